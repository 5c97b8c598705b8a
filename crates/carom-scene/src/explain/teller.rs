//! Who tells an impact: the letters with their values, the language, what has been said so far, and the rows of equations.
use super::number::is_rounded;
use super::words::{Phrase, relations};
use super::{Explanation, Formula, Inline, Item, Language, Row, Side, Step, Unit, Value, Values, meaning};

/// Axes by name.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// Tells one impact in one language.
pub(super) struct Teller<'a> {
    pub x: &'a Explanation,
    pub values: Values,
    pub language: Language,
    pub items: Vec<Item>,
    pub steps: Vec<Step>,
}

/// A formula from its source.
pub(super) fn read(source: &str) -> Formula {
    Formula::parse(source).unwrap_or(Formula::Number(f64::NAN))
}

/// One side of an equation.
pub(super) fn side(formula: Formula, unit: Unit, result: bool) -> Side {
    let rounded = formula.any(&|leaf| match leaf {
        Formula::Number(x) => is_rounded(*x),
        Formula::Vector(v) => v.iter().any(|x| is_rounded(*x)),
        _ => false,
    });
    Side { relation: if rounded { "≈" } else { "=" }, formula, unit, result }
}

/// Numbers that are a value already, and need no further side to say so.
fn is_value(formula: &Formula) -> bool {
    match formula {
        Formula::Number(_) | Formula::Vector(_) => true,
        Formula::Negative(a) => matches!(**a, Formula::Number(x) if x >= 0.0),
        _ => false,
    }
}

impl<'a> Teller<'a> {
    pub fn new(x: &'a Explanation, language: Language) -> Self {
        Self { x, values: meaning::letters(x), language, items: Vec::new(), steps: Vec::new() }
    }

    pub fn say(&mut self, phrase: Phrase, places: &[(&str, Inline)]) {
        let prose = phrase.fill(self.language, places);
        self.items.push(Item::Prose(prose));
    }

    pub fn show(&mut self, rows: Vec<Row>) {
        self.items.push(Item::Equations(rows));
    }

    pub fn add(&mut self, item: Item) {
        self.items.push(item);
    }

    /// Closes a step with what was said since the last.
    pub fn close(&mut self, number: Option<u8>, title: Phrase) {
        let items = core::mem::take(&mut self.items);
        self.steps.push(Step { number, title: self.words(title), items });
    }

    pub fn words(&self, phrase: Phrase) -> Vec<Inline> {
        phrase.fill(self.language, &[])
    }

    /// What a letter stands for, for a place in a phrase.
    pub fn quantity(&self, name: &str, unit: Unit) -> Inline {
        let value = self.values.get(name).cloned().unwrap_or(Value::Scalar(f64::NAN));
        Inline::Quantity(value, unit)
    }

    /// Letters only: the sides of `a = b = c`.
    pub fn letters(&self, source: &str) -> Row {
        let sides = relations(source).into_iter().map(|(_, f)| side(f, Unit::One, false)).collect();
        Row { sides, tick: false }
    }

    /// `a = formula = numbers = value`.
    pub fn row(&self, source: &str, unit: Unit) -> Row {
        let parts: Vec<Formula> = relations(source).into_iter().map(|p| p.1).collect();
        let numbers = parts.last().map(|last| self.values.put(last, false));
        self.finish(parts, numbers, unit)
    }

    /// The same, with other letters for the numbers than for the formula.
    pub fn row_by(&self, source: &str, numbers: &str, unit: Unit) -> Row {
        let parts = relations(source).into_iter().map(|p| p.1).collect();
        self.finish(parts, Some(self.values.put(&read(numbers), false)), unit)
    }

    pub fn finish(&self, parts: Vec<Formula>, numbers: Option<Formula>, unit: Unit) -> Row {
        // What the engine says, where the left side is a letter; else what the right side is worth.
        let known = parts.first().and_then(|left| match left {
            Formula::Letter(letter) => self.values.get(&letter.0).cloned(),
            _ => None,
        });
        let value = known.or_else(|| self.values.evaluate(parts.last()?));
        let mut sides: Vec<Side> = parts.into_iter().map(|f| side(f, Unit::One, false)).collect();
        if let Some(numbers) = numbers.filter(|n| !is_value(n)) {
            sides.push(side(numbers, Unit::One, false));
        }
        if let Some(value) = value {
            sides.push(side(value.formula(), unit, true));
        }
        Row { sides, tick: false }
    }

    /// Two accounts that agree: in letters, in numbers, and in value.
    pub fn both(&self, source: &str, unit: Unit) -> Vec<Row> {
        let parts: Vec<Formula> = relations(source).into_iter().map(|p| p.1).collect();
        let row = |formulas: Vec<Formula>, unit: Unit, result: bool| Row {
            sides: formulas.into_iter().map(|f| side(f, unit, result)).collect(),
            tick: result,
        };
        let numbers = parts.iter().map(|f| self.values.put(f, false)).collect();
        let values = parts.iter().filter_map(|f| self.values.evaluate(f)).map(|v| v.formula()).collect();
        vec![row(parts, Unit::One, false), row(numbers, Unit::One, false), row(values, unit, true)]
    }

    /// The letter of a velocity along the line of centres: on a line the velocity itself.
    pub fn v(&self) -> &'static str {
        if self.x.dim == 1 { "v" } else { "vp" }
    }

    /// A formula for this impact: `v_` stands for the velocity along the line of centres, `#b` for the body of finite mass,
    /// `#w` for the wall and `#m` for the reduced mass, which leaves the letter μ to friction where there is any.
    pub fn fitted(&self, source: &str) -> String {
        let wall = self.x.wall().unwrap_or(1);
        let (body, wall) = ((2 - wall).to_string(), (wall + 1).to_string());
        let mass = if self.x.rough.is_some() { "mn" } else { "μ" };
        source.replace("v_", self.v()).replace("#b", &body).replace("#w", &wall).replace("#m", mass)
    }

    /// What the reduced mass is.
    pub fn reduced_mass(&self) -> String {
        self.fitted(if self.x.wall().is_some() { "#m = m#b" } else { "#m = (m1 m2)/(m1 + m2)" })
    }

    /// What to call a body.
    pub fn name(&self, k: usize) -> Vec<Inline> {
        self.words(match (self.x.wall() == Some(k), k) {
            (true, _) => Phrase::Wall,
            (_, 0) => Phrase::Body1,
            _ => Phrase::Body2,
        })
    }

    pub fn axes(&self) -> &'static [&'static str] {
        &AXES[..self.x.dim]
    }
}
