//! How a formula is written down: in plain characters, or in LaTeX.
use super::number::Notation;
use super::page::Symbols;
use super::{Formula, Inline, Language, Unit};

/// Writes formulas, numbers and phrases in one notation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pen {
    pub notation: Notation,
    /// Vectors are bold in LaTeX (more than one dimension).
    pub bold: bool,
    /// For a page: letters carry their names, and are those of the course.
    pub symbols: Option<Symbols>,
}

impl Pen {
    pub fn new(language: Language, latex: bool, dim: usize) -> Self {
        Self { notation: Notation { comma: language.decimal_comma(), latex }, bold: dim > 1, symbols: None }
    }

    /// A formula on its own, or as the first thing in a side or a pair of parentheses.
    pub fn formula(&self, formula: &Formula) -> String {
        self.write(formula, true)
    }

    /// A formula with its unit.
    pub fn with_unit(&self, formula: &Formula, unit: Unit) -> String {
        let formula = self.formula(formula);
        match (unit, self.notation.latex) {
            (Unit::One, _) => formula,
            (_, true) => formula + &unit.latex(),
            (Unit::Degree, _) => formula + unit.symbol(),
            (_, false) => format!("{formula} {}", unit.symbol()),
        }
    }

    /// A sign such as = or ≈.
    pub fn relation(&self, relation: &str) -> String {
        match (relation, self.notation.latex) {
            ("≈", true) => "\\approx".into(),
            ("≤", true) => "\\le".into(),
            _ => relation.into(),
        }
    }

    /// Formulas with relations between them.
    pub fn relations(&self, parts: &[(String, Formula)]) -> String {
        let mut text = String::new();
        for (k, (relation, formula)) in parts.iter().enumerate() {
            if k > 0 {
                text += &format!(" {} ", self.relation(relation));
            }
            text += &self.formula(formula);
        }
        text
    }

    /// A paragraph's pieces; formulas and quantities between `open` and `close`.
    pub fn prose(&self, inlines: &[Inline], words: impl Fn(&str) -> String, math: impl Fn(&str) -> String) -> String {
        let piece = |inline: &Inline| match inline {
            Inline::Words(w) => words(w),
            Inline::Formula(parts) => math(&self.relations(parts)),
            Inline::Quantity(value, unit) => math(&self.with_unit(&value.formula(), *unit)),
        };
        inlines.iter().map(piece).collect()
    }

    /// `leading`: nothing stands before it, so that a minus sign needs no parentheses.
    fn write(&self, formula: &Formula, leading: bool) -> String {
        let latex = self.notation.latex;
        match formula {
            Formula::Letter(letter) if latex => match self.symbols {
                Some(symbols) => symbols.latex(letter, self.bold),
                None => letter.latex(self.bold),
            },
            Formula::Letter(letter) => letter.text(),
            Formula::Number(x) => {
                let number = self.notation.number(*x);
                if *x < 0.0 && !leading { format!("({number})") } else { number }
            }
            Formula::Vector(v) => {
                let numbers: Vec<String> = v.iter().map(|x| self.notation.number(*x)).collect();
                format!("({})", numbers.join(self.notation.separator()))
            }
            Formula::Negative(a) if begins_with_zero(a) => self.write(a, leading),
            Formula::Negative(a) => format!("{}{}", self.notation.minus(), self.write(a, false)),
            Formula::Sum(terms) => {
                let mut text = String::new();
                for (k, (plus, term)) in terms.iter().enumerate() {
                    if k > 0 {
                        text += &format!(" {} ", if *plus { "+" } else { self.notation.minus() });
                    }
                    text += &self.write(term, k == 0 && leading);
                }
                text
            }
            Formula::Product(factors) => {
                let mut text = String::new();
                for (k, factor) in factors.iter().enumerate() {
                    if k > 0 {
                        let dot = starts_with_number(factor) || (is_numeric(&factors[k - 1]) && is_numeric(factor));
                        text += match (dot, latex) {
                            (true, true) => " \\cdot ",
                            (true, false) => " · ",
                            (false, _) => " ",
                        };
                    }
                    text += &self.write(factor, k == 0 && leading);
                }
                text
            }
            Formula::Dot(a, b) => {
                let dot = if latex {
                    " \\cdot "
                } else if is_numeric(formula) {
                    " · "
                } else {
                    "·"
                };
                format!("{}{dot}{}", self.write(a, leading), self.write(b, false))
            }
            Formula::Cross(a, b) => {
                let cross = if latex { " \\times " } else { " × " };
                format!("{}{cross}{}", self.write(a, leading), self.write(b, false))
            }
            Formula::Over(a, b) if latex => format!("\\frac{{{}}}{{{}}}", self.bare(a), self.bare(b)),
            Formula::Over(a, b) => format!("{}/{}", self.tight(a, leading), self.tight(b, false)),
            Formula::Square(a) => format!("{}{}", self.tight(a, false), if latex { "^2" } else { "²" }),
            Formula::Length(a) if latex => format!("\\lvert {} \\rvert", self.formula(a)),
            Formula::Length(a) => format!("|{}|", self.formula(a)),
            Formula::Group(a) => format!("({})", self.formula(a)),
            Formula::Call(name, arguments) => {
                let arguments: Vec<String> = arguments.iter().map(|a| self.formula(a)).collect();
                let name = if latex { format!("\\operatorname{{{name}}}") } else { name.clone() };
                format!("{name}({})", arguments.join(self.notation.separator()))
            }
        }
    }

