//! Many threads, the same bits: what is a pure function of the world as it stands is computed by several threads at once, and
//! events still happen one after the other, in the order of their times.
//!
//! Lists of neighbours and first predictions are shared out body by body. Meetings are *planned* ahead: the calendar knows who is due
//! next, and what a meeting of two balls does (new records, and what both meet first after it) depends on nothing but them and those
//! in their lists. A plan is carried out when its turn comes, unless one of the bodies that it was made from has changed meanwhile;
//! whoever changes marks itself and all in its list, and what is marked is planned anew. So a plan that is carried out is what one
//! thread would have computed at that time, to the last bit.
use super::calendar::Entry;
use super::lean::Plan;
use super::{Limits, Next, Stop, WALL, World};
use crate::{Rotates, Vector};
use alloc::sync::Arc;
use alloc::vec::Vec;
use rayon::prelude::*;

/// Smaller worlds change so much in the time of a batch that plans go stale, and a batch is shorter than the way to another thread.
const FROM: usize = 50_000;
/// Bodies for each meeting that is planned ahead: a meeting touches some thirty bodies, so that a twentieth of the plans goes stale.
const SHARE: usize = 600;
/// The most meetings of a batch, and the slots of the calendar that are searched for them for each.
const MOST: usize = 8192;
const SLOTS: usize = 8;
/// Meetings that a thread plans at a time; their bodies' memory is asked for so many meetings ahead, that of neighbours half as many.
const PORTION: usize = 64;
const AHEAD: usize = 8;

/// The threads of a world, and what they have planned.
#[derive(Debug)]
pub(super) struct Crew<const D: usize> {
    pool: Option<Arc<rayon::ThreadPool>>,
    /// Meetings that are due, in the order of their times; what each does, if the lean way goes there.
    due: Vec<Entry>,
    plans: Vec<Option<Plan<D>>>,
    at: usize,
    /// Up to this time meetings have been looked for (s).
    until: f64,
    /// A bit for each body: it, or one in its list, has changed since the plans were made.
    marks: Vec<u64>,
    /// Worlds of so many bodies plan ahead, a meeting for each `share` of them.
    from: usize,
    share: usize,
    /// Plans that were carried out.
    carried: u64,
}

impl<const D: usize> Default for Crew<D> {
    fn default() -> Self {
        Self {
            pool: None,
            due: Vec::new(),
            plans: Vec::new(),
            at: 0,
            until: f64::NEG_INFINITY,
            marks: Vec::new(),
            from: FROM,
            share: SHARE,
            carried: 0,
        }
    }
}

impl<const D: usize> Crew<D> {
    /// Forgets all plans.
    pub fn rest(&mut self) {
        self.due.clear();
        self.plans.clear();
        self.at = 0;
        self.until = f64::NEG_INFINITY;
    }

    /// True while there are plans.
    #[inline(always)]
    pub fn is_busy(&self) -> bool {
        self.at < self.due.len()
    }

    /// The memory that the plans hold (bytes).
    pub fn bytes(&self) -> usize {
        use super::memory::held;
        held(&self.due) + held(&self.plans) + held(&self.marks)
    }

    #[inline(always)]
    fn is_marked(&self, i: usize) -> bool {
        self.marks[i / 64] >> (i % 64) & 1 != 0
    }

