//! A look at four neighbours at a time, for machines with vectors.
//!
//! First who may meet the looker at all, without a branch: some three of thirteen in a dense gas. Then these exactly, again four at a time, by the
//! products of [`meet::ball_ball`](crate::meet::ball_ball) in their order: the bits are those of a look at one after the other.
use super::Next;
use super::instant::TOUCHING;
use super::machine::{FOUR, Four, Lanes};
use super::sight::{COARSE, Found, Looker, NEVER, Sight, TO_INTEGER, apart_from, is_touching, meets};
use crate::Vector;

/// Whoever is nearer than what counts as touching, a part of the smaller radius, has a square of the distance that is larger than that of the reach by
/// less than this part: somewhat more than [`TOUCHING`].
const NEARLY_TOUCHING: f64 = 1.01 * TOUCHING;
/// So many groups of four are looked through before those of them who may meet the looker are predicted exactly.
const PART: usize = 8;

/// Who may meet a looker, of those near it: numbers in groups of four, of which `count` count.
struct Likely {
    ids: [u32; FOUR * PART + FOUR],
    count: usize,
    touched: bool,
}

impl Likely {
    const NOBODY: Self = Self { ids: [0; FOUR * PART + FOUR], count: 0, touched: false };
}

#[inline(always)]
pub(super) fn pass<S: Four, const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<'_, D>,
    groups: &[[u32; FOUR]],
    except: u32,
    now: f64,
    best: Next,
) -> Found {
    let mut found = Found { next: best, touched: false };
    for part in groups.chunks(PART) {
        let mut likely = Likely::NOBODY;
        find_likely::<S, D, LATEST, FALLS>(sight, who, part, except, now, &mut likely);
        found.touched |= likely.touched;
        if likely.count > 0 {
            soonest::<S, D, LATEST, FALLS>(sight, who, &likely, now, &mut found.next);
        }
    }
    found
}

/// The same of two lookers that have just met. What they wait for, the roots and quotients of the exact predictions, they wait for together.
#[inline(always)]
pub(super) fn pass_two<S: Four, const D: usize, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: [&Looker<'_, D>; 2],
    groups: [&[[u32; FOUR]]; 2],
    now: f64,
) -> [Found; 2] {
    let mut found = [Found { next: NEVER, touched: false }; 2];
    let except = [who[1].id, who[0].id];
    if groups[0].len() > PART || groups[1].len() > PART {
        for k in 0..2 {
            found[k] = pass::<S, D, true, FALLS>(sight, who[k], groups[k], except[k], now, NEVER);
        }
        return found;
    }
    let mut both = [Likely::NOBODY; 2];
    for k in 0..2 {
        find_likely::<S, D, true, FALLS>(sight, who[k], groups[k], except[k], now, &mut both[k]);
    }
    for k in 0..2 {
        found[k].touched = both[k].touched;
        soonest::<S, D, true, FALLS>(sight, who[k], &both[k], now, &mut found[k].next);
    }
    found
}

/// Those of at most [`PART`] groups that may meet the looker: who nears it, and does not pass by for sure; and whether somebody touches it.
#[inline(always)]
fn find_likely<S: Four, const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<'_, D>,
    groups: &[[u32; FOUR]],
    except: u32,
    now: f64,
    likely: &mut Likely,
) {
    let own = who.record;
    let own_radius = S::all(own.radius);
    let zero = S::all(0.0);
    let mut close = 0u32;
    let mut count = 0;
    for at in 0..groups.len().min(PART) {
        let others = !S::among(groups[at], [who.id, except]);
        let Apart { d, w, radius, .. } = apart::<S, D, LATEST, FALLS>(sight, who, groups[at], now);
        let (mut square, mut speed, mut b) = (zero, zero, zero);
        for k in 0..D {
            square = d[k].times_plus(d[k], square);
            speed = w[k].times_plus(w[k], speed);
            b = d[k].times_plus(w[k], b);
        }
        let reach = own_radius.add(radius);
        // Less than the gap, and more than the discriminant, by more than rounding.
        let c = S::all(COARSE).times_less(square, reach.times_less(reach, square));
        if LATEST {
            close |= (c.less(square.mul(S::all(NEARLY_TOUCHING))) & others) << (FOUR * at);
        }
        let squared = b.mul(b);
        let discriminant = S::all(2.0 * COARSE).times_plus(squared, speed.times_less(c, squared));
        let closing = b.closing(discriminant) & others;
        S::keep(closing, groups[at], &mut likely.ids, count);
        count += closing.count_ones() as usize;
    }
    likely.count = count;
    while close != 0 {
        let l = close.trailing_zeros() as usize;
        close &= close - 1;
        likely.touched |= touches::<D, LATEST, FALLS>(sight, who, groups[l / FOUR][l % FOUR], now);
    }
}

/// Who of these meets the looker first, if that is earlier than `best`.
#[inline(always)]
fn soonest<S: Four, const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<'_, D>,
    likely: &Likely,
    now: f64,
    best: &mut Next,
) {
    let mut at = 0;
    loop {
        let [e, f, g, h] = [likely.ids[at], likely.ids[at + 1], likely.ids[at + 2], likely.ids[at + 3]];
        let live = (1u32 << likely.count.saturating_sub(at).min(FOUR)) - 1;
        four_exactly::<S, D, LATEST, FALLS>(sight, who, [e, f, g, h], live, now, best);
        at += FOUR;
        if at >= likely.count {
            return;
        }
    }
}

