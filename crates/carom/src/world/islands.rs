//! Which bodies move by slices together: islands form, merge, split, come to rest and are left again.
use alloc::collections::BTreeMap;
use alloc::{vec, vec::Vec};

use super::calendar::Entry;
use super::instant::TOUCHING;
use super::predict::STILL;
use super::slices::{Effort, GAP_ERROR, Island, MANY, NO_ISLAND, Near, REST_TOLERANCE, SLICE, larger};
use super::store::{Motion, Store};
use super::support::{REST_EPS, held_acceleration};
use super::{ISLAND, SLICE_END, WALL, World};
use crate::vector::Exact;
use crate::{Rotates, Vector};

/// An island is at rest when gravity's projection onto its feasible velocities is below this part of gravity: static
/// equilibrium, up to the solver's accuracy.
pub const EQUILIBRIUM: f64 = 1e-9;

/// Islands of more bodies than this take in, at the start of a slice, what would hit them before its end, and so see impacts up
/// to a slice early. Smaller ones are cut at the very time of the impact.
const EXACT_ISLAND: usize = 16;

/// Who is not further from its partner than this part of its radius when the slice ends has not left it.
const HARDLY: f64 = 1e-6;

/// No slice is planned shorter than this (s).
const SHORTEST_SLICE: f64 = 1e-9;

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// A slice ends.
    pub(super) fn slice_end(&mut self, time: f64, k: usize) {
        self.time = larger(time, self.time);
        self.events += 1;
        let bodies = self.dissolve(k, time);
        self.regroup(time, bodies);
    }

    /// Bodies that part or close slower than this (m/s) may join an island, and those that part faster leave it. At least twice
    /// the speed that gravity gives in a slice: a slice gives it at once, so that what touches an island, and parts more slowly,
    /// would seem to be run into.
    fn slow(&self) -> f64 {
        larger(2.0 * self.rest_speed, 2.0 * self.store.gravity.norm() * SLICE)
    }

    /// Takes a body into the slices at `time`: its record is written, whatever held it so far is forgotten. Returns the bodies
    /// that come with it.
    pub(super) fn enlist_slice(&mut self, j: usize, time: f64) -> Vec<u32> {
        let k = self.island_of[j];
        if k != NO_ISLAND {
            return self.dissolve(k as usize, time);
        }
        if self.store.bodies.motion[j] != Motion::Sliced {
            let (x, v) = self.store.at(j, time);
            self.write(j, time, x, v);
            self.set_motion(j, Motion::Sliced);
            self.store.bodies.acceleration[j] = Vector::ZERO;
        }
        vec![j as u32]
    }

    /// Takes a body, and all that moves with it, into the group that is being made.
    fn join(&mut self, j: u32, time: f64, places: &mut BTreeMap<u32, usize>, list: &mut Vec<u32>) {
        for b in self.enlist_slice(j as usize, time) {
            places.entry(b).or_insert_with(|| {
                list.push(b);
                list.len() - 1
            });
        }
    }

    /// Groups bodies that belong to the slices, whose records stand at `time`, into islands, with all that is near enough to
    /// touch them within a slice. Those that nothing holds go back to the events.
    pub(super) fn regroup(&mut self, time: f64, seeds: Vec<u32>) {
        let mut places: BTreeMap<u32, usize> = BTreeMap::new();
        let mut list: Vec<u32> = Vec::new();
        for i in seeds {
            if places.insert(i, list.len()).is_none() {
                list.push(i);
            }
        }
        let g = self.store.gravity.norm();
        let reach = self.slice_reach();
        let mut near: Vec<Near<D>> = Vec::new();
        let mut links: Vec<(u32, u32)> = Vec::new();
        // The longest slice in which nobody can leave the neighbourhood that is looked at.
        let mut length = SLICE;
        let mut at = 0;
        while at < list.len() {
            let i = list[at];
            at += 1;
            let speed = self.store.bodies.record[i as usize].v.norm();
            let longest = reach / (2.0 * speed + 2.0 * g * SLICE);
            length = if longest < length { longest } else { length };
            let mut found: Vec<(u32, [i32; D])> = Vec::new();
            let x = self.store.bodies.record[i as usize].x;
            let s = &self.store;
            let away = |s: &Store<D>, j: u32, turns: [i32; D]| {
                let d = s.at(j as usize, time).0 - x;
                if s.any_periodic { d + s.widths(turns) } else { d }
            };
            self.cells.near(i, None, |j, turns| {
                let far = s.bodies.record[i as usize].radius + s.bodies.record[j as usize].radius + 2.0 * reach;
                if away(s, j, turns).norm_squared() < far * far && s.collide(i as usize, j as usize) {
                    found.push((j, turns));
                }
            });
            found.sort_unstable_by_key(|f| f.0);
            for (j, turns) in found {
                let fixed = self.store.bodies.matter[j as usize].inverse_mass == 0.0;
                if self.island_of[j as usize] != NO_ISLAND && !places.contains_key(&j) {
                    // Where it is, the end of its own slice says.
                    self.join(j, time, &mut places, &mut list);
                }
                let d = away(&self.store, j, turns);
                let distance = d.norm();
                let normal = if distance > 0.0 { d / distance } else { Vector::axis(0) };
                let (ri, rj) =
                    (self.store.bodies.record[i as usize].radius, self.store.bodies.record[j as usize].radius);
                let gap = distance - (ri + rj);
                let touches = gap <= TOUCHING * if ri < rj { ri } else { rj };
                let member = places.contains_key(&j);
                let approach = (self.store.bodies.record[i as usize].v - self.store.at(j as usize, time).1).dot(normal);
                let slow = approach.abs_() <= larger(self.slow(), STILL * speed);
                let touches = touches || gap <= g * SLICE * SLICE;
                if !fixed && !member {
                    // In a large island every cut costs the whole of it: it takes in what would hit it within the slice.
                    let soon = list.len() > EXACT_ISLAND && gap < (approach + g * SLICE) * SLICE;
                    // Who parts from it already may be hit again by what the slice does to the island.
                    let joins = soon || touches || slow && self.rest_speed > 0.0;
                    if !joins {
                        // It comes from outside: the slice ends about when it arrives.
                        let arrives = 1.05 * (if gap > 0.0 { gap } else { 0.0 }) / approach;
                        if approach > 0.0 && arrives < length {
                            length = larger(larger(arrives, SHORTEST_SLICE), 4.0 * f64::EPSILON * time);
                        }
                        continue;
                    }
                    self.join(j, time, &mut places, &mut list);
                }
                if fixed {
                    near.push(Near { a: i, b: j, normal, gap, inside: None });
                } else {
                    // Seen from both sides, if both were members by then; from one at least.
                    let (a, b, normal) = if i < j { (i, j, normal) } else { (j, i, -normal) };
                    near.push(Near { a, b, normal, gap, inside: None });
                    links.push((a, b));
                }
            }
            self.near_walls(i as usize, time, 2.0 * reach, SLICE, &mut near);
        }
        near.sort_unstable_by_key(|n| (n.a, n.b));
        near.dedup_by_key(|n| (n.a, n.b));
        let (groups, place) = components(&list, &links);
        let mut shares: Vec<Vec<Near<D>>> = groups.iter().map(|_| Vec::new()).collect();
        for n in near {
            shares[place[&n.a]].push(n);
        }
        for (bodies, near) in groups.into_iter().zip(shares) {
            self.install(time, bodies, near, length);
        }
        self.warm.clear();
        self.warm_drag.clear();
    }

    /// Starts a slice for one island, or lets it rest, or lets it go.
    fn install(&mut self, time: f64, bodies: Vec<u32>, near: Vec<Near<D>>, length: f64) {
        let lambda = near.iter().map(|n| self.warm.get(&(n.a, n.b)).copied().unwrap_or(0.0) * length).collect();
        let drag = match self.store.rough() {
            true => near.iter().map(|n| self.warm_drag.get(&(n.a, n.b)).copied().unwrap_or_default()).collect(),
            false => Vec::new(),
        };
        let drag = drag.into_iter().map(|(impulse, moment)| (impulse * length, moment * length)).collect();
        let before: Vec<Vector<D>> = bodies.iter().map(|&i| self.store.bodies.record[i as usize].v).collect();
        let mut island =
            Island { bodies, near, lambda, drag, start: time, length, before, alive: true, ..Island::empty() };
        if self.rests_here(&mut island) {
            self.lay_down(time, island);
            return;
        }
        self.bounce_first(time, &mut island);
        let reach = self.slice_reach();
        let mut solved = loop {
            let solved = self.solve_slice(&island, island.length);
            let far = solved.v.iter().map(|v| v.norm()).fold(0.0, larger) * island.length;
            if !(far > reach) {
                break solved;
            }
            // Someone was thrown further than was looked: a shorter slice.
            island.length *= 0.5;
            island.lambda.fill(0.0);
            island.drag.clear();
        };
        // A body that is further than its own size between two neighbouring numbers of the clock: nobody can tell whom it meets.
        self.broken |= !(time + island.length > time);
        island.lambda = solved.lambda.clone();
        // Whoever no contact holds, and who leaves all of them, goes back to the events; the others' slice is the same without.
        let velocity = |code: u32| match island.bodies.binary_search(&code) {
            Ok(k) => solved.v[k],
            Err(_) => self.immovable(code).unwrap_or_default(),
        };
        let idle = solved.lambda.iter().all(|&l| !(l > 0.0));
        let mut stays = vec![false; island.bodies.len()];
        if !idle {
            for (n, &lambda) in island.near.iter().zip(&island.lambda) {
                let opens = (velocity(n.b) - velocity(n.a)).dot(n.normal) > self.slow() && !self.stays_near(n, &island);
                if lambda > 0.0 || !opens {
                    for code in [n.a, n.b] {
                        if let Ok(k) = island.bodies.binary_search(&code) {
                            stays[k] = true;
                        }
                    }
                }
            }
        }
        for n in &island.near {
            if let Ok(k) = island.bodies.binary_search(&n.a)
                && self.clings(n, island.before[k])
            {
                stays[k] = true;
            }
        }
        if stays.contains(&false) {
            let keep = |code: u32| island.bodies.binary_search(&code).map_or(true, |k| stays[k]);
            let kept: Vec<bool> = island.near.iter().map(|n| keep(n.a) && keep(n.b)).collect();
            let leaving: Vec<u32> = island.bodies.iter().copied().filter(|&i| !keep(i)).collect();
            let after: Vec<Vector<D>> = (0..stays.len()).filter(|&k| stays[k]).map(|k| solved.v[k]).collect();
            // The plan is that of the others, less what gravity alone did to those who leave.
            for k in (0..stays.len()).filter(|&k| !stays[k]) {
                let i = island.bodies[k] as usize;
                let m = self.store.bodies.matter[i].mass;
                let weight = self.store.gravity * -(m * island.length);
                solved.momentum += weight;
                solved.moment += Vector::<D>::moment(self.store.bodies.record[i].x, weight);
                solved.lost -= 0.5 * m * (solved.v[k] - island.before[k]).norm_squared();
            }
            retain(&mut solved.x, &stays);
            retain(&mut solved.v, &stays);
            retain(&mut solved.spin, &stays);
            retain(&mut solved.lambda, &kept);
            retain(&mut island.near, &kept);
            retain(&mut island.lambda, &kept);
            for drag in [&mut island.drag, &mut solved.drag] {
                if !drag.is_empty() {
                    retain(drag, &kept);
                }
            }
            retain(&mut island.before, &stays);
            retain(&mut island.bodies, &stays);
            for &i in &leaving {
                self.set_motion(i as usize, Motion::Free);
            }
            if !island.bodies.is_empty() {
                island.planned = Some(solved);
                self.start(time, island, &after);
            }
            for i in leaving {
                self.predict(i as usize);
            }
            return;
        }
        if island.bodies.len() == 1 && self.hold(time, &island) {
            return;
        }
        let after = solved.v.clone();
        island.planned = Some(solved);
        self.start(time, island, &after);
    }

    /// True for a ball inside an arc that its speed presses against it, though a slice, which gives it the whole of its gravity
    /// at once, would let go: on its free path it would hit the arc again at once, and again.
    fn clings(&self, n: &Near<D>, v: Vector<D>) -> bool {
        let Some((centre, limit)) = n.inside else { return false };
        let g = self.store.gravity;
        let out = self.store.bodies.record[n.a as usize].x - centre;
        let out = out / larger(out.norm(), f64::MIN_POSITIVE);
        let along = v - out * v.dot(out);
        n.gap <= 4.0 * g.norm() * SLICE * SLICE && along.norm_squared() / limit + g.dot(out) > 0.0
    }

    /// How fast a party of an island goes as the slice begins (m/s).
    fn velocity_before(&self, island: &Island<D>, code: u32) -> Vector<D> {
        match island.bodies.binary_search(&code) {
            Ok(k) => island.before[k],
            Err(_) => self.immovable(code).unwrap_or_default(),
        }
    }

    /// True if two part so slowly as the slice begins that they do not get away, though the slice as planned opens the contact later on: with
    /// one of them back among the events, they would be looked at again and again, at distances that no slice can tell, and if they
    /// overlap they would sink a little with each hop that cuts the slice short.
    fn stays_near(&self, n: &Near<D>, island: &Island<D>) -> bool {
        let velocity = |code: u32| self.velocity_before(island, code);
        let parts = (velocity(n.b) - velocity(n.a)).dot(n.normal);
        let near = HARDLY * self.store.bodies.record[n.a as usize].radius;
        n.gap < 0.0 && parts.abs_() * parts < -2.0 * self.store.gravity.norm() * n.gap
            || n.gap + parts * island.length < near
    }

    /// Contacts of an island that close within the slice, faster than rest, are impacts: each with its own restitution, all
    /// together, at the slice's start. So an island sees the clock in steps of a slice, and what happens inside it is bounded.
    fn bounce_first(&mut self, time: f64, island: &mut Island<D>) {
        let velocity = |code: u32| self.velocity_before(island, code);
        let scale = island.before.iter().map(|v| v.norm()).fold(0.0, larger);
        // In a heap gravity, which a slice gives at once, makes contacts close by as much as that: it is no impact, and plastic.
        let heap = island.near.len() > MANY && !self.store.weightless;
        let least = larger(if heap { self.slow() } else { self.rest_speed }, 1e-9 * scale);
        let mut fastest = 0.0;
        for n in &island.near {
            let approach = (velocity(n.a) - velocity(n.b)).dot(n.normal);
            if approach > least && n.gap < approach * island.length {
                fastest = larger(fastest, approach);
            }
        }
        if !(fastest > 0.0) {
            return;
        }
        // With them, all that could take part in the same slice.
        let set: Vec<(u32, u32)> =
            island.near.iter().filter(|n| n.gap < fastest * island.length).map(|n| (n.a, n.b)).collect();
        self.bounce(time, &set, least);
        for (k, &i) in island.bodies.iter().enumerate() {
            island.before[k] = self.store.bodies.record[i as usize].v;
        }
    }

    /// Puts an island that is solved into the store and its end into the queue, and predicts what its bodies meet.
    fn start(&mut self, time: f64, mut island: Island<D>, after: &[Vector<D>]) {
        let k = match self.free_islands.pop() {
            Some(k) => k as usize,
            None => {
                self.islands.push(Island::empty());
                self.islands.len() - 1
            }
        };
        // From now on records have accelerations of their own, gravity or not.
        self.store.uniform = false;
        self.island_turn += 1;
        island.stamp = self.island_turn;
        let (end, stamp) = (time + island.length, island.stamp);
        let bodies = island.bodies.clone();
        for (m, &i) in bodies.iter().enumerate() {
            let i = i as usize;
            // The path that the slice takes for every length at which the same contacts press: x + v t + (v' - v) t^2 / h.
            self.store.bodies.acceleration[i] = (after[m] - island.before[m]) * (2.0 / island.length);
            self.island_of[i] = k as u32;
            // Those of another island may have looked at it already, as it was without a plan.
            self.store.bodies.matter[i].stamp = self.store.bodies.matter[i].stamp.wrapping_add(1);
            // Sorted, and walls come last.
            let end = island.near.partition_point(|n| n.a <= i as u32);
            let walls = island.near[..end].iter().rev().take_while(|n| n.a == i as u32 && n.b & WALL != 0);
            let mut walls: Vec<u32> = walls.map(|n| n.b & !WALL).collect();
            walls.reverse();
            self.held.insert(i as u32, walls);
        }
        self.islands[k] = island;
        self.queue.push(Entry { time: end, owner: ISLAND | k as u32, partner: SLICE_END, stamp });
        for i in bodies {
            self.predict(i as usize);
        }
    }

    /// One ball on flat walls needs no slices: it rests, or slides in a parabola.
    fn hold(&mut self, time: f64, island: &Island<D>) -> bool {
        let i = island.bodies[0] as usize;
        let radius = self.store.bodies.record[i].radius;
        let mut walls = Vec::new();
        let mut normals = Vec::new();
        for (n, &lambda) in island.near.iter().zip(&island.lambda) {
            let flat = n.b & WALL != 0 && self.flat(i, (n.b & !WALL) as usize, time);
            if lambda > 0.0 && !(flat && n.gap.abs_() <= 100.0 * TOUCHING * radius) {
                return false;
            }
            if lambda > 0.0 {
                walls.push(n.b & !WALL);
                normals.push(-n.normal);
            }
        }
        // Friction on one wall may press the ball against what it touches beside it, or just not.
        let touching = island.near.iter().filter(|n| n.gap <= 100.0 * TOUCHING * radius).count();
        if touching > 1 && walls.iter().any(|&w| self.rubs(i, w as usize)) {
            return false;
        }
        let mut pressing = Vec::new();
        let a = held_acceleration(self.store.gravity, &normals, &mut pressing);
        if walls.is_empty() || !pressing.iter().all(|p| *p) {
            return false;
        }
        let (x, v) = (self.store.bodies.record[i].x, self.store.bodies.record[i].v);
        let spin = self.store.bodies.spin[i];
        self.hold_by(i, time, x, (v, spin), &walls, &normals, a);
        self.predict(i);
        true
    }

    /// True if nothing moves and gravity's projection onto the feasible velocities is zero.
    fn rests_here(&mut self, island: &mut Island<D>) -> bool {
        let still = |v: &Vector<D>| v.norm() < REST_EPS;
        let driven = |n: &Near<D>| {
            let velocity = if n.b & WALL != 0 {
                self.store.walls[(n.b & !WALL) as usize].velocity
            } else if self.store.bodies.matter[n.b as usize].inverse_mass == 0.0 {
                self.store.bodies.record[n.b as usize].v
            } else {
                Vector::ZERO
            };
            velocity != Vector::ZERO
        };
        if !island.before.iter().all(still) || island.near.iter().any(driven) {
            return false;
        }
        let g = self.store.gravity.norm();
        let mut trial = island.clone();
        trial.before.fill(Vector::ZERO);
        // A contact that is as good as closed holds; one that is still open does not yet. Sweeps leave gaps of their own.
        let closed = if island.near.len() > MANY { 4.0 * GAP_ERROR } else { TOUCHING };
        for n in &mut trial.near {
            let radius = self.store.bodies.record[n.a as usize].radius;
            if n.gap <= closed * radius {
                n.gap = 0.0;
            }
        }
        let solved = self.solve_slice_by(&trial, trial.length, Effort::Factor(REST_TOLERANCE));
        let mut moves = solved.v.iter().map(|v| v.norm()).fold(0.0, larger);
        if self.store.rough() {
            for (w, &i) in solved.spin.iter().zip(&island.bodies) {
                let radius = self.store.bodies.record[i as usize].radius;
                let turned = *w - self.store.bodies.spin[i as usize];
                moves = larger(moves, Vector::<D>::spin_dot(turned, turned).sqrt_() * radius);
            }
        }
        let rests = moves < EQUILIBRIUM * g * trial.length;
        if rests {
            island.lambda = solved.lambda;
            island.drag = solved.drag;
        }
        rests
    }

    /// The island comes to rest: its last speeds are set to nothing, and booked.
    fn lay_down(&mut self, time: f64, mut island: Island<D>) {
        let k = match self.free_islands.pop() {
            Some(k) => k as usize,
            None => {
                self.islands.push(Island::empty());
                self.islands.len() - 1
            }
        };
        for &i in &island.bodies {
            let i = i as usize;
            let (x, v) = (self.store.bodies.record[i].x, self.store.bodies.record[i].v);
            // A spin that nothing rubs against goes on for ever and moves nothing.
            let (spin, radius) = (self.store.bodies.spin[i], self.store.bodies.record[i].radius);
            let slow = self.store.rough() && Vector::<D>::spin_dot(spin, spin).sqrt_() * radius < REST_EPS;
            let still = if slow { Default::default() } else { spin };
            self.book_change(i, x, (v, spin), (Vector::ZERO, still), Vector::ZERO);
            self.write_turning(i, time, x, Vector::ZERO, still);
            self.store.bodies.acceleration[i] = Vector::ZERO;
            self.island_of[i] = k as u32;
            self.set_motion(i, Motion::Resting);
        }
        island.resting = true;
        self.island_turn += 1;
        island.stamp = self.island_turn;
        let bodies = island.bodies.clone();
        self.islands[k] = island;
        for i in bodies {
            self.predict(i as usize);
        }
    }

    /// Before an event of bodies in slices: ends their slices at the event's time. If the other party is found to overlap there
    /// (the slice cut short ends a little beside the path that was predicted), at the time a little earlier when they touch.
    /// Returns the time, and the bodies to be grouped anew.
    pub(super) fn cut(&mut self, time: f64, i: usize, partner: u32) -> (f64, Vec<u32>) {
        let islands: Vec<u32> = [Some(i), (partner & WALL == 0).then_some(partner as usize)]
            .into_iter()
            .flatten()
            .map(|b| self.island_of[b])
            .filter(|&k| k != NO_ISLAND)
            .collect();
        let mut islands = islands;
        islands.sort_unstable();
        islands.dedup();
        islands.retain(|&k| !self.islands[k as usize].resting);
        if islands.is_empty() {
            return (time, Vec::new());
        }
        let time = self.first_touch(time, i, partner, &islands);
        let mut bodies = Vec::new();
        for k in islands {
            bodies.extend(self.dissolve(k as usize, time));
        }
        (time, bodies)
    }

    fn first_touch(&mut self, time: f64, i: usize, partner: u32, islands: &[u32]) -> f64 {
        let mut earliest = 0.0;
        for b in [Some(i), (partner & WALL == 0).then_some(partner as usize)].into_iter().flatten() {
            earliest = larger(earliest, self.store.bodies.record[b].time);
            earliest = self.counts_from(b, if b == i { partner } else { i as u32 }, earliest);
        }
        for &k in islands {
            earliest = larger(earliest, self.islands[k as usize].start);
        }
        let radius = self.store.bodies.record[i].radius;
        let tolerance = 0.5 * TOUCHING * radius;
        let (mut low, mut high) = (earliest, time);
        let mut gap = self.gap_at(time, i, partner, islands);
        if !(gap < -tolerance) || !(low < high) {
            return time;
        }
        let mut below = self.gap_at(low, i, partner, islands);
        let mut above = gap;
        // Regula falsi with halving: the gap falls nearly uniformly over so short a time.
        for round in 0..60 {
            if !(below >= -tolerance) {
                return low;
            }
            // They may touch when the slice starts, part, and meet again.
            let fraction = if round % 3 == 2 || !(below > tolerance) { 0.5 } else { below / (below - above) };
            let middle = low + (high - low) * fraction;
            if !(middle > low && middle < high) {
                return low;
            }
            gap = self.gap_at(middle, i, partner, islands);
            if gap.abs_() <= tolerance {
                return middle;
            }
            if gap > 0.0 {
                (low, below) = (middle, gap);
            } else {
                (high, above) = (middle, gap);
            }
        }
        low
    }

    /// The gap (m) between a body and its partner at a time, the slices of these islands solved up to it.
    fn gap_at(&mut self, time: f64, i: usize, partner: u32, islands: &[u32]) -> f64 {
        let position = |world: &mut Self, b: usize| {
            let k = world.island_of[b];
            if k == NO_ISLAND || !islands.contains(&k) {
                return world.store.at(b, time).0;
            }
            let island = core::mem::replace(&mut world.islands[k as usize], Island::empty());
            let solved = world.solve_slice(&island, time - island.start);
            let m = island.bodies.binary_search(&(b as u32)).expect("a member of its island");
            world.islands[k as usize] = island;
            solved.x[m]
        };
        let x = position(self, i);
        let radius = self.store.bodies.record[i].radius;
        if partner & WALL != 0 {
            let x = self.store.wrapped(x, self.store.turns(x));
            return self.store.walls[(partner & !WALL) as usize].over(time, x, radius).gap;
        }
        let other = position(self, partner as usize);
        self.store.nearest_image(other - x).norm() - radius - self.store.bodies.record[partner as usize].radius
    }
}

