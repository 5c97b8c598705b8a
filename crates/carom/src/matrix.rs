//! Square matrices of `D` rows: what an impulse does to the relative velocity at a contact, and inertia in space.
use core::ops::{Add, Mul};

use crate::Vector;

/// A matrix of `D` rows and columns; `.0[i][j]` stands in row `i`, column `j`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix<const D: usize>(pub [[f64; D]; D]);

impl<const D: usize> Matrix<D> {
    /// All zeros.
    pub const ZERO: Self = Self([[0.0; D]; D]);

    /// The matrix whose entry in row `i`, column `j` is `f(i, j)`.
    #[inline(always)]
    pub fn from_fn(mut f: impl FnMut(usize, usize) -> f64) -> Self {
        Self(core::array::from_fn(|i| core::array::from_fn(|j| f(i, j))))
    }

    /// `factor` times the unit matrix.
    #[inline(always)]
    pub fn scalar(factor: f64) -> Self {
        Self::from_fn(|i, j| if i == j { factor } else { 0.0 })
    }

    /// True if no entry is infinite or NaN.
    pub fn is_finite(&self) -> bool {
        self.0.iter().flatten().all(|x| x.is_finite())
    }
}

impl<const D: usize> Default for Matrix<D> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const D: usize> Mul<Vector<D>> for Matrix<D> {
    type Output = Vector<D>;
    #[inline(always)]
    fn mul(self, v: Vector<D>) -> Vector<D> {
        Vector::from_fn(|i| Vector(self.0[i]).dot(v))
    }
}

impl<const D: usize> Add for Matrix<D> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::from_fn(|i, j| self.0[i][j] + other.0[i][j])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_times_a_vector() {
        let m = Matrix([[1.0, 2.0], [-3.0, 4.0]]);
        assert_eq!(m * Vector([5.0, 0.5]), Vector([6.0, -13.0]));
        assert_eq!(m + Matrix::scalar(2.0), Matrix([[3.0, 2.0], [-3.0, 6.0]]));
        assert!(m.is_finite() && !Matrix([[f64::NAN]]).is_finite());
    }
}
