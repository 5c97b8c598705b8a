//! Friction where several contacts meet: one solve with the normal impulses as they are.
//!
//! After the normal impulses lambda are known, the tangential impulses b of all contacts together take what slip they can:
//!
//! ```text
//! minimise  1/2 b.Q b - b.c        |b_i| <= mu_i lambda_i        c_i = (1 + e_t,i) s_i
//! ```
//!
//! with s the slip before and Q b what the impulses take from it. One contact alone: b = min(mu lambda, (1 + e_t) m_t |s|)
//! along s, the law of rough spheres. Resistance to rolling and to spinning are moments between the same two bodies with
//! limits of their own, and join the same problem. The minimum is unique in the velocities, though not always in b.
//!
//! # Accuracy
//! b = 0 is allowed, and so with e_t = 0 everywhere the energy that is lost, 1/2 sum b_i.(s_i + s_i'), is at least
//! 1/2 b.Q b >= 0; with one e_t for all contacts at least (1 - e_t^2)/2 times a like sum. Where e_t differs from contact to
//! contact nothing guarantees that, so that the impulses are scaled down until nothing is gained. Model: the normal
//! impulses do not know of friction; the projection that follows where friction closes a contact does (THEORY 3.6, after
//! B. Smith et al. 2012). Solved by sweeps over the contacts in their order, to [`RUB_TOLERANCE`] of the velocities.
use alloc::vec::Vec;

use crate::vector::Exact;
use crate::{Rotates, Vector};

/// How far the last sweep may still change a velocity, relative to the largest slip.
pub const RUB_TOLERANCE: f64 = 1e-14;
/// Sweeps over the contacts at most. What is left then is still within every limit, and takes energy.
pub const SWEEPS: u32 = 1000;

/// A ball that the contacts act on.
#[derive(Clone, Copy, Debug)]
pub struct Turning<const D: usize>
where
    Vector<D>: Rotates,
{
    /// 1/m (1/kg).
    pub inverse_mass: f64,
    /// 1/I (1/(kg m^2)).
    pub inverse_inertia: f64,
    /// Velocity (m/s).
    pub velocity: Vector<D>,
    /// Spin (rad/s).
    pub spin: <Vector<D> as Rotates>::Spin,
}

/// One party of a contact: a place in the list of bodies, or the velocity (m/s) of an immovable surface.
#[derive(Clone, Copy, Debug)]
pub enum Rubbing<const D: usize> {
    /// The body of this number.
    Body(usize),
    /// A wall, or a fixed body: how fast its surface moves at the contact.
    Surface(Vector<D>),
}

/// A contact that presses.
#[derive(Clone, Copy, Debug)]
pub struct Rough<const D: usize>
where
    Vector<D>: Rotates,
{
    /// First and second.
    pub parties: [Rubbing<D>; 2],
    /// From each centre to the common point of contact (m), along the normal.
    pub arms: [Vector<D>; 2],
    /// Unit vector from the first to the second.
    pub normal: Vector<D>,
    /// mu lambda (N s).
    pub limit: f64,
    /// e_t in [-1, 1].
    pub tangential: f64,
    /// The largest moment impulses (N m s) that resist rolling and spinning.
    pub rolling: f64,
    /// See `rolling`.
    pub spinning: f64,
    /// The tangential impulse on the second (N s); what it holds at entry is where the solution starts.
    pub impulse: Vector<D>,
    /// The moment impulse on the second (N m s), of both resistances; likewise.
    pub moment: <Vector<D> as Rotates>::Spin,
}

/// What of the spin turns about an axis across this unit vector: rolling. The rest turns about it.
pub fn rolling<const D: usize>(spin: <Vector<D> as Rotates>::Spin, unit: Vector<D>) -> <Vector<D> as Rotates>::Spin
where
    Vector<D>: Rotates,
{
    Vector::<D>::moment(unit, Vector::<D>::turned(spin, unit))
}

fn length<const D: usize>(spin: <Vector<D> as Rotates>::Spin) -> f64
where
    Vector<D>: Rotates,
{
    Vector::<D>::spin_dot(spin, spin).sqrt_()
}

