//! How far a point lies from a wall. Points have three components; those beyond the scene's dimension are zero.
use std::f64::consts::PI;

use crate::model::Form;

/// A point or a vector, padded with zeros.
pub type Point = [f64; 3];

/// The padded point of `dim` components.
pub(crate) fn point(components: &[f64]) -> Point {
    let mut p = [0.0; 3];
    for (to, from) in p.iter_mut().zip(components) {
        *to = *from;
    }
    p
}

pub(crate) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a + s b
pub(crate) fn plus(a: Point, s: f64, b: Point) -> Point {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn norm(a: Point) -> f64 {
    let square = dot(a, a);
    if square > 1e-280 && square < 1e280 {
        return square.sqrt();
    }
    let largest = a.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    if !(largest > 0.0) || !largest.is_finite() {
        return largest;
    }
    // Scaled by a power of two, so that nothing overflows and nothing is rounded by it.
    let scale = libm::ldexp(1.0, libm::ilogb(largest).clamp(-1000, 1000));
    let s = a.map(|x| x / scale);
    scale * dot(s, s).sqrt()
}

/// The vector of length one along `a`; zeros for the zero vector.
pub(crate) fn unit(a: Point) -> Point {
    let largest = a.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    if !(largest > 0.0) {
        return [0.0; 3];
    }
    let s = a.map(|x| x / largest);
    let length = dot(s, s).sqrt();
    s.map(|x| x / length)
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Across a triangle, of twice its area; zero if its corners lie on one line.
pub(crate) fn area_vector(a: &[f64], b: &[f64], c: &[f64]) -> Point {
    cross(minus(point(b), point(a)), minus(point(c), point(a)))
}

/// The shape of a wall, ready for use: padded points, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outline {
    /// A half-space: a point of it and its normal, of any length but 0.
    Plane(Point, Point),
    /// A segment's ends.
    Segment(Point, Point),
    /// An arc, counter-clockwise from the angle `from` to the angle `to` > `from` (rad), at most one turn.
    Arc {
        /// The centre (m).
        centre: Point,
        /// The radius (m).
        radius: f64,
        /// Where it starts (rad).
        from: f64,
        /// Where it ends (rad).
        to: f64,
    },
    /// A triangle's corners.
    Triangle(Point, Point, Point),
}

impl From<&Form> for Outline {
    fn from(form: &Form) -> Self {
        match form {
            Form::Plane { point: p, normal } => Self::Plane(point(p), point(normal)),
            Form::Segment { from, to } => Self::Segment(point(from), point(to)),
            Form::Arc { centre, radius, from, to } => {
                // 350 to 10 degrees is an arc of 20 degrees, through 0.
                let to = if to < from { to + 360.0 } else { *to };
                let radians = |degrees: f64| degrees * (PI / 180.0);
                Self::Arc { centre: point(centre), radius: *radius, from: radians(*from), to: radians(to) }
            }
            Form::Triangle([a, b, c]) => Self::Triangle(point(a), point(b), point(c)),
        }
    }
}

impl Outline {
    /// The distance of `p` from the wall (m); from a plane with the sign of its side, negative behind it.
    pub fn distance(&self, p: Point) -> f64 {
        match *self {
            Self::Plane(on, normal) => dot(minus(p, on), unit(normal)),
            Self::Segment(a, b) => norm(minus(p, on_segment(p, a, b))),
            Self::Arc { centre, radius, from, to } => {
                let arm = minus(p, centre);
                if is_between(libm::atan2(arm[1], arm[0]), from, to) {
                    return (norm(arm) - radius).abs();
                }
                let end = |angle| norm(minus(p, on_circle(centre, radius, angle)));
                end(from).min(end(to))
            }
            Self::Triangle(a, b, c) => norm(minus(p, on_triangle(p, a, b, c))),
        }
    }

    /// The corners of the smallest box around the wall; `None` for a plane, which has no end.
    pub(crate) fn extent(&self) -> Option<(Point, Point)> {
        let of = |points: &[Point]| {
            let fold = |f: fn(f64, f64) -> f64| {
                let mut corner = points[0];
                for p in points {
                    for k in 0..3 {
                        corner[k] = f(corner[k], p[k]);
                    }
                }
                corner
            };
            Some((fold(f64::min), fold(f64::max)))
        };
        match *self {
            Self::Plane(..) => None,
            Self::Segment(a, b) => of(&[a, b]),
            Self::Triangle(a, b, c) => of(&[a, b, c]),
            Self::Arc { centre, radius, from, to } => {
                let mut points = vec![on_circle(centre, radius, from), on_circle(centre, radius, to)];
                for (k, along) in
                    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]].iter().enumerate()
                {
                    if is_between(k as f64 * (PI / 2.0), from, to) {
                        points.push(plus(centre, radius, *along));
                    }
                }
                of(&points)
            }
        }
    }
}

