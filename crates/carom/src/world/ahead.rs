//! Memory is asked for before it is needed: the calendar knows whose turn comes next, and a load that leaves the caches takes as long as
//! a hundred instructions. It changes nothing of what happens.
use super::machine::fetch;
use super::{CROSSING, WALL, World};
use crate::{Rotates, Vector};

/// Worlds of fewer bodies stay in the caches.
pub(super) const FROM: usize = 2_000;
/// Without lists of neighbours, asking who is near costs half as much as the look itself: it pays where memory is far away.
const FAR_FROM: usize = 30_000;
/// Slots between the open one and those whose entries, bodies and neighbours are asked for.
const ENTRIES: u64 = 9;
const BODIES: u64 = 6;
const NEIGHBOURS: u64 = 3;
/// A jump of the clock over more slots than this is not caught up with.
const MOST: u64 = 16;

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// A slot was opened: asks for what the slots behind it will need. `fetched` is the slot that was open the last time.
    pub(super) fn fetch_ahead(&self, fetched: &mut u64) {
        let open = self.queue.open();
        let first = if *fetched < open && open - *fetched <= MOST { *fetched + 1 } else { open };
        *fetched = open;
        for slot in first..=open {
            self.queue.fetch(slot + ENTRIES);
            let bodies = &self.store.bodies;
            self.queue.waiting_in(slot + BODIES, |owner, partner| {
                if partner == CROSSING && self.lists.on {
                    self.cells.fetch_place(owner);
                }
                fetch(&self.due, owner as usize);
                for code in [owner, partner] {
                    let i = code as usize;
                    if code & WALL == 0 {
                        fetch(&bodies.record, i);
                        fetch(&self.due, i);
                        fetch(&bodies.matter, i);
                        if self.lists.on {
                            self.lists.fetch(i);
                        } else {
                            self.cells.fetch_place(code);
                        }
                    }
                }
            });
            self.queue.waiting_in(slot + NEIGHBOURS, |owner, partner| {
                if partner == CROSSING && self.lists.on {
                    if bodies.len() >= FAR_FROM {
                        self.fetch_around_anchor(owner);
                    }
                    return;
                }
                for code in [owner, partner] {
                    let i = code as usize;
                    if code & WALL != 0 {
                        continue;
                    }
                    if self.lists.on {
                        self.lists.of(i).as_flattened().iter().for_each(|&k| fetch(&bodies.record, k as usize));
                    } else if bodies.len() >= FAR_FROM {
                        self.cells.fetch_around(code);
                    }
                }
            });
        }
    }
}
