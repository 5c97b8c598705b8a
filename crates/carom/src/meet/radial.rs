//! How the distance between a path and the origin falls and rises: a quartic, solved on the pieces on which it is monotone.
use super::path::Path;
use super::plane::roots;
use super::windows::Windows;
use crate::Vector;
use crate::vector::Exact;

/// No limit below: distances are never negative.
pub(super) const ANY: f64 = -1.0;

/// A path, with the times at which its distance from the origin turns.
pub(super) struct Radial<const D: usize> {
    path: Path<D>,
    /// |a|^2; 0 if the path is straight and even.
    bend: f64,
    /// 0, then the turning points in order, then infinity.
    turns: [f64; 5],
    count: usize,
}

impl<const D: usize> Radial<D> {
    pub(super) fn new(path: &Path<D>) -> Self {
        let mut radial = Self { path: *path, bend: path.acceleration.norm_squared(), turns: [0.0; 5], count: 1 };
        let (x, v, a) = (path.position, path.velocity, path.acceleration);
        let (b, c, d) = (x.dot(v), v.norm_squared() + x.dot(a), v.dot(a));
        // p.w = b + c t + 3/2 d t^2 + 1/2 |a|^2 t^3 is half the derivative of the squared distance. All its roots lie below
        // twice the largest of the ratios' roots (Fujiwara).
        let e = radial.bend;
        let last =
            2.1 * largest([libm::cbrt((2.0 * b / e).abs_()), (2.0 * c / e).abs_().sqrt_(), (3.0 * d / e).abs_()]);
        if !(e > 0.0 && last < f64::MAX) {
            // Straight and even, or as good as that: it turns once, where it is closest.
            radial.bend = 0.0;
            radial.turn(-b / v.norm_squared());
        } else {
            // The derivative of p.w is c + 3 d t + 3/2 |a|^2 t^2: at most three pieces on which p.w is monotone.
            let slope = |t: f64| path.position_at(t).dot(path.velocity_at(t));
            let (first, second) = roots(c, 3.0 * d, 3.0 * e);
            let mut from = (0.0, b);
            for to in [first, second, last] {
                if !(to > from.0 && to <= last) {
                    continue;
                }
                let at_to = slope(to);
                if (from.1 < 0.0) != (at_to < 0.0) {
                    radial.turn(crossing(from.0, to, at_to < 0.0, |t| {
                        let (p, w) = (path.position_at(t), path.velocity_at(t));
                        let square = w.norm_squared();
                        let noise = 0.5 * f64::EPSILON * (p.norm_squared() * square).sqrt_();
                        (p.dot(w), square + p.dot(path.acceleration), noise)
                    }));
                }
                from = (to, at_to);
            }
        }
        radial.turns[radial.count] = f64::INFINITY;
        radial.count += 1;
        radial
    }

    fn turn(&mut self, t: f64) {
        if t > self.turns[self.count - 1] && t < f64::MAX {
            self.turns[self.count] = t;
            self.count += 1;
        }
    }

    /// The windows in which the distance falls, from `high` at most, and is still over `low`.
    pub(super) fn falls(&self, high: f64, low: f64) -> Windows {
        let mut windows = Windows::NEVER;
        for (start, end) in self.pieces() {
            if !self.is_falling(start, end) {
                continue;
            }
            let (far, near) = (self.distance(start), self.distance(end));
            if near < high && far > low {
                windows.add(
                    if far <= high { start } else { self.reach(high, true, start, end) },
                    if near >= low { end } else { self.reach(low, true, start, end) },
                );
            }
        }
        windows
    }