/// As [`exactly`], of four at a time: the same products in the same order as [`ball_ball`](crate::meet::ball_ball) has them.
#[inline(always)]
fn four_exactly<S: Four, const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<'_, D>,
    ids: [u32; FOUR],
    live: u32,
    now: f64,
    best: &mut Next,
) {
    let Apart { d, w, radius, time } = apart::<S, D, LATEST, FALLS>(sight, who, ids, now);
    let zero = S::all(0.0);
    let reach = S::all(who.record.radius).add(radius);
    let (mut b, mut a, mut square) = (zero, zero, zero);
    for k in 0..D {
        b = b.add(d[k].mul(w[k]));
        a = a.add(w[k].mul(w[k]));
        square = square.add(d[k].mul(d[k]));
    }
    let distance = square.root();
    let c = distance.sub(reach).mul(distance.add(reach));
    let ratio = b.over(a);
    let mut aside = zero;
    for k in 0..D {
        let foot = d[k].sub(w[k].mul(ratio));
        aside = aside.add(foot.mul(foot));
    }
    let miss = aside.root();
    let clear = reach.sub(miss).mul(reach.add(miss));
    let times = time.add(c.over(a.mul(clear).root().sub(b)));
    let closing = b.less(zero) & live;
    let mut touching = c.at_most(zero) & closing;
    let meets = closing & zero.less(clear) & zero.less(c);
    let times = times.only(meets);
    let first = least(times);
    if first < f64::INFINITY && first <= best.time {
        let mut come = times.at_most(S::all(first));
        while come != 0 {
            let k = ids[come.trailing_zeros() as usize & (FOUR - 1)];
            come &= come - 1;
            if first < best.time || k < best.partner {
                *best = Next { time: first, partner: k, stamp: sight.matter[k as usize].stamp };
            }
        }
    }
    // Hardly ever.
    while touching != 0 {
        exactly::<D, LATEST, FALLS>(sight, who, ids[touching.trailing_zeros() as usize & (FOUR - 1)], now, best);
        touching &= touching - 1;
    }
}

/// Where four neighbours are and how fast, relative to the looker, at the later of the two records' times, that time, and their radii.
struct Apart<S, const D: usize> {
    d: [S; D],
    w: [S; D],
    time: S,
    radius: S,
}

/// As [`apart_from`] has it, to the bit: far from the origin, or in a fast frame, a difference has few digits.
#[inline(always)]
fn apart<S: Four, const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<'_, D>,
    ids: [u32; FOUR],
    now: f64,
) -> Apart<S, D> {
    let own = who.record;
    let own_time = S::all(own.time);
    let fall = sight.fall.unwrap_or(Vector::ZERO);
    let [e, f, g, h] = ids;
    let records = sight.records;
    let Lanes { x, v, time: t, radius } =
        S::of_records([&records[e as usize], &records[f as usize], &records[g as usize], &records[h as usize]]);
    let since = S::all(now).sub(t);
    let time = if LATEST { own_time } else { own_time.max(t) };
    let (mut d, mut w) = ([since; D], [since; D]);
    for k in 0..D {
        let pull = S::all(fall.0[k]);
        // Where both are now says which image of the box is meant.
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
        d[k] = apart.sub(turns.mul(S::all(sight.width.0[k])));
        w[k] = if FALLS {
            let (own_dt, dt) = (time.sub(own_time), time.sub(t));
            v[k].add(pull.mul(dt)).sub(S::all(own.v.0[k]).add(pull.mul(own_dt)))
        } else {
            v[k].sub(S::all(own.v.0[k]))
        };
    }
    Apart { d, w, time, radius }
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
    who: &Looker<'_, D>,
    k: u32,
    now: f64,
) -> bool {
    let (d, _, _) = apart_from::<D, LATEST, FALLS>(sight, who, k, now);
    is_touching(d.norm_squared(), who.record.radius, sight.records[k as usize].radius)
}

/// When the looker meets a neighbour, if that is earlier than `best`.
#[cold]
#[inline(never)]
fn exactly<const D: usize, const LATEST: bool, const FALLS: bool>(
    sight: &Sight<'_, D>,
    who: &Looker<'_, D>,
    k: u32,
    now: f64,
    best: &mut Next,
) {
    meets::<D, FALLS>(sight, who, k, apart_from::<D, LATEST, FALLS>(sight, who, k, now), best);
}

#[cfg(test)]
mod tests {
    use super::super::NOTHING;
    use super::super::machine::{first, first_with_loops, two_by_twins};
    use super::super::sight::{crept, pass_by_one};
    use super::super::store::{Matter, Record};
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
        let who = Looker { id: 1, record: &record, here: &here };
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
        let by_one = match (latest, falls) {
            (true, true) => pass_by_one::<D, true, true>,
            (true, false) => pass_by_one::<D, true, false>,
            (false, true) => pass_by_one::<D, false, true>,
            (false, false) => pass_by_one::<D, false, false>,
        };
        let three = by_one(&sight, &who, &groups, if latest { 2 } else { NOTHING }, now, NEVER);
        let told = |found: &Found| (found.next.time.to_bits(), found.next.partner, found.next.stamp, found.touched);
        assert_eq!(told(&one), told(&two));
        assert_eq!(told(&one), told(&three));
        if latest && records.len() > 2 {
            // Two at once are one and another.
            let other = Record { time: now, ..records[2] };
            let second = Looker { id: 2, record: &other, here: &other.x };
            let first_alone = first::<D, true>(&sight, &who, &groups, 2, now, NEVER);
            let second_alone = first::<D, true>(&sight, &second, &groups, 1, now, NEVER);
            for [a, b] in two_by_twins(&sight, [&who, &second], [&groups, &groups], now) {
                assert_eq!([told(&a), told(&b)], [told(&first_alone), told(&second_alone)]);
            }
        }
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
