//! The telling of an impact as data: steps of prose, equations and tables, ready to be set in any form.
use super::{Formula, Language, Unit, Value};

/// The lecture's chain for one impact.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The language of the words and of the decimal sign.
    pub language: Language,
    /// 1, 2 or 3.
    pub dim: usize,
    /// What meets, and where.
    pub title: String,
    /// What is given and what comes out, at a glance.
    pub opening: Vec<Item>,
    /// The eleven steps of the lecture, then result, checks and special cases.
    pub steps: Vec<Step>,
}

/// A step of the chain.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The step of the lecture; `None` for what comes after it.
    pub number: Option<u8>,
    /// Its title.
    pub title: Vec<Inline>,
    /// What it says.
    pub items: Vec<Item>,
}

/// A piece of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// A paragraph.
    Prose(Vec<Inline>),
    /// An aside.
    Note(Vec<Inline>),
    /// A list.
    Points(Vec<Vec<Inline>>),
    /// Alternatives, one of which holds.
    Choices(Vec<Choice>),
    /// Equations under one another.
    Equations(Vec<Row>),
    /// A table.
    Table(Table),
    /// Equations between matrices, under one another.
    Matrices(Vec<Matrices>),
    /// Balances: what is weighed, and if it closes.
    Checks(Vec<(bool, Vec<Inline>, Row)>),
}

/// A piece of a paragraph.
#[derive(Clone, Debug, PartialEq)]
pub enum Inline {
    /// Words.
    Words(String),
    /// A formula, or several with a relation before each but the first.
    Formula(Vec<(String, Formula)>),
    /// A number or vector with its unit.
    Quantity(Value, Unit),
}

/// One equation: sides, each but the first with its relation.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The sides: usually the letters, the numbers put in, and the value.
    pub sides: Vec<Side>,
    /// True if the row says that two accounts agree, and they do.
    pub tick: bool,
}

/// One side of an equation.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    /// "=" or, where a number is shown rounded, "≈"; before the first side it is not shown.
    pub relation: &'static str,
    /// The side.
    pub formula: Formula,
    /// Its unit, shown behind it.
    pub unit: Unit,
    /// True for the value that comes out.
    pub result: bool,
}

/// One of several alternatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// True for the one that holds here.
    pub holds: bool,
    /// When.
    pub when: Vec<Inline>,
    /// Then what.
    pub then: Vec<Inline>,
}

/// A table; the first column names the rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The heads of all columns.
    pub head: Vec<Vec<Inline>>,
    /// The cells, row by row.
    pub rows: Vec<Vec<Vec<Inline>>>,
}

impl Table {
    /// True if the cells of a column begin with words, which stand to the left; numbers stand to the right.
    pub(crate) fn is_left(&self, column: usize) -> bool {
        let words = |cell: &Vec<Inline>| cell.first().is_none_or(|i| matches!(i, Inline::Words(_)));
        column == 0 || self.rows.iter().all(|r| r.get(column).is_some_and(words))
    }
}

/// Matrices in a row, with signs between.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices(pub Vec<Piece>);

/// A piece of a row of matrices.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// A matrix, row by row.
    Matrix(Vec<Vec<Formula>>),
    /// A relation between two of them.
    Sign(&'static str),
}
