//! Islands in lasting contact move by slices: v' = Proj(v + g h) onto the velocities that open every near contact, x += h v'.
//!
//! Event by event a heap would never come to rest: bounces pile up without end. A slice takes all its contacts at once, with
//! the primitive that also serves simultaneous impacts (THEORY 4.3). For any length h it neither adds energy nor lets bodies
//! overlap, since the linearised gap of a convex pair underestimates the true one; so a slice may be cut short by an event, or
//! read half-way, by solving it again with the shorter h.
use alloc::{vec, vec::Vec};

use super::drag::{Dragged, Row};
use super::instant::TOUCHING;
use super::store::Motion;
use super::{WALL, World};
use crate::codec::codec;
use crate::law::together::{Solver, System};
use crate::{Rotates, Vector};

/// The length of a slice (s). A ball that only falls would lose m g^2 h^2 / 2 a slice, 5e-5 J a kilogram; a frictionless bowl
/// loses O(h).
pub const SLICE: f64 = 1e-3;
/// How good a slice that is solved by factors is to its contacts, relative to its fastest velocities: at 1 m/s they close by 1e-11 m
/// too much. What gap is left is the next slice's bound, and what the impulses did is booked, so that nothing adds up.
const SLICE_TOLERANCE: f64 = 1e-8;
/// How good a slice that is solved by sweeps is: contacts close too much by this part of the smallest radius at most, and by this part
/// of the way that the fastest body goes, or of what gravity alone would move it by, whichever is more. The next slice opens them again
/// as far as energy allows.
pub(super) const GAP_ERROR: f64 = 1e-7;
const WAY_ERROR: f64 = 1e-3;
const FALL_ERROR: f64 = 1e-6;
/// So many sweeps at most, and how many times the error may be what was asked for before the slice is solved by factors instead.
pub(super) const SWEEPS: u32 = 1000;
const SLOPPY: f64 = 4.0;
/// A projection by factors is repeated at most so often.
const PASSES: u32 = 4;
/// In small islands, contacts that overlap by more than counts as touching open at this part of the fastest velocity at most, if energy
/// allows: what very unequal masses leave of the solver's digits must not add up.
const REOPENING: f64 = 0.01;
/// Rounding may raise the energy by this part of what gravity gives a body that falls for a slice, and of the kinetic energy.
const RISE: f64 = 1e-12;
/// The same where the question is whether anything moves at all: a hundredth of [`super::EQUILIBRIUM`].
pub(super) const REST_TOLERANCE: f64 = 1e-11;
/// In islands of so many contacts, which are solved to [`SLICE_TOLERANCE`], balls may stand out of arcs by this part of the radius.
pub(super) const MANY: usize = 48;
const OUTSIDE: f64 = 1e-9;
/// A body moves no further in a slice than this part of the largest radius: fast heaps take shorter slices. The neighbours of a
/// heap all lie within twice that, so that a larger one costs nothing; it shows them sooner, where the linearised gap of a pair
/// holds them apart too early by a quarter of its square.
const REACH: f64 = 0.12;
/// Tangents added where a ball slides inside an arc, at most.
const TANGENTS: usize = 24;

/// A contact that a slice might close.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near<const D: usize> {
    /// A moving body, and the code of its partner.
    pub a: u32,
    pub b: u32,
    /// Unit vector from `a` to its partner.
    pub normal: Vector<D>,
    /// The gap (m) when the slice starts.
    pub gap: f64,
    /// Inside an arc: its centre, and how far from it the ball's centre may be (m).
    pub inside: Option<(Vector<D>, f64)>,
}

codec!(Near<D> { a, b, normal, gap, inside });

/// Bodies that move by slices together.
#[derive(Clone, Debug)]
pub(super) struct Island<const D: usize>
where
    Vector<D>: Rotates,
{
    /// The moving bodies, sorted.
    pub bodies: Vec<u32>,
    pub near: Vec<Near<D>>,
    /// Impulses (N s) of the slice as planned, one for each of `near`.
    pub lambda: Vec<f64>,
    /// Friction as the slice before left it, for this length: where its own starts, whatever part of it is solved. Empty where
    /// nothing rubs.
    pub drag: Vec<Dragged<D>>,
    /// When the slice started, how long it is planned to last, and the velocities at its start.
    pub start: f64,
    pub length: f64,
    pub before: Vec<Vector<D>>,
    pub resting: bool,
    pub alive: bool,
    /// The stamp of its entry in the queue.
    pub stamp: u32,
    /// The slice as planned, if it still holds.
    pub planned: Option<Solved<D>>,
}

