//! Newton's coefficient at all contacts at once.
//!
//! ```text
//! 0 <= lambda _|_ u' + E u >= 0 on all contacts
//! ```
//!
//! which is also what sequential impulses and Moreau-Jean stepping converge to. It is symmetric, keeps momentum and, at
//! e = 1, energy, but contacts do not break away: the cradle of five moves off as (-0.6, 0.4, 0.4, 0.4, 0.4). For comparison
//! with other engines; [`super::reflect`](mod@super::reflect) is the default.
//!
//! * A contact that opened may close afterwards (u' >= -e u allows it): the step is repeated until none closes.
//! * If e differs between contacts, dE = sum (1 - e_i) lambda_i u_i / 2 has no sign where contacts that open take part, and
//!   there need not be an answer. An instant in which energy would rise, or which has no answer, is resolved by GR-e from the
//!   start instead, and marked as `capped`.
//!
//! # Accuracy
//! u' = -e u to rounding at every contact that pushes, u' >= -e u at the others; momentum to rounding; at e = 1 energy too. As a model of
//! bodies that touch it is poor: elastic (Hertz) contact sends the last ball of a cradle away at 0.989 of the speed, where this says 0.4.
//!
//! Sources: J. J. Moreau, *Unilateral contact and dry friction in finite freedom dynamics* (1988), for the rule; R. W. Cottle, J.-S. Pang,
//! R. E. Stone, *The Linear Complementarity Problem* (1992), for the problem.
use super::{Outcome, Solver, System, Together, exchange::Rise};

/// Locked contacts are looked for after so many steps: where nothing is locked, one or two are enough.
const LOOK_AFTER: u32 = 4;

/// Resolves an instant by the LCP: [`Solver::resolve`] with [`Together::Lcp`] and memory of its own.
pub fn lcp(system: &mut System, restitution: impl FnMut(usize, f64) -> f64) -> Outcome {
    let mut solver = Solver::new();
    solver.resolve(Together::Lcp, system, restitution);
    solver.outcome
}

impl Solver {
    pub(super) fn lcp(&mut self, system: &mut System, e: &mut impl FnMut(usize, f64) -> f64) {
        let mut looked = self.opposed(system);
        if looked && !self.lock(system) {
            return;
        }
        for iteration in 0..self.cap() {
            if iteration == LOOK_AFTER && !looked {
                looked = true;
                if !self.lock(system) {
                    return;
                }
            }
            self.scale = self.scale.max(system.scale());
            if !self.all.iter().any(|&i| self.closes(system, i) && self.locked.binary_search(&i).is_err()) {
                if !self.shut_locked(system) {
                    return;
                }
                continue;
            }
            self.rows.clear();
            self.restitution.clear();
            for at in 0..self.all.len() {
                let i = self.all[at];
                if self.locked.binary_search(&i).is_err() {
                    self.rows.push(i);
                    self.restitution.push(e(i as usize, (-system.opening(i as usize)).max(0.0)));
                }
            }
            self.outcome.iterations += 1;
            if !self.exchange(system, Rise::Refuse) {
                self.start_over(system);
                self.outcome.crushed = false; // that is for GR-e to say
                self.reflect(system, e);
                self.outcome.capped = true;
                return;
            }
        }
        self.outcome.capped = true;
        self.plastic(system);
    }
}
