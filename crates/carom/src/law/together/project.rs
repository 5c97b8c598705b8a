//! The one primitive: the nearest velocities at which no contact closes.
//!
//! ```text
//! v' = argmin (w - v).M (w - v) / 2   s.t. N_i . w + d_i >= b_i      <=>      v' = v + M^-1 N lambda,
//!                                                              0 <= lambda _|_ N^T v' + d - b >= 0
//! ```
//!
//! v' is unique; lambda is not where contacts depend on each other (a box on four corners, a crystal). Of all impulses that
//! do it, those of least sum Q_ii lambda_i^2 come out, which treats equal contacts alike whatever their order. (With a warm
//! start, those near it; in large sets in which the active contacts are hard to find, those near the middle of all that do it,
//! which treats equal contacts alike as well.)
//!
//! # Method
//! In unit columns c_i (see `columns.rs`) the impulses solve min |C l|^2 / 2 - beta.l, l >= 0. The proximal point method
//! (Rockafellar 1976) adds delta |l - l_k|^2 / 2, which makes every subproblem strictly convex however the contacts depend on
//! each other, and moves l_k to its solution; the error falls by delta / (delta + s^2), s the least singular value that
//! matters. The subproblem is solved in its primal form, min |x|^2/2 + sum max(0, delta l_k + beta - c.x)^2 / (2 delta), by a
//! semismooth Newton method with exact line search (finite: Hintermueller, Ito & Kunisch 2002; with the line search,
//! Hermans, Themelis & Patrinos 2019): each step is one Cholesky factor of the active contacts, dense for few, sparse for
//! many. Where that does not settle soon, an interior point method (Mehrotra 1992) looks for the active contacts. Large sets of
//! which less is asked (a slice of a heap) take a shorter way: `loose.rs`.
//!
//! # Accuracy
//! An answer v with openings good to r is good to |v - v'|_M^2 <= sum r (lambda_i + lambda'_i): nearly opposite walls and very
//! unequal masses hold a body loosely. Mass ratios up to 1e4 keep 12 digits; 1e9 keeps about 9; above 1e13 between bodies
//! that touch, the contacts may not open (`converged` says so).
use alloc::vec::Vec;

use super::{System, columns::Columns, dense::Dense, frame::Frame, interior::Interior, relax::Relax, sparse::Sparse};
use crate::vector::Exact;

/// A projection is converged if no contact misses its bound by more than this, relative to the scale of the velocities.
pub const TOLERANCE: f64 = 1e-12;
/// Where it stops looking for more: about 45 eps.
pub(super) const GOAL: f64 = 1e-14;
/// The rounding of a sum of impulses, relative to the largest of them: 4 eps.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// The first delta: two or three steps reach the goal where contacts are well conditioned, and the rounding errors of lambda
/// along directions that do not act on any body stay near eps / delta = 2e-10.
const DELTA_START: f64 = 1e-6;
/// The last delta, above the rounding errors of Q. It resolves s^2 down to about 1e-13, a light body between two that are
/// 1e13 times as heavy.
const DELTA_END: f64 = 1e-13;
/// A proximal step that leaves more than this of the error asks for a smaller delta.
pub(super) const SLOW: f64 = 0.1;
/// So many of them may be slow.
const STALLS: u32 = 20;
/// At most so many proximal steps, and so many Newton steps in each.
const PROXIMAL_STEPS: u32 = 60;
const NEWTON_STEPS: u32 = 100;
/// After so many Newton steps the interior point method looks for the active contacts.
const PATIENCE: u32 = 10;
/// Up to so many contacts the factor is dense.
pub(super) const DENSE: usize = 48;
/// Without a warm start, contacts that open slower than this part of the fastest approach are tried as active.
const NEAR: f64 = 0.25;
/// If every feasible velocity change would have to be so many times larger than what is asked for, there is none.
const NO_ROOM: f64 = 1e10;

/// What a projection found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Projection {
    /// The impulse of each contact of the system (N s), all >= 0; 0 for contacts that took no part.
    pub lambda: Vec<f64>,
    /// The largest error of the answer: how far a contact falls short of its bound, or one with an impulse overshoots it,
    /// relative to the scale of the velocities: the largest of [`System::scale`], the bounds and the changes Q_ii lambda_i.
    pub residual: f64,
    /// True if the residual is at most [`TOLERANCE`].
    pub converged: bool,
    /// True if no velocities satisfy the bounds (driven bodies that leave no room). The answer then is the projection onto
    /// the bounds eased by the least amount.
    pub infeasible: bool,
    /// How many linear systems were factored.
    pub factors: u32,
}