codec!(Island<D> { bodies, near, lambda, drag, start, length, before, resting, alive, stamp, planned });

/// A slice, solved for some length.
#[derive(Clone, Debug)]
pub(super) struct Solved<const D: usize>
where
    Vector<D>: Rotates,
{
    pub x: Vec<Vector<D>>,
    pub v: Vec<Vector<D>>,
    pub spin: Vec<<Vector<D> as Rotates>::Spin>,
    pub lambda: Vec<f64>,
    pub drag: Vec<Dragged<D>>,
    /// What gravity and immovable parties gave.
    pub momentum: Vector<D>,
    pub moment: <Vector<D> as Rotates>::Spin,
    pub lost: f64,
    pub work: f64,
    pub crushed: bool,
    /// False if the sweeps did not come near enough.
    pub good: bool,
}

/// A body as its slice has it: its number, position, velocity and spin.
pub(super) type State<const D: usize> = (u32, Vector<D>, Vector<D>, <Vector<D> as Rotates>::Spin);

/// How a slice is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Effort {
    /// By sweeps; contacts that overlap open again.
    Open,
    /// By sweeps, a hundred times as good; contacts that overlap do not close further.
    Sweep,
    /// By factors; contacts that overlap open again.
    Reopen,
    /// By factors, good to this part of the velocities.
    Factor(f64),
}

/// What is asked of the solution of a slice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    pub effort: Effort,
    /// How fast a contact may close too much (m/s), where it is found by sweeps, and where by factors.
    pub closing: f64,
    pub enough: f64,
}

codec!(Solved<D> { x, v, spin, lambda, drag, momentum, moment, lost, work, crushed, good });

/// What the slices under way have done up to the present, read from a copy.
#[derive(Clone, Debug)]
pub(super) struct Partial<const D: usize>
where
    Vector<D>: Rotates,
{
    /// (body, position, velocity, spin), sorted by body.
    pub states: Vec<State<D>>,
    pub momentum: Vector<D>,
    pub moment: <Vector<D> as Rotates>::Spin,
    pub lost: f64,
    pub work: f64,
}

