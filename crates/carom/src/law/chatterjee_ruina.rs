//! The law of Chatterjee and Ruina for two rigid bodies of any shape, in closed form: the default.
//!
//! Two impulses bound what a contact can do: P_I brings the approach to a stop without friction, P_II brings all relative
//! motion at the point to a stop. With D = P_II - P_I, which stops the slip and leaves the approach alone (n.K D = 0),
//!
//! ```text
//! P = (1 + e) P_I + (1 + e_t) D        as long as |P_t| <= mu P_n; else the multiple of D that lies on the cone,
//! P = (1 + e) P_I + k D                k = mu (1 + e) P_I,n / (|D_t| - mu D_n)
//! ```
//!
//! so that e in [0, 1] says how fast the bodies part, e_t in [-1, 1] how the slip comes back (-1 smooth, 0 it stops, 1 the
//! superball), and mu bounds the friction.
//!
//! Three lines prove that it never gains energy. n.K D = 0 gives u_n' = -e u_n. P_I is along n, so P_I.K D = 0, and
//! D.u = D.K D. Hence the energy lost is (1 - e^2) u_n^2 / (2 n.K n) + k (2 - k) D.K D / 2, and 0 <= k <= 2.
//!
//! It is a model: where slip stops or turns round within the impact, Coulomb's law followed through the impact
//! ([`super::stronge`]) gives another tangential impulse. For balls nothing couples the two directions, and the law is that of
//! Walton and Luding ([`super::rough`]).
//!
//! Source: A. Chatterjee, A. Ruina, *A new algebraic rigid-body collision law based on impulse space considerations*,
//! Journal of Applied Mechanics 65 (1998).
use super::contact::Contact;
use super::effective::{Effective, dot, length, solve};
use super::routh::{Course, ROUGHEST, Slip};
use crate::material::Coefficients;
use crate::{Rotates, Vector};

/// The impulse P (N s): -P on the first body, +P on the second. Zero if they part, graze, cannot be moved along the normal,
/// or are not numbers.
///
/// # Accuracy
/// u_n' = -e u_n and |P_t| <= mu P_n hold to rounding: a few units in the last place of the speeds at the contact times the
/// condition of K, which is below 10 for compact bodies. With mu = 0 the impulse is that of [`super::smooth`].
pub fn impulse<const D: usize>(contact: &Contact<D>, c: Coefficients) -> Vector<D>
where
    Vector<D>: Rotates,
{
    course(contact, c).impulse
}

/// The impulse, and whether it slips ([`Slip::Kept`]) or lies within the cone ([`Slip::Stuck`]).
pub fn course<const D: usize>(contact: &Contact<D>, c: Coefficients) -> Course<D>
where
    Vector<D>: Rotates,
{
    let k = Effective::of(contact);
    let mut course = Course { impulse: Vector::ZERO, slip: Slip::Kept, steps: 0, fell_back: false };
    if !k.closes() || !(c.restitution >= 0.0) {
        return course;
    }
    let plastic = k.approach / k.normal; // P_I
    let push = (1.0 + c.restitution) * plastic;
    let turn = 1.0 + c.tangential;
    if !(c.friction > 0.0) || !(turn > 0.0) {
        course.impulse = k.vector(push, [0.0; 2]);
        return course;
    }
    let mu = if c.friction < ROUGHEST { c.friction } else { ROUGHEST };
    // D in the contact's axes: the slip that P_I leaves, over K with the approach held (its Schur complement).
    let ratio = k.coupling.map(|x| x / k.normal);
    let held = [0, 1].map(|i| [0, 1].map(|j| k.tangential[i][j] - ratio[i] * k.coupling[j]));
    let left = [0, 1].map(|i| k.slip[i] - k.coupling[i] * plastic);
    let across = solve(&held, left);
    let along = -dot(ratio, across);
    let size = length(across);
    let mut share = turn;
    if share * size > mu * (push + share * along) {
        // Positive: share (size - mu along) > mu push >= 0.
        share = mu * push / (size - mu * along);
    } else {
        course.slip = Slip::Stuck;
    }
    course.impulse = k.vector(push + share * along, across.map(|x| share * x));
    course
}
