//! Several contacts at one instant: what Newton's coefficient alone does not decide.
//!
//! Two bodies part by momentum and restitution. Where three meet at once the laws of motion leave a choice, and this module
//! is that choice: pure functions from a [`System`] (velocities, inverse masses, contacts) to impulses.
//!
//! ```text
//!                        breaks away   keeps symmetry   energy at e = 1   momentum   lambda >= 0
//! reflect     (GR-e)         yes            yes              kept            yes         yes
//! lcp                        no             yes              kept            yes         yes
//! sequential                 yes            no               kept            yes         yes
//! ```
//!
//! * [`reflect`](mod@reflect): the contacts that close reflect together, and again those that close then. Newton's cradle
//!   sends the last ball.
//! * [`lcp`](mod@lcp): Newton's coefficient at all contacts at once. The cradle moves off in one piece.
//! * [`sequential`](mod@sequential): one contact after the other. The answer depends on their order.
//! * [`grr`](mod@grr): reflection and plastic projection mixed, for one coefficient; an operator and an oracle.
//!
//! All of them stand on one primitive, [`project`](mod@project). Whatever the operator, lambda >= 0, momentum is kept to
//! rounding (the same bits act on both bodies), kinetic energy relative to the walls does not rise, every loop is bounded,
//! and nothing closes afterwards unless the outcome says so. Numbers that are not finite leave everything as it was.
//!
//! Sources: B. Smith, D. Kaufman, E. Vouga, R. Tamstorf, E. Grinspun, *Reflections on Simultaneous Impact*, ACM
//! Transactions on Graphics 31 (2012); E. Vouga et al., *All's Well That Ends Well*, ACM Transactions on Graphics 36 (2017).
use alloc::vec::Vec;

mod columns;
mod dense;
mod exchange;
mod frame;
pub mod grr;
mod interior;
pub mod lcp;
pub mod locked;
mod loose;
pub mod project;
pub mod reflect;
mod relax;
pub mod rub;
pub mod sequential;
mod sparse;
pub mod system;

pub use grr::{gr, grr};
pub use lcp::lcp;
pub use project::{Projection, TOLERANCE};
pub use reflect::reflect;
pub use sequential::sequential;
pub use system::System;

/// A contact closes if u < -VIOLATION times the scale of the velocities: about 450 eps, above what the projection
/// leaves over and the rounding of u itself. The scale never falls below that at entry: relative to the current velocities
/// the loop would go on for ever as they tend to zero. It rises where light bodies become fast.
pub const VIOLATION: f64 = 1e-13;
/// Iterations of an instant are limited to this and [`CAP_PER_CONTACT`] for each contact. Their number has no bound in the
/// mass ratio (Galperin's billiard: 31,415 impacts for 1e8); of random dense systems 99 in 100 need fewer than 123.
pub const CAP: u32 = 256;
/// See [`CAP`].
pub const CAP_PER_CONTACT: u32 = 8;

/// How contacts at one instant are resolved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Together {
    /// Contacts that close reflect together, repeatedly: GR-e.
    #[default]
    Reflect,
    /// Newton's coefficient at all contacts at once.
    Lcp,
    /// One contact after the other, in the order given.
    Sequential,
}

crate::codec::codec!(enum Together: Together::ALL);

impl Together {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Reflect, Self::Lcp, Self::Sequential];

    /// The name in scene files: "reflect", "lcp" or "sequential".
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Reflect => "reflect",
            Self::Lcp => "lcp",
            Self::Sequential => "sequential",
        }
    }
}

