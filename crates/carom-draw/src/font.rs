//! Letters as outlines: the typeface Inter (SIL Open Font License 1.1, `font/LICENSE-OFL`), made by `tools/glyphs.py`, so that
//! a picture looks the same everywhere and needs no fonts.
use crate::sheet::{At, Step};
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// How heavy letters are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weight {
    /// For everything.
    Regular,
    /// For titles.
    Semibold,
}

struct Glyph {
    /// Thousandths of an em.
    advance: f64,
    /// In thousandths of an em.
    steps: Vec<Step>,
}

type Font = BTreeMap<char, Glyph>;

/// What stands for a character that the font does not have.
const MISSING: char = '\u{b7}';
/// Raised figures are set from figures of this size, so much higher (em).
const RAISED: (f64, f64) = (0.68, 0.34);

fn font(weight: Weight) -> &'static Font {
    static REGULAR: OnceLock<Font> = OnceLock::new();
    static SEMIBOLD: OnceLock<Font> = OnceLock::new();
    match weight {
        Weight::Regular => REGULAR.get_or_init(|| read(include_str!("../font/regular.glyphs"))),
        Weight::Semibold => SEMIBOLD.get_or_init(|| read(include_str!("../font/semibold.glyphs"))),
    }
}

fn read(text: &str) -> Font {
    let glyph = |line: &str| {
        let mut words = line.splitn(3, ' ');
        let char = words.next().and_then(|w| u32::from_str_radix(w, 16).ok()).and_then(char::from_u32)?;
        let advance = words.next()?.parse().ok()?;
        Some((char, Glyph { advance, steps: steps(words.next().unwrap_or_default()) }))
    };
    text.lines().filter_map(glyph).collect()
}

/// An outline: M, L and Q with their points, Z.
fn steps(text: &str) -> Vec<Step> {
    let mut all = Vec::new();
    let mut rest = text;
    while let Some(verb) = rest.chars().next() {
        rest = &rest[verb.len_utf8()..];
        let end = rest.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let numbers: Vec<f64> = rest[..end].split_whitespace().filter_map(|w| w.parse().ok()).collect();
        rest = &rest[end..];
        match (verb, numbers.as_slice()) {
            ('M', [x, y]) => all.push(Step::Move([*x, *y])),
            ('L', [x, y]) => all.push(Step::Line([*x, *y])),
            ('Q', [a, b, x, y]) => all.push(Step::Quad([*a, *b], [*x, *y])),
            ('Z', []) => all.push(Step::Close),
            _ => {}
        }
    }
    all
}

/// The figure or sign that a raised character is made of.
fn raised(char: char) -> Option<char> {
    const FROM: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    const TO: &str = "0123456789−";
    FROM.chars().zip(TO.chars()).find(|(from, _)| *from == char).map(|(_, to)| to)
}

/// The glyphs of a text, each with its scale, its left end and how much it is raised (em).
fn layout(text: &str, weight: Weight) -> impl Iterator<Item = (&'static Glyph, f64, f64, f64)> {
    let font = font(weight);
    let mut x = 0.0;
    text.chars().filter_map(move |char| {
        let (char, size, up) = raised(char).map_or((char, 1.0, 0.0), |char| (char, RAISED.0, RAISED.1));
        let glyph = font.get(&char).or_else(|| font.get(&MISSING))?;
        let left = x;
        x += glyph.advance * size * 1e-3;
        Some((glyph, size, left, up))
    })
}

/// The width of a text set in this size.
pub fn width(text: &str, size: f64, weight: Weight) -> f64 {
    layout(text, weight).map(|(glyph, scale, _, _)| glyph.advance * scale * 1e-3).sum::<f64>() * size
}

/// The outline of a text that starts at a point of its baseline.
pub fn outline(text: &str, at: At, size: f64, weight: Weight) -> Vec<Step> {
    let mut all = Vec::new();
    for (glyph, scale, left, up) in layout(text, weight) {
        let k = 1e-3 * scale * size;
        let on = |p: At| [at[0] + left * size + p[0] * k, at[1] - up * size + p[1] * k];
        all.extend(glyph.steps.iter().map(|step| match *step {
            Step::Move(p) => Step::Move(on(p)),
            Step::Line(p) => Step::Line(on(p)),
            Step::Quad(c, p) => Step::Quad(on(c), on(p)),
            Step::Cubic(c, d, p) => Step::Cubic(on(c), on(d), on(p)),
            Step::Close => Step::Close,
        }));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_the_fonts_is_read() {
        for (weight, text) in [
            (Weight::Regular, include_str!("../font/regular.glyphs")),
            (Weight::Semibold, include_str!("../font/semibold.glyphs")),
        ] {
            assert_eq!(font(weight).len(), text.lines().count());
            let verbs = |line: &str| line.chars().filter(|c| "MLQZ".contains(*c)).count();
            for line in text.lines() {
                let path = line.splitn(3, ' ').nth(2).unwrap_or_default();
                assert_eq!(steps(path).len(), verbs(path), "{line}");
            }
        }
    }

    #[test]
    fn figures_are_equally_wide_and_a_text_is_as_wide_as_its_letters() {
        for weight in [Weight::Regular, Weight::Semibold] {
            for figure in "123456789".chars() {
                assert_eq!(width(&figure.to_string(), 10.0, weight), width("0", 10.0, weight));
            }
            assert!((width("Carom", 20.0, weight) - 2.0 * width("Carom", 10.0, weight)).abs() < 1e-12);
        }
        // What the font lacks is a dot, never nothing.
        assert!(width("漢", 10.0, Weight::Regular) > 0.0);
        assert!(width("10⁻⁶", 10.0, Weight::Regular) > width("10", 10.0, Weight::Regular));
    }
}
