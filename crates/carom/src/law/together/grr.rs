//! GR and GRR: generalised reflections as their authors wrote them, with one coefficient for all contacts.
//!
//! ```text
//! GRR(v, c) = (1 - c) Proj(v; all contacts) + c GR(v)
//! ```
//!
//! It inherits from both: nothing closes (the cone is convex), energy does not rise (so is its ball), momentum and symmetry
//! are kept, one contact obeys Newton's law with e = c. It differs from GR-e at 0 < c < 1: for the cradle of five and c = 0.9
//! (.02, .02, .02, .02, .92) against GR-e's (.0435, .0454, .0473, .0493, .8145). Source: Smith et al. (2012).
//!
//! # Accuracy
//! That of [`super::reflect`](mod@super::reflect) and of the plastic projection, of which it is the mean: nothing is added but one rounding.
use super::{Outcome, Solver, System, Together};

/// The generalised reflection: every contact elastic.
pub fn gr(system: &mut System) -> Outcome {
    super::reflect(system, |_, _| 1.0)
}

/// The generalised reflection with restitution `c` in [0, 1] for all contacts. The impulses are mixed as the velocities are;
/// the losses are those of the summed impulses between the two ends of the instant, of which some may be negative.
pub fn grr(system: &mut System, c: f64) -> Outcome {
    let c = if c > 0.0 { c.min(1.0) } else { 0.0 };
    if c == 0.0 || c == 1.0 {
        return super::reflect(system, |_, _| c);
    }
    let (mut reflected, mut solver) = (system.clone(), Solver::new());
    let elastic = solver.resolve(Together::Reflect, &mut reflected, |_, _| 1.0).clone();
    let mut outcome = elastic.clone();
    let mut stuck = system.clone();
    let plastic = solver.resolve(Together::Reflect, &mut stuck, |_, _| 0.0);
    outcome.lost = 0.0;
    outcome.crushed |= plastic.crushed;
    for i in 0..system.contacts() {
        outcome.lambda[i] = (1.0 - c) * plastic.lambda[i] + c * elastic.lambda[i];
        outcome.losses[i] = system.opening(i);
        if outcome.lambda[i] > 0.0 {
            outcome.first_restitution[i] = c;
        }
    }
    for i in 0..system.contacts() {
        if outcome.lambda[i] > 0.0 {
            system.push(i, outcome.lambda[i]);
        }
    }
    for i in 0..system.contacts() {
        outcome.losses[i] = -0.5 * outcome.lambda[i] * (outcome.losses[i] + system.opening(i));
        outcome.lost += outcome.losses[i];
    }
    outcome
}
