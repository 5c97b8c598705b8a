//! The table of a sweep: its columns, its rows, and the file that holds them on the way.
use crate::draft::Draft;
use crate::figures::{count, plural};
use crate::trouble::Trouble;
use carom_scene::Data;
use carom_scene::output::Report;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The columns behind the swept values; those that are numbers have a mean.
pub const COLUMNS: [(&str, bool); 15] = [
    ("stopped", false),
    ("time", true),
    ("impacts", true),
    ("energy_start", true),
    ("energy_end", true),
    ("kinetic", true),
    ("potential", true),
    ("lost", true),
    ("work", true),
    ("energy_drift", true),
    ("momentum_drift", true),
    ("overlap", true),
    ("capped", true),
    ("pass", false),
    ("digest", false),
];

/// A row: the number of the run, its values, and how it ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    cells: Vec<String>,
}

impl Row {
    /// The row of the `index`-th run, from 0.
    pub fn new(index: usize, values: &[(&str, Data)], report: &Report) -> Self {
        let (audit, energy) = (&report.audit, &report.audit.energy);
        let mut cells = vec![(index + 1).to_string()];
        cells.extend(values.iter().map(|(_, value)| shown(value)));
        cells.push(report.stopped.into());
        cells.push(format!("{:?}", report.time));
        cells.push(report.impacts.to_string());
        let energies =
            [energy.start, energy.end, energy.kinetic, energy.potential, energy.lost, energy.work, energy.drift];
        cells.extend(energies.iter().chain([&audit.momentum.drift, &audit.overlap]).map(|x| format!("{x:?}")));
        cells.push(audit.capped.to_string());
        cells.push(audit.pass.to_string());
        cells.push(report.digest.clone());
        Self { cells }
    }

    /// The number of the run, from 1.
    pub fn number(&self) -> &str {
        &self.cells[0]
    }

    /// The values of the sweep.
    pub fn values(&self) -> &[String] {
        &self.cells[1..self.cells.len() - COLUMNS.len()]
    }

    /// What a column of [`COLUMNS`] says.
    pub fn result(&self, name: &str) -> &str {
        let place = COLUMNS.iter().position(|c| c.0 == name).unwrap_or(0);
        &self.cells[self.cells.len() - COLUMNS.len() + place]
    }

    pub fn stopped_itself(&self) -> bool {
        matches!(self.result("stopped"), "crushed" | "not-finite")
    }

    pub fn passed(&self) -> bool {
        self.result("pass") == "true"
    }

    fn line(&self) -> String {
        line(self.cells.iter().map(String::as_str))
    }
}

/// A value as a cell: text without quotes, everything else as TOML writes it.
pub fn shown(value: &Data) -> String {
    match value {
        Data::Flag(flag) => flag.to_string(),
        Data::Integer(k) => k.to_string(),
        Data::Number(x) => format!("{x:?}"),
        Data::Text(text) => text.clone(),
        Data::List(items) => format!("[{}]", items.iter().map(quoted).collect::<Vec<_>>().join(", ")),
        Data::Table(entries) => {
            let entries = entries.iter().map(|(key, value)| format!("{key} = {}", quoted(value)));
            format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
    }
}

fn quoted(value: &Data) -> String {
    match value {
        Data::Text(text) => format!("{text:?}"),
        other => shown(other),
    }
}

/// A line of comma-separated values (RFC 4180), with its end.
pub fn line<'a>(cells: impl IntoIterator<Item = &'a str>) -> String {
    let quoted = cells.into_iter().map(|cell| {
        if cell.contains([',', '"', '\n', '\r']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell.into() }
    });
    quoted.collect::<Vec<String>>().join(",") + "\n"
}

/// The cells of such a line; `None` if it was cut.
fn cells(line: &str) -> Option<Vec<String>> {
    let mut all = vec![String::new()];
    let mut quotes = false;
    let mut letters = line.strip_suffix('\n')?.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quotes && letters.peek() == Some(&'"') => {
                letters.next();
                all.last_mut()?.push('"');
            }
            '"' => quotes = !quotes,
            ',' if !quotes => all.push(String::new()),
            other => all.last_mut()?.push(other),
        }
    }
    (!quotes).then_some(all)
}

/// The table of a sweep.
pub struct Table {
    head: String,
    rows: Vec<Row>,
    /// The file, and where its rows are while they are not all there.
    file: Option<(String, PathBuf, File)>,
}

