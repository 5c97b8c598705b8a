//! The chain for a page: words and LaTeX as JSON, every letter carrying its name so that the page can point from it to an arrow
//! or a cell and back, and every side saying whether it shows letters, numbers or the value.
use super::pen::Pen;
use super::{Chain, Explanation, Formula, Inline, Item, Language, Letter, Piece, Row, Side, Value, Values};
use super::{brief, meaning};
use serde::Serialize;

/// Which letters a course uses. The default is the lecture's: p, J with the vector F̂, e.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Symbols {
    /// Q for momentum (quantidade de movimento) instead of p.
    pub momentum_q: bool,
    /// The impulse: F̂ with the magnitude J, or J throughout, or I throughout.
    pub impulse: ImpulseLetter,
    /// ε for the coefficient of restitution instead of e.
    pub epsilon: bool,
}

/// The letter of the impulse.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ImpulseLetter {
    /// The lecture's F̂, with the magnitude J.
    #[default]
    Hat,
    /// J.
    J,
    /// I.
    I,
}

impl Symbols {
    /// Reads a list of letters: `Q`, `J` or `I`, `ε`; anything else is left as it is.
    pub fn named(letters: &str) -> Self {
        let mut symbols = Self::default();
        for letter in letters.split(',').map(str::trim) {
            match letter {
                "Q" => symbols.momentum_q = true,
                "J" => symbols.impulse = ImpulseLetter::J,
                "I" => symbols.impulse = ImpulseLetter::I,
                "ε" => symbols.epsilon = true,
                _ => {}
            }
        }
        symbols
    }

    /// A letter in LaTeX, with its name for the page around it.
    pub(crate) fn latex(self, letter: &Letter, bold: bool) -> String {
        let latex = self.switched(letter, bold);
        let name: String = letter.0.replace('\'', "-after");
        let plain = name.chars().all(|c| c.is_alphanumeric() || c == '-');
        // Fixed signs such as ½ or dp/dt stand for no quantity of their own.
        if !plain || matches!(letter.0.as_str(), "½" | "∞" | "constant") {
            return latex;
        }
        format!("\\htmlData{{q={name}}}{{{latex}}}")
    }

    fn switched(self, letter: &Letter, bold: bool) -> String {
        let latex = letter.latex(bold);
        let name = letter.0.as_str();
        let base = name.trim_start_matches('Δ');
        if name == "Q" && self.momentum_q {
            // The Portuguese Q is momentum; what is lost is dissipated.
            return "E_d".into();
        }
        if self.epsilon && name == "e" {
            return "\\varepsilon".into();
        }
        let momentum = base.starts_with('p') || base.starts_with('P') || name == "dp/dt" || name == "dP/dt";
        if self.momentum_q && momentum {
            let from = if latex.contains("{P}") || latex.starts_with('P') { "P" } else { "p" };
            return latex.replacen(from, "Q", 1);
        }
        let new = match self.impulse {
            ImpulseLetter::Hat => return latex,
            ImpulseLetter::J => "J",
            ImpulseLetter::I => "I",
        };
        if base.starts_with("Fh") {
            return latex.replacen("\\hat{\\mathbf{F}}", &format!("\\mathbf{{{new}}}"), 1).replacen("\\hat{F}", new, 1);
        }
        if base.starts_with('J') {
            return latex.replacen('J', new, 1);
        }
        latex
    }
}

#[derive(Serialize)]
#[serde(untagged)]
enum Bit {
    Words { w: String },
    Math { m: String },
}

#[derive(Serialize)]
struct PageSide {
    rel: String,
    tex: String,
    /// "letters", "numbers" or "value".
    kind: &'static str,
}

#[derive(Serialize)]
struct PageRow {
    sides: Vec<PageSide>,
    tick: bool,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum PageItem {
    Prose { text: Vec<Bit> },
    Note { text: Vec<Bit> },
    Points { points: Vec<Vec<Bit>> },
    Choices { choices: Vec<PageChoice> },
    Rows { rows: Vec<PageRow> },
    Table { head: Vec<Vec<Bit>>, rows: Vec<Vec<Vec<Bit>>>, left: Vec<bool> },
    Matrices { matrices: Vec<String> },
    Checks { checks: Vec<PageCheck> },
}

#[derive(Serialize)]
struct PageChoice {
    holds: bool,
    when: Vec<Bit>,
    then: Vec<Bit>,
}

#[derive(Serialize)]
struct PageCheck {
    holds: bool,
    name: Vec<Bit>,
    row: PageRow,
}

#[derive(Serialize)]
struct PageStep {
    number: Option<u8>,
    title: Vec<Bit>,
    items: Vec<PageItem>,
}

#[derive(Serialize)]
struct Page<'a> {
    language: &'static str,
    title: &'a str,
    brief: Vec<PageRow>,
    opening: Vec<PageItem>,
    steps: Vec<PageStep>,
    special: Vec<String>,
}

