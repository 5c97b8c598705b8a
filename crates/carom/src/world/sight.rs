//! What a body meets first of those near it, four of them at a time: the innermost loop of a plain world.
//!
//! First a coarse test without a branch; where one of the four may count, all four are predicted exactly, with the products of
//! [`meet::ball_ball`](crate::meet::ball_ball) in the same order, so that the bits are the same whatever the machine computes
//! them with: plain loops everywhere, and vectors of four where the machine has AVX2 and FMA.
//!
//! # Unsafe code
//! This is the one file that has any, for one reason: what is compiled for AVX2 may only run where there are AVX2 and FMA.
//! - [`Vectors`] is private, and made nowhere but below [`first_with_vectors`], which [`first`] calls only after it has asked the
//!   machine. Its operations are inlined there, and take no pointer: all memory is reached through slices that check their bounds.
//! - [`fetch`] asks for memory ahead of its use. It reads nothing, and its address is that of an element of a slice.
//! - The twin without unsafe code, [`Loops`], is compiled from the same source; the tests compare both bit by bit.
#![allow(unsafe_code)]
use super::instant::TOUCHING;
use super::lists::Anchor;
use super::predict::creep;
use super::store::{Matter, Record};
use super::{NOTHING, Next};
use crate::vector::Exact;
use crate::{Vector, meet};

/// So many are looked at at a time.
pub(super) const FOUR: usize = 4;

/// What rounding may do to the coarse tests, relative to the products they are made of: five hundred times the bound of 2 D units
/// in the last place.
const COARSE: f64 = 1e-12;
/// What rounding may do to an estimated time of a meeting, relative to it, is a thousand times less than this leaves.
const A_LITTLE_LESS: f64 = 1.0 - 1e-9;
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

/// Four records, number by number.
struct Lanes<S, const D: usize> {
    x: [S; D],
    v: [S; D],
    time: S,
    radius: S,
}

