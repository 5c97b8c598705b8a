//! Decimal numbers in the lab's modules, rounded correctly. The standard library's reader does the same faster, by ten kilobytes of
//! powers of five that do not compress: a page reads a few numbers and would rather load less.
//!
//! The number is a fraction of two whole numbers of any length; its bits are those of their quotient, one by one, and the rest says
//! how the last is rounded (to even at half).
use core::cmp::Ordering;

/// Digits that can matter: a number halfway between two of 53 bits has at most 767 (Steele and White 1990), and one more says
/// whether anything follows.
const DIGITS: usize = 800;

/// The number nearest to `text`, which is digits with a sign, a point and an exponent, as JSON has them; `None` if it is not.
pub(crate) fn read(text: &str) -> Option<f64> {
    let (sign, rest) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
    let (digits, exponent) = match rest.split_once(['e', 'E']) {
        Some((digits, exponent)) => (digits, power(exponent)?),
        None => (rest, 0),
    };
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let all = || whole.bytes().chain(part.bytes());
    if whole.is_empty() || !all().all(|b| b.is_ascii_digit()) {
        return None;
    }
    // Digits from the first that is not nought, as a whole number times a power of ten.
    let mut kept: Vec<u8> = all().skip_while(|&b| b == b'0').map(|b| b - b'0').collect();
    let mut ten = exponent.saturating_sub(part.len() as i64);
    if kept.len() > DIGITS {
        let more = kept[DIGITS..].iter().any(|&d| d > 0);
        ten = ten.saturating_add((kept.len() - DIGITS) as i64);
        kept.truncate(DIGITS);
        if more {
            kept.push(1);
            ten = ten.saturating_sub(1);
        }
    }
    let size = ten.saturating_add(kept.len() as i64);
    Some(
        sign * if kept.is_empty() || size < -330 {
            0.0
        } else if size > 310 {
            f64::INFINITY
        } else {
            nearest(&kept, ten as i32)
        },
    )
}