/// What each letter stands for, as a JSON array of names and numbers, with every digit. Written here rather than by the library, whose way
/// with numbers would be a tenth of the page's module.
fn values(all: &Values) -> String {
    let number = |x: &f64| if x.is_finite() { format!("{x:?}") } else { "null".into() };
    let one = |(name, value): (&str, &Value)| {
        let numbers: Vec<String> = value.numbers().iter().map(number).collect();
        format!("[\"{}\",[{}]]", name.replace('\'', "-after"), numbers.join(","))
    };
    format!("[{}]", all.iter().map(one).collect::<Vec<_>>().join(","))
}

struct Setter(Pen);

impl Setter {
    fn bits(&self, inlines: &[Inline]) -> Vec<Bit> {
        let bit = |inline: &Inline| match inline {
            Inline::Words(w) => Bit::Words { w: w.clone() },
            Inline::Formula(parts) => Bit::Math { m: self.0.relations(parts) },
            Inline::Quantity(value, unit) => Bit::Math { m: self.0.with_unit(&value.formula(), *unit) },
        };
        inlines.iter().map(bit).collect()
    }

    fn side(&self, side: &Side) -> PageSide {
        let letters = side.formula.any(&|leaf| matches!(leaf, Formula::Letter(l) if l.0 != "½" && l.0 != "∞"));
        let kind = match (side.result, letters) {
            (true, _) => "value",
            (_, true) => "letters",
            _ => "numbers",
        };
        PageSide { rel: self.0.relation(side.relation), tex: self.0.with_unit(&side.formula, side.unit), kind }
    }

    fn row(&self, row: &Row) -> PageRow {
        PageRow { sides: row.sides.iter().map(|s| self.side(s)).collect(), tick: row.tick }
    }

    fn item(&self, item: &Item) -> PageItem {
        match item {
            Item::Prose(p) => PageItem::Prose { text: self.bits(p) },
            Item::Note(p) => PageItem::Note { text: self.bits(p) },
            Item::Points(points) => PageItem::Points { points: points.iter().map(|p| self.bits(p)).collect() },
            Item::Choices(choices) => {
                let one = |c: &super::Choice| PageChoice {
                    holds: c.holds,
                    when: self.bits(&c.when),
                    then: self.bits(&c.then),
                };
                PageItem::Choices { choices: choices.iter().map(one).collect() }
            }
            Item::Equations(rows) => PageItem::Rows { rows: rows.iter().map(|r| self.row(r)).collect() },
            Item::Table(table) => PageItem::Table {
                head: table.head.iter().map(|c| self.bits(c)).collect(),
                rows: table.rows.iter().map(|r| r.iter().map(|c| self.bits(c)).collect()).collect(),
                left: (0..table.head.len()).map(|k| table.is_left(k)).collect(),
            },
            Item::Matrices(all) => PageItem::Matrices { matrices: all.iter().map(|m| self.matrices(m)).collect() },
            Item::Checks(checks) => {
                let one = |(holds, name, row): &(bool, Vec<Inline>, Row)| PageCheck {
                    holds: *holds,
                    name: self.bits(name),
                    row: self.row(row),
                };
                PageItem::Checks { checks: checks.iter().map(one).collect() }
            }
        }
    }

    fn matrices(&self, row: &super::Matrices) -> String {
        let mut text = String::new();
        for piece in &row.0 {
            match piece {
                Piece::Sign(sign) => text += &format!(" {} ", self.0.relation(sign)),
                Piece::Matrix(entries) => {
                    let rows =
                        entries.iter().map(|r| r.iter().map(|f| self.0.formula(f)).collect::<Vec<_>>().join(" & "));
                    text += &format!("\\begin{{pmatrix}} {} \\end{{pmatrix}}", rows.collect::<Vec<_>>().join(" \\\\ "));
                }
            }
        }
        text
    }
}

