//! The queue: which meeting is next. A calendar: later slots are unsorted chains of nodes from one store, which are sorted when they
//! are opened; what comes into the slot that is open is a heap, and what lies beyond the last slot waits apart.
//!
//! What comes out first depends on the entries alone (time, then ids), never on the width of a slot: the calendar re-chooses
//! its width as it likes.
use super::machine::{fetch, in_large_pages};
use super::memory::held;
use alloc::collections::BinaryHeap;
use alloc::{vec, vec::Vec};
use core::cmp::{Ordering, Reverse};

/// An entry: body `owner` meets `partner` (a code of its own) at `time`, if `stamp` is still the owner's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Entry {
    pub time: f64,
    pub owner: u32,
    pub partner: u32,
    pub stamp: u32,
}

impl Entry {
    /// Times are never negative and never NaN, so that their bits sort as they do. At equal times crossings come first (they
    /// may discover who else meets now), then pairs by their two ids, whoever owns the entry.
    fn key(&self) -> (u64, u32, u32) {
        let (low, high) =
            if self.owner < self.partner { (self.owner, self.partner) } else { (self.partner, self.owner) };
        if self.partner == super::CROSSING {
            (self.time.to_bits(), 0, self.owner)
        } else {
            (self.time.to_bits(), low + 1, high)
        }
    }
}

impl Eq for Entry {}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        // Hardly ever are two times equal.
        match self.time.to_bits().cmp(&other.time.to_bits()) {
            Ordering::Equal => {
                self.key().cmp(&other.key()).then(self.owner.cmp(&other.owner)).then(self.stamp.cmp(&other.stamp))
            }
            unequal => unequal,
        }
    }
}

/// A slot this full on opening, on average, says that the width is too large.
const CROWDED: usize = 32;
/// So many empty slots passed for each one opened say that it is too small.
const SPARSE: usize = 16;

/// So many entries of a slot are looked at before it is opened.
const MOST_AHEAD: usize = 8;
/// Widths at which the slots hold fewer entries than this, on average, are doubled while a part of the entries falls beyond the ring.
const FEW: usize = 3;
const BEYOND: usize = 8;

/// No node.
const NONE: u32 = u32::MAX;

/// An entry that waits in a slot, and the next one of the slot.
#[derive(Clone, Copy, Debug)]
struct Node {
    time: f64,
    owner: u32,
    partner: u32,
    stamp: u32,
    next: u32,
}

#[derive(Debug)]
pub(crate) struct Calendar {
    /// Width of a slot (s), and its inverse.
    width: f64,
    per_second: f64,
    /// The number of the open slot, counted from time 0.
    open: u64,
    /// The entries of the open slot, the first one last, and those that came since it was opened.
    front: Vec<Entry>,
    late: BinaryHeap<Reverse<Entry>>,
    /// The first node of each slot; the nodes, and the first of those that wait to be used.
    ring: Vec<u32>,
    nodes: Vec<Node>,
    spare: u32,
    /// Entries waiting in the ring.
    waiting: usize,
    far: Vec<Entry>,
    /// Since the last choice of the width: slots opened, empty slots passed, entries found.
    opened: usize,
    passed: usize,
    found: usize,
    /// Entries that came in all, and beyond the ring.
    pushed: usize,
    beyond: usize,
}

impl Default for Calendar {
    fn default() -> Self {
        Self {
            width: 1.0,
            per_second: 1.0,
            open: 0,
            front: Vec::new(),
            late: BinaryHeap::new(),
            ring: vec![NONE; 64],
            nodes: Vec::new(),
            spare: NONE,
            waiting: 0,
            far: Vec::new(),
            opened: 0,
            passed: 0,
            found: 0,
            pushed: 0,
            beyond: 0,
        }
    }
}

impl Calendar {
    /// Empties the queue and makes it ready for about `count` entries from time `now` on, spread over `span` seconds.
    pub(crate) fn reset(&mut self, now: f64, count: usize, span: f64) {
        let slots = (2 * count).next_power_of_two().clamp(64, 1 << 23);
        self.empty(slots);
        self.nodes.reserve_exact(count);
        in_large_pages(&self.nodes, false);
        self.far.clear();
        let width = span / slots as f64;
        self.choose(if width > 0.0 && width.is_finite() { width } else { 1.0 }, now);
    }

