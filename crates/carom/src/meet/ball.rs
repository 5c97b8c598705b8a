//! Two balls, or a ball and a point: the distance of the centres falls to the reach.
use super::path::Path;
use super::radial::{ANY, Radial};
use crate::Vector;
use crate::vector::Exact;

/// When two balls meet whose centres move uniformly relative to each other: `position` (m) and `velocity` (m/s) are those of
/// the second centre relative to the first, `reach` (m) the sum of the radii.
///
/// Uniform gravity acts on both alike and cancels; only where one of them feels another acceleration is
/// `ball_ball_accelerated` needed. For lengths and speeds between 1e-140 and 1e140.
///
/// # Accuracy
/// The discriminant is that of the geometry, (R - |l|)(R + |l|) with l the foot of the perpendicular on the path: the error
/// of t times the speed is about 1e-15 of the distance, where the textbook form b^2 - a c loses 6e-2 R at 1e7 R. Touching on
/// the way past is no event. Source: THEORY 5.2.
#[inline(always)]
pub fn ball_ball<const D: usize>(position: Vector<D>, velocity: Vector<D>, reach: f64) -> f64 {
    let b = position.dot(velocity);
    if !(b < 0.0) {
        return f64::INFINITY; // parting, passing, or not a number
    }
    let distance = position.norm_squared().sqrt_();
    let c = (distance - reach) * (distance + reach);
    if c <= 0.0 {
        return 0.0;
    }
    let a = velocity.norm_squared();
    let miss = (position - velocity * (b / a)).norm_squared().sqrt_();
    let d = (reach - miss) * (reach + miss);
    if !(d > 0.0) {
        return f64::INFINITY;
    }
    c / ((a * d).sqrt_() - b)
}

