//! A ball on one flat wall with friction: it slides, then rolls, in arcs that are exact as long as what resists it keeps its
//! direction.
//!
//! With N the pressing force per mass, t the tangential part of gravity, k = 1 + 1/kappa and u the slip:
//!
//! ```text
//! slides   a = t - mu N u/|u|             u' = t - mu k N u/|u|        until u = 0
//! rolls    a = t/(1 + kappa) - c N v/|v|  u = 0                        until v = 0, where c > 0
//! spins    w_n' = -s N / (kappa R)                                     until w_n = 0, where s > 0
//! ```
//!
//! c is the coefficient of rolling resistance, so defined that a ball rolling on the level slows down by c g, whatever its
//! inertia; s that of spinning friction, a moment s N R about the normal. Rolling needs a friction of |t - a| <= mu N; a
//! steeper slope makes the ball slide.
//!
//! # Accuracy
//! On the level, in the plane, and where gravity pulls along the slip, u keeps its direction and the parabola is exact. Else
//! (a ball that slides across a slope, in space), and where mu depends on the speed, the arc ends when the direction may have
//! turned by [`TURN`], and the resistance acts along the direction half-way: an error of second order, about TURN^2 of
//! what friction did. Energy is exact in every case.
use super::store::Motion;
use super::support::REST_EPS;
use super::{WALL, World};
use crate::codec::codec;
use crate::law::together::rub::rolling;
use crate::vector::Exact;
use crate::{Rotates, Vector};

/// The largest angle (rad) by which the direction of a slip or of a rolling motion may turn in one arc.
pub const TURN: f64 = 0.01;
/// No arc is planned shorter than this (s): what is left of a slip then ends with it.
const SHORTEST_ARC: f64 = 1e-7;
/// Slips below this part of the speeds involved are what rounding leaves of none.
const NO_SLIP: f64 = 1e-13;

/// What ends an arc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    /// Nothing does.
    Never,
    /// The slip is zero.
    Slip,
    /// The ball stands still.
    Roll,
    /// It no longer turns about the normal.
    Spin,
    /// Its resistance must be given a new direction.
    Turned,
}

codec!(enum End: [End::Never, End::Slip, End::Roll, End::Spin, End::Turned]);

/// How friction moves a held ball, from its record on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grip<const D: usize>
where
    Vector<D>: Rotates,
{
    /// When the arc ends (s); infinite if it does not.
    pub end: f64,
    why: End,
    /// Angular acceleration (rad/s^2).
    pub angular: <Vector<D> as Rotates>::Spin,
    /// Energy (J) that friction takes in a time t: loss.0 t + loss.1 t^2.
    pub loss: (f64, f64),
}

codec!(Grip<D> { end, why, angular, loss });

/// A length of time with the earliest end found so far.
struct Arc {
    length: f64,
    why: End,
}

impl Arc {
    fn offer(&mut self, length: f64, why: End) {
        if length < self.length {
            (self.length, self.why) = (length, why);
        }
    }
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// The spin of a body (rad/s) at a time, from its record.
    #[inline]
    pub(super) fn spin_at(&self, i: usize, time: f64) -> <Vector<D> as Rotates>::Spin {
        let b = &self.store.bodies;
        if b.motion[i] == Motion::Held
            && let Some(grip) = self.grips.get(&(i as u32))
        {
            return b.spin[i] + grip.angular * (time - b.record[i].time);
        }
        b.spin[i]
    }

    /// True if body `i` and wall `w` can rub.
    pub(super) fn rubs(&self, i: usize, w: usize) -> bool {
        self.store.rough() && {
            let said = self.said(i as u32, WALL | w as u32, 0.0, 0.0);
            // A curve may be zero at zero slip and not elsewhere.
            said.friction > 0.0 || self.said(i as u32, WALL | w as u32, 0.0, 1.0).friction > 0.0
        }
    }

