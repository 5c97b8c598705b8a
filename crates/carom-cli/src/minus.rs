//! Negative numbers and lists on the command line, bare and with `=`: `--velocity -1,2 -3,0`, `--velocity=3 -1`.
//!
//! The argument parser takes `-1,2` for an option and ends a list at `=`. So before it looks, `--velocity=3 -1` becomes
//! `--velocity 3 -1`, and the hyphen in front of a number becomes a minus sign (U+2212), which [`number`] reads as well, also
//! where it was copied from a printed page.
use std::ffi::OsString;

/// Options that take numbers, possibly several.
const NUMBERS: [&str; 10] =
    ["mass", "velocity", "normal", "spin", "radius", "inertia", "restitution", "friction", "tangential", "duration"];

/// The command line with its negative numbers made readable; only that of `explain` has any.
pub fn readable(arguments: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut all: Vec<OsString> = arguments.collect();
    if all.get(1).is_none_or(|verb| verb != "explain") {
        return all;
    }
    let options = all.split_off(2);
    for argument in options {
        let Some(text) = argument.to_str() else {
            all.push(argument);
            continue;
        };
        match text.strip_prefix("--").and_then(|t| t.split_once('=')) {
            Some((name, value)) if NUMBERS.contains(&name) => {
                all.push(format!("--{name}").into());
                all.push(minus(value).into());
            }
            _ => all.push(minus(text).into()),
        }
    }
    all
}

/// A text that begins with a negative number, with a minus sign for its hyphen.
fn minus(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit() || c == '.') || rest.starts_with("inf") => {
            format!("−{rest}")
        }
        _ => text.into(),
    }
}

/// A number, with a hyphen or a minus sign in front of a negative one; `inf` for an infinite one.
pub fn number(text: &str) -> Result<f64, String> {
    let trimmed = text.trim();
    let number = trimmed.replace('−', "-").replace('∞', "inf");
    number.parse().map_err(|_| {
        if trimmed.is_empty() { "a number is missing".to_string() } else { format!("'{trimmed}' is not a number") }
    })
}

/// A list of numbers with commas between: 3,-1.
pub fn list(text: &str) -> Result<Vec<f64>, String> {
    text.split(',').map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(line: &str) -> String {
        let arguments = readable(line.split(' ').map(OsString::from));
        arguments.iter().map(|a| a.to_str().unwrap()).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn hyphens_before_numbers() {
        assert_eq!(seen("carom explain --velocity -1,2 -3,0"), "carom explain --velocity −1,2 −3,0");
        assert_eq!(seen("carom explain --velocity=-1 -.5"), "carom explain --velocity −1 −.5");
        assert_eq!(seen("carom explain --mass -inf --lang=en -h"), "carom explain --mass −inf --lang=en -h");
        assert_eq!(seen("carom run -1 --velocity=3"), "carom run -1 --velocity=3");
    }

    #[test]
    fn numbers_and_lists() {
        assert_eq!(list("−1,2.5e-3"), Ok(vec![-1.0, 2.5e-3]));
        assert_eq!(number("inf"), Ok(f64::INFINITY));
        assert_eq!(list("1,").unwrap_err(), "a number is missing");
        assert_eq!(list("3m").unwrap_err(), "'3m' is not a number");
    }
}
