//! A case, run: a row for each number.
use serde::Serialize;

use crate::case::Names;
use crate::case::{Case, Number, Topic};
use crate::formula::{Misread, Words};
use crate::scene::{Got, Stage};
use crate::{contact, meeting, several};

/// One number: what it must be, and what it is.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// "topic/case", and ": what is read" where a case reads several numbers. Unique.
    pub name: String,
    /// Where the expected number comes from.
    pub reference: String,
    /// What it must be.
    pub expected: f64,
    /// What it is; not a number if it could not be read.
    pub got: f64,
    /// |got - expected|.
    pub error: f64,
    /// How large the error may be.
    pub tolerance: f64,
    /// True if it is not larger.
    pub pass: bool,
    /// What is read, as the book writes it.
    #[serde(skip)]
    pub reads: String,
    /// Where the tolerance comes from.
    #[serde(skip)]
    pub because: String,
    /// Why a number could not be read.
    #[serde(skip)]
    pub trouble: Option<String>,
}

impl Case {
    /// Runs the case: a row for each of its checks.
    pub fn run(&self, topic: &Topic) -> Vec<Row> {
        let names = Names::of(self);
        let got = self.got(topic, &names).unwrap_or_else(|e| self.check.iter().map(|_| Err(e.clone())).collect());
        let number = |number: &Number| names.value(number);
        let rows = self.check.iter().zip(got).map(|(check, got)| {
            let name = match self.check.len() {
                1 => format!("{}/{}", topic.name, self.name),
                _ => format!("{}/{}: {}{}", topic.name, self.name, check.got, when(check)),
            };
            let tolerance = check.tolerance.as_ref().unwrap_or(&self.tolerance);
            let all = number(&check.expected).and_then(|e| Ok((e, number(tolerance)?, got?)));
            let (expected, tolerance, got, trouble) = match all {
                Ok((expected, tolerance, got)) => (expected, tolerance, got, None),
                Err(e) => (f64::NAN, f64::NAN, f64::NAN, Some(e.0)),
            };
            let error = (got - expected).abs();
            Row {
                name,
                reference: self.reference.clone(),
                expected,
                got,
                error,
                tolerance,
                pass: error <= tolerance,
                reads: check.got.clone(),
                because: self.because.clone(),
                trouble,
            }
        });
        rows.collect()
    }

    fn got(&self, topic: &Topic, names: &Names<'_>) -> Result<Vec<Got>, Misread> {
        let all = |words: &dyn Words| {
            self.check.iter().map(|check| names.with(words).formula(&check.got)).collect::<Vec<Got>>()
        };
        match (&self.scene, &self.contact, &self.several, &self.meeting) {
            (Some(scene), None, None, None) => Ok(Stage::set(self, topic, scene, names)?.perform(self, names)),
            (None, Some(contact), None, None) => Ok(all(&contact::ask(contact, names)?)),
            (None, None, Some(several), None) => Ok(all(&several::ask(several, names)?)),
            (None, None, None, Some(meeting)) => Ok(all(&meeting::ask(meeting, names)?)),
            _ => Err(Misread("a case has one of scene, contact, several, meeting".into())),
        }
    }
}

/// When a check is read, if it says so itself.
fn when(check: &crate::case::Check) -> String {
    let written = |number: &Number| match number {
        Number::Integer(x) => x.to_string(),
        Number::Real(x) => x.to_string(),
        Number::Formula(text) => text.clone(),
    };
    match (&check.at, &check.after) {
        (Some(time), _) => format!(" at {}", written(time)),
        (None, Some(n)) => format!(" after {}", written(n)),
        (None, None) => String::new(),
    }
}
