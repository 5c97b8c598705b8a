//! Two smooth bodies in any dimension, without an angle: step 11 of the lecture, and the heart of the engine.
//!
//! *Can we do without trigonometry? Project.* Momentum and restitution along the line of centres d, of any length, give
//! with the relative velocity r = va - vb
//!
//! ```text
//! P = (1 + e) (r.d) / ((d.d) (1/ma + 1/mb)) d        va' = va - P/ma        vb' = vb + P/mb
//! ```
//!
//! On the line this is the closed form of [`super::line`], in the plane that of [`super::rotated`]; a wall is inverse mass
//! 0; there is no square root. The energy that is lost is (1 - e^2) mu u^2 / 2, with u the approach speed and mu the
//! reduced mass, in any frame of reference in which a wall that takes part stands still.
use crate::Vector;

/// What a law has to know of a body that only moves: its inverse mass (1/kg; 0 for what nothing can move) and its velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moving<const D: usize> {
    /// 1/m (1/kg); 0 for a wall, a fixed or a driven body.
    pub inverse_mass: f64,
    /// Velocity (m/s).
    pub velocity: Vector<D>,
}

impl<const D: usize> Moving<D> {
    /// A body of this mass (kg; infinite for what nothing can move) and velocity (m/s).
    pub fn new(mass: f64, velocity: impl Into<Vector<D>>) -> Self {
        Self { inverse_mass: 1.0 / mass, velocity: velocity.into() }
    }

    /// What nothing can move, moving at this velocity (m/s): a wall, a piston.
    pub fn driven(velocity: impl Into<Vector<D>>) -> Self {
        Self { inverse_mass: 0.0, velocity: velocity.into() }
    }
}

/// The impulse P (N s) that two smooth bodies exchange: -P acts on `a`, +P on `b`. Zero if they part, graze, cannot move,
/// or are not numbers.
///
/// `along` points from `a` to `b` and may have any length whose square neither overflows nor vanishes; `e` is the coefficient
/// of restitution in [0, 1].
///
/// # Accuracy
/// `along` is not normalised: an error of its unit length would scale the impulse and bias the energy, and the form d d/(d.d)
/// has no such error. Momentum is kept to a few units in the last place of the larger momentum; restitution to about 100
/// units of the relative velocity where masses differ by 1e12. Source: the lecture, step 11.
#[inline(always)]
pub fn impulse<const D: usize>(a: &Moving<D>, b: &Moving<D>, along: Vector<D>, e: f64) -> Vector<D> {
    let approach = (a.velocity - b.velocity).dot(along);
    let inverse_masses = a.inverse_mass + b.inverse_mass;
    let push = (1.0 + e) * approach;
    if !(push > 0.0) || !(inverse_masses > 0.0) {
        return Vector::ZERO; // parting, grazing, immovable, or not a number (e included)
    }
    along * (push / (along.norm_squared() * inverse_masses))
}

/// Hands the impulse to both bodies: the same bits, once with minus and once with plus, so that momentum is kept. A body of
/// inverse mass 0 keeps its velocity to the bit.
#[inline(always)]
pub fn exchange<const D: usize>(a: &mut Moving<D>, b: &mut Moving<D>, impulse: Vector<D>) {
    a.velocity -= impulse * a.inverse_mass;
    b.velocity += impulse * b.inverse_mass;
}

/// The impact of two smooth bodies: [`impulse`], then [`exchange`]. Returns the impulse.
///
/// ```
/// use carom::{Vector, law::smooth::{self, Moving}};
/// // The lecture's two balls: 2 kg at 3 m/s and 1 kg at -1 m/s meet with e = 1/2.
/// let (mut a, mut b) = (Moving::new(2.0, [3.0]), Moving::new(1.0, [-1.0]));
/// let impulse = smooth::impact(&mut a, &mut b, Vector([1.0]), 0.5);
/// assert_eq!(impulse, Vector([4.0]));
/// assert_eq!((a.velocity, b.velocity), (Vector([1.0]), Vector([3.0])));
/// ```
#[inline(always)]
pub fn impact<const D: usize>(a: &mut Moving<D>, b: &mut Moving<D>, along: Vector<D>, e: f64) -> Vector<D> {
    let impulse = impulse(a, b, along, e);
    exchange(a, b, impulse);
    impulse
}

/// The reduced mass mu = 1/(1/ma + 1/mb) (kg): what the relative motion weighs. Infinite if nothing can move.
pub fn reduced_mass<const D: usize>(a: &Moving<D>, b: &Moving<D>) -> f64 {
    1.0 / (a.inverse_mass + b.inverse_mass)
}

/// The kinetic energy (J) that an impact takes: (1 - e^2) mu u^2 / 2 for the approach speed u (m/s, along the line of
/// centres). (1 - e)(1 + e) keeps its digits where e is close to 1.
pub fn energy_lost(reduced_mass: f64, approach: f64, e: f64) -> f64 {
    if !(approach > 0.0) || !reduced_mass.is_finite() {
        return 0.0;
    }
    0.5 * reduced_mass * (1.0 - e) * (1.0 + e) * approach * approach
}