    /// The windows in which the distance rises, from `low` at least, and is still under `high`.
    pub(super) fn rises(&self, low: f64, high: f64) -> Windows {
        let mut windows = Windows::NEVER;
        for (start, end) in self.pieces() {
            if end < f64::MAX && self.is_falling(start, end) {
                continue;
            }
            let end = if end < f64::MAX { end } else { self.beyond(high, start) };
            let (near, far) = (self.distance(start), self.distance(end));
            if far > low && near < high {
                windows.add(
                    if near >= low { start } else { self.reach(low, false, start, end) },
                    if far <= high { end } else { self.reach(high, false, start, end) },
                );
            }
        }
        windows
    }

    fn pieces(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        (1..self.count).map(|k| (self.turns[k - 1], self.turns[k]))
    }

    /// Asked in the middle: at the ends of a piece the derivative is zero give or take a rounding. The last piece rises.
    fn is_falling(&self, start: f64, end: f64) -> bool {
        let middle = start + 0.5 * (end - start);
        end < f64::MAX && self.path.position_at(middle).dot(self.path.velocity_at(middle)) < 0.0
    }

    fn distance(&self, t: f64) -> f64 {
        self.path.position_at(t).norm()
    }

    /// A time after `start` from which on the distance is over `level`.
    fn beyond(&self, level: f64, start: f64) -> f64 {
        let Path { position, velocity, acceleration } = self.path;
        let (need, speed, pull) = (position.norm() + level, velocity.norm(), acceleration.norm());
        let t =
            if self.bend > 0.0 { (speed + (speed * speed + 2.0 * pull * need).sqrt_()) / pull } else { need / speed };
        // If nothing moves, t is not a number, and neither is any distance then: no window.
        start + 1.1 * t
    }

    /// The time at which the distance passes `level` between `start` and `end`, where it is monotone.
    fn reach(&self, level: f64, falling: bool, start: f64, end: f64) -> f64 {
        let Path { position, velocity, .. } = self.path;
        if !(self.bend > 0.0) {
            // Closed form, as for two balls.
            let (a, b) = (velocity.norm_squared(), position.dot(velocity));
            let distance = position.norm();
            let miss = (position - velocity * (b / a)).norm();
            let d = (level - miss) * (level + miss);
            let root = if d > 0.0 { (a * d).sqrt_() } else { 0.0 };
            let c = (distance - level) * (distance + level);
            return match falling {
                true => c / (root - b),
                false if b > 0.0 => -c / (b + root),
                false => (root - b) / a,
            };
        }
        crossing(start, end, falling, |t| {
            let (p, w) = (self.path.position_at(t), self.path.velocity_at(t));
            let distance = p.norm();
            (distance - level, p.dot(w) / distance, 0.5 * f64::EPSILON * (distance + level))
        })
    }
}

/// Newton's steps double the digits, and bisection steps in wherever they do not at least halve the step; a bracket of any
/// two numbers is down to neighbours after that many. Ten are usual.
const MOST_STEPS: usize = 2200;

/// Where a monotone function passes zero between `start` and `end`; `falling` says which way. It gives its value, its slope
/// and how far the value may be off by rounding. Newton, kept in the bracket by bisection.
fn crossing(start: f64, end: f64, falling: bool, f: impl Fn(f64) -> (f64, f64, f64)) -> f64 {
    let (mut before, mut after) = (start, end);
    let (mut t, mut step) = (start, end - start);
    for _ in 0..MOST_STEPS {
        let (value, slope, noise) = f(t);
        if (value > 0.0) == falling {
            before = t;
        } else {
            after = t;
        }
        let newton = -value / slope;
        let next = t + newton;
        let inside = next >= before && next <= after;
        if !(value.abs_() > noise) || (inside && newton.abs_() <= 2.0 * f64::EPSILON * t) {
            return if inside { next } else { t };
        }
        if inside && newton.abs_() <= 0.5 * step.abs_() {
            step = newton;
            t = next;
        } else {
            let middle = before + 0.5 * (after - before);
            if !(middle > before && middle < after) {
                return t;
            }
            step = middle - t;
            t = middle;
        }
    }
    t
}

fn largest(of: [f64; 3]) -> f64 {
    Vector(of).largest()
}
