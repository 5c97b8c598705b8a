//! Running the clock: until a time, a number of impacts, rest, or until nothing can ever meet again.
use core::sync::atomic::{AtomicBool, Ordering};

use super::ahead;
use super::calendar::Entry;
use super::machine;
use super::rounds::ROUNDS_AT_ONCE;
use super::store::Motion;
use super::{CROSSING, GRIP_END, ISLAND, NOTHING, SLICE_END, SUPPORT_END, WALL, World};
use crate::report::{Impact, Touch};
use crate::vector::Exact;
use crate::wall::Shape;
use crate::{Rotates, Vector};

/// When a run ends.
#[derive(Clone, Copy, Debug, Default)]
pub struct Limits<'a> {
    /// At this time (s); an impact exactly then still happens.
    pub time: Option<f64>,
    /// When the world has seen this many impacts in all. An instant is never split, so that there may be more.
    pub impacts: Option<u64>,
    /// When every body is at rest or fixed.
    pub rest: bool,
    /// As soon as this is set.
    pub interrupt: Option<&'a AtomicBool>,
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The time was reached.
    Time,
    /// The number of impacts was reached.
    Impacts,
    /// Every body is at rest or fixed.
    Rest,
    /// Nothing can ever meet again.
    Quiet,
    /// The caller's flag was set.
    Interrupted,
    /// Driven bodies or walls leave a body no room; or others that are so much heavier that no impulse is in their numbers.
    Crushed,
    /// A position or a velocity is no longer finite; or, in a periodic box, a body went round so fast (more than once between two
    /// neighbouring numbers of the clock) or so often without meeting anything (1,000,000,000 times) that nobody can tell where it is;
    /// or one in a lasting contact moves further than its own size in so short a time.
    NotFinite,
}