impl Table {
    /// Starts a table on standard output, or in a file; `what` tells sweeps apart. With `resume`, rows that are there already are read.
    pub fn start(
        name: Option<&str>,
        resume: bool,
        keys: &[String],
        runs: &Range<usize>,
        what: &str,
    ) -> Result<Self, Trouble> {
        let columns = keys.iter().map(String::as_str).chain(COLUMNS.map(|c| c.0));
        let head = line(["run"].into_iter().chain(columns));
        let Some(name) = name else {
            super::print(&head)?;
            return Ok(Self { head, rows: Vec::new(), file: None });
        };
        // What cannot be replaced is known before hours are spent.
        drop(Draft::create(name)?);
        let part = part(Path::new(name));
        let mark = format!("# carom {} sweep {:016x}\n", env!("CARGO_PKG_VERSION"), fnv(what.as_bytes()));
        let kept = match fs::read_to_string(&part) {
            Ok(text) if text.starts_with(&mark) => Some(text),
            _ => None,
        };
        let there = part.display();
        let rows = match (kept, resume) {
            (Some(text), true) => read(&text[mark.len()..], &head, runs),
            (Some(text), false) if !read(&text[mark.len()..], &head, runs).is_empty() => {
                let done = plural(read(&text[mark.len()..], &head, runs).len() as u64, "run");
                let help = format!("--resume goes on with it; delete {there} to begin anew");
                return Err(Trouble::usage(format!("{there} holds {done} of this sweep already\nhelp: {help}")));
            }
            (None, true) if part.exists() => {
                let help = "give the same scene, --set and --shard; or leave --resume out to begin anew";
                return Err(Trouble::usage(format!("{there} is of another sweep\nhelp: {help}")));
            }
            _ => Vec::new(),
        };
        // Only whole rows of this sweep stay.
        let mut text = mark + &head;
        text.extend(rows.iter().map(Row::line));
        let cannot = |e: io::Error| Trouble::unwritten(&there.to_string(), &e);
        let beside = crate::draft::beside(&part);
        let put = fs::write(&beside, &text).and_then(|()| fs::rename(&beside, &part));
        put.inspect_err(|_| drop(fs::remove_file(&beside))).map_err(cannot)?;
        let file = OpenOptions::new().append(true).open(&part).map_err(cannot)?;
        Ok(Self { head, rows, file: Some((name.into(), part, file)) })
    }

    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Adds the next row.
    pub fn add(&mut self, row: Row) -> Result<(), Trouble> {
        match &mut self.file {
            None => super::print(&row.line())?,
            Some((_, part, file)) => {
                // One write: a process that is killed leaves a row or none, or a piece that is known as one.
                let written = file.write_all(row.line().as_bytes());
                written.map_err(|e| Trouble::unwritten(&part.display().to_string(), &e))?;
            }
        }
        self.rows.push(row);
        Ok(())
    }

    /// The trouble, with where the rows are.
    pub fn keep(&self, trouble: Trouble) -> Trouble {
        if trouble.is_unread() {
            return trouble;
        }
        match &self.file {
            Some((_, part, _)) if !self.rows.is_empty() => {
                let note = format!("note: {} are in {}", plural(self.rows.len() as u64, "row"), part.display());
                trouble.with(&note)
            }
            _ => trouble,
        }
    }

    /// What to say after Ctrl-C.
    pub fn interrupted(&self, runs: &Range<usize>) -> Trouble {
        let done = format!("{} of {} runs are done", count(self.rows.len() as u64), count(runs.len() as u64));
        let trouble = Trouble::interrupted();
        match &self.file {
            Some((_, part, _)) => trouble.with(&format!("{done}, in {}; --resume goes on", part.display())),
            None => trouble.with(&done),
        }
    }

    /// All rows are there: the file is put in its place.
    pub fn finish(self) -> Result<(), Trouble> {
        let Some((name, part, _)) = self.file else { return Ok(()) };
        let mut draft = Draft::create(&name)?;
        let written = draft.write_all(self.head.as_bytes()).and_then(|()| {
            self.rows.iter().try_for_each(|row| draft.write_all(row.line().as_bytes()))?;
            draft.complete()
        });
        written.map_err(|e| Trouble::unwritten(&name, &e))?;
        let _ = fs::remove_file(part);
        Ok(())
    }
}

/// Where the rows of a file are while they are not all there.
fn part(file: &Path) -> PathBuf {
    let mut name = file.file_name().unwrap_or_default().to_os_string();
    name.push(".part");
    file.with_file_name(name)
}

/// The rows of a part that follow one another from the first run on.
fn read(text: &str, head: &str, runs: &Range<usize>) -> Vec<Row> {
    let Some(rest) = text.strip_prefix(head) else { return Vec::new() };
    let columns = cells(head).map_or(0, |c| c.len());
    let mut rows: Vec<Row> = Vec::new();
    // A cell may hold the end of a line: lines are put together until their quotes match.
    let mut piece = String::new();
    for line in rest.split_inclusive('\n') {
        piece += line;
        let Some(cells) = cells(&piece) else { continue };
        let due = runs.start + rows.len() + 1;
        if cells.len() != columns || cells[0] != due.to_string() || due > runs.end {
            break;
        }
        rows.push(Row { cells });
        piece.clear();
    }
    rows
}

/// 64-bit FNV-1a.
fn fnv(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &b| (hash ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_back_and_what_is_cut_does_not_count() {
        let wild = ["1", "a, b", "say \"x\"", "two\nlines", ""];
        let text = line(wild);
        assert_eq!(cells(&text), Some(wild.map(String::from).to_vec()));
        for cut in 0..text.len() {
            // Cut anywhere, the end of the line is missing, or stands inside quotes.
            assert!(cells(&text[..cut]).is_none(), "{cut}");
        }
        let head = line(["run", "x"].into_iter().chain(COLUMNS.map(|c| c.0)));
        let row = |n: usize| line([n.to_string().as_str(), "two\nlines"].into_iter().chain(COLUMNS.map(|c| c.0)));
        let whole = format!("{head}{}{}", row(4), row(5));
        for cut in 0..=whole.len() {
            let want = usize::from(cut >= head.len() + row(4).len()) + usize::from(cut == whole.len());
            assert_eq!(read(&whole[..cut], &head, &(3..9)).len(), want, "{cut}");
        }
        assert_eq!(read(&whole, &head, &(2..9)).len(), 0, "another part");
    }
}