/// Four numbers, and what is done with them lane by lane. A comparison gives a bit for each lane.
trait Four: Copy {
    fn all(x: f64) -> Self;
    /// What four records say.
    fn of_records<const D: usize>(four: [&Record<D>; FOUR]) -> Lanes<Self, D>;
    /// Places and radii of four anchors.
    fn of_anchors<const D: usize>(four: [&Anchor<D>; FOUR]) -> ([Self; D], Self);
    fn out(self) -> [f64; FOUR];
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    fn root(self) -> Self;
    /// Itself times `factor`, and `term` more or less that; rounded once or twice, as the machine has it: for estimates only.
    fn times_plus(self, factor: Self, term: Self) -> Self;
    fn times_less(self, factor: Self, term: Self) -> Self;
    /// The larger one, or the smaller one; `other` where they are equal, or one is not a number.
    fn max(self, other: Self) -> Self;
    fn min(self, other: Self) -> Self;
    /// False where a number is none.
    fn less(self, other: Self) -> u32;
    fn at_most(self, other: Self) -> u32;
    /// Itself where it is more than `least`, else infinite.
    fn beyond(self, least: Self) -> Self;
    /// This time and c / (sqrt(discriminant) - b), or a little less; infinite unless b < 0, where the discriminant is negative, and for who is
    /// one of `except`. A quotient that is negative or not a number counts as 0.
    fn and_root(self, b: Self, c: Self, discriminant: Self, ids: [u32; FOUR], except: [u32; 2]) -> Self;
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
    fn of_records<const D: usize>([e, f, g, h]: [&Record<D>; FOUR]) -> Lanes<Self, D> {
        let (mut x, mut v) = ([Self([0.0; FOUR]); D], [Self([0.0; FOUR]); D]);
        for k in 0..D {
            x[k] = Self([e.x.0[k], f.x.0[k], g.x.0[k], h.x.0[k]]);
            v[k] = Self([e.v.0[k], f.v.0[k], g.v.0[k], h.v.0[k]]);
        }
        let (time, radius) = ([e.time, f.time, g.time, h.time], [e.radius, f.radius, g.radius, h.radius]);
        Lanes { x, v, time: Self(time), radius: Self(radius) }
    }
    #[inline(always)]
    fn of_anchors<const D: usize>([e, f, g, h]: [&Anchor<D>; FOUR]) -> ([Self; D], Self) {
        let mut x = [Self([0.0; FOUR]); D];
        for k in 0..D {
            x[k] = Self([e.x.0[k], f.x.0[k], g.x.0[k], h.x.0[k]]);
        }
        (x, Self([e.radius, f.radius, g.radius, h.radius]))
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
    fn times_plus(self, factor: Self, term: Self) -> Self {
        term.add(self.mul(factor))
    }
    #[inline(always)]
    fn times_less(self, factor: Self, term: Self) -> Self {
        term.sub(self.mul(factor))
    }
    #[inline(always)]
    fn beyond(self, least: Self) -> Self {
        self.each(least, |a, b| if a > b { a } else { f64::INFINITY })
    }
    #[inline(always)]
    fn and_root(self, b: Self, c: Self, discriminant: Self, ids: [u32; FOUR], except: [u32; 2]) -> Self {
        let mut out = [f64::INFINITY; FOUR];
        for l in 0..FOUR {
            if b.0[l] < 0.0 && !(discriminant.0[l] < 0.0) && !except.contains(&ids[l]) {
                let dt = c.0[l] / (discriminant.0[l].sqrt_() - b.0[l]) * A_LITTLE_LESS;
                out[l] = self.0[l] + if dt > 0.0 { dt } else { 0.0 };
            }
        }
        Self(out)
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
    use super::{A_LITTLE_LESS, Anchor, FOUR, Found, Four, Lanes, Looker, Next, Record, Sight, near_of, pass};
    use core::arch::x86_64::*;

    /// Four numbers in one register. Only for code that is inlined into a function compiled for AVX2.
    #[derive(Clone, Copy)]
    struct Vectors(__m256d);

    /// What consists of numbers (f64) alone, in the order of its fields, `COUNT` of them.
    ///
    /// # Safety
    /// It does, without gaps between them.
    unsafe trait Numbers {
        const COUNT: usize;
    }

    // SAFETY: `repr(C)`, and D + D + 1 + 1 fields of eight bytes.
    unsafe impl<const D: usize> Numbers for Record<D> {
        const COUNT: usize = 2 * D + 2;
    }

    // SAFETY: `repr(C)`, and D + 1 fields of eight bytes.
    unsafe impl<const D: usize> Numbers for Anchor<D> {
        const COUNT: usize = D + 1;
    }

    /// Four numbers of each, from the `first` on: all of the first ones, of the second ones, and so on.
    #[inline(always)]
    fn rows<T: Numbers>(four: [&T; FOUR], first: usize) -> [Vectors; FOUR] {
        assert!(first + FOUR <= T::COUNT);
        let row = |one: &T| {
            // SAFETY: so many numbers lie there.
            unsafe { _mm256_loadu_pd(core::ptr::from_ref(one).cast::<f64>().add(first)) }
        };
        let (e, f, g, h) = (row(four[0]), row(four[1]), row(four[2]), row(four[3]));
        unsafe {
            let (ef, gh) = (_mm256_unpacklo_pd(e, f), _mm256_unpacklo_pd(g, h));
            let (fe, hg) = (_mm256_unpackhi_pd(e, f), _mm256_unpackhi_pd(g, h));
            [
                Vectors(_mm256_permute2f128_pd::<0x20>(ef, gh)),
                Vectors(_mm256_permute2f128_pd::<0x20>(fe, hg)),
                Vectors(_mm256_permute2f128_pd::<0x31>(ef, gh)),
                Vectors(_mm256_permute2f128_pd::<0x31>(fe, hg)),
            ]
        }
    }

    /// Two numbers of each.
    #[inline(always)]
    fn pairs<T: Numbers>(four: [&T; FOUR], first: usize) -> [Vectors; 2] {
        assert!(first + 2 <= T::COUNT);
        let pair = |one: &T| {
            // SAFETY: so many numbers lie there.
            unsafe { _mm_loadu_pd(core::ptr::from_ref(one).cast::<f64>().add(first)) }
        };
        let (e, f, g, h) = (pair(four[0]), pair(four[1]), pair(four[2]), pair(four[3]));
        unsafe {
            let (eg, fh) = (_mm256_set_m128d(g, e), _mm256_set_m128d(h, f));
            [Vectors(_mm256_unpacklo_pd(eg, fh)), Vectors(_mm256_unpackhi_pd(eg, fh))]
        }
    }

    // SAFETY (of every block below): see the head of the file; this code runs where the machine has AVX2, and nowhere else.
    impl Four for Vectors {
        #[inline(always)]
        fn all(x: f64) -> Self {
            Self(unsafe { _mm256_set1_pd(x) })
        }
        #[inline(always)]
        fn of_records<const D: usize>(four: [&Record<D>; FOUR]) -> Lanes<Self, D> {
            // Numbers from the start of a record on: 2 D places and velocities, the time, the radius.
            let one = rows(four, 0);
            let two = if D > 2 { rows(four, 4) } else { one };
            let [time, radius] = if D == 2 { pairs(four, 4) } else { [two[2], two[3]] };
            let (mut x, mut v) = ([one[0]; D], [one[0]; D]);
            for k in 0..D {
                x[k] = one[k];
                v[k] = if D + k < FOUR { one[(D + k) % FOUR] } else { two[(D + k) % FOUR] };
            }
            Lanes { x, v, time, radius }
        }
        #[inline(always)]
        fn of_anchors<const D: usize>(four: [&Anchor<D>; FOUR]) -> ([Self; D], Self) {
            let [e, f, g, h] = four;
            if D < 3 {
                let [first, second] = pairs(four, 0);
                let last = Self(unsafe { _mm256_setr_pd(e.radius, f.radius, g.radius, h.radius) });
                let mut x = [first; D];
                x[D - 1] = if D == 2 { second } else { first };
                return (x, last);
            }
            let all = rows(four, 0);
            let mut x = [all[0]; D];
            #[allow(clippy::manual_memcpy)] // which becomes a call
            for k in 1..D {
                x[k] = all[k];
            }
            (x, all[3])
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
        fn times_plus(self, factor: Self, term: Self) -> Self {
            Self(unsafe { _mm256_fmadd_pd(self.0, factor.0, term.0) })
        }
        #[inline(always)]
        fn times_less(self, factor: Self, term: Self) -> Self {
            Self(unsafe { _mm256_fnmadd_pd(self.0, factor.0, term.0) })
        }
        #[inline(always)]
        fn beyond(self, least: Self) -> Self {
            let never = Self::all(f64::INFINITY);
            Self(unsafe { _mm256_blendv_pd(never.0, self.0, _mm256_cmp_pd::<_CMP_GT_OQ>(self.0, least.0)) })
        }
        #[inline(always)]
        fn and_root(self, b: Self, c: Self, discriminant: Self, ids: [u32; FOUR], except: [u32; 2]) -> Self {
            let (zero, never) = (Self::all(0.0), Self::all(f64::INFINITY));
            let dt = c.div(discriminant.root().sub(b)).mul(Self::all(A_LITTLE_LESS));
            let time = self.add(dt.max(zero));
            unsafe {
                let passing = _mm256_cmp_pd::<_CMP_LT_OQ>(discriminant.0, zero.0);
                let closing = _mm256_cmp_pd::<_CMP_LT_OQ>(b.0, zero.0);
                let ids = _mm_setr_epi32(ids[0] as i32, ids[1] as i32, ids[2] as i32, ids[3] as i32);
                let one = _mm_cmpeq_epi32(ids, _mm_set1_epi32(except[0] as i32));
                let other = _mm_cmpeq_epi32(ids, _mm_set1_epi32(except[1] as i32));
                let out = _mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm_or_si128(one, other)));
                let out = _mm256_or_pd(passing, out);
                Self(_mm256_blendv_pd(never.0, time.0, _mm256_andnot_pd(out, closing)))
            }
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

    #[target_feature(enable = "avx2,fma")]
    pub(super) fn near_with_vectors<const D: usize>(
        sight: &Sight<'_, D>,
        anchors: &[Anchor<D>],
        id: u32,
        margins: f64,
        groups: &[[u32; FOUR]],
        found: impl FnMut(u32) -> bool,
    ) -> bool {
        near_of::<Vectors, D>(sight, anchors, id, margins, groups, found)
    }

    #[target_feature(enable = "avx2,fma")]
    pub(super) fn first_with_vectors<const D: usize, const LATEST: bool, const FALLS: bool>(
        sight: &Sight<'_, D>,
        who: &Looker<D>,
        groups: &[[u32; FOUR]],
        except: u32,
        now: f64,
        best: Next,
    ) -> Found {
        pass::<Vectors, D, LATEST, FALLS>(sight, who, groups, except, now, best)
    }
}

/// The earliest meeting of a looker with these neighbours (but for itself, which fills up the last group, and `except`), if it is earlier than `best`. `LATEST` says
/// that no neighbour's record is later than the looker's, and that the looker's is of now.
#[inline]
pub(super) fn first<const D: usize, const LATEST: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<D>,
    groups: &[[u32; FOUR]],
    except: u32,
    now: f64,
    best: Next,
) -> Found {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma") {
        return if sight.fall.is_some() {
            // SAFETY: there are AVX2 and FMA.
            unsafe { vectors::first_with_vectors::<D, LATEST, true>(sight, who, groups, except, now, best) }
        } else {
            // SAFETY: there are AVX2 and FMA.
            unsafe { vectors::first_with_vectors::<D, LATEST, false>(sight, who, groups, except, now, best) }
        };
    }
    // In a browser size counts: falling by nothing leaves every bit as it is.
    if cfg!(target_arch = "wasm32") || sight.fall.is_some() {
        first_with_loops::<D, LATEST, true>(sight, who, groups, except, now, best)
    } else {
        first_with_loops::<D, LATEST, false>(sight, who, groups, except, now, best)
    }
}

#[inline(never)]
fn first_with_loops<const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<D>,
    groups: &[[u32; FOUR]],
    except: u32,
    now: f64,
    best: Next,
) -> Found {
    pass::<Loops, D, LATEST, FALLS>(sight, who, groups, except, now, best)
}

#[inline(always)]
fn pass<S: Four, const D: usize, const LATEST: bool, const FALLS: bool>(
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

/// First no more than estimates, without a branch: for each neighbour a time that it surely does not meet the looker before. Then the earliest of them
/// exactly, and whoever else may come before what that gave.
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

/// Hands those to `found` whose anchors are so near a body's that they may touch before one of them has left its own behind by half of
/// `margins`. False as soon as `found` says so.
#[inline]
pub(super) fn near<const D: usize>(
    sight: &Sight<'_, D>,
    anchors: &[Anchor<D>],
    id: u32,
    margins: f64,
    groups: &[[u32; FOUR]],
    found: impl FnMut(u32) -> bool,
) -> bool {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma") {
        // SAFETY: there are AVX2 and FMA.
        return unsafe { vectors::near_with_vectors(sight, anchors, id, margins, groups, found) };
    }
    near_of::<Loops, D>(sight, anchors, id, margins, groups, found)
}

#[inline(always)]
fn near_of<S: Four, const D: usize>(
    sight: &Sight<'_, D>,
    anchors: &[Anchor<D>],
    id: u32,
    margins: f64,
    groups: &[[u32; FOUR]],
    mut found: impl FnMut(u32) -> bool,
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