/// Keeps what is marked.
fn retain<T>(list: &mut Vec<T>, marks: &[bool]) {
    let mut k = 0;
    list.retain(|_| {
        k += 1;
        marks[k - 1]
    });
}

/// The connected components of `bodies` under `links`, each sorted, in the order of their first bodies, and for each body the
/// number of its component.
fn components(bodies: &[u32], links: &[(u32, u32)]) -> (Vec<Vec<u32>>, BTreeMap<u32, usize>) {
    let mut sorted = bodies.to_vec();
    sorted.sort_unstable();
    let place = |i: u32| sorted.binary_search(&i).expect("a listed body");
    let mut root: Vec<usize> = (0..sorted.len()).collect();
    fn find(root: &mut [usize], mut k: usize) -> usize {
        while root[k] != k {
            root[k] = root[root[k]];
            k = root[k];
        }
        k
    }
    for &(a, b) in links {
        let (a, b) = (find(&mut root, place(a)), find(&mut root, place(b)));
        // The smaller place is the root, so that the order of the links does not show.
        if a < b {
            root[b] = a;
        } else {
            root[a] = b;
        }
    }
    let mut numbers = vec![usize::MAX; sorted.len()];
    let mut groups: Vec<Vec<u32>> = Vec::new();
    let mut of = BTreeMap::new();
    for k in 0..sorted.len() {
        let r = find(&mut root, k);
        if numbers[r] == usize::MAX {
            numbers[r] = groups.len();
            groups.push(Vec::new());
        }
        groups[numbers[r]].push(sorted[k]);
        of.insert(sorted[k], numbers[r]);
    }
    (groups, of)
}
