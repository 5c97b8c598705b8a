//! A scene as text: read, changed by `--set` and sweeps, and turned into a model.
use crate::model::Scene;
use crate::node::{Node, Source, Span};
use crate::plan::Plan;
use crate::problem::{Problem, Problems, Severity};
use crate::{check, json, path, plan, read, toml};

/// The format of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// For people.
    Toml,
    /// For programs.
    Json,
}

impl Format {
    /// The format of a file: by its extension, and where that says nothing (standard input, a built-in scene) JSON if the
    /// first character that is not blank is `{`.
    pub fn of(name: &str, text: &str) -> Self {
        let name = name.to_ascii_lowercase();
        if name.ends_with(".json") {
            Self::Json
        } else if name.ends_with(".toml") || !text.trim_start_matches('\u{feff}').trim_start().starts_with('{') {
            Self::Toml
        } else {
            Self::Json
        }
    }
}

/// The longest text that is read: twenty times the largest scene that anyone has written by hand or by script.
const LONGEST: usize = 256 << 20;

/// A scene file that is well formed, with the places of all its values.
#[derive(Clone, Debug)]
pub struct Document {
    pub(crate) root: Node,
    pub(crate) sources: Vec<Source>,
}

impl Document {
    /// Reads a file's bytes; `name` stands in messages, and its extension picks the format.
    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, Problems> {
        match std::str::from_utf8(bytes) {
            Ok(text) => Self::parse(name, text),
            Err(error) => {
                let good = error.valid_up_to();
                let text = String::from_utf8_lossy(&bytes[..(good + 64).min(bytes.len())]).into_owned();
                let sources = [Source { name: name.to_owned(), text }];
                let problem =
                    Problem::new("", "this is no text: a byte that is not UTF-8").help("save the file as UTF-8");
                Err(Span { source: 0, start: good, end: good + 1 }.tell(&sources, problem).into())
            }
        }
    }

    /// Reads a text, as [`Format::of`] says.
    pub fn parse(name: &str, text: &str) -> Result<Self, Problems> {
        Self::parse_as(name, text, Format::of(name, text))
    }

    /// Reads a text of this format.
    pub fn parse_as(name: &str, text: &str, format: Format) -> Result<Self, Problems> {
        // The mark of some editors is no part of the text, and takes no column.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.len() > LONGEST {
            let message = format!("{name}: {} bytes are more than {LONGEST}", text.len());
            return Err(Problem::new("", message).help("a [[group]] makes many bodies from one line").into());
        }
        let sources = vec![Source { name: name.to_owned(), text: text.to_owned() }];
        let root = match format {
            Format::Toml => toml::parse(&sources, 0),
            Format::Json => json::parse(&sources, 0),
        }?;
        Ok(Self { root, sources })
    }

    /// The model, with every rule checked that needs no body to be placed.
    pub fn scene(&self) -> Result<Scene, Problems> {
        let (scene, mut problems) = read::scene(&self.root, &self.sources);
        problems.retain(|p| p.severity == Severity::Error);
        let sound = problems.is_empty();
        if let Some(scene) = &scene {
            let mut more = check::names(scene);
            if sound {
                more.extend(check::rules(scene));
            }
            problems.extend(more.into_iter().map(|p| self.place(p)));
        }
        match scene {
            Some(scene) if problems.is_empty() => Ok(scene),
            _ => Err(Problems::new(problems)),
        }
    }

    /// Keys that have no effect where they stand.
    pub fn notes(&self) -> Vec<Problem> {
        let (_, mut problems) = read::scene(&self.root, &self.sources);
        problems.retain(|p| p.severity == Severity::Note);
        problems
    }

    /// All bodies and walls of this document's `scene`, placed and checked for overlaps.
    pub fn plan(&self, scene: &Scene) -> Result<Plan, Problems> {
        plan::plan(scene).map_err(|all| Problems::new(all.into_iter().map(|p| self.place(p)).collect()))
    }

    /// The problem, with the place in this document of the key it is about.
    pub fn place(&self, problem: Problem) -> Problem {
        path::locate(&self.root, &problem.key).tell(&self.sources, problem)
    }
}