    /// Nothing in the front or in the ring, of this many slots.
    fn empty(&mut self, slots: usize) {
        self.front.clear();
        self.late.clear();
        self.nodes.clear();
        self.spare = NONE;
        self.ring.clear();
        self.ring.reserve_exact(slots);
        in_large_pages(&self.ring, false);
        self.ring.resize(slots, NONE);
        self.waiting = 0;
    }

    /// The memory that the queue holds (bytes).
    pub(crate) fn bytes(&self) -> usize {
        let front = held(&self.front) + self.late.capacity() * size_of::<Entry>();
        front + held(&self.ring) + held(&self.nodes) + held(&self.far)
    }

    fn choose(&mut self, width: f64, now: f64) {
        // A slot must be wider than the clock's own step, and its number must fit.
        let least = if now * 1e-15 > 1e-300 { now * 1e-15 } else { 1e-300 };
        self.width = if width > least { width } else { least };
        self.per_second = 1.0 / self.width;
        self.open = self.slot(now);
        self.count_anew();
    }

    fn count_anew(&mut self) {
        (self.opened, self.passed, self.found, self.pushed, self.beyond) = (0, 0, 0, 0, 0);
    }

    fn slot(&self, time: f64) -> u64 {
        (time * self.per_second) as u64 // saturates
    }

    #[inline]
    pub(crate) fn push(&mut self, entry: Entry) {
        if !(entry.time < f64::INFINITY) {
            return;
        }
        let slot = self.slot(entry.time);
        if slot <= self.open {
            self.late.push(Reverse(entry));
        } else if slot - self.open < self.ring.len() as u64 {
            let at = slot as usize & (self.ring.len() - 1);
            let Entry { time, owner, partner, stamp } = entry;
            let node = Node { time, owner, partner, stamp, next: self.ring[at] };
            match self.nodes.get_mut(self.spare as usize) {
                Some(place) => {
                    self.ring[at] = self.spare;
                    self.spare = place.next;
                    *place = node;
                }
                None => {
                    self.ring[at] = self.nodes.len() as u32;
                    self.nodes.push(node);
                }
            }
            self.waiting += 1;
        } else {
            self.far.push(entry);
            self.beyond += 1;
        }
        self.pushed += 1;
    }

    /// The first entry of all that `live` accepts; what it refuses is dropped.
    #[inline]
    pub(crate) fn peek(&mut self, mut live: impl FnMut(&Entry) -> bool) -> Option<Entry> {
        loop {
            while let Some(first) = self.first() {
                if live(&first) {
                    return Some(first);
                }
                self.pop();
            }
            if !self.open_next(&mut live) {
                return None;
            }
        }
    }

    /// The first entry of the open slot, live or not.
    #[inline]
    fn first(&self) -> Option<Entry> {
        let sorted = self.front.last();
        match (sorted, self.late.peek()) {
            (Some(a), Some(Reverse(b))) => Some(if a < b { *a } else { *b }),
            (Some(a), None) => Some(*a),
            (None, b) => b.map(|b| b.0),
        }
    }

    /// Takes the entry that `peek` has just returned.
    #[inline]
    pub(crate) fn pop(&mut self) {
        let from_late = match (self.front.last(), self.late.peek()) {
            (Some(a), Some(Reverse(b))) => a >= b,
            (None, Some(_)) => true,
            _ => false,
        };
        if from_late {
            self.late.pop();
        } else {
            self.front.pop();
        }
    }

    /// The number of the slot that is open.
    #[inline(always)]
    pub(crate) fn open(&self) -> u64 {
        self.open
    }

    /// Owners and partners of what waits in a slot that is yet to be opened: the first few.
    #[inline]
    pub(crate) fn waiting_in(&self, slot: u64, mut visit: impl FnMut(u32, u32)) {
        let mut k = self.ring[slot as usize & (self.ring.len() - 1)];
        for _ in 0..MOST_AHEAD {
            let Some(node) = self.nodes.get(k as usize) else { return };
            visit(node.owner, node.partner);
            k = node.next;
        }
    }

    /// Asks for the memory of the first entry of a slot.
    #[inline]
    pub(crate) fn fetch(&self, slot: u64) {
        fetch(&self.nodes, self.ring[slot as usize & (self.ring.len() - 1)] as usize);
    }

