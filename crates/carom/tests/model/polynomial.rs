//! When a gap closes: the times at which a polynomial falls through zero.

/// The value of a polynomial by rising powers.
fn value(p: &[f64], t: f64) -> f64 {
    p.iter().rev().fold(0.0, |sum, c| sum * t + c)
}

/// Where a function that has other signs at `a` and `b`, and rises or falls all the way between, is zero: halved until the two
/// ends are neighbours.
fn bisect(p: &[f64], mut a: f64, mut b: f64) -> f64 {
    let high = value(p, b) > 0.0;
    loop {
        let middle = 0.5 * (a + b);
        if middle <= a || middle >= b {
            return b;
        }
        if (value(p, middle) > 0.0) == high { b = middle } else { a = middle }
    }
}

/// All changes of sign in (0, end), and whether each is a fall. Between two neighbouring zeros of its derivative a polynomial
/// rises or falls all the way.
fn changes(p: &[f64], end: f64) -> Vec<(f64, bool)> {
    if p.len() < 2 {
        return Vec::new();
    }
    let slope: Vec<f64> = p.iter().enumerate().skip(1).map(|(k, c)| k as f64 * c).collect();
    let mut stops = vec![0.0];
    stops.extend(changes(&slope, end).iter().map(|c| c.0));
    stops.push(end);
    let mut found = Vec::new();
    for w in stops.windows(2) {
        let (before, after) = (value(p, w[0]) > 0.0, value(p, w[1]) > 0.0);
        if before != after {
            found.push((bisect(p, w[0], w[1]), before));
        }
    }
    found
}

/// The times in (0, end) at which the polynomial falls through zero, in order.
pub fn falls(p: &[f64], end: f64) -> Vec<f64> {
    changes(p, end).into_iter().filter(|c| c.1).map(|c| c.0).collect()
}

#[test]
fn exact_cases() {
    let near = |got: Vec<f64>, want: &[f64]| {
        println!("{got:?} {want:?}");
        assert_eq!(got.len(), want.len());
        assert!(got.iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-14));
    };
    // (t - 5)^2 - 1: falls at 4, rises at 6.
    near(falls(&[24.0, -10.0, 1.0], 100.0), &[4.0]);
    // It only comes near: (t - 10)^2 + 0.001.
    near(falls(&[100.001, -20.0, 1.0], 100.0), &[]);
    // A drop of 9 m at g = 9.81: sqrt(18/9.81).
    near(falls(&[9.0, 0.0, -0.5 * 9.81], 100.0), &[(18.0f64 / 9.81).sqrt()]);
    // (t - 1)(t - 2)(t - 3)(t - 4): falls at 1 and 3.
    near(falls(&[24.0, -50.0, 35.0, -10.0, 1.0], 100.0), &[1.0, 3.0]);
}
