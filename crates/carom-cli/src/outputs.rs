//! Files that a run writes. They appear under their names when they are complete: what is under way lies beside.
use crate::source::{Ready, told};
use crate::trouble::Trouble;
use carom_scene::Problem;
use carom_scene::output::{BodyLine, ImpactLine, Report};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Holds {
    /// The run in one object.
    Run,
    /// The impacts.
    Impacts(Rows),
    /// The bodies, at equal steps of time (s).
    Bodies(Rows, f64),
}

/// How rows are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rows {
    Csv,
    Lines,
}

/// A file that a run writes.
pub struct Output {
    pub holds: Holds,
    name: String,
    to: PathBuf,
    /// Where it is written before it is complete; `None` for what cannot be replaced, such as a pipe.
    beside: Option<PathBuf>,
    file: BufWriter<File>,
}

impl Output {
    fn open(name: &str, holds: Holds, dim: usize) -> Result<Self, Trouble> {
        let cannot = |e: io::Error| Trouble::unwritten(name, &e);
        // A link stays a link: what it points to is replaced.
        let to = fs::canonicalize(name).unwrap_or_else(|_| PathBuf::from(name));
        let special = fs::metadata(&to).is_ok_and(|m| !m.is_file());
        if to.is_dir() {
            return Err(Trouble::usage(format!("cannot write {name}: it is a folder")));
        }
        let beside = (!special).then(|| beside(&to));
        let file = match &beside {
            Some(path) => File::create(path),
            None => fs::OpenOptions::new().write(true).open(&to),
        };
        let file = BufWriter::new(file.map_err(cannot)?);
        let mut output = Self { holds, name: name.into(), to, beside, file };
        match holds {
            Holds::Impacts(Rows::Csv) => output.line(&ImpactLine::csv_head(dim))?,
            Holds::Bodies(Rows::Csv, _) => output.line(&BodyLine::csv_head(dim))?,
            _ => {}
        }
        Ok(output)
    }

    fn line(&mut self, line: &str) -> Result<(), Trouble> {
        writeln!(self.file, "{line}").map_err(|e| Trouble::unwritten(&self.name, &e))
    }

    /// Writes an impact, if the file holds impacts.
    pub fn impact(&mut self, line: &ImpactLine) -> Result<(), Trouble> {
        match self.holds {
            Holds::Impacts(Rows::Csv) => self.line(&line.csv()),
            Holds::Impacts(Rows::Lines) => self.line(&line.json()),
            _ => Ok(()),
        }
    }

    /// Writes a body, if the file holds bodies.
    pub fn body(&mut self, line: &BodyLine) -> Result<(), Trouble> {
        match self.holds {
            Holds::Bodies(Rows::Csv, _) => self.line(&line.csv()),
            Holds::Bodies(Rows::Lines, _) => self.line(&line.json()),
            _ => Ok(()),
        }
    }

    /// Completes the file, and puts it in its place.
    pub fn finish(mut self, report: &Report) -> Result<(), Trouble> {
        let done = match self.holds {
            Holds::Run => self.file.write_all(report.json().as_bytes()),
            _ => Ok(()),
        };
        let done = done.and_then(|()| self.file.flush()).and_then(|()| match &self.beside {
            Some(path) => fs::rename(path, &self.to),
            None => Ok(()),
        });
        done.map_err(|e| Trouble::unwritten(&self.name, &e))?;
        self.beside = None;
        Ok(())
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        // Cut short: nothing half written is left.
        if let Some(path) = self.beside.take() {
            let _ = fs::remove_file(path);
        }
    }
}

/// The name beside a file under which it is written.
fn beside(to: &Path) -> PathBuf {
    let mut name = to.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".part-{}", std::process::id()));
    to.with_file_name(name)
}

/// Opens what the command line and the scene want written, in that order.
pub fn open(ready: &Ready, wanted: &[String]) -> Result<Vec<Output>, Trouble> {
    let mut all: Vec<(String, Holds)> = Vec::new();
    for path in wanted {
        if let Some(problem) = carom_scene::output(path) {
            return Err(told(&[Problem { key: "-o".into(), ..problem }]));
        }
        all.push((
            path.clone(),
            holds(path, None).ok_or_else(|| Trouble::usage(format!("-o {path}: no such format")))?,
        ));
    }
    for (k, output) in ready.scene.outputs.iter().enumerate() {
        match holds(&output.path, output.every) {
            Some(holds) => all.push((output.path.clone(), holds)),
            None => {
                let problem = Problem::new(
                    format!("output[{}].every", k + 1),
                    format!("`{}` is written once, when the run is over", output.path),
                );
                let help = "leave `every` out, or write the bodies on the way to a .csv or .jsonl";
                return Err(told(&[ready.document.place(problem.help(help))]));
            }
        }
    }
    for (k, (path, _)) in all.iter().enumerate() {
        if all[..k].iter().any(|(other, _)| other == path) {
            return Err(Trouble::usage(format!("{path} would be written twice; give the outputs different names")));
        }
    }
    all.iter().map(|(path, holds)| Output::open(path, *holds, ready.scene.world.dim)).collect()
}

/// What a file of this name holds.
fn holds(path: &str, every: Option<f64>) -> Option<Holds> {
    let extension = carom_scene::model::Output { path: path.into(), every }.extension();
    let rows = match extension.as_str() {
        "csv" => Rows::Csv,
        "jsonl" => Rows::Lines,
        "json" => return if every.is_none() { Some(Holds::Run) } else { None },
        _ => return None,
    };
    Some(every.map_or(Holds::Impacts(rows), |step| Holds::Bodies(rows, step)))
}
