//! Friction in a slice: after the normal impulses, one solve for the tangential ones, and one projection more for what they
//! closed.
//!
//! Normal impulses and friction depend on each other: each is solved with the other as it stands, in turn, from the friction of the
//! slice before on, until neither changes. A stack that stands is such a fixed point. The slice's energy rises by
//! F = w.v'' - 1/2 |v'' - v|^2 in the metric of the masses, w being all that contacts changed (THEORY 4.3). With normal impulses alone
//! that is never positive; with friction it has no sign. Then the slice lies between the two, at the point on the line between their
//! velocities where F, which is convex, is not positive any more: it opens every contact and stays in every cone as both do.
use super::slices::{Asked, Effort, Island, SWEEPS, Solved, larger};
use super::{WALL, World};
use crate::law::together::rub::{Pressing, Rough, Rubbing, Turning, grind, rub};
use crate::law::together::{Solver, System};
use crate::vector::Exact;
use crate::{Rotates, Vector};
use alloc::vec::Vec;

/// How good the friction of a slice is, relative to its slips.
const DRAG_TOLERANCE: f64 = 1e-12;
/// In slices that are solved to a tolerance of their own, this part of it.
const DRAG_PART: f64 = 0.1;
/// The same in large islands, whose normal impulses are solved by sweeps.
const SWEPT_TOLERANCE: f64 = 1e-6;
/// Normal impulses and friction are solved in turn so often at most: in small islands, and in those that are solved by sweeps.
const ROUNDS: usize = 40;
const SWEPT_ROUNDS: usize = 3;
/// Impulses that are so many times what all of the island's mass has at its fastest have lost their meaning.
const JAMMED: f64 = 1e6;
/// A round that leaves more than this of the change stalls; so many may.
const SLOW: f64 = 0.5;
const STALLS: u32 = 3;
/// Sweeps over the contacts for both together in one round, and for the friction at the end, at most.
const GRINDS: u32 = 25;
const RUBS: u32 = 100;
/// A gain of energy below this part of all that moves is rounding.
const NO_GAIN: f64 = 1e-13;

/// What rounding may make of the point where nothing is gained.
const ROUNDING: f64 = 1e-12;

/// A row of a slice: a near contact, or a tangent of the inside of an arc.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<const D: usize> {
    /// A moving body, and the code of its partner.
    pub a: u32,
    pub b: u32,
    /// Unit vector from `a` to its partner, and the gap (m) when the slice starts.
    pub normal: Vector<D>,
    pub gap: f64,
    /// The least opening speed (m/s).
    pub bound: f64,
}