impl<const D: usize> Rough<D>
where
    Vector<D>: Rotates,
{
    /// A contact that does not rub yet: its limits and its impulses are nothing.
    pub fn new(parties: [Rubbing<D>; 2], arms: [Vector<D>; 2], normal: Vector<D>) -> Self {
        Self {
            parties,
            arms,
            normal,
            limit: 0.0,
            tangential: 0.0,
            rolling: 0.0,
            spinning: 0.0,
            impulse: Vector::ZERO,
            moment: Default::default(),
        }
    }

    fn party(&self, k: usize, bodies: &[Turning<D>]) -> (f64, f64, Vector<D>, <Vector<D> as Rotates>::Spin) {
        match self.parties[k] {
            Rubbing::Body(i) => {
                let b = &bodies[i];
                let surface = b.velocity + Vector::<D>::turned(b.spin, self.arms[k]);
                (b.inverse_mass, b.inverse_inertia, surface, b.spin)
            }
            Rubbing::Surface(velocity) => (0.0, 0.0, velocity, Default::default()),
        }
    }

    /// The slip (m/s): the tangential part of the relative velocity of the two surfaces, first minus second.
    pub fn slip(&self, bodies: &[Turning<D>]) -> Vector<D> {
        let relative = self.party(0, bodies).2 - self.party(1, bodies).2;
        relative - self.normal * relative.dot(self.normal)
    }

    /// The relative spin (rad/s), first minus second.
    pub fn relative_spin(&self, bodies: &[Turning<D>]) -> <Vector<D> as Rotates>::Spin {
        self.party(0, bodies).3 - self.party(1, bodies).3
    }

    /// How it yields.
    fn yields(&self, bodies: &[Turning<D>]) -> Yields {
        let (mut yielding, mut turning) = (0.0, 0.0);
        for k in 0..2 {
            let (w, by_turning, ..) = self.party(k, bodies);
            yielding += w + by_turning * self.arms[k].norm_squared();
            turning += by_turning;
        }
        Yields { yielding, turning, reach: self.arms[0].norm().max(self.arms[1].norm()) }
    }

    /// Hands over an impulse (+ on the second, - on the first) and a moment.
    pub(crate) fn push(&self, bodies: &mut [Turning<D>], impulse: Vector<D>, moment: <Vector<D> as Rotates>::Spin) {
        for (k, sign) in [(0, -1.0), (1, 1.0)] {
            if let Rubbing::Body(i) = self.parties[k] {
                let b = &mut bodies[i];
                b.velocity += impulse * (sign * b.inverse_mass);
                let turn = Vector::<D>::moment(self.arms[k], impulse) + moment;
                b.spin += turn * (sign * b.inverse_inertia);
            }
        }
    }

    /// One contact takes what it can, the others as they stand: of the slip what is more than -e_t times the `first` one, and of the
    /// relative spin. Returns the largest change of velocity (m/s).
    #[inline]
    fn rub(&mut self, bodies: &mut [Turning<D>], first: Vector<D>, Yields { yielding, turning, reach }: Yields) -> f64 {
        let mut change: f64 = 0.0;
        if self.limit > 0.0 && yielding > 0.0 {
            let excess = self.slip(bodies) + first * self.tangential;
            let wanted = held_to(self.impulse + excess / yielding, self.limit);
            let more = wanted - self.impulse;
            self.impulse = wanted;
            self.push(bodies, more, Default::default());
            change = more.norm() * yielding;
        }
        if (self.rolling > 0.0 || self.spinning > 0.0) && turning > 0.0 {
            let spin = self.relative_spin(bodies);
            let across = rolling(spin, self.normal);
            let old = rolling(self.moment, self.normal);
            let rolls = turn_held_to::<D>(old + across * (1.0 / turning), self.rolling);
            // In the plane nothing turns about the normal.
            let about =
                if D == 3 { (self.moment - old) + (spin - across) * (1.0 / turning) } else { Default::default() };
            let wanted = rolls + turn_held_to::<D>(about, self.spinning);
            let more = wanted - self.moment;
            self.moment = wanted;
            self.push(bodies, Vector::ZERO, more);
            change = change.max(length::<D>(more) * turning * reach);
        }
        change
    }

    /// Cuts the impulses to their limits.
    fn hold(&mut self) {
        self.impulse = held_to(self.impulse, self.limit);
        let across = rolling(self.moment, self.normal);
        self.moment = turn_held_to::<D>(across, self.rolling) + turn_held_to::<D>(self.moment - across, self.spinning);
    }

    fn is_idle(&self) -> bool {
        !(self.limit > 0.0 || self.rolling > 0.0 || self.spinning > 0.0)
    }
}

