//! The line, the plane, space: vectors of `D` components, and how a spin acts on an arm.
use core::ops::{Add, AddAssign, Div, Index, IndexMut, Mul, Neg, Sub, SubAssign};

use crate::Matrix;

/// A vector of `D` components, each an `f64` in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Vector<const D: usize>(pub [f64; D]);

impl<const D: usize> Vector<D> {
    /// The vector whose components are all zero.
    pub const ZERO: Self = Self([0.0; D]);

    /// The vector whose component `k` is `f(k)`.
    #[inline(always)]
    pub fn from_fn(mut f: impl FnMut(usize) -> f64) -> Self {
        // A plain loop: `core::array::from_fn` is not always inlined, and every product of the engine goes through here.
        let mut v = Self::ZERO;
        for k in 0..D {
            v.0[k] = f(k);
        }
        v
    }

    /// The unit vector along axis `k`.
    ///
    /// # Panics
    /// If `k >= D`.
    pub fn axis(k: usize) -> Self {
        let mut v = Self::ZERO;
        v.0[k] = 1.0;
        v
    }

    /// The scalar product, summed from the first component to the last.
    #[inline(always)]
    pub fn dot(self, other: Self) -> f64 {
        let mut sum = 0.0;
        for k in 0..D {
            sum += self.0[k] * other.0[k];
        }
        sum
    }

    /// The square of the length.
    #[inline(always)]
    pub fn norm_squared(self) -> f64 {
        self.dot(self)
    }

    /// The length, free of overflow and underflow between.
    #[inline]
    pub fn norm(self) -> f64 {
        let square = self.norm_squared();
        if square > 1e-280 && square < 1e280 {
            return square.sqrt_();
        }
        let largest = self.largest();
        if !(largest > 0.0) || !largest.is_finite() {
            return largest;
        }
        largest * (self / largest).norm_squared().sqrt_()
    }

    /// The largest magnitude of a component; NaN if any component is NaN.
    pub fn largest(self) -> f64 {
        let mut largest = 0.0;
        for x in self.0 {
            let magnitude = if x < 0.0 { -x } else { x };
            if !(magnitude <= largest) {
                largest = magnitude;
            }
            if magnitude.is_nan() {
                return magnitude;
            }
        }
        largest
    }

    /// The vector of length one along this one; `None` for the zero vector and for what is not finite.
    pub fn unit(self) -> Option<Self> {
        let largest = self.largest();
        if !(largest > 0.0) || !largest.is_finite() {
            return None;
        }
        let scaled = self / largest;
        Some(scaled / scaled.norm_squared().sqrt_())
    }

    /// True if no component is infinite or NaN.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.0.iter().all(|x| x.is_finite())
    }
}

impl<const D: usize> Default for Vector<D> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const D: usize> From<[f64; D]> for Vector<D> {
    #[inline]
    fn from(components: [f64; D]) -> Self {
        Self(components)
    }
}

impl<const D: usize> From<Vector<D>> for [f64; D] {
    #[inline]
    fn from(v: Vector<D>) -> Self {
        v.0
    }
}

impl<const D: usize> Index<usize> for Vector<D> {
    type Output = f64;
    #[inline(always)]
    fn index(&self, k: usize) -> &f64 {
        &self.0[k]
    }
}

impl<const D: usize> IndexMut<usize> for Vector<D> {
    #[inline(always)]
    fn index_mut(&mut self, k: usize) -> &mut f64 {
        &mut self.0[k]
    }
}

impl<const D: usize> Add for Vector<D> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::from_fn(|k| self.0[k] + other.0[k])
    }
}

impl<const D: usize> Sub for Vector<D> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::from_fn(|k| self.0[k] - other.0[k])
    }
}

impl<const D: usize> Neg for Vector<D> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::from_fn(|k| -self.0[k])
    }
}

impl<const D: usize> Mul<f64> for Vector<D> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self::from_fn(|k| self.0[k] * factor)
    }
}

impl<const D: usize> Mul<Vector<D>> for f64 {
    type Output = Vector<D>;
    #[inline(always)]
    fn mul(self, v: Vector<D>) -> Vector<D> {
        v * self
    }
}