    /// Lets wall `w` hold body `i`, which presses and rubs on it: it stands at `x`, its velocity is `v` after `from`, and its
    /// spin `spin`; `normal` points away from the wall. The record is written.
    pub(super) fn grip(
        &mut self,
        i: usize,
        time: f64,
        x: Vector<D>,
        (from, v): (Vector<D>, Vector<D>),
        spin: <Vector<D> as Rotates>::Spin,
        w: usize,
        normal: Vector<D>,
    ) {
        self.grip_after(i, time, x, (from, v), spin, w, normal, End::Never);
    }

    /// An arc of a held ball is over.
    pub(super) fn grip_end(&mut self, time: f64, i: usize) {
        self.time = time;
        self.events += 1;
        let (x, v) = self.store.at(i, time);
        let spin = self.spin_at(i, time);
        let (Some(grip), Some(&[w])) = (self.grips.get(&(i as u32)), self.held.get(&(i as u32)).map(|w| &w[..])) else {
            return self.support_end(time, i);
        };
        let why = grip.why;
        let at = self.store.wrapped(x, self.store.turns(x));
        let over = self.store.walls[w as usize].over(time, at, self.store.bodies.record[i].radius);
        let normal = -(over.towards / over.towards.norm());
        self.grip_after(i, time, x, (v, v), spin, w as usize, normal, why);
        self.predict(i);
    }

