//! The lean way of a plain world: two balls meet, nobody else touches them, and what follows is found in one pass over their
//! neighbours.
//!
//! A world is *plain* while its bodies move uniformly and freely, all may meet all, and none is a sensor. There an impact of two
//! balls needs none of the machinery for instants. This file does the same arithmetic as [`instant`](super::instant),
//! [`booking`](super::booking) and [`predict`](super::predict), in the same order, so that the bits are the same; whatever is unlike a
//! plain impact (a third ball touches, a wall does, the pair does not close) is left to them before anything is written.
use super::instant::TOUCHING;
use super::predict::{STILL, creep};
use super::store::{Motion, Record};
use super::{NOTHING, Next, World};
use crate::law::smooth::{self, Moving};
use crate::ledger::Magnitudes;
use crate::meet;
use crate::{Rotates, Vector};

/// The most neighbours that are looked at in one pass; where there are more the general way is taken.
const MOST: usize = 128;
/// So many neighbours are tested at a time.
const LIKELY: usize = 32;

/// What rounding may do to the coarse tests, relative to the products they are made of: five hundred times the bound of 2 D units
/// in the last place.
const COARSE: f64 = 1e-12;

/// Adding and taking away 1.5 x 2^52 rounds to the nearest integer, ties to even.
const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// A body as a pass over its neighbours sees it.
#[derive(Clone, Copy)]
struct Looker<const D: usize> {
    record: Record<D>,
    /// Where it is now.
    here: Vector<D>,
}

/// A neighbour that comes closer: its place and velocity relative to the looker at `time`.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Closing<const D: usize> {
    d: Vector<D>,
    v: Vector<D>,
    time: f64,
    who: u32,
}

/// What a pass found.
struct Found {
    next: Next,
    /// Somebody touches the looker now.
    touched: bool,
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// Looks at who is plain: made anew whenever cells and queue are.
    pub(super) fn look_at_plainness(&mut self) {
        self.plain = self.store.ignored.is_empty() && self.cells.is_wide();
        self.common_layers = u32::MAX;
        for i in 0..self.store.bodies.len() {
            if self.store.bodies.alive[i] {
                self.keep_plain(i);
            }
        }
        self.inverse_width = Vector::from_fn(|k| if self.store.periodic[k] { 1.0 / self.store.width[k] } else { 0.0 });
    }

    /// A body that is new, or that changed: the world stays plain if it is plain itself, and shares a layer with all others.
    pub(super) fn keep_plain(&mut self, i: usize) {
        let b = &self.store.bodies;
        self.common_layers &= b.layers[i].0 & b.layers[i].1;
        self.plain &= self.common_layers != 0 && b.motion[i] == Motion::Free && !b.sensor[i];
    }

    /// True if the lean way may be tried.
    #[inline(always)]
    pub(super) fn is_plain(&self) -> bool {
        self.plain && self.store.uniform
    }

    /// The earliest meeting of a looker with these neighbours, if it is earlier than `best`. `LATEST` says that no neighbour's record
    /// is later than the looker's, and that the looker's is of now.
    ///
    /// First a coarse test of all neighbours without a branch, so that nothing waits for a guess or for memory; the few that pass
    /// it are then predicted exactly.
    #[inline(always)]
    fn pass<const LATEST: bool>(&self, who: &Looker<D>, ids: &[u32], now: f64, best: Next) -> Found {
        let records = &self.store.bodies.record[..];
        let (width, inverse_width) = (self.store.width, self.inverse_width);
        let own = &who.record;
        let mut closing = [Closing { d: Vector::<D>::ZERO, v: Vector::ZERO, time: 0.0, who: 0 }; LIKELY];
        let mut best = best;
        let mut touched = false;
        for part in ids.chunks(LIKELY) {
            let mut count = 0;
            for &k in part {
                let other = &records[k as usize];
                // Where both are now: this says which image of the box is meant.
                let away = other.x + other.v * (now - other.time) - who.here;
                let turns = Vector::<D>::from_fn(|k| (away[k] * inverse_width[k] + TO_INTEGER) - TO_INTEGER);
                let shift = Vector::<D>::from_fn(|k| turns[k] * width[k]);
                let reach = own.radius + other.radius;
                // The pair's time counts from the later of the two records.
                let (time, d) = if LATEST {
                    (own.time, away - shift)
                } else {
                    let time = if own.time > other.time { own.time } else { other.time };
                    let d = (other.x + other.v * (time - other.time)) - (own.x + own.v * (time - own.time));
                    (time, d - shift)
                };
                let v = other.v - own.v;
                let square = d.norm_squared();
                if LATEST {
                    let smaller = if own.radius < other.radius { own.radius } else { other.radius };
                    let close = reach + TOUCHING * smaller;
                    touched |= square < close * close;
                }
                let b = d.dot(v);
                let c = square - reach * reach - COARSE * square;
                // Written so that what is not a number goes on to the exact test.
                let parting = b >= 0.0;
                let passing = b * b < v.norm_squared() * c;
                let late = c > -2.0 * b * ((best.time - time) * (1.0 + 1e-9));
                closing[count & (LIKELY - 1)] = Closing { d, v, time, who: k };
                count += usize::from(!(parting | passing | late));
            }
            for Closing { d, v, time, who: k } in &closing[..count] {
                let other = &records[*k as usize];
                let dt = meet::ball_ball(*d, *v, own.radius + other.radius);
                let meeting = if dt != 0.0 {
                    time + dt
                } else {
                    let smaller = if own.radius < other.radius { own.radius } else { other.radius };
                    time + creep(-d.dot(*v) / d.norm(), own.v.norm() + other.v.norm(), smaller)
                };
                if meeting < best.time || meeting == best.time && *k < best.partner {
                    best = Next { time: meeting, partner: *k, stamp: self.store.bodies.stamp[*k as usize] };
                }
            }
        }
        Found { next: best, touched }
    }

