//! What meets at one instant: bodies as degrees of freedom, contacts as sparse columns.
use alloc::vec::Vec;

use crate::{Vector, vector::Exact};

/// Bodies and the contacts between them at one instant.
///
/// A body is a run of degrees of freedom, each with a velocity (m/s, rad/s) and an inverse mass (1/kg, 1/(kg m^2); 0 for
/// what nothing can move). A contact i is a column N_i and, for walls, a drive d_i (m/s): u_i = N_i . v + d_i is the velocity
/// at which it opens (m/s), so that u_i < 0 approaches. An impulse lambda_i >= 0 (N s) changes v by M^-1 N_i lambda_i.
///
/// Cleared and filled again it allocates nothing: it is made to sit in an event loop.
///
/// ```
/// use carom::{Vector, law::together::{self, System}};
/// // Newton's cradle: the first of three touching balls comes in.
/// let mut cradle = System::new();
/// let balls = [1.0, 0.0, 0.0].map(|v| cradle.ball(1.0, Vector([v])));
/// cradle.pair(balls[0], balls[1], Vector([1.0]));
/// cradle.pair(balls[1], balls[2], Vector([1.0]));
/// let outcome = together::reflect(&mut cradle, |_, _| 1.0);
/// assert_eq!(cradle.velocities(), [0.0, 0.0, 1.0]);
/// assert_eq!((outcome.iterations, outcome.capped), (2, false));
/// ```
#[derive(Clone, Debug, Default)]
pub struct System {
    velocity: Vec<f64>,
    inverse_mass: Vec<f64>,
    /// For each degree of freedom the first one of its body.
    owner: Vec<u32>,
    /// Column i is `entries[ends[i - 1]..ends[i]]`.
    ends: Vec<usize>,
    entries: Vec<(u32, f64)>,
    drive: Vec<f64>,
}

impl System {
    /// Nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets bodies and contacts, and keeps the memory.
    pub fn clear(&mut self) {
        self.velocity.clear();
        self.inverse_mass.clear();
        self.owner.clear();
        self.ends.clear();
        self.entries.clear();
        self.drive.clear();
    }

    /// Adds a body: the velocity and the inverse mass of each degree of freedom. Returns its first degree of freedom, which
    /// is its name here.
    pub fn body(&mut self, freedoms: impl IntoIterator<Item = (f64, f64)>) -> usize {
        let first = self.velocity.len();
        for (velocity, inverse_mass) in freedoms {
            self.velocity.push(velocity);
            self.inverse_mass.push(inverse_mass);
            self.owner.push(first as u32);
        }
        first
    }

    /// Adds a ball that only moves: inverse mass (1/kg; 0 for a fixed or driven one) and velocity (m/s).
    pub fn ball<const D: usize>(&mut self, inverse_mass: f64, velocity: Vector<D>) -> usize {
        self.body(velocity.0.map(|v| (v, inverse_mass)))
    }

    /// Adds a contact: its column as (degree of freedom, value), and its drive (m/s; 0 unless what lies behind it moves and
    /// is no body here). Values for the same degree of freedom add up.
    ///
    /// # Panics
    /// If a degree of freedom does not exist.
    pub fn contact(&mut self, column: impl IntoIterator<Item = (usize, f64)>, drive: f64) -> usize {
        let start = self.entries.len();
        for (freedom, value) in column {
            assert!(freedom < self.velocity.len(), "degree of freedom {freedom} of {}", self.velocity.len());
            match self.entries[start..].iter_mut().find(|e| e.0 as usize == freedom) {
                Some(entry) => entry.1 += value,
                None => self.entries.push((freedom as u32, value)),
            }
        }
        self.ends.push(self.entries.len());
        self.drive.push(drive);
        self.ends.len() - 1
    }

    /// Adds the contact of two balls (bodies whose first `D` degrees of freedom are a velocity): `normal` is a unit vector
    /// from `a` to `b`, u = (vb - va).n.
    ///
    /// # Panics
    /// If a body does not exist.
    pub fn pair<const D: usize>(&mut self, a: usize, b: usize, normal: Vector<D>) -> usize {
        self.contact((0..D).map(|k| (a + k, -normal[k])).chain((0..D).map(|k| (b + k, normal[k]))), 0.0)
    }

    /// Adds the contact of a ball with a wall: `normal` is a unit vector from the ball to the wall, which moves at
    /// `wall_velocity` (m/s) whatever hits it; u = (V - va).n.
    ///
    /// # Panics
    /// If the body does not exist.
    pub fn wall<const D: usize>(&mut self, a: usize, normal: Vector<D>, wall_velocity: Vector<D>) -> usize {
        self.contact((0..D).map(|k| (a + k, -normal[k])), wall_velocity.dot(normal))
    }

