//! The rough sphere: balls with friction and spin in closed form, without a matrix (Walton and Luding).
//!
//! The arms of a ball are along the normal, so nothing couples the two directions, and
//!
//! ```text
//! P_n = (1 + e) m_n u_n                                   1/m_n = 1/ma + 1/mb
//! P_t = min( mu P_n, (1 + e_t) m_t |u_t| ) u_t/|u_t|      1/m_t = (1 + 1/ka)/ma + (1 + 1/kb)/mb
//! ```
//!
//! where k is the number of I = k m R^2 (2/5 for a solid sphere, whose m_t against a wall is 2/7 m; 1/2 for a disc, m/3; 2/3
//! for a shell). The first branch of the minimum slips, the second sticks. Energy lost is (1 - e^2) m_n u_n^2 / 2 and, for
//! friction, (1 - e_t^2) m_t u_t^2 / 2 if it sticks or s |u_t| - s^2/(2 m_t) with s = mu P_n if it slips: never less than
//! nothing. It is the law of [`super::chatterjee_ruina`] for balls, and the engine's way for them.
//!
//! Sources: O. R. Walton, *Numerical simulation of inelastic, frictional particle-particle interactions* (1993); S. Luding,
//! *Collisions and contacts between two particles* (1998); the superball (e = e_t = 1): R. L. Garwin, *Kinematics of an
//! ultraelastic rough ball*, American Journal of Physics 37 (1969).
use super::smooth::{self, Moving};
use crate::material::Coefficients;
use crate::vector::Exact;
use crate::{Rotates, Vector};

/// A ball that moves and turns, or what nothing can move or turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turning<const D: usize>
where
    Vector<D>: Rotates,
{
    /// Inverse mass (1/kg; 0 for what nothing can move or turn) and velocity (m/s).
    pub moving: Moving<D>,
    /// Spin (rad/s).
    pub spin: <Vector<D> as Rotates>::Spin,
    /// Radius (m); 0 for a wall.
    pub radius: f64,
    /// k in I = k m R^2.
    pub kappa: f64,
}

impl<const D: usize> Turning<D>
where
    Vector<D>: Rotates,
{
    /// A wall at this velocity (m/s).
    pub fn wall(velocity: impl Into<Vector<D>>) -> Self {
        Self { moving: Moving::driven(velocity), spin: Default::default(), radius: 0.0, kappa: 1.0 }
    }

    /// What one newton second across the normal does to the speed of the contact point (1/kg): (1 + 1/k)/m.
    fn tangential(&self) -> f64 {
        self.moving.inverse_mass * (1.0 + 1.0 / self.kappa)
    }
}

/// The slip (m/s) of the first ball's contact point over the second's: the relative velocity there across `along`, which
/// points from `a` to `b` and may have any length but 0.
#[inline]
pub fn slip<const D: usize>(a: &Turning<D>, b: &Turning<D>, along: Vector<D>) -> Vector<D>
where
    Vector<D>: Rotates,
{
    let square = along.norm_squared();
    let r = a.moving.velocity - b.moving.velocity;
    let across = r - along * (r.dot(along) / square);
    // va + wa x (Ra n) - vb - wb x (-Rb n)
    across + Vector::<D>::turned(a.spin * a.radius + b.spin * b.radius, along * (1.0 / square.sqrt_()))
}

/// 1/m_t (1/kg): what one newton second across the normal does to the slip.
#[inline]
pub fn inverse_tangential_mass<const D: usize>(a: &Turning<D>, b: &Turning<D>) -> f64
where
    Vector<D>: Rotates,
{
    a.tangential() + b.tangential()
}

/// The impulse (N s) along the normal and across it: minus their sum acts on `a`, plus their sum on `b`. Both are zero if the
/// balls part, graze, cannot be moved, or are not numbers.
///
/// `along` points from `a` to `b` and may have any length whose square neither overflows nor vanishes.
///
/// # Accuracy
/// The normal part is that of [`smooth::impulse`] to the bit, whatever the friction. Nothing is subtracted but the velocities:
/// the parts are good to a few units in the last place of the slip and of the approach, for any ratio of masses.
#[inline]
pub fn parts<const D: usize>(a: &Turning<D>, b: &Turning<D>, along: Vector<D>, c: Coefficients) -> [Vector<D>; 2]
where
    Vector<D>: Rotates,
{
    let normal = smooth::impulse(&a.moving, &b.moving, along, c.restitution);
    let push = normal.norm();
    if !(c.friction > 0.0) || !(push > 0.0) {
        return [normal, Vector::ZERO];
    }
    let slip = slip(a, b, along);
    let speed = slip.norm();
    if !(speed > 0.0) {
        return [normal, Vector::ZERO];
    }
    // As multiples of the slip itself; a slip so small that the cone's multiple overflows sticks.
    let stick = (1.0 + c.tangential) / inverse_tangential_mass(a, b);
    let cone = c.friction * push / speed;
    [normal, slip * if cone < stick { cone } else { stick }]
}

/// The impulse P (N s) as one vector: -P acts on `a`, +P on `b`.
#[inline]
pub fn impulse<const D: usize>(a: &Turning<D>, b: &Turning<D>, along: Vector<D>, c: Coefficients) -> Vector<D>
where
    Vector<D>: Rotates,
{
    let [normal, across] = parts(a, b, along, c);
    normal + across
}

/// Hands the two parts of an impulse to both balls: velocities and spins. Only the part across the normal turns them: without
/// friction spins keep their bits. What cannot be moved keeps both to the bit.
#[inline]
pub fn exchange<const D: usize>(a: &mut Turning<D>, b: &mut Turning<D>, along: Vector<D>, parts: [Vector<D>; 2])
where
    Vector<D>: Rotates,
{
    let [normal, across] = parts;
    smooth::exchange(&mut a.moving, &mut b.moving, normal + across);
    if across == Vector::ZERO {
        return;
    }
    // Ra n x (-P) on the first and -Rb n x P on the second: the same sense for both, over I = k m R^2.
    let moment = Vector::<D>::moment(along * (1.0 / along.norm_squared().sqrt_()), across);
    for ball in [a, b] {
        if ball.moving.inverse_mass > 0.0 && ball.radius > 0.0 {
            ball.spin -= moment * (ball.moving.inverse_mass / (ball.kappa * ball.radius));
        }
    }
}
