//! A ball and a thin circular wall, met from outside and from inside.
use super::path::Path;
use super::radial::Radial;
use super::segment::{Reading, corner, earlier, near};
use super::windows::Windows;
use crate::Vector;

/// A circular arc in the plane of the first two components, counter-clockwise from one angle to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc<const D: usize> {
    centre: Vector<D>,
    radius: f64,
    from: f64,
    to: f64,
    /// The unit vectors to the start, the middle and the end of the arc.
    start: [f64; 2],
    middle: [f64; 2],
    end: [f64; 2],
}

crate::codec::codec!(Arc<D> { centre, radius, from, to, start, middle, end });

impl<const D: usize> Arc<D> {
    /// The arc round `centre` (m) of this radius (m), counter-clockwise from the angle `from` to the angle `to` (rad), where
    /// `to` is not less than `from`; from 2 pi between them on it is a circle.
    pub fn new(centre: impl Into<Vector<D>>, radius: f64, from: f64, to: f64) -> Self {
        let unit = |angle| [libm::cos(angle), libm::sin(angle)];
        let middle = from + 0.5 * (to - from);
        Self { centre: centre.into(), radius, from, to, start: unit(from), middle: unit(middle), end: unit(to) }
    }

    /// The circle round `centre` (m) of this radius (m).
    pub fn circle(centre: impl Into<Vector<D>>, radius: f64) -> Self {
        Self::new(centre, radius, 0.0, core::f64::consts::TAU)
    }

    /// The centre (m).
    pub fn centre(&self) -> Vector<D> {
        self.centre
    }

    /// The radius (m).
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The angles at which it starts and ends (rad).
    pub fn angles(&self) -> (f64, f64) {
        (self.from, self.to)
    }

    /// True if it is a whole circle.
    pub fn is_circle(&self) -> bool {
        self.to - self.from >= core::f64::consts::TAU
    }

    /// True if it is a half circle or more; what is left is then the smaller sector.
    fn is_wide(&self) -> bool {
        self.to - self.from > core::f64::consts::PI
    }

    /// True for a direction from the centre that passes through the arc.
    fn covers(&self, q: [f64; 2]) -> bool {
        let (after_start, before_end) = (cross(self.start, q) >= 0.0, cross(q, self.end) >= 0.0);
        self.is_circle()
            || if self.is_wide() {
                after_start || before_end
            } else {
                after_start && before_end && dot(self.middle, q) >= 0.0
            }
    }

    fn is_sound(&self) -> bool {
        self.centre.is_finite()
            && self.radius >= 0.0
            && self.radius < f64::INFINITY
            && (self.to - self.from).is_finite()
    }
}

