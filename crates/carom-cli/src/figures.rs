//! Numbers for people: six digits, no noise.

/// A number with at most six digits.
pub fn short(x: f64) -> String {
    digits(x, 6)
}

/// What is smaller than this part of an account's scale is rounding, and is shown as 0.
pub const NOISE: f64 = 1e-12;

/// A number beside others of this scale, in six digits: 0 if it is nothing but rounding. (JSON has all digits.)
pub fn beside(x: f64, scale: f64) -> String {
    short(if x.abs() <= NOISE * scale { 0.0 } else { x })
}

/// A number with at most this many significant digits, without trailing zeros; very large and very small ones as 1.5e-9.
pub fn digits(x: f64, n: usize) -> String {
    if x == 0.0 {
        return "0".into();
    }
    if !x.is_finite() {
        return if x.is_nan() { "not a number".into() } else { format!("{x}") };
    }
    let scientific = format!("{x:.*e}", n - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..n as i32).contains(&exponent) {
        let places = (n as i32 - 1 - exponent).max(0) as usize;
        return trimmed(&format!("{x:.places$}"));
    }
    format!("{}e{exponent}", trimmed(mantissa))
}

fn trimmed(text: &str) -> String {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text.into() }
}

/// A vector as (1, 2); on a line just the number.
pub fn vector(v: &[f64]) -> String {
    vector_of(v, 6)
}

/// A vector with at most this many digits each.
pub fn vector_of(v: &[f64], n: usize) -> String {
    match v {
        [] => "-".into(),
        [x] => digits(*x, n),
        all => format!("({})", all.iter().map(|x| digits(*x, n)).collect::<Vec<_>>().join(", ")),
    }
}

/// A whole number with commas between the thousands.
pub fn count(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// "1 impact", "2 impacts", "10,000 impacts".
pub fn plural(n: u64, one: &str) -> String {
    let ending = match (n, one) {
        (1, _) => "".to_string(),
        (_, "body") => return format!("{} bodies", count(n)),
        _ => "s".to_string(),
    };
    format!("{} {one}{ending}", count(n))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        let all = [0.45, 0.1 + 0.2, 1.0, -0.0, 1e-9, 123456.7, 1234567.0, -2.5e-5, 1e-4, 9.99999999, f64::NAN];
        let shown = all.map(short).join(" ");
        assert_eq!(shown, "0.45 0.3 1 0 1e-9 123457 1.23457e6 -2.5e-5 0.0001 10 not a number");
        assert_eq!(vector(&[1.0, -0.5]), "(1, -0.5)");
        assert_eq!([0, 999, 1000, 1234567].map(count).join(" "), "0 999 1,000 1,234,567");
        assert_eq!(plural(1, "body") + " " + &plural(2, "body"), "1 body 2 bodies");
    }
}
