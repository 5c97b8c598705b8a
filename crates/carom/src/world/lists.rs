//! The broad phase of dense worlds: for each body a list of those that it may meet before it, or they, have moved a little way.
//!
//! Every body has an *anchor*, a place where it was, and leaves it behind by the margin at most: then it is anchored anew, which
//! writes no record. Two bodies whose anchors are farther apart than their radii and twice the margin cannot touch; all other pairs
//! stand in each other's lists. In a dense gas a body turns round before it gets far, and a list is a third of what the cells
//! around it hold; in a dilute one cells cost less. What is predicted is the same either way.
use super::cells::WIDE_AROUND;
use super::machine::{FOUR, fetch, in_large_pages};
use super::memory::held;
use super::{Next, World, machine};
use crate::vector::Exact;
use crate::{Rotates, Vector};
use alloc::vec::Vec;

/// The most neighbours a list holds; a world in which that is too few goes back to cells.
pub(super) const MOST: usize = 28;
/// Bodies that fill more than this part of their space are dense: on the line, in the plane, and in space.
const DENSE: [f64; 3] = [0.5, 0.5, 0.25];
/// The margin, in mean radii: above this part of the space, and below it.
const MARGIN: [(f64, f64); 3] = [(0.5, 0.5), (0.55, 0.55), (0.5, 0.55)];
const VERY_DENSE: f64 = 0.4;
/// Fewer bodies than this look at all others.
const FEW: usize = 24;

/// Who is near a body.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct List {
    /// In groups of four, the last of which the body itself fills up.
    groups: [[u32; FOUR]; MOST / FOUR],
    count: u32,
}

impl List {
    /// Nobody is near this body.
    const fn empty(id: u32) -> Self {
        Self { groups: [[id; FOUR]; MOST / FOUR], count: 0 }
    }

    /// Too many are near this body.
    const fn long(id: u32) -> Self {
        Self { count: MOST as u32 + 1, ..Self::empty(id) }
    }

    #[inline(always)]
    pub fn ids(&self) -> &[u32] {
        &self.groups.as_flattened()[..(self.count as usize).min(MOST)]
    }

    #[inline(always)]
    pub fn groups(&self) -> &[[u32; FOUR]] {
        &self.groups[..(self.count as usize).min(MOST).div_ceil(FOUR)]
    }

    /// Without a branch: several are compared at once. Never asked for the body itself.
    #[inline(always)]
    fn has(&self, id: u32) -> bool {
        let mut found = false;
        for g in 0..4 {
            let [e, f, g, h] = self.groups[g];
            found |= (e == id) | (f == id) | (g == id) | (h == id);
        }
        if self.count > 16 {
            for g in 4..MOST / FOUR {
                let [e, f, g, h] = self.groups[g];
                found |= (e == id) | (f == id) | (g == id) | (h == id);
            }
        }
        found
    }

    /// False if there is no room.
    #[inline(always)]
    pub fn push(&mut self, id: u32) -> bool {
        let k = self.count as usize;
        if k >= MOST {
            return false;
        }
        self.groups[k / FOUR][k % FOUR] = id;
        self.count += 1;
        true
    }

    /// Takes a neighbour out of the list of body `own`.
    fn remove(&mut self, id: u32, own: u32) {
        if let Some(k) = self.ids().iter().position(|&other| other == id) {
            self.count -= 1;
            let all = self.groups.as_flattened_mut();
            let last = self.count as usize;
            all[k] = all[last];
            all[last] = own;
        }
    }
}

/// Where a body was, in the box, and its radius.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(super) struct Anchor<const D: usize> {
    pub x: Vector<D>,
    pub radius: f64,
}

impl<const D: usize> Anchor<D> {
    const NOWHERE: Self = Self { x: Vector::ZERO, radius: 0.0 };
}

/// The lists of a world, if it has them.
#[derive(Debug)]
pub(super) struct Lists<const D: usize> {
    /// The lists are kept, and cells hold anchors, not places.
    pub on: bool,
    /// A list was too short: the world does without from the next preparation on.
    pub short: bool,
    /// How far a body may leave its anchor behind (m).
    margin: f64,
    anchor: Vec<Anchor<D>>,
    near: Vec<List>,
    /// For measurements and tests: never, or always with this margin in mean radii.
    pub forced: Option<f64>,
}

impl<const D: usize> Default for Lists<D> {
    fn default() -> Self {
        Self { on: false, short: false, margin: 0.0, anchor: Vec::new(), near: Vec::new(), forced: None }
    }
}