impl<const D: usize> Default for Partial<D>
where
    Vector<D>: Rotates,
{
    fn default() -> Self {
        Self { states: vec![], momentum: Vector::ZERO, moment: Default::default(), lost: 0.0, work: 0.0 }
    }
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// The velocity of an immovable party.
    pub(super) fn immovable(&self, code: u32) -> Option<Vector<D>> {
        if code & WALL != 0 {
            return Some(self.store.walls[(code & !WALL) as usize].velocity);
        }
        (self.store.bodies.matter[code as usize].inverse_mass == 0.0).then(|| self.store.bodies.record[code as usize].v)
    }

    /// Solves a slice of length `h` from the island's start. Writes nothing but the solver's memory.
    pub(super) fn solve_slice(&mut self, island: &Island<D>, h: f64) -> Solved<D> {
        let g = self.store.gravity.norm();
        let (mut rise, mut fastest) = (0.0, 0.0);
        for (&i, v) in island.bodies.iter().zip(&island.before) {
            rise += RISE * 0.5 * self.store.bodies.matter[i as usize].mass * (v.norm_squared() + g * g * h * h);
            fastest = larger(fastest, v.norm());
        }
        // Where nothing moves there is no energy to open contacts with.
        let moves = fastest > g * h;
        let overlaps = |n: &Near<D>| n.gap < -TOUCHING * self.store.bodies.record[n.a as usize].radius;
        let efforts = match (island.near.len() > MANY, moves) {
            (true, true) => &[Effort::Open, Effort::Sweep][..],
            (true, false) => &[Effort::Sweep],
            _ if island.near.iter().any(overlaps) => &[Effort::Reopen],
            _ => &[],
        };
        for &effort in efforts {
            let solved = self.solve_slice_by(island, h, effort);
            if solved.good && !(solved.lost < -rise) {
                return solved;
            }
        }
        self.solve_slice_by(island, h, Effort::Factor(SLICE_TOLERANCE))
    }

    /// The same by one method.
    pub(super) fn solve_slice_by(&mut self, island: &Island<D>, h: f64, effort: Effort) -> Solved<D> {
        let g = self.store.gravity;
        let count = island.bodies.len();
        let place = |code: u32| island.bodies.binary_search(&code).ok().map(|k| k * D);
        let x: Vec<Vector<D>> = island.bodies.iter().map(|&i| self.store.bodies.record[i as usize].x).collect();
        let mut solved = Solved {
            x: x.clone(),
            v: island.before.clone(),
            spin: island.bodies.iter().map(|&i| self.store.bodies.spin[i as usize]).collect(),
            lambda: vec![0.0; island.near.len()],
            drag: vec![],
            momentum: Vector::ZERO,
            moment: Default::default(),
            lost: 0.0,
            work: 0.0,
            crushed: false,
            good: true,
        };
        if !(h > 0.0) {
            return solved;
        }
        let mut system = core::mem::take(&mut self.system);
        let mut solver = core::mem::take(&mut self.solver);
        // A large island is solved to fewer digits.
        let outside = if island.near.len() > MANY { OUTSIDE } else { 4.0 * f64::EPSILON };
        // Tangents of arcs, found as the trial points leave them: (contact, normal, gap).
        let mut tangents: Vec<(usize, Vector<D>, f64)> = Vec::new();
        let radius =
            island.bodies.iter().map(|&i| self.store.bodies.record[i as usize].radius).fold(f64::INFINITY, f64::min);
        let fastest = island.before.iter().map(|v| v.norm()).fold(0.0, larger);
        let asked = (GAP_ERROR * radius / h).min(larger(WAY_ERROR * fastest, FALL_ERROR * g.norm() * h));
        let asked = if effort == Effort::Open { asked } else { 0.01 * asked };
        let slack = if island.near.len() > MANY { GAP_ERROR * radius / h } else { 0.0 };
        let enough = larger(SLICE_TOLERANCE * fastest, slack);
        // How fast a contact that overlaps may open (m/s).
        let opening = match effort {
            Effort::Open => SLOPPY * asked,
            Effort::Reopen => REOPENING * fastest,
            _ => 0.0,
        };
        let scaled = if island.length > 0.0 { h / island.length } else { 0.0 };
        let warm: Vec<f64> = island.lambda.iter().map(|l| l * scaled).collect();
        let rough = self.store.rough();
        let given = if rough { self.dragged_along(island, scaled) } else { Vec::new() };
        let mut rows: Vec<Row<D>> = Vec::new();
        let mut rubbed = Vec::new();
        for round in 0..TANGENTS {
            system.clear();
            for (k, &i) in island.bodies.iter().enumerate() {
                let from = island.before[k] + g * h;
                let from = if rough { from + given[k] } else { from };
                system.ball(self.store.bodies.matter[i as usize].inverse_mass, from);
            }
            let mut bounds = Vec::with_capacity(island.near.len());
            rows.clear();
            let mut add = |a: u32, b: u32, normal: Vector<D>, gap: f64| {
                let first = place(a).expect("a member of the island");
                match self.immovable(b) {
                    Some(velocity) => system.wall(first, normal, velocity),
                    None => system.pair(first, place(b).expect("a member of the island"), normal),
                };
                bounds.push(-larger(gap, -opening * h) / h);
                if rough {
                    rows.push(Row { a, b, normal, gap, bound: bounds[bounds.len() - 1] });
                }
            };
            for n in &island.near {
                add(n.a, n.b, n.normal, n.gap);
            }
            for &(k, normal, gap) in &tangents {
                add(island.near[k].a, island.near[k].b, normal, gap);
            }
            let mut start = warm.clone();
            start.resize(bounds.len(), 0.0);
            let projection = match effort {
                Effort::Reopen => solver.project_to(&mut system, &bounds, &start, SLICE_TOLERANCE),
                Effort::Factor(tolerance) => solver.project_to(&mut system, &bounds, &start, tolerance),
                _ => solver.relax(&mut system, &bounds, &start, asked, SWEEPS),
            };
            if matches!(effort, Effort::Open | Effort::Sweep) {
                solved.good = projection.residual <= SLOPPY * asked;
            }
            solved.crushed = projection.infeasible;
            solved.lambda.clear();
            solved.lambda.extend_from_slice(&projection.lambda);
            if let Effort::Reopen | Effort::Factor(_) = effort {
                self.project_again(&mut solver, &mut system, &bounds, enough, &mut solved.lambda);
            }
            for k in 0..count {
                solved.v[k] = system.velocity(k * D);
            }
            if rough {
                let by = if effort == Effort::Reopen { Effort::Factor(SLICE_TOLERANCE) } else { effort };
                let asked = Asked { effort: by, closing: asked, enough };
                rubbed = self.drag(island, h, &rows, asked, (&mut system, &mut solver), &mut solved);
            }
            let found = tangents.len();
            for (k, n) in island.near.iter().enumerate() {
                let Some((centre, limit)) = n.inside else { continue };
                let m = place(n.a).expect("a member of the island") / D;
                let velocity = self.immovable(n.b).unwrap_or_default();
                let reached = x[m] + (solved.v[m] - velocity) * h - centre;
                if reached.norm() > limit * (1.0 + outside) {
                    let normal = reached / reached.norm();
                    tangents.push((k, normal, limit - normal.dot(x[m] - centre)));
                }
            }
            if tangents.len() == found {
                break;
            }
            if round + 1 == TANGENTS {
                tangents.truncate(found); // never solved for
            }
        }
        // The accounts: momentum from gravity and walls, what the contacts took.
        for (k, &i) in island.bodies.iter().enumerate() {
            let m = self.store.bodies.matter[i as usize].mass;
            let change = solved.v[k] - island.before[k];
            solved.momentum += g * (m * h);
            solved.moment += Vector::<D>::moment(x[k], g * (m * h));
            solved.lost += 0.5 * m * change.norm_squared();
            if rough {
                let turned = solved.spin[k] - self.store.bodies.spin[i as usize];
                solved.lost += 0.5 * self.store.bodies.inertia[i as usize] * Vector::<D>::spin_dot(turned, turned);
            }
        }
        if !rubbed.is_empty() {
            self.book_drag(island, &rubbed, &x, &mut solved);
        }
        for (c, &lambda) in solved.lambda.iter().enumerate() {
            if !(lambda > 0.0) {
                continue;
            }
            solved.lost -= lambda * system.opening(c);
            let (a, b, normal) = match c.checked_sub(island.near.len()) {
                None => (island.near[c].a, island.near[c].b, island.near[c].normal),
                Some(t) => (island.near[tangents[t].0].a, island.near[tangents[t].0].b, tangents[t].1),
            };
            if let Some(velocity) = self.immovable(b) {
                let impulse = -(normal * lambda);
                let m = place(a).expect("a member of the island") / D;
                solved.momentum += impulse;
                solved.moment += Vector::<D>::moment(x[m], impulse);
                solved.work += impulse.dot(velocity);
            }
        }
        for (t, &(k, ..)) in tangents.iter().enumerate() {
            // The tangents' impulses are the contact's own.
            // (One found in the last round has none yet.)
            let lambda = solved.lambda.get(island.near.len() + t).copied().unwrap_or(0.0);
            solved.lambda[k] += lambda;
        }
        solved.lambda.truncate(island.near.len());
        for k in 0..count {
            solved.x[k] = x[k] + solved.v[k] * h;
        }
        for n in &island.near {
            if let Some((centre, limit)) = n.inside {
                // What rounding leaves outside is taken back towards the centre.
                let m = place(n.a).expect("a member of the island") / D;
                let centre = centre + self.immovable(n.b).unwrap_or_default() * h;
                let out = solved.x[m] - centre;
                let distance = out.norm();
                if distance > limit && distance < limit * (1.0 + 1e-9) {
                    solved.x[m] = centre + out * (limit / distance);
                }
            }
        }
        (self.system, self.solver) = (system, solver);
        solved
    }

    /// Between very unequal masses one projection may leave contacts that close (`law/together/exchange.rs`): those that close by more
    /// than `enough` (m/s) are projected again.
    pub(super) fn project_again(
        &self,
        solver: &mut Solver,
        system: &mut System,
        bounds: &[f64],
        enough: f64,
        lambda: &mut [f64],
    ) {
        for _ in 0..PASSES {
            let short = (0..bounds.len()).map(|c| bounds[c] - system.opening(c)).fold(0.0, larger);
            if !(short > enough) {
                return;
            }
            for (sum, more) in lambda.iter_mut().zip(&solver.project(system, bounds, &[]).lambda) {
                *sum += more;
            }
        }
    }

    /// Ends an island's slice at `time`: solves it for the time that has passed, books it, writes the records. The island is no
    /// more; its bodies, which are returned, wait to be grouped anew.
    pub(super) fn dissolve(&mut self, k: usize, time: f64) -> Vec<u32> {
        let mut island = core::mem::replace(&mut self.islands[k], Island::empty());
        self.free_islands.push(k as u32);
        if island.resting {
            for &i in &island.bodies {
                let (x, v) = self.store.at(i as usize, time);
                self.write(i as usize, time, x, v);
                self.island_of[i as usize] = NO_ISLAND;
                self.set_motion(i as usize, Motion::Sliced);
            }
        } else {
            let solved = match island.planned.take() {
                Some(planned) if time == island.start + island.length => planned,
                _ => self.solve_slice(&island, time - island.start),
            };
            self.books.momentum_given.add(&solved.momentum.0);
            if !self.store.any_periodic {
                self.books.angular_given.add(Vector::<D>::spin_slice(&solved.moment));
            }
            self.books.lost.add(solved.lost);
            self.books.work.add(solved.work);
            self.crushed |= solved.crushed;
            for (m, &i) in island.bodies.iter().enumerate() {
                self.write_turning(i as usize, time, solved.x[m], solved.v[m], solved.spin[m]);
                self.store.bodies.acceleration[i as usize] = Vector::ZERO;
                self.island_of[i as usize] = NO_ISLAND;
            }
            island.drag = solved.drag;
            self.slices += 1;
        }
        for (n, lambda) in island.near.iter().zip(&island.lambda) {
            if *lambda > 0.0 {
                self.warm.insert((n.a, n.b), *lambda / island.length);
            }
        }
        let lasted = if island.resting { island.length } else { time - island.start };
        for (n, (impulse, moment)) in island.near.iter().zip(&island.drag).filter(|_| lasted > 0.0) {
            let rate = 1.0 / lasted;
            self.warm_drag.insert((n.a, n.b), (*impulse * rate, *moment * rate));
        }
        island.bodies
    }

    /// Reads the slices under way at the present time, from a copy: nothing is written.
    pub(super) fn read_slices(&mut self) {
        let mut partial = core::mem::take(&mut self.partial);
        partial = Partial {
            states: {
                partial.states.clear();
                partial.states
            },
            ..Partial::default()
        };
        for k in 0..self.islands.len() {
            if !self.islands[k].alive || self.islands[k].resting {
                continue;
            }
            let island = core::mem::replace(&mut self.islands[k], Island::empty());
            let solved = self.solve_slice(&island, self.time - island.start);
            for (m, &i) in island.bodies.iter().enumerate() {
                partial.states.push((i, solved.x[m], solved.v[m], solved.spin[m]));
            }
            partial.momentum += solved.momentum;
            partial.moment += solved.moment;
            partial.lost += solved.lost;
            partial.work += solved.work;
            self.islands[k] = island;
        }
        partial.states.sort_unstable_by_key(|s| s.0);
        self.partial = partial;
    }

    /// Where a body is now, and how fast: from its record, or from the copy of its slice.
    pub(super) fn state_now(&self, i: usize) -> (Vector<D>, Vector<D>) {
        if self.store.bodies.motion[i] == Motion::Sliced
            && let Ok(k) = self.partial.states.binary_search_by_key(&(i as u32), |s| s.0)
        {
            return (self.partial.states[k].1, self.partial.states[k].2);
        }
        self.store.at(i, self.time)
    }

    /// How fast a body turns now (rad/s), likewise.
    pub(super) fn spin_now(&self, i: usize) -> <Vector<D> as Rotates>::Spin {
        if self.store.bodies.motion[i] == Motion::Sliced
            && let Ok(k) = self.partial.states.binary_search_by_key(&(i as u32), |s| s.0)
        {
            return self.partial.states[k].3;
        }
        self.spin_at(i, self.time)
    }

    /// The near contacts of a body with walls, for a slice during which it moves no further than `margin` (m).
    pub(super) fn near_walls(&self, i: usize, time: f64, margin: f64, length: f64, near: &mut Vec<Near<D>>) {
        let s = &self.store;
        let (x, _) = s.at(i, time);
        let x = s.wrapped(x, s.turns(x));
        let radius = s.bodies.record[i].radius;
        let mut wall = |w: usize| {
            let wall = &s.walls[w];
            let over = wall.over(time, x, radius);
            let normal = over.towards / over.towards.norm();
            if over.gap > margin + wall.velocity.norm() * length {
                return;
            }
            let shift = wall.shift(time);
            let inside = wall.shape.hollow(x - shift, radius).map(|(centre, limit)| (centre + shift, limit));
            near.push(Near { a: i as u32, b: WALL | w as u32, normal, gap: over.gap, inside });
        };
        for &w in &self.everywhere {
            wall(w as usize);
        }
        for &w in self.cells.walls(i as u32) {
            wall(w as usize);
        }
    }

    /// The largest distance that a body may move in a slice (m): what lies beyond is not looked at.
    pub(super) fn slice_reach(&mut self) -> f64 {
        REACH * self.largest_radius()
    }
}

/// No island.
pub(super) const NO_ISLAND: u32 = u32::MAX;

impl<const D: usize> Island<D>
where
    Vector<D>: Rotates,
{
    pub(super) fn empty() -> Self {
        Self {
            bodies: vec![],
            near: vec![],
            lambda: vec![],
            drag: vec![],
            start: 0.0,
            length: 0.0,
            before: vec![],
            resting: false,
            alive: false,
            stamp: 0,
            planned: None,
        }
    }
}

/// The larger of two numbers, where neither is NaN.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
