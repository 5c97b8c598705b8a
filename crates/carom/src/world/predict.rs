//! What comes next for a body: its earliest meeting with the others, and when it leaves its cell.
//!
//! The predicted time of a pair is a pure function of its two records and the image of the box: it is evaluated at the later
//! record's time and never clamped to the time at which it was noticed. So the cells' width, the number of frames, and who
//! asked cannot change a bit of it.
use super::calendar::Entry;
use super::instant::TOUCHING;
use super::rounds::is_beyond;
use super::slices::NO_ISLAND;
use super::store::Motion;
use super::{CROSSING, GRIP_END, NOTHING, Next, SUPPORT_END, WALL, World};
use crate::meet::{self, Path};
use crate::vector::Exact;
use crate::wall::Shape;
use crate::{Rotates, Vector};

/// Speeds below this many units in the last place of the bodies' own speeds are what rounding leaves of zero: bodies that
/// touch and close no faster move together (THEORY 4.3). An impact with e = 0 leaves at most half of it.
pub(crate) const STILL: f64 = 8.0 * f64::EPSILON;
/// Below this speed (m/s) a product with a mass or a length has no digits left: it is no speed.
const NO_SPEED: f64 = 1e-290;

/// Where bodies touch, closing speeds below this part of their own speeds are what the operators leave of zero. They may come
/// together by [`CREEP`] of the smaller radius before it counts.
const SLOW_CREEP: f64 = 1e-12;
const CREEP: f64 = 1e-10;
/// The same of speeds by which they come together by less than this part of the smaller radius in a unit of time. Where nothing bounces, speeds halve
/// from impact to impact at one place; without an end to it they would do so down to [`NO_SPEED`], hundreds of times at one instant.
const STANDSTILL: f64 = 1e-20;

/// When bodies that touch and close at `closing` (m/s), while their speeds add up to `speeds`, meet: now, or where it is
/// rounding that closes them, much later or never. So a cluster that moves together does not meet over and over at one
/// instant.
pub(super) fn creep(closing: f64, speeds: f64, radius: f64) -> f64 {
    if !(closing > STILL * speeds + NO_SPEED) {
        f64::INFINITY
    } else if closing > SLOW_CREEP * speeds && closing > STANDSTILL * radius {
        0.0
    } else {
        CREEP * radius / closing
    }
}