fn on_circle(centre: Point, radius: f64, angle: f64) -> Point {
    plus(centre, radius, [libm::cos(angle), libm::sin(angle), 0.0])
}

/// True if the arc from `from` to `to` passes this angle (rad), whole turns apart.
fn is_between(angle: f64, from: f64, to: f64) -> bool {
    let turn = 2.0 * PI;
    let after = (angle - from) - turn * ((angle - from) / turn).floor();
    after <= to - from
}

/// The point of a segment nearest to `p`.
fn on_segment(p: Point, a: Point, b: Point) -> Point {
    let along = minus(b, a);
    let share = dot(minus(p, a), along) / dot(along, along);
    if !(share > 0.0) {
        a
    } else if share >= 1.0 {
        b
    } else {
        plus(a, share, along)
    }
}

/// The point of a triangle nearest to `p` (C. Ericson, Real-Time Collision Detection, 5.1.5).
fn on_triangle(p: Point, a: Point, b: Point, c: Point) -> Point {
    let (ab, ac, ap) = (minus(b, a), minus(c, a), minus(p, a));
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = minus(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return plus(a, d1 / (d1 - d3), ab);
    }
    let cp = minus(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return plus(a, d2 / (d2 - d6), ac);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return plus(b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), minus(c, b));
    }
    let whole = va + vb + vc;
    plus(plus(a, vb / whole, ab), vc / whole, ac)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The nearest of many points of the wall: what a distance is.
    fn sampled(wall: &Outline, p: Point) -> f64 {
        let n = 400;
        let share = |k: usize| k as f64 / n as f64;
        let mut least = f64::INFINITY;
        let mut see = |q: Point| least = least.min(norm(minus(p, q)));
        match *wall {
            Outline::Segment(a, b) => (0..=n).for_each(|k| see(plus(a, share(k), minus(b, a)))),
            Outline::Arc { centre, radius, from, to } => {
                (0..=n).for_each(|k| see(on_circle(centre, radius, from + (to - from) * share(k))));
            }
            Outline::Triangle(a, b, c) => {
                for i in 0..=n {
                    for j in 0..=n - i {
                        see(plus(plus(a, share(i), minus(b, a)), share(j), minus(c, a)));
                    }
                }
            }
            Outline::Plane(..) => {}
        }
        least
    }

    #[test]
    fn distances_are_those_of_the_nearest_point() {
        let arc = |from: f64, to: f64| Outline::from(&Form::Arc { centre: vec![0.2, -0.1], radius: 0.8, from, to });
        let walls = [
            Outline::Segment([0.0; 3], [1.0, 0.5, 0.0]),
            arc(0.0, 90.0),
            arc(350.0, 10.0),
            arc(-30.0, 200.0),
            arc(180.0, -180.0),
            Outline::Triangle([0.0; 3], [1.0, 0.1, 0.2], [0.3, 0.9, -0.4]),
        ];
        for wall in &walls {
            let flat = !matches!(wall, Outline::Triangle(..));
            for k in 0..60 {
                let t = k as f64;
                let p =
                    [2.0 * libm::sin(1.7 * t), 2.0 * libm::sin(2.3 * t + 1.0), if flat { 0.0 } else { libm::sin(t) }];
                let (got, want) = (wall.distance(p), sampled(wall, p));
                // The samples lie at most 0.02 apart, and miss the nearest point by half of that at most.
                assert!(got <= want + 1e-12 && want - got < 0.01, "{wall:?} {p:?}: {got} {want}");
                let (low, high) = wall.extent().unwrap();
                let gap = (0..3).map(|k| (low[k] - p[k]).max(p[k] - high[k])).fold(0.0, f64::max);
                assert!(gap <= got + 1e-12, "{wall:?} {p:?}: {gap} {got}");
            }
        }
        assert_eq!(Outline::Plane([0.0, 1.0, 0.0], [0.0, 1e-320, 0.0]).distance([5.0, 0.25, 0.0]), -0.75);
        let (low, high) = arc(-90.0, 90.0).extent().unwrap();
        assert!((low[1] + 0.9).abs() < 1e-15 && high[0] == 1.0, "{low:?} {high:?}");
    }
}
