//! The chain on a terminal: 80 columns, aligned at the signs of equality.
use super::pen::Pen;
use super::{Chain, Formula, Inline, Item, Matrices, Piece, Row, Side, Table};

/// Columns.
const WIDTH: usize = 80;
/// Where prose and equations begin.
const PROSE: usize = 4;
const EQUATIONS: usize = 8;

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Style {
    Plain,
    Bold,
    Dim,
    Heading,
    Good,
    Bad,
}

/// Pieces of a line, each in its style.
#[derive(Clone, Default)]
pub(super) struct Line(Vec<(Style, String)>);

impl Line {
    fn indent(columns: usize) -> Self {
        Self(vec![(Style::Plain, " ".repeat(columns))])
    }

    fn add(mut self, style: Style, text: impl Into<String>) -> Self {
        self.0.push((style, text.into()));
        self
    }

    fn width(&self) -> usize {
        self.0.iter().map(|(_, t)| width(t)).sum()
    }

    fn print(&self, colour: bool) -> String {
        let mut text = String::new();
        for (style, piece) in &self.0 {
            let code = match style {
                _ if !colour => "",
                Style::Plain => "",
                Style::Bold => "1",
                Style::Dim => "2",
                Style::Heading => "1;36",
                Style::Good => "32",
                Style::Bad => "1;31",
            };
            // A space inside a formula holds it together until here.
            let piece = piece.replace('\u{a0}', " ");
            text += &if code.is_empty() { piece } else { format!("\x1b[{code}m{piece}\x1b[0m") };
        }
        text.trim_end().into()
    }

    /// Without any style, for a code block.
    pub(super) fn plain(&self) -> String {
        self.print(false)
    }
}

/// Columns that a text takes: the hat of F̂ stands above its letter.
pub(super) fn width(text: &str) -> usize {
    text.chars().filter(|c| *c != '\u{302}').count()
}

fn pad(text: &str, columns: usize) -> String {
    format!("{text}{}", " ".repeat(columns.saturating_sub(width(text))))
}

fn pad_left(text: &str, columns: usize) -> String {
    format!("{}{text}", " ".repeat(columns.saturating_sub(width(text))))
}

/// Breaks a text into lines of at most so many columns.
fn wrap(text: &str, columns: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ').filter(|w| !w.is_empty()) {
        let last = lines.len() - 1;
        if lines[last].is_empty() {
            lines[last].push_str(word);
        } else if width(&lines[last]) + 1 + width(word) <= columns {
            lines[last].push(' ');
            lines[last].push_str(word);
        } else {
            lines.push(word.into());
        }
    }
    lines
}

/// Sets the pieces of a chain into lines.
pub(super) struct Sheet {
    pub pen: Pen,
}

impl Sheet {
    pub fn words(&self, inlines: &[Inline]) -> String {
        self.pen.prose(inlines, str::to_string, |math| math.replace(' ', "\u{a0}"))
    }

    fn paragraph(&self, inlines: &[Inline], first: Line, columns: usize, style: Style) -> Vec<Line> {
        let lines = wrap(&self.words(inlines), WIDTH - columns);
        let mut first = Some(first);
        lines.into_iter().map(|l| first.take().unwrap_or_else(|| Line::indent(columns)).add(style, l)).collect()
    }

    fn side(&self, side: &Side) -> String {
        self.pen.with_unit(&side.formula, side.unit)
    }