/// What an instant did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// How many times a set of contacts was solved (for [`Together::Sequential`]: sweeps that found a contact to close).
    pub iterations: u32,
    /// True if the limit of iterations was reached and a plastic projection ended the instant, or if the operator could not
    /// be carried out as it stands (see there), or if the input was not finite (then nothing was changed).
    pub capped: bool,
    /// True if driven bodies leave no room: no velocities open every contact. Those that fall short by the least remain.
    pub crushed: bool,
    /// How many contacts are locked: bodies pinned from opposite sides, that lost their motion along these normals. Not
    /// counted as capped.
    pub locked: u32,
    /// The impulse of each contact (N s), summed over the iterations, >= 0. Where contacts depend on each other, each
    /// iteration takes those of [`project`](mod@project), which do not depend on the order of the contacts.
    pub lambda: Vec<f64>,
    /// The kinetic energy that each contact took (J): -sum lambda (u + u') / 2. Their sum is the instant's, but for rounding.
    pub losses: Vec<f64>,
    /// The kinetic energy that the instant took (J), relative to walls and whatever else is driven.
    pub lost: f64,
    /// The coefficient of restitution that each contact used first; NaN for contacts that took no part.
    pub first_restitution: Vec<f64>,
}

impl Outcome {
    fn clear(&mut self, contacts: usize) {
        (self.iterations, self.capped, self.crushed, self.locked) = (0, false, false, 0);
        self.forget(contacts);
    }

    /// Forgets the impulses, not the iterations.
    fn forget(&mut self, contacts: usize) {
        self.lost = 0.0;
        for (list, value) in [(&mut self.lambda, 0.0), (&mut self.losses, 0.0), (&mut self.first_restitution, f64::NAN)]
        {
            list.clear();
            list.resize(contacts, value);
        }
    }
}

/// The operators with their memory: made once, used for every instant.
#[derive(Clone, Debug, Default)]
pub struct Solver {
    projector: project::Projector,
    outcome: Outcome,
    projection: Projection,
    /// The contacts that can be changed, those in play, and the locked ones.
    all: Vec<u32>,
    rows: Vec<u32>,
    locked: Vec<u32>,
    /// For each of `rows`: e, u before, lambda.
    restitution: Vec<f64>,
    before: Vec<f64>,
    impulse: Vec<f64>,
    /// For each contact of the system: the bound of an exchange with mixed e.
    bounds: Vec<f64>,
    /// The velocities at entry, and before an exchange.
    entry: Vec<f64>,
    saved: Vec<f64>,
    /// The largest scale that the velocities had so far (m/s).
    scale: f64,
    /// True if something drives into a contact, so that there may be no room. Otherwise bodies at rest are always a way out.
    driven: bool,
    /// Contacts that close slower than this (m/s) are left alone, and large sets are solved roughly: [`Solver::rebound`].
    least: f64,
    rough: bool,
}

impl Solver {
    /// An empty one.
    pub fn new() -> Self {
        Self::default()
    }

    /// Resolves the instant. `restitution(contact, approach)` says e in [0, 1] for a contact that closes at `approach`
    /// (m/s, >= 0); it is asked afresh at each iteration, and beforehand to see whether every contact is plastic (see
    /// [`reflect`](mod@reflect)). What lies outside [0, 1] is clamped, NaN is 0.
    pub fn resolve(
        &mut self,
        how: Together,
        system: &mut System,
        mut restitution: impl FnMut(usize, f64) -> f64,
    ) -> &Outcome {
        let mut e = |i: usize, approach: f64| {
            let e = restitution(i, approach);
            if e > 0.0 { e.min(1.0) } else { 0.0 } // NaN is plastic
        };
        if self.enter(system) {
            if self.every_contact_is_plastic(system, &mut e) {
                self.outcome.iterations = 1;
                self.plastic(system);
            } else {
                match how {
                    Together::Reflect => self.reflect(system, &mut e),
                    Together::Lcp => self.lcp(system, &mut e),
                    Together::Sequential => self.sequential(system, &mut e),
                }
            }
        }
        &self.outcome
    }