/// When a ball meets an arc: thin, from outside where its centre comes as close as R + r, from inside where it gets as far as
/// R - r, and at its end points. `path` is that of the ball's centre relative to the same origin as the arc's, `radius` (m, > 0)
/// is the ball's. In space the arc is a sheet, straight along the third axis and without end.
///
/// A ball that is larger than the arc (r > R) cannot be inside without overlapping: coming from there it meets the end points.
///
/// # Accuracy
/// The error of t times the closing speed is a few units in the last place of the distances along the way, from the path's
/// start to the centre included. All contacts are quartics, with no acceleration closed forms. Source: THEORY 5.1, 5.3.
pub fn arc<const D: usize>(path: &Path<D>, arc: &Arc<D>, radius: f64) -> f64 {
    if D < 2 || !(radius >= 0.0) || !path.is_finite() || !arc.is_sound() {
        return f64::INFINITY;
    }
    let flat = |v: Vector<D>| Vector([v[0], v[1]]);
    let path = Path {
        position: flat(path.position - arc.centre),
        velocity: flat(path.velocity),
        acceleration: flat(path.acceleration),
    };
    let size = Vector([arc.radius; 2]);
    if near(&path, -size, size, radius).are_empty() {
        return f64::INFINITY;
    }
    let radial = Radial::new(&path);
    // Up to the arc itself: beyond, the centre is on the other side and the gap grows.
    let outside = radial.falls(arc.radius + radius, arc.radius);
    let inside = radial.rises(arc.radius - radius, arc.radius);
    let round = |over: &Windows| earlier(outside.and(over).first(), inside.and(over).first());
    if arc.is_circle() {
        return round(&Windows::ALWAYS);
    }

    let past = |direction: [f64; 2]| Reading::new(&path, Vector(direction), 1.0, Vector::ZERO);
    let after_start = past([-arc.start[1], arc.start[0]]);
    let before_end = past([arc.end[1], -arc.end[0]]);
    let (first, last) = (after_start.not_negative(), before_end.not_negative());
    let over = if arc.is_wide() {
        earlier(round(&first), round(&last))
    } else {
        // The two half planes of a narrow arc nearly meet in its opposite, too.
        round(&first.and(&last).and(&past(arc.middle).not_negative()))
    };
    // Elsewhere the nearer end is the nearest point: the open sector is halved by the line through the centre.
    let nearer_start = past([arc.start[0] - arc.end[0], arc.start[1] - arc.end[1]]);
    let start_alone = after_start.negated().not_negative().and(&nearer_start.not_negative());
    let end_alone = before_end.negated().not_negative().and(&nearer_start.negated().not_negative());
    let start = corner(&path, Vector(arc.start) * arc.radius, radius, &start_alone);
    let end = corner(&path, Vector(arc.end) * arc.radius, radius, &end_alone);
    earlier(over, earlier(start, end))
}

