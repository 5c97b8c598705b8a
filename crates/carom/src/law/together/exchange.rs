//! One exchange: a set of contacts is solved at once and the impulses are handed over.
//!
//! ```text
//! 0 <= lambda _|_ u' + E u >= 0 on the set,      u' = u + Q lambda,      v' = v + M^-1 N lambda
//! ```
//!
//! which is the projection with the bounds b = -E u. If all e are equal, lambda = (1 + e) lambda_0 with lambda_0 the plastic
//! one (e = 0), and the length of the step is chosen by energy, s = -(1 + e) (P.v)/(P.M^-1 P) along P = N lambda_0: then
//! exactly (1 - e^2) (P.v)^2 / (2 P.M^-1 P) is lost, nothing at e = 1, even where lambda_0 is good to fewer digits.
use super::{Solver, System, project::DENSE};

/// -(P.v)/(P.M^-1 P) is 1 where the projection is exact. Where impulses are left that act on nothing but rounding, it is
/// anything; energy would allow it, rounding would not.
const LONGEST: f64 = 2.0;
/// What rounding may gain in an exchange, relative to the energies before and after.
const GAIN: f64 = 1e-13;
/// How good a rough exchange is, relative to the fastest approach, and how many sweeps it may take.
const ROUGH: f64 = 1e-3;
const ROUGH_SWEEPS: u32 = 48;
/// A plastic projection is repeated at most so often.
const PASSES: u32 = 4;

impl Solver {
    /// Solves the contacts `rows` (with e in `restitution`) and the locked ones, which stay shut, and applies the impulses.
    /// False if that cannot be done without a gain of energy, or at all: then nothing was changed.
    pub(super) fn exchange(&mut self, system: &mut System, rises: Rise) -> bool {
        let asked = self.rows.len();
        self.before.clear();
        self.impulse.clear();
        let rows = self.rows.iter().chain(&self.locked);
        self.before.extend(rows.map(|&i| system.opening(i as usize)));
        if asked == 1 && self.locked.is_empty() {
            // Newton's law, without a detour.
            let i = self.rows[0] as usize;
            self.impulse.push((1.0 + self.restitution[0]) * (-self.before[0]) / system.yielding(i));
            return self.hand_over(system);
        }
        self.rows.extend_from_slice(&self.locked);
        let first = self.restitution[0];
        let equal = self.restitution.iter().all(|e| *e == first);
        let (rows, e) = (&self.rows, &self.restitution);
        if self.rough && rows.len() > DENSE {
            let fastest = self.before.iter().fold(0.0, |a: f64, u| a.max(-u));
            let ratio = |r: usize| if equal { 0.0 } else { self.restitution.get(r).copied().unwrap_or(0.0) };
            self.bounds.clear();
            self.bounds.resize(system.contacts(), 0.0);
            for r in 0..rows.len() {
                self.bounds[rows[r] as usize] = -ratio(r) * self.before[r];
            }
            let bounds = &self.bounds;
            self.projector.relax(system, rows, |i| bounds[i], None, ROUGH * fastest, ROUGH_SWEEPS);
        } else if equal {
            self.projector.solve(system, rows, |_| 0.0, None, self.scale);
        } else {
            self.bounds.clear();
            self.bounds.resize(system.contacts(), 0.0);
            for r in 0..asked {
                self.bounds[rows[r] as usize] = -e[r] * self.before[r];
            }
            let bounds = &self.bounds;
            self.projector.solve(system, rows, |i| bounds[i], None, self.scale);
        }
        if self.projector.infeasible {
            self.outcome.crushed |= self.driven;
            return false;
        }
        self.impulse.extend((0..rows.len()).map(|r| self.projector.impulse(r)));
        let work: f64 = self.impulse.iter().zip(&self.before).map(|(l, u)| l * u).sum(); // P.v
        let square = self.projector.square(); // P.M^-1 P
        let length = if equal && first > 0.0 {
            (1.0 + first) * (-work / square).min(LONGEST)
        } else if !(work + 0.5 * square > 0.0) {
            1.0
        } else if let Rise::Refuse = rises
            && work + 0.5 * square > super::VIOLATION * square
        {
            return false;
        } else {
            -2.0 * work / square // as far as energy allows
        };
        if !(length > 0.0) || !length.is_finite() {
            return false;
        }
        for lambda in &mut self.impulse {
            *lambda *= length;
        }
        self.hand_over(system)
    }

    /// The plastic projection of all contacts: how an instant ends that would not end otherwise.
    pub(super) fn plastic(&mut self, system: &mut System) {
        self.rows.clear();
        self.rows.extend_from_slice(&self.all);
        self.shut(system);
    }

    /// The plastic projection of the contacts `rows`. Between heavy bodies a light one gets the difference of large impulses,
    /// and with it their rounding: what then still closes is projected again.
    pub(super) fn shut(&mut self, system: &mut System) {
        self.restitution.clear();
        self.restitution.resize(self.rows.len(), 0.0);
        for _ in 0..PASSES {
            self.before.clear();
            self.before.extend(self.rows.iter().map(|&i| system.opening(i as usize)));
            self.projector.solve(system, &self.rows, |_| 0.0, None, self.scale);
            self.outcome.crushed |= self.projector.infeasible && self.driven;
            self.impulse.clear();
            self.impulse.extend((0..self.rows.len()).map(|r| self.projector.impulse(r)));
            if !self.hand_over(system) || self.outcome.crushed || !self.rows.iter().any(|&i| self.closes(system, i)) {
                break;
            }
        }
    }

    /// Applies `impulse` at `rows` and keeps the books. If rounding made energy of it (impulses that are 1e13 times what they
    /// do), everything is as before, and the answer false.
    fn hand_over(&mut self, system: &mut System) -> bool {
        self.saved.clear();
        self.saved.extend_from_slice(system.velocities());
        for (&i, &lambda) in self.rows.iter().zip(&self.impulse) {
            if lambda > 0.0 {
                system.push(i as usize, lambda);
            }
        }
        // What the moving bodies gained, velocity by velocity, and what of it came from driven ones.
        let (mut size, mut gained) = (0.0, 0.0);
        for ((&v, &old), &w) in system.velocities().iter().zip(&self.saved).zip(system.inverse_masses()) {
            if w > 0.0 && v != old {
                size += 0.5 * (v * v + old * old) / w;
                gained += 0.5 * (v + old) * (v - old) / w;
            }
        }
        for (&i, &lambda) in self.rows.iter().zip(&self.impulse) {
            if lambda > 0.0 {
                gained += lambda * system.fixed_opening(i as usize);
            }
        }
        if !(gained <= GAIN * size) {
            system.velocities_mut().copy_from_slice(&self.saved);
            return false;
        }
        self.outcome.lost -= gained;
        for (r, &i) in self.rows.iter().enumerate() {
            let (i, lambda) = (i as usize, self.impulse[r]);
            if !(lambda > 0.0) {
                continue;
            }
            self.outcome.lambda[i] += lambda;
            self.outcome.losses[i] -= 0.5 * lambda * (self.before[r] + system.opening(i));
            let first = &mut self.outcome.first_restitution[i];
            if first.is_nan() {
                // Locked contacts follow those that were asked, and are plastic.
                *first = self.restitution.get(r).copied().unwrap_or(0.0);
            }
        }
        true
    }
}

/// What to do if an exchange would gain energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rise {
    /// Go only as far as energy allows.
    Shorten,
    /// Leave it.
    Refuse,
}
