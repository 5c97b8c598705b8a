//! `carom verify`: the verification book, run here and now.
use crate::figures::{digits, plural};
use crate::table::Table;
use crate::trouble::{Trouble, colour, say};
use carom_book::{Book, Chosen, Row};
use clap::{Args, ValueEnum};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

const AFTER: &str = "\
A case is a situation, where its numbers come from, what they must be, and how far off they may
be and why. None of them is the engine's own. NAME is a file of the book (pool), a case
(pool/half-full), or how names begin (cradles). One case alone is shown with its derivation.

Exit codes: 0 all within tolerance, 1 a number is not, 2 nothing has that name.

Examples:
  carom verify
  carom verify galperin
  carom verify oblique --format markdown
  carom verify --format json > book.json";

/// Run the verification book: expected, got, error and tolerance of every law
#[derive(Args)]
#[command(after_help = AFTER)]
pub struct Verify {
    /// A file of the book, a case, or the beginning of names; all of it if left out
    name: Option<String>,
    /// How to print it
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    /// Run the cases that take long as well
    #[arg(long)]
    long: bool,
    /// Print the names and references of the cases, and run nothing
    #[arg(long)]
    list: bool,
    /// Run the book in this folder instead: its .toml files, in the order of their names
    #[arg(long, value_name = "FOLDER")]
    book: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// for people
    Text,
    /// for the guide
    Markdown,
    /// for programs: an array, an object a number
    Json,
}

impl Verify {
    pub fn run(self) -> Result<(), Trouble> {
        let book = match &self.book {
            None => Book::open().map_err(|e| Trouble::audit(e.to_string()))?,
            Some(folder) => folder_of(folder)?,
        };
        let chosen = book.choose(self.name.as_deref(), self.long).map_err(|e| Trouble::usage(e.to_string()))?;
        let mut out = io::stdout().lock();
        if self.list {
            return list(&chosen, &mut out);
        }
        let begun = Instant::now();
        let mut all: Vec<Row> = Vec::new();
        let alone = chosen.len() == 1;
        if self.format == Format::Markdown {
            say(&mut out, "# The cases of the verification book\n\n")?;
        }
        for topic in chosen.chunk_by(|a, b| a.topic.name == b.topic.name) {
            let rows = carom_book::run(topic);
            match self.format {
                Format::Text if alone => say(&mut out, &case(&topic[0], &rows[0]))?,
                Format::Text => say(&mut out, &text(topic, &rows, colour()))?,
                Format::Markdown => say(&mut out, &markdown(topic, &rows))?,
                Format::Json => {}
            }
            all.extend(rows.into_iter().flatten());
        }
        let failed: Vec<&Row> = all.iter().filter(|row| !row.pass).collect();
        let counts = format!("{} of {}", plural(all.len() as u64, "number"), plural(chosen.len() as u64, "case"));
        match self.format {
            Format::Text => {
                let time = digits(begun.elapsed().as_secs_f64(), 2);
                say(&mut out, &format!("{}\n{}\n", failures(&failed), total(&counts, failed.len(), &time)))?;
            }
            Format::Markdown => {
                let verdict = match failed.len() {
                    0 => "all within their tolerances".to_owned(),
                    n => format!("**{n} not within their tolerances**"),
                };
                say(&mut out, &format!("{counts}: {verdict}.\n"))?;
            }
            Format::Json => {
                let json = serde_json::to_string_pretty(&all).map_err(|e| Trouble::audit(e.to_string()))?;
                say(&mut out, &(json + "\n"))?;
            }
        }
        if failed.is_empty() {
            return Ok(());
        }
        if self.format == Format::Text {
            // The table has said it.
            return Err(Trouble::audit(""));
        }
        Err(Trouble::audit(failures(&failed)))
    }
}

/// The book in a folder.
fn folder_of(folder: &Path) -> Result<Book, Trouble> {
    let cannot = |path: &Path, e: io::Error| Trouble::usage(format!("cannot read {}: {e}", path.display()));
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(|e| cannot(folder, e))? {
        let path = entry.map_err(|e| cannot(folder, e))?.path();
        if path.extension().is_some_and(|e| e == "toml") {
            paths.push(path);
        }
    }
    paths.sort();
    if paths.is_empty() {
        return Err(Trouble::usage(format!("there is no .toml file in {}", folder.display())));
    }
    let mut files = Vec::new();
    for path in paths {
        let text = std::fs::read_to_string(&path).map_err(|e| cannot(&path, e))?;
        files.push((path.file_stem().unwrap_or_default().to_string_lossy().into_owned(), text));
    }
    let texts = files.iter().map(|(name, text)| (name.as_str(), text.as_str()));
    Book::read(texts).map_err(|e| Trouble::usage(e.to_string()))
}

