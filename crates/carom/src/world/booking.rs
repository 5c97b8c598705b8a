//! What an instant leaves behind: entries in the books, reports, and the records of those who took part.
use super::instant::{Instant, Touching};
use super::predict::STILL;
use super::rounds::is_beyond;
use super::slices::larger;
use super::store::Record;
use super::{WALL, World};
use crate::ledger::Magnitudes;
use crate::report::{Impact, Party, State};
use crate::vector::Exact;
use crate::{Rotates, Vector};

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// Into the books, and into the reports.
    pub(super) fn book(&mut self, time: f64, set: &Instant<D>) {
        let scale = set.members.iter().map(|m| m.before.norm()).fold(0.0, f64::max);
        let struck = |c: &Touching<D>| c.impulse > 0.0;
        let together = set.contacts.iter().filter(|c| struck(c)).count() as u32;
        // Each contact that exchanges an impulse is an event; the instant itself is counted already.
        self.events += u64::from(together.saturating_sub(1));
        for c in &set.contacts {
            let overlap = -c.gap;
            if overlap > self.books.overlap {
                self.books.overlap = overlap;
            }
            if !struck(c) {
                continue;
            }
            let lost = 0.5 * c.impulse * (c.approach - c.departure) + c.rubbed;
            self.books.lost.add(lost);
            let x = match set.members.iter().find(|m| m.body == c.a) {
                Some(m) => m.x,
                None => self.store.at(c.a as usize, time).0,
            };
            self.hand_over(c, x);
            // What rounding leaves of a contact that moves together is exchanged, but is no impact.
            if together == 1 && !(c.approach > STILL * scale) && !(c.approach > STILL * self.wall_speed(c.b)) {
                continue;
            }
            self.impact_count += 1;
            if self.keep_reports {
                let impact = self.report(time, c, set, x, lost, together);
                self.impacts.push(impact);
            }
        }
    }

    pub(super) fn wall_speed(&self, code: u32) -> f64 {
        if code & WALL != 0 { self.store.walls[(code & !WALL) as usize].velocity.norm() } else { 0.0 }
    }

    /// What an immovable party gives to the moving one.
    pub(super) fn hand_over(&mut self, c: &Touching<D>, x: Vector<D>) {
        let inverse =
            |code: u32| if code & WALL != 0 { 0.0 } else { self.store.bodies.matter[code as usize].inverse_mass };
        let (wa, wb) = (inverse(c.a), inverse(c.b));
        let (giver, sign) = match (wa > 0.0, wb > 0.0) {
            (true, false) => (c.b, -1.0),
            (false, true) => (c.a, 1.0),
            _ => return,
        };
        let impulse = c.normal * (sign * c.impulse);
        let velocity = if giver & WALL != 0 {
            self.store.walls[(giver & !WALL) as usize].velocity
        } else {
            self.store.bodies.record[giver as usize].v
        };
        self.books.momentum_given.add(&impulse.0);
        if !self.store.any_periodic {
            // Frictionless, the impulse passes through the moving body's centre.
            let centre = if giver == c.b { x } else { self.store.at(c.b as usize, self.time).0 };
            self.book_moment(centre, impulse);
        }
        self.books.work.add(impulse.dot(velocity));
        if c.friction != Vector::ZERO {
            let friction = c.friction * sign;
            self.books.momentum_given.add(&friction.0);
            if !self.store.any_periodic {
                self.book_moment(x + c.arms[0], friction);
            }
            let surface = self.surface_velocity(giver, if giver == c.b { c.arms[1] } else { c.arms[0] });
            self.books.work.add(friction.dot(surface));
        }
    }

    /// Books the moment of an impulse that was given at `x`. Its magnitude counts in the scale of the account: who flies out from the origin
    /// and is stopped had an angular momentum that is known to the rounding of |x| |p|, however small it is.
    pub(super) fn book_moment(&mut self, x: Vector<D>, impulse: Vector<D>) {
        let moment = Vector::<D>::moment(x, impulse);
        self.books.angular_given.add(Vector::<D>::spin_slice(&moment));
        let angular = self.books.now.angular + x.norm() * impulse.norm();
        self.books.largest.raise(&Magnitudes { angular, ..self.books.now });
    }

    /// How fast the surface of an immovable party moves at the end of an arm from its centre (m/s): fixed bodies may turn.
    pub(super) fn surface_velocity(&self, code: u32, arm: Vector<D>) -> Vector<D> {
        if code & WALL != 0 {
            return self.store.walls[(code & !WALL) as usize].velocity;
        }
        let b = &self.store.bodies;
        b.record[code as usize].v + Vector::<D>::turned(b.spin[code as usize], arm)
    }

    pub(super) fn report(
        &self,
        time: f64,
        c: &Touching<D>,
        set: &Instant<D>,
        x: Vector<D>,
        lost: f64,
        together: u32,
    ) -> Impact<D> {
        let party = |code: u32| {
            if code & WALL != 0 {
                Party::Wall(self.store.wall_id((code & !WALL) as usize))
            } else {
                Party::Body(self.store.bodies.id(code as usize))
            }
        };
        let states = |code: u32| {
            if code & WALL != 0 {
                let state = State { velocity: self.store.walls[(code & !WALL) as usize].velocity, ..State::default() };
                return [state, state];
            }
            let b = &self.store.bodies;
            match set.members.iter().find(|m| m.body == code) {
                Some(m) => {
                    [State { velocity: m.before, spin: m.spin_before }, State { velocity: m.after, spin: m.spin_after }]
                }
                None => [State { velocity: b.record[code as usize].v, spin: b.spin[code as usize] }; 2],
            }
        };
        let (a, b) = (states(c.a), states(c.b));
        let x = self.store.wrapped(x, self.store.turns(x));
        Impact {
            time: larger(time, self.time),
            parties: [party(c.a), party(c.b)],
            point: x + c.arms[0],
            normal: c.normal,
            approach: c.approach,
            departure: c.departure,
            restitution: if c.restitution.is_nan() { self.restitution(c, 0.0) } else { c.restitution },
            impulse: c.impulse,
            friction_impulse: c.friction,
            before: [a[0], b[0]],
            after: [a[1], b[1]],
            lost,
            together,
        }
    }

    /// Writes a body's record at `time`: position `x`, velocity `v`. What gravity and supports gave since the last record goes
    /// into the books first.
    pub(super) fn write(&mut self, i: usize, time: f64, x: Vector<D>, v: Vector<D>) {
        let spin = self.spin_at(i, time);
        self.write_turning(i, time, x, v, spin);
    }

    /// The same, with the spin that the body has from now on.
    pub(super) fn write_turning(
        &mut self,
        i: usize,
        time: f64,
        x: Vector<D>,
        v: Vector<D>,
        spin: <Vector<D> as Rotates>::Spin,
    ) {
        self.book_flight(i, time);
        if !self.store.uniform && self.books.start.is_some() {
            // What the body had gathered by now, before this takes it away.
            let (x, v) = self.store.at(i, time);
            let mut gathered = self.books.now;
            gathered.add(&self.magnitudes(i), -1.0);
            gathered.add(&self.magnitudes_at(i, x, v), 1.0);
            self.books.largest.raise(&gathered);
        }
        let turns = self.store.turns(x);
        let x = self.store.wrapped(x, turns);
        let before = self.magnitudes(i);
        let b = &mut self.store.bodies;
        if self.store.any_periodic {
            for k in 0..D {
                b.image[i][k] = b.image[i][k].saturating_add(turns[k]);
            }
            self.cells.rewrapped(i as u32, turns);
            self.broken |= is_beyond(&turns);
        }
        b.record[i] = Record { x, v, time, radius: b.record[i].radius };
        b.spin[i] = spin;
        b.matter[i].stamp = b.matter[i].stamp.wrapping_add(1);
        if self.books.start.is_some() {
            let after = self.magnitudes(i);
            self.books.now.add(&before, -1.0);
            self.books.now.add(&after, 1.0);
            let now = self.books.now;
            self.books.largest.raise(&now);
        }
        if !(v.is_finite() && x.is_finite()) {
            self.broken = true;
        }
    }

    /// The magnitudes of a body's share of the accounts, as its record has them.
    pub(super) fn magnitudes(&self, i: usize) -> Magnitudes {
        let r = &self.store.bodies.record[i];
        self.magnitudes_at(i, r.x, r.v)
    }

    /// The same, where the body is at `x` with velocity `v`.
    pub(super) fn magnitudes_at(&self, i: usize, x: Vector<D>, v: Vector<D>) -> Magnitudes {
        let b = &self.store.bodies;
        if b.matter[i].inverse_mass == 0.0 {
            return Magnitudes::default();
        }
        let m = b.matter[i].mass;
        let momentum = m * v.norm_squared().sqrt_();
        let spin = b.spin[i];
        let turning = Vector::<D>::spin_dot(spin, spin);
        Magnitudes {
            momentum,
            // A periodic world has no such account.
            angular: if self.store.any_periodic {
                0.0
            } else {
                x.norm_squared().sqrt_() * momentum + b.inertia[i] * turning.sqrt_()
            },
            energy: 0.5 * (m * v.norm_squared() + b.inertia[i] * turning) + (m * self.store.gravity.dot(x)).abs_(),
        }
    }
}