    fn grip_after(
        &mut self,
        i: usize,
        time: f64,
        x: Vector<D>,
        (from, mut v): (Vector<D>, Vector<D>),
        spin_from: <Vector<D> as Rotates>::Spin,
        w: usize,
        normal: Vector<D>,
        ended: End,
    ) {
        let support = self.store.walls[w].velocity;
        let mut spin = spin_from;
        let g = self.store.gravity;
        let b = &self.store.bodies;
        let (radius, mass, inertia) = (b.record[i].radius, b.matter[i].mass, b.inertia[i]);
        let kappa = inertia / (mass * radius * radius);
        let arm = -(normal * radius);
        let press = -g.dot(normal);
        let down = g + normal * press;
        let down = if down.norm() <= 1e-12 * g.norm() { Vector::ZERO } else { down };
        let code = WALL | w as u32;
        let slip_of = |v: Vector<D>, spin: <Vector<D> as Rotates>::Spin| {
            let u = v - support + Vector::<D>::turned(spin, arm);
            u - normal * u.dot(normal)
        };
        let mut slip = slip_of(v, spin);
        let speeds = (v - support).norm() + Vector::<D>::turned(spin, arm).norm();
        let still = self.said(i as u32, code, 0.0, 0.0);
        let said = self.said(i as u32, code, 0.0, slip.norm());
        // What is left of a slip that has come to its end is taken from both the motion and the spin, as friction would.
        let fastest = down.norm() + said.friction.max(still.friction) * press * (1.0 + 1.0 / kappa);
        // Where the slip turns as it ends, it turns ever faster: what would end within the shortest arc has ended.
        let turning = (down - slip * (down.dot(slip) / slip.norm_squared())).norm() > 1e-12 * down.norm();
        let shortest = if turning || !self.is_steady(i, w) { fastest * SHORTEST_ARC } else { 0.0 };
        if ended == End::Slip || !(slip.norm() > NO_SLIP * speeds + shortest) {
            v -= slip * (kappa / (1.0 + kappa));
            let turn = (v - support) - normal * (v - support).dot(normal);
            let about = if D == 3 { spin - rolling(spin, normal) } else { Default::default() };
            spin = about - Vector::<D>::moment(arm, turn) * (1.0 / (radius * radius));
            slip = Vector::ZERO;
        }
        let mut arc = Arc { length: f64::INFINITY, why: End::Never };
        let mut loss = (0.0, 0.0);
        let acceleration;
        let mut angular;
        let along = v - support;
        let rolls = slip == Vector::ZERO;
        let resists = Resists {
            free: down * (1.0 / (1.0 + kappa)),
            needed: down * (kappa / (1.0 + kappa)),
            grip: still.friction * press,
            resistance: still.rolling * press,
        };
        let rolled = if rolls { resists.rolling(along, ended, &mut arc) } else { None };
        match rolled {
            Some((a, resistance)) => {
                acceleration = a;
                if resistance == Vector::ZERO && a == Vector::ZERO && along.norm() <= resists.stop_speed(ended) {
                    v = support;
                    spin = if D == 3 { spin - rolling(spin, normal) } else { Default::default() };
                }
                angular = -(Vector::<D>::moment(arm, a) * (1.0 / (radius * radius)));
                let power = mass * (1.0 + kappa);
                loss.0 += power * resistance.dot(v - support);
                loss.1 += 0.5 * power * resistance.dot(a);
            }
            None => {
                // On a slope too steep to roll on, a slip begins downhill.
                arc = Arc { length: f64::INFINITY, why: End::Never };
                let k = 1.0 + 1.0 / kappa;
                let mu = if rolls { still.friction } else { said.friction };
                let first = if rolls { down } else { slip };
                let mut direction = unit(first);
                let mut force = mu * press;
                let mut faster = down - direction * (force * k);
                let across = (down - direction * down.dot(direction)).norm();
                let steady = across <= 1e-12 * down.norm() && self.is_steady(i, w);
                if !steady {
                    let size = slip.norm();
                    let changes = if self.is_steady(i, w) { across } else { across + faster.norm() };
                    arc.offer((TURN * size / changes).max(SHORTEST_ARC), End::Turned);
                    // Half-way, but not beyond the end of the slip.
                    let closing = -faster.dot(direction);
                    let left = if closing > 0.0 { size / closing } else { f64::INFINITY };
                    let middle = slip + faster * (0.5 * arc.length.min(left));
                    if middle.norm() > 0.0 {
                        direction = unit(middle);
                        force = self.said(i as u32, code, 0.0, middle.norm()).friction * press;
                        faster = down - direction * (force * k);
                    }
                }
                let closing = -faster.dot(direction);
                if closing > 0.0 && !rolls {
                    arc.offer(slip.norm() / closing, End::Slip);
                }
                acceleration = down - direction * force;
                angular = Vector::<D>::moment(arm, direction * (-mass * force)) * (1.0 / inertia);
                loss.0 += mass * force * direction.dot(slip);
                loss.1 += 0.5 * mass * force * direction.dot(faster);
            }
        }
        if D == 3 {
            if ended == End::Spin {
                spin = rolling(spin, normal);
            }
            let about = spin - rolling(spin, normal);
            let rate = Vector::<D>::spin_dot(about, about).sqrt_();
            let slows = still.spinning * press / (kappa * radius);
            if slows > 0.0 && rate > 0.0 {
                angular += about * (-slows / rate);
                arc.offer(rate / slows, End::Spin);
                loss.0 += inertia * slows * rate;
                loss.1 -= 0.5 * inertia * slows * slows;
            }
        }
        let relative = v - support;
        let at_rest = acceleration == Vector::ZERO
            && Vector::<D>::spin_dot(angular, angular) == 0.0
            && !(relative.norm() > REST_EPS)
            && slip == Vector::ZERO;
        if at_rest {
            v = support;
        }
        self.book_change(i, x, (from, spin_from), (v, spin), support);
        self.write_turning(i, time, x, v, spin);
        self.held.insert(i as u32, alloc::vec![w as u32]);
        self.store.bodies.acceleration[i] = acceleration;
        if at_rest && support == Vector::ZERO {
            self.set_motion(i, Motion::Resting);
        } else {
            self.set_motion(i, Motion::Held);
            let end = if arc.length < f64::INFINITY { time + arc.length } else { f64::INFINITY };
            self.grips.insert(i as u32, Grip { end, why: arc.why, angular, loss });
        }
    }

