//! The projection of a heap for a slice: eight digits, in few factors.
//!
//! The next slice starts from this one's gaps, so that its errors do not add up, and momentum and energy are booked from the
//! impulses that were used: less is asked than of an instant (`project.rs`). The method is the same, with two differences.
//!
//! * delta starts where the contacts still give way ([`DELTA_START`]) and follows the solution down. A semismooth Newton step
//!   then changes a few contacts at a time, where a small delta from the outset sends it from corner to corner.
//! * The factor is that of the bodies (`frame.rs`).
//!
//! Where more contacts touch than there are degrees of freedom (crystals, of which poured heaps of equal balls are full), the
//! active set is not unique and the steps lose their way. Then the interior point method takes over: always as many factors,
//! about twenty, and what it finds is feasible. It ends with contacts held apart by a little, not with an overlap.
use super::project::{DENSE, GOAL, Projector, SLOW};

/// The first delta, the part of it that the next one is, and the last one, at which lambda still has ten digits.
const DELTA_START: f64 = 1e-2;
const DELTA_STEP: f64 = 1e-2;
const DELTA_END: f64 = 1e-6;
/// Newton steps for the first delta, and for the others: if they do not settle, the interior point method takes over. Those
/// that settle do so in about five and three.
const FIRST_STEPS: u32 = 8;
const NEXT_STEPS: u32 = 4;
/// At most so many proximal steps.
const PROXIMAL_STEPS: u32 = 12;
/// The interior point method starts where l s of every contact is the square of this part of the largest beta: nearer to the
/// last slice's impulses it takes longer, because it has to leave the boundary first.
const INSIDE: f64 = 0.5;
/// And ends when l s is the square of this times the tolerance, relative to the largest beta: for a tolerance of 1e-8 a contact
/// that pushes with the slice's typical impulse is 1e-10 of the speed off.
const CENTRED: f64 = 1e3;
/// The largest beta counts as at least so many tolerances.
const LEAST: f64 = 1e4;

impl Projector {
    /// True if this method serves: many contacts, and fewer digits.
    pub(super) fn is_loose(&self) -> bool {
        self.tolerance > GOAL && self.columns.len() > DENSE
    }

    /// Finds lambda from the first `active` contacts and `center`.
    pub(super) fn settle(&mut self, largest: f64) {
        let (mut delta, mut best, mut last) = (DELTA_START, f64::INFINITY, f64::INFINITY);
        self.best.clone_from(&self.center);
        self.start.clone_from(&self.center);
        for step in 0..PROXIMAL_STEPS {
            if !self.descend(delta, largest, if step == 0 { FIRST_STEPS } else { NEXT_STEPS }) {
                self.start_inside(largest);
                return;
            }
            for i in 0..self.lambda.len() {
                self.step[i] = self.lambda[i] - self.center[i];
            }
            self.columns.combine(&self.lambda, &mut self.x);
            let error = self.error();
            if error < best {
                best = error;
                self.best.clone_from(&self.lambda);
            }
            self.center.copy_from_slice(&self.lambda);
            if error <= 1.0 {
                break;
            }
            if error > SLOW * last && delta <= DELTA_END {
                self.infeasible = self.driven && self.no_room(largest);
                break;
            }
            last = error;
            delta = (delta * DELTA_STEP).max(DELTA_END);
        }
        self.lambda.clone_from(&self.best);
        self.columns.combine(&self.lambda, &mut self.x);
        self.residual = best * self.tolerance;
    }

    /// One proximal step of at most `most` Newton steps. True if it settled.
    fn descend(&mut self, delta: f64, largest: f64, most: u32) -> bool {
        let mut settled = false;
        for step in 0..most {
            self.newton_target(delta);
            core::mem::swap(&mut self.x, &mut self.target);
            core::mem::swap(&mut self.pull, &mut self.step);
            settled = self.pulls(delta, largest);
            if settled {
                break;
            }
            self.advance(delta, step != 0);
        }
        for lambda in &mut self.lambda {
            *lambda = lambda.max(0.0);
        }
        settled
    }

    /// The interior point method, from the impulses that were given.
    fn start_inside(&mut self, largest: f64) {
        let least = self.goal.iter().fold(0.0, |a: f64, goal| a.max(*goal)) * LEAST;
        let size = largest.max(least);
        let centred = CENTRED * self.tolerance;
        let start = (&self.start[..], INSIDE, centred * centred);
        self.factors += self.interior.solve(&self.columns, &self.beta, size, &mut self.frame, Some(start));
        self.interior.impulses(&mut self.lambda);
        self.columns.combine(&self.lambda, &mut self.x);
        self.residual = self.error() * self.tolerance;
        self.infeasible = self.driven && !(self.residual < 1.0);
    }
}
