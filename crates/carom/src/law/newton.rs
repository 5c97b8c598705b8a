//! The textbook's rule: Coulomb's friction through the course of the impact, and Newton's coefficient at its end.
//!
//! Slip, sticking and slip the other way follow one another as in [`super::stronge`]; the impact ends when the bodies part at
//! e times the speed of approach, whatever that takes.
//!
//! **It can gain energy.** Where friction turns the slip round, the normal speed that e asks for is bought with more than was
//! put in, as T. Kane and D. Levinson showed on an example (*Dynamics: Theory and Applications*, 1985). A rod that falls at 45
//! degrees onto a floor with e = 1 and mu = 1/2 gains 136/5929 of its energy; of rods at every angle with e = 1, mu = 1 one in
//! five gains, up to 18 per cent (`examples/laws.rs`). The law is here to be compared with, and the ledger shows what it gains.
//! Balls never gain: nothing couples their directions.
//!
//! The tangential restitution e_t plays no part: Coulomb's law alone rules the slip.
use super::contact::Contact;
use super::routh::{self, Course};
use crate::material::Coefficients;
use crate::{Rotates, Vector};

/// The impulse P (N s) that acts as -P on the first body and as +P on the second, and how it was found. Zero if the bodies
/// part, graze, cannot be moved along the normal, or are not numbers.
///
/// # Accuracy
/// u_n' = -e u_n to rounding where the slip keeps its line (in the plane always), else to the tolerance of
/// [`routh`].
pub fn impulse<const D: usize>(contact: &Contact<D>, c: Coefficients) -> Course<D>
where
    Vector<D>: Rotates,
{
    routh::follow(contact, c, routh::End::Speed)
}