/// Crossings between two looks at whether a periodic world is quiet, per body: the look costs as much as a pair for each pair.
const CROSSINGS_BEFORE_A_LOOK: u64 = 64;
/// Queue entries between two looks at whether the bodies have left the cells behind, per body.
const GRID_LOOK: u64 = 16;
/// Events between two looks at the caller's flag.
const EVENTS_BETWEEN_LOOKS: u64 = 256;
/// In larger worlds the search for a last pair that might meet is left out, and a world without a predicted meeting that still
/// crosses cells counts as not quiet.
const MOST_FOR_QUIET: usize = 20_000;

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// Lets `dt` seconds pass and returns every impact in (t, t + dt], in order, complete (from time 0 on: in [0, dt]). The
    /// buffer is reused by the next call.
    ///
    /// Nothing happens for a `dt` that is not positive.
    pub fn advance(&mut self, dt: f64) -> &[Impact<D>] {
        self.advance_to(self.time + dt)
    }

    /// Lets time pass until `time` (s). As [`World::advance`], without the rounding of a sum of steps.
    pub fn advance_to(&mut self, time: f64) -> &[Impact<D>] {
        self.run(&Limits { time: Some(time), ..Limits::default() });
        &self.impacts
    }

    /// Lets time pass until the next instant at which there is an impact, but not beyond `horizon` (s), and returns the impacts
    /// of that instant: empty if there was none.
    pub fn advance_to_next(&mut self, horizon: f64) -> &[Impact<D>] {
        let limits = Limits { time: Some(horizon), impacts: Some(self.impact_count + 1), ..Limits::default() };
        self.run(&limits);
        &self.impacts
    }

    /// Runs until the first of the limits holds, and says which. The impacts are then in [`World::impacts`]; without a limit
    /// that bounds them, so is their number in memory: pass a number of impacts and call again.
    pub fn run(&mut self, limits: &Limits<'_>) -> Stop {
        let stop = self.run_events(limits);
        self.read_slices();
        stop
    }

    pub(super) fn run_events(&mut self, limits: &Limits<'_>) -> Stop {
        self.impacts.clear();
        self.touches.clear();
        if !self.ready {
            self.prepare();
        }
        // Looked at here as well: a caller that asks for a few impacts at a time never gets to the look below.
        if limits.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            return Stop::Interrupted;
        }
        let end = limits.time.unwrap_or(f64::INFINITY);
        if end.is_nan() || end < self.time {
            return Stop::Time;
        }
        let regrid = GRID_LOOK * (self.store.bodies.len() as u64 + 1024);
        let mut since_grid = 0;
        let mut looked = self.crossed;
        let mut patience = CROSSINGS_BEFORE_A_LOOK * (self.store.bodies.len() as u64 + 1);
        let mut rounds = 0;
        let (mut ahead, mut fetched) = (u64::MAX, 0);
        let (mut steps, mut impacts_then) = (0u64, self.impact_count);
        loop {
            if self.broken {
                return Stop::NotFinite;
            }
            if self.crushed {
                return Stop::Crushed;
            }
            if self.lists.on && (self.lists.short || !self.is_plain() || !self.store.uniform) {
                // Lists are for plain worlds without gravity.
                self.prepare();
            }
            let (due, islands, instant) = (&self.due, &self.islands, self.time);
            let live = |e: &Entry| {
                if e.partner == SLICE_END {
                    let island = &islands[(e.owner & !ISLAND) as usize];
                    return island.alive && island.stamp == e.stamp;
                }
                due[e.owner as usize].turn == e.stamp
            };
            let Some(entry) = self.queue.peek(live) else {
                return self.nothing_left(limits, end);
            };
            if self.queue.open() != ahead && self.store.bodies.len() >= ahead::FROM {
                ahead = self.queue.open();
                self.fetch_ahead(&mut fetched);
            }
            if entry.time > instant {
                if limits.rest && self.restless == 0 && self.has_moving() {
                    return Stop::Rest;
                }
                if limits.impacts.is_some_and(|n| self.impact_count >= n) {
                    return Stop::Impacts;
                }
            }
            if !(entry.time <= end) {
                self.time = end;
                return if self.is_quiet() { Stop::Quiet } else { Stop::Time };
            }
            steps += 1;
            if steps.is_multiple_of(EVENTS_BETWEEN_LOOKS)
                && limits.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed))
            {
                return Stop::Interrupted;
            }
            since_grid += 1;
            if since_grid > regrid {
                since_grid = 0;
                if self.outgrown() {
                    // The entry that is due is predicted anew with all the others.
                    self.prepare();
                    continue;
                }
            }
            self.queue.pop();
            let i = entry.owner as usize;
            // The clock never goes back, not even by a rounding.
            let time = if entry.time > self.time { entry.time } else { self.time };
            if time > self.time {
                rounds = 0;
                if !self.told.is_empty() {
                    self.told.clear();
                }
            }
            if entry.partner == CROSSING {
                self.time = time;
                rounds += u64::from(self.cross(i));
                if self.impact_count != impacts_then {
                    (impacts_then, looked, rounds) = (self.impact_count, self.crossed, 0);
                }
                if rounds > ROUNDS_AT_ONCE * (self.store.bodies.len() as u64 + 1) {
                    self.outrun();
                }
                if self.crossed - looked > patience {
                    let told = limits.time.is_some() && self.store.bodies.sensor.contains(&true);
                    if !told && self.is_quiet() {
                        return self.coast(limits, end);
                    }
                    looked = self.crossed;
                    patience = patience.saturating_mul(2);
                }
                continue;
            }
            if entry.partner == SLICE_END {
                self.slice_end(time, (entry.owner & !ISLAND) as usize);
            } else {
                self.event(time, i);
            }
        }
    }

    fn event(&mut self, time: f64, i: usize) {
        let next = self.due[i].next;
        if next.partner == SUPPORT_END {
            self.support_end(time, i);
        } else if next.partner == GRIP_END {
            self.grip_end(time, i);
        } else if next.partner & WALL != 0 {
            self.meet(time, i, next.partner);
        } else if self.store.bodies.matter[next.partner as usize].stamp != next.stamp {
            // Its partner went elsewhere meanwhile.
            self.predict(i);
        } else if self.store.bodies.sensor[i] || self.store.bodies.sensor[next.partner as usize] {
            self.tell(time, i, next.partner as usize);
        } else if !self.is_plain() || !machine::meet(self, time, i, next.partner as usize) {
            self.meet(time, i, next.partner);
        }
    }

    fn tell(&mut self, time: f64, i: usize, j: usize) {
        self.time = time;
        let (low, high) = if i < j { (i, j) } else { (j, i) };
        if self.told.insert((low as u32, high as u32, time.to_bits())) {
            self.events += 1;
            let bodies = [self.store.bodies.id(low), self.store.bodies.id(high)];
            self.touches.push(Touch { time, bodies });
        }
        self.predict(i);
    }

    /// The queue is empty: nothing moves into anything any more.
    pub(super) fn nothing_left(&mut self, limits: &Limits<'_>, end: f64) -> Stop {
        if limits.rest && self.restless == 0 && self.has_moving() {
            return Stop::Rest;
        }
        if limits.impacts.is_some_and(|n| self.impact_count >= n) {
            return Stop::Impacts;
        }
        let quiet = self.resting == 0;
        if end.is_finite() {
            self.time = end;
            return if quiet { Stop::Quiet } else { Stop::Time };
        }
        if quiet { Stop::Quiet } else { Stop::Rest }
    }

    /// True if there is a body that is not fixed.
    fn has_moving(&self) -> bool {
        self.store.bodies.living().any(|i| !self.store.bodies.is_fixed(i))
    }

    /// True if nothing can ever meet again. Resting bodies are never quiet: gravity presses them.
    pub fn is_quiet(&self) -> bool {
        if !self.ready || self.resting > 0 || !self.held.is_empty() {
            return false;
        }
        let b = &self.store.bodies;
        let live = |i: usize| {
            let next = &self.due[i].next;
            let j = next.partner as usize;
            next.partner != NOTHING
                && (next.partner & WALL != 0 || b.matter[j].stamp == next.stamp && !b.sensor[i] && !b.sensor[j])
        };
        // A prediction that still holds is a meeting to come, or is forestalled by one.
        if b.living().any(live) {
            return false;
        }
        if self.cells.len() == 1 && !self.store.any_periodic && b.living().all(|i| self.due[i].next.partner == NOTHING)
        {
            return true;
        }
        if b.living().count() > MOST_FOR_QUIET {
            return false;
        }
        let bodies: alloc::vec::Vec<usize> = b.living().collect();
        for (k, &i) in bodies.iter().enumerate() {
            for (w, wall) in self.store.walls.iter().enumerate().filter(|(_, wall)| wall.alive) {
                if b.matter[i].inverse_mass > 0.0 && !b.sensor[i] {
                    let unsure = self.store.any_periodic && !matches!(wall.shape, Shape::Plane { .. });
                    if unsure || self.wall_time(i, w, [0; D]) < f64::INFINITY {
                        return false;
                    }
                }
            }
            for &j in &bodies[k + 1..] {
                if self.store.collide(i, j) && self.may_meet(i, j) {
                    return false;
                }
            }
        }
        true
    }

    /// True if the bodies have spread or gathered so much that the cells no longer fit them.
    pub(super) fn outgrown(&self) -> bool {
        /// So many times as many in a cell as there were, and so many more.
        const CROWDED: f64 = 4.0;
        if self.cells.len() == 1 && self.store.bodies.len() < 64 {
            return false;
        }
        if self.cells.crowding() > CROWDED * (self.crowding + 1.0) {
            return true;
        }
        let (now, then) = (self.space(), self.cells.space());
        (0..D).any(|k| {
            let (wide, was) = (now.high[k] - now.low[k], then.high[k] - then.low[k]);
            !(wide < 2.0 * was && was < 2.0 * wide)
                || now.low[k] > then.high[k]
                || now.high[k] < then.low[k]
                || now.low[k] < then.low[k] - was
                || now.high[k] > then.high[k] + was
        })
    }

    /// True if two bodies may meet some day, in any image of the box.
    fn may_meet(&self, i: usize, j: usize) -> bool {
        if !self.store.any_periodic {
            return self.pair_time(i, j, [0; D]) < f64::INFINITY;
        }
        let ((xi, vi), (xj, vj)) = (self.store.at(i, self.time), self.store.at(j, self.time));
        let v = vj - vi;
        if v == Vector::ZERO && self.store.acceleration(i) == self.store.acceleration(j) {
            return false;
        }
        // Along one axis only, they pass each other if they are far enough apart across it.
        let axes = (0..D).filter(|&k| v[k] != 0.0).count();
        if axes == 1 && self.store.weightless {
            let mut d = self.store.nearest_image(xj - xi);
            for k in 0..D {
                if v[k] != 0.0 {
                    if !self.store.periodic[k] && d[k] * v[k] >= 0.0 {
                        return false;
                    }
                    d[k] = 0.0;
                }
            }
            let reach = self.store.bodies.record[i].radius + self.store.bodies.record[j].radius;
            return d.norm() < reach;
        }
        if D == 2 && self.store.periodic == [true; D] && self.store.weightless {
            let reach = self.store.bodies.record[i].radius + self.store.bodies.record[j].radius;
            return line_meets(
                (xj - xi).0[0],
                (xj - xi).0[1],
                v[0],
                v[1],
                self.store.width[0],
                self.store.width[1],
                reach,
            );
        }
        true
    }

    /// True if the body is at rest on its supports.
    pub(super) fn is_resting(&self, i: usize) -> bool {
        self.store.bodies.motion[i] == Motion::Resting
    }
}