/// How a contact yields.
#[derive(Clone, Copy, Debug)]
struct Yields {
    /// What a unit of tangential impulse takes from the slip: 1/m_t (1/kg). The same in every direction, since the arms lie along the
    /// normal.
    yielding: f64,
    /// What a unit of moment takes from the relative spin (1/(kg m^2)).
    turning: f64,
    /// The longer arm (m).
    reach: f64,
}

fn held_to<const D: usize>(v: Vector<D>, limit: f64) -> Vector<D> {
    let size = v.norm();
    if size <= limit {
        v
    } else if limit > 0.0 {
        v * (limit / size)
    } else {
        Vector::ZERO
    }
}

fn turn_held_to<const D: usize>(s: <Vector<D> as Rotates>::Spin, limit: f64) -> <Vector<D> as Rotates>::Spin
where
    Vector<D>: Rotates,
{
    let size = length::<D>(s);
    if size <= limit {
        s
    } else if limit > 0.0 {
        s * (limit / size)
    } else {
        Default::default()
    }
}

/// The friction of all contacts: leaves the impulses in them, and the velocities and spins in the bodies. Starts from the
/// impulses that the contacts hold, cut to their limits, and goes over them `sweeps` times at most. Returns the energy (J) that it took, >= 0 but for rounding.
pub fn rub<const D: usize>(bodies: &mut [Turning<D>], contacts: &mut [Rough<D>], tolerance: f64, sweeps: u32) -> f64
where
    Vector<D>: Rotates,
{
    let first: Vec<Vector<D>> = contacts.iter().map(|c| c.slip(bodies)).collect();
    let turned: Vec<_> = contacts.iter().map(|c| c.relative_spin(bodies)).collect();
    let start = bodies.to_vec();
    let mut scale = 0.0;
    for (c, s) in contacts.iter_mut().zip(&first) {
        let spins = (0..2).map(|k| length::<D>(c.party(k, bodies).3)).sum::<f64>() * c.yields(bodies).reach;
        scale = f64::max(scale, s.norm() + spins);
        c.hold();
    }
    for c in contacts.iter() {
        if !c.is_idle() {
            c.push(bodies, c.impulse, c.moment);
        }
    }
    let yields: Vec<Yields> = contacts.iter().map(|c| c.yields(bodies)).collect();
    for _ in 0..sweeps {
        let mut change: f64 = 0.0;
        for ((c, first), yields) in contacts.iter_mut().zip(&first).zip(&yields) {
            change = change.max(c.rub(bodies, *first, *yields));
        }
        if !(change > tolerance * scale) {
            break;
        }
    }
    // Once more from the start: what thousands of small pushes rounded away would be missing in the accounts.
    bodies.copy_from_slice(&start);
    for c in contacts.iter() {
        c.push(bodies, c.impulse, c.moment);
    }
    let (mut asked, mut took) = (0.0, 0.0);
    for (k, c) in contacts.iter().enumerate() {
        let last = c.slip(bodies);
        let (before, after) = (turned[k], c.relative_spin(bodies));
        asked += c.impulse.dot(first[k]) + Vector::<D>::spin_dot(c.moment, before);
        took += 0.5 * (c.impulse.dot(first[k] + last) + Vector::<D>::spin_dot(c.moment, before + after));
    }
    // A superball takes nothing, but for rounding.
    if !(took < -1e-14 * asked.abs_()) {
        return took;
    }
    // Scaled by s, the impulses take s asked - s^2 (asked - took): nothing is gained up to the factor below.
    let part = if asked > 0.0 { (asked / (asked - took)) * (1.0 - 1e-12) } else { 0.0 };
    bodies.copy_from_slice(&start);
    for c in contacts.iter_mut() {
        (c.impulse, c.moment) = (c.impulse * part, c.moment * part);
        c.push(bodies, c.impulse, c.moment);
    }
    part * asked - part * part * (asked - took)
}

