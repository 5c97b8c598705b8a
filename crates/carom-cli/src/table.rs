//! Tables of text: columns as wide as they need to be, numbers to the right.

/// Rows under a head.
pub struct Table {
    /// One letter for each column: `l` to the left, `r` to the right.
    align: &'static str,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new<S: Into<String>>(align: &'static str, head: impl IntoIterator<Item = S>) -> Self {
        let mut table = Self { align, rows: Vec::new() };
        table.row(head);
        table
    }

    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// The table, every line indented by two blanks; the head dimmed where colour is wanted.
    pub fn text(&self, colour: bool) -> String {
        let width = |k: usize| self.rows.iter().filter_map(|r| r.get(k)).map(|c| c.chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..self.align.len()).map(width).collect();
        let mut text = String::new();
        for (line, row) in self.rows.iter().enumerate() {
            let mut shown = String::new();
            for ((cell, width), align) in row.iter().zip(&widths).zip(self.align.chars()) {
                let gap = " ".repeat(width - cell.chars().count());
                let cell = if align == 'r' { format!("{gap}{cell}") } else { format!("{cell}{gap}") };
                shown.push_str("  ");
                shown.push_str(&cell);
            }
            let shown = shown.trim_end();
            if line == 0 && colour {
                text.push_str(&format!("\x1b[2m{shown}\x1b[0m\n"));
            } else {
                text.push_str(&format!("{shown}\n"));
            }
        }
        text
    }

    /// The table in Markdown.
    pub fn markdown(&self) -> String {
        let mut text = String::new();
        for (line, row) in self.rows.iter().enumerate() {
            let cells: Vec<String> = row.iter().map(|c| c.replace('|', "\\|")).collect();
            text.push_str(&format!("| {} |\n", cells.join(" | ")));
            if line == 0 {
                let rules: Vec<&str> =
                    self.align.chars().take(row.len()).map(|a| if a == 'r' { "---:" } else { "---" }).collect();
                text.push_str(&format!("| {} |\n", rules.join(" | ")));
            }
        }
        text
    }

    /// The table as a LaTeX `tabular`.
    pub fn latex(&self) -> String {
        let columns: String = self.align.chars().take(self.rows.first().map_or(0, Vec::len)).collect();
        let mut text = format!("\\begin{{tabular}}{{{columns}}}\n");
        for (line, row) in self.rows.iter().enumerate() {
            let cells: Vec<String> = row.iter().map(|c| escape(c)).collect();
            text.push_str(&format!("  {} \\\\\n", cells.join(" & ")));
            if line == 0 {
                text.push_str("  \\hline\n");
            }
        }
        text + "\\end{tabular}\n"
    }
}

/// Text with what LaTeX would read as a command written out.
pub fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => escaped.extend(['\\', c]),
            '\\' => escaped.push_str("\\textbackslash{}"),
            '~' => escaped.push_str("\\textasciitilde{}"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '>' | '<' => escaped.push_str(&format!("${c}$")),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up() {
        let mut table = Table::new("rl", ["n", "who"]);
        table.row(["1", "A - B"]);
        table.row(["10", "A"]);
        assert_eq!(table.text(false), "   n  who\n   1  A - B\n  10  A\n");
        assert_eq!(table.markdown(), "| n | who |\n| ---: | --- |\n| 1 | A - B |\n| 10 | A |\n");
        let latex =
            "\\begin{tabular}{rl}\n  n & who \\\\\n  \\hline\n  1 & A - B \\\\\n  10 & A \\\\\n\\end{tabular}\n";
        assert_eq!(table.latex(), latex);
        assert_eq!(escape("a_1 > 5 %"), "a\\_1 $>$ 5 \\%");
    }
}