/// An exponent; beyond what a number can have it only has to be large.
fn power(text: &str) -> Option<i64> {
    let (sign, digits) = match text.as_bytes() {
        [b'-', rest @ ..] => (-1, rest),
        [b'+', rest @ ..] => (1, rest),
        rest => (1, rest),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let mut size = 0_i64;
    for &b in digits {
        size = (size * 10 + i64::from(b - b'0')).min(1 << 40);
    }
    Some(sign * size)
}

/// The number nearest to these digits times that power of ten.
fn nearest(digits: &[u8], ten: i32) -> f64 {
    let power = ten.unsigned_abs();
    // Both are exact, and one division or product is rounded correctly (Clinger 1990).
    if digits.len() <= 15 && power <= 22 {
        let whole = digits.iter().fold(0_u64, |sum, &d| sum * 10 + u64::from(d)) as f64;
        let scale = (0..power).fold(1.0, |scale, _| scale * 10.0);
        return if ten < 0 { whole / scale } else { whole * scale };
    }
    let mut above = Long(Vec::new());
    for &digit in digits {
        above.times_plus(10, u32::from(digit));
    }
    let mut below = Long(vec![1]);
    let scaled = if ten < 0 { &mut below } else { &mut above };
    for _ in 0..power {
        scaled.times_plus(10, 0);
    }
    // above / below = r 2^k with r from 1 to 2.
    let mut k = above.bits() as i32 - below.bits() as i32;
    if k > 0 {
        below.shift(k as usize);
    } else {
        above.shift(k.unsigned_abs() as usize);
    }
    if above.order(&below) == Ordering::Less {
        above.shift(1);
        k -= 1;
    }
    // Below 2^-1022 bits get fewer.
    let bits = 53.min(k + 1075);
    if k > 1023 {
        return f64::INFINITY;
    }
    if bits < 0 {
        return 0.0;
    }
    let mut quotient = 0_u64;
    for _ in 0..bits {
        quotient <<= 1;
        if above.order(&below) != Ordering::Less {
            above.minus(&below);
            quotient |= 1;
        }
        above.shift(1);
    }
    let rest = above.order(&below);
    if rest == Ordering::Greater || (rest == Ordering::Equal && quotient & 1 == 1) {
        quotient += 1;
    }
    quotient as f64 * two_to(k - bits + 1)
}

/// 2^k for k from -1074 to 1023.
fn two_to(k: i32) -> f64 {
    f64::from_bits(if k >= -1022 { ((k + 1023) as u64) << 52 } else { 1 << (k + 1074) })
}

/// A whole number of any length, its least 32 bits first, without noughts at the end.
struct Long(Vec<u32>);

impl Long {
    fn times_plus(&mut self, factor: u32, more: u32) {
        let mut carry = u64::from(more);
        for word in &mut self.0 {
            carry += u64::from(*word) * u64::from(factor);
            *word = carry as u32;
            carry >>= 32;
        }
        if carry > 0 {
            self.0.push(carry as u32);
        }
    }

    fn bits(&self) -> usize {
        self.0.last().map_or(0, |top| 32 * self.0.len() - top.leading_zeros() as usize)
    }

    /// Times 2^n.
    fn shift(&mut self, n: usize) {
        if !n.is_multiple_of(32) {
            self.times_plus(1 << (n % 32), 0);
        }
        if n >= 32 {
            self.0.splice(0..0, core::iter::repeat_n(0, n / 32));
        }
    }

    fn order(&self, other: &Self) -> Ordering {
        self.0.len().cmp(&other.0.len()).then_with(|| self.0.iter().rev().cmp(other.0.iter().rev()))
    }

    /// Takes away what is not larger.
    fn minus(&mut self, other: &Self) {
        let mut borrow = 0_i64;
        for (k, word) in self.0.iter_mut().enumerate() {
            let left = i64::from(*word) - i64::from(other.0.get(k).copied().unwrap_or(0)) + borrow;
            *word = left as u32;
            borrow = left >> 32;
        }
        while self.0.last() == Some(&0) {
            self.0.pop();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::read;

    #[track_caller]
    fn same(text: &str) {
        let (ours, std) = (read(text).unwrap(), text.parse::<f64>().unwrap());
        assert_eq!(ours.to_bits(), std.to_bits(), "{text}: {ours:e} and {std:e}");
    }

    #[test]
    fn the_same_as_the_standard_library() {
        // A small generator of random bits (Marsaglia 2003).
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state
        };
        for _ in 0..3000 {
            let x = f64::from_bits(random());
            if !x.is_finite() {
                continue;
            }
            // As it is printed, with every digit, and with too many.
            for text in [format!("{x:e}"), format!("{x:.20e}"), format!("{x:.5e}")] {
                same(&text);
            }
            let near = (random() % 2_000_000) as f64 / 1e6 - 1.0;
            same(&format!("{near}"));
            same(
                &format!("{}.{}e{}", random() % 1000, random(), random() % 700)
                    .replace("e", if random() & 1 == 0 { "e" } else { "E-" }),
            );
        }
    }

    #[test]
    fn halves_and_ends() {
        for text in [
            "0",
            "-0",
            "0.0",
            "0e5",
            "000.5",
            "1",
            "-1.5",
            "9007199254740993",
            "9007199254740992.5",
            "9007199254740995",
            "1.7976931348623157e308",
            "1.7976931348623158e308",
            "1.7976931348623159e308",
            "1e309",
            "1e400",
            "1e99999999999999999999",
            "2.2250738585072011e-308",
            "2.2250738585072014e-308",
            "4.9406564584124654e-324",
            "2.4703282292062327e-324",
            "2.4703282292062328e-324",
            "2.5e-324",
            "1e-400",
            "1e-99999999999999999999",
            "123456789012345678901234567890",
            "1e22",
            "1e23",
            "8.5e22",
            "0.000001",
            "5e-324",
            "3e-324",
        ] {
            same(text);
        }
        // Just above and just below halfway, in a digit far away.
        for more in ["", "1"] {
            same(&format!("9007199254740993.{}{more}", "0".repeat(900)));
            same(&format!("9007199254740992.{}{more}", "9".repeat(900)));
        }
        // The 767 digits of the halfway point below the least number, and a little more.
        let half = format!("{:.1080}", f64::from_bits(1));
        let digits: String = half.chars().collect();
        same(&digits);
    }

    #[test]
    fn what_is_no_number() {
        for text in ["", "-", ".", ".5", "e5", "1e", "1e+", "1x", "1.2.3", "inf", "NaN", "+1"] {
            assert_eq!(read(text), None, "{text}");
        }
        assert_eq!(read("1."), Some(1.0));
    }
}