/// How a contact presses while it rubs: what [`grind`] finds along the normal.
#[derive(Clone, Copy, Debug)]
pub struct Pressing {
    /// mu, and the moments that resist rolling and spinning, for each unit of normal impulse (m).
    pub friction: f64,
    /// See `friction`.
    pub rolling: f64,
    /// See `friction`.
    pub spinning: f64,
    /// The least opening speed (m/s).
    pub bound: f64,
    /// The normal impulse (N s), >= 0; what it holds at entry is where the solution starts.
    pub lambda: f64,
}

/// Normal impulses and friction of contacts that last, together: each contact in turn opens as fast as it must, and then rubs as its
/// own normal impulse allows (nonlinear Gauss-Seidel; Jean & Moreau 1992). Starts from the impulses that the contacts hold, and
/// goes over them until no velocity changes by more than `tolerance` (m/s), `sweeps` times at most. Leaves velocities and
/// impulses as they came out: good to that tolerance, and dependent on the order of the contacts by as much.
pub fn grind<const D: usize>(
    bodies: &mut [Turning<D>],
    contacts: &mut [Rough<D>],
    pressing: &mut [Pressing],
    tolerance: f64,
    sweeps: u32,
) -> u32
where
    Vector<D>: Rotates,
{
    for (c, p) in contacts.iter_mut().zip(pressing.iter()) {
        c.allow(p);
        c.hold();
        c.push(bodies, c.impulse, c.moment);
        c.press(bodies, p.lambda);
    }
    let yields: Vec<Yields> = contacts.iter().map(|c| c.yields(bodies)).collect();
    for sweep in 0..sweeps {
        let mut change: f64 = 0.0;
        for ((c, p), yields) in contacts.iter_mut().zip(pressing.iter_mut()).zip(&yields) {
            let (wa, _, va, _) = c.party(0, bodies);
            let (wb, _, vb, _) = c.party(1, bodies);
            let missing = p.bound - (vb - va).dot(c.normal);
            let wanted = p.lambda + missing / (wa + wb);
            let wanted = if wanted > 0.0 { wanted } else { 0.0 };
            if wanted != p.lambda {
                c.press(bodies, wanted - p.lambda);
                change = change.max((wanted - p.lambda).abs_() * (wa + wb));
                p.lambda = wanted;
                c.allow(p);
            }
            if p.friction > 0.0 && (p.lambda > 0.0 || c.impulse != Vector::ZERO) {
                change = change.max(c.rub(bodies, Vector::ZERO, *yields));
                if c.is_idle() {
                    let (impulse, moment) = (c.impulse, c.moment);
                    c.hold();
                    c.push(bodies, c.impulse - impulse, c.moment - moment);
                }
            }
        }
        if !(change > tolerance) {
            return sweep + 1;
        }
    }
    sweeps
}

