//! How the centre of a ball moves relative to an obstacle.
use crate::Vector;

/// The motion x + v t + a t^2 / 2 of a ball's centre relative to an obstacle, with now as t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path<const D: usize> {
    /// Where the centre is now (m).
    pub position: Vector<D>,
    /// Its velocity now (m/s).
    pub velocity: Vector<D>,
    /// Its acceleration (m/s^2), constant.
    pub acceleration: Vector<D>,
}

impl<const D: usize> Path<D> {
    /// A path from a position (m), a velocity (m/s) and an acceleration (m/s^2).
    pub fn new(
        position: impl Into<Vector<D>>,
        velocity: impl Into<Vector<D>>,
        acceleration: impl Into<Vector<D>>,
    ) -> Self {
        Self { position: position.into(), velocity: velocity.into(), acceleration: acceleration.into() }
    }

    /// Where the centre is at time `t` (m).
    #[inline(always)]
    pub fn position_at(&self, t: f64) -> Vector<D> {
        self.position + (self.velocity + self.acceleration * (0.5 * t)) * t
    }

    /// The velocity at time `t` (m/s).
    #[inline(always)]
    pub fn velocity_at(&self, t: f64) -> Vector<D> {
        self.velocity + self.acceleration * t
    }

    /// True if no number of it is infinite or NaN.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.position.is_finite() && self.velocity.is_finite() && self.acceleration.is_finite()
    }
}
