//! The chain in LaTeX: a body for any document that loads amsmath and reads UTF-8.
use super::pen::Pen;
use super::text::width;
use super::words::Phrase;
use super::{Chain, Inline, Item, Matrices, Piece, Row};
use core::fmt::Write;

/// Characters that LaTeX would take for commands.
fn escaped(words: &str) -> String {
    let mut text = String::new();
    for c in words.chars() {
        match c {
            '\u{a0}' => text.push('~'),
            '\\' => text += "\\textbackslash{}",
            '~' => text += "\\textasciitilde{}",
            '^' => text += "\\textasciicircum{}",
            '#' | '$' | '%' | '&' | '_' | '{' | '}' => {
                text.push('\\');
                text.push(c);
            }
            c => text.push(c),
        }
    }
    text
}

/// Sides of an equation that stand on one line as long as they take fewer plain characters than this.
const LINE: usize = 64;

struct Setter<'a> {
    chain: &'a Chain,
    pen: Pen,
    plain: Pen,
}

impl Setter<'_> {
    fn prose(&self, inlines: &[Inline]) -> String {
        self.pen.prose(inlines, escaped, |math| format!("${math}$"))
    }

    /// One equation, aligned at the first relation.
    fn row(&self, row: &Row) -> String {
        let mut text = String::new();
        let mut columns = 0;
        for (k, side) in row.sides.iter().enumerate() {
            let plain = width(&self.plain.with_unit(&side.formula, side.unit));
            let formula = self.pen.with_unit(&side.formula, side.unit);
            let relation = self.pen.relation(side.relation);
            match k {
                0 => text += &formula,
                1 => text += &format!(" &{relation} {formula}"),
                _ if columns + plain > LINE => {
                    text += &format!(" \\\\\n  &{relation} {formula}");
                    columns = 0;
                }
                _ => text += &format!(" {relation} {formula}"),
            }
            columns += plain + 3;
        }
        if row.tick {
            text += &format!(" \\quad\\text{{({})}}", Phrase::Holds.words(self.chain.language));
        }
        text
    }

    fn align(&self, rows: &[String]) -> String {
        let lines: Vec<String> = rows.iter().map(|r| format!("  {r}")).collect();
        format!("\\begin{{align*}}\n{}\n\\end{{align*}}\n", lines.join(" \\\\\n"))
    }

    fn matrices(&self, row: &Matrices) -> String {
        let mut text = String::new();
        // Aligned at the first sign.
        let mut mark = "&";
        for piece in &row.0 {
            match piece {
                Piece::Sign(sign) => text += &format!(" {}{} ", core::mem::take(&mut mark), self.pen.relation(sign)),
                Piece::Matrix(entries) => {
                    let rows: Vec<String> = entries
                        .iter()
                        .map(|r| r.iter().map(|f| self.pen.formula(f)).collect::<Vec<_>>().join(" & "))
                        .collect();
                    text += &format!("\\begin{{pmatrix}} {} \\end{{pmatrix}}", rows.join(" \\\\ "));
                }
            }
        }
        text
    }

    fn list(&self, lines: Vec<String>) -> String {
        let items: String = lines.iter().map(|l| format!("  \\item {l}\n")).collect();
        format!("\\begin{{itemize}}\n{items}\\end{{itemize}}\n")
    }

    fn item(&self, item: &Item) -> String {
        match item {
            Item::Prose(p) => self.prose(p) + "\n",
            Item::Note(p) => format!("\\begin{{quote}}\n{}\n\\end{{quote}}\n", self.prose(p)),
            Item::Points(points) => self.list(points.iter().map(|p| self.prose(p)).collect()),
            Item::Choices(choices) => {
                let one = |c: &super::Choice| {
                    let (when, then) = (self.prose(&c.when), self.prose(&c.then));
                    if c.holds { format!("{when}: \\textbf{{{then}}}") } else { format!("{when}: {then}") }
                };
                self.list(choices.iter().map(one).collect())
            }
            Item::Equations(rows) => self.align(&rows.iter().map(|r| self.row(r)).collect::<Vec<_>>()),
            Item::Matrices(all) => self.align(&all.iter().map(|m| self.matrices(m)).collect::<Vec<_>>()),
            Item::Table(table) => {
                let cells = |row: &[Vec<Inline>]| row.iter().map(|c| self.prose(c)).collect::<Vec<_>>().join(" & ");
                let rows: String = table.rows.iter().map(|r| format!("  {} \\\\\n", cells(r))).collect();
                let columns =
                    (0..table.head.len()).map(|k| if table.is_left(k) { 'l' } else { 'r' }).collect::<String>();
                let head = cells(&table.head);
                format!(
                    "\\begin{{center}}\n\\begin{{tabular}}{{{columns}}}\n  {head} \\\\ \\hline\n{rows}\\end{{tabular}}\n\\end{{center}}\n"
                )
            }
            Item::Checks(checks) => {
                let rows: Vec<String> = checks
                    .iter()
                    .map(|(holds, name, row)| {
                        let verdict = if *holds { Phrase::Holds } else { Phrase::Fails }.words(self.chain.language);
                        format!("{} &\\quad\\text{{({}: {verdict})}}", self.row(row), self.prose(name))
                    })
                    .collect();
                self.align(&rows)
            }
        }
    }
}

impl Chain {
    /// The chain as a LaTeX snippet, to be read into a document that loads amsmath.
    pub fn latex(&self) -> String {
        let set = Setter {
            chain: self,
            pen: Pen::new(self.language, true, self.dim),
            plain: Pen::new(self.language, false, self.dim),
        };
        let mut text = format!("% \\usepackage{{amsmath}}\n\\section*{{{}}}\n", escaped(&self.title));
        for item in &self.opening {
            let _ = write!(text, "\n{}", set.item(item));
        }
        for step in &self.steps {
            let number = step.number.map_or(String::new(), |n| format!("{n}. "));
            let _ = write!(text, "\n\\subsection*{{{number}{}}}\n", set.prose(&step.title));
            for item in &step.items {
                let _ = write!(text, "\n{}", set.item(item));
            }
        }
        text
    }
}