    /// The first iterations of [`reflect`](mod@reflect), `most` at most, of the contacts that close faster than `least` (m/s). What closes
    /// then is plastic. In sets of more than 48 contacts all this is solved to about a thousandth only: a projection follows.
    /// Dissipative all the same (THEORY 3.4, the lemma, and the step by energy; see `exchange.rs`). `capped` stays false: it is what is
    /// asked for.
    pub fn rebound(
        &mut self,
        most: u32,
        least: f64,
        system: &mut System,
        mut restitution: impl FnMut(usize, f64) -> f64,
    ) -> &Outcome {
        let mut e = |i: usize, approach: f64| {
            let e = restitution(i, approach);
            if e > 0.0 { e.min(1.0) } else { 0.0 }
        };
        if self.enter(system) {
            (self.least, self.rough) = (least, true);
            if !self.rebounds(system, most, &mut e) {
                // What is left closes without bouncing: exactly, or as well as a rough exchange can.
                self.locked.clear();
                if self.all.len() > project::DENSE {
                    self.rows.clear();
                    self.rows.extend_from_slice(&self.all);
                    self.restitution.clear();
                    self.restitution.resize(self.rows.len(), 0.0);
                    self.exchange(system, exchange::Rise::Shorten);
                } else {
                    self.least = 0.0;
                    self.plastic(system);
                }
            }
            (self.least, self.rough) = (0.0, false);
        }
        &self.outcome
    }

    /// Projects the velocities onto { u_i >= bounds_i for all i } (m/s; 0 for all if `bounds` is empty) and applies the
    /// impulses. `warm` are impulses to start from (N s), usually the last `lambda` of nearly the same contacts; empty if
    /// there are none. Where lambda is not unique it stays near `warm`.
    ///
    /// If the input is not finite or the lengths do not fit, nothing is changed and `converged` is false.
    pub fn project(&mut self, system: &mut System, bounds: &[f64], warm: &[f64]) -> &Projection {
        self.project_to(system, bounds, warm, 0.0)
    }

    /// The same, where an error of `tolerance` will do, relative to the scale of the velocities: [`TOLERANCE`] or less is
    /// [`Solver::project`], and so are up to 48 contacts; 1e-8 is for slices. More contacts are solved much quicker so, but lambda
    /// may depend on their order where it is not unique, and where more of them touch than there are degrees of freedom,
    /// those that push may open by up to 1e-5 of the largest approach (`converged` is false then). None closes by more.
    pub fn project_to(&mut self, system: &mut System, bounds: &[f64], warm: &[f64], tolerance: f64) -> &Projection {
        if !self.begin(system, bounds, warm) {
            return &self.projection;
        }
        let projection = &mut self.projection;
        let m = system.contacts();
        let bound = |i: usize| if bounds.is_empty() { 0.0 } else { bounds[i] };
        let scale = (0..m).fold(system.scale(), |a, i| a.max(bound(i)));
        let warm = (!warm.is_empty()).then_some(warm);
        let asked = if tolerance > TOLERANCE && self.rows.len() > project::DENSE { tolerance } else { 0.0 };
        self.projector.solve_to(system, &self.rows, bound, warm, scale, asked);
        let mut changed = scale;
        for (r, &i) in self.rows.iter().enumerate() {
            let lambda = self.projector.impulse(r);
            if lambda > 0.0 {
                changed = changed.max(system.yielding(i as usize) * lambda);
                projection.lambda[i as usize] = lambda;
                system.push(i as usize, lambda);
            }
        }
        projection.residual = if changed > 0.0 { self.projector.residual * (scale / changed) } else { 0.0 };
        projection.infeasible = self.projector.infeasible;
        projection.converged = projection.residual <= TOLERANCE.max(asked) && !projection.infeasible;
        projection.factors = self.projector.factors;
        projection
    }

