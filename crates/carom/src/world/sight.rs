//! What a body meets first of those near it, four of them at a time: the innermost loop of a plain world.
//!
//! First no more than estimates, without a branch: for each neighbour a time that it surely does not meet the body before. Then the earliest of them
//! is predicted exactly, by [`meet::ball_ball`], and whoever else may come before what that gave. So the bits are the same whatever the
//! [machine](super::machine) computes the estimates with.
use super::instant::TOUCHING;
use super::lists::{Anchor, List};
use super::machine::{FOUR, Four, Lanes};
use super::predict::creep;
use super::store::{Matter, Record};
use super::{NOTHING, Next};
use crate::{Vector, meet};

/// What rounding may do to the coarse tests, relative to the products they are made of: five hundred times the bound of 2 D units
/// in the last place.
const COARSE: f64 = 1e-12;
/// Somewhat more than [`TOUCHING`].
const NEARLY_TOUCHING: f64 = 1.01 * TOUCHING;
/// So many groups of four are estimated before the earliest of them are predicted exactly.
const PART: usize = 8;

/// Adding and taking away 1.5 x 2^52 rounds to the nearest integer, ties to even.
pub(super) const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// What a look reads of the world.
#[derive(Clone, Copy)]
pub(super) struct Sight<'a, const D: usize> {
    pub records: &'a [Record<D>],
    pub matter: &'a [Matter],
    /// The widths of the box along periodic axes, and one over them; else zero.
    pub width: Vector<D>,
    pub inverse_width: Vector<D>,
    /// The acceleration that all have, where bodies do not move uniformly; zero along periodic axes.
    pub fall: Option<Vector<D>>,
}

/// A body as a pass over its neighbours sees it.
#[derive(Clone, Copy)]
pub(super) struct Looker<const D: usize> {
    pub id: u32,
    pub record: Record<D>,
    /// Where it is now.
    pub here: Vector<D>,
}

/// What a pass found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub next: Next,
    /// Somebody touches the looker now.
    pub touched: bool,
}

/// No meeting.
pub(super) const NEVER: Next = Next { time: f64::INFINITY, partner: NOTHING, stamp: 0 };

#[inline(always)]
pub(super) fn pass<S: Four, const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<D>,
    groups: &[[u32; FOUR]],
    except: u32,
    now: f64,
    best: Next,
) -> Found {
    let mut found = Found { next: best, touched: false };
    for part in groups.chunks(PART) {
        part_of::<S, D, LATEST, FALLS>(sight, who, part, except, now, &mut found);
    }
    found
}