/// True if a straight line through (x, y) along (u, v) on a torus of these widths passes a point of the lattice of its images
/// within `reach`.
///
/// Across the line the lattice lies at p a + q b for all whole p and q: a grid of the pitch that Euclid's algorithm finds, or,
/// if it ends below 2 `reach`, at least that fine.
fn line_meets(x: f64, y: f64, u: f64, v: f64, wide: f64, high: f64, reach: f64) -> bool {
    let speed = Vector([u, v]).norm();
    let (mut a, mut b) = ((wide * v / speed).abs_(), (high * u / speed).abs_());
    let zero = 1e-12 * (wide + high);
    for _ in 0..200 {
        if a < b {
            (a, b) = (b, a);
        }
        if a <= 2.0 * reach {
            return true;
        }
        if b <= zero {
            break;
        }
        a -= libm::floor(a / b) * b;
    }
    let across = (x * v - y * u) / speed;
    (across - libm::rint(across / a) * a).abs_() < reach
}

#[cfg(test)]
mod tests {
    use super::line_meets;

    #[test]
    fn lines_on_a_torus() {
        // Along the diagonal of a unit square the images lie 1/sqrt 2 apart across it.
        assert!(line_meets(0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.1));
        assert!(!line_meets(0.5, 0.0, 1.0, 1.0, 1.0, 1.0, 0.3), "half of it is 0.35 away");
        assert!(line_meets(0.5, 0.0, 1.0, 1.0, 1.0, 1.0, 0.36));
        // The golden ratio comes near everything.
        assert!(line_meets(0.5, 0.3, 1.0, 1.618033988749895, 1.0, 1.0, 1e-4));
        // Slope 1/2: pitch 1/sqrt 5.
        assert!(!line_meets(0.25, 0.0, 2.0, 1.0, 1.0, 1.0, 0.11) && line_meets(0.25, 0.0, 2.0, 1.0, 1.0, 1.0, 0.12));
    }
}
