//! Lasting contact of one ball with walls: it rests, or slides in a parabola, until something hits it or the support ends.
use super::instant::{Instant, Member};
use super::store::Motion;
use super::{WALL, World};
use crate::wall::Shape;
use crate::{Rotates, Vector};
use alloc::vec::Vec;

/// Speeds below this (m/s) are rest, where nothing accelerates the body any more, whatever `rest_speed` is: a micrometre a second,
/// a ten-thousandth of [`super::REST_SPEED`]. Without friction what creeps in a heap has nothing else to stop it: a sphere that the last
/// contact let go at 1e-8 m/s would reach its neighbour after a week.
pub const REST_EPS: f64 = 1e-6;

/// Contacts that part or close slower than this (m/s) at an instant whose bodies move at `scale` (m/s) move together: what the
/// operators leave of zero (they are good to 1e-13), and far below what any scene can mean.
pub(super) fn still_speed(scale: f64) -> f64 {
    1e-12 * scale + 1e-15
}

/// What is left of the acceleration `g` where walls with these unit normals (away from the wall) hold a body: the vector
/// nearest to `g` that points into no wall. `pressing` says for each wall whether the body presses on it.
///
/// At most `D` walls press at a time: all sets of so many are tried, and the one that satisfies the conditions of optimality
/// (no pull, no push into a wall) is the answer, which is unique.
pub(super) fn held_acceleration<const D: usize>(
    g: Vector<D>,
    normals: &[Vector<D>],
    pressing: &mut Vec<bool>,
) -> Vector<D> {
    pressing.clear();
    pressing.resize(normals.len(), false);
    let weight = g.norm();
    let tolerance = 1e-12 * weight;
    let feasible = |a: Vector<D>| normals.iter().all(|n| n.dot(a) >= -tolerance);
    if feasible(g) {
        return g;
    }
    let count = normals.len().min(16);
    for size in 1..=D.min(count) {
        for subset in 0u32..1 << count {
            if subset.count_ones() as usize != size {
                continue;
            }
            let chosen: Vec<Vector<D>> = (0..count).filter(|k| subset >> k & 1 == 1).map(|k| normals[k]).collect();
            let Some((a, pushes)) = without(g, &chosen, size == D) else { continue };
            if pushes.iter().all(|&p| p > 0.0) && feasible(a) {
                for (k, presses) in pressing.iter_mut().enumerate() {
                    *presses = subset >> k & 1 == 1;
                }
                return a;
            }
        }
    }
    pressing.fill(true);
    Vector::ZERO
}