/// When a ball meets another ball, or a point, that does not share its acceleration: `path` is that of its centre relative to
/// the other's, `reach` (m) the sum of the radii.
///
/// # Accuracy
/// The error of t times the closing speed is a few units in the last place of the distances along the way. The quartic is
/// solved on the pieces on which it is monotone, in the form |x + v t + a t^2 / 2| - R. Source: THEORY 5.3.
pub fn ball_ball_accelerated<const D: usize>(path: &Path<D>, reach: f64) -> f64 {
    if !(reach >= 0.0) || !path.is_finite() {
        return f64::INFINITY;
    }
    Radial::new(path).falls(reach, ANY).first()
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEVER: f64 = f64::INFINITY;

    #[test]
    fn exact_values() {
        let meet = |x: [f64; 3], v: [f64; 3], reach| ball_ball(Vector(x), Vector(v), reach);
        assert_eq!(meet([-5.0, 0.0, 0.0], [1.0, 0.0, 0.0], 1.0), 4.0);
        assert!((meet([-5.0, 3.0, 0.0], [1.0, 0.0, 0.0], 5.0) - 1.0).abs() < 1e-15);
        assert!((meet([-13.0, 5.0, 0.0], [2.0, 0.0, 0.0], 13.0) - 0.5).abs() < 1e-15);
        assert!((meet([-10.0, 0.6, 0.0], [3.0, 0.0, 0.0], 1.0) - 46.0 / 15.0).abs() < 2e-15);
        assert_eq!(meet([-10.0, 1.0, 0.0], [1.0, 0.0, 0.0], 1.0), NEVER); // grazing at t = 10
        assert_eq!(meet([-10.0, 1.0 - 1e-13, 0.0], [1.0, 0.0, 0.0], 1.0).floor(), 9.0);
        assert_eq!(ball_ball(Vector([3.0]), Vector([-1.0]), 1.0), 2.0);
    }

    #[test]
    fn touching_and_overlapping() {
        let meet = |x, v| ball_ball(Vector([x, 0.0]), Vector([v, 1.0]), 1.0);
        for x in [1.0, 1.0_f64.next_down(), 0.9] {
            assert_eq!(meet(x, -1.0), 0.0);
            assert_eq!(meet(x, -1e-9), 0.0);
            assert_eq!(meet(x, 0.0), NEVER);
            assert_eq!(meet(x, 1.0), NEVER);
        }
        assert_eq!(ball_ball(Vector([0.5, 0.0]), Vector::ZERO, 1.0), NEVER);
    }

    #[test]
    fn exact_values_under_gravity() {
        let g = [0.0, 0.0, -9.81];
        for (x, v, t) in [
            ([0.0, 0.0, 10.0], [0.0, 0.0, 0.0], 1.3545709229571927),
            ([-5.0, 0.0, 0.0], [5.0, 0.0, 4.905], 0.8461060230051147),
            ([-5.0, 0.0, 2.0], [4.0, 0.0, 3.0], 1.0009773894041392),
            ([0.5, 0.0, 5.0], [0.0, 0.0, 0.0], 0.9180459010836803),
            ([0.0, 0.0, 0.9], [0.0, 0.0, -1.0], 0.0),
            ([0.0, 0.0, 0.9], [0.0, 0.0, 0.5], 0.0509683995922528),
            ([0.0, 0.0, 0.9], [0.0, 0.0, 3.0], 0.5762408681276348),
            ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0], 0.0),
            ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], 0.0),
            ([0.0, 0.0, 1.0], [0.0, 0.0, 9.81], 2.0),
        ] {
            let found = ball_ball_accelerated(&Path::new(x, v, g), 1.0);
            assert!((found - t).abs() <= 3e-16 * (1.0 + t), "{x:?} {v:?}: {found} {t}");
        }
        assert_eq!(ball_ball_accelerated(&Path::new([3.0, 0.0, -4.0], [-2.0, 0.0, 8.0], g), 1.0), NEVER);
        assert_eq!(ball_ball_accelerated(&Path::new([0.0, 0.0, 0.9], [0.0, 0.0, 1.0], [0.0; 3]), 1.0), NEVER);
        assert_eq!(ball_ball_accelerated(&Path::new([0.0, 0.0, -1.0], [0.0, 0.0, 0.0], g), 1.0), NEVER);
    }

    #[test]
    fn the_next_bounce_on_a_point_is_2v_over_g() {
        for height in [1.0, 1.0_f64.next_down(), 1.0_f64.next_up()] {
            for v in [1e-6, 1e-3, 1.0, 1e3] {
                let next = ball_ball_accelerated(&Path::new([0.0, height], [0.0, v], [0.0, -9.81]), 1.0);
                // The height's rounding, 2.2e-16, counts by c g / (2 v^2), and so do those of the way, 1e-16 (1 + v^2 / g).
                assert!((next * 9.81 / (2.0 * v) - 1.0).abs() < 4e-16 + 4e-15 / (v * v), "{height} {v} {next}");
            }
        }
    }

    #[test]
    fn hardly_any_acceleration() {
        for exponent in [-8, -30, -100, -150, -170, -300, -320] {
            let pull = 10.0_f64.powi(exponent);
            let t = ball_ball_accelerated(&Path::new([-5.0, 0.0], [1.0, 0.0], [0.0, pull]), 1.0);
            assert!((t - 4.0).abs() < 1e-14, "{exponent} {t}");
            let back = ball_ball_accelerated(&Path::new([-5.0, 0.0], [-1.0, 0.0], [pull, 0.0]), 1.0);
            // Back after 2 / pull s, and 4 s that do not count; past 1e16 s the time itself is coarser than the ball.
            assert!((back * pull / 2.0 - 1.0).abs() < 5e-8 || exponent < -12, "{exponent} {back}");
        }
    }

    #[test]
    fn what_is_not_a_number_never_meets() {
        let nan = f64::NAN;
        assert_eq!(ball_ball(Vector([nan, 0.0]), Vector([-1.0, 0.0]), 1.0), NEVER);
        assert_eq!(ball_ball(Vector([3.0, 0.0]), Vector([nan, 0.0]), 1.0), NEVER);
        assert_eq!(ball_ball(Vector([3.0, 0.0]), Vector([-1.0, 0.0]), nan), NEVER);
        assert_eq!(ball_ball(Vector([f64::NEG_INFINITY, 0.0]), Vector([1.0, 0.0]), 1.0), NEVER);
    }
}
