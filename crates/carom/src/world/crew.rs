//! Many threads, the same bits: what is a pure function of the world as it stands is computed by several threads at once.
//!
//! Lists of neighbours and first predictions are shared out body by body, when a world is made ready. Events happen one after the
//! other, in the order of their times, on the caller's thread: planning them ahead was tried, and brought nothing (`guide/speed.md`).
use super::{Next, World};
use crate::{Rotates, Vector};
use alloc::sync::Arc;
use alloc::vec::Vec;
use rayon::prelude::*;

/// Bodies that a thread takes at a time; fewer than the square of it are not shared out.
const PORTION: usize = 64;

/// The threads of a world, if there are more than the caller's.
#[derive(Clone, Debug, Default)]
pub(super) struct Crew(Option<Arc<rayon::ThreadPool>>);

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// Lets so many threads make this world ready (1: only the caller's): they share out the lists of neighbours and what each body
    /// meets first. Events stay on the caller's thread. Results never depend on their number: every bit is the same.
    ///
    /// Where the system gives no threads, the world goes on with the caller's.
    pub fn set_threads(&mut self, threads: usize) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        self.crew = Crew(if threads > 1 { pool.build().ok().map(Arc::new) } else { None });
    }

    /// Each element as `f` has it, by its number: shared out over the threads.
    pub(super) fn share_out<T: Send>(&self, all: &mut [T], f: impl Fn(usize, &mut T) + Sync + Send) {
        match &self.crew.0 {
            Some(pool) if all.len() >= PORTION * PORTION => pool.install(|| {
                all.par_iter_mut().enumerate().with_min_len(PORTION).for_each(|(i, one)| f(i, one));
            }),
            _ => all.iter_mut().enumerate().for_each(|(i, one)| f(i, one)),
        }
    }

    /// What each body meets first of the others, for a plain world that is being made ready; nothing if there is one thread.
    pub(super) fn first_looks(&self) -> Vec<Option<Next>> {
        if self.crew.0.is_none() || !self.is_plain() {
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
}