impl Explanation {
    /// The chain as one JSON object for a page: the heart of it in seven lines (`brief`), then everything that `carom explain`
    /// prints, with the same numbers.
    pub fn page(&self, language: Language, symbols: Symbols) -> String {
        let chain: Chain = self.chain(language);
        let set = Setter(Pen { symbols: Some(symbols), ..Pen::new(language, true, chain.dim) });
        let page = Page {
            language: language.tag(),
            title: &chain.title,
            brief: brief::brief(self, language).iter().map(|r| set.row(r)).collect(),
            opening: chain.opening.iter().map(|i| set.item(i)).collect(),
            steps: chain
                .steps
                .iter()
                .map(|s| PageStep {
                    number: s.number,
                    title: set.bits(&s.title),
                    items: s.items.iter().map(|i| set.item(i)).collect(),
                })
                .collect(),
            special: self.special.iter().map(|s| format!("{s:?}")).collect(),
        };
        match serde_json::to_string(&page) {
            Ok(page) => format!("{},\"values\":{}}}", page.trim_end_matches('}'), values(&meaning::letters(self))),
            Err(_) => "null".into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Question;
    use super::*;

    #[test]
    fn letters_carry_their_names() {
        let question = Question::new([2.0, 1.0], [vec![3.0], vec![-1.0]]).restitution(0.5);
        let explanation = question.answer().unwrap();
        let page: serde_json::Value =
            serde_json::from_str(&explanation.page(Language::Portuguese, Symbols::named("Q,I,ε"))).unwrap();
        let text = page.to_string();
        assert!(text.contains("\\\\htmlData{q=v1-after}{v_1'}"), "{text}");
        assert!(text.contains("\\\\htmlData{q=p1}{Q_1}") && text.contains("\\\\htmlData{q=P}{Q}"));
        assert!(text.contains("\\\\htmlData{q=J}{I}") && text.contains("\\\\htmlData{q=Fh1}{I_1}"));
        assert!(text.contains("\\\\varepsilon") && text.contains("E_d"));
        // THEORY 1: u = 4, mu = 2/3, J = 4, v1' = 1, v2' = 3, Q = 4; each line of the brief ends with its value.
        let last: Vec<&str> = page["brief"]
            .as_array()
            .unwrap()
            .iter()
            .map(|row| row["sides"].as_array().unwrap().last().unwrap()["tex"].as_str().unwrap())
            .collect();
        for (line, want) in last.iter().zip(["4", "0{,}666667", "4", "1", "3", "4"]) {
            assert!(line.starts_with(want), "{last:?}");
        }
        assert_eq!(last.len(), 6);
        assert_eq!(page["steps"].as_array().unwrap().len(), explanation.chain(Language::English).steps.len());
    }

    #[test]
    fn the_brief_is_true_with_friction_as_well() {
        use super::super::{Formula, Values};
        let (v, n) = ([vec![5.0, 0.0], vec![-1.0, 2.0]], [3.0, 4.0]);
        let base = Question::new([2.0, 3.0], v).normal(n).restitution(0.5);
        let turning = Question { spin: Some([vec![4.0], vec![-1.0]]), radius: Some([0.5, 1.0]), ..base.clone() };
        let wall = Question { masses: [2.0, f64::INFINITY], ..turning.clone() };
        for question in [base.clone(), turning.clone(), wall]
            .map(|q| [0.0, 0.05, 2.0].map(|mu| Question { friction: mu, ..q.clone() }))
        {
            for question in question {
                let Ok(x) = question.answer() else { continue };
                for row in brief::brief(&x, Language::English) {
                    let values: Vec<Vec<f64>> = row
                        .sides
                        .iter()
                        .filter(|s| !s.formula.any(&|leaf| matches!(leaf, Formula::Letter(l) if l.0 != "½")))
                        .filter_map(|s| Values::default().evaluate(&s.formula).map(|v| v.numbers().to_vec()))
                        .collect();
                    for pair in values.windows(2) {
                        // Numbers of order ten, a few roundings.
                        let far = pair[0].iter().zip(&pair[1]).any(|(a, b)| (a - b).abs() > 1e-12);
                        assert!(!far, "mu = {}: {row:?}", question.friction);
                    }
                }
            }
        }
    }

    #[test]
    fn vectors_of_the_plane_stay_bold() {
        let question = Question::new([2.0, 3.0], [vec![5.0, 0.0], vec![-1.0, 2.0]]).normal([3.0, 4.0]).restitution(0.5);
        let page = question.answer().unwrap().page(Language::English, Symbols::named("Q,J"));
        for want in ["{\\\\mathbf{J}_1}", "{\\\\mathbf{Q}_1}", "\\\\frac{d\\\\mathbf{Q}}{dt}", "{Q_x}", "{v_{p1}}"] {
            assert!(page.contains(want), "{want}");
        }
        assert!(!page.contains("\\\\hat"));
    }
}