/// The solver with its memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Projector {
    pub(super) columns: Columns,
    pub(super) beta: Vec<f64>,
    /// The error in beta's units that is good enough.
    pub(super) goal: Vec<f64>,
    /// l_k, l, and the change between them.
    pub(super) center: Vec<f64>,
    pub(super) lambda: Vec<f64>,
    pub(super) step: Vec<f64>,
    /// The l of the least error so far.
    pub(super) best: Vec<f64>,
    /// The impulses that were given.
    pub(super) start: Vec<f64>,
    /// x = C l relative to the given velocities; where a Newton step would go, and the way there.
    pub(super) x: Vec<f64>,
    pub(super) target: Vec<f64>,
    pub(super) way: Vec<f64>,
    /// delta l_k + beta - c.x at `x`.
    pub(super) pull: Vec<f64>,
    /// What rounding makes of it.
    pub(super) noise: Vec<f64>,
    pub(super) active: Vec<bool>,
    factored: Vec<bool>,
    pub(super) factored_delta: f64,
    bends: Vec<(f64, f64)>,
    /// A linear system: what is added to the diagonal, and the right-hand side, then the solution.
    shift: Vec<f64>,
    right: Vec<f64>,
    pub(super) interior: Interior,
    dense: Dense,
    sparse: Sparse,
    pub(super) frame: Frame,
    relax: Relax,
    pushed: Vec<f64>,
    ordered: bool,
    searched: bool,
    pub(super) driven: bool,
    /// The error that is good enough, relative to the scale of the velocities.
    pub(super) tolerance: f64,
    pub(super) residual: f64,
    pub(super) infeasible: bool,
    pub(super) factors: u32,
}

impl Projector {
    /// Solves for the contacts `rows` of `system` with the bounds `bound(i)`; `warm` may give impulses to start from. The
    /// impulses come out by [`Self::impulse`]; the system is not changed. `scale` is the scale of the velocities (m/s).
    pub fn solve(
        &mut self,
        system: &System,
        rows: &[u32],
        bound: impl Fn(usize) -> f64,
        warm: Option<&[f64]>,
        scale: f64,
    ) {
        self.solve_to(system, rows, bound, warm, scale, GOAL);
    }

    /// The same, good to `tolerance` of the scale if that is more than [`GOAL`].
    pub fn solve_to(
        &mut self,
        system: &System,
        rows: &[u32],
        bound: impl Fn(usize) -> f64,
        warm: Option<&[f64]>,
        scale: f64,
        tolerance: f64,
    ) {
        self.tolerance = if tolerance > GOAL { tolerance } else { GOAL };
        self.columns.load(system, rows);
        self.beta.clear();
        self.goal.clear();
        self.center.clear();
        for (r, &i) in rows.iter().enumerate() {
            let i = i as usize;
            let root = self.columns.root[r];
            self.beta.push((bound(i) - system.opening(i)) / root);
            self.goal.push(self.tolerance * scale / root);
            let start = warm.map_or(0.0, |w| w[i] * root);
            self.center.push(if start > 0.0 && start.is_finite() { start } else { 0.0 });
        }
        // Bodies at rest are the way out, unless something drives into them.
        self.driven = rows.iter().any(|&i| !(system.fixed_opening(i as usize) >= bound(i as usize)));
        self.run(warm.is_some());
    }

    /// Sweeps until no contact misses its bound by more than `tolerance` (m/s), `most` of them at most.
    pub fn relax(
        &mut self,
        system: &System,
        rows: &[u32],
        bound: impl Fn(usize) -> f64,
        warm: Option<&[f64]>,
        tolerance: f64,
        most: u32,
    ) {
        self.columns.load(system, rows);
        self.beta.clear();
        self.goal.clear();
        self.relax.l.clear();
        for (r, &i) in rows.iter().enumerate() {
            let i = i as usize;
            let root = self.columns.root[r];
            self.beta.push((bound(i) - system.opening(i)) / root);
            self.goal.push(tolerance / root);
            let start = warm.map_or(0.0, |w| w[i] * root);
            self.relax.l.push(if start > 0.0 && start.is_finite() { start } else { 0.0 });
        }
        self.infeasible = false;
        self.relax.run(system, rows, &self.columns.root, &self.beta, &self.goal, most);
        self.lambda.clone_from(&self.relax.l);
        self.columns.combine(&self.lambda, &mut self.x);
        self.residual = self.relax.error * tolerance;
        self.factors = self.relax.sweeps;
    }

