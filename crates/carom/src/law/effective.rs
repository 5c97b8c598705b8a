//! A contact seen along its normal and across it: what the laws with friction compute with.
use crate::law::contact::Contact;
use crate::vector::Exact;
use crate::{Rotates, Vector};

/// A contact in its own axes. The part across the normal has `D - 1` numbers, of which arrays of two keep the rest at zero;
/// the padded part of `tangential` is zero too, and nothing reads it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effective<const D: usize> {
    /// The normal, then an orthonormal basis of the directions across it.
    axes: [Vector<D>; D],
    /// u.n > 0: approaching (m/s).
    pub approach: f64,
    /// u across the normal (m/s).
    pub slip: [f64; 2],
    /// n.K n (1/kg).
    pub normal: f64,
    /// K n across the normal: what couples the two. Zero for balls.
    pub coupling: [f64; 2],
    /// K across the normal.
    pub tangential: [[f64; 2]; 2],
}

impl<const D: usize> Effective<D>
where
    Vector<D>: Rotates,
{
    #[inline]
    pub fn of(contact: &Contact<D>) -> Self {
        let axes = axes(contact.normal);
        let [a, b] = &contact.sides;
        let u = contact.relative_velocity();
        let k = |i: usize, j: usize| a.mobility(axes[i], axes[j]) + b.mobility(axes[i], axes[j]);
        let mut effective = Self {
            axes,
            approach: u.dot(contact.normal),
            slip: [0.0; 2],
            normal: k(0, 0),
            coupling: [0.0; 2],
            tangential: [[0.0; 2]; 2],
        };
        for i in 1..D {
            effective.slip[i - 1] = u.dot(axes[i]);
            effective.coupling[i - 1] = k(i, 0);
            for j in 1..=i {
                let entry = k(i, j);
                (effective.tangential[i - 1][j - 1], effective.tangential[j - 1][i - 1]) = (entry, entry);
            }
        }
        effective
    }

    /// True if the bodies close and something can be moved along the normal. NaN says no.
    #[inline]
    pub fn closes(&self) -> bool {
        self.approach > 0.0 && self.normal > 0.0
    }

    /// The vector of these components along the normal and across it.
    #[inline]
    pub fn vector(&self, normal: f64, across: [f64; 2]) -> Vector<D> {
        let mut v = self.axes[0] * normal;
        for i in 1..D {
            v += self.axes[i] * across[i - 1];
        }
        v
    }
}

/// An orthonormal basis whose first vector is the unit vector `n`: the reflection that carries an axis to n (Householder),
/// which divides by nothing smaller than 1.
fn axes<const D: usize>(n: Vector<D>) -> [Vector<D>; D] {
    let sign = if n.0[0] < 0.0 { -1.0 } else { 1.0 };
    let mut mirror = n;
    mirror.0[0] += sign;
    let scale = 1.0 / (1.0 + n.0[0].abs_());
    core::array::from_fn(|k| if k == 0 { n } else { Vector::axis(k) - mirror * (n.0[k] * scale) })
}

/// The scalar product of two pairs.
#[inline(always)]
pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The length of a pair.
#[inline(always)]
pub(super) fn length(a: [f64; 2]) -> f64 {
    Vector(a).norm()
}

/// A symmetric matrix of two rows times a pair.
#[inline(always)]
pub(super) fn times(m: &[[f64; 2]; 2], v: [f64; 2]) -> [f64; 2] {
    [dot(m[0], v), dot(m[1], v)]
}

/// A pivot below this share of its row's diagonal is rounding, not mobility: a few dozen eps.
const FLAT: f64 = 1e-14;

/// x with M x = b for a symmetric M >= 0 of two rows, by elimination from the larger diagonal entry on. Directions in which
/// nothing can be moved (a body that turns about a fixed axle has some) get none.
#[inline]
pub(super) fn solve(m: &[[f64; 2]; 2], b: [f64; 2]) -> [f64; 2] {
    let (i, j) = if m[1][1] > m[0][0] { (1, 0) } else { (0, 1) };
    let mut x = [0.0; 2];
    if !(m[i][i] > 0.0) {
        return x;
    }
    let ratio = m[i][j] / m[i][i];
    let rest = m[j][j] - ratio * m[i][j];
    if rest > FLAT * m[j][j] {
        x[j] = (b[j] - ratio * b[i]) / rest;
    }
    x[i] = (b[i] - m[i][j] * x[j]) / m[i][i];
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_stand_on_each_other() {
        for n in
            [[0.6, 0.0, 0.8], [-0.6, 0.8, 0.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0]]
        {
            let axes = axes(Vector(n));
            for i in 0..3 {
                for j in 0..3 {
                    let want = if i == j { 1.0 } else { 0.0 };
                    // A dozen roundings of numbers below 2.
                    assert!((axes[i].dot(axes[j]) - want).abs() < 1e-15, "{n:?} {i} {j}");
                }
            }
        }
        assert_eq!(super::axes(Vector([-1.0])), [Vector([-1.0])]);
    }

    #[test]
    fn two_equations() {
        assert_eq!(solve(&[[2.0, 1.0], [1.0, 4.0]], [4.0, 9.0]), [1.0, 2.0]);
        assert_eq!(solve(&[[4.0, 0.0], [0.0, 0.0]], [2.0, 0.0]), [0.5, 0.0], "the padded plane");
        assert_eq!(solve(&[[1.0, 2.0], [2.0, 4.0]], [3.0, 6.0])[0], 0.0, "of many answers one");
        assert_eq!(solve(&[[0.0; 2]; 2], [1.0, 1.0]), [0.0; 2]);
    }
}
