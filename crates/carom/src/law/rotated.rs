//! Two balls in the plane by angles: step 10 of the lecture, for teaching and as an oracle.
//!
//! Rotate into the line of centres (angle theta with the x axis), treat the components along it as an impact on a line,
//! keep the components across it, rotate back. The letters are the lecture's: v_p lies *along* the line of centres, v_n
//! *across* it. Everywhere else in this library "normal" means along the line of centres.
use super::line;
use crate::Vector;

/// The frame of the line of centres, turned by `theta` (rad, counter-clockwise) against the x axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The angle of the line of centres, atan2(n_y, n_x).
    pub theta: f64,
    cos: f64,
    sin: f64,
}

impl Frame {
    /// The frame whose first axis points along `along` (any length but 0, from the first body to the second).
    pub fn along(along: Vector<2>) -> Self {
        let theta = libm::atan2(along[1], along[0]);
        Self { theta, cos: libm::cos(theta), sin: libm::sin(theta) }
    }

    /// Into the frame: v_p = v_x cos t + v_y sin t, v_n = -v_x sin t + v_y cos t. Returns (v_p, v_n).
    pub fn enter(&self, v: Vector<2>) -> (f64, f64) {
        (v[0] * self.cos + v[1] * self.sin, -v[0] * self.sin + v[1] * self.cos)
    }

    /// Back from the frame, by the matrix [[cos t, -sin t], [sin t, cos t]].
    pub fn back(&self, v_p: f64, v_n: f64) -> Vector<2> {
        Vector([self.cos * v_p - self.sin * v_n, self.sin * v_p + self.cos * v_n])
    }
}

/// An impact as the rotated frame sees it: (v_p, v_n) of both bodies before and after.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotated {
    /// The frame.
    pub frame: Frame,
    /// (v_p, v_n) of the first and of the second body before.
    pub before: [(f64, f64); 2],
    /// The same after.
    pub after: [(f64, f64); 2],
}

/// The impact of two smooth balls in the plane by rotation, closed form and rotation back.
///
/// `mass` in kg (infinite for a wall), `velocity` in m/s, `along` from the first to the second, of any length but 0.
/// Bodies that do not approach are left alone.
///
/// # Accuracy
/// Three roundings of trigonometric functions, so about 1e-15 of the speeds; [`super::smooth`] needs none of them.
pub fn impact(mass: [f64; 2], velocity: [Vector<2>; 2], along: Vector<2>, e: f64) -> (Rotated, [Vector<2>; 2]) {
    let frame = Frame::along(along);
    let before = velocity.map(|v| frame.enter(v));
    let (p1, p2) = (before[0].0, before[1].0);
    let (q1, q2) = if !(p1 - p2 > 0.0) {
        (p1, p2)
    } else {
        match (mass[0].is_finite(), mass[1].is_finite()) {
            (true, true) => line::velocities(mass[0], mass[1], p1, p2, e),
            (true, false) => (line::against_wall(p1, p2, e), p2),
            (false, true) => (p1, line::against_wall(p2, p1, e)),
            (false, false) => (p1, p2),
        }
    };
    let after = [(q1, before[0].1), (q2, before[1].1)];
    (Rotated { frame, before, after }, after.map(|(p, n)| frame.back(p, n)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a9_of_the_theory() {
        let (rotated, after) = impact([2.0, 3.0], [Vector([5.0, 0.0]), Vector([-1.0, 2.0])], Vector([3.0, 4.0]), 0.5);
        let want = [Vector([98.0 / 25.0, -36.0 / 25.0]), Vector([-7.0 / 25.0, 74.0 / 25.0])];
        for (got, want) in after.iter().zip(want) {
            assert!((*got - want).norm() < 1e-14, "{got:?} {want:?}");
        }
        // v_n is untouched, to the bit.
        assert_eq!(rotated.before.map(|b| b.1), rotated.after.map(|a| a.1));
    }
}
