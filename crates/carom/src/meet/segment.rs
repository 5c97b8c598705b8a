//! A ball and a thin wall from one point to another.
use super::ball::ball_ball_accelerated;
use super::path::Path;
use super::plane::{closing, not_negative};
use super::radial::{ANY, Radial};
use super::windows::Windows;
use crate::Vector;
use crate::vector::Exact;

/// When a ball meets the segment between two points (m): thin, met from every side, with its end points. `path` is that of
/// the centre relative to the same origin as the points, `radius` is in m and has to be positive: a point would not know on
/// which side of the segment it is.
///
/// # Accuracy
/// The error of t times the closing speed is a few units in the last place of the distances along the way, from the path's
/// start to `from` included. In the plane the side is a quadratic, in space (a wire) a quartic; the ends are quartics; with no
/// acceleration all are closed forms. Source: THEORY 5.1, 5.3.
pub fn segment<const D: usize>(path: &Path<D>, from: Vector<D>, to: Vector<D>, radius: f64) -> f64 {
    if !(radius >= 0.0) || !path.is_finite() || !from.is_finite() || !to.is_finite() {
        return f64::INFINITY;
    }
    let path = Path { position: path.position - from, ..*path };
    let edge = Edge::new(to - from);
    if !(edge.length > 0.0) {
        return ball_ball_accelerated(&path, radius);
    }
    let (low, high) = bounds([Vector::ZERO, edge.along]);
    if near(&path, low, high, radius).are_empty() {
        return f64::INFINITY;
    }
    let (after_start, before_end) = (edge.after_start(&path), edge.before_end(&path));
    let mut first = f64::INFINITY;
    let beside = after_start.not_negative().and(&before_end.not_negative());
    if D > 1 && !beside.are_empty() {
        first = earlier(first, edge.closing(&path, radius).and(&beside).first());
    }
    for (end, past) in [(Vector::ZERO, after_start), (edge.along, before_end)] {
        first = earlier(first, corner(&path, end, radius, &past.negated().not_negative()));
    }
    first
}

/// The point of the segment that is nearest to `point` (m).
pub fn nearest_on_segment<const D: usize>(point: Vector<D>, from: Vector<D>, to: Vector<D>) -> Vector<D> {
    let along = to - from;
    let s = (point - from).dot(along) / along.norm_squared();
    if !(s > 0.0) {
        from // also if the segment is a point
    } else if s < 1.0 {
        // From the nearer end, whose coordinates then round the least.
        if s < 0.5 { from + along * s } else { to + along * ((point - to).dot(along) / along.norm_squared()) }
    } else {
        to
    }
}

/// A straight piece of an obstacle, from the origin to `along`.
pub(super) struct Edge<const D: usize> {
    pub(super) along: Vector<D>,
    pub(super) length: f64,
}

impl<const D: usize> Edge<D> {
    pub(super) fn new(along: Vector<D>) -> Self {
        Self { along, length: along.norm() }
    }

    /// How far the path is past the start of the edge.
    pub(super) fn after_start(&self, path: &Path<D>) -> Reading {
        Reading::new(path, self.along, self.length, Vector::ZERO)
    }

    /// How far the path is before the end of the edge.
    pub(super) fn before_end(&self, path: &Path<D>) -> Reading {
        Reading::new(path, self.along, self.length, self.along).negated()
    }

    /// When the path closes in on the infinite line.
    pub(super) fn closing(&self, path: &Path<D>, radius: f64) -> Windows {
        let unit = self.along / self.length;
        if D == 2 {
            let across = |v: Vector<D>| unit[0] * v[1] - unit[1] * v[0];
            return closing(across(path.position), across(path.velocity), across(path.acceleration), radius);
        }
        let across = |v: Vector<D>| v - unit * v.dot(unit);
        let seen_along = Path {
            position: across(path.position),
            velocity: across(path.velocity),
            acceleration: across(path.acceleration),
        };
        Radial::new(&seen_along).falls(radius, ANY)
    }
}

