//! One coordinate, moving as c + b t + a t^2 / 2: a ball and a plane, a body and the wall of its cell.
use super::windows::Windows;
use crate::vector::Exact;

/// When a ball meets a plane: `height` (m) is that of its centre over the plane, `speed` (m/s) and `acceleration` (m/s^2) are
/// its derivatives, `radius` is in m. The ball lives on the positive side; what is below it by any depth overlaps.
///
/// # Accuracy
/// Closed form without cancellation: a few units in the last place of t, except close to grazing, where only the
/// discriminant's rounding counts. Source: THEORY 5.3.
#[inline]
pub fn plane(height: f64, speed: f64, acceleration: f64, radius: f64) -> f64 {
    let c = height - radius;
    let (start, end) = falling(speed, acceleration);
    let t = later(start, falls_to_zero(c, speed, acceleration));
    if t < end && !(c + speed + acceleration).is_nan() { t } else { f64::INFINITY }
}

/// When a coordinate leaves the interval [`low`, `high`] (m; either may be infinite): the first time it is at a wall or
/// beyond while moving outward. On a wall, or outside, and moving inward it does not fire.
#[inline]
pub fn exit(position: f64, speed: f64, acceleration: f64, low: f64, high: f64) -> f64 {
    let below = plane(position - low, speed, acceleration, 0.0);
    let above = plane(high - position, -speed, -acceleration, 0.0);
    if above < below { above } else { below }
}

/// The windows in which the magnitude of c + b t + a t^2 / 2 falls, from `radius` at most.
pub(super) fn closing(c: f64, b: f64, a: f64, radius: f64) -> Windows {
    let mut windows = Windows::NEVER;
    for (c, b, a) in [(c, b, a), (-c, -b, -a)] {
        let (start, end) = falling(b, a);
        let to_zero = falls_to_zero(c, b, a);
        windows.add(later(start, falls_to_zero(c - radius, b, a)), if to_zero < end { to_zero } else { end });
    }
    windows
}

/// The windows in which c + b t + a t^2 / 2 >= 0.
pub(super) fn not_negative(c: f64, b: f64, a: f64) -> Windows {
    // It falls to zero once at most and, mirrored, rises to zero once at most.
    let (falls_from, falls_until) = falling(b, a);
    let (rises_from, rises_until) = falling(-b, -a);
    let mut windows = Windows::NEVER;
    let falls = falls_to_zero(c, b, a);
    windows.add(falls_from, if falls < falls_until { falls } else { falls_until });
    windows.add(later(rises_from, falls_to_zero(-c, -b, -a)), rises_until);
    if b == 0.0 && a == 0.0 && c >= 0.0 {
        return Windows::ALWAYS;
    }
    windows
}

/// Where c + b t + a t^2 / 2, with a > 0, has fallen to zero and where it has risen to zero again; infinite where it never is.
pub(super) fn roots(c: f64, b: f64, a: f64) -> (f64, f64) {
    let fall = if b < 0.0 { falls_to_zero(c, b, a) } else { f64::INFINITY };
    (fall, falls_to_zero(-c, -b, -a))
}

/// The span of t >= 0 in which b + a t < 0; empty if its end is not after its start.
#[inline(always)]
fn falling(b: f64, a: f64) -> (f64, f64) {
    if a > 0.0 {
        (0.0, if b < 0.0 { -b / a } else { 0.0 })
    } else if a < 0.0 {
        (if b > 0.0 { -b / a } else { 0.0 }, f64::INFINITY)
    } else {
        (0.0, if b < 0.0 { f64::INFINITY } else { 0.0 })
    }
}

/// The time (of either sign) at which c + b t + a t^2 / 2 falls through zero; -infinity if it is never positive, +infinity if
/// it is never negative, or not before numbers end. Of use only where [`falling`] is not empty.
#[inline(always)]
fn falls_to_zero(c: f64, b: f64, a: f64) -> f64 {
    // b^2 - 2 a c, without losing what is left where the two are close.
    let product = 2.0 * a * c;
    let discriminant = if product > 0.0 {
        let root = product.sqrt_();
        (b.abs_() - root) * (b.abs_() + root)
    } else {
        b * b - product
    };
    if !(discriminant > 0.0 && discriminant < f64::INFINITY) {
        return if c > 0.0 { f64::INFINITY } else { f64::NEG_INFINITY };
    }
    let root = discriminant.sqrt_();
    if b < 0.0 { 2.0 * c / (root - b) } else { -(b + root) / a }
}