impl<const D: usize> Lists<D> {
    /// The memory that the lists hold (bytes).
    pub fn bytes(&self) -> usize {
        held(&self.anchor) + held(&self.near)
    }

    #[inline(always)]
    pub fn of(&self, i: usize) -> &[[u32; FOUR]] {
        self.near[i].groups()
    }

    /// Asks for the memory of a body's list and anchor.
    pub fn fetch(&self, i: usize) {
        fetch(&self.anchor, i);
        self.fetch_list(i);
    }

    fn fetch_list(&self, i: usize) {
        fetch(&self.near, i);
        if let Some(list) = self.near.get(i) {
            fetch(&list.groups, MOST / FOUR - 1);
        }
    }

    /// Chooses: `margin` is the way that bodies may go (m).
    pub fn start(&mut self, on: bool, margin: f64, bodies: usize) {
        self.on = on;
        self.margin = margin;
        self.anchor.clear();
        self.near.clear();
        if on {
            self.anchor.reserve_exact(bodies);
            self.near.reserve_exact(bodies);
            in_large_pages(&self.anchor, false);
            in_large_pages(&self.near, false);
            self.anchor.resize(bodies, Anchor::NOWHERE);
            self.near.extend((0..bodies as u32).map(List::empty));
        } else {
            self.anchor.shrink_to_fit();
            self.near.shrink_to_fit();
        }
    }
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// Whether lists pay where bodies are so dense (to the m^D), and with which margin (m).
    pub(super) fn margin_of_lists(&self, density: f64) -> Option<f64> {
        let b = &self.store.bodies;
        let (mut filled, mut radii, mut count) = (0.0, 0.0, 0usize);
        for i in b.living() {
            let r = b.record[i].radius;
            filled += match D {
                1 => 2.0 * r,
                2 => core::f64::consts::PI * r * r,
                _ => 4.0 / 3.0 * core::f64::consts::PI * r * r * r,
            };
            radii += r;
            count += 1;
        }
        if !self.store.uniform || self.lists.short || count < FEW {
            return None;
        }
        let mean = radii / count as f64;
        let fraction = filled / count as f64 * density;
        match self.lists.forced {
            Some(margin) if margin > 0.0 => Some(margin * mean),
            Some(_) => None,
            None => {
                let (dense, (narrow, wide)) = (DENSE[D.clamp(1, 3) - 1], MARGIN[D.clamp(1, 3) - 1]);
                let margin = if fraction > VERY_DENSE { narrow } else { wide };
                (fraction > dense).then_some(margin * mean)
            }
        }
    }

    /// Never keeps lists of neighbours (0), or always, with this margin in mean radii. Results do not depend on it.
    #[doc(hidden)]
    pub fn set_lists(&mut self, margin: Option<f64>) {
        self.lists.forced = margin;
        self.ready = false;
    }

    /// True if a body surely does not leave its anchor behind by the margin before this time, to which it moves uniformly: it is nearer both
    /// now and then. Mostly so, and quicker to tell than when it does.
    #[inline(always)]
    pub(super) fn stays_at_anchor(&self, i: usize, time: f64) -> bool {
        let r = &self.store.bodies.record[i];
        let p = r.x - self.lists.anchor[i].x;
        let least = self.lists.margin * self.lists.margin * (1.0 - 1e-9);
        // It was at its record's place after it was anchored, or has since moved on along this line.
        let way = r.v * (time - r.time);
        // Mostly in the same image of the box.
        (p + way).norm_squared() < least || (self.nearest(p) + way).norm_squared() < least
    }

    /// When a body has left its anchor behind by the margin.
    pub(super) fn leaves_anchor(&self, i: usize) -> f64 {
        let s = &self.store;
        let r = &s.bodies.record[i];
        let now = if r.time > self.time { r.time } else { self.time };
        // It is near its anchor, in whatever image of the box.
        let p = self.nearest(r.x + r.v * (now - r.time) - self.lists.anchor[i].x);
        let (a, b) = (r.v.norm_squared(), p.dot(r.v));
        let c = self.lists.margin * self.lists.margin - p.norm_squared();
        if !(a > 0.0) {
            return f64::INFINITY;
        }
        // A rounding outside is at the edge.
        let c = if c > 0.0 { c } else { 0.0 };
        let root = (b * b + a * c).sqrt_();
        let dt = if b > 0.0 { c / (root + b) } else { (root - b) / a };
        now + dt
    }