    /// The impulse of the r-th of the rows (N s).
    pub fn impulse(&self, r: usize) -> f64 {
        self.lambda[r] / self.columns.root[r]
    }

    /// u of contact `i`, the r-th of the rows, as it would be with these impulses (m/s).
    pub fn opening_after(&self, system: &System, r: usize, i: usize) -> f64 {
        system.opening(i) + self.columns.dot(r, &self.x) * self.columns.root[r]
    }

    /// |x|^2 = P.M^-1 P for the impulse P (J times two).
    pub fn square(&self) -> f64 {
        self.x.iter().map(|x| x * x).sum()
    }

    /// Projects the vector q = sum of all c_i onto { c_i . w >= 0 }; the answer is left in [`Self::slack`].
    pub fn solve_sum(&mut self, system: &System, rows: &[u32]) {
        self.columns.load(system, rows);
        let m = rows.len();
        self.center.clear();
        self.center.resize(m, 1.0);
        let mut sum = core::mem::take(&mut self.target);
        self.columns.combine(&self.center, &mut sum);
        self.center.fill(0.0);
        self.beta.clear();
        self.beta.extend((0..m).map(|i| -self.columns.dot(i, &sum)));
        self.goal.clear();
        self.goal.resize(m, GOAL);
        self.tolerance = GOAL;
        self.driven = false;
        self.run(false);
        for k in 0..sum.len() {
            self.x[k] += sum[k];
        }
        self.target = sum;
    }

    /// After [`Self::solve_sum`]: the length of the projection.
    pub fn length(&self) -> f64 {
        self.x.iter().map(|x| x * x).sum::<f64>().sqrt_()
    }

    /// After [`Self::solve_sum`]: how fast the r-th of the rows opens.
    pub fn slack(&self, r: usize) -> f64 {
        self.columns.dot(r, &self.x)
    }

    fn run(&mut self, warm: bool) {
        let m = self.columns.len();
        self.lambda.clear();
        self.lambda.resize(m, 0.0);
        self.x.clear();
        self.x.resize(self.columns.freedoms, 0.0);
        (self.residual, self.infeasible, self.factors) = (0.0, false, 0);
        (self.ordered, self.searched, self.factored_delta) = (false, false, 0.0);
        let largest = self.beta.iter().fold(0.0, |a: f64, b| if *b > a { *b } else { a });
        if (0..m).all(|i| self.beta[i] <= self.goal[i]) {
            return; // nothing closes: the nearest velocities are those given
        }
        if m == 1 {
            self.lambda[0] = self.beta[0];
            self.columns.combine(&self.lambda, &mut self.x);
            return;
        }

        self.guess(warm, largest);
        if self.is_loose() {
            self.settle(largest);
            return;
        }
        let (mut delta, mut last) = (DELTA_START, f64::INFINITY);
        let (mut stalls, mut best, mut error) = (0, f64::INFINITY, f64::INFINITY);
        self.best.clone_from(&self.lambda);
        for _ in 0..PROXIMAL_STEPS {
            self.newton(delta, largest);
            for i in 0..m {
                self.step[i] = self.lambda[i] - self.center[i];
            }
            self.columns.combine(&self.lambda, &mut self.x);
            error = self.error();
            if error < best {
                best = error;
                self.best.clone_from(&self.lambda);
            }
            self.center.copy_from_slice(&self.lambda);
            if error <= 1.0 {
                break;
            }
            if error > SLOW * last {
                // Is it rounding that is left? A smaller delta would only make it larger.
                if error <= self.floor() || stalls > STALLS {
                    break;
                }
                if self.driven && self.no_room(largest) {
                    self.infeasible = true;
                    break;
                }
                stalls += 1;
                delta = (delta * 1e-2).max(DELTA_END);
            }
            last = error;
        }
        if !(error <= best) {
            self.lambda.clone_from(&self.best);
            self.columns.combine(&self.lambda, &mut self.x);
        }
        self.residual = best * self.tolerance;
    }