    #[inline(always)]
    fn mark(&mut self, i: usize) {
        if let Some(word) = self.marks.get_mut(i / 64) {
            *word |= 1 << (i % 64);
        }
    }
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// Lets so many threads work on this world (1: only the caller's). Results never depend on their number: every bit is the same.
    ///
    /// With two threads no gain was measured so far (100,000 bodies, `guide/speed.md`). Where the system gives no threads, the world goes
    /// on with the caller's.
    pub fn set_threads(&mut self, threads: usize) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        self.crew.pool = if threads > 1 { pool.build().ok().map(Arc::new) } else { None };
        self.crew.rest();
    }

    /// The events up to these limits, on one of the threads: what it hands to the others and they do not take, it does itself.
    pub(super) fn run_shared(&mut self, limits: &Limits<'_>) -> Stop {
        match self.crew.pool.clone() {
            Some(pool) => pool.install(|| self.run_events(limits)),
            None => self.run_events(limits),
        }
    }

    /// For tests: worlds of `from` bodies plan ahead, a meeting for each `share` of them.
    #[doc(hidden)]
    pub fn set_planning(&mut self, from: usize, share: usize) {
        (self.crew.from, self.crew.share) = (from, share.max(1));
    }

    /// For tests: how many plans were carried out.
    #[doc(hidden)]
    pub fn plans_carried_out(&self) -> u64 {
        self.crew.carried
    }

    /// Each element as `f` has it, by its number: shared out over the threads.
    pub(super) fn share_out<T: Send>(&self, all: &mut [T], f: impl Fn(usize, &mut T) + Sync + Send) {
        match &self.crew.pool {
            Some(pool) if all.len() >= PORTION * PORTION => pool.install(|| {
                all.par_iter_mut().enumerate().with_min_len(PORTION).for_each(|(i, one)| f(i, one));
            }),
            _ => all.iter_mut().enumerate().for_each(|(i, one)| f(i, one)),
        }
    }

    /// What each body meets first of the others, for a plain world that is being made ready; nothing if there is one thread.
    pub(super) fn first_looks(&self) -> Vec<Option<Next>> {
        if self.crew.pool.is_none() || !self.is_plain() {
            return Vec::new();
        }
        let mut looks: Vec<Option<Next>> = alloc::vec![None; self.store.bodies.len()];
        self.share_out(&mut looks, |i, look| {
            if self.store.bodies.alive[i] && (self.store.uniform || self.nulls[i].is_none()) {
                *look = self.lean_look(i, None, super::sight::NEVER);
            }
        });
        looks
    }

    /// True if meetings should be planned before the event at this time.
    #[inline(always)]
    pub(super) fn plans_run_out(&self, time: f64) -> bool {
        self.crew.pool.is_some() && time > self.crew.until && self.lists.on && self.store.bodies.len() >= self.crew.from
    }

    /// Plans the next meetings of balls, up to this time, and no more than are wanted.
    pub(super) fn plan_ahead(&mut self, end: f64, wanted: u64) {
        let mut crew = core::mem::take(&mut self.crew);
        crew.rest();
        let many = (self.store.bodies.len() / crew.share).min(MOST).min(usize::try_from(wanted).unwrap_or(MOST));
        let (turn, next, bodies) = (&self.turn, &self.next, &self.store.bodies);
        let due = &mut crew.due;
        crew.until = self.queue.upcoming(many, many * SLOTS, end, |e| {
            if e.time <= end
                && e.partner & WALL == 0
                && turn[e.owner as usize] == e.stamp
                && bodies.stamp[e.partner as usize] == next[e.owner as usize].stamp
            {
                due.push(*e);
            }
            due.len()
        });
        if self.is_plain() && !self.store.rough() {
            due.sort_unstable();
            crew.marks.clear();
            crew.marks.resize(bodies.len() / 64 + 1, 0);
            crew.plans.resize_with(due.len(), || None);
            let (due, plans) = (&*due, &mut crew.plans);
            plans.par_chunks_mut(PORTION).zip(due.par_chunks(PORTION)).for_each(|(plans, due)| {
                for k in 0..due.len() + AHEAD {
                    if let Some(e) = due.get(k) {
                        self.fetch_pair(e.owner, e.partner);
                    }
                    if let Some(e) = (k + AHEAD / 2).checked_sub(AHEAD).and_then(|k| due.get(k)) {
                        self.fetch_neighbours(e.owner);
                        self.fetch_neighbours(e.partner);
                    }
                    if let Some(k) = k.checked_sub(AHEAD) {
                        let e = &due[k];
                        plans[k] = self.plan(e.time, e.owner as usize, e.partner as usize).map(|(plan, _)| plan);
                    }
                }
            });
        } else {
            due.clear();
        }
        self.crew = crew;
    }

    /// The plan of this meeting, if there is one and it still holds.
    #[inline]
    pub(super) fn planned(&mut self, time: f64, i: usize, j: usize) -> Option<Plan<D>> {
        while self.crew.due.get(self.crew.at).is_some_and(|e| e.time < time) {
            self.crew.at += 1;
        }
        let e = self.crew.due.get(self.crew.at)?;
        if e.time != time || e.owner as usize != i || e.partner as usize != j {
            return None;
        }
        if self.crew.is_marked(i) || self.crew.is_marked(j) {
            return None;
        }
        let plan = self.crew.plans[self.crew.at].take();
        self.crew.carried += u64::from(plan.is_some());
        plan
    }

    /// A body has another record, or another list: whatever was planned with it goes.
    #[inline(always)]
    pub(super) fn mark(&mut self, i: usize) {
        if self.crew.is_busy() {
            self.mark_around(i);
        }
    }

    fn mark_around(&mut self, i: usize) {
        self.crew.mark(i);
        for &k in self.lists.of(i) {
            self.crew.mark(k as usize);
        }
    }

    #[inline]
    fn fetch_pair(&self, i: u32, j: u32) {
        for k in [i as usize, j as usize] {
            super::sight::fetch(&self.store.bodies.record, k);
            super::sight::fetch(&self.piles, k);
            self.lists.fetch(k);
        }
    }

    #[inline]
    fn fetch_neighbours(&self, i: u32) {
        self.lists.of(i as usize).iter().for_each(|&k| super::sight::fetch(&self.store.bodies.record, k as usize));
    }
}