#[inline(always)]
fn part_of<S: Four, const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<D>,
    groups: &[[u32; FOUR]],
    except: u32,
    now: f64,
    found: &mut Found,
) {
    let own = &who.record;
    let (own_time, own_radius) = (S::all(own.time), S::all(own.radius));
    let zero = S::all(0.0);
    let fall = sight.fall.unwrap_or(Vector::ZERO);
    let mut soonest = [S::all(f64::INFINITY); PART];
    let mut earliest = soonest[0];
    let mut close = 0u32;
    let count = groups.len().min(PART);
    for at in 0..count {
        let [e, f, g, h] = groups[at];
        let records = sight.records;
        let Lanes { x, v, time: t, radius } =
            S::of_records([&records[e as usize], &records[f as usize], &records[g as usize], &records[h as usize]]);
        let since = S::all(now).sub(t);
        let time = if LATEST { own_time } else { own_time.max(t) };
        // Relative to the looker, at the later of the two records' times.
        let (mut square, mut speed, mut b) = (zero, zero, zero);
        for k in 0..D {
            let pull = S::all(fall.0[k]);
            // As `apart` has it, to the bit: far from the origin, or in a fast frame, a difference has few digits. Where both are now says
            // which image of the box is meant.
            let mean = if LATEST && FALLS { v[k].add(pull.mul(S::all(0.5).mul(since))) } else { v[k] };
            let away = x[k].add(mean.mul(since)).sub(S::all(who.here.0[k]));
            let turns = away.mul(S::all(sight.inverse_width.0[k])).add(S::all(TO_INTEGER)).sub(S::all(TO_INTEGER));
            let apart = if LATEST {
                away
            } else {
                let (own_dt, dt) = (time.sub(own_time), time.sub(t));
                let (mut own_mean, mut mean) = (S::all(own.v.0[k]), v[k]);
                if FALLS {
                    own_mean = own_mean.add(pull.mul(S::all(0.5).mul(own_dt)));
                    mean = mean.add(pull.mul(S::all(0.5).mul(dt)));
                }
                x[k].add(mean.mul(dt)).sub(S::all(own.x.0[k]).add(own_mean.mul(own_dt)))
            };
            let d = apart.sub(turns.mul(S::all(sight.width.0[k])));
            let w = if FALLS {
                let (own_dt, dt) = (time.sub(own_time), time.sub(t));
                v[k].add(pull.mul(dt)).sub(S::all(own.v.0[k]).add(pull.mul(own_dt)))
            } else {
                v[k].sub(S::all(own.v.0[k]))
            };
            square = d.times_plus(d, square);
            speed = w.times_plus(w, speed);
            b = d.times_plus(w, b);
        }
        let reach = own_radius.add(radius);
        if LATEST {
            let near = own_radius.min(radius).times_plus(S::all(NEARLY_TOUCHING), reach);
            close |= square.less(near.mul(near)) << (FOUR * at);
        }
        // Less than the gap, and more than the discriminant, by more than rounding.
        let c = S::all(COARSE).times_less(square, reach.times_less(reach, square));
        let squared = b.mul(b);
        let discriminant = S::all(2.0 * COARSE).times_plus(squared, speed.times_less(c, squared));
        let times = time.and_root(b, c, discriminant, groups[at], [who.id, except]);
        soonest[at] = times;
        earliest = times.min(earliest);
    }
    // Mostly the other one of the two that have just met, and whoever fills up the last group.
    while close != 0 {
        let l = close.trailing_zeros() as usize;
        close &= close - 1;
        let k = groups[l / FOUR][l % FOUR];
        if k != except && k != who.id {
            found.touched |= touches::<D, LATEST, FALLS>(sight, who, k, now);
        }
    }
    let mut next = least(earliest);
    while next < f64::INFINITY && next <= found.next.time {
        // Whoever may come as early as this; then as early as the next one, if that may be before what this gave.
        let bound = S::all(next);
        let mut after = S::all(f64::INFINITY);
        let mut come = 0u32;
        for at in 0..count {
            come |= soonest[at].at_most(bound) << (FOUR * at);
            after = soonest[at].beyond(bound).min(after);
        }
        while come != 0 {
            let l = come.trailing_zeros() as usize;
            come &= come - 1;
            exactly::<D, LATEST, FALLS>(sight, who, groups[l / FOUR][l % FOUR], now, &mut found.next);
        }
        next = least(after);
    }
}

/// The least of four.
#[inline(always)]
fn least<S: Four>(four: S) -> f64 {
    let [e, f, g, h] = four.out();
    let (e, g) = (if e < f { e } else { f }, if g < h { g } else { h });
    if e < g { e } else { g }
}

/// True if a neighbour touches the looker now.
#[cold]
#[inline(never)]
fn touches<const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<D>,
    k: u32,
    now: f64,
) -> bool {
    let (d, _, _) = apart::<D, LATEST, FALLS>(sight, who, k, now);
    let (one, other) = (who.record.radius, sight.records[k as usize].radius);
    let near = one + other + TOUCHING * if one < other { one } else { other };
    d.norm_squared() < near * near
}

/// Where a neighbour is and how fast, relative to the looker, at the later of the two records' times, and that time.
#[inline(always)]
fn apart<const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<D>,
    k: u32,
    now: f64,
) -> (Vector<D>, Vector<D>, f64) {
    let (own, other) = (&who.record, &sight.records[k as usize]);
    let fall = sight.fall.unwrap_or(Vector::ZERO);
    let since = now - other.time;
    let time = if LATEST || own.time > other.time { own.time } else { other.time };
    let (own_dt, dt) = (time - own.time, time - other.time);
    let (mut d, mut w) = (Vector::<D>::ZERO, Vector::<D>::ZERO);
    for k in 0..D {
        let (x, v, pull) = (other.x.0[k], other.v.0[k], fall.0[k]);
        let mean = if LATEST && FALLS { v + pull * (0.5 * since) } else { v };
        let away = (x + mean * since) - who.here.0[k];
        let turns = (away * sight.inverse_width.0[k] + TO_INTEGER) - TO_INTEGER;
        let apart = if LATEST {
            away
        } else {
            let (mut own_mean, mut mean) = (own.v.0[k], v);
            if FALLS {
                own_mean += pull * (0.5 * own_dt);
                mean += pull * (0.5 * dt);
            }
            (x + mean * dt) - (own.x.0[k] + own_mean * own_dt)
        };
        d.0[k] = apart - turns * sight.width.0[k];
        w.0[k] = if FALLS { (v + pull * dt) - (own.v.0[k] + pull * own_dt) } else { v - own.v.0[k] };
    }
    (d, w, time)
}