    /// What body `i` meets first of those near it (in one layer of cells, if a side is given), if it is earlier than `best`. `None`
    /// where the lean way does not go.
    pub(super) fn lean_look(&self, i: usize, side: Option<(usize, bool)>, best: Next) -> Option<Next> {
        if self.lists.on {
            return Some(self.lean_first(i, self.lists.of(i), best));
        }
        let mut ids = [0u32; MOST];
        let count = self.cells.gather(i as u32, i as u32, side, &mut ids)?;
        Some(self.lean_first(i, &ids[..count], best))
    }

    /// The same, of these.
    pub(super) fn lean_first(&self, i: usize, ids: &[u32], best: Next) -> Next {
        let record = self.store.bodies.record[i];
        let who = Looker { record, here: record.x + record.v * (self.time - record.time) };
        self.pass::<false>(&who, ids, self.time, best).next
    }

    /// The nearest image of a vector between two places in the box.
    #[inline(always)]
    pub(super) fn nearest(&self, d: Vector<D>) -> Vector<D> {
        let (width, inverse) = (self.store.width, self.inverse_width);
        Vector::from_fn(|k| d[k] - ((d[k] * inverse[k] + TO_INTEGER) - TO_INTEGER) * width[k])
    }

    /// Those near a body, but for one: into `found`, and how many they are.
    #[inline(always)]
    fn gather_lean(&self, i: usize, except: u32, found: &mut [u32]) -> Option<usize> {
        if !self.lists.on {
            return self.cells.gather(i as u32, except, None, found);
        }
        let mut count = 0;
        for &k in self.lists.of(i) {
            *found.get_mut(count)? = k;
            count += usize::from(k != except);
        }
        Some(count)
    }

