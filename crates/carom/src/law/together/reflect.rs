//! GR-e: the contacts that close reflect together, and again those that close then.
//!
//! ```text
//! repeat  A = { i : u_i < 0 };   0 <= lambda _|_ u' + E u >= 0 on A,  E = diag(e_i(|u_i|));   v += M^-1 N_A lambda
//! until   A is empty
//! ```
//!
//! At e = 1 this is the generalised reflection GR of Smith et al. (2012), for one contact Newton's law. That every contact
//! may have its own e, and another one at each iteration, is this project's rule: complementarity gives lambda_i u_i' =
//! -e_i lambda_i u_i, so dE = sum (1 - e_i) lambda_i u_i / 2 <= 0 because every u_i < 0 in A; and some multiple of -v
//! satisfies the bounds, so that there always is an answer. The proof stands; a validation by experiment or in print does
//! not. It would fail if contacts that open were in A.
//!
//! If **every contact has e = 0** the answer is the plastic projection at once: repeating tends there slowly (a cradle of
//! five takes 137 iterations) and can miss it (a rack of fifteen by 5e-3). "Every contact has e = 0" is asked at its own
//! approach speed (0 if it opens) and at the fastest of the set.
//!
//! Source: B. Smith, D. Kaufman, E. Vouga, R. Tamstorf, E. Grinspun, *Reflections on simultaneous impact*, ACM Transactions on Graphics 31
//! (2012).
//!
//! # Accuracy
//! Symmetric to rounding, but not continuous: in a wedge of 60 degrees a ball 10 degrees off the bisector comes straight
//! back, whereas two impacts a moment apart send it elsewhere. Against Hertz contacts velocities are off by 5 to 10 % of the
//! incoming speed. The number of iterations grows with the graph distance that the blow travels (rows of a rack plus one)
//! and with mass ratios; it is capped ([`super::CAP`]).
use super::{Outcome, Solver, System, Together, exchange::Rise, locked::LOOK_AFTER};

/// Resolves an instant by GR-e: [`Solver::resolve`] with [`Together::Reflect`] and memory of its own.
pub fn reflect(system: &mut System, restitution: impl FnMut(usize, f64) -> f64) -> Outcome {
    let mut solver = Solver::new();
    solver.resolve(Together::Reflect, system, restitution);
    solver.outcome
}

impl Solver {
    pub(super) fn reflect(&mut self, system: &mut System, e: &mut impl FnMut(usize, f64) -> f64) {
        let cap = self.cap();
        if !self.rebounds(system, cap, e) {
            self.outcome.capped = true;
            self.plastic(system);
        }
    }

    /// At most `most` iterations; false if contacts close still.
    pub(super) fn rebounds(&mut self, system: &mut System, most: u32, e: &mut impl FnMut(usize, f64) -> f64) -> bool {
        let mut looked = self.opposed(system);
        if looked && !self.lock(system) {
            return true;
        }
        for iteration in 0..most {
            if iteration == LOOK_AFTER && !looked {
                looked = true;
                if !self.lock(system) {
                    return true;
                }
            }
            self.scale = self.scale.max(system.scale());
            self.rows.clear();
            self.restitution.clear();
            for at in 0..self.all.len() {
                let i = self.all[at];
                if self.closes(system, i) && self.locked.binary_search(&i).is_err() {
                    self.rows.push(i);
                    self.restitution.push(e(i as usize, -system.opening(i as usize)));
                }
            }
            if self.rows.is_empty() {
                if !self.shut_locked(system) {
                    return true;
                }
                continue;
            }
            self.outcome.iterations += 1;
            if !self.exchange(system, Rise::Shorten) {
                break;
            }
        }
        false
    }
}