    /// A side that may stand alone on a line of `columns`, or broken before its signs of sum or its ×.
    fn broken(&self, side: &Side, columns: usize) -> Vec<String> {
        let whole = self.side(side);
        if width(&whole) <= columns {
            return vec![whole];
        }
        let terms = match &side.formula {
            Formula::Sum(terms) => terms,
            Formula::Cross(a, b) => {
                return vec![self.pen.formula(a), format!("× {}", self.pen.formula(b))];
            }
            _ => return vec![whole],
        };
        let one = |(k, (plus, term)): (usize, &(bool, Formula))| {
            let sign = match (k, plus) {
                (0, _) => "",
                (_, true) => "+ ",
                (_, false) => "− ",
            };
            // A term after a sign needs its parentheses: written as the second term of a sum it gets them.
            let text = if k == 0 {
                self.pen.formula(term)
            } else {
                let sum = Formula::Sum(vec![(true, Formula::Number(0.0)), (true, term.clone())]);
                self.pen.formula(&sum).trim_start_matches("0 + ").to_string()
            };
            format!("{sign}{text}")
        };
        terms.iter().enumerate().map(one).collect()
    }

    /// Equations under one another, the signs of equality aligned; in columns where they fit, else one side per line.
    pub fn equations(&self, rows: &[Row], indent: usize) -> Vec<Line> {
        let sides: Vec<Vec<String>> = rows.iter().map(|r| r.sides.iter().map(|s| self.side(s)).collect()).collect();
        let columns = sides.iter().map(Vec::len).max().unwrap_or(0);
        // A column is as wide as its widest side that is not the last of its row.
        let widths: Vec<usize> = (0..columns)
            .map(|k| sides.iter().filter(|r| r.len() > k + 1 || k == 0).map(|r| width(&r[k])).max().unwrap_or(0))
            .collect();
        let in_columns = |k: usize| {
            let mut line = Line::indent(indent);
            for (c, side) in rows[k].sides.iter().enumerate() {
                let text = &sides[k][c];
                let last = c + 1 == rows[k].sides.len();
                line = match c {
                    0 => line.add(Style::Plain, pad_left(text, widths[0])),
                    _ => {
                        let text = if last { text.clone() } else { pad(text, widths[c]) };
                        line.add(Style::Plain, format!(" {} ", side.relation)).add(style(side), text)
                    }
                };
            }
            tick(line, &rows[k])
        };
        let table: Vec<Line> = (0..rows.len()).map(in_columns).collect();
        if table.iter().all(|l| l.width() <= WIDTH) {
            return table;
        }
        rows.iter().zip(&sides).flat_map(|(row, sides)| self.stacked(row, sides, indent, widths[0])).collect()
    }

    fn stacked(&self, row: &Row, sides: &[String], indent: usize, first: usize) -> Vec<Line> {
        let mut lines = vec![Line::indent(indent).add(Style::Plain, pad_left(&sides[0], first))];
        for (k, side) in row.sides.iter().enumerate().skip(1) {
            let line = lines.len() - 1;
            let fits = lines[line].width() + 3 + width(&sides[k]) <= WIDTH;
            let fresh = k == 1;
            if !fits && !fresh {
                lines.push(Line::indent(indent + first));
            }
            let room = WIDTH.saturating_sub(indent + first + 3);
            let parts = if fits { vec![sides[k].clone()] } else { self.broken(side, room) };
            for (p, part) in parts.into_iter().enumerate() {
                if p > 0 {
                    lines.push(Line::indent(indent + first + 5));
                }
                if let Some(last) = lines.pop() {
                    let last = if p == 0 { last.add(Style::Plain, format!(" {} ", side.relation)) } else { last };
                    lines.push(last.add(style(side), part));
                }
            }
        }
        if let Some(last) = lines.pop() {
            lines.push(tick(last, row));
        }
        lines
    }

