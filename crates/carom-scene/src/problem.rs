//! What is wrong with a scene: where, which key, which rule, and what would be right.
use std::fmt;

/// How many problems of one file are told: more would be a wall of text, and most of them the echo of the first.
pub const MOST_PROBLEMS: usize = 20;

/// The longest piece of a source line that is shown around a problem, in characters.
const EXCERPT: usize = 100;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The scene cannot run.
    Error,
    /// The scene runs, but a key in it has no effect.
    Note,
}

/// Where a problem lies in the text that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The name of the file, or of the argument.
    pub source: String,
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1, in characters.
    pub column: usize,
    /// The source line, or the part of it around the problem.
    excerpt: String,
    /// How many characters of the excerpt lie before the problem.
    before: usize,
    /// How many characters to underline, at least one.
    width: usize,
}

impl Place {
    /// The place of the bytes `start..end` of a text.
    pub(crate) fn new(source: &str, text: &str, start: usize, end: usize) -> Self {
        let start = floor_boundary(text, start);
        let end = floor_boundary(text, end).max(start);
        let line_start = text[..start].rfind('\n').map_or(0, |k| k + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |k| start + k);
        let line = text[..line_start].bytes().filter(|&b| b == b'\n').count() + 1;
        let column = text[line_start..start].chars().count() + 1;
        // A problem that spans lines is underlined on its first one.
        let width = text[start..end.min(line_end)].chars().count().max(1);
        let skip = if column + width.min(EXCERPT / 2) > EXCERPT { column.saturating_sub(EXCERPT / 2) } else { 0 };
        let mut excerpt: String = text[line_start..line_end]
            .trim_end_matches('\r')
            .chars()
            .skip(skip)
            .take(EXCERPT)
            .map(|c| if c.is_control() { ' ' } else { c })
            .collect();
        while excerpt.ends_with(' ') {
            excerpt.pop();
        }
        let before = column - 1 - skip;
        let width = width.min(EXCERPT.saturating_sub(before)).max(1);
        Self { source: source.to_owned(), line, column, excerpt, before, width }
    }
}

/// The last place at or before `k` where a character starts.
fn floor_boundary(text: &str, k: usize) -> usize {
    let mut k = k.min(text.len());
    while !text.is_char_boundary(k) {
        k -= 1;
    }
    k
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Error or note.
    pub severity: Severity,
    /// The key it is about, as a dotted path that `--set` understands: `body[2].mass`. Counted from 1, as `body-1` is.
    pub key: String,
    /// The rule that is broken, in plain words.
    pub message: String,
    /// What would be right.
    pub help: Option<String>,
    /// Where it is, if the scene was read from text.
    pub place: Option<Box<Place>>,
}

impl Problem {
    /// An error about a key.
    pub fn new(key: impl Into<String>, message: impl Into<String>) -> Self {
        Self { severity: Severity::Error, key: key.into(), message: message.into(), help: None, place: None }
    }

    /// The same, with what would be right.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The same, found there.
    pub(crate) fn at(mut self, place: Place) -> Self {
        self.place = Some(Box::new(place));
        self
    }

    /// The line, from 1, if it is known.
    pub fn line(&self) -> Option<usize> {
        self.place.as_ref().map(|p| p.line)
    }

    /// The column, from 1 and in characters, if it is known.
    pub fn column(&self) -> Option<usize> {
        self.place.as_ref().map(|p| p.column)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.place {
            write!(f, "{}:{}:{}: ", place.source, place.line, place.column)?;
        }
        f.write_str(match self.severity {
            Severity::Error => "error: ",
            Severity::Note => "note: ",
        })?;
        if !self.key.is_empty() {
            write!(f, "{}: ", self.key)?;
        }
        f.write_str(&self.message)?;
        if let Some(place) = &self.place {
            let gutter = place.line.to_string().len();
            write!(f, "\n {} | {}", place.line, place.excerpt)?;
            write!(
                f,
                "\n {:gutter$} | {:before$}{:^>width$}",
                "",
                "",
                "^",
                before = place.before,
                width = place.width
            )?;
        }
        if let Some(help) = &self.help {
            write!(f, "\nhelp: {help}")?;
        }
        Ok(())
    }
}

/// Everything that is wrong with a scene, in the order of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problems {
    all: Vec<Problem>,
    untold: usize,
}

impl Problems {
    /// The first [`MOST_PROBLEMS`] of these, in the order of the text; what is at the same place keeps its order.
    pub(crate) fn new(mut all: Vec<Problem>) -> Self {
        all.sort_by_key(|p| p.place.as_ref().map(|p| (p.line, p.column)));
        let untold = all.len().saturating_sub(MOST_PROBLEMS);
        all.truncate(MOST_PROBLEMS);
        Self { all, untold }
    }

    /// The problems, in the order of the text.
    pub fn iter(&self) -> std::slice::Iter<'_, Problem> {
        self.all.iter()
    }
}

impl From<Problem> for Problems {
    fn from(problem: Problem) -> Self {
        Self::new(vec![problem])
    }
}

impl IntoIterator for Problems {
    type Item = Problem;
    type IntoIter = std::vec::IntoIter<Problem>;
    fn into_iter(self) -> Self::IntoIter {
        self.all.into_iter()
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, problem) in self.all.iter().enumerate() {
            write!(f, "{}{problem}", if k == 0 { "" } else { "\n\n" })?;
        }
        if self.untold > 0 {
            write!(f, "\n\nand at least {} more", self.untold)?;
        }
        Ok(())
    }
}

impl std::error::Error for Problems {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_problem_reads_like_a_compilers() {
        let text = "carom = 1\nmäss = -2.0 # negative\n";
        let start = text.find("-2.0").unwrap();
        let problem = Problem::new("body[1].mass", "mass must be positive, got -2")
            .help("a mass in kg, as in mass = 1.0")
            .at(Place::new("scene.toml", text, start, start + 4));
        let shown = problem.to_string();
        println!("{shown}");
        assert_eq!(
            shown,
            "scene.toml:2:8: error: body[1].mass: mass must be positive, got -2\n \
             2 | mäss = -2.0 # negative\n   |        ^^^^\nhelp: a mass in kg, as in mass = 1.0"
        );
    }

    #[test]
    fn a_place_inside_a_character_or_past_the_end_is_no_panic() {
        for text in ["", "é", "a\r\nb", "\n\n"] {
            for start in 0..6 {
                for end in 0..6 {
                    let place = Place::new("x", text, start, end);
                    assert!(place.line >= 1 && place.column >= 1);
                    let _ = Problem::new("k", "m").at(place).to_string();
                }
            }
        }
    }

    #[test]
    fn a_long_line_is_cut_around_the_problem() {
        let text = format!("{}!{}", "a".repeat(5000), "b".repeat(5000));
        let place = Place::new("x", &text, 5000, 5001);
        let shown = Problem::new("k", "m").at(place).to_string();
        println!("{shown}");
        let lines: Vec<_> = shown.lines().collect();
        assert!(lines[1].len() < 130);
        assert_eq!(lines[1].find('!'), lines[2].find('^'));
    }
}