/// `g` without its part in the span of these normals, and the coefficients of that part taken away. `None` if they are
/// (nearly) dependent. If the normals span the whole space nothing is left, exactly.
fn without<const D: usize>(g: Vector<D>, normals: &[Vector<D>], whole: bool) -> Option<(Vector<D>, Vec<f64>)> {
    // Gram-Schmidt, then back: at most three vectors.
    let mut axes: Vec<Vector<D>> = Vec::new();
    let mut triangle: Vec<Vec<f64>> = Vec::new();
    for n in normals {
        let mut rest = *n;
        let mut row = Vec::new();
        for axis in &axes {
            let part = rest.dot(*axis);
            row.push(part);
            rest -= *axis * part;
        }
        let length = rest.norm();
        if !(length > 1e-9) {
            return None;
        }
        row.push(length);
        axes.push(rest / length);
        triangle.push(row);
    }
    let parts: Vec<f64> = axes.iter().map(|axis| -g.dot(*axis)).collect();
    // normals[k] = sum_j triangle[k][j] axes[j], and sum_k push_k normals[k] = sum_j parts[j] axes[j].
    let mut pushes = parts.clone();
    for j in (0..normals.len()).rev() {
        for k in j + 1..normals.len() {
            pushes[j] -= pushes[k] * triangle[k][j];
        }
        pushes[j] /= triangle[j][j];
    }
    let mut left = g;
    for axis in &axes {
        left -= *axis * left.dot(*axis);
    }
    Some((if whole { Vector::ZERO } else { left }, pushes))
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// True if wall `w` holds body `i`.
    #[inline]
    pub(super) fn supports(&self, i: usize, w: usize) -> bool {
        self.store.bodies.motion[i] != Motion::Free
            && self.held.get(&(i as u32)).is_some_and(|walls| walls.contains(&(w as u32)))
    }

    pub(super) fn set_motion(&mut self, i: usize, motion: Motion) {
        let resting = |m: Motion| matches!(m, Motion::Resting | Motion::Fixed);
        let old = self.store.bodies.motion[i];
        match (resting(old), resting(motion)) {
            (true, false) => self.restless += 1,
            (false, true) => self.restless -= 1,
            _ => {}
        }
        match (old, motion) {
            (Motion::Resting, m) if m != Motion::Resting => self.resting -= 1,
            (m, Motion::Resting) if m != Motion::Resting => self.resting += 1,
            _ => {}
        }
        let bound = |m: Motion| !matches!(m, Motion::Free | Motion::Fixed);
        match (bound(old), bound(motion)) {
            (false, true) => self.bound += 1,
            (true, false) => self.bound -= 1,
            _ => {}
        }
        if old != motion {
            // It goes another way from its record: what was predicted of it does not hold.
            self.store.bodies.matter[i].stamp = self.store.bodies.matter[i].stamp.wrapping_add(1);
        }
        if motion == Motion::Free {
            self.held.remove(&(i as u32));
        }
        if motion != Motion::Held && !self.grips.is_empty() {
            self.grips.remove(&(i as u32));
        }
        self.store.bodies.motion[i] = motion;
    }

    /// How a member of the instant goes on: freely, or held by the walls that it touches and that gravity presses it against.
    pub(super) fn settle(&mut self, time: f64, m: &Member<D>, set: &Instant<D>, scale: f64) {
        let i = m.body as usize;
        if self.store.bodies.motion[i] == Motion::Sliced {
            self.write_turning(i, time, m.x, m.after, m.spin_after);
            return;
        }
        let g = self.store.gravity;
        let mut walls: Vec<u32> = Vec::new();
        let mut normals: Vec<Vector<D>> = Vec::new();
        if !self.store.weightless {
            for c in &set.contacts {
                if c.a != m.body || c.b & WALL == 0 {
                    continue;
                }
                let w = (c.b & !WALL) as usize;
                let wall = &self.store.walls[w];
                let speed = (m.after - wall.velocity).dot(c.normal);
                let still = still_speed(scale + wall.velocity.norm());
                // A contact that neither parts nor approaches, on something flat.
                if speed <= still && -speed <= still && self.flat(i, w, time) {
                    walls.push(w as u32);
                    normals.push(-c.normal);
                }
            }
        }
        let mut pressing = Vec::new();
        let a = held_acceleration(g, &normals, &mut pressing);
        let pressed = |k: &usize| pressing[*k];
        let holders: Vec<u32> = (0..walls.len()).filter(pressed).map(|k| walls[k]).collect();
        // What several rough walls hold is a matter for the slices.
        if holders.is_empty() || holders.len() > 1 && holders.iter().any(|&w| self.rubs(i, w as usize)) {
            self.write_turning(i, time, m.x, m.after, m.spin_after);
            self.set_motion(i, Motion::Free);
            return;
        }
        let normals: Vec<Vector<D>> = (0..walls.len()).filter(pressed).map(|k| normals[k]).collect();
        self.hold_by(i, time, m.x, (m.after, m.spin_after), &holders, &normals, a);
    }

    /// Lets walls hold a body that stands at `x` with velocity `from`, their unit `normals` away from them, `a` what they leave
    /// of gravity.
    pub(super) fn hold_by(
        &mut self,
        i: usize,
        time: f64,
        x: Vector<D>,
        (from, spin): (Vector<D>, <Vector<D> as Rotates>::Spin),
        holders: &[u32],
        normals: &[Vector<D>],
        a: Vector<D>,
    ) {
        let velocity = self.store.walls[holders[0] as usize].velocity;
        let mut v = from;
        // The normal speed is zero but for rounding; make it so, and book what that takes.
        for _ in 0..2 {
            for n in normals {
                v -= *n * (v - velocity).dot(*n);
            }
        }
        if let (&[w], &[normal]) = (holders, normals)
            && self.rubs(i, w as usize)
        {
            return self.grip(i, time, x, (from, v), spin, w as usize, normal);
        }
        let still = a.norm() <= 1e-12 * self.store.gravity.norm();
        let a = if still { Vector::ZERO } else { a };
        let relative = v - velocity;
        let rests = still && !(relative.norm() > REST_EPS);
        if rests {
            v = velocity;
        }
        self.book_stop(i, x, from, v, velocity);
        self.write_turning(i, time, x, v, spin);
        self.held.insert(i as u32, holders.to_vec());
        self.store.bodies.acceleration[i] = a;
        self.set_motion(i, if rests && velocity == Vector::ZERO { Motion::Resting } else { Motion::Held });
    }

    /// True if a ball touches the flat part of a wall: a plane, the inside of a segment or of a triangle.
    pub(super) fn flat(&self, i: usize, w: usize, time: f64) -> bool {
        let wall = &self.store.walls[w];
        let x = self.store.at(i, time).0 - wall.shift(time);
        match &wall.shape {
            Shape::Plane { .. } => true,
            Shape::Arc(_) => false,
            Shape::Segment { from, to } => {
                let along = *to - *from;
                let s = (x - *from).dot(along);
                s > 0.0 && s < along.norm_squared()
            }
            Shape::Triangle(corners) => (0..3).all(|k| {
                let (a, b, c) = (corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
                let edge = b - a;
                let inward = (c - a) - edge * ((c - a).dot(edge) / edge.norm_squared());
                (x - a).dot(inward) > 0.0
            }),
        }
    }

    /// Books that a support brought a body from velocity `from` to `to` (m/s), the support moving at `support`.
    pub(super) fn book_stop(&mut self, i: usize, x: Vector<D>, from: Vector<D>, to: Vector<D>, support: Vector<D>) {
        if from == to || self.books.start.is_none() {
            return;
        }
        let m = self.store.bodies.matter[i].mass;
        let impulse = (to - from) * m;
        self.books.momentum_given.add(&impulse.0);
        if !self.store.any_periodic {
            self.book_moment(x, impulse);
        }
        let work = impulse.dot(support);
        self.books.work.add(work);
        self.books.lost.add(work - 0.5 * m * (to - from).dot(to + from));
    }

    /// Books what gravity and the supports gave to a body since its record: m a dt, its moment, and the work of supports that
    /// move.
    pub(super) fn book_flight(&mut self, i: usize, time: f64) {
        if self.store.weightless || self.books.start.is_none() {
            return;
        }
        let b = &self.store.bodies;
        let dt = time - b.record[i].time;
        if b.matter[i].inverse_mass == 0.0 || dt == 0.0 || b.motion[i] == Motion::Sliced {
            return;
        }
        let Given { momentum, moment, work, lost } = self.flight(i, dt);
        self.books.momentum_given.add(&momentum.0);
        if !self.store.any_periodic {
            self.books.angular_given.add(Vector::<D>::spin_slice(&moment));
        }
        if work != 0.0 {
            self.books.work.add(work);
        }
        if lost != 0.0 {
            self.books.lost.add(lost);
        }
    }

    /// What gravity and supports give to body `i` in the time `dt` after its record.
    pub(super) fn flight(&self, i: usize, dt: f64) -> Given<D> {
        let b = &self.store.bodies;
        let (r, m) = (&b.record[i], b.matter[i].mass);
        let a = self.store.acceleration(i);
        let momentum = a * (m * dt);
        // The integral of x cross m a over the flight: x is a parabola, and a cross a is nothing.
        let mut moment = Vector::<D>::moment((r.x + r.v * (0.5 * dt)) * (m * dt), a);
        let mut work = 0.0;
        if let Some(&w) = self.held.get(&(i as u32)).and_then(|walls| walls.first()) {
            let velocity = self.store.walls[w as usize].velocity;
            if velocity != Vector::ZERO {
                work = ((a - self.store.gravity) * m).dot(velocity) * dt;
            }
        }
        let mut lost = 0.0;
        if b.motion[i] == Motion::Held
            && let Some(grip) = self.grips.get(&(i as u32))
        {
            moment += grip.angular * (b.inertia[i] * dt);
            lost = (grip.loss.0 + grip.loss.1 * dt) * dt;
        }
        Given { momentum, moment, work, lost }
    }

    /// A held body has come to the end of a support: it goes on freely, or held by what is left.
    pub(super) fn support_end(&mut self, time: f64, i: usize) {
        self.time = time;
        self.events += 1;
        let (x, v) = self.store.at(i, time);
        self.write(i, time, x, v);
        self.set_motion(i, Motion::Free);
        self.predict(i);
    }
}

/// What gravity and supports gave over a flight.
pub(super) struct Given<const D: usize>
where
    Vector<D>: Rotates,
{
    pub momentum: Vector<D>,
    pub moment: <Vector<D> as Rotates>::Spin,
    pub work: f64,
    pub lost: f64,
}