/// The friction of a contact over a slice: the tangential impulse on the partner and the moment.
pub(super) type Dragged<const D: usize> = (Vector<D>, <Vector<D> as Rotates>::Spin);

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// The contact of a row as the friction solvers take it, and what it allows.
    fn rough_row(&self, island: &Island<D>, row: &Row<D>) -> (Rough<D>, Pressing) {
        let b = &self.store.bodies;
        let place = |code: u32| island.bodies.binary_search(&code).ok();
        let radius = b.record[row.a as usize].radius;
        let (arms, smaller) = if row.b & WALL != 0 {
            ([row.normal * (radius + row.gap), Vector::ZERO], radius)
        } else {
            let other = b.record[row.b as usize].radius;
            let arms = [row.normal * (radius + 0.5 * row.gap), -(row.normal * (other + 0.5 * row.gap))];
            (arms, radius * other / (radius + other))
        };
        let second = match place(row.b) {
            Some(k) => Rubbing::Body(k),
            None => Rubbing::Surface(self.surface_velocity(row.b, arms[1])),
        };
        let first = place(row.a).expect("a member of the island");
        let contact = Rough::new([Rubbing::Body(first), second], arms, row.normal);
        let said = self.said(row.a, row.b, 0.0, self.slip_of(island, &contact).norm());
        let kappa = b.inertia[row.a as usize] / (b.matter[row.a as usize].mass * radius * radius);
        let rough = if said.friction > 0.0 { 1.0 } else { 0.0 };
        let pressing = Pressing {
            friction: said.friction,
            rolling: rough * said.rolling * smaller * (1.0 + kappa),
            spinning: rough * said.spinning * smaller,
            bound: row.bound,
            lambda: 0.0,
        };
        (contact, pressing)
    }

    fn slip_of(&self, island: &Island<D>, contact: &Rough<D>) -> Vector<D> {
        let surface = |k: usize| match contact.parties[k] {
            Rubbing::Body(m) => {
                let spin = self.store.bodies.spin[island.bodies[m] as usize];
                island.before[m] + Vector::<D>::turned(spin, contact.arms[k])
            }
            Rubbing::Surface(velocity) => velocity,
        };
        let relative = surface(0) - surface(1);
        relative - contact.normal * relative.dot(contact.normal)
    }

    /// What the friction of the slice before, for a slice of this part of its length, gives to each body's velocity (m/s).
    pub(super) fn dragged_along(&self, island: &Island<D>, scaled: f64) -> Vec<Vector<D>> {
        let mut given = alloc::vec![Vector::ZERO; island.bodies.len()];
        for (n, (impulse, _)) in island.near.iter().zip(&island.drag) {
            for (code, sign) in [(n.a, -scaled), (n.b, scaled)] {
                if let Ok(k) = island.bodies.binary_search(&code) {
                    given[k] += *impulse * (sign * self.store.bodies.matter[code as usize].inverse_mass);
                }
            }
        }
        given
    }

    /// Adds friction to a slice of length `h` whose normal impulses are solved. Changes the velocities of `system`, and the impulses,
    /// velocities and spins of `solved`. Returns the rough rows.
    pub(super) fn drag(
        &self,
        island: &Island<D>,
        h: f64,
        rows: &[Row<D>],
        asked: Asked,
        (system, solver): (&mut System, &mut Solver),
        solved: &mut Solved<D>,
    ) -> Vec<(usize, Rough<D>)> {
        let (b, g) = (&self.store.bodies, self.store.gravity);
        let scaled = if island.length > 0.0 { h / island.length } else { 0.0 };
        let bounds: Vec<f64> = rows.iter().map(|r| r.bound).collect();
        let scale = island.before.iter().map(|v| v.norm()).fold(g.norm() * h, larger);
        let (tolerance, slack, rounds) = match asked.effort {
            Effort::Factor(tolerance) => (larger(DRAG_TOLERANCE, DRAG_PART * tolerance), tolerance * scale, ROUNDS),
            _ => (SWEPT_TOLERANCE, asked.closing, SWEPT_ROUNDS),
        };
        let start: Vec<_> = island.bodies.iter().map(|&i| b.spin[i as usize]).collect();
        let (mut contacts, mut pressing): (Vec<Rough<D>>, Vec<Pressing>) =
            rows.iter().map(|row| self.rough_row(island, row)).unzip();
        // Friction starts as the slice before left it. The normal has turned since.
        for (k, c) in contacts.iter_mut().enumerate() {
            let (impulse, moment) = island.drag.get(k).copied().unwrap_or_default();
            let impulse = impulse * scaled;
            (c.impulse, c.moment) = (impulse - c.normal * impulse.dot(c.normal), moment * scaled);
        }
        let free = self.pressed_bodies(island, h, rows, &[], &start);
        let mass: f64 = island.bodies.iter().map(|&i| b.matter[i as usize].mass).sum();
        let (smooth, jammed) = (solved.lambda.clone(), JAMMED * mass * scale);
        let (mut last, mut stalls) = (f64::INFINITY, 0);
        for round in 0..rounds {
            for (p, lambda) in pressing.iter_mut().zip(&solved.lambda) {
                p.lambda = *lambda;
            }
            let mut bodies = free.clone();
            let sweeps = grind(&mut bodies, &mut contacts, &mut pressing, tolerance * scale, GRINDS);
            if round > 0 && sweeps == 1 {
                break; // nothing changes any more
            }
            self.press(island, h, &bounds, asked, &contacts, (system, solver), solved);
            let most = solved.lambda.iter().copied().fold(0.0, larger);
            let change = pressing.iter().zip(&solved.lambda).map(|(p, l)| (p.lambda - l).abs_()).fold(0.0, larger);
            if !(most < jammed) {
                // Friction wedges bodies between each other for good: then it is what the impulses without it allow.
                contacts.iter_mut().for_each(|c| (c.impulse, c.moment) = (Vector::ZERO, Default::default()));
                solved.lambda = smooth;
                break;
            }
            stalls += if change > SLOW * last { 1 } else { 0 };
            if !(change > tolerance * most) || stalls > STALLS {
                break;
            }
            last = change;
        }
        let mut bodies = self.pressed_bodies(island, h, rows, &solved.lambda, &start);
        let (mut rough, mut which) = (Vec::new(), Vec::new());
        for (k, (c, p)) in contacts.iter().zip(&pressing).enumerate() {
            let lambda = solved.lambda[k];
            if lambda > 0.0 && p.friction > 0.0 {
                let (limit, rolling, spinning) = (p.friction * lambda, p.rolling * lambda, p.spinning * lambda);
                rough.push(Rough { limit, rolling, spinning, ..*c });
                which.push(k);
            }
        }
        rub(&mut bodies, &mut rough, tolerance, RUBS);
        for (velocities, body) in system.velocities_mut().chunks_mut(D).zip(&bodies) {
            velocities.copy_from_slice(&body.velocity.0);
        }
        if (0..rows.len()).any(|k| system.opening(k) < bounds[k] - slack) {
            let more = self.open(&bounds, &[], asked, (system, solver));
            for (sum, more) in solved.lambda.iter_mut().zip(more) {
                *sum += more;
            }
            for (k, body) in bodies.iter_mut().enumerate() {
                body.velocity = system.velocity(k * D);
            }
        }
        let gain = self.gain(island, h, &bodies, &start, &solved.lambda, system, &rough);
        if gain > 0.0 {
            let (with, lambda) = (bodies.clone(), solved.lambda.clone());
            self.press(island, h, &bounds, asked, &[], (system, solver), solved);
            for (k, body) in bodies.iter_mut().enumerate() {
                (body.velocity, body.spin) = (system.velocity(k * D), start[k]);
            }
            let without = self.gain(island, h, &bodies, &start, &solved.lambda, system, &[]);
            let part = if without < 0.0 { (without / (without - gain)) * (1.0 - ROUNDING) } else { 0.0 };
            for (sum, with) in solved.lambda.iter_mut().zip(lambda) {
                *sum += (with - *sum) * part;
            }
            for (body, with) in bodies.iter_mut().zip(&with) {
                body.velocity += (with.velocity - body.velocity) * part;
                body.spin += (with.spin - body.spin) * part;
            }
            for c in &mut rough {
                (c.impulse, c.moment) = (c.impulse * part, c.moment * part);
            }
            for (velocities, body) in system.velocities_mut().chunks_mut(D).zip(&bodies) {
                velocities.copy_from_slice(&body.velocity.0);
            }
        }
        for (k, body) in bodies.iter().enumerate() {
            (solved.v[k], solved.spin[k]) = (body.velocity, body.spin);
        }
        which.into_iter().zip(rough).collect()
    }

    /// The bodies of an island after gravity and these normal impulses, friction not counted.
    fn pressed_bodies(
        &self,
        island: &Island<D>,
        h: f64,
        rows: &[Row<D>],
        lambda: &[f64],
        start: &[<Vector<D> as Rotates>::Spin],
    ) -> Vec<Turning<D>> {
        let (b, g) = (&self.store.bodies, self.store.gravity);
        let mut bodies: Vec<Turning<D>> = island
            .bodies
            .iter()
            .zip(island.before.iter().zip(start))
            .map(|(&i, (&v, &spin))| b.turning(i as usize, v + g * h, spin))
            .collect();
        for (row, &lambda) in rows.iter().zip(lambda).filter(|(_, l)| **l > 0.0) {
            for (code, sign) in [(row.a, -lambda), (row.b, lambda)] {
                if let Ok(k) = island.bodies.binary_search(&code) {
                    bodies[k].velocity += row.normal * (sign * b.matter[code as usize].inverse_mass);
                }
            }
        }
        bodies
    }

    /// By how much a slice that ends like this raises the energy (J).
    fn gain(
        &self,
        island: &Island<D>,
        h: f64,
        bodies: &[Turning<D>],
        start: &[<Vector<D> as Rotates>::Spin],
        lambda: &[f64],
        system: &System,
        rough: &[Rough<D>],
    ) -> f64 {
        let b = &self.store.bodies;
        let fall = self.store.gravity.norm() * h;
        let (mut gain, mut moved) = (0.0, 0.0);
        for (k, &i) in island.bodies.iter().enumerate() {
            let (m, inertia) = (b.matter[i as usize].mass, b.inertia[i as usize]);
            let (dv, dw) = (bodies[k].velocity - island.before[k], bodies[k].spin - start[k]);
            gain -= 0.5 * (m * dv.norm_squared() + inertia * Vector::<D>::spin_dot(dw, dw));
            moved += m * (bodies[k].velocity.norm_squared() + fall * fall)
                + inertia * Vector::<D>::spin_dot(bodies[k].spin, bodies[k].spin);
        }
        for (k, l) in lambda.iter().enumerate() {
            gain += l * system.opening(k);
        }
        for c in rough {
            gain -= c.impulse.dot(c.slip(bodies)) + Vector::<D>::spin_dot(c.moment, c.relative_spin(bodies));
        }
        if gain > NO_GAIN * moved { gain } else { gain.min(0.0) }
    }

    /// What friction did in a slice, for the accounts: what immovable parties gave, what it took, and where the next one starts.
    pub(super) fn book_drag(
        &self,
        island: &Island<D>,
        rubbed: &[(usize, Rough<D>)],
        x: &[Vector<D>],
        solved: &mut Solved<D>,
    ) {
        solved.drag = alloc::vec![Dragged::<D>::default(); island.near.len()];
        let bodies: Vec<Turning<D>> = solved
            .v
            .iter()
            .zip(&solved.spin)
            .map(|(&velocity, &spin)| Turning { inverse_mass: 0.0, inverse_inertia: 0.0, velocity, spin })
            .collect();
        for (k, c) in rubbed {
            let (slip, spin) = (c.slip(&bodies), c.relative_spin(&bodies));
            solved.lost += c.impulse.dot(slip) + Vector::<D>::spin_dot(c.moment, spin);
            if let (Rubbing::Body(m), Rubbing::Surface(velocity)) = (c.parties[0], c.parties[1]) {
                // It acts on the first.
                let impulse = -c.impulse;
                solved.momentum += impulse;
                solved.moment += Vector::<D>::moment(x[m] + c.arms[0], impulse) - c.moment;
                solved.work += impulse.dot(velocity);
            }
            if let Some(drag) = solved.drag.get_mut(*k) {
                *drag = (c.impulse, c.moment);
            }
        }
    }

    /// The normal impulses of the slice, with this friction as it stands.
    fn press(
        &self,
        island: &Island<D>,
        h: f64,
        bounds: &[f64],
        asked: Asked,
        rough: &[Rough<D>],
        (system, solver): (&mut System, &mut Solver),
        solved: &mut Solved<D>,
    ) {
        let start = alloc::vec![Default::default(); island.bodies.len()];
        let mut bodies = self.pressed_bodies(island, h, &[], &[], &start);
        for c in rough {
            c.push(&mut bodies, c.impulse, c.moment);
        }
        for (velocities, body) in system.velocities_mut().chunks_mut(D).zip(&bodies) {
            velocities.copy_from_slice(&body.velocity.0);
        }
        solved.lambda = self.open(bounds, &solved.lambda, asked, (system, solver));
    }

    /// Projects the velocities of a slice, by the method that is asked for, until every contact opens. Returns the impulses.
    fn open(
        &self,
        bounds: &[f64],
        warm: &[f64],
        asked: Asked,
        (system, solver): (&mut System, &mut Solver),
    ) -> Vec<f64> {
        let Effort::Factor(tolerance) = asked.effort else {
            return solver.relax(system, bounds, warm, asked.closing, SWEEPS).lambda.clone();
        };
        let mut lambda = solver.project_to(system, bounds, warm, tolerance).lambda.clone();
        self.project_again(solver, system, bounds, asked.enough, &mut lambda);
        lambda
    }
}
