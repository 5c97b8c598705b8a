//! One instant: who touches whom, what they exchange, and how each goes on.
use super::memory::held;
use super::slices::{NO_ISLAND, larger};
use super::store::Motion;
use super::support::still_speed;
use super::{WALL, World};
use crate::law::smooth::{self, Moving};
use crate::{MaterialId, Rotates, Shape, Vector};
use alloc::vec::Vec;

/// Bodies whose gap is below this fraction of the smaller radius touch: they share the instant. Positions are good to about
/// 1e-15 of the coordinates, so that a scene may lie a million radii from its origin.
pub const TOUCHING: f64 = 1e-9;
/// Inside an island impacts take so many iterations at most at the start of a slice; what closes then is the slice's. A blow
/// travels so many bodies a millisecond. More would collapse inelastically, within the slice, hundreds of times a millisecond.
const REBOUNDS: u32 = 4;

/// A contact of the instant, from a body to a body or a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touching<const D: usize> {
    /// A body, and its partner's code.
    pub a: u32,
    pub b: u32,
    /// From `a` to `b` along the line of centres, of any length.
    pub towards: Vector<D>,
    pub normal: Vector<D>,
    /// The gap over the smaller radius.
    pub gap: f64,
    /// From `a`'s and from `b`'s centre to the common point of contact; nothing for a wall.
    pub arms: [Vector<D>; 2],
    /// Along the normal before the instant and after it; the impulse; the e that was used first.
    pub approach: f64,
    pub departure: f64,
    pub impulse: f64,
    pub restitution: f64,
    /// The tangential impulse on `b`, and the energy (J) that it took.
    pub friction: Vector<D>,
    pub rubbed: f64,
    /// True if gravity presses the contact together, or if a party is in lasting contact already: slow approaches are plastic.
    pub lasting: bool,
}

impl<const D: usize> Default for Touching<D> {
    fn default() -> Self {
        Self {
            a: 0,
            b: 0,
            towards: Vector::ZERO,
            normal: Vector::ZERO,
            gap: 0.0,
            arms: [Vector::ZERO; 2],
            approach: 0.0,
            departure: 0.0,
            impulse: 0.0,
            restitution: f64::NAN,
            friction: Vector::ZERO,
            rubbed: 0.0,
            lasting: false,
        }
    }
}

/// A moving body of the instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member<const D: usize>
where
    Vector<D>: Rotates,
{
    pub body: u32,
    pub x: Vector<D>,
    pub before: Vector<D>,
    pub after: Vector<D>,
    pub spin_before: <Vector<D> as Rotates>::Spin,
    pub spin_after: <Vector<D> as Rotates>::Spin,
}

impl<const D: usize> Member<D>
where
    Vector<D>: Rotates,
{
    /// True if the instant changed how it moves or turns.
    pub fn changed(&self) -> bool {
        self.after != self.before || self.spin_after != self.spin_before
    }
}

/// What an instant works on; kept between instants for its buffers.
#[derive(Debug)]
pub(super) struct Instant<const D: usize>
where
    Vector<D>: Rotates,
{
    pub contacts: Vec<Touching<D>>,
    pub members: Vec<Member<D>>,
    /// The gap of the contact that was predicted, over the smaller radius.
    pub seed_gap: f64,
    /// Its parties.
    pub seed: (u32, u32),
    /// For each body: the number of the instant that saw it last, and its place among the members.
    seen: Vec<(u64, u32)>,
    number: u64,
}

impl<const D: usize> Instant<D>
where
    Vector<D>: Rotates,
{
    /// One contact of two moving balls: where they are, their velocities before and after, and their spins.
    pub fn only(
        &mut self,
        contact: Touching<D>,
        parties: [(Vector<D>, Vector<D>, Vector<D>); 2],
        [sa, sb]: [<Vector<D> as Rotates>::Spin; 2],
    ) {
        self.contacts.clear();
        self.contacts.push(contact);
        self.members.clear();
        let [a, b] = parties;
        self.members.push(Member { body: contact.a, x: a.0, before: a.1, after: a.2, spin_before: sa, spin_after: sa });
        self.members.push(Member { body: contact.b, x: b.0, before: b.1, after: b.2, spin_before: sb, spin_after: sb });
    }

    /// The memory that it holds (bytes).
    pub fn bytes(&self) -> usize {
        held(&self.contacts) + held(&self.members) + held(&self.seen)
    }
}