    /// Bodies `i` and `j` meet at `time`, in a plain world. False, and nothing is done, if it takes more than the lean way.
    pub(super) fn meet_lean(&mut self, time: f64, i: usize, j: usize) -> bool {
        let (a, b) = if i < j { (i, j) } else { (j, i) };
        let s = &self.store;
        let (ra, rb) = (s.bodies.record[a], s.bodies.record[b]);
        let ((xa, va), (xb, vb)) = (s.at(a, time), s.at(b, time));
        let d = s.nearest_image(xb - xa);
        let mut contact = self.between_balls(a, b, d);
        contact.approach = (va - vb).dot(contact.normal);
        let (sa, sb) = (va.norm(), vb.norm());
        let scale = if sa > sb { sa } else { sb };
        if !(contact.approach > STILL * scale) || !(scale < 1e100) {
            return false;
        }
        let (mut pile_a, mut pile_b) = (self.piles[a], self.piles[b]);
        let rest = self.rest_speed > 0.0;
        if pile_a.hit(time, b as u32, false, rest, false) | pile_b.hit(time, a as u32, false, rest, false) {
            return false;
        }
        if pile_a.stands_still() || pile_b.stands_still() {
            return false;
        }
        let said = s.coefficients(s.bodies.material[a], s.bodies.material[b], contact.approach);
        if said.friction != 0.0 {
            return false;
        }
        let e = said.restitution;
        let mut one = Moving { inverse_mass: s.bodies.inverse_mass[a], velocity: va };
        let mut two = Moving { inverse_mass: s.bodies.inverse_mass[b], velocity: vb };
        let impulse = smooth::impact(&mut one, &mut two, contact.towards, e);
        contact.impulse = impulse.dot(contact.normal);
        contact.restitution = e;
        contact.departure = -(one.velocity - two.velocity).dot(contact.normal);
        if !(contact.impulse > 0.0) || one.velocity == va || two.velocity == vb {
            return false;
        }
        // Records as they will be, and what they meet: if somebody else touches, none of this happens.
        let (ta, tb) = (s.turns(xa), s.turns(xb));
        let after_a = Record { x: s.wrapped(xa, ta), v: one.velocity, time, radius: ra.radius };
        let after_b = Record { x: s.wrapped(xb, tb), v: two.velocity, time, radius: rb.radius };
        let mut ids = [0u32; 2 * MOST];
        let (near_a, near_b) = ids.split_at_mut(MOST);
        let (Some(count_a), Some(count_b)) =
            (self.gather_lean(a, b as u32, near_a), self.gather_lean(b, a as u32, near_b))
        else {
            return false;
        };
        let (near_a, near_b) = (&near_a[..count_a], &near_b[..count_b]);
        let nothing = Next { time: f64::INFINITY, partner: NOTHING, stamp: 0 };
        let first_a = self.pass::<true>(&Looker { record: after_a, here: after_a.x }, near_a, time, nothing);
        let first_b = self.pass::<true>(&Looker { record: after_b, here: after_b.x }, near_b, time, nothing);
        if first_a.touched || first_b.touched || self.touches_wall(a, &after_a) || self.touches_wall(b, &after_b) {
            return false;
        }
        // From here on it happens.
        self.time = time;
        self.events += 1;
        let overlap = -contact.gap;
        if overlap > self.books.overlap {
            self.books.overlap = overlap;
        }
        let lost = 0.5 * contact.impulse * (contact.approach - contact.departure);
        self.books.lost.add(lost);
        self.impact_count += 1;
        if self.keep_reports {
            let mut set = core::mem::take(&mut self.instant);
            set.only(contact, [(xa, va, one.velocity), (xb, vb, two.velocity)]);
            let impact = self.report(time, &contact, &set, xa, lost, 1);
            self.impacts.push(impact);
            self.instant = set;
        }
        (self.piles[a], self.piles[b]) = (pile_a, pile_b);
        (self.nulls[a], self.nulls[b]) = Default::default();
        self.rewrite(a, after_a, ta);
        self.rewrite(b, after_b, tb);
        // The two of them, last: each with the other's new record.
        self.next[a] =
            self.pass::<true>(&Looker { record: after_a, here: after_a.x }, &[b as u32], time, first_a.next).next;
        self.next[b] =
            self.pass::<true>(&Looker { record: after_b, here: after_b.x }, &[a as u32], time, first_b.next).next;
        for k in [a, b] {
            self.look_at_walls(k);
            self.schedule(k);
        }
        true
    }

    /// True if a wall touches a body of this record now.
    fn touches_wall(&self, i: usize, r: &Record<D>) -> bool {
        let touches = |&w: &u32| self.against_wall(r.time, i, w as usize).gap < TOUCHING;
        self.everywhere.iter().any(touches) || self.cells.walls(i as u32).iter().any(touches)
    }

    /// Writes a record that an impact in a plain world left, and what it does to the sums of magnitudes.
    fn rewrite(&mut self, i: usize, record: Record<D>, turns: [i32; D]) {
        let before = self.magnitudes(i);
        let b = &mut self.store.bodies;
        if self.store.any_periodic && turns != [0; D] {
            for k in 0..D {
                b.image[i][k] += turns[k];
            }
        }
        if self.store.any_periodic {
            self.cells.rewrapped(i as u32, turns);
        }
        b.record[i] = record;
        b.stamp[i] = b.stamp[i].wrapping_add(1);
        if self.books.start.is_some() {
            let after: Magnitudes = self.magnitudes(i);
            self.books.now.add(&before, -1.0);
            self.books.now.add(&after, 1.0);
            let now = self.books.now;
            self.books.largest.raise(&now);
        }
        if !(record.v.is_finite() && record.x.is_finite()) {
            self.broken = true;
        }
    }
}