impl<const D: usize> Rough<D>
where
    Vector<D>: Rotates,
{
    fn allow(&mut self, p: &Pressing) {
        (self.limit, self.rolling, self.spinning) =
            (p.friction * p.lambda, p.rolling * p.lambda, p.spinning * p.lambda);
    }

    /// Hands over an impulse along the normal: + on the second, - on the first.
    fn press(&self, bodies: &mut [Turning<D>], impulse: f64) {
        for (k, sign) in [(0, -1.0), (1, 1.0)] {
            if let Rubbing::Body(i) = self.parties[k] {
                let b = &mut bodies[i];
                b.velocity += self.normal * (impulse * sign * b.inverse_mass);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(v: [f64; 2], w: f64) -> Turning<2> {
        Turning { inverse_mass: 1.0, inverse_inertia: 2.5, velocity: Vector(v), spin: Vector([w]) }
    }

    fn on_floor(i: usize, limit: f64, tangential: f64) -> Rough<2> {
        let down = Vector([0.0, -1.0]);
        let parties = [Rubbing::Body(i), Rubbing::Surface(Vector::ZERO)];
        Rough { limit, tangential, ..Rough::new(parties, [down, Vector::ZERO], down) }
    }

    /// THEORY 2.2: a solid ball on a floor, kappa = 2/5, m = R = 1, at 3 m/s without spin. In the plane a spin to the right
    /// is clockwise: w = -15/7.
    #[test]
    fn one_contact_is_the_law_of_rough_spheres() {
        let mut bodies = [ball([3.0, 0.0], 0.0)];
        let took = rub(&mut bodies, &mut [on_floor(0, 30.0, 0.0)], RUB_TOLERANCE, SWEEPS);
        assert!((bodies[0].velocity[0] - 15.0 / 7.0).abs() < 1e-15 && (bodies[0].spin[0] + 15.0 / 7.0).abs() < 1e-15);
        assert!((took - 9.0 / 7.0).abs() < 1e-14, "1/2 m_t s^2 with m_t = 2/7: {took}");
        // mu lambda = 3/10: it slips.
        let mut bodies = [ball([3.0, 0.0], 0.0)];
        rub(&mut bodies, &mut [on_floor(0, 0.3, 0.0)], RUB_TOLERANCE, SWEEPS);
        assert!((bodies[0].velocity[0] - 2.7).abs() < 1e-15 && (bodies[0].spin[0] + 0.75).abs() < 1e-15);
        // A superball: the slip turns round, nothing is lost.
        let mut bodies = [ball([3.0, 0.0], 0.0)];
        let took = rub(&mut bodies, &mut [on_floor(0, 30.0, 1.0)], RUB_TOLERANCE, SWEEPS);
        assert!((bodies[0].velocity[0] - 9.0 / 7.0).abs() < 1e-14 && (bodies[0].spin[0] + 30.0 / 7.0).abs() < 1e-14);
        assert!(took.abs() < 1e-14);
    }

    /// A chain of rough discs between two plates, one of which slides: everything ends still with the resting plate or moves
    /// with limits in force; energy is only taken, and a mirrored scene gives the mirrored answer.
    #[test]
    fn the_answer_does_not_depend_on_the_order() {
        let chain = |order: &[usize]| {
            let mut bodies: Vec<Turning<2>> = (0..4).map(|k| ball([0.3 * k as f64, 0.0], 1.0 - k as f64)).collect();
            let mut contacts: Vec<Rough<2>> = (0..3)
                .map(|k| Rough {
                    parties: [Rubbing::Body(k), Rubbing::Body(k + 1)],
                    arms: [Vector([1.0, 0.0]), Vector([-1.0, 0.0])],
                    normal: Vector([1.0, 0.0]),
                    limit: 0.05 + 0.1 * k as f64,
                    ..on_floor(0, 0.0, 0.5)
                })
                .collect();
            contacts.extend((0..4).map(|k| on_floor(k, 0.07 * k as f64, 0.2)));
            let mut sorted: Vec<Rough<2>> = order.iter().map(|&k| contacts[k]).collect();
            let before: f64 = energy(&bodies);
            let took = rub(&mut bodies, &mut sorted, RUB_TOLERANCE, SWEEPS);
            assert!(took >= 0.0 && (before - energy(&bodies) - took).abs() < 1e-14);
            bodies
        };
        let (a, b) = (chain(&[0, 1, 2, 3, 4, 5, 6]), chain(&[6, 2, 4, 0, 5, 3, 1]));
        for (a, b) in a.iter().zip(&b) {
            assert!((a.velocity - b.velocity).norm() < 1e-13 && (a.spin - b.spin).norm() < 1e-13);
        }
    }

    fn energy(bodies: &[Turning<2>]) -> f64 {
        let of = |b: &Turning<2>| 0.5 * (b.velocity.norm_squared() + b.spin.norm_squared() / 2.5);
        bodies.iter().map(of).sum()
    }
}
