//! What stands in the files of the book: topics, their cases, and what each of them checks.
use std::collections::BTreeMap;

use serde::Deserialize;

use crate::formula::{Formula, Misread, Words};

/// A file of the book.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Topic {
    /// The file's name without its extension; it begins the name of each of its cases.
    #[serde(skip)]
    pub name: String,
    /// What the table is headed by.
    pub title: String,
    /// The law in a few sentences, with its equation.
    pub about: String,
    /// Scenes that several cases share, as text with `$name` and `$(formula)` where the cases differ.
    #[serde(default)]
    pub scenes: BTreeMap<String, String>,
    /// The cases, in order.
    #[serde(rename = "case")]
    pub cases: Vec<Case>,
}

/// One case: a situation, and the numbers that it must come to.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Unique in its file.
    pub name: String,
    /// Where the expected numbers come from.
    pub reference: String,
    /// What else is to be said: a derivation, a printed answer that is wrong.
    pub note: Option<String>,
    /// The case's own names. One may use the others.
    #[serde(default, rename = "let")]
    pub names: BTreeMap<String, Number>,
    /// A world: the name of a scene of the file, or of a built-in one, or the text of a scene.
    pub scene: Option<String>,
    /// Keys of the scene that differ, by dotted path.
    #[serde(default)]
    pub set: BTreeMap<String, Number>,
    /// What is measured of a gas between two numbers of impacts.
    pub window: Option<Window>,
    /// One contact, given to a law without a world.
    pub contact: Option<Contact>,
    /// Several contacts at one instant, given to an operator without a world.
    pub several: Option<Several>,
    /// The motion of a ball towards something: when do they meet?
    pub meeting: Option<Meeting>,
    /// How far `got` may lie from `expected`, for checks that say nothing of their own.
    pub tolerance: Number,
    /// Where the tolerance comes from.
    pub because: String,
    /// When the checks are read, unless they say so themselves: at this time (s) ...
    pub at: Option<Number>,
    /// ... or after this number of impacts. Neither: at the end of the run.
    pub after: Option<Number>,
    /// The numbers that are read, and what they must be.
    pub check: Vec<Check>,
    /// Runs only when asked for (`--long`): it takes more than a second or two.
    #[serde(default)]
    pub long: bool,
}

/// A number, or a formula for one.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(untagged)]
pub enum Number {
    /// As it stands.
    Integer(i64),
    /// As it stands.
    Real(f64),
    /// A formula.
    Formula(String),
}

/// One number that is read.
#[derive(Clone, Debug, Deserialize)]
#[serde(from = "Written")]
pub struct Check {
    /// The formula of what is read.
    pub got: String,
    /// What it must be.
    pub expected: Number,
    /// How far off it may be; the case's tolerance if there is none.
    pub tolerance: Option<Number>,
    /// When it is read (s); as the case says, if neither this nor `after` is given.
    pub at: Option<Number>,
    /// After how many impacts it is read.
    pub after: Option<Number>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Written {
    Short(String, Number),
    Full(Full),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Full {
    got: String,
    expected: Number,
    tolerance: Option<Number>,
    at: Option<Number>,
    after: Option<Number>,
}

impl From<Written> for Check {
    fn from(written: Written) -> Self {
        match written {
            Written::Short(got, expected) => Self { got, expected, tolerance: None, at: None, after: None },
            Written::Full(Full { got, expected, tolerance, at, after }) => Self { got, expected, tolerance, at, after },
        }
    }
}

/// What is counted while a gas runs.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Window {
    /// Impacts before it begins, for the gas to forget how it was laid out.
    pub skip: Number,
    /// Impacts that it lasts.
    pub take: Number,
    /// Impacts between two looks at all velocities.
    pub look: Option<Number>,
    /// The time (s) over which velocities are correlated and displacements measured; from each look on.
    pub lag: Option<Number>,
}

/// One contact for a law.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// "line", "rotated", "smooth", "rough", "chatterjee-ruina", "stronge" or "newton".
    pub law: String,
    /// From the first body to the second; of any length for the smooth laws and "rough", else it is made a unit vector.
    pub normal: Vec<Number>,
    /// e.
    pub restitution: Number,
    /// mu.
    pub friction: Option<Number>,
    /// e_t.
    pub tangential: Option<Number>,
    /// The first body.
    pub a: Body,
    /// The second body; a wall at rest if there is none.
    pub b: Option<Body>,
}

/// A body of a contact.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Mass (kg); `inf` for what nothing can move.
    pub mass: Number,
    /// Velocity (m/s).
    pub velocity: Vec<Number>,
    /// Spin (rad/s): one number in the plane, three in space.
    #[serde(default)]
    pub spin: Vec<Number>,
    /// The radius (m) of a ball: its arm lies along the normal.
    pub radius: Option<Number>,
    /// kappa of a ball, I = kappa m R^2.
    pub kappa: Option<Number>,
    /// Inertia about the centre of mass (kg m^2) of what is no ball: one number in the plane, the diagonal in space.
    #[serde(default)]
    pub inertia: Vec<Number>,
    /// From the centre of mass to the contact (m), of what is no ball.
    #[serde(default)]
    pub arm: Vec<Number>,
}

/// Several contacts for an operator.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Several {
    /// "reflect", "lcp", "sequential", "gr", "grr" or "project".
    pub operator: String,
    /// The mass (kg) or inertia (kg m^2) of each degree of freedom.
    pub mass: Vec<Number>,
    /// The velocity of each degree of freedom.
    pub velocity: Vec<Number>,
    /// How many degrees of freedom belong to one body; 1 on the line.
    pub freedoms: Option<usize>,
    /// The contacts: u = column . v + drive opens if it is positive. On the line: each body and the next, if there are none.
    #[serde(default)]
    pub columns: Vec<Vec<Number>>,
    /// What drives each contact (m/s); nothing if there are none.
    #[serde(default)]
    pub drive: Vec<Number>,
    /// e of each contact, or of all of them if there is one.
    pub restitution: Vec<Number>,
}