    /// How many contacts there are.
    pub fn contacts(&self) -> usize {
        self.ends.len()
    }

    /// The velocities of all degrees of freedom, in the order of the bodies.
    pub fn velocities(&self) -> &[f64] {
        &self.velocity
    }

    /// The same, to be set.
    pub fn velocities_mut(&mut self) -> &mut [f64] {
        &mut self.velocity
    }

    /// The velocity of a ball.
    ///
    /// # Panics
    /// If the body does not exist.
    pub fn velocity<const D: usize>(&self, body: usize) -> Vector<D> {
        Vector::from_fn(|k| self.velocity[body + k])
    }

    /// The inverse masses of all degrees of freedom.
    pub fn inverse_masses(&self) -> &[f64] {
        &self.inverse_mass
    }

    /// The column of contact `i`: (degree of freedom, value).
    ///
    /// # Panics
    /// If there is no such contact.
    pub fn column(&self, i: usize) -> &[(u32, f64)] {
        let start = if i == 0 { 0 } else { self.ends[i - 1] };
        &self.entries[start..self.ends[i]]
    }

    /// u_i (m/s): the velocity at which contact `i` opens; negative if it approaches.
    ///
    /// # Panics
    /// If there is no such contact.
    pub fn opening(&self, i: usize) -> f64 {
        let mut u = 0.0;
        for &(k, value) in self.column(i) {
            u += value * self.velocity[k as usize];
        }
        u + self.drive[i]
    }

    /// Q_ii (1/kg): what contact `i` opens faster by for an impulse of 1 N s. 0 if nothing of it can move.
    ///
    /// # Panics
    /// If there is no such contact.
    pub fn yielding(&self, i: usize) -> f64 {
        let mut q = 0.0;
        for &(k, value) in self.column(i) {
            q += self.movable(k) * (value * value);
        }
        q
    }

    /// Hands the impulse `lambda` (N s) to the bodies of contact `i`. What cannot move keeps its velocity to the bit.
    ///
    /// # Panics
    /// If there is no such contact.
    pub fn push(&mut self, i: usize, lambda: f64) {
        let start = if i == 0 { 0 } else { self.ends[i - 1] };
        for &(k, value) in &self.entries[start..self.ends[i]] {
            let w = self.inverse_mass[k as usize];
            if w > 0.0 {
                self.velocity[k as usize] += w * (value * lambda); // the bracket has the same bits for both bodies
            }
        }
    }

    /// The kinetic energy of what can move (J).
    pub fn kinetic_energy(&self) -> f64 {
        let moving = self.velocity.iter().zip(&self.inverse_mass).filter(|(_, w)| **w > 0.0);
        moving.map(|(v, w)| 0.5 * v * v / w).sum()
    }

    /// The part of u_i that no impulse changes (m/s): the drive, and the velocities of bodies that nothing moves.
    pub(super) fn fixed_opening(&self, i: usize) -> f64 {
        let fixed = self.column(i).iter().filter(|e| !(self.movable(e.0) > 0.0));
        fixed.map(|&(k, value)| value * self.velocity[k as usize]).sum::<f64>() + self.drive[i]
    }

    /// The first degree of freedom of the body that has this one.
    pub(super) fn owner(&self, freedom: u32) -> u32 {
        self.owner[freedom as usize]
    }

    /// The inverse mass of a degree of freedom; 0 if it is not a positive number.
    pub(super) fn movable(&self, freedom: u32) -> f64 {
        let w = self.inverse_mass[freedom as usize];
        if w > 0.0 { w } else { 0.0 }
    }

    /// True if contact `i` can be changed by an impulse.
    pub(super) fn yields(&self, i: usize) -> bool {
        self.yielding(i) >= f64::MIN_POSITIVE
    }

    /// The scale of the velocities at the contacts (m/s): the largest sum of magnitudes that makes a u_i. Rounding errors of
    /// every u_i are a few eps of it.
    pub fn scale(&self) -> f64 {
        let mut scale = 0.0;
        for i in 0..self.contacts() {
            let mut sum = self.drive[i].abs_();
            for &(k, value) in self.column(i) {
                sum += (value * self.velocity[k as usize]).abs_();
            }
            if sum > scale {
                scale = sum;
            }
        }
        scale
    }

    /// True if every number is finite.
    pub(super) fn is_finite(&self) -> bool {
        self.velocity.iter().chain(&self.inverse_mass).chain(&self.drive).all(|x| x.is_finite())
            && self.entries.iter().all(|e| e.1.is_finite())
            && (0..self.contacts()).all(|i| self.yielding(i).is_finite())
            && self.scale().is_finite()
    }
}
