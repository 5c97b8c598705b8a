//! Friction at an instant: one contact by the law of rough balls, several by one solve after their normal impulses.
use super::instant::{Member, Touching};
use super::{WALL, World};
use crate::law::Law;
use crate::law::contact::{Contact, Side};
use crate::law::smooth::{self, Moving};
use crate::law::together::rub::{RUB_TOLERANCE, Rough, Rubbing, SWEEPS, Turning, rub};
use crate::law::together::{Solver, System, VIOLATION};
use crate::material::Coefficients;
use crate::vector::Exact;
use crate::{Rotates, Vector};
use alloc::vec::Vec;

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// What two parties' surfaces say at these speeds (m/s).
    pub(super) fn said(&self, a: u32, b: u32, approach: f64, slip: f64) -> Coefficients {
        self.store.materials.between(self.surface_of(a), self.surface_of(b), approach, slip)
    }

    /// A party as a law sees it. What nothing can move has inverse mass and inertia 0.
    fn turning(&self, code: u32, members: &[Member<D>]) -> Turning<D> {
        if code & WALL != 0 {
            let velocity = self.store.walls[(code & !WALL) as usize].velocity;
            return Turning { inverse_mass: 0.0, inverse_inertia: 0.0, velocity, spin: Default::default() };
        }
        let (i, b) = (code as usize, &self.store.bodies);
        match members.iter().find(|m| m.body == code) {
            Some(m) => b.turning(i, m.after, m.spin_after),
            None => Turning { inverse_mass: 0.0, inverse_inertia: 0.0, velocity: b.record[i].v, spin: b.spin[i] },
        }
    }

    /// One contact with friction: the law of rough balls. False, and nothing done, where the surfaces are smooth.
    pub(super) fn grips(&self, c: &mut Touching<D>, members: &mut [Member<D>], piled: bool) -> bool {
        let (a, b) = (self.turning(c.a, members), self.turning(c.b, members));
        let mut contact = Rough::new([Rubbing::Body(0), Rubbing::Body(1)], c.arms, c.normal);
        let mut both = [a, b];
        let slip = contact.slip(&both);
        let said = self.said(c.a, c.b, c.approach, slip.norm());
        if !(said.friction > 0.0) {
            return false;
        }
        let e = if piled { 0.0 } else { self.restitution(c, c.approach) };
        c.restitution = e;
        let law = self.store.materials.law(self.surface_of(c.a), self.surface_of(c.b)).unwrap_or(self.law);
        if law != Law::ChatterjeeRuina {
            self.by_law(law, c, [a, b], members, Coefficients { restitution: e, ..said });
            return true;
        }
        // For balls the default law is that of rough spheres.
        let moving = |t: &Turning<D>| Moving { inverse_mass: t.inverse_mass, velocity: t.velocity };
        let (mut ma, mut mb) = (moving(&a), moving(&b));
        c.impulse = smooth::impact(&mut ma, &mut mb, c.towards, e).dot(c.normal);
        (both[0].velocity, both[1].velocity) = (ma.velocity, mb.velocity);
        contact.limit = said.friction * c.impulse;
        contact.tangential = said.tangential;
        let mut one = [contact];
        c.rubbed = rub(&mut both, &mut one, RUB_TOLERANCE, SWEEPS);
        c.friction = one[0].impulse;
        c.departure = -(both[0].velocity - both[1].velocity).dot(c.normal);
        for m in members {
            let after = if m.body == c.a { &both[0] } else { &both[1] };
            (m.after, m.spin_after) = (after.velocity, after.spin);
        }
        true
    }

    /// One contact by a law for bodies of any shape.
    fn by_law(
        &self,
        law: Law,
        c: &mut Touching<D>,
        parties: [Turning<D>; 2],
        members: &mut [Member<D>],
        said: Coefficients,
    ) {
        let side = |k: usize| Side {
            velocity: parties[k].velocity,
            spin: parties[k].spin,
            inverse_mass: parties[k].inverse_mass,
            inverse_inertia: Vector::<D>::isotropic(parties[k].inverse_inertia),
            arm: c.arms[k],
        };
        let contact = Contact { normal: c.normal, sides: [side(0), side(1)] };
        let impulse = law.impulse(&contact, said);
        let after = contact.after(impulse);
        c.impulse = impulse.dot(c.normal);
        c.friction = impulse - c.normal * c.impulse;
        c.rubbed = 0.5 * c.friction.dot(contact.slip() + after.slip());
        c.departure = -after.approach();
        for m in members {
            let side = &after.sides[usize::from(m.body != c.a)];
            (m.after, m.spin_after) = (side.velocity, side.spin);
        }
    }

    /// Several contacts whose normal impulses are known: their friction, all at once, and where it made a contact close again,
    /// one plastic projection more.
    pub(super) fn rub(
        &self,
        contacts: &mut [Touching<D>],
        members: &mut [Member<D>],
        system: &mut System,
        solver: &mut Solver,
    ) {
        let place = |code: u32| members.iter().position(|m| m.body == code);
        let bodies = |motion: fn(&Member<D>) -> (Vector<D>, <Vector<D> as Rotates>::Spin)| {
            let turning = |m: &Member<D>| {
                let (velocity, spin) = motion(m);
                self.store.bodies.turning(m.body as usize, velocity, spin)
            };
            members.iter().map(turning).collect::<Vec<_>>()
        };
        let before = bodies(|m| (m.before, m.spin_before));
        let mut after = bodies(|m| (m.after, m.spin_after));
        let mut rough: Vec<Rough<D>> = Vec::new();
        let mut which: Vec<usize> = Vec::new();
        for (k, c) in contacts.iter().enumerate() {
            let party = |code: u32, arm: Vector<D>| match place(code) {
                Some(k) => Rubbing::Body(k),
                None => Rubbing::Surface(self.surface_velocity(code, arm)),
            };
            let mut contact = Rough::new([party(c.a, c.arms[0]), party(c.b, c.arms[1])], c.arms, c.normal);
            let said = self.said(c.a, c.b, c.approach, contact.slip(&before).norm());
            if c.impulse > 0.0 && said.friction > 0.0 {
                contact.limit = said.friction * c.impulse;
                contact.tangential = said.tangential;
                rough.push(contact);
                which.push(k);
            }
        }
        if rough.is_empty() {
            return;
        }
        rub(&mut after, &mut rough, RUB_TOLERANCE, SWEEPS);
        for (velocities, b) in system.velocities_mut().chunks_mut(D).zip(&after) {
            velocities.copy_from_slice(&b.velocity.0);
        }
        let scale = after.iter().map(|b| b.velocity.norm_squared()).fold(0.0, f64::max).sqrt_();
        if (0..contacts.len()).any(|k| system.opening(k) < -VIOLATION * scale) {
            let more = solver.project(system, &[], &[]);
            for (c, lambda) in contacts.iter_mut().zip(&more.lambda) {
                c.impulse += lambda;
            }
        }
        for (k, m) in members.iter_mut().enumerate() {
            m.after = system.velocity(k * D);
            m.spin_after = after[k].spin;
            after[k].velocity = m.after;
        }
        for (c, k) in rough.iter().zip(which) {
            contacts[k].friction = c.impulse;
            contacts[k].rubbed = 0.5 * c.impulse.dot(c.slip(&before) + c.slip(&after));
        }
        for (k, c) in contacts.iter_mut().enumerate() {
            c.departure = system.opening(k);
        }
    }
}