    #[inline(always)]
    fn open_next(&mut self, live: &mut impl FnMut(&Entry) -> bool) -> bool {
        if self.waiting == 0 {
            // Nothing in the ring: go straight to the first of what waits apart.
            self.far.retain(|e| live(e));
            let Some(first) = self.far.iter().map(|e| e.time.to_bits()).min().map(f64::from_bits) else { return false };
            self.spread(first);
            return true;
        }
        let mask = self.ring.len() - 1;
        loop {
            self.open += 1;
            if self.open & mask as u64 == 0 && !self.far.is_empty() {
                self.gather_far(live);
            }
            let mut k = core::mem::replace(&mut self.ring[self.open as usize & mask], NONE);
            if k == NONE {
                self.passed += 1;
                continue;
            }
            self.opened += 1;
            while let Some(node) = self.nodes.get_mut(k as usize) {
                let entry = Entry { time: node.time, owner: node.owner, partner: node.partner, stamp: node.stamp };
                let next = core::mem::replace(&mut node.next, self.spare);
                self.spare = k;
                k = next;
                self.waiting -= 1;
                self.found += 1;
                if live(&entry) {
                    self.front.push(entry);
                }
            }
            if self.front.len() > 1 {
                self.front.sort_unstable_by(|a, b| b.cmp(a));
            }
            break;
        }
        if self.opened + self.passed / SPARSE > self.ring.len() {
            self.adapt();
        }
        true
    }

    /// Once a turn of the ring: what waited apart and now lies within the ring moves in.
    fn gather_far(&mut self, live: &mut impl FnMut(&Entry) -> bool) {
        let far = core::mem::take(&mut self.far);
        for entry in far {
            if live(&entry) {
                self.push(entry);
            }
        }
    }

    /// Chooses a width anew if the slots are too full or too empty.
    fn adapt(&mut self) {
        let factor = if self.found > CROWDED * self.opened {
            8.0 * self.opened as f64 / self.found as f64
        } else if self.passed > SPARSE * self.opened {
            (self.passed as f64 / self.opened.max(1) as f64).min(1024.0)
        } else if self.beyond > self.pushed / BEYOND && self.found < FEW * (self.opened + self.passed) {
            2.0
        } else {
            self.count_anew();
            return;
        };
        let now = self.open as f64 * self.width;
        let mut all: Vec<Entry> = core::mem::take(&mut self.far);
        for &first in &self.ring {
            let mut k = first;
            while let Some(&Node { time, owner, partner, stamp, next }) = self.nodes.get(k as usize) {
                all.push(Entry { time, owner, partner, stamp });
                k = next;
            }
        }
        all.append(&mut self.front);
        all.extend(self.late.drain().map(|e| e.0));
        self.empty(self.ring.len());
        self.choose(self.width * factor, now);
        for entry in all {
            self.push(entry);
        }
    }

    /// Opens the slot of this time and spreads what waited apart over the ring behind it.
    fn spread(&mut self, time: f64) {
        let far = core::mem::take(&mut self.far);
        let last = far.iter().map(|e| e.time).fold(time, f64::max);
        // All of it should fit, at a few entries a slot.
        let width = (last - time) / self.ring.len() as f64;
        if width > 0.0 && width.is_finite() && (width > self.width || far.len() > self.ring.len() / 8) {
            self.choose(width * 1.0001, time);
        } else {
            self.open = self.slot(time);
        }
        for entry in far {
            self.push(entry);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    proptest! {
        /// A calendar hands out what a sorted list would, whatever the times, with pushes between the pops.
        #[test]
        fn in_order(
            times in prop::collection::vec((0.0..1.0f64, 0..60i32), 1..300),
            later in prop::collection::vec((0.0..1.0f64, -60..10i32), 0..300),
            span in 0..40i32,
        ) {
            let mut calendar = Calendar::default();
            calendar.reset(0.0, times.len(), 2.0f64.powi(span - 30));
            let mut sorted = BTreeMap::new();
            let mut owner = 0;
            let mut add = |calendar: &mut Calendar, sorted: &mut BTreeMap<_, _>, time: f64| {
                let entry = Entry { time, owner, partner: owner + 1, stamp: 0 };
                owner += 1;
                calendar.push(entry);
                sorted.insert((time.to_bits(), entry.owner), entry);
            };
            for (t, p) in times {
                add(&mut calendar, &mut sorted, t * 2.0f64.powi(p - 40));
            }
            let mut later = later.into_iter();
            while let Some(first) = calendar.peek(|_| true) {
                calendar.pop();
                let (_, want) = sorted.pop_first().unwrap();
                prop_assert_eq!(first, want);
                if let Some((t, p)) = later.next() {
                    add(&mut calendar, &mut sorted, first.time + t * 2.0f64.powi(p));
                }
            }
            prop_assert!(sorted.is_empty());
        }
    }
}
