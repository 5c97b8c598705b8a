//! One tree of values for both formats, each value with its place in the text.
use crate::problem::{Place, Problem};

/// A text that values come from: the scene file, or an argument such as `--set body.A.mass=2`.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub name: String,
    pub text: String,
}

/// A piece of a source, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Span {
    pub source: usize,
    pub start: usize,
    pub end: usize,
}

impl Span {
    /// The place of this span, for a problem.
    pub fn place(self, sources: &[Source]) -> Option<Place> {
        sources.get(self.source).map(|s| Place::new(&s.name, &s.text, self.start, self.end))
    }

    /// `problem`, found here.
    pub fn tell(self, sources: &[Source], problem: Problem) -> Problem {
        match self.place(sources) {
            Some(place) => problem.at(place),
            None => problem,
        }
    }
}

/// A value with its place.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub value: Value,
    pub span: Span,
}

/// What a value is.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Null,
    Flag(bool),
    /// Written without fraction and exponent. Every `i64` and every `u64` fits.
    Integer(i128),
    Number(f64),
    Text(String),
    List(Vec<Node>),
    Table(Vec<Entry>),
    /// A date or a time: TOML has them, a scene does not.
    #[cfg_attr(not(feature = "toml"), allow(dead_code))]
    Date,
}

/// One line of a table. No key comes twice: both readers refuse that.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub key: String,
    pub key_span: Span,
    pub node: Node,
}

impl Node {
    /// The value of a key, if this is a table that has it.
    pub fn get(&self, key: &str) -> Option<&Node> {
        match &self.value {
            Value::Table(entries) => entries.iter().find(|e| e.key == key).map(|e| &e.node),
            _ => None,
        }
    }

    /// What to call it in a message.
    pub fn kind(&self) -> &'static str {
        match self.value {
            Value::Null => "null",
            Value::Flag(_) => "true or false",
            Value::Integer(_) => "an integer",
            Value::Number(_) => "a number",
            Value::Text(_) => "text",
            Value::List(_) => "a list",
            Value::Table(_) => "a table",
            Value::Date => "a date",
        }
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self.value {
            Value::Integer(k) => Some(k as f64),
            Value::Number(x) => Some(x),
            _ => None,
        }
    }

    /// The integer, if it is one; `1e4` and `10.0` are, as they are in JSON, where one type holds all numbers.
    pub fn integer(&self) -> Option<i128> {
        /// Above 2^53 not every integer is a number, and the one that was meant is not known.
        const EXACT: f64 = 9_007_199_254_740_992.0;
        match self.value {
            Value::Integer(k) => Some(k),
            Value::Number(x) if x == x.trunc() && x.abs() <= EXACT => Some(x as i128),
            _ => None,
        }
    }

    /// The text, if it is one.
    pub fn text(&self) -> Option<&str> {
        match &self.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The value without its places.
    pub fn data(&self) -> Data {
        match &self.value {
            // A scene has no place for either: the reader has refused them before anyone asks.
            Value::Null | Value::Date => Data::Text(String::new()),
            Value::Flag(flag) => Data::Flag(*flag),
            Value::Integer(k) => Data::Integer(*k),
            Value::Number(x) => Data::Number(*x),
            Value::Text(text) => Data::Text(text.clone()),
            Value::List(nodes) => Data::List(nodes.iter().map(Node::data).collect()),
            Value::Table(entries) => Data::Table(entries.iter().map(|e| (e.key.clone(), e.node.data())).collect()),
        }
    }
}

/// A value on its own: of a sweep, or on its way out.
#[derive(Clone, Debug, PartialEq)]
pub enum Data {
    /// true or false
    Flag(bool),
    /// An integer
    Integer(i128),
    /// A number
    Number(f64),
    /// Text
    Text(String),
    /// A list
    List(Vec<Data>),
    /// A table, in order
    Table(Vec<(String, Data)>),
}

impl Data {
    /// The value as a node, all of it at one place.
    pub(crate) fn node(&self, span: Span) -> Node {
        let value = match self {
            Self::Flag(flag) => Value::Flag(*flag),
            Self::Integer(k) => Value::Integer(*k),
            Self::Number(x) => Value::Number(*x),
            Self::Text(text) => Value::Text(text.clone()),
            Self::List(items) => Value::List(items.iter().map(|d| d.node(span)).collect()),
            Self::Table(entries) => Value::Table(
                entries.iter().map(|(key, d)| Entry { key: key.clone(), key_span: span, node: d.node(span) }).collect(),
            ),
        };
        Node { value, span }
    }
}

impl From<&[f64]> for Data {
    fn from(numbers: &[f64]) -> Self {
        Self::List(numbers.iter().map(|&x| Self::Number(x)).collect())
    }
}

impl From<&str> for Data {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}