/// A ball and what it meets.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Meeting {
    /// Where the centre is relative to the obstacle (m).
    pub position: Vec<Number>,
    /// Its velocity (m/s).
    pub velocity: Vec<Number>,
    /// Its acceleration (m/s^2); none if there is none.
    #[serde(default)]
    pub acceleration: Vec<Number>,
    /// The radius, or the sum of two radii (m).
    pub reach: Number,
    /// The end points of a segment, or the corners of a triangle; a point if there are none.
    #[serde(default)]
    pub obstacle: Vec<Vec<Number>>,
    /// The obstacle is the plane through the origin that is normal to the last axis.
    #[serde(default)]
    pub plane: bool,
}

impl Topic {
    /// Reads a file of the book.
    pub fn read(name: &str, text: &str) -> Result<Self, Misread> {
        let mut topic: Self = toml::from_str(text).map_err(|e| Misread(format!("book/{name}.toml: {e}")))?;
        topic.name = name.to_owned();
        Ok(topic)
    }
}

/// How deep names may stand for names.
const DEEPEST: usize = 32;

/// The names of a case, and behind them the words of what is measured.
pub struct Names<'a> {
    names: &'a BTreeMap<String, Number>,
    measured: Option<&'a dyn Words>,
    depth: usize,
}

impl<'a> Names<'a> {
    /// The case's names alone.
    pub fn of(case: &'a Case) -> Self {
        Self { names: &case.names, measured: None, depth: 0 }
    }

    /// The same, with what is measured.
    pub fn with(&self, measured: &'a dyn Words) -> Self {
        Self { names: self.names, measured: Some(measured), depth: 0 }
    }

    /// The value of a number.
    pub fn value(&self, number: &Number) -> Result<f64, Misread> {
        match number {
            Number::Integer(x) => Ok(*x as f64),
            Number::Real(x) => Ok(*x),
            Number::Formula(text) => self.formula(text),
        }
    }

    /// The value of a formula.
    pub fn formula(&self, text: &str) -> Result<f64, Misread> {
        Formula::read(text)?.value(self).map_err(|e| Misread(format!("{e}, in `{text}`")))
    }

    /// The values of a list.
    pub fn list(&self, numbers: &[Number]) -> Result<Vec<f64>, Misread> {
        numbers.iter().map(|x| self.value(x)).collect()
    }

    /// The value of a number that may be left out.
    pub fn or(&self, number: Option<&Number>, otherwise: f64) -> Result<f64, Misread> {
        number.map_or(Ok(otherwise), |x| self.value(x))
    }

    /// A count.
    pub fn count(&self, number: &Number) -> Result<u64, Misread> {
        let x = self.value(number)?;
        if (0.0..1e15).contains(&x) && x == libm::floor(x) {
            Ok(x as u64)
        } else {
            Err(Misread(format!("{x} is no count")))
        }
    }

    /// A text with `$name` and `$(formula)` replaced by their values, as TOML writes numbers.
    pub fn fill(&self, text: &str) -> Result<String, Misread> {
        let mut filled = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('$') {
            filled.push_str(before);
            let (formula, after) = match after.strip_prefix('(') {
                Some(inner) => {
                    let mut depth = 1;
                    let end = inner.find(|c: char| {
                        depth += i32::from(c == '(') - i32::from(c == ')');
                        depth == 0
                    });
                    let end = end.ok_or_else(|| Misread("a `)` is missing after `$(`".into()))?;
                    (&inner[..end], &inner[end + 1..])
                }
                None => {
                    let end = after.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(after.len());
                    after.split_at(end)
                }
            };
            filled.push_str(&written(self.formula(formula)?));
            rest = after;
        }
        filled.push_str(rest);
        Ok(filled)
    }
}

/// A number as TOML writes it: whole ones without a point, so that they may count something.
fn written(x: f64) -> String {
    if x == libm::floor(x) && x.abs() < 1e15 { format!("{}", x as i64) } else { format!("{x:?}") }
}

impl Words for Names<'_> {
    fn name(&self, name: &str) -> Result<f64, Misread> {
        match self.names.get(name) {
            Some(_) if self.depth >= DEEPEST => Err(Misread(format!("`{name}` stands for itself"))),
            Some(number) => Self { depth: self.depth + 1, ..*self }.value(number),
            None => match self.measured {
                Some(words) => words.name(name),
                None => Err(Misread(format!("nothing is called `{name}`"))),
            },
        }
    }

    fn of(&self, word: &str, what: &str) -> Result<f64, Misread> {
        match self.measured {
            Some(words) => words.of(word, what),
            None => Err(Misread(format!("`{word}[{what}]` is not known before anything has run"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_for_names_and_fill_scenes() {
        let names = BTreeMap::from([
            ("a".to_owned(), Number::Formula("b + 1".into())),
            ("b".to_owned(), Number::Real(0.5)),
            ("n".to_owned(), Number::Integer(3)),
            ("loop".to_owned(), Number::Formula("loop + 1".into())),
        ]);
        let names = Names { names: &names, measured: None, depth: 0 };
        assert_eq!(names.fill("x = [$a, $(-(a + n)*2)]; n = $n").unwrap(), "x = [1.5, -9]; n = 3");
        assert!(names.fill("$loop").unwrap_err().0.contains("stands for itself"));
        assert!(names.fill("$(1").is_err() && names.fill("$c").is_err());
        assert!(names.count(&Number::Real(1.5)).is_err() && names.count(&Number::Integer(-1)).is_err());
    }
}
