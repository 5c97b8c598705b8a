//! Reading one table by its shape: every value is checked by the rule of its key, every problem is noted with its place, and
//! reading goes on, so that a file's problems are told together.
use std::cell::{Cell, RefCell};

use carom::Coefficient;

use crate::keys::{Key, Kind, Rule, Shape};
use crate::nearest::{meant, nearest, suggestion};
use crate::node::{Entry, Node, Source, Span, Value};
use crate::problem::{Problem, Severity};

/// What reading has found so far.
pub(crate) struct Reader<'d> {
    pub sources: &'d [Source],
    /// The dimension, once it is known.
    pub dim: Cell<Option<usize>>,
    pub problems: RefCell<Vec<Problem>>,
}

/// No file has that many things worth saying, and each costs a search for its line.
const MOST_KEPT: usize = 200;

impl Reader<'_> {
    pub fn tell(&self, span: Span, problem: Problem) {
        let mut problems = self.problems.borrow_mut();
        if problems.len() < MOST_KEPT {
            problems.push(span.tell(self.sources, problem));
        }
    }
}

/// The axis of a name.
pub(crate) const AXES: [&str; 3] = ["x", "y", "z"];

/// A table that is being read.
pub(crate) struct Fields<'d> {
    pub reader: &'d Reader<'d>,
    shape: &'static Shape,
    entries: &'d [Entry],
    pub span: Span,
    /// The dotted path of this table.
    pub path: String,
}

impl<'d> Fields<'d> {
    /// The fields of a node, which has to be a table: tells unknown keys and required keys that are missing.
    pub fn new(reader: &'d Reader<'d>, node: &'d Node, shape: &'static Shape, path: String) -> Option<Self> {
        let Value::Table(entries) = &node.value else {
            let example = shape.keys.first().map_or("", |k| k.name);
            reader.tell(
                node.span,
                Problem::new(path.clone(), format!("{} must be a table, got {}", last(&path), node.kind()))
                    .help(format!("a table, as in {{ {example} = ... }}")),
            );
            return None;
        };
        let fields = Self { reader, shape, entries, span: node.span, path };
        let mut mistyped = Vec::new();
        for entry in entries {
            if shape.key(&entry.key).is_none() {
                let names: Vec<_> = shape.names().collect();
                mistyped.extend(nearest(&entry.key, names.iter().copied()).filter(|n| n.1).map(|n| n.0));
                let message = format!("unknown key `{}`{}", entry.key, suggestion(&entry.key, names.iter().copied()));
                reader.tell(
                    entry.key_span,
                    Problem::new(fields.join(&entry.key), message).help(format!(
                        "{} has the keys {}",
                        shape.name,
                        names.join(", ")
                    )),
                );
            }
        }
        // A key that is there with a typing error is told once.
        let missing = |k: &&Key| k.required && !mistyped.contains(&k.name) && !entries.iter().any(|e| e.key == k.name);
        for key in shape.keys.iter().filter(missing) {
            let problem =
                Problem::new(fields.join(key.name), format!("`{}` is missing: {} needs it", key.name, shape.name));
            fields.tell(problem.help(key.about));
        }
        Some(fields)
    }

    /// The dotted path of a key of this table.
    pub fn join(&self, key: &str) -> String {
        let quoted = crate::path::quote(key);
        if self.path.is_empty() { quoted.into_owned() } else { format!("{}.{quoted}", self.path) }
    }

    /// Notes a problem with the table itself.
    pub fn tell(&self, problem: Problem) {
        self.reader.tell(self.span, problem);
    }

    /// Notes a problem with a key: at its value, or at the table if it is not there.
    pub fn tell_key(&self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        let span = self.get(key).map_or(self.span, |n| n.span);
        self.reader.tell(span, Problem::new(self.join(key), message).help(help));
    }

    /// Notes that a key has no effect here.
    pub fn note_key(&self, key: &str, message: impl Into<String>) {
        if let Some(entry) = self.entries.iter().find(|e| e.key == key) {
            let mut problem = Problem::new(self.join(key), message);
            problem.severity = Severity::Note;
            self.reader.tell(entry.key_span, problem);
        }
    }

