//! What a body meets first of those near it: the innermost loop of a plain world. Here one neighbour after the other, as machines without vectors do
//! it; four at a time in [`fours`](super::fours).
use super::instant::TOUCHING;
use super::lists::{Anchor, List};
use super::machine::{FOUR, Four};
use super::predict::creep;
use super::store::{Matter, Record};
use super::{NOTHING, Next};
use crate::{Vector, meet};

/// What rounding may do to the coarse tests, relative to the products they are made of: five hundred times the bound of 2 D units
/// in the last place.
pub(super) const COARSE: f64 = 1e-12;
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
pub(super) struct Looker<'a, const D: usize> {
    pub id: u32,
    /// By reference: copied whole, what was just written number by number would have to be waited for.
    pub record: &'a Record<D>,
    /// Where it is now.
    pub here: &'a Vector<D>,
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

/// Where a neighbour is and how fast, relative to the looker, at the later of the two records' times, and that time.
#[inline(always)]
pub(super) fn apart_from<const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<'_, D>,
    k: u32,
    now: f64,
) -> (Vector<D>, Vector<D>, f64) {
    let (own, other) = (who.record, &sight.records[k as usize]);
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

/// Whom a looker meets first, with one neighbour after the other: for machines without vectors.
#[inline(never)]
pub(super) fn pass_by_one<const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<'_, D>,
    groups: &[[u32; FOUR]],
    except: u32,
    now: f64,
    best: Next,
) -> Found {
    let mut found = Found { next: best, touched: false };
    for &k in groups.as_flattened() {
        if k == who.id || k == except {
            continue;
        }
        let (d, w, time) = apart_from::<D, LATEST, FALLS>(sight, who, k, now);
        let (square, b) = (d.norm_squared(), d.dot(w));
        let other = sight.records[k as usize].radius;
        let reach = who.record.radius + other;
        if LATEST {
            found.touched |= is_touching(square, who.record.radius, other);
        }
        // Half of them part, and of the others most pass by: no root for those.
        let c = square - reach * reach;
        if b < 0.0 && !(b * b - w.norm_squared() * c < -2.0 * COARSE * (b * b + w.norm_squared() * square)) {
            meets::<D, FALLS>(sight, who, k, (d, w, time), &mut found.next);
        }
    }
    found
}

/// True if two balls of these radii touch, whose centres are so far apart (squared).
#[inline(always)]
pub(super) fn is_touching(square: f64, one: f64, other: f64) -> bool {
    let near = one + other + TOUCHING * if one < other { one } else { other };
    square < near * near
}

/// When the looker meets a neighbour that is so far away and moves so relative to it at this time, if that is earlier than `best`.
#[inline(always)]
pub(super) fn meets<const D: usize, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<'_, D>,
    k: u32,
    (d, w, time): (Vector<D>, Vector<D>, f64),
    best: &mut Next,
) {
    let (own, other) = (who.record, &sight.records[k as usize]);
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
pub(super) fn crept<const D: usize>(
    a: &Record<D>,
    b: &Record<D>,
    apart: Vector<D>,
    closing: Vector<D>,
    speeds: f64,
) -> f64 {
    let smaller = if a.radius < b.radius { a.radius } else { b.radius };
    creep(-apart.dot(closing) / apart.norm(), speeds, smaller)
}