/// Names and references.
fn list(chosen: &[Chosen<'_>], out: &mut impl Write) -> Result<(), Trouble> {
    for topic in chosen.chunk_by(|a, b| a.topic.name == b.topic.name) {
        let mut lines = format!("{}: {}\n", topic[0].topic.name, topic[0].topic.title);
        for c in topic {
            lines.push_str(&format!("  {}\n      {}\n", c.name(), c.case.reference));
        }
        say(out, &lines)?;
    }
    Ok(())
}

/// A number of the table: twelve digits are more than any tolerance of the book leaves.
fn figure(x: f64) -> String {
    digits(x, 12)
}

/// What tells the rows of a case apart.
fn reads<'r>(c: &Chosen<'_>, row: &'r Row) -> &'r str {
    row.name.strip_prefix(&c.name()).map_or("", |rest| rest.trim_start_matches(": "))
}

/// The widths of the table: names, expected, got, error, tolerance.
const WIDTHS: [usize; 5] = [46, 19, 19, 9, 9];

/// A topic as text: a line for each number.
fn text(topic: &[Chosen<'_>], rows: &[Vec<Row>], colour: bool) -> String {
    let paint = |code: &str, text: &str| if colour { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() };
    let [w, e, g, r, t] = WIDTHS;
    let mut lines = format!("\n{}\n", paint("1", &format!("{}  ({})", topic[0].topic.title, topic[0].topic.name)));
    let head = format!("  {:w$} {:>e$} {:>g$} {:>r$} {:>t$}", "", "expected", "got", "error", "tolerance");
    lines.push_str(&format!("{}\n", paint("2", &head)));
    for (c, rows) in topic.iter().zip(rows) {
        let several = rows.len() > 1;
        if several {
            lines.push_str(&format!("  {}\n", c.case.name));
        }
        for row in rows {
            let name = if several { format!("    {}", reads(c, row)) } else { c.case.name.clone() };
            let name = cut(&name, w);
            let mark = if row.pass { paint("32", "✓") } else { paint("1;31", "✗ FAILED") };
            let [error, tolerance] = [row.error, row.tolerance].map(|x| digits(x, 2));
            let (expected, got) = (figure(row.expected), figure(row.got));
            lines.push_str(&format!("  {name:w$} {expected:>e$} {got:>g$} {error:>r$} {tolerance:>t$} {mark}\n"));
        }
    }
    lines
}

/// At most so many characters.
fn cut(text: &str, width: usize) -> String {
    if text.chars().count() <= width {
        return text.to_owned();
    }
    text.chars().take(width - 1).chain(['…']).collect()
}

/// One case with all that the book says of it.
fn case(c: &Chosen<'_>, rows: &[Row]) -> String {
    let mut text = format!("\n{}\n\n", c.name());
    let mut tell = |key: &str, value: &str| {
        for (k, line) in wrapped(value, 84).into_iter().enumerate() {
            text.push_str(&format!("  {:<10} {line}\n", if k == 0 { key } else { "" }));
        }
    };
    tell("reference", &c.case.reference);
    if let Some(note) = &c.case.note {
        tell("note", note);
    }
    tell("tolerance", &c.case.because);
    let mut table = Table::new("lrrrrl", ["", "expected", "got", "error", "tolerance", ""]);
    for row in rows {
        let digits2 = |x| digits(x, 2);
        let mark = if row.pass { "✓" } else { "✗ FAILED" };
        table.row([
            row.reads.clone(),
            digits(row.expected, 17),
            digits(row.got, 17),
            digits2(row.error),
            digits2(row.tolerance),
            mark.to_owned(),
        ]);
    }
    text + "\n" + &table.text(colour())
}

/// A text in lines of at most this many characters, where words allow it.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().map_or(0, |l| l.chars().count());
        if line > 0 && line + 1 + word.chars().count() > width {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            line.push_str(if line.is_empty() { "" } else { " " });
            line.push_str(word);
        }
    }
    lines
}

/// What failed, each with where its number comes from.
fn failures(failed: &[&Row]) -> String {
    let mut text = String::new();
    for row in failed {
        text.push_str(&format!("\nFAILED {}\n", row.name));
        match &row.trouble {
            Some(trouble) => text.push_str(&format!("  {trouble}\n")),
            None => {
                let [expected, got] = [row.expected, row.got].map(|x| digits(x, 17));
                let [error, tolerance] = [row.error, row.tolerance].map(|x| digits(x, 2));
                text.push_str(&format!(
                    "  expected {expected}, got {got}: off by {error}, and {tolerance} is allowed\n  tolerance: {}\n",
                    row.because
                ));
            }
        }
        text.push_str(&format!("  reference: {}\n", row.reference));
    }
    text
}

fn total(counts: &str, failed: usize, seconds: &str) -> String {
    match failed {
        0 => format!("PASSED: {counts}, all within their tolerances, in {seconds} s."),
        n => format!("FAILED: {n} of {counts} are not within their tolerances ({seconds} s)."),
    }
}

/// A topic in Markdown.
fn markdown(topic: &[Chosen<'_>], rows: &[Vec<Row>]) -> String {
    let head = topic[0].topic;
    let text = format!("## {}\n\n{}\n\n", head.title, head.about.split_whitespace().collect::<Vec<_>>().join(" "));
    let mut table = Table::new("llrrrrl", ["case", "reads", "expected", "got", "error", "tolerance", ""]);
    let mut sources = String::new();
    for (c, rows) in topic.iter().zip(rows) {
        for (k, row) in rows.iter().enumerate() {
            let name = if k == 0 { c.case.name.clone() } else { String::new() };
            let [error, tolerance] = [row.error, row.tolerance].map(|x| digits(x, 2));
            let mark = if row.pass { "✓" } else { "✗ **failed**" };
            let reads = match reads(c, row) {
                "" => &row.reads,
                reads => reads,
            };
            table.row([
                name,
                format!("`{reads}`"),
                figure(row.expected),
                figure(row.got),
                error,
                tolerance,
                mark.to_owned(),
            ]);
        }
        let note = c.case.note.as_deref().unwrap_or_default().split_whitespace().collect::<Vec<_>>().join(" ");
        let note = if note.is_empty() { note } else { format!(" {note}") };
        sources.push_str(&format!(
            "- **{}**: {}.{note} *Tolerance*: {}.\n",
            c.case.name, c.case.reference, c.case.because
        ));
    }
    text + &table.markdown() + "\n" + &sources + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_wrapped_and_cut() {
        assert_eq!(wrapped("a bb ccc dddd", 6), ["a bb", "ccc", "dddd"]);
        assert_eq!(wrapped("", 6), [""]);
        assert_eq!((cut("abc", 3).as_str(), cut("abcd", 3).as_str()), ("abc", "ab…"));
    }
}