    /// The first set of active contacts.
    fn guess(&mut self, warm: bool, largest: f64) {
        let m = self.columns.len();
        self.active.clear();
        if warm && self.center.iter().any(|l| *l > 0.0) {
            self.active.extend(self.center.iter().map(|l| *l > 0.0));
        } else {
            self.active.extend(self.beta.iter().map(|b| *b > -NEAR * largest));
        }
        for list in [&mut self.step, &mut self.pull, &mut self.noise] {
            list.clear();
            list.resize(m, 0.0);
        }
    }

    /// The largest error of l and x = C l, in units of the goal.
    pub(super) fn error(&self) -> f64 {
        let mut largest = 0.0;
        for i in 0..self.columns.len() {
            let short = self.beta[i] - self.columns.dot(i, &self.x);
            let error = if self.lambda[i] > 0.0 { short.abs_() } else { short } / self.goal[i];
            if !(error <= largest) {
                largest = error;
            }
        }
        largest
    }

    /// The error that rounding explains, in units of the goal.
    fn floor(&self) -> f64 {
        let units = self.noise.iter().zip(&self.goal).map(|(noise, goal)| 4.0 * noise / goal);
        units.fold(0.0, f64::max)
    }

    /// Farkas: if d >= 0 does not act on any body (C d = 0) and yet beta.d > 0, no x has C^T x >= beta, because then
    /// beta.d <= x.C d = 0. On an infeasible problem the proximal steps tend to such a d.
    pub(super) fn no_room(&mut self, largest: f64) -> bool {
        let most = self.step.iter().fold(0.0, |a: f64, d| a.max(*d));
        if !self.step.iter().all(|d| *d >= -1e-6 * most) {
            return false;
        }
        self.columns.combine(&self.step, &mut self.way);
        let gain: f64 = self.step.iter().zip(&self.beta).map(|(d, b)| d * b).sum();
        let act = self.way.iter().map(|x| x * x).sum::<f64>().sqrt_();
        gain > NO_ROOM * act * largest
    }

    /// One proximal step: `lambda` from `center`, beginning with the contacts that are `active`.
    fn newton(&mut self, delta: f64, largest: f64) {
        for step in 0..NEWTON_STEPS {
            let lost = step == PATIENCE && !self.searched;
            if lost {
                self.search(largest);
            }
            self.newton_target(delta);
            core::mem::swap(&mut self.x, &mut self.target);
            core::mem::swap(&mut self.pull, &mut self.step);
            let settled = self.pulls(delta, largest);
            if settled {
                break;
            }
            // Any start will do, also that of a guess; from there on every step is a descent.
            self.advance(delta, step != 0 && !lost);
        }
        for lambda in &mut self.lambda {
            *lambda = lambda.max(0.0);
        }
    }

    /// Goes the way from the start (in `target`, its pulls in `step`) to the Newton target (in `x` and `pull`), as far as the line
    /// search says if `searching`, and takes the active contacts there.
    pub(super) fn advance(&mut self, delta: f64, searching: bool) {
        let length = if searching { self.line_search(delta) } else { 1.0 };
        if length < 1.0 {
            for k in 0..self.x.len() {
                self.x[k] = self.target[k] + length * self.way[k];
            }
            for i in 0..self.pull.len() {
                self.pull[i] = self.step[i] + length * (self.pull[i] - self.step[i]);
            }
        }
        for i in 0..self.pull.len() {
            self.active[i] = self.pull[i] > if self.active[i] { 0.0 } else { self.noise[i] };
        }
    }

    /// Takes the active contacts, and a center, from the interior point method.
    fn search(&mut self, largest: f64) {
        self.searched = true;
        self.factors += self.interior.solve(&self.columns, &self.beta, largest, &mut self.frame, None);
        for i in 0..self.columns.len() {
            let pushes = self.interior.pushes(i);
            self.active[i] = pushes.is_some();
            self.center[i] = pushes.unwrap_or(0.0);
        }
    }

    /// The pulls at a Newton target `x`. True if they say the same active set. Where active they are delta l_i, free of the
    /// rounding of x; where not, a contact comes in only if it is pulled by more than that rounding, or contacts that
    /// neither push nor open (of which crystals are full) would come and go for ever.
    pub(super) fn pulls(&mut self, delta: f64, largest: f64) -> bool {
        let most = self.lambda.iter().fold(largest, |a, l| a.max(*l));
        let mut settled = true;
        for i in 0..self.columns.len() {
            self.noise[i] = 0.25 * self.goal[i] + ROUNDING * most;
            if self.active[i] {
                self.pull[i] = delta * self.lambda[i];
                settled &= self.pull[i] >= 0.0;
            } else {
                self.pull[i] = delta * self.center[i] + self.beta[i] - self.columns.dot(i, &self.x);
                settled &= self.pull[i] <= self.noise[i];
            }
        }
        settled
    }

