//! What the machine computes with: four numbers at a time, in plain loops everywhere, and in vectors where there are AVX2 and FMA; memory
//! asked for ahead, and in large pages.
//!
//! # Unsafe code
//! This is the one file that has any.
//! - What is compiled for AVX2, FMA, BMI and POPCNT may only run where there are all of them. [`Vectors`](vectors) is private, and made nowhere but below the functions that are
//!   so compiled, which are called only after the machine has been asked: [`first_two`] asks no more where `VECTORS` says that its caller is so compiled,
//!   and [`World::meet_lean`] says so for `meet_with_vectors` alone. Numbers are read from references to structs that consist of nothing else.
//! - [`in_large_pages`] gives the system the address of memory that is a list's, and hints about it that keep what it holds.
//! - [`fetch`] asks for memory ahead of its use. It reads nothing, and its address is that of an element of a slice.
//!
//! The twin without unsafe code, [`Loops`], runs the same source; the tests of [`fours`](super::fours) compare both, and what a machine without
//! vectors does, bit by bit.
#![allow(unsafe_code)]
use super::lists::{Anchor, List};
use super::sight::{Found, Looker, NEVER, Sight, near_of, pass_by_one};
use super::store::Record;
use super::{Next, World};
use crate::vector::Exact;
use crate::{Rotates, Vector};

/// So many are looked at at a time.
pub(super) const FOUR: usize = 4;

/// Four records, number by number.
#[cfg_attr(not(all(feature = "std", target_arch = "x86_64")), allow(dead_code))]
pub(super) struct Lanes<S, const D: usize> {
    pub x: [S; D],
    pub v: [S; D],
    pub time: S,
    pub radius: S,
}

