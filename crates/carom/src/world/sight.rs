//! What a body meets first of those near it, four of them at a time: the innermost loop of a plain world.
//!
//! First a coarse test without a branch; where one of the four may count, all four are predicted exactly, with the products of
//! [`meet::ball_ball`](crate::meet::ball_ball) in the same order, so that the bits are the same whatever the machine computes
//! them with: plain loops everywhere, and vectors of four where the machine has AVX2.
//!
//! # Unsafe code
//! This is the one file that has any, for one reason: what is compiled for AVX2 may only run where there is AVX2.
//! - [`Vectors`] is private, and made nowhere but below [`first_with_vectors`], which [`first`] calls only after it has asked the
//!   machine. Its operations are inlined there, and take no pointer: all memory is reached through slices that check their bounds.
//! - [`fetch`] asks for memory ahead of its use. It reads nothing, and its address is that of an element of a slice.
//! - The twin without unsafe code, [`Loops`], is compiled from the same source; the tests compare both bit by bit.
#![allow(unsafe_code)]
use super::instant::TOUCHING;
use super::lists::Anchor;
use super::predict::creep;
use super::store::Record;
use super::{NOTHING, Next};
use crate::Vector;
use crate::vector::Exact;

/// So many are looked at at a time.
pub(super) const FOUR: usize = 4;

/// What rounding may do to the coarse tests, relative to the products they are made of: five hundred times the bound of 2 D units
/// in the last place.
const COARSE: f64 = 1e-12;

/// Adding and taking away 1.5 x 2^52 rounds to the nearest integer, ties to even.
pub(super) const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// What a look reads of the world.
#[derive(Clone, Copy)]
pub(super) struct Sight<'a, const D: usize> {
    pub records: &'a [Record<D>],
    pub stamps: &'a [u32],
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