impl<const D: usize> Default for Instant<D>
where
    Vector<D>: Rotates,
{
    fn default() -> Self {
        Self { contacts: Vec::new(), members: Vec::new(), seed_gap: 0.0, seed: (0, 0), seen: Vec::new(), number: 0 }
    }
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// Bodies `i` and the partner of this code meet at `time`: finds all that touch with them, lets them exchange their
    /// impulses, books and reports it, and predicts what follows.
    pub(super) fn meet(&mut self, time: f64, i: usize, partner: u32) {
        let closing = if self.islands.is_empty() { 0.0 } else { self.closing(time, i, partner) };
        // A slice cut short may put the meeting a little before the last event; the dynamics take it there, the clock and the
        // reports do not go back.
        let (time, mut sliced) = self.cut(time, i, partner);
        self.time = larger(time, self.time);
        self.events += 1;
        loop {
            self.gather(time, i, partner);
            // Whoever else is met in the middle of a slice ends it now.
            let under_way = |m: &&Member<D>| {
                let k = self.island_of[m.body as usize];
                k != NO_ISLAND && !self.islands[k as usize].resting
            };
            let Some(body) = self.instant.members.iter().find(under_way).map(|m| m.body as usize) else { break };
            sliced.extend(self.dissolve(self.island_of[body] as usize, time));
        }
        if !sliced.is_empty() && self.instant.seed_gap > TOUCHING {
            // The slice, cut short, ends a little before they meet: they are looked at again when they may have come half the way.
            self.wait(time, i, partner, closing);
            self.regroup(time, sliced);
            for b in [Some(i), (partner & WALL == 0).then_some(partner as usize)].into_iter().flatten() {
                if self.island_of[b] == NO_ISLAND {
                    self.predict(b);
                }
            }
            return;
        }
        let mut set = core::mem::take(&mut self.instant);
        let piled = self.pile_up(&set, time);
        let capped = match &mut set.contacts[..] {
            [only] => {
                self.alone(only, &mut set.members, piled);
                false
            }
            _ => self.several(&mut set, piled, None),
        };
        self.last_word(&mut set);
        if piled || capped {
            self.books.capped += 1;
        }
        self.book(time, &set);
        self.note_null(time, &set);
        self.finish(time, &mut set, sliced, piled);
        self.instant = set;
    }

    /// The contacts of the instant: the one that was predicted, and all that touch, connected through bodies that can move.
    fn gather(&mut self, time: f64, i: usize, partner: u32) {
        let mut set = core::mem::take(&mut self.instant);
        set.contacts.clear();
        set.members.clear();
        set.number += 1;
        set.seen.resize(self.store.bodies.len(), (0, 0));
        if partner & WALL == 0 {
            let j = partner as usize;
            // By ids, not by who owned the entry: the books see one body after the other.
            let (a, b) = if i < j { (i, j) } else { (j, i) };
            self.enlist(&mut set, time, a as u32);
            self.enlist(&mut set, time, b as u32);
            let d = self.store.nearest_image(self.store.at(b, time).0 - self.store.at(a, time).0);
            let contact = self.between_balls(a, b, d);
            set.contacts.push(contact);
        } else {
            self.enlist(&mut set, time, i as u32);
            let contact = self.against_wall(time, i, (partner & !WALL) as usize);
            set.contacts.push(contact);
        }
        set.seed_gap = set.contacts[0].gap;
        set.seed = (set.contacts[0].a, set.contacts[0].b);
        // Every member looks round once; those it touches become members.
        let mut k = 0;
        while k < set.members.len() {
            let (body, x) = (set.members[k].body, set.members[k].x);
            self.touching(&mut set, time, body as usize, x);
            k += 1;
        }
        self.prepare_contacts(&mut set);
        self.instant = set;
    }

    /// Sorts contacts and members by their ids, and gives each contact its approach.
    fn prepare_contacts(&self, set: &mut Instant<D>) {
        if set.contacts.len() > 1 {
            set.contacts.sort_unstable_by_key(|c| (c.a, c.b));
            set.members.sort_unstable_by_key(|m| m.body);
            for (k, m) in set.members.iter().enumerate() {
                set.seen[m.body as usize].1 = k as u32;
            }
        }
        for c in &mut set.contacts {
            let (va, vb) =
                (self.velocity_in(&set.members, &set.seen, c.a), self.velocity_in(&set.members, &set.seen, c.b));
            c.approach = (va - vb).dot(c.normal);
            c.departure = -c.approach;
            c.lasting = self.lasting(c);
        }
    }

    fn enlist(&self, set: &mut Instant<D>, time: f64, body: u32) {
        let i = body as usize;
        if self.store.bodies.matter[i].inverse_mass == 0.0 || set.seen[i].0 == set.number {
            return;
        }
        set.seen[i] = (set.number, set.members.len() as u32);
        set.members.push(self.member(i, time));
    }

    fn member(&self, i: usize, time: f64) -> Member<D> {
        let (x, v) = self.store.at(i, time);
        let spin = self.spin_at(i, time);
        Member { body: i as u32, x, before: v, after: v, spin_before: spin, spin_after: spin }
    }

    /// The velocity of a party of this code at the instant, as the members have it now.
    fn velocity_in(&self, members: &[Member<D>], seen: &[(u64, u32)], code: u32) -> Vector<D> {
        if code & WALL != 0 {
            return self.store.walls[(code & !WALL) as usize].velocity;
        }
        let i = code as usize;
        if self.store.bodies.matter[i].inverse_mass == 0.0 {
            return self.store.bodies.record[i].v;
        }
        members[seen[i].1 as usize].after
    }

    pub(super) fn between_balls(&self, a: usize, b: usize, d: Vector<D>) -> Touching<D> {
        let (ra, rb) = (self.store.bodies.record[a].radius, self.store.bodies.record[b].radius);
        let distance = d.norm();
        let towards = if distance > 0.0 { d } else { Vector::axis(0) };
        let normal = towards / towards.norm();
        // Along an axis the unit vector is exact, and so are the numbers of a textbook's scene.
        let towards = if normal.largest() == 1.0 { normal } else { towards };
        let gap = distance - (ra + rb);
        Touching {
            a: a as u32,
            b: b as u32,
            towards,
            normal,
            gap: gap / if ra < rb { ra } else { rb },
            // In the middle of what little gap or overlap there is, so that both arms end in one point.
            arms: [normal * (ra + 0.5 * gap), -(normal * (rb + 0.5 * gap))],
            ..Touching::default()
        }
    }

    pub(super) fn against_wall(&self, time: f64, i: usize, w: usize) -> Touching<D> {
        let radius = self.store.bodies.record[i].radius;
        let (x, _) = self.store.at(i, time);
        let x = self.store.wrapped(x, self.store.turns(x));
        let mut over = self.store.walls[w].over(time, x, radius);
        if self.store.any_periodic && over.gap > TOUCHING * radius {
            over = self.nearest_wall_image(time, x, radius, w);
        }
        Touching {
            a: i as u32,
            b: WALL | w as u32,
            towards: over.towards,
            normal: over.towards / over.towards.norm(),
            gap: over.gap / radius,
            arms: [over.point - x, Vector::ZERO],
            ..Touching::default()
        }
    }

    /// In a periodic box a ball may touch the part of a wall that lies round the corner.
    fn nearest_wall_image(&self, time: f64, x: Vector<D>, radius: f64, w: usize) -> crate::wall::Over<D> {
        let mut best = self.store.walls[w].over(time, x, radius);
        for code in 0..3usize.pow(D as u32) {
            let mut rest = code;
            let mut shift = Vector::ZERO;
            for k in 0..D {
                shift[k] = if self.store.periodic[k] { ((rest % 3) as f64 - 1.0) * self.store.width[k] } else { 0.0 };
                rest /= 3;
            }
            let mut over = self.store.walls[w].over(time, x + shift, radius);
            over.point -= shift;
            if over.gap < best.gap {
                best = over;
            }
        }
        best
    }

    /// Adds what body `i` touches.
    fn touching(&self, set: &mut Instant<D>, time: f64, i: usize, x: Vector<D>) {
        let s = &self.store;
        let radius = s.bodies.record[i].radius;
        let number = set.number;
        let first = set.contacts[0];
        let Instant { contacts, members, seen, .. } = set;
        self.cells.near(i as u32, None, |j, turns| {
            let j = j as usize;
            let r = &s.bodies.record[j];
            let mut d = s.at(j, time).0 - x;
            if s.any_periodic {
                d += s.widths(turns);
            }
            let smaller = if radius < r.radius { radius } else { r.radius };
            let reach = radius + r.radius + TOUCHING * smaller;
            if !(d.norm_squared() < reach * reach) || !s.collide(i, j) {
                return;
            }
            if s.bodies.matter[j].inverse_mass > 0.0 {
                if seen[j].0 != number {
                    seen[j] = (number, members.len() as u32);
                    members.push(self.member(j, time));
                } else if (seen[j].1 as usize) < seen[i].1 as usize {
                    return; // it has looked round already, and found this contact
                }
            }
            let (a, b, d) = if i < j { (i, j, d) } else { (j, i, -d) };
            if (a as u32, b as u32) != (first.a, first.b) {
                contacts.push(self.between_balls(a, b, d));
            }
        });
        let mut wall = |w: usize| {
            if (i as u32, WALL | w as u32) == (first.a, first.b) {
                return;
            }
            let contact = self.against_wall(time, i, w);
            let held = matches!(s.bodies.motion[i], Motion::Held | Motion::Resting) && self.island_of[i] == NO_ISLAND;
            if contact.gap < TOUCHING || held && self.supports(i, w) {
                contacts.push(contact);
            }
        };
        for &w in &self.everywhere {
            wall(w as usize);
        }
        for &w in self.cells.walls(i as u32) {
            wall(w as usize);
        }
    }

    pub(super) fn surface_of(&self, code: u32) -> MaterialId {
        if code & WALL != 0 {
            self.store.walls[(code & !WALL) as usize].material
        } else {
            self.store.bodies.matter[code as usize].material
        }
    }

    /// The acceleration of a party as its lasting contacts leave it; that of a slice is a matter of its solver.
    pub(super) fn party_acceleration(&self, code: u32) -> Vector<D> {
        if code & WALL != 0 || self.store.bodies.motion[code as usize] == Motion::Sliced {
            return Vector::ZERO;
        }
        self.store.acceleration(code as usize)
    }

    /// True if gravity presses the contact together.
    fn pressed(&self, c: &Touching<D>) -> bool {
        let closing = (self.party_acceleration(c.a) - self.party_acceleration(c.b)).dot(c.normal);
        closing > super::predict::PRESSED * self.store.gravity.norm()
    }

    /// True where `rest_speed` acts: gravity presses the contact together, or a party is in lasting contact already.
    fn lasting(&self, c: &Touching<D>) -> bool {
        if self.store.weightless || !(self.rest_speed > 0.0) {
            return false;
        }
        let held = |code: u32| {
            code & WALL == 0
                && matches!(self.store.bodies.motion[code as usize], Motion::Held | Motion::Resting | Motion::Sliced)
        };
        self.pressed(c) || held(c.a) || held(c.b)
    }

    /// The coefficient of restitution of a contact at this approach speed.
    pub(super) fn restitution(&self, c: &Touching<D>, approach: f64) -> f64 {
        if c.lasting && approach < self.rest_speed {
            return 0.0;
        }
        self.store.coefficients(self.surface_of(c.a), self.surface_of(c.b), approach).restitution
    }

    /// One contact: the law of the lecture, or where there is friction, the world's law for it.
    fn alone(&self, c: &mut Touching<D>, members: &mut [Member<D>], piled: bool) {
        if self.store.rough() && self.grips(c, members, piled) {
            return;
        }
        let moving = |code: u32, members: &[Member<D>]| {
            if code & WALL != 0 {
                return Moving { inverse_mass: 0.0, velocity: self.store.walls[(code & !WALL) as usize].velocity };
            }
            let inverse_mass = self.store.bodies.matter[code as usize].inverse_mass;
            let velocity = match members.iter().find(|m| m.body == code) {
                Some(m) => m.after,
                None => self.store.bodies.record[code as usize].v,
            };
            Moving { inverse_mass, velocity }
        };
        let (mut a, mut b) = (moving(c.a, members), moving(c.b, members));
        let e = if piled { 0.0 } else { self.restitution(c, c.approach) };
        let impulse = smooth::impact(&mut a, &mut b, c.towards, e);
        c.impulse = impulse.dot(c.normal);
        c.restitution = e;
        c.departure = -(a.velocity - b.velocity).dot(c.normal);
        for m in members {
            m.after = if m.body == c.a { a.velocity } else { b.velocity };
        }
    }

    /// The contacts of these pairs that close faster than `least` (m/s) exchange their impulses at `time`: members of one island, at
    /// the start of a slice.
    pub(super) fn bounce(&mut self, time: f64, pairs: &[(u32, u32)], least: f64) {
        let mut set = core::mem::take(&mut self.instant);
        set.contacts.clear();
        set.members.clear();
        set.number += 1;
        set.seen.resize(self.store.bodies.len(), (0, 0));
        for &(a, b) in pairs {
            self.enlist(&mut set, time, a);
            if b & WALL == 0 {
                self.enlist(&mut set, time, b);
                let (a, b) = if a < b { (a as usize, b as usize) } else { (b as usize, a as usize) };
                let d = self.store.nearest_image(self.store.at(b, time).0 - self.store.at(a, time).0);
                set.contacts.push(self.between_balls(a, b, d));
            } else {
                set.contacts.push(self.against_wall(time, a as usize, (b & !WALL) as usize));
            }
        }
        self.prepare_contacts(&mut set);
        self.events += 1;
        self.several(&mut set, false, Some(least));
        self.book(time, &set);
        for m in &set.members {
            if m.changed() {
                self.write_turning(m.body as usize, time, m.x, m.after, m.spin_after);
            }
        }
        self.instant = set;
    }

    /// The operators leave alone what closes slower than a part in 1e13 of the fastest of the set. The pair that was predicted to
    /// meet must not meet again at once: it ends without closing.
    fn last_word(&self, set: &mut Instant<D>) {
        let seed = set.seed;
        let Some(k) = set.contacts.iter().position(|c| (c.a, c.b) == seed) else { return };
        if set.contacts[k].impulse == 0.0 && set.contacts[k].departure < 0.0 {
            let mut c = set.contacts[k];
            let mut parties: Vec<Member<D>> =
                set.members.iter().filter(|m| m.body == c.a || m.body == c.b).copied().collect();
            self.alone(&mut c, &mut parties, true);
            set.contacts[k] = c;
            for p in parties {
                if let Some(m) = set.members.iter_mut().find(|m| m.body == p.body) {
                    *m = p;
                }
            }
        }
    }

    /// Several contacts at once: the world's operator, or the first iterations of `reflect` where the slice that follows takes
    /// the rest. Returns true if it had to be cut short.
    fn several(&mut self, set: &mut Instant<D>, piled: bool, least: Option<f64>) -> bool {
        let Instant { contacts, members, seen, .. } = set;
        let mut system = core::mem::take(&mut self.system);
        let mut solver = core::mem::take(&mut self.solver);
        system.clear();
        for m in members.iter() {
            system.ball(self.store.bodies.matter[m.body as usize].inverse_mass, m.before);
        }
        let place = |code: u32| {
            let movable = code & WALL == 0 && self.store.bodies.matter[code as usize].inverse_mass > 0.0;
            movable.then(|| seen[code as usize].1 as usize * D)
        };
        for c in contacts.iter() {
            match (place(c.a), place(c.b)) {
                (Some(a), Some(b)) => system.pair(a, b, c.normal),
                (Some(a), None) => system.wall(a, c.normal, self.velocity_in(members, seen, c.b)),
                // A fixed ball that comes first in the file: seen from the other one.
                (None, Some(b)) => system.wall(b, -c.normal, self.velocity_in(members, seen, c.a)),
                (None, None) => system.contact([], 0.0),
            };
        }
        let e = |k: usize, approach: f64| if piled { 0.0 } else { self.restitution(&contacts[k], approach) };
        let outcome = match least {
            None => solver.resolve(self.together, &mut system, e),
            Some(least) => solver.rebound(REBOUNDS, least, &mut system, e),
        };
        for (k, m) in members.iter_mut().enumerate() {
            m.after = system.velocity(k * D);
        }
        for (k, c) in contacts.iter_mut().enumerate() {
            c.impulse = outcome.lambda[k];
            c.restitution = outcome.first_restitution[k];
            c.departure = system.opening(k);
        }
        let capped = outcome.capped;
        self.crushed |= outcome.crushed;
        if self.store.rough() {
            self.rub(contacts, members, &mut system, &mut solver);
        }
        (self.system, self.solver) = (system, solver);
        capped
    }

    /// Writes the records of all whose motion changed and of those that were predicted to meet, finds what holds them now, and
    /// predicts what follows. `sliced` are bodies whose slices the instant ended.
    fn finish(&mut self, time: f64, set: &mut Instant<D>, mut sliced: Vec<u32>, piled: bool) {
        let scale = set.members.iter().map(|m| m.before.norm()).fold(0.0, f64::max);
        for k in 0..set.members.len() {
            let body = set.members[k].body as usize;
            // A hit wakes all that rests together.
            if set.members[k].changed() && self.island_of[body] != NO_ISLAND {
                sliced.extend(self.dissolve(self.island_of[body] as usize, time));
            }
        }
        for k in 0..set.members.len() {
            let m = set.members[k];
            let seed = m.body == set.seed.0 || m.body == set.seed.1;
            if m.changed() || self.newly_pressed(&m, set) {
                self.settle(time, &m, set, scale);
            } else if seed && self.island_of[m.body as usize] == NO_ISLAND {
                // Nothing came of it; a new record keeps the same meeting from being predicted again.
                self.write(m.body as usize, time, m.x, m.after);
            }
        }
        self.press_together(time, set, scale, &mut sliced, piled);
        if !sliced.is_empty() {
            self.regroup(time, sliced);
        }
        for k in 0..set.members.len() {
            let i = set.members[k].body as usize;
            if self.island_of[i] == NO_ISLAND && (self.store.bodies.record[i].time == time || i as u32 == set.seed.0) {
                self.predict(i);
            }
        }
        for b in [set.seed.0, set.seed.1] {
            // Whoever was hit and does not move for it, a fixed body or one that rests, had looked no further than to this meeting.
            let rests = |i: usize| {
                let k = self.island_of[i];
                k != NO_ISLAND && self.islands[k as usize].resting
            };
            if b & WALL == 0 && (self.store.bodies.matter[b as usize].inverse_mass == 0.0 || rests(b as usize)) {
                self.predict(b as usize);
            }
        }
    }

    /// True if a ball touches an arc from inside: it cannot move on without pressing against it.
    fn curves_in(&self, c: &Touching<D>, time: f64) -> bool {
        if c.b & WALL == 0 {
            return false;
        }
        let (i, wall) = (c.a as usize, &self.store.walls[(c.b & !WALL) as usize]);
        matches!(wall.shape, Shape::Arc(_)) && {
            let x = self.store.at(i, time).0 - wall.shift(time);
            wall.shape.curves_in(x, self.store.bodies.record[i].radius)
        }
    }

    /// Contacts that neither part nor close and that gravity presses together last. What one flat wall cannot hold goes to the
    /// slices. At the end of a pile-up so does what parts too slowly for positions to tell: friction on one wall lifts a ball off
    /// another by less than that, over and over.
    fn press_together(&mut self, time: f64, set: &Instant<D>, scale: f64, sliced: &mut Vec<u32>, piled: bool) {
        let still = still_speed(scale);
        if self.store.weightless && !set.contacts.iter().any(|c| self.curves_in(c, time)) {
            return;
        }
        loop {
            let mut found = false;
            for c in &set.contacts {
                let lasts = self.pressed(c) || self.curves_in(c, time);
                let parts = c.departure > still;
                let low = parts && piled && self.too_low(c, self.store.at(c.a as usize, time).0, c.departure);
                if parts && !low || c.departure < -still || !lasts {
                    continue;
                }
                if c.b & WALL != 0 && !low {
                    let (i, w) = (c.a as usize, (c.b & !WALL) as usize);
                    // Friction on one wall may press a ball against another one, which then does not hold it.
                    if self.supports(i, w) || self.flat(i, w, time) && !self.store.rough() {
                        continue;
                    }
                }
                for code in [c.a, c.b] {
                    let i = code as usize;
                    if code & WALL != 0 || self.store.bodies.matter[i].inverse_mass == 0.0 {
                        continue;
                    }
                    if self.store.bodies.motion[i] != Motion::Sliced {
                        sliced.extend(self.enlist_slice(i, time));
                        found = true;
                    }
                }
            }
            if !found {
                return;
            }
        }
    }

    /// True if a member that nothing moved touches a wall that gravity presses it against, and is not held yet.
    fn newly_pressed(&self, m: &Member<D>, set: &Instant<D>) -> bool {
        self.store.bodies.motion[m.body as usize] == Motion::Free
            && !self.store.weightless
            && set.contacts.iter().any(|c| c.a == m.body && c.b & WALL != 0)
    }
}