    /// Solves the subproblem as if the active contacts were all and two-sided: `lambda`, and `target` = C lambda.
    pub(super) fn newton_target(&mut self, delta: f64) {
        let m = self.columns.len();
        self.lambda.clear();
        self.lambda.extend((0..m).map(|i| if self.active[i] { self.center[i] } else { 0.0 }));
        self.columns.combine(&self.lambda, &mut self.target);
        self.right.clear();
        self.right.extend(
            (0..m).map(|i| if self.active[i] { self.beta[i] - self.columns.dot(i, &self.target) } else { 0.0 }),
        );
        self.factor(delta);
        self.solve_factored();
        for i in 0..m {
            self.lambda[i] += self.right[i];
        }
        self.columns.combine(&self.lambda, &mut self.target);
    }

    /// Factors C_A^T C_A + delta 1, if that is not what was factored last.
    fn factor(&mut self, delta: f64) {
        if self.factored_delta == delta && self.factored == self.active {
            return;
        }
        self.shift.clear();
        self.shift.resize(self.columns.len(), delta);
        self.factor_shifted();
        self.factored_delta = delta;
        self.factored.clone_from(&self.active);
    }

    /// Factors C_A^T C_A + diag(shift).
    fn factor_shifted(&mut self) {
        self.factors += 1;
        self.factored_delta = 0.0;
        if self.is_loose() {
            self.frame.order(&self.columns);
            let active = &self.active;
            self.frame.factor(&self.columns, |i| if active[i] { 1.0 } else { 0.0 }, self.shift[0]);
        } else if self.columns.len() <= DENSE {
            self.dense.factor(&self.columns, &self.active, &self.shift);
        } else {
            if !self.ordered {
                self.sparse.order(&self.columns);
                self.ordered = true;
            }
            self.sparse.factor(&self.columns, &self.active, &self.shift);
        }
    }

    /// Replaces `right` by the solution.
    fn solve_factored(&mut self) {
        if self.is_loose() {
            self.columns.combine(&self.right, &mut self.pushed);
            self.frame.solve(&mut self.pushed);
            let inverse = 1.0 / self.factored_delta;
            for i in 0..self.right.len() {
                if self.active[i] {
                    self.right[i] = (self.right[i] - self.columns.dot(i, &self.pushed)) * inverse;
                }
            }
            return;
        }
        if self.columns.len() <= DENSE { self.dense.solve(&mut self.right) } else { self.sparse.solve(&mut self.right) }
    }

    /// With the start in `target` and its pulls in `step`, and the full step in `x` and its pulls in `pull`: the part of the
    /// step, in (0, 1], at which |x|^2/2 + sum max(0, pull)^2 / (2 delta) is least. `way` is left as the whole step.
    pub(super) fn line_search(&mut self, delta: f64) -> f64 {
        let m = self.columns.len();
        self.way.clear();
        self.way.extend(self.x.iter().zip(&self.target).map(|(to, from)| to - from));
        // The slope at t is value + t growth between the bends, where a contact comes in or goes out.
        let (mut value, mut growth) = (0.0, 0.0);
        for k in 0..self.way.len() {
            value += self.target[k] * self.way[k];
            growth += self.way[k] * self.way[k];
        }
        self.bends.clear();
        for i in 0..m {
            let (from, to) = (self.step[i], self.pull[i]);
            let fall = from - to; // c_i . way
            if from > 0.0 {
                value -= from * fall / delta;
                growth += fall * fall / delta;
            }
            if (from > 0.0) != (to > 0.0) {
                let t = from / fall;
                if (0.0..1.0).contains(&t) {
                    self.bends.push((t, if from > 0.0 { -fall * fall } else { fall * fall } / delta));
                }
            }
        }
        self.bends.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        for &(t, change) in &self.bends {
            if value + t * growth >= 0.0 {
                break;
            }
            value -= t * change;
            growth += change;
        }
        let t = -value / growth;
        if (0.0..1.0).contains(&t) { t } else { 1.0 }
    }
}