/// Asks for the memory of an element, which will be read soon.
#[inline(always)]
pub(super) fn fetch<T>(all: &[T], i: usize) {
    #[cfg(target_arch = "x86_64")]
    if let Some(element) = all.get(i) {
        use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a hint about an address that is valid; every x86-64 has it.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(core::ptr::from_ref(element).cast()) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (all, i);
}

/// No meeting.
pub(super) const NEVER: Next = Next { time: f64::INFINITY, partner: NOTHING, stamp: 0 };

/// Four numbers, and what is done with them lane by lane. A comparison gives a bit for each lane.
trait Four: Copy {
    fn all(x: f64) -> Self;
    fn of(x: [f64; FOUR]) -> Self;
    fn out(self) -> [f64; FOUR];
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    fn root(self) -> Self;
    /// The larger one, or the smaller one; `other` where they are equal.
    fn max(self, other: Self) -> Self;
    fn min(self, other: Self) -> Self;
    /// False where a number is none.
    fn less(self, other: Self) -> u32;
    fn at_most(self, other: Self) -> u32;
}

#[derive(Clone, Copy)]
struct Loops([f64; FOUR]);

impl Loops {
    #[inline(always)]
    fn each(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = [0.0; FOUR];
        for l in 0..FOUR {
            out[l] = f(self.0[l], other.0[l]);
        }
        Self(out)
    }

    #[inline(always)]
    fn test(self, other: Self, f: impl Fn(f64, f64) -> bool) -> u32 {
        let mut bits = 0;
        for l in 0..FOUR {
            bits |= u32::from(f(self.0[l], other.0[l])) << l;
        }
        bits
    }
}

impl Four for Loops {
    #[inline(always)]
    fn all(x: f64) -> Self {
        Self([x; FOUR])
    }
    #[inline(always)]
    fn of(x: [f64; FOUR]) -> Self {
        Self(x)
    }
    #[inline(always)]
    fn out(self) -> [f64; FOUR] {
        self.0
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.each(other, |a, b| a + b)
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.each(other, |a, b| a - b)
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.each(other, |a, b| a * b)
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.each(other, |a, b| a / b)
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.each(self, |a, _| a.sqrt_())
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.each(other, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.each(other, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn less(self, other: Self) -> u32 {
        self.test(other, |a, b| a < b)
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> u32 {
        self.test(other, |a, b| a <= b)
    }
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod vectors {
    use super::{Anchor, FOUR, Found, Four, Looker, Next, Sight, near_of, pass};
    use core::arch::x86_64::*;

    /// Four numbers in one register. Only for code that is inlined into a function compiled for AVX2.
    #[derive(Clone, Copy)]
    struct Vectors(__m256d);

    // SAFETY (of every block below): see the head of the file; this code runs where the machine has AVX2, and nowhere else.
    impl Four for Vectors {
        #[inline(always)]
        fn all(x: f64) -> Self {
            Self(unsafe { _mm256_set1_pd(x) })
        }
        #[inline(always)]
        fn of(x: [f64; FOUR]) -> Self {
            Self(unsafe { _mm256_setr_pd(x[0], x[1], x[2], x[3]) })
        }
        #[inline(always)]
        fn out(self) -> [f64; FOUR] {
            unsafe {
                let (low, high) = (_mm256_castpd256_pd128(self.0), _mm256_extractf128_pd::<1>(self.0));
                let (second, fourth) = (_mm_unpackhi_pd(low, low), _mm_unpackhi_pd(high, high));
                [_mm_cvtsd_f64(low), _mm_cvtsd_f64(second), _mm_cvtsd_f64(high), _mm_cvtsd_f64(fourth)]
            }
        }
        #[inline(always)]
        fn add(self, other: Self) -> Self {
            Self(unsafe { _mm256_add_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn sub(self, other: Self) -> Self {
            Self(unsafe { _mm256_sub_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn mul(self, other: Self) -> Self {
            Self(unsafe { _mm256_mul_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn div(self, other: Self) -> Self {
            Self(unsafe { _mm256_div_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn root(self) -> Self {
            Self(unsafe { _mm256_sqrt_pd(self.0) })
        }
        #[inline(always)]
        fn max(self, other: Self) -> Self {
            Self(unsafe { _mm256_max_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn min(self, other: Self) -> Self {
            Self(unsafe { _mm256_min_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn less(self, other: Self) -> u32 {
            unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0)) as u32 }
        }
        #[inline(always)]
        fn at_most(self, other: Self) -> u32 {
            unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LE_OQ>(self.0, other.0)) as u32 }
        }
    }

    #[target_feature(enable = "avx2")]
    pub(super) fn near_with_vectors<const D: usize>(
        sight: &Sight<'_, D>,
        anchors: &[Anchor<D>],
        id: u32,
        margins: f64,
        ids: &[u32],
        found: impl FnMut(u32) -> bool,
    ) -> bool {
        near_of::<Vectors, D>(sight, anchors, id, margins, ids, found)
    }

    #[target_feature(enable = "avx2")]
    pub(super) fn first_with_vectors<const D: usize, const LATEST: bool, const FALLS: bool>(
        sight: &Sight<'_, D>,
        who: &Looker<D>,
        ids: &[u32],
        except: u32,
        now: f64,
        best: Next,
    ) -> Found {
        pass::<Vectors, D, LATEST, FALLS>(sight, who, ids, except, now, best)
    }
}

/// The earliest meeting of a looker with these neighbours (but for itself and `except`), if it is earlier than `best`. `LATEST` says
/// that no neighbour's record is later than the looker's, and that the looker's is of now.
#[inline]
pub(super) fn first<const D: usize, const LATEST: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<D>,
    ids: &[u32],
    except: u32,
    now: f64,
    best: Next,
) -> Found {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("avx2") {
        return if sight.fall.is_some() {
            // SAFETY: there is AVX2.
            unsafe { vectors::first_with_vectors::<D, LATEST, true>(sight, who, ids, except, now, best) }
        } else {
            // SAFETY: there is AVX2.
            unsafe { vectors::first_with_vectors::<D, LATEST, false>(sight, who, ids, except, now, best) }
        };
    }
    // In a browser size counts: falling by nothing leaves every bit as it is.
    if cfg!(target_arch = "wasm32") || sight.fall.is_some() {
        first_with_loops::<D, LATEST, true>(sight, who, ids, except, now, best)
    } else {
        first_with_loops::<D, LATEST, false>(sight, who, ids, except, now, best)
    }
}

#[inline(never)]
fn first_with_loops<const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<D>,
    ids: &[u32],
    except: u32,
    now: f64,
    best: Next,
) -> Found {
    pass::<Loops, D, LATEST, FALLS>(sight, who, ids, except, now, best)
}

#[inline(always)]
fn pass<S: Four, const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<D>,
    ids: &[u32],
    except: u32,
    now: f64,
    best: Next,
) -> Found {
    let own = &who.record;
    let (own_time, own_radius) = (S::all(own.time), S::all(own.radius));
    let zero = S::all(0.0);
    let fall = sight.fall.unwrap_or(Vector::ZERO);
    let mut best = best;
    let mut touched = false;
    let mut at = 0;
    while at < ids.len() {
        // What is missing of the last four is the looker itself, which it does not meet.
        let group: [u32; FOUR] = match ids[at..].first_chunk() {
            Some(four) => *four,
            None => {
                // Not a loop: that becomes a call to copy a few bytes.
                let of = |l: usize| ids.get(at + l).copied().unwrap_or(who.id);
                [of(0), of(1), of(2), of(3)]
            }
        };
        at += FOUR;
        let [e, f, g, h] = group;
        let [e, f, g, h] = [
            &sight.records[e as usize],
            &sight.records[f as usize],
            &sight.records[g as usize],
            &sight.records[h as usize],
        ];
        let t = S::of([e.time, f.time, g.time, h.time]);
        let radius = S::of([e.radius, f.radius, g.radius, h.radius]);
        let since = S::all(now).sub(t);
        let time = if LATEST { own_time } else { own_time.max(t) };
        // Places and velocities relative to the looker, at the later of the two records' times.
        let (mut d, mut w) = ([zero; D], [zero; D]);
        let (mut square, mut speed, mut b) = (zero, zero, zero);
        for k in 0..D {
            let x = S::of([e.x.0[k], f.x.0[k], g.x.0[k], h.x.0[k]]);
            let v = S::of([e.v.0[k], f.v.0[k], g.v.0[k], h.v.0[k]]);
            let pull = S::all(fall.0[k]);
            // Where both are now: this says which image of the box is meant.
            let mean = if LATEST && FALLS { v.add(pull.mul(S::all(0.5).mul(since))) } else { v };
            let away = x.add(mean.mul(since)).sub(S::all(who.here.0[k]));
            let turns = away.mul(S::all(sight.inverse_width.0[k])).add(S::all(TO_INTEGER)).sub(S::all(TO_INTEGER));
            let apart = if LATEST {
                away
            } else {
                let (own_dt, dt) = (time.sub(own_time), time.sub(t));
                let (mut own_mean, mut mean) = (S::all(own.v.0[k]), v);
                if FALLS {
                    own_mean = own_mean.add(pull.mul(S::all(0.5).mul(own_dt)));
                    mean = mean.add(pull.mul(S::all(0.5).mul(dt)));
                }
                let own_x = S::all(own.x.0[k]).add(own_mean.mul(own_dt));
                x.add(mean.mul(dt)).sub(own_x)
            };
            d[k] = apart.sub(turns.mul(S::all(sight.width.0[k])));
            w[k] = if FALLS {
                v.add(pull.mul(time.sub(t))).sub(S::all(own.v.0[k]).add(pull.mul(time.sub(own_time))))
            } else {
                v.sub(S::all(own.v.0[k]))
            };
            square = square.add(d[k].mul(d[k]));
            speed = speed.add(w[k].mul(w[k]));
            b = b.add(d[k].mul(w[k]));
        }
        let reach = own_radius.add(radius);
        let mut close = 0;
        if LATEST {
            let near = reach.add(S::all(TOUCHING).mul(own_radius.min(radius)));
            close = square.less(near.mul(near));
        }
        let c = square.sub(reach.mul(reach)).sub(S::all(COARSE).mul(square));
        let passing = b.mul(b).less(speed.mul(c));
        let sooner = S::all(best.time).sub(time).mul(S::all(1.0 + 1e-9));
        let late = S::all(-2.0).mul(b).mul(sooner).less(c);
        // What is not a number is never less, and goes on to the exact test unless b is it.
        let keep = b.less(zero) & !(passing | late);
        if (keep | close) == 0 {
            continue;
        }
        let stranger = |k: u32| k != except && k != who.id;
        while close != 0 {
            touched |= stranger(group[close.trailing_zeros() as usize & (FOUR - 1)]);
            close &= close - 1;
        }
        if keep == 0 {
            continue;
        }
        // The products of `meet::ball_ball`.
        let distance = square.root();
        let c = distance.sub(reach).mul(distance.add(reach));
        let along = b.div(speed);
        let mut miss = zero;
        for k in 0..D {
            let aside = d[k].sub(w[k].mul(along));
            miss = miss.add(aside.mul(aside));
        }
        let miss = miss.root();
        let discriminant = reach.sub(miss).mul(reach.add(miss));
        let now_ = c.at_most(zero) & keep;
        let meets = zero.less(discriminant) & keep & !now_;
        let times = time.add(c.div(speed.mul(discriminant).root().sub(b))).out();
        let mut left = meets | now_;
        while left != 0 {
            let l = left.trailing_zeros() as usize & (FOUR - 1);
            left &= left - 1;
            let k = group[l];
            if !stranger(k) {
                continue;
            }
            let meeting = if meets >> l & 1 != 0 {
                times[l]
            } else {
                // Touching: hardly ever.
                let other = &sight.records[k as usize];
                let (mut apart, mut closing) = (Vector::<D>::ZERO, Vector::<D>::ZERO);
                for k in 0..D {
                    (apart.0[k], closing.0[k]) = (d[k].out()[l], w[k].out()[l]);
                }
                let at = time.out()[l];
                let speed = |r: &Record<D>| if FALLS { (r.v + fall * (at - r.time)).norm() } else { r.v.norm() };
                at + crept(own, other, apart, closing, speed(own) + speed(other))
            };
            if meeting < best.time || meeting == best.time && meeting < f64::INFINITY && k < best.partner {
                best = Next { time: meeting, partner: k, stamp: sight.stamps[k as usize] };
            }
        }
    }
    Found { next: best, touched }
}

/// Hands those to `found` whose anchors are so near a body's that they may touch before one of them has left its own behind by half of
/// `margins`. False as soon as `found` says so.
#[inline]
pub(super) fn near<const D: usize>(
    sight: &Sight<'_, D>,
    anchors: &[Anchor<D>],
    id: u32,
    margins: f64,
    ids: &[u32],
    found: impl FnMut(u32) -> bool,
) -> bool {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: there is AVX2.
        return unsafe { vectors::near_with_vectors(sight, anchors, id, margins, ids, found) };
    }
    near_of::<Loops, D>(sight, anchors, id, margins, ids, found)
}

#[inline(always)]
fn near_of<S: Four, const D: usize>(
    sight: &Sight<'_, D>,
    anchors: &[Anchor<D>],
    id: u32,
    margins: f64,
    ids: &[u32],
    mut found: impl FnMut(u32) -> bool,
) -> bool {
    let own = &anchors[id as usize];
    let reach = S::all(own.radius + margins);
    for part in ids.chunks(FOUR) {
        let of = |l: usize| part.get(l).copied().unwrap_or(id);
        let group = [of(0), of(1), of(2), of(3)];
        let [e, f, g, h] = group;
        let [e, f, g, h] = [&anchors[e as usize], &anchors[f as usize], &anchors[g as usize], &anchors[h as usize]];
        let mut square = S::all(0.0);
        for k in 0..D {
            let away = S::of([e.x.0[k], f.x.0[k], g.x.0[k], h.x.0[k]]).sub(S::all(own.x.0[k]));
            let turns = away.mul(S::all(sight.inverse_width.0[k])).add(S::all(TO_INTEGER)).sub(S::all(TO_INTEGER));
            let apart = away.sub(turns.mul(S::all(sight.width.0[k])));
            square = square.add(apart.mul(apart));
        }
        let reach = reach.add(S::of([e.radius, f.radius, g.radius, h.radius])).mul(S::all(1.0 + 1e-9));
        let mut left = square.at_most(reach.mul(reach));
        while left != 0 {
            let k = group[left.trailing_zeros() as usize & (FOUR - 1)];
            left &= left - 1;
            if k != id && !found(k) {
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
    use super::*;
    use proptest::prelude::*;
    use std::vec::Vec;

    fn twins<const D: usize>(numbers: &[f64], radii: [f64; 2], latest: bool, falls: bool) {
        // Along an axis that is not periodic.
        let fall = (falls && D > 1).then(|| Vector::from_fn(|k| if k == 1 { -1.7 } else { 0.0 }));
        let g = fall.unwrap_or(Vector::ZERO);
        let at = |r: &Record<D>, time: f64| {
            let dt = time - r.time;
            (r.x + (r.v + g * (0.5 * dt)) * dt, r.v + g * dt)
        };
        let period = 3.0;
        let record = |n: &[f64]| Record {
            x: Vector::<D>::from_fn(|k| period * n[k]),
            v: Vector::from_fn(|k| 2.0 * n[3 + k] - 1.0),
            time: n[6],
            radius: radii[usize::from(n[7] > 0.5)],
        };
        let records: Vec<Record<D>> = numbers.chunks_exact(8).map(record).collect();
        let stamps: Vec<u32> = (0..records.len() as u32).map(|i| i ^ 5).collect();
        // Every other axis is periodic.
        let width = Vector::from_fn(|k| if k % 2 == 0 { period } else { 0.0 });
        let inverse_width = Vector::from_fn(|k| if k % 2 == 0 { 1.0 / period } else { 0.0 });
        let sight = Sight { records: &records, stamps: &stamps, width, inverse_width, fall };
        let ids: Vec<u32> = (0..records.len() as u32).collect();
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
            (first::<D, true>(&sight, &who, &ids, 2, now, NEVER), loops(&sight, &who, &ids, 2, now, NEVER))
        } else {
            (first::<D, false>(&sight, &who, &ids, NOTHING, now, NEVER), loops(&sight, &who, &ids, NOTHING, now, NEVER))
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
                best = Next { time: at, partner: k, stamp: stamps[k as usize] };
            }
        }
        assert_eq!((one.next.time.to_bits(), one.next.partner), (best.time.to_bits(), best.partner));
    }

    proptest! {
        /// Vectors, loops and one after the other give the same bits, in every dimension, for any number of neighbours.
        #[test]
        fn all_ways_are_one(
            numbers in prop::collection::vec(0.0..1.0f64, 16..200),
            radii in [0.01..0.6f64, 0.01..0.6f64],
            latest: bool,
            falls: bool,
        ) {
            twins::<1>(&numbers, radii, latest, falls);
            twins::<2>(&numbers, radii, latest, falls);
            twins::<3>(&numbers, radii, latest, falls);
        }
    }
}