    /// Anchors all bodies and makes all lists, from the cells.
    pub(super) fn make_lists(&mut self) {
        for i in 0..self.store.bodies.len() {
            if self.store.bodies.alive[i] {
                let (x, _) = self.store.at(i, self.time);
                let x = self.store.wrapped(x, self.store.turns(x));
                self.lists.anchor[i] = Anchor { x, radius: self.store.bodies.record[i].radius };
            }
        }
        let mut lists = core::mem::take(&mut self.lists.near);
        let alive = &self.store.bodies.alive;
        #[cfg(feature = "rayon")]
        self.share_out(&mut lists, |i, list| {
            *list = if alive[i] { self.around_anchor(i) } else { Some(List::empty(i as u32)) }
                .unwrap_or(List::long(i as u32))
        });
        #[cfg(not(feature = "rayon"))]
        for (i, list) in lists.iter_mut().enumerate().filter(|(i, _)| alive[*i]) {
            *list = self.around_anchor(i).unwrap_or(List::long(i as u32));
        }
        self.lists.short |= lists.iter().any(|list| list.count > MOST as u32);
        self.lists.near = lists;
    }

    /// Those whose anchors are near a body's; `None` if they are too many.
    fn around_anchor(&self, i: usize) -> Option<List> {
        let mut found = [0u32; WIDE_AROUND];
        let groups = self.cells.gather(i as u32, None, &mut found)?;
        let mut list = List::empty(i as u32);
        let margins = 2.0 * self.lists.margin;
        machine::near(&self.sight(), &self.lists.anchor, i as u32, margins, groups, &mut list).then_some(list)
    }

    /// Asks for the memory that a new list of this body takes: the anchors around it, and the lists that it stands in, most of which change.
    pub(super) fn fetch_around_anchor(&self, id: u32) {
        let mut found = [0u32; WIDE_AROUND];
        if let Some(groups) = self.cells.gather(id, None, &mut found) {
            groups.as_flattened().iter().for_each(|&k| fetch(&self.lists.anchor, k as usize));
        }
        self.lists.near[id as usize].ids().iter().for_each(|&k| self.lists.fetch_list(k as usize));
    }

    /// A body that has just been put into the cells, at this place in the box, is anchored there. Those who are new in its list.
    fn anchored(&mut self, i: usize, x: Vector<D>) -> List {
        let id = i as u32;
        if self.lists.anchor.len() <= i {
            self.lists.anchor.resize(i + 1, Anchor::NOWHERE);
            let known = self.lists.near.len() as u32;
            self.lists.near.extend((known..=id).map(List::empty));
        }
        self.lists.anchor[i] = Anchor { x, radius: self.store.bodies.record[i].radius };
        let Some(list) = self.around_anchor(i) else {
            self.lists.short = true;
            return List::empty(id);
        };
        let old = self.lists.near[i];
        for &k in old.ids().iter().filter(|&&k| !list.has(k)) {
            self.lists.near[k as usize].remove(id, k);
        }
        let mut new = List::empty(id);
        for &k in list.ids().iter().filter(|&&k| !old.has(k)) {
            new.push(k);
            if !self.lists.near[k as usize].push(id) {
                self.lists.short = true;
            }
        }
        self.lists.near[i] = list;
        new
    }

    /// A body that the user added or moved, and that stands in the cells at `x`.
    pub(super) fn list_anew(&mut self, i: usize, x: Vector<D>) {
        if self.lists.on {
            self.anchored(i, x);
        }
    }

    /// A body is gone.
    pub(super) fn unlist(&mut self, i: usize) {
        if self.lists.on {
            let old = core::mem::replace(&mut self.lists.near[i], List::empty(i as u32));
            for &k in old.ids() {
                self.lists.near[k as usize].remove(i as u32, k);
            }
        }
    }

    /// A body has left its anchor behind: it gets another one, and looks at those that are new beside it.
    pub(super) fn anchor_anew(&mut self, i: usize) {
        let (x, _) = self.store.at(i, self.time);
        let turns = self.store.turns(x);
        let x = self.store.wrapped(x, turns);
        self.cells.remove(i as u32);
        self.cells.insert(i as u32, x, turns);
        let new = self.anchored(i, x);
        let best: Next = self.due[i].next;
        self.due[i].next = self.lean_first(i, new.groups(), best);
    }
}