    /// Without the parentheses that a fraction bar makes needless.
    fn bare(&self, formula: &Formula) -> String {
        match formula {
            Formula::Group(a) => self.formula(a),
            other => self.formula(other),
        }
    }

    /// As an operand of / or ², where 10⁻⁷ needs parentheses.
    fn tight(&self, formula: &Formula, leading: bool) -> String {
        let text = self.write(formula, leading);
        let power = matches!(formula, Formula::Number(_))
            && !text.starts_with('(')
            && text.contains("10^") | text.contains("×10");
        if power { format!("({text})") } else { text }
    }
}

fn is_letter(formula: &Formula) -> bool {
    matches!(formula, Formula::Letter(letter) if letter.0 != "½")
}

fn is_numeric(formula: &Formula) -> bool {
    !formula.any(&is_letter)
}

/// A minus sign in front of a zero says nothing.
fn begins_with_zero(formula: &Formula) -> bool {
    match formula {
        Formula::Number(x) => *x == 0.0,
        Formula::Product(factors) => factors.first().is_some_and(begins_with_zero),
        _ => false,
    }
}

fn starts_with_number(formula: &Formula) -> bool {
    match formula {
        Formula::Number(_) | Formula::Vector(_) => true,
        Formula::Product(factors) => factors.first().is_some_and(starts_with_number),
        Formula::Over(a, _) | Formula::Dot(a, _) | Formula::Cross(a, _) | Formula::Square(a) => starts_with_number(a),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::Values;
    use super::*;

    #[test]
    fn formulas_in_letters_and_numbers() {
        let mut values = Values::default();
        for (name, x) in [("m1", 2.0), ("m2", 1.0), ("v1", 3.0), ("v2", -1.0), ("v1'", 1.0), ("v2'", 3.0), ("e", 0.5)] {
            values.set(name, x);
        }
        values.set("r", [6.0, -2.0].as_slice());
        let (text, latex) = (Pen::new(Language::English, false, 1), Pen::new(Language::Portuguese, true, 1));
        for (source, letters, numbers, source_in_latex, numbers_in_latex) in [
            ("m1 v1 + m2 v2", "m₁ v₁ + m₂ v₂", "2 · 3 + 1 · (−1)", "m_1 v_1 + m_2 v_2", "2 \\cdot 3 + 1 \\cdot (-1)"),
            ("-(v1' - v2')", "−(v₁′ − v₂′)", "−(1 − 3)", "-(v_1' - v_2')", "-(1 - 3)"),
            ("e (v1 - v2)", "e (v₁ − v₂)", "0.5 · (3 − (−1))", "e (v_1 - v_2)", "0{,}5 \\cdot (3 - (-1))"),
            ("v2 + v1", "v₂ + v₁", "−1 + 3", "v_2 + v_1", "-1 + 3"),
            (
                "(1 + e) m2/(m1 + m2) v2",
                "(1 + e) m₂/(m₁ + m₂) v₂",
                "(1 + 0.5) · 1/(2 + 1) · (−1)",
                "(1 + e) \\frac{m_2}{m_1 + m_2} v_2",
                "(1 + 0{,}5) \\cdot \\frac{1}{2 + 1} \\cdot (-1)",
            ),
            (
                "½ m1 v2^2",
                "½ m₁ v₂²",
                "½ · 2 · (−1)²",
                "\\tfrac{1}{2} m_1 v_2^2",
                "\\tfrac{1}{2} \\cdot 2 \\cdot (-1)^2",
            ),
            ("r·r", "r·r", "(6, −2) · (6, −2)", "r \\cdot r", "(6;\\; -2) \\cdot (6;\\; -2)"),
        ] {
            let formula = Formula::parse(source).unwrap();
            let put = values.put(&formula, false);
            assert_eq!((text.formula(&formula).as_str(), text.formula(&put).as_str()), (letters, numbers));
            assert_eq!(
                (latex.formula(&formula).as_str(), latex.formula(&put).as_str()),
                (source_in_latex, numbers_in_latex)
            );
        }
        let known = values.put(&Formula::parse("m1 v1' + m2 v2'").unwrap(), true);
        assert_eq!(text.formula(&known), "2 v₁′ + 1 v₂′");
    }
}
