//! Numbers on pictures: how many decimals, and where the ticks of an axis stand.

/// The power of ten of a number's first figure.
fn order(x: f64) -> i32 {
    if x.abs() > 0.0 && x.is_finite() { libm::floor(libm::log10(x.abs()) + 1e-9) as i32 } else { 0 }
}

/// A number that is one of many up to `scale`: three figures of the largest of them, always as many decimals.
pub fn fixed(x: f64, scale: f64) -> String {
    let k = order(scale);
    if (-4..6).contains(&k) {
        let decimals = (2 - k).clamp(0, 6) as usize;
        return signed(&format!("{x:.decimals$}"));
    }
    scientific(x / 10f64.powi(k), 2, k)
}

/// A number by itself, with at most `figures` figures and no zeros at its end.
pub fn short(x: f64, figures: i32) -> String {
    let k = order(x);
    if x == 0.0 || (-4..6).contains(&k) {
        let decimals = (figures - 1 - k).clamp(0, 9) as usize;
        return signed(&trimmed(&format!("{x:.decimals$}")));
    }
    scientific(x / 10f64.powi(k), (figures - 1).clamp(0, 9) as usize, k)
}

fn scientific(mantissa: f64, decimals: usize, power: i32) -> String {
    let mantissa = trimmed(&format!("{mantissa:.decimals$}"));
    let ten = format!("10{}", raised(power));
    if mantissa == "1" { ten } else { format!("{} × {ten}", signed(&mantissa)) }
}

/// A whole number in raised figures.
pub fn raised(n: i32) -> String {
    const FIGURES: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| if c == '-' { '⁻' } else { FIGURES[c.to_digit(10).unwrap_or(0) as usize] };
    n.to_string().chars().map(digit).collect()
}

fn trimmed(text: &str) -> String {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text.to_owned() }
}

/// With a minus that is as wide as a plus, and none before zero.
fn signed(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(zero) if zero.chars().all(|c| c == '0' || c == '.') => zero.to_owned(),
        Some(rest) => format!("−{rest}"),
        None => text.to_owned(),
    }
}

/// The largest of 1, 2 and 5 times a power of ten that is at most `x`.
pub fn nice_below(x: f64) -> f64 {
    if !(x > 0.0) || !x.is_finite() {
        return 1.0;
    }
    let ten = 10f64.powi(order(x));
    [5.0, 2.0, 1.0].map(|m| m * ten).into_iter().find(|n| *n <= x * (1.0 + 1e-9)).unwrap_or(ten)
}

/// Ticks between two ends, about so many of them, and their labels.
pub fn ticks(low: f64, high: f64, about: usize) -> Vec<(f64, String)> {
    let room = high - low;
    if !(room > 0.0) || !room.is_finite() {
        return Vec::new();
    }
    let least = room / about.max(1) as f64;
    let ten = 10f64.powi(order(least));
    let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * ten).into_iter().find(|s| *s >= least * (1.0 - 1e-9)).unwrap_or(least);
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    if !(last - first < 1000.0) {
        return Vec::new();
    }
    let top = low.abs().max(high.abs());
    let (power, by) = if (-4..6).contains(&order(top)) { (0, 1.0) } else { (order(top), 10f64.powi(order(top))) };
    let decimals = (-order(step / by)).clamp(0, 9) as usize;
    let label = |x: f64| {
        let text = signed(&format!("{:.decimals$}", x / by));
        if power == 0 || x == 0.0 { text } else { format!("{text}×10{}", raised(power)) }
    };
    (0..=(last - first) as i64).map(|k| (first + k as f64) * step).map(|x| (x, label(x))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_written_as_people_write_them() {
        assert_eq!(
            [0.0, 5.44, 0.3333333, 120.0, 1e-7, 2.5e8].map(|x| short(x, 3)),
            ["0", "5.44", "0.333", "120", "10⁻⁷", "2.5 × 10⁸"]
        );
        assert_eq!([0.0, 5.4375, -0.001].map(|x| fixed(x, 9.5)), ["0.00", "5.44", "0.00"]);
        assert_eq!(fixed(-12.0, 950.0), "−12");
        assert_eq!([0.99, 1.0, 4.9, 5.0, 70.0].map(nice_below), [0.5, 1.0, 2.0, 5.0, 50.0]);
        assert!((nice_below(0.3) - 0.2).abs() < 1e-12);
    }

    #[test]
    fn ticks_are_round_and_between_the_ends() {
        let labels = |low, high, n| -> Vec<String> { ticks(low, high, n).into_iter().map(|t| t.1).collect() };
        assert_eq!(labels(0.0, 1.0, 5), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(-1.5, 3.0, 5), ["−1", "0", "1", "2", "3"]);
        assert_eq!(labels(0.0, 2e-6, 2), ["0", "1×10⁻⁶", "2×10⁻⁶"]);
        assert!(ticks(1.0, 1.0, 5).is_empty() && ticks(f64::NAN, 1.0, 5).is_empty());
    }
}