    pub fn get(&self, key: &str) -> Option<&'d Node> {
        self.entries.iter().find(|e| e.key == key).map(|e| &e.node)
    }

    pub fn has(&self, key: &str) -> bool {
        self.get(key).is_some()
    }

    /// The node of a key and what the table of keys says of it.
    fn known(&self, key: &str) -> Option<(&'d Node, &'static Key)> {
        let known = self.shape.key(key);
        debug_assert!(known.is_some(), "`{key}` is not in the keys of {}", self.shape.name);
        Some((self.get(key)?, known?))
    }

    fn wrong(&self, node: &Node, key: &str, message: String, help: &str) {
        self.reader.tell(node.span, Problem::new(self.join(key), message).help(help));
    }

    pub fn number(&self, key: &str) -> Option<f64> {
        let (node, known) = self.known(key)?;
        let Kind::Number(rule) = known.kind else { return None };
        self.checked(node, &self.join(key), key, rule, known.about)
    }

    /// A number that keeps a rule.
    fn checked(&self, node: &Node, path: &str, name: &str, rule: Rule, about: &str) -> Option<f64> {
        let tell = |message: String, help: &str| {
            self.reader.tell(node.span, Problem::new(path, message).help(help));
            None
        };
        let Some(x) = node.number() else {
            return tell(format!("{name} must be a number, got {}", node.kind()), about);
        };
        if !x.is_finite() {
            let help = match name {
                "mass" => "for a body that nothing moves, leave mass out and write fixed = true",
                _ => about,
            };
            return tell(format!("{name} must be finite, got {x}"), help);
        }
        match rule {
            Rule::Positive if !(x > 0.0) => tell(format!("{name} must be positive, got {x}"), about),
            Rule::NotNegative if !(x >= 0.0) => tell(format!("{name} must not be negative, got {x}"), about),
            Rule::Within(low, high) if !(x >= low && x <= high) => {
                tell(format!("{name} must lie in [{low}, {high}], got {x}"), about)
            }
            _ => Some(x),
        }
    }

    pub fn integer(&self, key: &str) -> Option<u64> {
        let (node, known) = self.known(key)?;
        let Kind::Integer { least, most } = known.kind else { return None };
        let Some(k) = node.integer() else {
            let message = match node.number() {
                Some(x) if !x.is_finite() => format!("{key} must be finite, got {x}"),
                Some(x) => format!("{key} must be an integer, got {x}"),
                None => format!("{key} must be an integer, got {}", node.kind()),
            };
            self.wrong(node, key, message, known.about);
            return None;
        };
        if k < i128::from(least) || k > i128::from(most) {
            let message = if k < 0 && least == 0 {
                format!("{key} must not be negative, got {k}")
            } else if k <= 0 && least == 1 && most > 3 {
                format!("{key} must be positive, got {k}")
            } else if least == most {
                format!("{key} must be {least}, got {k}")
            } else {
                format!("{key} must lie in [{least}, {most}], got {k}")
            };
            self.wrong(node, key, message, known.about);
            return None;
        }
        u64::try_from(k).ok()
    }

    pub fn text(&self, key: &str) -> Option<&'d str> {
        let (node, known) = self.known(key)?;
        let text = node.text();
        if text.is_none() {
            self.wrong(node, key, format!("{key} must be text, got {}", node.kind()), known.about);
        }
        text
    }

    /// A name: text with something in it.
    pub fn name(&self, key: &str) -> Option<&'d str> {
        let text = self.text(key)?;
        if text.trim().is_empty() || text.chars().any(char::is_control) {
            self.tell_key(key, format!("{key} must be a word that can be read, got {text:?}"), "as in name = \"A\"");
            return None;
        }
        Some(text)
    }

    pub fn flag(&self, key: &str) -> Option<bool> {
        let (node, known) = self.known(key)?;
        if let Value::Flag(flag) = node.value {
            return Some(flag);
        }
        self.wrong(node, key, format!("{key} must be true or false, got {}", node.kind()), known.about);
        None
    }

    pub fn choice(&self, key: &str) -> Option<&'d str> {
        let known = self.known(key)?.1;
        let Kind::Choice(names) = known.kind else { return None };
        let text = self.text(key)?;
        if names.contains(&text) {
            return Some(text);
        }
        let help = format!("one of {}", names.iter().map(|n| format!("{n:?}")).collect::<Vec<_>>().join(", "));
        self.tell_key(key, format!("unknown {key} `{text}`{}", meant(text, names.iter().copied())), help);
        None
    }

    /// The numbers of a list of the length that `expects` names.
    fn numbers(&self, node: &Node, key: &str, length: Option<usize>, expects: &str, about: &str) -> Option<Vec<f64>> {
        let Value::List(items) = &node.value else {
            self.wrong(node, key, format!("{key} {expects}, got {}", node.kind()), about);
            return None;
        };
        if length.is_some_and(|n| n != items.len()) || items.len() > 3 {
            self.wrong(node, key, format!("{key} {expects}, got {}", items.len()), about);
            return None;
        }
        let path = self.join(key);
        let numbers: Vec<_> = items
            .iter()
            .enumerate()
            .map(|(k, item)| self.checked(item, &format!("{path}[{}]", k + 1), key, Rule::Finite, about))
            .collect();
        numbers.into_iter().collect()
    }

    /// dim numbers.
    pub fn vector(&self, key: &str) -> Option<Vec<f64>> {
        let (node, known) = self.known(key)?;
        let dim = self.reader.dim.get();
        let expects = match dim {
            Some(1) => "expects dim = 1 number in a list".to_owned(),
            Some(dim) => format!("expects dim = {dim} numbers in a list"),
            None => "expects dim numbers in a list".to_owned(),
        };
        // The contract's words where the length is wrong; the list is named only where there is none.
        let expects = if matches!(node.value, Value::List(_)) {
            match dim {
                Some(dim) => format!("expects dim = {dim} numbers"),
                None => "expects dim numbers".to_owned(),
            }
        } else {
            expects
        };
        self.numbers(node, key, dim, &expects, known.about)
    }

    pub fn spin(&self, key: &str) -> Option<Vec<f64>> {
        let (node, known) = self.known(key)?;
        let length = self.reader.dim.get().map(spin_length);
        let expects = match self.reader.dim.get() {
            Some(1) => "expects no numbers, as dim = 1: []",
            Some(2) => "expects 1 number, as dim = 2: [w]",
            Some(3) => "expects 3 numbers, as dim = 3: [x, y, z]",
            _ => "expects 0, 1 or 3 numbers",
        };
        self.numbers(node, key, length, expects, known.about)
    }

    /// Names of axes, as their numbers, in order.
    pub fn axes(&self, key: &str) -> Option<Vec<usize>> {
        let (node, known) = self.known(key)?;
        let Value::List(items) = &node.value else {
            self.wrong(node, key, format!("{key} must be a list of axes, got {}", node.kind()), known.about);
            return None;
        };
        let dim = self.reader.dim.get().unwrap_or(3);
        let mut axes = Vec::new();
        let mut fine = true;
        for item in items {
            let axis = item.text().and_then(|name| AXES[..dim].iter().position(|a| *a == name));
            match axis {
                Some(axis) if axes.contains(&axis) => {
                    self.wrong(item, key, format!("the axis {} comes twice", AXES[axis]), known.about);
                    fine = false;
                }
                Some(axis) => axes.push(axis),
                None => {
                    let got = item.text().map_or_else(|| item.kind().to_owned(), |t| format!("`{t}`"));
                    let known = AXES[..dim].iter().map(|a| format!("{a:?}")).collect::<Vec<_>>().join(", ");
                    self.wrong(
                        item,
                        key,
                        format!("unknown axis {got}"),
                        &format!("with dim = {dim} the axes are {known}"),
                    );
                    fine = false;
                }
            }
        }
        axes.sort_unstable();
        fine.then_some(axes)
    }

    /// Two names.
    pub fn two_names(&self, key: &str) -> Option<[String; 2]> {
        let (node, known) = self.known(key)?;
        if let Value::List(items) = &node.value
            && let [a, b] = &items[..]
            && let (Some(a), Some(b)) = (a.text(), b.text())
        {
            return Some([a.to_owned(), b.to_owned()]);
        }
        self.wrong(node, key, format!("{key} expects the names of two materials"), known.about);
        None
    }

    /// A number, or a curve over speed.
    pub fn coefficient(&self, key: &str) -> Option<Coefficient> {
        let (node, known) = self.known(key)?;
        let Kind::Coefficient(rule) = known.kind else { return None };
        if !matches!(node.value, Value::Table(_)) {
            let path = self.join(key);
            return self.checked(node, &path, key, rule, known.about).map(Coefficient::Constant);
        }
        let help = "a curve is { curve = [[speed, value], ...] } with rising speeds (m/s)";
        let Value::Table(entries) = &node.value else { return None };
        for entry in entries.iter().filter(|e| e.key != "curve") {
            let message = format!("unknown key `{}`; did you mean `curve`?", entry.key);
            self.reader
                .tell(entry.key_span, Problem::new(format!("{}.{}", self.join(key), entry.key), message).help(help));
        }
        let Some(curve) = node.get("curve") else {
            self.wrong(node, key, format!("{key} must be a number or a curve"), help);
            return None;
        };
        let Value::List(points) = &curve.value else {
            self.wrong(curve, key, format!("the curve of {key} must be a list of points, got {}", curve.kind()), help);
            return None;
        };
        if points.is_empty() {
            self.wrong(curve, key, format!("the curve of {key} needs at least one point"), help);
            return None;
        }
        let path = format!("{}.curve", self.join(key));
        let mut read: Vec<(f64, f64)> = Vec::new();
        let mut fine = true;
        for (k, point) in points.iter().enumerate() {
            let path = format!("{path}[{}]", k + 1);
            let pair = match &point.value {
                Value::List(pair) if pair.len() == 2 => pair,
                _ => {
                    self.wrong(
                        point,
                        key,
                        format!("a point of the curve of {key} expects 2 numbers: [speed, value]"),
                        help,
                    );
                    fine = false;
                    continue;
                }
            };
            let speed = self.checked(&pair[0], &path, "speed", Rule::NotNegative, help);
            let value = self.checked(&pair[1], &path, key, rule, known.about);
            let (Some(speed), Some(value)) = (speed, value) else {
                fine = false;
                continue;
            };
            if let Some(&(before, _)) = read.last()
                && !(speed > before)
            {
                let message = format!("the speeds of the curve of {key} must rise, got {speed} after {before}");
                self.reader.tell(pair[0].span, Problem::new(path, message).help(help));
                fine = false;
            }
            read.push((speed, value));
        }
        fine.then_some(Coefficient::Curve(read))
    }

    pub fn table(&self, key: &str) -> Option<Fields<'d>> {
        let (node, known) = self.known(key)?;
        let Kind::Table(shape) = known.kind else { return None };
        Fields::new(self.reader, node, shape, self.join(key))
    }

    /// The tables of `[[key]]`, each with its number from 1.
    pub fn list(&self, key: &str) -> Vec<(usize, Fields<'d>)> {
        let Some((node, known)) = self.known(key) else { return Vec::new() };
        let Kind::List(shape) = known.kind else { return Vec::new() };
        let Value::List(items) = &node.value else {
            self.wrong(
                node,
                key,
                format!("{key} must be a list of tables, got {}", node.kind()),
                &format!("write [[{key}]] above each of them (in JSON: \"{key}\": [{{ ... }}, ...])"),
            );
            return Vec::new();
        };
        let fields =
            |(k, item)| Some((k + 1, Fields::new(self.reader, item, shape, format!("{}[{}]", self.join(key), k + 1))?));
        items.iter().enumerate().filter_map(fields).collect()
    }

    /// The tables of `[key.name]`, each with its name.
    pub fn named(&self, key: &str) -> Vec<(&'d str, Fields<'d>)> {
        let Some((node, known)) = self.known(key) else { return Vec::new() };
        let Kind::Named(shape) = known.kind else { return Vec::new() };
        let Value::Table(entries) = &node.value else {
            self.wrong(
                node,
                key,
                format!("{key} must be a table of tables, got {}", node.kind()),
                &format!("write [{key}.default] above the default's coefficients"),
            );
            return Vec::new();
        };
        let fields = |e: &'d Entry| {
            let path = format!("{}.{}", self.join(key), crate::path::quote(&e.key));
            Some((e.key.as_str(), Fields::new(self.reader, &e.node, shape, path)?))
        };
        entries.iter().filter_map(fields).collect()
    }
}

/// How many numbers a spin has.
pub(crate) fn spin_length(dim: usize) -> usize {
    match dim {
        1 => 0,
        2 => 1,
        _ => 3,
    }
}

/// The last part of a dotted path.
fn last(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}
