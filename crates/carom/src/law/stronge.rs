//! Stronge's law: Coulomb's friction through the course of the impact, and energetic restitution at its end.
//!
//! The impact is followed as the normal impulse p grows from 0 ([`super::routh`]): the bodies slip against friction, the slip
//! may stop, stick or turn round; the approach speed u_n falls to zero at the end of compression, by when
//! W = integral of u_n dp has gone into the contact. Restitution gives e^2 W of it back, and the impact is over:
//!
//! ```text
//! integral of u_n dp over restitution = -e^2 W
//! ```
//!
//! So e = 0 takes all of the normal work and e = 1 none, and no impact gains energy: the normal work loses (1 - e^2) W, and
//! friction opposes the slip at every instant. The departure speed is e times the approach speed only where the slip does not
//! stop within the impact, and for balls.
//!
//! The tangential restitution e_t plays no part: Coulomb's law alone rules the slip, so that a contact that sticks keeps e_t
//! at 0 for balls.
//!
//! Source: W. J. Stronge, *Rigid body collisions with friction*, Proceedings of the Royal Society A 431 (1990); *Impact
//! Mechanics* (2000).
use super::contact::Contact;
use super::routh::{self, Course};
use crate::material::Coefficients;
use crate::{Rotates, Vector};

/// The impulse P (N s) that acts as -P on the first body and as +P on the second, and how it was found. Zero if the bodies
/// part, graze, cannot be moved along the normal, or are not numbers.
///
/// # Accuracy
/// To rounding where the slip keeps its line: in the plane, for balls, and from where it first stops. Else the first slip is
/// integrated with the tolerance of [`routh`].
pub fn impulse<const D: usize>(contact: &Contact<D>, c: Coefficients) -> Course<D>
where
    Vector<D>: Rotates,
{
    routh::follow(contact, c, routh::End::Energy)
}
