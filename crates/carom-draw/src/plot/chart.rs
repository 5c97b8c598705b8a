//! A chart: axes, layers of areas and lines, and a key.
use crate::colour::Colour;
use crate::figure::{raised, ticks};
use crate::font::{self, Weight};
use crate::sheet::{At, Pen, Sheet, Side, Style};
use crate::theme::Theme;

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What is measured, and in which unit.
    pub label: String,
    /// Its ends; of a logarithmic axis both are positive.
    pub low: f64,
    /// The larger end.
    pub high: f64,
    /// True if equal lengths are equal factors.
    pub log: bool,
}

impl Axis {
    /// An axis with equal steps that holds all of these numbers, and a little more; from 0 if that is near.
    pub fn holding(label: impl Into<String>, numbers: impl IntoIterator<Item = f64>) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for x in numbers.into_iter().filter(|x| x.is_finite()) {
            (low, high) = (low.min(x), high.max(x));
        }
        if !(low <= high) {
            (low, high) = (0.0, 1.0);
        }
        if low > 0.0 && low < 0.35 * high {
            low = 0.0;
        }
        let room = if high > low { 0.05 * (high - low) } else { 0.1 * high.abs().max(1e-3) };
        let low = if low == 0.0 { 0.0 } else { low - room };
        Self { label: label.into(), low, high: high + room, log: false }
    }

    /// An axis from one number to another.
    pub fn between(label: impl Into<String>, low: f64, high: f64) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        Self { label: label.into(), low, high, log: false }
    }

    /// Where a number lies, 0 at the low end and 1 at the high end.
    pub fn part(&self, x: f64) -> f64 {
        if self.log {
            let (low, high) = (libm::log10(self.low), libm::log10(self.high));
            return (libm::log10(x.max(self.low)) - low) / (high - low);
        }
        (x - self.low) / (self.high - self.low)
    }

    /// Ticks and their labels.
    pub fn ticks(&self, about: usize) -> Vec<(f64, String)> {
        if !self.log {
            return ticks(self.low, self.high, about);
        }
        let (low, high) = (libm::log10(self.low).ceil() as i32, libm::log10(self.high).floor() as i32);
        let step = ((high - low) / about.max(1) as i32 + 1).max(1);
        (low..=high).filter(|k| (k - low) % step == 0).map(|k| (10f64.powi(k), format!("10{}", raised(k)))).collect()
    }
}

/// What a layer is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sort {
    /// A line through its points.
    Line {
        /// True if it is dashed.
        dashed: bool,
    },
    /// The area between its points and its base.
    Area,
}

/// Something drawn between the axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// What it is.
    pub sort: Sort,
    /// Its points.
    pub points: Vec<[f64; 2]>,
    /// The lower edge of an area, point by point.
    pub base: Vec<f64>,
    /// Its colour.
    pub colour: Colour,
    /// The width of a line.
    pub width: f64,
    /// Which key it belongs to: a terminal tells layers apart by that.
    pub key: usize,
}

/// A line of the key.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// What it says.
    pub label: String,
    /// In which colour.
    pub colour: Colour,
    /// How it is drawn.
    pub sort: Sort,
}

/// A chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What it is of.
    pub title: String,
    /// What it shows.
    pub subtitle: String,
    /// Across.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// From the bottom up.
    pub layers: Vec<Layer>,
    /// The key.
    pub keys: Vec<Key>,
}

impl Chart {
    /// Adds a line.
    pub fn line(&mut self, points: Vec<[f64; 2]>, colour: Colour, width: f64, dashed: bool, key: usize) {
        self.layers.push(Layer { sort: Sort::Line { dashed }, points, base: Vec::new(), colour, width, key });
    }

    /// Adds an area between two edges.
    pub fn area(&mut self, points: Vec<[f64; 2]>, base: Vec<f64>, colour: Colour, key: usize) {
        self.layers.push(Layer { sort: Sort::Area, points, base, colour, width: 0.0, key });
    }