    /// True if the friction between a body and a wall is the same at every speed.
    fn is_steady(&self, i: usize, w: usize) -> bool {
        let s = &self.store;
        s.materials.steady_friction(s.bodies.matter[i].material, s.walls[w].material)
    }

    /// Books that a support changed the motion of a body, its surface moving at `support` (m/s): what is left over where a slip
    /// ends or a ball comes to rest.
    pub(super) fn book_change(
        &mut self,
        i: usize,
        x: Vector<D>,
        from: (Vector<D>, <Vector<D> as Rotates>::Spin),
        to: (Vector<D>, <Vector<D> as Rotates>::Spin),
        support: Vector<D>,
    ) {
        self.book_stop(i, x, from.0, to.0, support);
        if from.1 == to.1 || self.books.start.is_none() {
            return;
        }
        let inertia = self.store.bodies.inertia[i];
        let turned = to.1 - from.1;
        if !self.store.any_periodic {
            self.books.angular_given.add(Vector::<D>::spin_slice(&(turned * inertia)));
        }
        self.books.lost.add(-0.5 * inertia * Vector::<D>::spin_dot(turned, to.1 + from.1));
    }
}

/// What a rolling ball meets, per mass (m/s^2).
struct Resists<const D: usize> {
    /// Its acceleration without resistance, and the friction that this takes, against it.
    free: Vector<D>,
    needed: Vector<D>,
    /// The most that friction gives, and the resistance to rolling.
    grip: f64,
    resistance: f64,
}

impl<const D: usize> Resists<D> {
    /// Below this speed (m/s) a ball that rolls stands still, if its rolling resists at all.
    fn stop_speed(&self, ended: End) -> f64 {
        if ended == End::Roll { f64::INFINITY } else { REST_EPS + self.resistance * SHORTEST_ARC }
    }

    /// The resistance to a ball that rolls this way: no more than friction can hold while it rolls, |needed + r| <= grip.
    fn against(&self, direction: Vector<D>) -> f64 {
        let along = self.needed.dot(direction);
        let most = (along * along - self.needed.norm_squared() + self.grip * self.grip).max(0.0).sqrt_() - along;
        if self.resistance < most { self.resistance } else { most.max(0.0) }
    }

    /// The acceleration of a ball that rolls at `along`, and what resists it, in its direction. `None` if it cannot roll.
    fn rolling(&self, along: Vector<D>, ended: End, arc: &mut Arc) -> Option<(Vector<D>, Vector<D>)> {
        if !(self.needed.norm() <= self.grip) {
            return None;
        }
        if !(self.resistance > 0.0) {
            return Some((self.free, Vector::ZERO));
        }
        let speed = along.norm();
        if speed <= self.stop_speed(ended) {
            let direction = unit(self.free);
            let resistance = self.against(direction);
            if self.free.norm() <= resistance {
                return Some((Vector::ZERO, Vector::ZERO));
            }
            return Some((self.free - direction * resistance, direction * resistance));
        }
        let mut direction = unit(along);
        let mut resistance = self.against(direction);
        let across = (self.free - direction * self.free.dot(direction)).norm();
        if across > 1e-12 * self.free.norm() {
            arc.offer((TURN * speed / across).max(SHORTEST_ARC), End::Turned);
            let acceleration = self.free - direction * resistance;
            let slowing = -acceleration.dot(direction);
            let left = if slowing > 0.0 { speed / slowing } else { f64::INFINITY };
            direction = unit(along + acceleration * (0.5 * arc.length.min(left)));
            resistance = self.against(direction);
        }
        let acceleration = self.free - direction * resistance;
        let slowing = -acceleration.dot(direction);
        if slowing > 0.0 {
            arc.offer(along.dot(direction) / slowing, End::Roll);
        }
        Some((acceleration, direction * resistance))
    }
}

fn unit<const D: usize>(v: Vector<D>) -> Vector<D> {
    let size = v.norm();
    if size > 0.0 { v / size } else { Vector::ZERO }
}