/// When the path meets the point `corner`, while it is over it.
pub(super) fn corner<const D: usize>(path: &Path<D>, corner: Vector<D>, radius: f64, over: &Windows) -> f64 {
    if over.are_empty() {
        return f64::INFINITY;
    }
    let path = Path { position: path.position - corner, ..*path };
    // Cheaper than a quartic, dearer than the closed form.
    let bent = path.acceleration != Vector::ZERO;
    if bent && near(&path, Vector::ZERO, Vector::ZERO, radius).and(over).are_empty() {
        return f64::INFINITY;
    }
    Radial::new(&path).falls(radius, ANY).and(over).first()
}

/// When a path is within `reach` of a box: outside these windows there is no need to ask further. They are wider than the
/// true ones by what may round.
pub(super) fn near<const D: usize>(path: &Path<D>, low: Vector<D>, high: Vector<D>, reach: f64) -> Windows {
    let mut near = Windows::ALWAYS;
    for k in 0..D {
        let (x, v, a) = (path.position[k], path.velocity[k], path.acceleration[k]);
        let slack = SLACK * (x.abs_() + low[k].abs_() + high[k].abs_() + reach) + reach;
        let (per_time, per_time_squared) = (SLACK * v.abs_(), SLACK * a.abs_());
        near = near.and(&not_negative(x - low[k] + slack, v + per_time, a + per_time_squared));
        if near.are_empty() {
            break;
        }
        near = near.and(&not_negative(high[k] - x + slack, per_time - v, per_time_squared - a));
        if near.are_empty() {
            break;
        }
    }
    near
}

/// How far a path is along a direction, as a quadratic in time, and how far that may be off by rounding: the parts of an
/// obstacle are widened by so much, and overlap where otherwise a seam between them would belong to neither.
#[derive(Clone, Copy)]
pub(super) struct Reading {
    value: [f64; 3],
    slack: [f64; 3],
}

/// A scalar product of three terms, a difference before it and the two steps of a path round by less than this.
const SLACK: f64 = 32.0 * f64::EPSILON;

impl Reading {
    /// (path - origin).direction; `size` is the length of the direction, or a bound.
    pub(super) fn new<const D: usize>(path: &Path<D>, direction: Vector<D>, size: f64, origin: Vector<D>) -> Self {
        let value = [path.position - origin, path.velocity, path.acceleration].map(|v| v.dot(direction));
        let slack = [path.position.norm() + origin.norm(), path.velocity.norm(), path.acceleration.norm()];
        Self { value, slack: slack.map(|length| SLACK * size * length) }
    }

    pub(super) fn negated(self) -> Self {
        Self { value: self.value.map(|x| -x), ..self }
    }

    /// When it is positive, or zero within rounding.
    pub(super) fn not_negative(&self) -> Windows {
        let [c, b, a] = self.value;
        let [slack, per_time, per_time_squared] = self.slack;
        not_negative(c + slack, b + per_time, a + per_time_squared)
    }
}

/// The lowest and the highest coordinates of some points.
pub(super) fn bounds<const D: usize, const N: usize>(points: [Vector<D>; N]) -> (Vector<D>, Vector<D>) {
    let lowest = |sign: f64| Vector::from_fn(|k| points.iter().fold(f64::INFINITY, |low, p| earlier(low, sign * p[k])));
    (lowest(1.0), -lowest(-1.0))
}