    /// The chart on a sheet of this size (pixels).
    pub fn sheet(&self, [width, height]: [u32; 2], theme: &Theme) -> Sheet {
        let mut sheet = Sheet::new();
        let (w, h) = (f64::from(width), f64::from(height));
        let u = (w / 900.0).min(h / 520.0).clamp(0.45, 4.0);
        let small = (12.0 * u).max(10.5);
        let title = (17.0 * u).max(12.0);
        let (left, right) = (76.0 * u, w - 28.0 * u);
        sheet.text([28.0 * u, 34.0 * u], &self.title, Style::new(title, theme.ink).bold());
        let from = 28.0 * u + font::width(&self.title, title, Weight::Semibold) + 12.0 * u;
        if from + font::width(&self.subtitle, small, Weight::Regular) < right {
            sheet.text([from, 34.0 * u], &self.subtitle, Style::new(small, theme.quiet));
        }
        let top = self.key(&mut sheet, theme, [28.0 * u, 34.0 * u + 1.9 * small, right], u, small) + 12.0 * u;
        let bottom = h - 52.0 * u;
        let at = |p: [f64; 2]| -> At {
            [left + self.x.part(p[0]) * (right - left), bottom - self.y.part(p[1]) * (bottom - top)]
        };
        sheet.rectangle([left, top, right, bottom], theme.floor);
        let grid = Pen::new(theme.faint, 1.0 * u);
        let quiet = Style::new(small, theme.quiet);
        for (x, label) in self.x.ticks(8) {
            let [x, _] = at([x, self.y.low]);
            sheet.line(&[[x, top], [x, bottom]], grid);
            sheet.text([x, bottom + 6.0 * u + small], &label, quiet.side(Side::Middle));
        }
        for (y, label) in self.y.ticks(5) {
            let [_, y] = at([self.x.low, y]);
            sheet.line(&[[left, y], [right, y]], grid);
            sheet.text([left - 7.0 * u, y + 0.36 * small], &label, quiet.side(Side::End));
        }
        sheet.text([right, bottom + 10.0 * u + 2.2 * small], &self.x.label, quiet.side(Side::End));
        sheet.upright([20.0 * u + 0.5 * small, 0.5 * (top + bottom)], &self.y.label, quiet);
        sheet.window = Some([left, top, right, bottom]);
        for layer in &self.layers {
            match layer.sort {
                Sort::Area => {
                    let back = layer.points.iter().zip(&layer.base).rev().map(|(p, base)| at([p[0], *base]));
                    let outline: Vec<At> = layer.points.iter().map(|p| at(*p)).chain(back).collect();
                    sheet.area(&outline, layer.colour);
                }
                Sort::Line { dashed } => {
                    let pen = Pen::new(layer.colour, layer.width * u);
                    let pen = if dashed { pen.dashed(5.0 * u, 5.0 * u) } else { pen };
                    // What cannot be drawn (a gap in the line) parts it in two.
                    for piece in layer.points.split(|p| !(p[0].is_finite() && p[1].is_finite())) {
                        let points: Vec<At> = piece.iter().map(|p| at(*p)).collect();
                        sheet.line(&points, pen);
                    }
                }
            }
        }
        sheet.window = None;
        sheet.line(&[[left, bottom], [right, bottom]], Pen::new(theme.quiet, 1.2 * u));
        sheet
    }

    /// The key, in as many rows as it takes; where the last of them stands.
    fn key(&self, sheet: &mut Sheet, theme: &Theme, [left, mut y, right]: [f64; 3], u: f64, small: f64) -> f64 {
        let mut x = left;
        for key in &self.keys {
            let mark = 20.0 * u;
            let wide = mark + 6.0 * u + font::width(&key.label, small, Weight::Regular);
            if x > left && x + wide > right {
                (x, y) = (left, y + 1.6 * small);
            }
            let line = y - 0.36 * small;
            match key.sort {
                Sort::Area => sheet.rounded([x, line - 5.0 * u, x + mark, line + 5.0 * u], 2.0 * u, key.colour),
                Sort::Line { dashed } => {
                    let pen = Pen::new(key.colour, 2.2 * u);
                    let pen = if dashed { pen.dashed(4.0 * u, 4.5 * u) } else { pen };
                    sheet.line(&[[x, line], [x + mark, line]], pen);
                }
            }
            sheet.text([x + mark + 6.0 * u, y], &key.label, Style::new(small, theme.quiet));
            x += wide + 20.0 * u;
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_hold_their_numbers() {
        let axis = Axis::holding("x", [0.2, 5.0, f64::NAN]);
        assert!(axis.low == 0.0 && axis.part(5.0) < 1.0 && axis.part(0.2) > 0.0);
        let axis = Axis::holding("x", [7.0, 7.0]);
        assert!((axis.part(7.0) - 0.5).abs() < 1e-12);
        let log = Axis { label: String::new(), low: 1e-6, high: 1.0, log: true };
        assert!((log.part(1e-3) - 0.5).abs() < 1e-12 && log.part(0.0) == 0.0);
        assert_eq!(log.ticks(5).iter().map(|t| t.1.as_str()).collect::<Vec<_>>(), ["10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"]);
    }
}
