//! Rows of comma-separated values (RFC 4180), numbers with as many digits as it takes to read the same bits back.
use crate::fields::AXES;
use std::fmt::Write;

/// A row that is being written.
#[derive(Default)]
pub(super) struct Row(String);

impl Row {
    fn cell(&mut self) -> &mut String {
        if !self.0.is_empty() {
            self.0.push(',');
        }
        &mut self.0
    }

    /// Text, in quotes where it needs them.
    pub fn text(&mut self, text: &str) -> &mut Self {
        let cell = self.cell();
        if text.is_empty() || text.contains([',', '"', '\n', '\r']) {
            let _ = write!(cell, "\"{}\"", text.replace('"', "\"\""));
        } else {
            cell.push_str(text);
        }
        self
    }

    pub fn texts<'a>(&mut self, all: impl IntoIterator<Item = &'a str>) -> &mut Self {
        all.into_iter().for_each(|text| {
            self.text(text);
        });
        self
    }

    pub fn whole(&mut self, n: u64) -> &mut Self {
        let _ = write!(self.cell(), "{n}");
        self
    }

    pub fn number(&mut self, x: f64) -> &mut Self {
        let _ = write!(self.cell(), "{x:?}");
        self
    }

    pub fn numbers(&mut self, all: &[f64]) -> &mut Self {
        all.iter().for_each(|x| {
            self.number(*x);
        });
        self
    }

    /// The heads of a vector's components: `name_x`, `name_y`, ...
    pub fn components(&mut self, name: &str, dim: usize) -> &mut Self {
        AXES.iter().take(dim).for_each(|axis| {
            self.text(&format!("{name}_{axis}"));
        });
        self
    }

    /// The heads of a spin: nothing on a line, `name` in the plane, `name_x`, `name_y`, `name_z` in space.
    pub fn spins(&mut self, name: &str, dim: usize) -> &mut Self {
        match dim {
            1 => self,
            2 => self.text(name),
            _ => self.components(name, dim),
        }
    }

    pub fn end(self) -> String {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_that_need_quotes_have_them() {
        let mut row = Row::default();
        row.whole(3).text("A").text("one, two").text("say \"x\"").number(0.1).number(-0.0).number(1e300);
        assert_eq!(row.end(), "3,A,\"one, two\",\"say \"\"x\"\"\",0.1,-0.0,1e300");
    }
}
