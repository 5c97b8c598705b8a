//! The lean way of a plain world: two balls meet, nobody else touches them, and what follows is found in one pass over their
//! neighbours.
//!
//! A world is *plain* while its bodies move freely, all may meet all, and none is a sensor. One gravity for all changes little:
//! relative motion is as uniform as without. There an impact of two balls needs none of the machinery for instants. This file does the same arithmetic as [`instant`](super::instant),
//! [`booking`](super::booking) and [`predict`](super::predict), in the same order, so that the bits are the same; whatever is unlike a
//! plain impact (a third ball touches, a wall does, the pair does not close) is left to them before anything is written.
use super::cells::AROUND;
use super::instant::{Member, TOUCHING, Touching};
use super::machine::{self, FOUR};
use super::predict::{STILL, creep};
use super::sight::{Found, Looker, Sight, TO_INTEGER};
use super::store::{Motion, Record};
use super::{NOTHING, Next, World};
use crate::law::smooth::{self, Moving};
use crate::meet;
use crate::vector::Exact;
use crate::{Rotates, Shape, Vector};

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// Looks at who is plain: made anew whenever cells and queue are.
    pub(super) fn look_at_plainness(&mut self) {
        self.plain = self.store.ignored.is_empty() && self.cells.is_wide();
        self.common_layers = u32::MAX;
        let motions = self.store.bodies.living().map(|i| self.store.bodies.motion[i]);
        self.bound = motions.filter(|m| !matches!(m, Motion::Free | Motion::Fixed)).count();
        for i in 0..self.store.bodies.len() {
            if self.store.bodies.alive[i] {
                self.keep_plain(i);
            }
        }
        self.any_null = self.nulls.iter().any(|null| !null.is_none());
        self.inverse_width = Vector::from_fn(|k| if self.store.periodic[k] { 1.0 / self.store.width[k] } else { 0.0 });
    }

    /// A body that is new, or that changed: the world stays plain if it is plain itself, and shares a layer with all others.
    pub(super) fn keep_plain(&mut self, i: usize) {
        let b = &self.store.bodies;
        self.common_layers &= b.layers[i].0 & b.layers[i].1;
        self.plain &= self.common_layers != 0 && b.motion[i] != Motion::Fixed && !b.sensor[i];
    }

    /// True if the lean way may be tried.
    #[inline(always)]
    pub(super) fn is_plain(&self) -> bool {
        self.plain && self.bound == 0
    }

    /// What a look reads.
    #[inline(always)]
    pub(super) fn sight(&self) -> Sight<'_, D> {
        let bodies = &self.store.bodies;
        Sight {
            records: &bodies.record,
            matter: &bodies.matter,
            width: self.store.width,
            inverse_width: self.inverse_width,
            fall: if self.store.uniform { None } else { Some(self.store.gravity) },
        }
    }

    /// What two bodies of these records, which are of now, meet first of those near them but for each other. `None` where the lean way does
    /// not go.
    #[inline(always)]
    fn first_after<const VECTORS: bool>(
        &self,
        sight: &Sight<'_, D>,
        ids: [usize; 2],
        records: [&Record<D>; 2],
    ) -> Option<[Found; 2]> {
        let one = Looker { id: ids[0] as u32, record: records[0], here: &records[0].x };
        let two = Looker { id: ids[1] as u32, record: records[1], here: &records[1].x };
        let now = records[0].time;
        if self.lists.on {
            let groups = [self.lists.of(ids[0]), self.lists.of(ids[1])];
            return Some(machine::first_two::<D, VECTORS>(sight, [&one, &two], groups, now));
        }
        let (mut near_one, mut near_two) = ([0u32; AROUND], [0u32; AROUND]);
        let one_groups = self.cells.gather(one.id, None, &mut near_one)?;
        let two_groups = self.cells.gather(two.id, None, &mut near_two)?;
        Some(machine::first_two::<D, VECTORS>(sight, [&one, &two], [one_groups, two_groups], now))
    }

    /// What body `i` meets first of those near it (in one layer of cells, if a side is given), if it is earlier than `best`. `None`
    /// where the lean way does not go.
    pub(super) fn lean_look(&self, i: usize, side: Option<(usize, bool)>, best: Next) -> Option<Next> {
        if self.lists.on {
            return Some(self.lean_first(i, self.lists.of(i), best));
        }
        let mut ids = [0u32; AROUND];
        let groups = self.cells.gather(i as u32, side, &mut ids)?;
        Some(self.lean_first(i, groups, best))
    }

    /// The same, of these.
    pub(super) fn lean_first(&self, i: usize, groups: &[[u32; FOUR]], best: Next) -> Next {
        let record = &self.store.bodies.record[i];
        let here = record.x + record.v * (self.time - record.time);
        let who = Looker { id: i as u32, record, here: &here };
        machine::first::<D, false>(&self.sight(), &who, groups, NOTHING, self.time, best).next
    }

    /// The nearest image of a vector between two places in the box.
    #[inline(always)]
    pub(super) fn nearest(&self, d: Vector<D>) -> Vector<D> {
        let mut near = d;
        for k in 0..D {
            let turns = (d[k] * self.inverse_width[k] + TO_INTEGER) - TO_INTEGER;
            near[k] = d[k] - turns * self.store.width[k];
        }
        near
    }

    /// Bodies `i` and `j` meet at `time`, in a plain world. False, and nothing is done, if it takes more than the lean way. `VECTORS` where the
    /// caller is compiled for vectors ([`machine`]), and nowhere else.
    #[inline(always)]
    pub(super) fn meet_lean<const VECTORS: bool>(&mut self, time: f64, i: usize, j: usize) -> bool {
        let (a, b) = if i < j { (i, j) } else { (j, i) };
        let s = &self.store;
        let (ra, rb) = (s.bodies.record[a], s.bodies.record[b]);
        let ((xa, va), (xb, vb)) = (s.at(a, time), s.at(b, time));
        let d = self.nearest(xb - xa);
        let distance = d.norm();
        if !(distance > 0.0) {
            return false;
        }
        let normal = d / distance;
        // Along an axis the unit vector is exact, and so are the numbers of a textbook's scene.
        let towards = if is_axis(normal) { normal } else { d };
        let approach = (va - vb).dot(normal);
        let (sa, sb) = (va.norm(), vb.norm());
        let scale = if sa > sb { sa } else { sb };
        if !(approach > STILL * scale) || !(scale < 1e100) {
            return false;
        }
        let (mut pile_a, mut pile_b) = (self.due[a].pile, self.due[b].pile);
        let (rest, heavy) = (self.rest_speed > 0.0, !s.weightless);
        if pile_a.hit(time, b as u32, heavy, rest, false) | pile_b.hit(time, a as u32, heavy, rest, false) {
            return false;
        }
        if pile_a.stands_still() || pile_b.stands_still() {
            return false;
        }
        let gripped = if s.rough() { self.gripped([a, b], [xa, xb], [va, vb], d, approach) } else { None };
        let (after, impulse, departure, restitution, rubbed) = match &gripped {
            Some((c, m)) => ([m[0].after, m[1].after], c.impulse, c.departure, c.restitution, c.rubbed),
            None => {
                let said = s.coefficients(s.bodies.matter[a].material, s.bodies.matter[b].material, approach);
                if said.friction != 0.0 {
                    return false;
                }
                let mut one = Moving { inverse_mass: s.bodies.matter[a].inverse_mass, velocity: va };
                let mut two = Moving { inverse_mass: s.bodies.matter[b].inverse_mass, velocity: vb };
                let push = smooth::impact(&mut one, &mut two, towards, said.restitution);
                let departure = -(one.velocity - two.velocity).dot(normal);
                ([one.velocity, two.velocity], push.dot(normal), departure, said.restitution, 0.0)
            }
        };
        if !(impulse > 0.0) || is_same(after[0], va) || is_same(after[1], vb) {
            return false;
        }
        // Records as they will be, and what they meet: if somebody else touches, none of this happens.
        let ta = if s.is_inside(xa) { None } else { Some(s.turns(xa)) };
        let tb = if s.is_inside(xb) { None } else { Some(s.turns(xb)) };
        let mut after_a = Record { x: xa, v: after[0], time, radius: ra.radius };
        let mut after_b = Record { x: xb, v: after[1], time, radius: rb.radius };
        if let Some(turns) = ta {
            after_a.x = s.wrapped(xa, turns);
        }
        if let Some(turns) = tb {
            after_b.x = s.wrapped(xb, turns);
        }
        let sight = self.sight();
        let Some([first_a, first_b]) = self.first_after::<VECTORS>(&sight, [a, b], [&after_a, &after_b]) else {
            return false;
        };
        if first_a.touched || first_b.touched {
            return false;
        }
        let walls = !self.everywhere.is_empty() || self.cells.has_walls();
        if walls && (self.touches_wall(a, &after_a) || self.touches_wall(b, &after_b)) {
            return false;
        }

        // All of it is known: from here on it happens.
        self.time = time;
        self.events += 1;
        let overlap = (ra.radius + rb.radius - distance) / if ra.radius < rb.radius { ra.radius } else { rb.radius };
        if overlap > self.books.overlap {
            self.books.overlap = overlap;
        }
        let lost = 0.5 * impulse * (approach - departure) + rubbed;
        self.books.lost.add(lost);
        self.impact_count += 1;
        if self.keep_reports {
            let mut contact = self.between_balls(a, b, d);
            (contact.approach, contact.departure) = (approach, departure);
            (contact.impulse, contact.restitution) = (impulse, restitution);
            let mut set = core::mem::take(&mut self.instant);
            let spins = [self.store.bodies.spin[a], self.store.bodies.spin[b]];
            set.only(contact, [(xa, va, after[0]), (xb, vb, after[1])], spins);
            if let Some((c, members)) = &gripped {
                contact = *c;
                set.members.copy_from_slice(members);
            }
            let impact = self.report(time, &contact, &set, xa, lost, 1);
            self.impacts.push(impact);
            self.instant = set;
        }
        (self.due[a].pile, self.due[b].pile) = (pile_a, pile_b);
        if self.any_null {
            (self.nulls[a], self.nulls[b]) = Default::default();
        }
        if self.store.uniform {
            self.weigh(a, &ra, sa, &after_a);
            self.weigh(b, &rb, sb, &after_b);
            if let Some((_, members)) = &gripped {
                members.iter().for_each(|m| self.turn(m));
            }
            let now = self.books.now;
            self.books.largest.raise(&now);
            self.rewrite(a, after_a, ta);
            self.rewrite(b, after_b, tb);
        } else {
            // What gravity gave since the last records goes into the books as well.
            let spins = match &gripped {
                Some((_, members)) => [members[0].spin_after, members[1].spin_after],
                None => [self.store.bodies.spin[a], self.store.bodies.spin[b]],
            };
            self.write_turning(a, time, xa, after[0], spins[0]);
            self.write_turning(b, time, xb, after[1], spins[1]);
        }
        // The two of them again, each with the other's new record.
        let again = self.again(&after_a, &after_b);
        (self.due[a].next, self.due[b].next) = (first_a.next, first_b.next);
        let stamps = (self.store.bodies.matter[a].stamp, self.store.bodies.matter[b].stamp);
        if again < f64::INFINITY {
            self.offer(a, again, b as u32, stamps.1);
            self.offer(b, again, a as u32, stamps.0);
        }
        for k in [a, b] {
            if walls {
                self.look_at_walls(k);
            }
            self.schedule(k);
        }
        true
    }

    /// What friction makes of the impact: the contact, and both bodies, if their surfaces rub.
    #[inline(never)]
    fn gripped(
        &self,
        ids: [usize; 2],
        x: [Vector<D>; 2],
        v: [Vector<D>; 2],
        d: Vector<D>,
        approach: f64,
    ) -> Option<(Touching<D>, [Member<D>; 2])> {
        let mut contact = self.between_balls(ids[0], ids[1], d);
        contact.approach = approach;
        let member = |k: usize| {
            let spin = self.store.bodies.spin[ids[k]];
            Member { body: ids[k] as u32, x: x[k], before: v[k], after: v[k], spin_before: spin, spin_after: spin }
        };
        let mut members = [member(0), member(1)];
        self.grips(&mut contact, &mut members, false).then_some((contact, members))
    }

    /// Gives a body the spin that an impact left it, and what that does to the sums of magnitudes.
    fn turn(&mut self, m: &Member<D>) {
        let i = m.body as usize;
        let inertia = self.store.bodies.inertia[i];
        let square = |spin| Vector::<D>::spin_dot(spin, spin);
        let (then, now) = (square(m.spin_before), square(m.spin_after));
        self.store.bodies.spin[i] = m.spin_after;
        if self.books.start.is_some() {
            self.books.now.energy += 0.5 * inertia * (now - then);
            if !self.store.any_periodic {
                self.books.now.angular += inertia * (now.sqrt_() - then.sqrt_());
            }
        }
    }

    /// When two that have just met meet again: hardly ever, for they part.
    #[inline(always)]
    fn again(&self, a: &Record<D>, b: &Record<D>) -> f64 {
        let (d, w) = (self.nearest(b.x - a.x), b.v - a.v);
        let dt = meet::ball_ball(d, w, a.radius + b.radius);
        if dt != 0.0 {
            return a.time + dt;
        }
        let smaller = if a.radius < b.radius { a.radius } else { b.radius };
        a.time + creep(-d.dot(w) / d.norm(), a.v.norm() + b.v.norm(), smaller)
    }

    /// True if a wall touches a body of this record now.
    fn touches_wall(&self, i: usize, r: &Record<D>) -> bool {
        let touches = |&w: &u32| {
            let wall = &self.store.walls[w as usize];
            match &wall.shape {
                // As `against_wall` has it, without what only a contact needs.
                Shape::Plane { point, normal } if !self.store.any_periodic => {
                    let height = (r.x - wall.shift(r.time) - *point).dot(*normal);
                    (height - r.radius) / r.radius < TOUCHING
                }
                _ => self.against_wall(r.time, i, w as usize).gap < TOUCHING,
            }
        };
        self.everywhere.iter().any(touches) || self.cells.walls(i as u32).iter().any(touches)
    }

    /// What an impact does to the sums of magnitudes, of a body whose speed before it is known. Nothing turns it.
    #[inline(always)]
    fn weigh(&mut self, i: usize, before: &Record<D>, speed: f64, after: &Record<D>) {
        let m = self.store.bodies.matter[i].mass;
        if self.books.start.is_none() || self.store.bodies.matter[i].inverse_mass == 0.0 {
            return;
        }
        let square = after.v.norm_squared();
        let (then, now) = (m * speed, m * square.sqrt_());
        let magnitudes = &mut self.books.now;
        magnitudes.momentum += now - then;
        magnitudes.energy += 0.5 * m * (square - speed * speed);
        // A periodic world has no such account.
        if !self.store.any_periodic {
            magnitudes.angular += after.x.norm_squared().sqrt_() * now - before.x.norm_squared().sqrt_() * then;
        }
    }

    /// Writes a record that an impact in a plain world left.
    #[inline(always)]
    fn rewrite(&mut self, i: usize, record: Record<D>, turns: Option<[i32; D]>) {
        let b = &mut self.store.bodies;
        if let Some(turns) = turns {
            for k in 0..D {
                b.image[i][k] = b.image[i][k].saturating_add(turns[k]);
            }
            self.cells.rewrapped(i as u32, turns);
        }
        b.record[i] = record;
        b.matter[i].stamp = b.matter[i].stamp.wrapping_add(1);
        if !(record.v.is_finite() && record.x.is_finite()) {
            self.broken = true;
        }
    }
}

/// As `==`, which for arrays is a call where the code is compiled for what the machine has.
#[inline(always)]
fn is_same<const D: usize>(a: Vector<D>, b: Vector<D>) -> bool {
    let mut same = true;
    for k in 0..D {
        same &= a[k] == b[k];
    }
    same
}

/// True for a unit vector along an axis.
#[inline(always)]
fn is_axis<const D: usize>(normal: Vector<D>) -> bool {
    let mut largest = 0.0;
    for k in 0..D {
        let magnitude = normal[k].abs_();
        largest = if magnitude > largest { magnitude } else { largest };
    }
    largest == 1.0
}