/// The later of two times.
#[inline(always)]
fn later(s: f64, t: f64) -> f64 {
    if t > s { t } else { s }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEVER: f64 = f64::INFINITY;

    #[test]
    fn a_ball_over_a_floor() {
        let fall = plane(10.0, 0.0, -9.81, 1.0);
        assert!((fall - 1.3545709229571927).abs() < 3e-16);
        assert_eq!(plane(10.0, -3.0, 0.0, 1.0), 3.0);
        assert_eq!(plane(10.0, -3.0, 0.5, 1.0), NEVER); // touches at t = 6, grazing
        assert_eq!(plane(10.0, 3.0, 0.0, 1.0), NEVER);
        assert_eq!(plane(10.0, 0.0, 0.0, 1.0), NEVER);
        assert_eq!(plane(1.5, 2.0, -8.0, 1.0), (2.0 + 12.0_f64.sqrt()) / 8.0);
    }

    #[test]
    fn touching() {
        assert_eq!(plane(1.0, -1.0, 0.0, 1.0), 0.0);
        assert_eq!(plane(1.0, -1.0, 9.81, 1.0), 0.0);
        assert_eq!(plane(1.0, 0.0, -9.81, 1.0), 0.0);
        assert_eq!(plane(1.0, 0.0, 0.0, 1.0), NEVER);
        assert_eq!(plane(1.0, 0.0, 9.81, 1.0), NEVER);
        assert_eq!(plane(1.0, 1.0, 0.0, 1.0), NEVER);
    }

    #[test]
    fn after_an_impact_the_next_bounce_is_2v_over_g() {
        for height in [1.0, 1.0_f64.next_down(), 1.0_f64.next_up()] {
            for v in [1e-6, 1e-3, 1.0, 1e3] {
                let next = plane(height, v, -9.81, 1.0);
                assert!((next * 9.81 / (2.0 * v) - 1.0).abs() < 5e-16 + 2e-15 / (v * v), "{height} {v} {next}");
            }
        }
    }

    #[test]
    fn overlapping() {
        assert_eq!(plane(0.9, -1.0, 0.0, 1.0), 0.0);
        assert_eq!(plane(0.9, 1.0, 0.0, 1.0), NEVER);
        assert_eq!(plane(0.9, 0.5, -9.81, 1.0), 0.5 / 9.81); // the turning point, not out yet
        assert!((plane(0.9, 3.0, -9.81, 1.0) - 0.5762408681276348).abs() < 2e-16);
        assert_eq!(plane(-50.0, -1.0, 0.0, 1.0), 0.0);
    }

    #[test]
    fn cells() {
        assert_eq!(exit(0.5, 1.0, 0.0, 0.0, 2.0), 1.5);
        assert_eq!(exit(0.5, -1.0, 0.0, 0.0, 2.0), 0.5);
        assert_eq!(exit(0.0, 1.0, 0.0, 0.0, 2.0), 2.0);
        assert_eq!(exit(0.0, -1.0, 0.0, 0.0, 2.0), 0.0);
        assert_eq!(exit(-1e-9, 1.0, 0.0, 0.0, 2.0), 2.0 + 1e-9);
        assert_eq!(exit(0.5, 0.0, 0.0, 0.0, 2.0), NEVER);
        assert_eq!(exit(0.0, 2.0, -4.0, 0.0, 2.0), 1.0);
        let (inf, no) = (f64::INFINITY, f64::NEG_INFINITY);
        for a in [-1.0, 0.0, 1.0] {
            for v in [-1.0, 0.0, 1.0] {
                assert_eq!(exit(0.5, v, a, no, inf), NEVER, "{v} {a}");
            }
        }
        assert_eq!(exit(0.5, -2.0, 0.0, 0.0, inf), 0.25);
        assert_eq!(exit(0.5, 2.0, 0.0, no, 1.0), 0.25);
    }

    #[test]
    fn what_is_not_a_number_never_meets() {
        let good = [0.5, -1.0, -1.0, 1.0];
        for k in 0..4 {
            let mut bad = good;
            bad[k] = f64::NAN;
            assert_eq!(plane(bad[0], bad[1], bad[2], bad[3]), NEVER, "{bad:?}");
        }
        assert_eq!(exit(f64::NAN, -1.0, 0.0, 0.0, 1.0), NEVER);
    }

    #[test]
    fn both_sides_close_in() {
        // |8 - t| falls from 3 to 0 in [5, 8]; |t^2/2 - 8| from 3 in [sqrt 10, 4]; |8 - t^2/2| is the same.
        assert_eq!(closing(8.0, -1.0, 0.0, 3.0).first(), 5.0);
        for sign in [1.0, -1.0] {
            let windows = closing(-8.0 * sign, 0.0, sign, 3.0);
            assert!((windows.first() - 10.0_f64.sqrt()).abs() < 1e-15);
            assert!(windows.and(&not_negative(4.0 - 1e-15, -1.0, 0.0)).first() < 4.0);
            assert!(windows.and(&not_negative(-4.0, 1.0, 0.0)).are_empty());
        }
    }

    #[test]
    fn when_a_quadratic_is_not_negative() {
        let first = |c, b, a| not_negative(c, b, a).first();
        assert_eq!(first(-1.0, 1.0, 0.0), 1.0);
        assert_eq!(first(1.0, -1.0, 0.0), 0.0);
        assert_eq!(first(-1.0, -1.0, 0.0), NEVER);
        assert_eq!(first(-1.0, -1.0, 4.0), 1.0);
        assert_eq!(first(-4.0, 5.0, -2.0), 1.0);
        assert_eq!(first(-4.0, 4.0, -3.0), NEVER);
        assert_eq!(first(-1.0, 0.0, 0.0), NEVER);
        assert_eq!(first(-1.0, -1e-170, 0.0), NEVER);
        assert_eq!(first(-1.0, 0.0, 0.02), 10.0);
        assert_eq!(first(0.0, 0.0, 0.0), 0.0);
    }
}
