//! The chain in Markdown: headings, tables, and equations as code, which every viewer shows aligned.
use super::pen::Pen;
use super::text::Sheet;
use super::{Chain, Inline, Item, Row};
use core::fmt::Write;

/// Characters that Markdown would take for markup.
fn escaped(words: &str) -> String {
    let mut text = String::new();
    for c in words.replace('\u{a0}', " ").chars() {
        if "\\`*_[]<>|#".contains(c) {
            text.push('\\');
        }
        text.push(c);
    }
    text
}

impl Sheet {
    fn marked(&self, inlines: &[Inline]) -> String {
        self.pen.prose(inlines, escaped, escaped)
    }

    fn row(&self, row: &Row) -> String {
        let sides = row.sides.iter().enumerate().map(|(k, side)| {
            let relation = if k == 0 { String::new() } else { format!(" {} ", side.relation) };
            format!("{relation}{}", escaped(&self.pen.with_unit(&side.formula, side.unit)))
        });
        sides.collect()
    }

    fn code(&self, lines: Vec<String>) -> String {
        format!("```text\n{}\n```\n", lines.join("\n"))
    }

    fn markdown(&self, item: &Item) -> String {
        match item {
            Item::Prose(p) => self.marked(p) + "\n",
            Item::Note(p) => format!("> {}\n", self.marked(p)),
            Item::Points(points) => points.iter().map(|p| format!("- {}\n", self.marked(p))).collect(),
            Item::Choices(choices) => choices
                .iter()
                .map(|c| {
                    let line = format!("{}: {}", self.marked(&c.when), self.marked(&c.then));
                    if c.holds { format!("- **{line}**\n") } else { format!("- {line}\n") }
                })
                .collect(),
            Item::Equations(rows) => self.code(self.equations(rows, 0).iter().map(|l| l.plain()).collect()),
            Item::Matrices(all) => self.code(self.matrices(all, 0).iter().map(|l| l.plain()).collect()),
            Item::Table(table) => {
                let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
                let cells = |row: &[Vec<Inline>]| line(row.iter().map(|c| self.marked(c)).collect());
                let rule =
                    (0..table.head.len()).map(|k| if table.is_left(k) { "---" } else { "---:" }.to_string()).collect();
                let rows: String = table.rows.iter().map(|r| cells(r)).collect();
                cells(&table.head) + &line(rule) + &rows
            }
            Item::Checks(checks) => checks
                .iter()
                .map(|(holds, name, row)| {
                    format!("- {} {}: {}\n", if *holds { "✓" } else { "✗" }, self.marked(name), self.row(row))
                })
                .collect(),
        }
    }
}

impl Chain {
    /// The chain as a Markdown document.
    pub fn markdown(&self) -> String {
        let sheet = Sheet { pen: Pen::new(self.language, false, self.dim) };
        let mut text = format!("# {}\n", self.title);
        for item in &self.opening {
            let _ = write!(text, "\n{}", sheet.markdown(item));
        }
        for step in &self.steps {
            let number = step.number.map_or(String::new(), |n| format!("{n}. "));
            let _ = write!(text, "\n## {number}{}\n", sheet.marked(&step.title));
            for item in &step.items {
                let _ = write!(text, "\n{}", sheet.markdown(item));
            }
        }
        text
    }
}