    fn table(&self, table: &Table) -> Vec<Line> {
        let text = |cells: &[Vec<Inline>]| cells.iter().map(|c| self.words(c)).collect::<Vec<_>>();
        let head = text(&table.head);
        let rows: Vec<Vec<String>> = table.rows.iter().map(|r| text(r)).collect();
        let widest =
            |k: usize| rows.iter().chain([&head]).filter_map(|r| r.get(k)).map(|c| width(c)).max().unwrap_or(0);
        let widths: Vec<usize> = (0..head.len()).map(widest).collect();
        let gap = if PROSE + widths.iter().sum::<usize>() + 3 * (head.len() - 1) <= WIDTH { 3 } else { 2 };
        if PROSE + widths.iter().sum::<usize>() + gap * (head.len() - 1) <= WIDTH {
            let set = |cells: &[String], style: Style| {
                let mut line = Line::indent(PROSE)
                    .add(if style == Style::Dim { style } else { Style::Bold }, pad(&cells[0], widths[0]));
                for (k, (cell, columns)) in cells.iter().zip(&widths).enumerate().skip(1) {
                    let cell = if table.is_left(k) { pad(cell, *columns) } else { pad_left(cell, *columns) };
                    line = line.add(style, format!("{}{cell}", " ".repeat(gap)));
                }
                line
            };
            return core::iter::once(set(&head, Style::Dim)).chain(rows.iter().map(|r| set(r, Style::Plain))).collect();
        }
        // Too wide: a row becomes a list of its cells.
        let names = head.iter().skip(1).map(|h| width(h)).max().unwrap_or(0);
        let mut lines = Vec::new();
        for row in &rows {
            lines.push(Line::indent(PROSE).add(Style::Bold, row[0].clone()));
            for (name, cell) in head.iter().zip(row).skip(1) {
                lines.push(
                    Line::indent(PROSE + 4).add(Style::Dim, pad(name, names)).add(Style::Plain, format!("   {cell}")),
                );
            }
        }
        lines
    }

    /// Matrices of two rows, side by side; what does not fit goes on below, from a sign of equality on.
    pub fn matrices(&self, all: &[Matrices], indent: usize) -> Vec<Line> {
        let mut lines = Vec::new();
        for (n, row) in all.iter().enumerate() {
            if n > 0 {
                lines.push(Line::default());
            }
            let columns: Vec<[String; 2]> = row.0.iter().enumerate().map(|(at, p)| self.piece(p, at, &row.0)).collect();
            // A sign and what follows it up to the next stay together.
            let starts = (0..columns.len()).filter(|k| *k == 0 || matches!(row.0[*k], Piece::Sign(_)));
            let mut starts: Vec<usize> = starts.collect();
            starts.push(columns.len());
            let mut pair = [Line::indent(indent), Line::indent(indent)];
            let mut margin = 0;
            for group in starts.windows(2) {
                let group = &columns[group[0]..group[1]];
                let wide: usize = group.iter().map(|c| width(&c[0])).sum();
                if pair[0].width() + wide > WIDTH {
                    lines.extend(core::mem::replace(
                        &mut pair,
                        [Line::indent(indent + margin), Line::indent(indent + margin)],
                    ));
                }
                if margin == 0 {
                    margin = wide;
                }
                for (line, half) in [0, 1].into_iter().flat_map(|half| group.iter().map(move |c| (half, &c[half]))) {
                    pair[line] = core::mem::take(&mut pair[line]).add(Style::Plain, half.clone());
                }
            }
            lines.extend(pair);
        }
        lines
    }

    /// The two lines of a matrix, or of the sign between two.
    fn piece(&self, piece: &Piece, at: usize, row: &[Piece]) -> [String; 2] {
        let entries = match piece {
            Piece::Sign(sign) => return ["   ".into(), format!(" {sign} ")],
            Piece::Matrix(entries) => entries,
        };
        let text: Vec<Vec<String>> = entries.iter().map(|r| r.iter().map(|f| self.pen.formula(f)).collect()).collect();
        let widest = |c: usize| text.iter().filter_map(|r| r.get(c)).map(|t| width(t)).max().unwrap_or(0);
        let beside = if at > 0 && matches!(row[at - 1], Piece::Matrix(_)) { " " } else { "" };
        let line = |k: usize, open: char, close: char| {
            let cells = text.get(k).into_iter().flatten().enumerate().map(|(c, t)| pad_left(t, widest(c)));
            format!("{beside}{open}{}{close}", cells.collect::<Vec<_>>().join("  "))
        };
        [line(0, '⎡', '⎤'), line(1, '⎣', '⎦')]
    }

