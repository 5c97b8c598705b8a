//! The experiments. Each takes an engine's maker and returns the numbers of one row.
pub mod bullet;
pub mod cradle;
pub mod drop;
pub mod gas;
pub mod pair;
pub mod rack;

use crate::engine::{Engine, State};
use crate::scene::Scene;

/// Makes a world of an engine at some settings.
pub type Make<'a> = &'a dyn Fn(&Scene) -> Box<dyn Engine>;

/// Each case is repeated with the start shifted by this part of what is travelled in a frame: an impact may fall anywhere in it.
pub const PHASES: u32 = 16;

/// A column of a table: what it is called, and what would be exact.
pub type Column = (&'static str, &'static str);

/// A cell: as it is shown, and as numbers.
pub struct Cell {
    pub shown: String,
    pub numbers: Vec<f64>,
}

impl Cell {
    /// The span of several values.
    pub fn span(values: &[f64]) -> Self {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (a, b) = (number(low), number(high));
        Self { shown: if a == b { a } else { format!("{a} to {b}") }, numbers: vec![low, high] }
    }

    /// The largest of several errors; rounding is shown as its power of ten.
    pub fn worst(values: &[f64]) -> Self {
        let high = values.iter().copied().fold(0.0, f64::max);
        Self { shown: number(high), numbers: vec![high] }
    }

    /// A list of values.
    pub fn list(values: &[f64]) -> Self {
        let shown = values.iter().map(|&v| number(v)).collect::<Vec<_>>().join(" ");
        Self { shown, numbers: values.to_vec() }
    }

    /// A number as a part of the whole.
    pub fn percent(value: f64) -> Self {
        Self { shown: percent(value), numbers: vec![value] }
    }

    /// Words in place of a number.
    pub fn words(words: String, numbers: Vec<f64>) -> Self {
        Self { shown: words, numbers }
    }
}

/// Three digits, without a lie: what is not zero is not shown as zero.
pub fn number(v: f64) -> String {
    let v = if v == 0.0 { 0.0 } else { v };
    if v != 0.0 && v.abs() < 5e-4 {
        return format!("{v:.0e}");
    }
    let text = format!("{v:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "1" && v != 1.0 && (v - 1.0).abs() > 1e-9 { format!("{v:.4}") } else { text.to_string() }
}

/// In percent.
pub fn percent(v: f64) -> String {
    if v != 0.0 && v.abs() < 5e-6 {
        format!("{:.0e} %", 100.0 * v)
    } else {
        format!("{} %", number((1e4 * v).round() / 100.0))
    }
}

/// The kinetic energy of balls (J).
pub fn kinetic(scene: &Scene, balls: &[State]) -> f64 {
    let square = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>();
    scene.balls.iter().zip(balls).map(|(b, s)| 0.5 * b.mass * square(s.velocity)).sum()
}

/// The distance of two points, or the size of the difference of two velocities.
pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
