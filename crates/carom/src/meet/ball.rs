//! Two balls, or a ball and a point: the distance of the centres falls to the reach.
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

#[cfg(test)]
mod tests {
    use super::*;

    const NEVER: f64 = f64::INFINITY;

    #[test]
    fn exact_values() {
        let meet = |x: [f64; 3], v: [f64; 3], reach| ball_ball(Vector(x), Vector(v), reach);
        assert_eq!(meet([-5.0, 0.0, 0.0], [1.0, 0.0, 0.0], 1.0), 4.0);
        assert_eq!(meet([-5.0, 3.0, 0.0], [1.0, 0.0, 0.0], 5.0), 1.0);
        assert_eq!(meet([-13.0, 5.0, 0.0], [2.0, 0.0, 0.0], 13.0), 0.5);
        assert!((meet([-10.0, 0.6, 0.0], [3.0, 0.0, 0.0], 1.0) - 46.0 / 15.0).abs() < 1e-15);
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
    fn what_is_not_a_number_never_meets() {
        let nan = f64::NAN;
        assert_eq!(ball_ball(Vector([nan, 0.0]), Vector([-1.0, 0.0]), 1.0), NEVER);
        assert_eq!(ball_ball(Vector([3.0, 0.0]), Vector([nan, 0.0]), 1.0), NEVER);
        assert_eq!(ball_ball(Vector([3.0, 0.0]), Vector([-1.0, 0.0]), nan), NEVER);
        assert_eq!(ball_ball(Vector([f64::NEG_INFINITY, 0.0]), Vector([1.0, 0.0]), 1.0), NEVER);
    }
}