/// An acceleration presses a contact together if this part of it points along the normal; less is rounding.
pub(crate) const PRESSED: f64 = 1e-12;

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// When bodies `i` and `j` meet, `j`'s record shifted by `turns` box widths; infinite if never.
    #[inline]
    pub(super) fn pair_time(&self, i: usize, j: usize, turns: [i32; D]) -> f64 {
        let s = &self.store;
        let (a, b, sign) = if i < j { (i, j, 1.0) } else { (j, i, -1.0) };
        let (ra, rb) = (&s.bodies.record[a], &s.bodies.record[b]);
        let mut time = if ra.time > rb.time { ra.time } else { rb.time };
        if !s.uniform {
            // Either remembers the last one it waits for: who touches several is remembered by them.
            for (k, other) in [(i, j), (j, i)] {
                time = self.counts_from(k, other as u32, time);
            }
        }
        let ((xa, va), (xb, vb)) = (s.at(a, time), s.at(b, time));
        let mut x = xb - xa;
        if s.any_periodic {
            x += s.widths(turns) * sign;
        }
        let v = vb - va;
        let mut reach = ra.radius + rb.radius;
        if !s.uniform {
            let aside = self.off_path(a) + self.off_path(b);
            if aside > 0.0 && !(-x.dot(v) > STILL * (va.norm() + vb.norm()) * x.norm()) {
                // They part, or keep their distance, but may be nearer than a slice may leave them beside their paths, and one may be stopped: they are looked at
                // again when they may have come half the way.
                let gap = x.norm() - reach;
                let smaller = if ra.radius < rb.radius { ra.radius } else { rb.radius };
                if gap < aside && gap > TOUCHING * smaller {
                    return time + 0.5 * gap / self.closing(time, i, j as u32);
                }
            }
            reach += aside;
        }
        let dt = if s.uniform || s.acceleration(a) == s.acceleration(b) {
            meet::ball_ball(x, v, reach)
        } else {
            let acceleration = s.acceleration(b) - s.acceleration(a);
            meet::ball_ball_accelerated(&Path { position: x, velocity: v, acceleration }, reach)
        };
        if dt != 0.0 {
            return time + dt;
        }
        let relative = if s.uniform { Vector::ZERO } else { s.acceleration(b) - s.acceleration(a) };
        let pressed = -x.dot(relative) > PRESSED * relative.norm() * x.norm();
        if !pressed {
            let smaller = if ra.radius < rb.radius { ra.radius } else { rb.radius };
            return time + creep(-x.dot(v) / x.norm(), va.norm() + vb.norm(), smaller);
        }
        time
    }

    /// When body `i` meets wall `w`; infinite if never. `turns` says how often the body's record has to be taken back round
    /// the box to stand beside the wall.
    pub(super) fn wall_time(&self, i: usize, w: usize, turns: [i32; D]) -> f64 {
        let s = &self.store;
        let (r, wall) = (&s.bodies.record[i], &s.walls[w]);
        // Before it came, or was given this velocity, the wall was not where its motion says.
        let since = if r.time > wall.since { r.time } else { wall.since };
        let time = self.counts_from(i, WALL | w as u32, since);
        let (x, v) = s.at(i, time);
        let mut position = x - wall.shift(time);
        if s.any_periodic {
            position -= s.widths(turns);
        }
        let acceleration = if s.uniform { Vector::ZERO } else { s.acceleration(i) };
        let path = Path { position, velocity: v - wall.velocity, acceleration };
        let dt = wall.shape.meets(&path, r.radius);
        if dt == 0.0 && !wall.shape.curves_in(position, r.radius) {
            // Touching: is it more than a rounding that brings them together?
            let towards = wall.shape.over(position, r.radius).towards;
            let pressed = path.acceleration.dot(towards) > PRESSED * path.acceleration.norm() * towards.norm();
            let closing = path.velocity.dot(towards);
            if !pressed {
                return time + creep(closing / towards.norm(), v.norm() + wall.velocity.norm(), r.radius);
            }
        }
        time + dt
    }

    /// Predicts anew what body `i` meets first, of all that is near it, and schedules it.
    pub(super) fn predict(&mut self, i: usize) {
        self.due[i].next = Next { time: f64::INFINITY, partner: NOTHING, stamp: 0 };
        if !matches!(self.store.bodies.motion[i], Motion::Resting) || self.store.bodies.sensor[i] {
            self.look(i, None);
            self.look_at_walls(i);
            if self.store.bodies.motion[i] == Motion::Held {
                let (time, partner) = self.support_ends(i);
                self.offer(i, time, partner, 0);
                if let Some(grip) = self.grips.get(&(i as u32)) {
                    self.offer(i, grip.end, GRIP_END, 0);
                }
            }
        } else {
            self.look(i, None);
        }
        self.schedule(i);
    }

    /// Looks at the bodies in the cells near `i` (of one layer of cells, if a side is given) and keeps the earliest meeting.
    fn look(&mut self, i: usize, side: Option<(usize, bool)>) {
        let mut best = self.due[i].next;
        if self.is_plain()
            && (self.store.uniform || self.nulls[i].is_none())
            && let Some(found) = self.lean_look(i, side, best)
        {
            self.due[i].next = found;
            return;
        }
        let b = &self.store.bodies;
        // What a body meets after its slice is predicted when the next one starts.
        let beyond = match self.island_of[i] {
            NO_ISLAND => f64::INFINITY,
            k if self.islands[k as usize].resting => f64::INFINITY,
            k => self.islands[k as usize].start + self.islands[k as usize].length,
        };
        self.cells.near(i as u32, side, |j, turns| {
            let j = j as usize;
            if self.kept_apart(i, j) {
                return;
            }
            if b.matter[i].inverse_mass == 0.0 && b.matter[j].inverse_mass == 0.0 && !(b.sensor[i] || b.sensor[j]) {
                return;
            }
            if beyond < f64::INFINITY && self.out_of_reach(i, j, turns, beyond) {
                return;
            }
            let time = self.pair_time(i, j, turns);
            let sooner = time < best.time || time == best.time && (j as u32) < best.partner;
            if !(time < f64::INFINITY) || !sooner || !b.meets(i, j) || self.store.ignores(i, j) {
                return;
            }
            if b.sensor[i] || b.sensor[j] {
                // A sensor's meeting changes no record: what was told already must not be told again.
                let (low, high) = if i < j { (i, j) } else { (j, i) };
                // And who is inside already does not enter.
                let (ti, tj) = (b.record[i].time, b.record[j].time);
                let recorded = if ti > tj { ti } else { tj };
                if time < self.time
                    || time == recorded && recorded > 0.0
                    || self.told.contains(&(low as u32, high as u32, time.to_bits()))
                {
                    return;
                }
            }
            best = Next { time, partner: j as u32, stamp: b.matter[j].stamp };
        });
        self.due[i].next = best;
    }

    /// True if two bodies cannot meet before `end`, at the speeds they have, and by what slices may leave them beside their paths.
    fn out_of_reach(&self, i: usize, j: usize, turns: [i32; D], end: f64) -> bool {
        let s = &self.store;
        let (ra, rb) = (&s.bodies.record[i], &s.bodies.record[j]);
        let time = if ra.time > rb.time { ra.time } else { rb.time };
        let ((xa, va), (xb, vb)) = (s.at(i, time), s.at(j, time));
        let x = xb - xa + s.widths(turns);
        let dt = end - time;
        let way = ((vb - va).norm() + 0.5 * (s.acceleration(j) - s.acceleration(i)).norm() * dt) * dt;
        let aside = self.off_path(i) + self.off_path(j);
        x.norm() > (ra.radius + rb.radius + aside + way) * (1.0 + 1e-9)
    }

    /// How far a slice that is cut short may leave a body beside the path on which it is predicted (m). Whoever comes from outside
    /// is seen so much earlier, and the slice that follows is as short as the way that is left.
    fn off_path(&self, i: usize) -> f64 {
        match self.island_of[i] {
            NO_ISLAND => 0.0,
            k if self.islands[k as usize].resting => 0.0,
            k => {
                let h = self.islands[k as usize].length;
                let planned = self.store.bodies.acceleration[i].norm();
                // Of a body that comes straight at a contact the path is v t until it touches at t', not v t - (v - v') t^2 / h: at most
                // 4/27 v h off, 0.44 (v - v') h.
                (0.5 * self.store.gravity.norm() + 0.25 * planned) * h * h
            }
        }
    }

    /// True if a slice or rest keeps two bodies apart, so that they do not meet as an event.
    fn kept_apart(&self, i: usize, j: usize) -> bool {
        let (ki, kj) = (self.island_of[i], self.island_of[j]);
        if ki == NO_ISLAND && kj == NO_ISLAND {
            return false;
        }
        if ki == kj {
            return true;
        }
        // A fixed body that the slice counts with.
        let near = |k: u32, a: usize, b: usize| {
            k != NO_ISLAND
                && self.store.bodies.matter[b].inverse_mass == 0.0
                && self.islands[k as usize].near.binary_search_by_key(&(a as u32, b as u32), |n| (n.a, n.b)).is_ok()
        };
        near(ki, i, j) || near(kj, j, i)
    }

    pub(super) fn offer(&mut self, i: usize, time: f64, partner: u32, stamp: u32) {
        let best = &mut self.due[i].next;
        if time < best.time || time == best.time && time < f64::INFINITY && partner < best.partner {
            *best = Next { time, partner, stamp };
        }
    }

    pub(super) fn look_at_walls(&mut self, i: usize) {
        if self.store.bodies.matter[i].inverse_mass == 0.0 || self.store.bodies.sensor[i] {
            return;
        }
        let wraps = self.cells.place(i as u32).wraps;
        for k in 0..self.everywhere.len() {
            let w = self.everywhere[k] as usize;
            if self.misses_plane(i, w) || self.supports(i, w) {
                continue;
            }
            if !self.store.any_periodic || matches!(self.store.walls[w].shape, Shape::Plane { .. }) {
                let time = self.wall_time(i, w, [0; D]);
                self.offer(i, time, WALL | w as u32, 0);
                continue;
            }
            // A ball near the edge of the box touches what lies beyond it.
            let mut offset = [0i32; D];
            for code in 0..3usize.pow(D as u32) {
                let mut rest = code;
                let mut wanted = true;
                for k in 0..D {
                    offset[k] = (rest % 3) as i32 - 1;
                    rest /= 3;
                    wanted &= self.store.periodic[k] || offset[k] == 0;
                }
                if wanted {
                    let time = self.wall_time(i, w, core::array::from_fn(|k| wraps[k] + offset[k]));
                    self.offer(i, time, WALL | w as u32, 0);
                }
            }
        }
        for k in 0..self.cells.walls(i as u32).len() {
            let w = self.cells.walls(i as u32)[k] as usize;
            if !self.supports(i, w) {
                let time = self.wall_time(i, w, [0; D]);
                self.offer(i, time, WALL | w as u32, 0);
            }
        }
    }

    /// True if a body cannot meet a plane before its next meeting, or never will: it is too far away, or moves uniformly and not towards
    /// it.
    #[inline(always)]
    fn misses_plane(&self, i: usize, w: usize) -> bool {
        let (s, wall) = (&self.store, &self.store.walls[w]);
        let Shape::Plane { point, normal } = &wall.shape else { return false };
        let r = &s.bodies.record[i];
        let speed = (r.v - wall.velocity).dot(*normal);
        if s.uniform && !(speed < 0.0) {
            return true;
        }
        if s.any_periodic || !self.nulls[i].is_none() {
            return false;
        }
        let height = (r.x - wall.shift(r.time) - *point).dot(*normal) - r.radius;
        let dt = self.due[i].next.time - r.time;
        let pull = if s.uniform { 0.0 } else { 0.5 * s.acceleration(i).dot(*normal) };
        let down = |x: f64| if x < 0.0 { -x } else { 0.0 };
        // With room for the rounding of places and times.
        height > (down(speed) + down(pull) * dt) * dt * (1.0 + 1e-6) + 1e-6 * r.radius
    }

    /// Puts the earlier of a body's next meeting and its next crossing into the queue, under a new stamp.
    pub(super) fn schedule(&mut self, i: usize) {
        self.due[i].turn = self.due[i].turn.wrapping_add(1);
        let next = self.due[i].next;
        let crossing = if self.lists.on {
            if self.stays_at_anchor(i, next.time) { f64::INFINITY } else { self.leaves_anchor(i) }
        } else {
            let (crossing, axis, up) = self.crossing(i);
            self.due[i].crossing = (axis as u8) << 1 | up as u8;
            crossing
        };
        let (time, partner) = if crossing <= next.time { (crossing, CROSSING) } else { (next.time, next.partner) };
        if time < f64::INFINITY {
            self.queue.push(Entry { time, owner: i as u32, partner, stamp: self.due[i].turn });
        }
    }

    /// When a body leaves its cell, along which axis, and whether upwards.
    fn crossing(&self, i: usize) -> (f64, usize, bool) {
        let s = &self.store;
        let mut first = (f64::INFINITY, 0, false);
        if self.cells.len() == 1 && !s.any_periodic {
            return first;
        }
        let r = &s.bodies.record[i];
        // The time from which the cell counts: the record's, or that of the last crossing.
        let now = if r.time > self.time { r.time } else { self.time };
        let (x, v) = s.at(i, now);
        if s.uniform {
            let (dt, axis, up) = self.cells.exit(i as u32, x, v);
            return (now + dt, axis, up);
        }
        let a = s.acceleration(i);
        for k in 0..D {
            let (low, high) = self.cells.interval(i as u32, k);
            let dt = meet::exit(x[k], v[k], a[k], low, high);
            if now + dt < first.0 {
                let (there, speed) = (x[k] + (v[k] + a[k] * (0.5 * dt)) * dt, v[k] + a[k] * dt);
                // Which of the two edges it is: the one it moves towards; at a turning point, the nearer one.
                let up = if speed == 0.0 { (high - there).abs_() < (there - low).abs_() } else { speed > 0.0 };
                first = (now + dt, k, up);
            }
        }
        first
    }

    /// A body crosses into the next cell: who is new beside it? True if it might do so for ever: it went once round the box, or
    /// left the place where its list was made.
    pub(super) fn cross(&mut self, i: usize) -> bool {
        let (axis, up) = ((self.due[i].crossing >> 1) as usize, self.due[i].crossing & 1 == 1);
        self.crossed += 1;
        let mut round = self.lists.on;
        if self.lists.on {
            self.anchor_anew(i);
            if self.wrapped_walls {
                self.look_at_walls(i);
            }
        } else if self.cells.cross(i as u32, axis, up) {
            round = self.store.periodic[axis] && self.cells.has_come_round(i as u32, axis, up);
            self.look(i, Some((axis, up)));
            if !self.cells.walls(i as u32).is_empty() || self.wrapped_walls {
                self.look_at_walls(i);
            }
        }
        if round {
            self.broken |= is_beyond(&self.cells.place(i as u32).wraps);
        }
        self.schedule(i);
        round
    }

    /// When a held body comes to the end of a support; infinite if it does not.
    fn support_ends(&self, i: usize) -> (f64, u32) {
        let s = &self.store;
        let r = &s.bodies.record[i];
        let mut first = f64::INFINITY;
        for &w in self.held.get(&(i as u32)).map_or(&[][..], |walls| walls) {
            let wall = &s.walls[w as usize];
            let path = Path {
                position: r.x - wall.shift(r.time),
                velocity: r.v - wall.velocity,
                acceleration: s.acceleration(i),
            };
            let dt = match &wall.shape {
                Shape::Segment { from, to } => {
                    let along = *to - *from;
                    meet::exit(
                        (path.position - *from).dot(along),
                        path.velocity.dot(along),
                        path.acceleration.dot(along),
                        0.0,
                        along.norm_squared(),
                    )
                }
                Shape::Triangle(corners) => {
                    let mut dt = f64::INFINITY;
                    for k in 0..3 {
                        // The edge's inward direction in the triangle's plane: the part of the third corner across the edge.
                        let (a, b, c) = (corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
                        let edge = b - a;
                        let inward = (c - a) - edge * ((c - a).dot(edge) / edge.norm_squared());
                        let leave = meet::exit(
                            (path.position - a).dot(inward),
                            path.velocity.dot(inward),
                            path.acceleration.dot(inward),
                            0.0,
                            f64::INFINITY,
                        );
                        dt = if leave < dt { leave } else { dt };
                    }
                    dt
                }
                Shape::Plane { .. } | Shape::Arc(_) => f64::INFINITY,
            };
            if r.time + dt < first {
                first = r.time + dt;
            }
        }
        (first, SUPPORT_END)
    }
}