    /// The same where an error of `tolerance` (m/s) will do, by sweeps that need no factor (`relax.rs`), `most` of them at most. More is
    /// not promised: the answer is what the sweeps have come to, and `residual` says how good it is (m/s).
    pub fn relax(
        &mut self,
        system: &mut System,
        bounds: &[f64],
        warm: &[f64],
        tolerance: f64,
        most: u32,
    ) -> &Projection {
        if !self.begin(system, bounds, warm) {
            return &self.projection;
        }
        let projection = &mut self.projection;
        spread(&mut self.rows);
        self.projector.relax(
            system,
            &self.rows,
            |i| if bounds.is_empty() { 0.0 } else { bounds[i] },
            (!warm.is_empty()).then_some(warm),
            tolerance,
            most,
        );
        for (r, &i) in self.rows.iter().enumerate() {
            let lambda = self.projector.impulse(r);
            if lambda > 0.0 {
                projection.lambda[i as usize] = lambda;
                system.push(i as usize, lambda);
            }
        }
        projection.residual = self.projector.residual;
        projection.converged = projection.residual <= tolerance;
        projection.factors = self.projector.factors;
        projection
    }

    /// Prepares a projection, with the contacts that can be changed in `rows`; false if the input is not finite or does not fit.
    fn begin(&mut self, system: &System, bounds: &[f64], warm: &[f64]) -> bool {
        let m = system.contacts();
        let projection = &mut self.projection;
        projection.lambda.clear();
        projection.lambda.resize(m, 0.0);
        (projection.residual, projection.converged, projection.infeasible, projection.factors) = (0.0, false, false, 0);
        let fits = |list: &[f64]| list.is_empty() || list.len() == m;
        if !system.is_finite() || !bounds.iter().all(|b| b.is_finite()) || !fits(bounds) || !fits(warm) {
            projection.residual = f64::NAN;
            return false;
        }
        self.rows.clear();
        self.rows.extend((0..m as u32).filter(|&i| system.yields(i as usize)));
        true
    }

    /// Prepares an instant; false if there is nothing to do.
    fn enter(&mut self, system: &System) -> bool {
        let m = system.contacts();
        self.outcome.clear(m);
        self.locked.clear();
        self.all.clear();
        if !system.is_finite() {
            self.outcome.capped = true;
            return false;
        }
        self.all.extend((0..m as u32).filter(|&i| system.yields(i as usize)));
        self.scale = system.scale();
        self.driven = self.all.iter().any(|&i| system.fixed_opening(i as usize) < 0.0);
        self.entry.clear();
        self.entry.extend_from_slice(system.velocities());
        self.all.iter().any(|&i| self.closes(system, i))
    }

    fn closes(&self, system: &System, i: u32) -> bool {
        let still = VIOLATION * self.scale;
        system.opening(i as usize) < -(if self.least > still { self.least } else { still })
    }

    /// How many iterations the instant may take.
    fn cap(&self) -> u32 {
        CAP + CAP_PER_CONTACT * self.all.len() as u32
    }

    /// Back to the velocities at entry.
    fn start_over(&mut self, system: &mut System) {
        system.velocities_mut().copy_from_slice(&self.entry);
        self.outcome.forget(system.contacts());
    }

    /// True if e = 0 at every contact, at its own approach speed as well as at the fastest of the set, which it might see
    /// when others have pushed it.
    fn every_contact_is_plastic(&self, system: &System, e: &mut impl FnMut(usize, f64) -> f64) -> bool {
        let fastest = self.all.iter().fold(0.0, |a: f64, &i| a.max(-system.opening(i as usize)));
        self.all.iter().all(|&i| {
            let i = i as usize;
            e(i, (-system.opening(i)).max(0.0)) == 0.0 && e(i, fastest) == 0.0
        })
    }
}

/// Takes the rows in an order in which neighbours do not follow each other, so that a sweep need not wait for what it has just
/// written.
fn spread(rows: &mut Vec<u32>) {
    let m = rows.len();
    let common = |mut a: usize, mut b: usize| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    if let Some(stride) = (m / 3..m).find(|&s| s > 1 && common(s, m) == 1) {
        let taken = core::mem::take(rows);
        rows.extend((0..m).map(|k| taken[k * stride % m]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names() {
        assert_eq!(Together::default(), Together::Reflect);
        assert_eq!(Together::ALL.map(Together::as_str), ["reflect", "lcp", "sequential"]);
    }
}
