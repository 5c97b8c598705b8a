//! What happens when they touch: pure functions from a state to an impulse. A law knows no time and no world.
//!
//! The chapters of the lecture, in its order:
//! [`momentum`] (p = m v, F = dp/dt, impulse), [`line`](mod@line) (the closed forms on a line), [`rotated`] (the plane, by angles)
//! and [`smooth`] (any dimension, by projection: what the engine runs). [`together`] goes on where several bodies meet at
//! one instant.
//!
//! The chapter that the lecture leaves out, friction and spin: [`contact`] (two bodies of any shape that touch),
//! [`chatterjee_ruina`] (the default law, closed form), [`rough`] (the same for balls, without a matrix), [`stronge`] and
//! [`newton`] (Coulomb's friction followed through the impact, by [`routh`]). [`Law`] picks one.
use crate::material::Coefficients;
use crate::{Rotates, Vector};

pub mod chatterjee_ruina;
pub mod contact;
mod effective;
pub mod line;
pub mod momentum;
pub mod newton;
pub mod rotated;
pub mod rough;
pub mod routh;
pub mod smooth;
pub mod stronge;
pub mod together;

pub use crate::material::Law;
pub use contact::{Contact, Side};
pub use routh::Course;

impl Law {
    /// The impulse P (N s) of an impact under this law: -P on the first body, +P on the second. Zero if they part, graze,
    /// cannot be moved along the normal, or are not numbers.
    ///
    /// ```
    /// use carom::{Law, Vector, law::{Contact, Side}, material::Coefficients};
    /// // A uniform rod (1 kg, 2 m, at 45 degrees) falls with its lower end on a rough floor, moving to the right.
    /// let half = std::f64::consts::FRAC_1_SQRT_2;
    /// let rod = Side {
    ///     velocity: Vector([1.0, -1.0]),
    ///     spin: Vector([0.0]),
    ///     inverse_mass: 1.0,
    ///     inverse_inertia: 3.0,
    ///     arm: Vector([-half, -half]),
    /// };
    /// let contact = Contact { normal: Vector([0.0, -1.0]), sides: [rod, Side::driven(Vector::ZERO)] };
    /// let c = Coefficients { restitution: 1.0, friction: 0.5, ..Default::default() };
    /// let lost = |law: Law| contact.energy_lost(law.impulse(&contact, c));
    /// assert!((lost(Law::ChatterjeeRuina) - 0.05).abs() < 1e-15);
    /// assert!(lost(Law::Stronge) > 0.0);
    /// assert!(lost(Law::Newton) < -0.02, "the textbook's rule makes energy out of nothing");
    /// ```
    #[inline]
    pub fn impulse<const D: usize>(self, contact: &Contact<D>, c: Coefficients) -> Vector<D>
    where
        Vector<D>: Rotates,
    {
        self.course(contact, c).impulse
    }

    /// The same, and how it was found: how many steps an integration took, and whether it was cut off.
    pub fn course<const D: usize>(self, contact: &Contact<D>, c: Coefficients) -> Course<D>
    where
        Vector<D>: Rotates,
    {
        match self {
            Self::ChatterjeeRuina => chatterjee_ruina::course(contact, c),
            Self::Stronge => stronge::impulse(contact, c),
            Self::Newton => newton::impulse(contact, c),
        }
    }
}