/// When the looker meets a neighbour, if that is earlier than `best`.
#[inline(never)]
fn exactly<const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<D>,
    k: u32,
    now: f64,
    best: &mut Next,
) {
    let (own, other) = (&who.record, &sight.records[k as usize]);
    let (d, w, time) = apart::<D, LATEST, FALLS>(sight, who, k, now);
    let dt = meet::ball_ball(d, w, own.radius + other.radius);
    let meeting = if dt == 0.0 {
        // Touching: hardly ever.
        let fall = sight.fall.unwrap_or(Vector::ZERO);
        let speed = |r: &Record<D>| if FALLS { (r.v + fall * (time - r.time)).norm() } else { r.v.norm() };
        time + crept(own, other, d, w, speed(own) + speed(other))
    } else {
        time + dt
    };
    if meeting < best.time || meeting == best.time && meeting < f64::INFINITY && k < best.partner {
        *best = Next { time: meeting, partner: k, stamp: sight.matter[k as usize].stamp };
    }
}

#[inline(always)]
pub(super) fn near_of<S: Four, const D: usize>(
    sight: &Sight<'_, D>,
    anchors: &[Anchor<D>],
    id: u32,
    margins: f64,
    groups: &[[u32; FOUR]],
    list: &mut List,
) -> bool {
    let own = &anchors[id as usize];
    let reach = S::all(own.radius + margins);
    for group in groups {
        let [e, f, g, h] = *group;
        let (x, radius) =
            S::of_anchors([&anchors[e as usize], &anchors[f as usize], &anchors[g as usize], &anchors[h as usize]]);
        let mut square = S::all(0.0);
        for k in 0..D {
            let away = x[k].sub(S::all(own.x.0[k]));
            let turns = away.mul(S::all(sight.inverse_width.0[k])).add(S::all(TO_INTEGER)).sub(S::all(TO_INTEGER));
            let apart = away.sub(turns.mul(S::all(sight.width.0[k])));
            square = square.add(apart.mul(apart));
        }
        let reach = reach.add(radius).mul(S::all(1.0 + 1e-9));
        let mut left = square.at_most(reach.mul(reach));
        while left != 0 {
            let k = group[left.trailing_zeros() as usize & (FOUR - 1)];
            left &= left - 1;
            if k != id && !list.push(k) {
                return false;
            }
        }
    }
    true
}

/// How long two that touch and close wait.
#[cold]
#[inline(never)]
fn crept<const D: usize>(a: &Record<D>, b: &Record<D>, apart: Vector<D>, closing: Vector<D>, speeds: f64) -> f64 {
    let smaller = if a.radius < b.radius { a.radius } else { b.radius };
    creep(-apart.dot(closing) / apart.norm(), speeds, smaller)
}

#[cfg(test)]
mod tests {
    use super::super::machine::{first, first_with_loops};
    use super::*;
    use proptest::prelude::*;
    use std::vec::Vec;