    fn item(&self, item: &Item) -> Vec<Line> {
        match item {
            Item::Prose(p) => self.paragraph(p, Line::indent(PROSE), PROSE, Style::Plain),
            Item::Note(p) => {
                let lines = wrap(&self.words(p), WIDTH - PROSE - 2);
                lines.into_iter().map(|l| Line::indent(PROSE).add(Style::Heading, "│ ").add(Style::Plain, l)).collect()
            }
            Item::Points(points) => {
                let point = |p: &Vec<Inline>| {
                    let bullet = Line::indent(PROSE).add(Style::Heading, "★ ");
                    self.paragraph(p, bullet, PROSE + 2, Style::Plain)
                };
                points.iter().flat_map(point).collect()
            }
            Item::Choices(choices) => {
                let when = choices.iter().map(|c| width(&self.words(&c.when))).max().unwrap_or(0);
                let one = |c: &super::Choice| {
                    let style = if c.holds { Style::Bold } else { Style::Dim };
                    let mark = if c.holds { "▸ " } else { "  " };
                    let first = Line::indent(PROSE + 2).add(Style::Heading, mark);
                    let first = first.add(style, format!("{}   ", pad(&self.words(&c.when), when)));
                    self.paragraph(&c.then, first, PROSE + 2 + 2 + when + 3, style)
                };
                choices.iter().flat_map(one).collect()
            }
            Item::Equations(rows) => self.equations(rows, EQUATIONS),
            Item::Table(table) => self.table(table),
            Item::Matrices(all) => self.matrices(all, EQUATIONS),
            Item::Checks(checks) => {
                let names = checks.iter().map(|c| width(&self.words(&c.1))).max().unwrap_or(0);
                let one = |(holds, name, row): &(bool, Vec<Inline>, Row)| {
                    let indent = PROSE + 2 + names + 3;
                    let mut lines = self.equations(core::slice::from_ref(row), indent);
                    let (mark, style) = if *holds { ("✓ ", Style::Good) } else { ("✗ ", Style::Bad) };
                    let mut first = Line::indent(PROSE).add(style, mark);
                    first = first.add(Style::Plain, pad(&self.words(name), names + 3));
                    first.0.extend(lines[0].0.drain(1..));
                    lines[0] = first;
                    lines
                };
                checks.iter().flat_map(one).collect()
            }
        }
    }
}

fn style(side: &Side) -> Style {
    if side.result { Style::Bold } else { Style::Plain }
}

fn tick(line: Line, row: &Row) -> Line {
    if row.tick { line.add(Style::Good, "  ✓") } else { line }
}

impl Chain {
    /// The chain for a terminal of 80 columns, in bold and colour if asked.
    pub fn text(&self, colour: bool) -> String {
        let sheet = Sheet { pen: Pen::new(self.language, false, self.dim) };
        let mut lines = vec![Line::default(), Line::indent(1).add(Style::Bold, self.title.clone()), Line::default()];
        let set = |lines: &mut Vec<Line>, items: &[Item]| {
            for item in items {
                lines.extend(sheet.item(item));
                lines.push(Line::default());
            }
        };
        set(&mut lines, &self.opening);
        for step in &self.steps {
            let number = step.number.map_or("── ".into(), |n| format!("── {n} "));
            let heading = Line::default().add(Style::Dim, number).add(Style::Heading, sheet.words(&step.title));
            let rule = WIDTH.saturating_sub(heading.width() + 1);
            lines.push(heading.add(Style::Dim, format!(" {}", "─".repeat(rule))));
            lines.push(Line::default());
            set(&mut lines, &step.items);
        }
        while lines.last().is_some_and(|l| l.width() == 0) {
            lines.pop();
        }
        lines.iter().map(|l| l.print(colour) + "\n").collect()
    }
}