#[inline(always)]
pub(super) fn earlier(s: f64, t: f64) -> f64 {
    if t < s { t } else { s }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEVER: f64 = f64::INFINITY;
    const FROM: Vector<2> = Vector([0.0, 0.0]);
    const TO: Vector<2> = Vector([4.0, 0.0]);

    fn meet(x: [f64; 2], v: [f64; 2], a: [f64; 2], radius: f64) -> f64 {
        segment(&Path::new(x, v, a), FROM, TO, radius)
    }

    #[test]
    fn from_both_sides_and_at_the_ends() {
        let still = [0.0, 0.0];
        for side in [1.0, -1.0] {
            assert_eq!(meet([2.0, 5.0 * side], [0.0, -2.0 * side], still, 1.0), 2.0);
            assert_eq!(meet([2.0, 5.0 * side], [0.0, 2.0 * side], still, 1.0), NEVER);
            assert_eq!(meet([0.0, 5.0 * side], [0.0, -2.0 * side], still, 1.0), 2.0); // just over the end
            assert_eq!(meet([4.0, 5.0 * side], [0.0, -2.0 * side], still, 1.0), 2.0);
            assert_eq!(meet([4.6, 5.0 * side], [0.0, -side], still, 1.0), 4.2); // an end point, 3-4-5
            assert_eq!(meet([5.0, 5.0 * side], [0.0, -side], still, 1.0), NEVER); // past it, grazing
            assert_eq!(meet([2.0, 9.0 * side], [0.0, 0.0], [0.0, -4.0 * side], 1.0), 2.0);
            // After a bounce: back on it after 2 s, or off its end by then.
            assert_eq!(meet([1.0, 1.0 * side], [1.0, 4.0 * side], [0.0, -4.0 * side], 1.0), 2.0);
            assert_eq!(meet([1.0, 1.0 * side], [4.0, 4.0 * side], [0.0, -4.0 * side], 1.0), NEVER);
        }
        assert_eq!(meet([-5.0, 0.0], [1.0, 0.0], still, 1.0), 4.0);
        assert_eq!(meet([9.0, 0.0], [-1.0, 0.0], still, 1.0), 4.0);
    }

    #[test]
    fn overlapping_a_little() {
        let g = [0.0, -9.81];
        for gap in [0.0, -1e-16, -1e-9, -0.1] {
            let y = 1.0 + gap;
            assert_eq!(meet([2.0, y], [3.0, -1.0], g, 1.0), 0.0);
            assert_eq!(meet([2.0, -y], [3.0, 1.0], g, 1.0), 0.0);
            assert_eq!(meet([2.0, -y], [3.0, -1.0], g, 1.0), NEVER);
            assert_eq!(meet([2.0, y], [0.0, 0.0], [0.0; 2], 1.0), NEVER);
            let next = meet([2.0, y], [0.0, 3.0], g, 1.0);
            assert!((next - (3.0 + (9.0 + 2.0 * 9.81 * gap).sqrt()) / 9.81).abs() < 1e-15, "{gap} {next}");
        }
    }

    #[test]
    fn a_point_and_a_wire() {
        let path = Path::new([-5.0, 0.0], [1.0, 0.0], [0.0, 0.0]);
        assert_eq!(segment(&path, FROM, FROM, 1.0), 4.0);
        let path = Path::new([-5.0, 0.6, 3.0], [1.0, 0.0, 0.0], [0.0; 3]);
        let (low, high) = (Vector([0.0, 0.0, -9.0]), Vector([0.0, 0.0, 9.0]));
        assert!((segment(&path, low, high, 1.0) - 4.2).abs() < 1e-15);
        assert_eq!(segment(&path, low, Vector([0.0, 0.0, 1.0]), 1.0), NEVER);
        let path = Path::new([-5.0], [1.0], [0.0]);
        assert_eq!(segment(&path, Vector([0.0]), Vector([2.0]), 1.0), 4.0);
    }

    #[test]
    fn the_nearest_point() {
        assert_eq!(nearest_on_segment(Vector([1.0, 3.0]), FROM, TO), Vector([1.0, 0.0]));
        assert_eq!(nearest_on_segment(Vector([-1.0, 3.0]), FROM, TO), FROM);
        assert_eq!(nearest_on_segment(Vector([7.0, 3.0]), FROM, TO), TO);
        assert_eq!(nearest_on_segment(Vector([7.0, 3.0]), FROM, FROM), FROM);
    }
}