    /// `far` from the origin (m) along the axes that are not periodic, and in a frame that moves as `fast` (m/s).
    fn twins<const D: usize>(numbers: &[f64], radii: [f64; 2], [far, fast]: [f64; 2], latest: bool, falls: bool) {
        // Along an axis that is not periodic.
        let fall = (falls && D > 1).then(|| Vector::from_fn(|k| if k == 1 { -1.7 } else { 0.0 }));
        let g = fall.unwrap_or(Vector::ZERO);
        let at = |r: &Record<D>, time: f64| {
            let dt = time - r.time;
            (r.x + (r.v + g * (0.5 * dt)) * dt, r.v + g * dt)
        };
        let period = 3.0;
        let record = |n: &[f64]| Record {
            x: Vector::<D>::from_fn(|k| period * n[k] + if k % 2 == 1 { far } else { 0.0 }),
            v: Vector::from_fn(|k| 2.0 * n[3 + k] - 1.0 + fast),
            time: n[6],
            radius: radii[usize::from(n[7] > 0.5)],
        };
        let records: Vec<Record<D>> = numbers.chunks_exact(8).map(record).collect();
        let matter: Vec<Matter> = (0..records.len() as u32)
            .map(|i| Matter { inverse_mass: 1.0, mass: 1.0, material: Default::default(), stamp: i ^ 5 })
            .collect();
        // Every other axis is periodic.
        let width = Vector::from_fn(|k| if k % 2 == 0 { period } else { 0.0 });
        let inverse_width = Vector::from_fn(|k| if k % 2 == 0 { 1.0 / period } else { 0.0 });
        let sight = Sight { records: &records, matter: &matter, width, inverse_width, fall };
        let ids: Vec<u32> = (0..records.len() as u32).collect();
        let groups: Vec<[u32; FOUR]> =
            ids.chunks(FOUR).map(|c| core::array::from_fn(|l| c.get(l).copied().unwrap_or(1))).collect();
        let mut record = records[1];
        let now = 1.0;
        if latest {
            record.time = now;
        }
        let here = record.x + record.v * (now - record.time);
        let who = Looker { id: 1, record, here };
        let loops = match (latest, falls) {
            (true, true) => first_with_loops::<D, true, true>,
            (true, false) => first_with_loops::<D, true, false>,
            (false, true) => first_with_loops::<D, false, true>,
            (false, false) => first_with_loops::<D, false, false>,
        };
        let (one, two) = if latest {
            (first::<D, true>(&sight, &who, &groups, 2, now, NEVER), loops(&sight, &who, &groups, 2, now, NEVER))
        } else {
            (
                first::<D, false>(&sight, &who, &groups, NOTHING, now, NEVER),
                loops(&sight, &who, &groups, NOTHING, now, NEVER),
            )
        };
        assert_eq!(
            (one.next.time.to_bits(), one.next.partner, one.next.stamp, one.touched),
            (two.next.time.to_bits(), two.next.partner, two.next.stamp, two.touched)
        );
        // And what a plain look at one after the other finds.
        let mut best = NEVER;
        for &k in ids.iter().filter(|&&k| k != 1 && !(latest && k == 2)) {
            let other = &records[k as usize];
            let time = if record.time > other.time { record.time } else { other.time };
            let away = other.x + other.v * (now - other.time) - here;
            let turns = Vector::<D>::from_fn(|k| libm::rint(away[k] * inverse_width[k]) * width[k]);
            let ((own_x, own_v), (other_x, other_v)) = (at(&record, time), at(other, time));
            let (d, w) = (other_x - own_x - turns, other_v - own_v);
            let dt = crate::meet::ball_ball(d, w, record.radius + other.radius);
            let speeds = own_v.norm() + other_v.norm();
            let at = if dt != 0.0 { time + dt } else { time + crept(&record, other, d, w, speeds) };
            if at < best.time || at == best.time && at < f64::INFINITY && k < best.partner {
                best = Next { time: at, partner: k, stamp: matter[k as usize].stamp };
            }
        }
        assert_eq!((one.next.time.to_bits(), one.next.partner), (best.time.to_bits(), best.partner));
    }

    proptest! {
        /// Vectors, loops and one after the other give the same bits, in every dimension, for any number of neighbours.
        #[test]
        fn all_ways_are_one(
            numbers in prop::collection::vec(0.0..1.0f64, 16..400),
            radii in [0.01..0.6f64, 0.01..0.6f64],
            frame in prop_oneof![Just([0.0; 2]), [-1e7..1e7f64, -1e3..1e3f64]],
            latest: bool,
            falls: bool,
        ) {
            twins::<1>(&numbers, radii, frame, latest, falls);
            twins::<2>(&numbers, radii, frame, latest, falls);
            twins::<3>(&numbers, radii, frame, latest, falls);
        }
    }
}