impl<const D: usize> Div<f64> for Vector<D> {
    type Output = Self;
    #[inline(always)]
    fn div(self, divisor: f64) -> Self {
        Self::from_fn(|k| self.0[k] / divisor)
    }
}

impl<const D: usize> AddAssign for Vector<D> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const D: usize> SubAssign for Vector<D> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

/// The square root and the absolute value, exact or correctly rounded on every machine. `core` has no `sqrt`; with `std`
/// it is the machine's instruction, without it `libm`'s, and IEEE 754 makes both give the same bits.
pub(crate) trait Exact {
    fn sqrt_(self) -> f64;
    fn abs_(self) -> f64;
}

impl Exact for f64 {
    #[inline(always)]
    fn sqrt_(self) -> f64 {
        #[cfg(feature = "std")]
        {
            self.sqrt()
        }
        #[cfg(not(feature = "std"))]
        {
            libm::sqrt(self)
        }
    }
    #[inline(always)]
    fn abs_(self) -> f64 {
        f64::from_bits(self.to_bits() & !(1 << 63))
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Vector<1> {}
    impl Sealed for super::Vector<2> {}
    impl Sealed for super::Vector<3> {}
}

/// Spaces in which a body can turn: nothing turns on the line, one number tells a spin in the plane (counter-clockwise),
/// three in space (right hand).
///
/// `Spin` is itself a [`Vector`] of 0, 1 or 3 components in rad/s, so that it adds, scales and takes scalar products.
pub trait Rotates: sealed::Sealed + Copy {
    /// A spin (rad/s), or a moment of the same shape (N m, N m s).
    type Spin: Copy
        + Default
        + PartialEq
        + core::fmt::Debug
        + Send
        + Sync
        + Add<Output = Self::Spin>
        + Sub<Output = Self::Spin>
        + Neg<Output = Self::Spin>
        + Mul<f64, Output = Self::Spin>
        + AddAssign
        + SubAssign
        + crate::codec::Codec
        + 'static;
    /// The inverse of a body's inertia about its centre of mass, in the axes of the world (1/(kg m^2)): nothing on the line,
    /// one number in the plane, a symmetric matrix in space. Zero for what nothing can turn.
    type InverseInertia: Copy + Default + PartialEq + core::fmt::Debug + Send + Sync + 'static;
    /// How many numbers a spin has: 0, 1 or 3.
    const SPINS: usize;
    /// The velocity that a spin gives to the end of an arm: w x r.
    fn turned(spin: Self::Spin, arm: Self) -> Self;
    /// The moment of a vector at the end of an arm: r x p.
    fn moment(arm: Self, p: Self) -> Self::Spin;
    /// The inverse inertia of what turns equally easily about every axis, as balls do (1/(kg m^2)).
    fn isotropic(inverse: f64) -> Self::InverseInertia;
    /// The change of spin that a moment of this impulse gives: I^-1 L.
    fn spun(inverse: &Self::InverseInertia, moment: Self::Spin) -> Self::Spin;
    /// The scalar product of two spins.
    fn spin_dot(a: Self::Spin, b: Self::Spin) -> f64;
    /// The numbers of a spin.
    fn spin_slice(spin: &Self::Spin) -> &[f64];
    /// A spin of these numbers; `None` if there are not [`Self::SPINS`] of them.
    fn spin_from(numbers: &[f64]) -> Option<Self::Spin>;
}

impl Rotates for Vector<1> {
    type Spin = Vector<0>;
    type InverseInertia = ();
    const SPINS: usize = 0;
    #[inline(always)]
    fn turned(_: Vector<0>, _: Self) -> Self {
        Self::ZERO
    }
    #[inline(always)]
    fn moment(_: Self, _: Self) -> Vector<0> {
        Vector([])
    }
    #[inline(always)]
    fn isotropic(_: f64) {}
    #[inline(always)]
    fn spun(_: &(), moment: Vector<0>) -> Vector<0> {
        moment
    }
    #[inline(always)]
    fn spin_dot(_: Vector<0>, _: Vector<0>) -> f64 {
        0.0
    }
    fn spin_slice(spin: &Vector<0>) -> &[f64] {
        &spin.0
    }
    fn spin_from(numbers: &[f64]) -> Option<Vector<0>> {
        numbers.try_into().ok().map(Vector)
    }
}

impl Rotates for Vector<2> {
    type Spin = Vector<1>;
    type InverseInertia = f64;
    const SPINS: usize = 1;
    #[inline(always)]
    fn turned(spin: Vector<1>, arm: Self) -> Self {
        Self([-spin.0[0] * arm.0[1], spin.0[0] * arm.0[0]])
    }
    #[inline(always)]
    fn moment(arm: Self, p: Self) -> Vector<1> {
        Vector([arm.0[0] * p.0[1] - arm.0[1] * p.0[0]])
    }
    #[inline(always)]
    fn isotropic(inverse: f64) -> f64 {
        inverse
    }
    #[inline(always)]
    fn spun(inverse: &f64, moment: Vector<1>) -> Vector<1> {
        moment * *inverse
    }
    #[inline(always)]
    fn spin_dot(a: Vector<1>, b: Vector<1>) -> f64 {
        a.dot(b)
    }
    fn spin_slice(spin: &Vector<1>) -> &[f64] {
        &spin.0
    }
    fn spin_from(numbers: &[f64]) -> Option<Vector<1>> {
        numbers.try_into().ok().map(Vector)
    }
}

/// The vector product in space.
#[inline(always)]
fn cross(a: Vector<3>, b: Vector<3>) -> Vector<3> {
    Vector([a.0[1] * b.0[2] - a.0[2] * b.0[1], a.0[2] * b.0[0] - a.0[0] * b.0[2], a.0[0] * b.0[1] - a.0[1] * b.0[0]])
}

impl Rotates for Vector<3> {
    type Spin = Vector<3>;
    type InverseInertia = Matrix<3>;
    const SPINS: usize = 3;
    #[inline(always)]
    fn turned(spin: Self, arm: Self) -> Self {
        cross(spin, arm)
    }
    #[inline(always)]
    fn moment(arm: Self, p: Self) -> Self {
        cross(arm, p)
    }
    #[inline(always)]
    fn isotropic(inverse: f64) -> Matrix<3> {
        Matrix::scalar(inverse)
    }
    #[inline(always)]
    fn spun(inverse: &Matrix<3>, moment: Self) -> Self {
        *inverse * moment
    }
    #[inline(always)]
    fn spin_dot(a: Self, b: Self) -> f64 {
        a.dot(b)
    }
    fn spin_slice(spin: &Self) -> &[f64] {
        &spin.0
    }
    fn spin_from(numbers: &[f64]) -> Option<Self> {
        numbers.try_into().ok().map(Vector)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_survive_extremes() {
        assert!((Vector([3e200, 4e200]).norm() / 5e200 - 1.0).abs() < 1e-15); // two roundings by the scale
        assert!((Vector([3e-200, 4e-200]).norm() / 5e-200 - 1.0).abs() < 1e-15);
        assert_eq!(Vector([0.0, 0.0]).norm(), 0.0);
        assert!(Vector([f64::NAN, 1.0]).norm().is_nan());
        assert!(Vector([f64::NAN, 1.0]).largest().is_nan() && Vector([1.0, f64::NAN]).largest().is_nan());
        assert_eq!(Vector([0.0, 0.0]).unit(), None);
        assert_eq!(Vector([0.0, f64::INFINITY]).unit(), None);
        assert_eq!(Vector([0.0, -5e-324]).unit(), Some(Vector([0.0, -1.0])));
    }

    #[test]
    fn the_triple_product_turns_round() {
        // (w x r).p = w.(r x p), in the plane and in space.
        let (w, r, p) = (Vector([0.5, -2.0, 3.0]), Vector([1.0, 4.0, -2.0]), Vector([-3.0, 0.25, 8.0]));
        assert_eq!(Vector::<3>::turned(w, r).dot(p), w.dot(Vector::<3>::moment(r, p)));
        let (w, r, p) = (Vector([-2.0]), Vector([1.0, 4.0]), Vector([-3.0, 0.25]));
        assert_eq!(Vector::<2>::turned(w, r).dot(p), w.dot(Vector::<2>::moment(r, p)));
    }
}