/// The point of the arc that is nearest to `point` (m); at the exact centre, one of the arc's points.
pub fn nearest_on_arc<const D: usize>(point: Vector<D>, arc: &Arc<D>) -> Vector<D> {
    if D < 2 {
        return arc.centre;
    }
    let q = [point[0] - arc.centre[0], point[1] - arc.centre[1]];
    let direction = match Vector(q).unit() {
        Some(direction) if arc.covers(q) => direction.0,
        Some(_) if dot(q, arc.start) < dot(q, arc.end) => arc.end,
        Some(_) => arc.start,
        None => arc.middle,
    };
    let mut nearest = point;
    for k in 0..2 {
        nearest[k] = arc.centre[k] + arc.radius * direction[k];
    }
    nearest
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    const NEVER: f64 = f64::INFINITY;

    fn meet(x: [f64; 2], v: [f64; 2], of: &Arc<2>, radius: f64) -> f64 {
        arc(&Path::new(x, v, [0.0, 0.0]), of, radius)
    }

    fn close(found: f64, expected: f64) {
        assert!(found == expected || (found - expected).abs() < 4e-15, "{found} is not {expected}");
    }

    #[test]
    fn a_circle_from_both_sides() {
        let circle = Arc::circle([0.0, 0.0], 5.0);
        close(meet([-10.0, 0.0], [1.0, 0.0], &circle, 1.0), 4.0);
        close(meet([0.0, 0.0], [1.0, 0.0], &circle, 1.0), 4.0);
        close(meet([4.0, 0.0], [1.0, 0.0], &circle, 1.0), 0.0);
        close(meet([4.0, 0.0], [-1.0, 0.0], &circle, 1.0), 8.0);
        close(meet([4.0_f64.next_up(), 0.0], [-1.0, 0.0], &circle, 1.0), 8.0);
        close(meet([4.0_f64.next_up(), 0.0], [0.0, 0.0], &circle, 1.0), NEVER);
        close(meet([-10.0, 6.0], [1.0, 0.0], &circle, 1.0), NEVER);
        close(meet([5.5, 0.0], [-1.0, 0.0], &circle, 1.0), 0.0); // overlapping from outside, closing
        close(meet([4.5, 0.0], [-1.0, 0.0], &circle, 1.0), 8.5); // overlapping from inside, parting
    }

    #[test]
    fn a_bowl() {
        let bowl = Arc::new([0.0, 0.0], 5.0, PI, 2.0 * PI);
        close(meet([0.0, 0.0], [0.0, -1.0], &bowl, 1.0), 4.0);
        close(meet([0.0, -10.0], [0.0, 1.0], &bowl, 1.0), 4.0);
        close(meet([0.0, 0.0], [0.0, 1.0], &bowl, 1.0), NEVER);
        close(meet([0.0, 10.0], [0.0, -1.0], &bowl, 1.0), 14.0);
        // Its rim from above: centre over (5, 0), and 3-4-5 beside it.
        close(meet([5.0, 10.0], [0.0, -1.0], &bowl, 1.0), 9.0);
        close(meet([5.6, 10.0], [0.0, -1.0], &bowl, 1.0), 9.2);
        close(meet([4.4, 10.0], [0.0, -1.0], &bowl, 1.0), 9.2);
        // A ball that does not fit in rests on both ends: 5-12-13.
        close(meet([0.0, 20.0], [0.0, -1.0], &bowl, 13.0), 8.0);
        // One that hardly fits goes down between the ends to the bottom.
        close(meet([0.0, 20.0], [0.0, -1.0], &bowl, 4.9), 20.1);
        let drop = arc(&Path::new([0.0, 9.0], [0.0, 0.0], [0.0, -2.0]), &bowl, 1.0);
        close(drop, 13.0_f64.sqrt());
    }

    #[test]
    fn through_the_gap_of_a_wide_arc() {
        let ring = Arc::new([0.0, 0.0], 5.0, 0.25 * PI, 1.75 * PI);
        close(meet([10.0, 0.0], [-1.0, 0.0], &ring, 1.0), 14.0);
        close(meet([0.0, 0.0], [1.0, 0.0], &ring, 1.0), NEVER);
        close(meet([0.0, 0.0], [0.0, 1.0], &ring, 1.0), 4.0);
        close(meet([-10.0, 0.0], [1.0, 0.0], &ring, 1.0), 4.0);
        // The ends lie at (5, +-5) / sqrt 2: a ball of radius 5 / sqrt 2 just passes, a larger one does not.
        let half = 5.0 / 2.0_f64.sqrt();
        let large = half + 0.5;
        close(meet([20.0, 0.0], [-1.0, 0.0], &ring, large), 20.0 - half - (large * large - half * half).sqrt());
        close(meet([20.0, 0.0], [-1.0, 0.0], &ring, half - 0.1), 20.0 + 5.0 - (half - 0.1));
    }

    #[test]
    fn a_narrow_arc_has_no_opposite() {
        for sweep in [0.0, 1e-17, 1e-9, 1e-3] {
            let dot = Arc::new([0.0, 0.0], 5.0, 0.0, sweep);
            close(meet([-10.0, 0.0], [1.0, 0.0], &dot, 1.0), 14.0);
            close(meet([10.0, 0.0], [-1.0, 0.0], &dot, 1.0), 4.0);
            close(meet([-10.0, -1.5], [0.0, 1.0], &dot, 1.0), NEVER);
            assert!((meet([5.0, -10.0], [0.0, 1.0], &dot, 1.0) - 9.0).abs() < 2e-15);
        }
    }

    #[test]
    fn the_nearest_point() {
        let bowl = Arc::new([0.0, 0.0], 5.0, PI, 2.0 * PI);
        let near = |x, expected: [f64; 2]| {
            let found = nearest_on_arc(Vector(x), &bowl);
            assert!((found - Vector(expected)).norm() < 2e-15, "{x:?} {found:?}");
        };
        near([0.0, -1.0], [0.0, -5.0]);
        near([0.0, -9.0], [0.0, -5.0]);
        near([6.0, 3.0], [5.0, 0.0]);
        near([-1.0, 3.0], [-5.0, 0.0]);
        near([0.0, 0.0], [0.0, -5.0]);
        assert_eq!(nearest_on_arc(Vector([3.0, 4.0, 7.0]), &Arc::circle([0.0; 3], 10.0)), Vector([6.0, 8.0, 7.0]));
    }
}