/// Four numbers, and what is done with them lane by lane. A comparison gives a bit for each lane.
#[cfg_attr(not(all(feature = "std", target_arch = "x86_64")), allow(dead_code))]
pub(super) trait Four: Copy {
    fn all(x: f64) -> Self;
    /// What four records say.
    fn of_records<const D: usize>(four: [&Record<D>; FOUR]) -> Lanes<Self, D>;
    /// Places and radii of four anchors.
    fn of_anchors<const D: usize>(four: [&Anchor<D>; FOUR]) -> ([Self; D], Self);
    fn out(self) -> [f64; FOUR];
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    /// Itself times `factor`, and `term` more or less that; rounded once or twice, as the machine has it: for estimates only.
    fn times_plus(self, factor: Self, term: Self) -> Self;
    fn times_less(self, factor: Self, term: Self) -> Self;
    /// The larger one; `other` where they are equal, or one is not a number.
    fn max(self, other: Self) -> Self;
    /// False where a number is none.
    fn less(self, other: Self) -> u32;
    fn at_most(self, other: Self) -> u32;
    fn root(self) -> Self;
    fn over(self, other: Self) -> Self;
    /// Itself where a bit is set, else infinite.
    fn only(self, bits: u32) -> Self;
    /// Where it is negative, and the discriminant is not.
    fn closing(self, discriminant: Self) -> u32;
    /// Who of these is one of two.
    fn among(ids: [u32; FOUR], two: [u32; 2]) -> u32;
    /// Writes those of a group whose bits are set into a list, one after the other from place `at` on, and anything behind them.
    fn keep(bits: u32, ids: [u32; FOUR], list: &mut [u32], at: usize);
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
    fn times_plus(self, factor: Self, term: Self) -> Self {
        term.add(self.mul(factor))
    }
    #[inline(always)]
    fn times_less(self, factor: Self, term: Self) -> Self {
        term.sub(self.mul(factor))
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.each(self, |a, _| a.sqrt_())
    }
    #[inline(always)]
    fn over(self, other: Self) -> Self {
        self.each(other, |a, b| a / b)
    }
    #[inline(always)]
    fn only(mut self, bits: u32) -> Self {
        for l in 0..FOUR {
            self.0[l] = if bits >> l & 1 == 1 { self.0[l] } else { f64::INFINITY };
        }
        self
    }
    #[inline(always)]
    fn closing(self, discriminant: Self) -> u32 {
        self.test(discriminant, |b, discriminant| b < 0.0 && !(discriminant < 0.0))
    }
    #[inline(always)]
    fn among(ids: [u32; FOUR], two: [u32; 2]) -> u32 {
        let mut bits = 0;
        for l in 0..FOUR {
            bits |= u32::from(two.contains(&ids[l])) << l;
        }
        bits
    }
    #[inline(always)]
    fn keep(bits: u32, ids: [u32; FOUR], list: &mut [u32], mut at: usize) {
        for l in 0..FOUR {
            if let Some(place) = list.get_mut(at) {
                *place = ids[l];
            }
            at += (bits >> l & 1) as usize;
        }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.each(other, |a, b| if a > b { a } else { b })
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
    use super::super::fours::{pass, pass_two};
    use super::{Anchor, FOUR, Found, Four, Lanes, List, Looker, Next, Record, Sight, World, near_of};
    use crate::{Rotates, Vector};
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

    /// For each set of four bits, the places of those that are set, in order, and then of others.
    const ORDER: [[u32; FOUR]; 16] = {
        let mut order = [[0; FOUR]; 16];
        let mut bits = 0;
        while bits < 16 {
            let (mut at, mut l) = (0, 0);
            while l < FOUR {
                if bits >> l & 1 == 1 {
                    order[bits][at] = l as u32;
                    at += 1;
                }
                l += 1;
            }
            bits += 1;
        }
        order
    };

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
        fn times_plus(self, factor: Self, term: Self) -> Self {
            Self(unsafe { _mm256_fmadd_pd(self.0, factor.0, term.0) })
        }
        #[inline(always)]
        fn times_less(self, factor: Self, term: Self) -> Self {
            Self(unsafe { _mm256_fnmadd_pd(self.0, factor.0, term.0) })
        }
        #[inline(always)]
        fn root(self) -> Self {
            Self(unsafe { _mm256_sqrt_pd(self.0) })
        }
        #[inline(always)]
        fn over(self, other: Self) -> Self {
            Self(unsafe { _mm256_div_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn only(self, bits: u32) -> Self {
            let never = Self::all(f64::INFINITY);
            unsafe {
                let bit = _mm256_setr_epi64x(1, 2, 4, 8);
                let set = _mm256_cmpeq_epi64(_mm256_and_si256(_mm256_set1_epi64x(i64::from(bits)), bit), bit);
                Self(_mm256_blendv_pd(never.0, self.0, _mm256_castsi256_pd(set)))
            }
        }
        #[inline(always)]
        fn closing(self, discriminant: Self) -> u32 {
            unsafe {
                let zero = _mm256_setzero_pd();
                let passing = _mm256_cmp_pd::<_CMP_LT_OQ>(discriminant.0, zero);
                let closing = _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, zero);
                _mm256_movemask_pd(_mm256_andnot_pd(passing, closing)) as u32
            }
        }
        #[inline(always)]
        fn among(ids: [u32; FOUR], two: [u32; 2]) -> u32 {
            unsafe {
                let ids = _mm_setr_epi32(ids[0] as i32, ids[1] as i32, ids[2] as i32, ids[3] as i32);
                let one = _mm_cmpeq_epi32(ids, _mm_set1_epi32(two[0] as i32));
                let other = _mm_cmpeq_epi32(ids, _mm_set1_epi32(two[1] as i32));
                _mm_movemask_ps(_mm_castsi128_ps(_mm_or_si128(one, other))) as u32
            }
        }
        #[inline(always)]
        fn keep(bits: u32, ids: [u32; FOUR], list: &mut [u32], at: usize) {
            let order = &ORDER[bits as usize & 15];
            if let Some(place) = list.get_mut(at..).and_then(|rest| rest.first_chunk_mut::<FOUR>()) {
                unsafe {
                    let ids = _mm_setr_epi32(ids[0] as i32, ids[1] as i32, ids[2] as i32, ids[3] as i32);
                    let order = _mm_setr_epi32(order[0] as i32, order[1] as i32, order[2] as i32, order[3] as i32);
                    let kept = _mm_castps_si128(_mm_permutevar_ps(_mm_castsi128_ps(ids), order));
                    *place = [
                        _mm_extract_epi32::<0>(kept) as u32,
                        _mm_extract_epi32::<1>(kept) as u32,
                        _mm_extract_epi32::<2>(kept) as u32,
                        _mm_extract_epi32::<3>(kept) as u32,
                    ];
                }
            }
        }
        #[inline(always)]
        fn max(self, other: Self) -> Self {
            Self(unsafe { _mm256_max_pd(self.0, other.0) })
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

    /// Nothing of it is written for vectors, and nothing is fused: it takes a fifth fewer instructions, for the same bits.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,popcnt")]
    pub(super) fn meet_with_vectors<const D: usize>(world: &mut World<D>, time: f64, i: usize, j: usize) -> bool
    where
        Vector<D>: Rotates,
    {
        world.meet_lean::<true>(time, i, j)
    }

    #[target_feature(enable = "avx2,fma,bmi1,bmi2,popcnt")]
    pub(super) fn near_with_vectors<const D: usize>(
        sight: &Sight<'_, D>,
        anchors: &[Anchor<D>],
        id: u32,
        margins: f64,
        groups: &[[u32; FOUR]],
        list: &mut List,
    ) -> bool {
        near_of::<Vectors, D>(sight, anchors, id, margins, groups, list)
    }

    #[target_feature(enable = "avx2,fma,bmi1,bmi2,popcnt")]
    pub(super) fn first_two_with_vectors<const D: usize, const FALLS: bool>(
        sight: &Sight<'_, D>,
        who: [&Looker<'_, D>; 2],
        groups: [&[[u32; FOUR]]; 2],
        now: f64,
    ) -> [Found; 2] {
        pass_two::<Vectors, D, FALLS>(sight, who, groups, now)
    }

    #[target_feature(enable = "avx2,fma,bmi1,bmi2,popcnt")]
    pub(super) fn first_with_vectors<const D: usize, const LATEST: bool, const FALLS: bool>(
        sight: &Sight<'_, D>,
        who: &Looker<'_, D>,
        groups: &[[u32; FOUR]],
        except: u32,
        now: f64,
        best: Next,
    ) -> Found {
        pass::<Vectors, D, LATEST, FALLS>(sight, who, groups, except, now, best)
    }
}

/// As [`first`], of two that have just met, whose records are of now. `VECTORS` where what calls is compiled for vectors itself.
#[inline(always)]
pub(super) fn first_two<const D: usize, const VECTORS: bool>(
    sight: &Sight<'_, D>,
    who: [&Looker<'_, D>; 2],
    groups: [&[[u32; FOUR]]; 2],
    now: f64,
) -> [Found; 2] {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if VECTORS {
        debug_assert!(has_vectors());
        return if sight.fall.is_some() {
            // SAFETY: the machine was asked, by who called what calls this.
            unsafe { vectors::first_two_with_vectors::<D, true>(sight, who, groups, now) }
        } else {
            // SAFETY: the machine was asked, by who called what calls this.
            unsafe { vectors::first_two_with_vectors::<D, false>(sight, who, groups, now) }
        };
    }
    let one = first::<D, true>(sight, who[0], groups[0], who[1].id, now, NEVER);
    [one, first::<D, true>(sight, who[1], groups[1], who[0].id, now, NEVER)]
}

/// True if the machine has what [`vectors`] is compiled for. Asked several times an impact, so that the answer is kept.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[inline(always)]
fn has_vectors() -> bool {
    use core::sync::atomic::{AtomicU8, Ordering};
    static KNOWN: AtomicU8 = AtomicU8::new(UNKNOWN);
    const UNKNOWN: u8 = 2;
    #[cold]
    fn ask() -> bool {
        let has = std::arch::is_x86_feature_detected!("avx2")
            && std::arch::is_x86_feature_detected!("fma")
            && std::arch::is_x86_feature_detected!("bmi1")
            && std::arch::is_x86_feature_detected!("bmi2")
            && std::arch::is_x86_feature_detected!("popcnt");
        KNOWN.store(u8::from(has), Ordering::Relaxed);
        has
    }
    match KNOWN.load(Ordering::Relaxed) {
        UNKNOWN => ask(),
        known => known == 1,
    }
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

/// Asks for large pages for the memory of a large list: neighbours lie anywhere in it, and who looks them up in pages of 4 kB waits for the
/// table of pages as well. They are taken as the list is filled; of what is `filled` already, pages are put together, which takes a copy. Where
/// the system has none to give, nothing happens.
#[cfg(all(feature = "large-pages", target_os = "linux"))]
pub(super) fn in_large_pages<T>(list: &alloc::vec::Vec<T>, filled: bool) {
    const LARGE: usize = 2 << 20;
    let start = (list.as_ptr() as usize).next_multiple_of(LARGE);
    let end = (list.as_ptr() as usize + list.capacity() * size_of::<T>()) / LARGE * LARGE;
    if start < end {
        let pages: *mut libc::c_void = core::ptr::with_exposed_provenance_mut(start);
        // SAFETY: the pages lie within the list's memory, and neither hint changes what they hold.
        unsafe {
            libc::madvise(pages, end - start, libc::MADV_HUGEPAGE);
            if filled {
                libc::madvise(pages, end - start, libc::MADV_COLLAPSE);
            }
        }
    }
}

/// Elsewhere pages are as the system has them.
#[cfg(not(all(feature = "large-pages", target_os = "linux")))]
pub(super) fn in_large_pages<T>(_: &alloc::vec::Vec<T>, _filled: bool) {}

/// [`World::meet_lean`], compiled for what the machine has.
#[inline]
pub(super) fn meet<const D: usize>(world: &mut World<D>, time: f64, i: usize, j: usize) -> bool
where
    Vector<D>: Rotates,
{
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if has_vectors() {
        // SAFETY: the machine was asked.
        return unsafe { vectors::meet_with_vectors(world, time, i, j) };
    }
    meet_without(world, time, i, j)
}

#[inline(never)]
fn meet_without<const D: usize>(world: &mut World<D>, time: f64, i: usize, j: usize) -> bool
where
    Vector<D>: Rotates,
{
    world.meet_lean::<false>(time, i, j)
}

/// The earliest meeting of a looker with these neighbours (but for itself, which fills up the last group, and `except`), if it is earlier than `best`. `LATEST` says
/// that no neighbour's record is later than the looker's, and that the looker's is of now.
#[inline]
pub(super) fn first<const D: usize, const LATEST: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<'_, D>,
    groups: &[[u32; FOUR]],
    except: u32,
    now: f64,
    best: Next,
) -> Found {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if has_vectors() {
        return if sight.fall.is_some() {
            // SAFETY: the machine was asked.
            unsafe { vectors::first_with_vectors::<D, LATEST, true>(sight, who, groups, except, now, best) }
        } else {
            // SAFETY: the machine was asked.
            unsafe { vectors::first_with_vectors::<D, LATEST, false>(sight, who, groups, except, now, best) }
        };
    }
    // In a browser size counts: falling by nothing leaves every bit as it is.
    if cfg!(target_arch = "wasm32") || sight.fall.is_some() {
        pass_by_one::<D, LATEST, true>(sight, who, groups, except, now, best)
    } else {
        pass_by_one::<D, LATEST, false>(sight, who, groups, except, now, best)
    }
}

/// The twin of what is done with vectors, for tests: the same source, in loops.
#[cfg(test)]
pub(super) fn first_with_loops<const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<'_, D>,
    groups: &[[u32; FOUR]],
    except: u32,
    now: f64,
    best: Next,
) -> Found {
    super::fours::pass::<Loops, D, LATEST, FALLS>(sight, who, groups, except, now, best)
}

/// The same of two, with vectors where there are any.
#[cfg(test)]
pub(super) fn two_by_twins<const D: usize>(
    sight: &Sight<'_, D>,
    who: [&Looker<'_, D>; 2],
    groups: [&[[u32; FOUR]]; 2],
    now: f64,
) -> [[Found; 2]; 2] {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    let two = if has_vectors() {
        first_two::<D, true>(sight, who, groups, now)
    } else {
        first_two::<D, false>(sight, who, groups, now)
    };
    #[cfg(not(all(feature = "std", target_arch = "x86_64")))]
    let two = first_two::<D, false>(sight, who, groups, now);
    let looped = match sight.fall {
        Some(_) => super::fours::pass_two::<Loops, D, true>(sight, who, groups, now),
        None => super::fours::pass_two::<Loops, D, false>(sight, who, groups, now),
    };
    [two, looped]
}

/// Puts those into a list whose anchors are so near a body's that they may touch before one of them has left its own behind by half of
/// `margins`. False if it has no room for them.
#[inline]
pub(super) fn near<const D: usize>(
    sight: &Sight<'_, D>,
    anchors: &[Anchor<D>],
    id: u32,
    margins: f64,
    groups: &[[u32; FOUR]],
    list: &mut List,
) -> bool {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if has_vectors() {
        // SAFETY: the machine was asked.
        return unsafe { vectors::near_with_vectors(sight, anchors, id, margins, groups, list) };
    }
    near_of::<Loops, D>(sight, anchors, id, margins, groups, list)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// Large pages keep what a list holds, and what it is about to hold.
    #[test]
    fn large_pages_change_nothing() {
        let mut list: Vec<u64> = (0..1 << 20).collect();
        in_large_pages(&list, true);
        list.reserve(1 << 20);
        in_large_pages(&list, false);
        list.extend((0..1 << 20).map(|k| k + (1 << 20)));
        in_large_pages(&list, true);
        assert!(list.iter().enumerate().all(|(k, &x)| k as u64 == x));
        in_large_pages::<u64>(&Vec::new(), true);
    }
}
