//! One contact after the other, by Newton's law for two bodies, until none closes.
//!
//! What many engines do. It breaks away, keeps momentum and, at e = 1, energy, but the answer depends on the order of the
//! contacts: a ball that hits two touching ones in the middle goes off to one side. Sweeps follow the order of the system's
//! contacts, which the caller chooses. The two exceptions of [`super::reflect`](mod@super::reflect) hold here too: where
//! every contact has e = 0 the answer is the plastic projection at once, and locked contacts are found and shut (the rest is
//! then resolved by GR-e, because contacts that stay shut cannot be taken one at a time).
//!
//! Source: A. P. Ivanov, *On multiple impact*, Journal of Applied Mathematics and Mechanics 59 (1995), who shows that the answer depends on
//! the order.
//!
//! # Accuracy
//! Each step is Newton's law for two bodies, exact to rounding, and so are momentum and, at e = 1, energy of the whole. The answer is that of
//! impacts a moment apart in the order of the contacts: right if that is the order in which they come, and otherwise one of many. A rack struck
//! on its axis is off its mirror image by a third of the blow's speed (`compare/results_event_driven.md`).
use super::{Outcome, Solver, System, Together, exchange::Rise, locked::LOOK_AFTER};

/// Resolves an instant contact by contact: [`Solver::resolve`] with [`Together::Sequential`] and memory of its own.
pub fn sequential(system: &mut System, restitution: impl FnMut(usize, f64) -> f64) -> Outcome {
    let mut solver = Solver::new();
    solver.resolve(Together::Sequential, system, restitution);
    solver.outcome
}

impl Solver {
    pub(super) fn sequential(&mut self, system: &mut System, e: &mut impl FnMut(usize, f64) -> f64) {
        let opposed = self.opposed(system);
        for sweep in 0..self.cap() {
            if opposed && sweep == 0 || !opposed && sweep == LOOK_AFTER {
                if !self.lock(system) {
                    return;
                }
                if !self.locked.is_empty() {
                    return self.reflect(system, e);
                }
            }
            self.scale = self.scale.max(system.scale());
            let mut closed = false;
            for at in 0..self.all.len() {
                let i = self.all[at];
                if self.closes(system, i) {
                    closed = true;
                    self.rows.clear();
                    self.rows.push(i);
                    self.restitution.clear();
                    self.restitution.push(e(i as usize, -system.opening(i as usize)));
                    self.exchange(system, Rise::Shorten);
                }
            }
            if !closed {
                return;
            }
            self.outcome.iterations += 1;
        }
        self.outcome.capped = true;
        self.plastic(system);
    }
}
