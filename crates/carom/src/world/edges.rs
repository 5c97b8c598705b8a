//! Where the edges of the cells lie along each axis: evenly, or, where densities differ, closer together where bodies crowd.
//!
//! Even cells are made for the mean density. A heap under a gas, or a heap and one ball that flies away, would lie in a few of them, and
//! every look would be at everybody. So edges follow the density along each axis: where a slab across the axis holds mostly crowded
//! bodies, its cells are as narrow as these want them, and empty space is one wide cell. What happens is the same either way.
use super::cells::Space;
use crate::Vector;
use alloc::{vec, vec::Vec};

/// Cells may not be many more than bodies, in a wide world of few bodies.
const CELLS_PER_BODY: f64 = 2.0;
const MOST_PER_BODY: u64 = 8;
/// Uneven cells may be so many times what even ones would be, since some of them lie where nobody is.
const MORE: f64 = 1.5;
/// Densities are counted in boxes of so many bodies.
const COUNTED: f64 = 16.0;
/// There are not more boxes than so many to a body, and so many. Gaps of all scales, along all axes, would make more.
const MOST_BOXES: u64 = 32;
const LEAST_BOXES: u64 = 1 << 16;
/// Fewer bodies than this are looked at evenly.
const LEAST_COUNTED: usize = 64;
/// So many bodies, evenly chosen, say where slabs lie.
const SAMPLE: usize = 4096;
/// By so much the share of the emptiest slab shrinks at a time while there are too many cells.
const NARROWER: f64 = 0.75;
/// The slabs at the ends hold so many times fewer each.
const TAIL: usize = 4;
/// Where more than this part of the bodies want cells narrower than even ones by this factor, cells are not even.
const MINORITY: f64 = 0.25;
const UNEVEN: f64 = 1.5;

/// The edges of all axes, one after the other.
#[derive(Clone, Debug)]
pub(super) struct Edges<const D: usize> {
    /// Cells along each axis, of which there is one edge more; where its edges begin.
    pub count: [u32; D],
    first: [usize; D],
    at: Vec<f64>,
    /// What separates even edges; 0 where they are not.
    pitch: Vector<D>,
    /// From the first edge to the last (m).
    extent: Vector<D>,
}

/// How bodies are spread over a space in which densities differ.
#[derive(Clone, Debug)]
pub(super) struct Spread<const D: usize> {
    slabs: Edges<D>,
    /// In each slab the density (bodies to the m^D) in which its bodies find themselves, and how many they are.
    density: [Vec<f64>; D],
    bodies: [Vec<f64>; D],
    periodic: [bool; D],
    /// The density in which all bodies find themselves, on average.
    pub around: f64,
}

impl<const D: usize> Edges<D> {
    fn laid(space: &Space<D>, axes: [Vec<f64>; D], pitch: Vector<D>) -> Self {
        let (mut count, mut first, mut at) = ([1; D], [0; D], Vec::new());
        for (k, edges) in axes.iter().enumerate() {
            count[k] = (edges.len() as u32).saturating_sub(1);
            first[k] = at.len();
            at.extend_from_slice(edges);
        }
        Self { count, first, at, pitch, extent: Vector::from_fn(|k| space.high[k] - space.low[k]) }
    }

    /// One cell.
    pub fn one(space: &Space<D>) -> Self {
        Self::even(space, [1; D])
    }

    /// So many cells along each axis, all equally wide.
    pub fn even(space: &Space<D>, count: [u32; D]) -> Self {
        let pitch = Vector::from_fn(|k| {
            let extent = space.high[k] - space.low[k];
            if extent > 0.0 { extent / f64::from(count[k]) } else { 1.0 }
        });
        let axis = |k: usize| (0..=count[k]).map(|n| space.low[k] + f64::from(n) * pitch[k]).collect();
        Self::laid(space, core::array::from_fn(axis), pitch)
    }

    /// Cells for `bodies` bodies spread evenly: `wanted` to a body, times `scale` in width, but none narrower than `least`.
    pub fn for_mean(space: &Space<D>, bodies: usize, least: f64, scale: f64, wanted: f64) -> Self {
        let extent = Vector::<D>::from_fn(|k| space.high[k] - space.low[k]);
        let mut volume = 1.0;
        for k in 0..D {
            volume *= if extent[k] > least { extent[k] } else { least };
        }
        let most = bodies as f64 * CELLS_PER_BODY.max(wanted) + 64.0;
        let width = libm::pow(volume / (bodies.max(1) as f64 * wanted), 1.0 / D as f64) * scale;
        let width = if width > least { width } else { least };
        let mut count = [1u32; D];
        for k in 0..D {
            let fit = extent[k] / width;
            // A thin world may put all its cells along one axis.
            count[k] = (if fit < most { fit } else { most } as u32).max(1);
        }
        // No more cells in all than the bodies deserve.
        while product(&count) > (bodies as u64 + 64) * MOST_PER_BODY {
            let widest = (0..D).max_by_key(|&k| count[k]).unwrap_or(0);
            count[widest] = (count[widest] / 2).max(1);
        }
        Self::even(space, count)
    }

    /// Cells for bodies that are spread like this.
    pub fn for_spread(
        space: &Space<D>,
        bodies: usize,
        least: f64,
        scale: f64,
        wanted: f64,
        spread: &Spread<D>,
    ) -> Self {
        let most = MORE * bodies as f64 * wanted.max(1.0) + 64.0;
        let mut shares: [Vec<f64>; D] = core::array::from_fn(|k| spread.shares(k, least, scale, wanted));
        let cells = |shares: &[f64]| libm::floor(shares.iter().sum()).max(1.0);
        let mut count = shares.each_ref().map(|shares| cells(shares));
        // Where a layer of cells across the space holds the fewest bodies, layers get wider, until there are few enough.
        while count.iter().product::<f64>() > most {
            let mut emptiest = (0.0, 0, 0);
            for k in 0..D {
                for (s, (share, bodies)) in shares[k].iter().zip(&spread.bodies[k]).enumerate() {
                    let emptiness = share / ((bodies + 1.0) * count[k]);
                    if emptiness > emptiest.0 {
                        emptiest = (emptiness, k, s);
                    }
                }
            }
            let (_, k, s) = emptiest;
            shares[k][s] *= NARROWER;
            count[k] = cells(&shares[k]);
        }
        let axes = core::array::from_fn(|k| spread.edges(k, &shares[k], count[k]));
        Self::laid(space, axes, Vector::ZERO)
    }

    /// The edge (m) below cell `n` of axis `k`, or above the last.
    #[inline(always)]
    pub fn at(&self, k: usize, n: u32) -> f64 {
        self.at[self.first[k] + n as usize]
    }

    /// How far apart along axis `k` the same place in two neighbouring images of the box lies (m).
    #[inline(always)]
    pub fn extent(&self, k: usize) -> f64 {
        self.extent[k]
    }

    /// The cell in which a coordinate lies, the first or the last one if it lies outside.
    #[inline]
    pub fn cell(&self, k: usize, x: f64) -> u32 {
        let n = if self.pitch[k] > 0.0 {
            // Saturates, and takes NaN to 0.
            ((x - self.at(k, 0)) / self.pitch[k]) as u32
        } else {
            let own = &self.at[self.first[k] + 1..][..self.count[k] as usize];
            own.partition_point(|&edge| edge <= x) as u32
        };
        n.min(self.count[k] - 1)
    }

    /// True if along this axis, which is periodic, two neighbouring cells are narrower than half of the box: of all images of a ball nearby
    /// only one is nearest.
    pub fn is_wide(&self, k: usize) -> bool {
        let n = self.count[k];
        n >= 5 && (1..n).all(|c| self.at(k, c + 1) - self.at(k, c - 1) < 0.45 * self.extent[k])
    }

    fn width(&self, k: usize, n: u32) -> f64 {
        self.at(k, n + 1) - self.at(k, n)
    }

    /// The number of bodies in each cell.
    fn counted(&self, places: &[Vector<D>]) -> Vec<u32> {
        let mut counted = vec![0u32; product(&self.count) as usize];
        for x in places {
            let index = (0..D).rev().fold(0, |index, k| index * self.count[k] as usize + self.cell(k, x[k]) as usize);
            counted[index] += 1;
        }
        counted
    }
}

impl<const D: usize> Spread<D> {
    /// How these bodies are spread; `None` where even cells are as good.
    pub fn of(space: &Space<D>, places: &[Vector<D>]) -> Option<Self> {
        if places.len() < LEAST_COUNTED {
            return None;
        }
        let mut volume = 1.0;
        for k in 0..D {
            volume *= space.high[k] - space.low[k];
        }
        if !places.iter().all(|x| x.is_finite()) {
            return None;
        }
        let slabs = Self::slabs(space, places);
        if product(&slabs.count) > places.len() as u64 * MOST_BOXES + LEAST_BOXES {
            return None;
        }
        let spread = Self::counted(space, slabs, places);
        let even = libm::pow(volume / places.len() as f64, 1.0 / D as f64);
        (spread.around.is_finite() && spread.is_uneven(even)).then_some(spread)
    }

    /// Slabs that hold as many bodies each, by a sample; at both ends, of all bodies there, ever fewer; and what is empty by itself.
    fn slabs(space: &Space<D>, places: &[Vector<D>]) -> Edges<D> {
        let many = (libm::pow(places.len() as f64 / COUNTED, 1.0 / D as f64).min(64.0) as usize).max(1);
        let axes = core::array::from_fn(|k| {
            let sorted = |mut x: Vec<f64>| {
                x.sort_unstable_by(f64::total_cmp);
                x
            };
            let x = sorted(places.iter().step_by(places.len().div_ceil(SAMPLE)).map(|x| x[k]).collect());
            let tail = x.len() / many / TAIL;
            let (first, last) = (x[tail], x[x.len() - 1 - tail]);
            let below = sorted(places.iter().map(|x| x[k]).filter(|x| *x <= first).collect());
            let above = sorted(places.iter().map(|x| x[k]).filter(|x| *x >= last).collect());
            let fewer = |n: usize| core::iter::successors(Some(n), |n| Some(n / TAIL)).take_while(|n| *n > 0);
            let mut ends: Vec<f64> = fewer(below.len() - 1).map(|n| below[n]).collect();
            ends.extend((1..many).map(|n| x[n * x.len() / many]));
            ends.extend(fewer(above.len()).map(|n| above[above.len() - n]));
            let quartiles = [1, 2, 3].map(|n| x[n * x.len() / 4]);
            for x in [&below, &x, &above] {
                ends.extend(x.windows(2).flat_map(|pair| around_gap(pair[0], pair[1], quartiles, many as f64)));
            }
            let mut edges = vec![space.low[k]];
            edges.extend(sorted(ends).into_iter().filter(|x| space.low[k] < *x && *x < space.high[k]));
            edges.dedup();
            edges.push(space.high[k]);
            edges
        });
        Edges::laid(space, axes, Vector::ZERO)
    }

    /// The densities in these slabs: what bodies see around them. Of n bodies in a box each sees n - 1.
    fn counted(space: &Space<D>, slabs: Edges<D>, places: &[Vector<D>]) -> Self {
        let counted = slabs.counted(places);
        let of = |k: usize| vec![0.0; slabs.count[k] as usize];
        let (mut seen, mut bodies): ([Vec<f64>; D], [Vec<f64>; D]) =
            (core::array::from_fn(of), core::array::from_fn(of));
        let mut around = 0.0;
        for (index, &n) in counted.iter().enumerate().filter(|(_, n)| **n > 0) {
            let (mut rest, mut volume, mut cell) = (index, 1.0, [0; D]);
            for k in 0..D {
                cell[k] = rest % slabs.count[k] as usize;
                rest /= slabs.count[k] as usize;
                volume *= slabs.width(k, cell[k] as u32);
            }
            let n = f64::from(n);
            let sees = n * (n - 1.0) / volume;
            around += sees;
            for k in 0..D {
                seen[k][cell[k]] += sees;
                bodies[k][cell[k]] += n;
            }
        }
        for k in 0..D {
            for (seen, n) in seen[k].iter_mut().zip(&bodies[k]) {
                *seen = if *n > 0.0 { *seen / n } else { 0.0 };
            }
        }
        Self { slabs, density: seen, bodies, periodic: space.periodic, around: around / places.len() as f64 }
    }

    /// True if cells of this width are too wide for many of the bodies.
    fn is_uneven(&self, even: f64) -> bool {
        let dense = libm::pow(even / UNEVEN, -(D as f64));
        self.density.iter().zip(&self.bodies).any(|(density, bodies)| {
            let crowded: f64 =
                density.iter().zip(bodies).filter(|(density, _)| **density > dense).map(|(_, n)| n).sum();
            crowded > MINORITY * bodies.iter().sum::<f64>()
        })
    }

    /// How many cells fit into each slab of axis `k`: for `wanted` cells a body, times `scale` in width, none narrower than `least`. A wide slab
    /// of few bodies is mostly empty, however close these are. Along a periodic axis no cell is so wide that images are in doubt
    /// ([`Edges::is_wide`]).
    fn shares(&self, k: usize, least: f64, scale: f64, wanted: f64) -> Vec<f64> {
        let extent = self.slabs.extent(k) / if self.periodic[k] { 6.0 } else { 1.0 };
        let share = |s: usize| {
            let width = (libm::pow(wanted * self.density[k][s], -1.0 / D as f64) * scale).max(least);
            let fit = self.slabs.width(k, s as u32) / if width < extent { width } else { extent };
            let most = (self.bodies[k][s] + 1.0) * wanted.max(1.0);
            fit.min(if self.periodic[k] { most.max(self.slabs.width(k, s as u32) / extent) } else { most })
        };
        (0..self.density[k].len()).map(share).collect()
    }

    /// The edges of so many cells along axis `k`: each takes the same share of what fits.
    fn edges(&self, k: usize, shares: &[f64], cells: f64) -> Vec<f64> {
        let step = shares.iter().sum::<f64>() / cells;
        let mut edges = vec![self.slabs.at(k, 0)];
        let mut sum = 0.0;
        for (s, &share) in shares.iter().enumerate() {
            let (low, width) = (self.slabs.at(k, s as u32), self.slabs.width(k, s as u32));
            let mut next = step * edges.len() as f64;
            while next < sum + share && (edges.len() as f64) < cells {
                edges.push(low + width * ((next - sum) / share));
                next = step * edges.len() as f64;
            }
            sum += share;
        }
        edges.push(self.slabs.at(k, self.slabs.count[k]));
        edges
    }
}

/// Edges around a gap between two neighbouring coordinates that is wider than all there is between it and the middle, and not much less wide
/// than where half of the bodies are: close behind the lower one, by a slab of what is there, and at the upper one. None for other gaps.
fn around_gap(low: f64, high: f64, quartiles: [f64; 3], slabs: f64) -> impl Iterator<Item = f64> {
    let [first, middle, last] = quartiles;
    let gap = high - low;
    let (inner, behind) = if low >= middle { (low - middle, (low - middle) / slabs) } else { (middle - high, 0.0) };
    let wide = inner >= 0.0 && gap > inner && gap > 0.75 * (last - first);
    let behind = if behind > 1e-3 * gap { behind } else { 1e-3 * gap };
    [low + if behind < 0.5 * gap { behind } else { 0.5 * gap }, high].into_iter().filter(move |_| wide)
}

fn product<const D: usize>(count: &[u32; D]) -> u64 {
    count.iter().fold(1, |all, &n| all.saturating_mul(u64::from(n)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Clumps of bodies: where each is, how wide, how many.
    fn clumps() -> impl Strategy<Value = Vec<(f64, f64, f64, f64, usize)>> {
        let place = || -1e3..1e3f64;
        prop::collection::vec(
            (place(), place(), place(), prop_oneof![0.0..1.0f64, 0.0..1e3f64, Just(1e9)], 1..200usize),
            1..5,
        )
    }

    fn places(clumps: &[(f64, f64, f64, f64, usize)]) -> Vec<Vector<3>> {
        // Fractions of multiples of 1/g, 1/g^2 and 1/g^3, where g^4 = g + 1, fill a cube evenly.
        let even = |n: usize| [0.819_172_513, 0.671_043_607, 0.549_700_478].map(|a: f64| (a * n as f64).fract());
        let of = |&(x, y, z, wide, n): &(f64, f64, f64, f64, usize)| {
            (0..n).map(move |k| Vector([x, y, z]) + Vector(even(k)) * wide)
        };
        clumps.iter().flat_map(of).collect()
    }

    fn space_of(places: &[Vector<3>]) -> Space<3> {
        let fold = |k: usize, pick: fn(f64, f64) -> f64| places.iter().map(|x| x[k]).reduce(pick).unwrap_or(0.0);
        let low = Vector::from_fn(|k| fold(k, f64::min));
        Space { low, high: Vector::from_fn(|k| fold(k, f64::max).max(low[k] + 1e-3)), periodic: [false; 3] }
    }

    proptest! {
        #[test]
        fn edges_ascend_from_end_to_end_and_no_cell_is_too_narrow(clumps in clumps(), least in 1e-3..10.0f64) {
            let places = places(&clumps);
            let space = space_of(&places);
            let n = places.len();
            let mean = Edges::for_mean(&space, n, least, 1.0, 1.0);
            let spread = Spread::of(&space, &places).map(|spread| Edges::for_spread(&space, n, least, 1.0, 1.0, &spread));
            for edges in [Some(mean), spread].into_iter().flatten() {
                prop_assert!(product(&edges.count) <= 8 * (n as u64 + 64));
                for k in 0..3 {
                    let all: Vec<f64> = (0..=edges.count[k]).map(|n| edges.at(k, n)).collect();
                    let extent = space.high[k] - space.low[k];
                    prop_assert_eq!(all[0], space.low[k]);
                    prop_assert!((all[all.len() - 1] - space.high[k]).abs() <= 1e-12 * space.high[k].abs().max(extent));
                    if all.len() > 2 {
                        for pair in all.windows(2) {
                            prop_assert!(pair[1] - pair[0] >= least * (1.0 - 1e-9), "{pair:?} and {least}");
                        }
                    }
                    for x in &places {
                        let c = edges.cell(k, x[k]);
                        let slack = 1e-9 * extent;
                        prop_assert!(all[c as usize] <= x[k] + slack && x[k] - slack <= all[c as usize + 1]);
                    }
                }
            }
        }

        /// Whoever looks at the bodies in its cell looks at few, wherever the others are.
        #[test]
        fn a_clump_is_divided_wherever_the_others_are(many in 500..20_000usize, far in 1e3..1e9f64, narrow in 0.1..10.0f64) {
            let places = places(&[(0.0, 0.0, 0.0, narrow, many), (far, -far, far, 1.0, 1)]);
            let space = space_of(&places);
            let mean = Edges::for_mean(&space, places.len(), 1e-6, 1.0, 1.0);
            let spread = Spread::of(&space, &places).expect("nothing is less even");
            let edges = Edges::for_spread(&space, places.len(), 1e-6, 1.0, 1.0, &spread);
            prop_assert_eq!(mean.counted(&places).into_iter().max(), Some(many as u32));
            let most = edges.counted(&places).into_iter().max();
            prop_assert!(most < Some(30), "{most:?}: {spread:?} {edges:?}");
        }

        /// Nobody knows where: scales from 2^-400 to 2^400 m, and what is not a number.
        #[test]
        fn bodies_of_all_scales_are_counted_in_few_boxes(many in 64..900usize, broken in prop::option::of(0..64usize)) {
            let mut places: Vec<Vector<3>> = (0..many)
                .map(|n| Vector::from_fn(|k| (1.0 - 2.0 * (n % 2) as f64) * libm::exp2((n + k) as f64 - 400.0)))
                .collect();
            let space = space_of(&places);
            if let Some(n) = broken {
                places[n].0[n % 3] = [f64::NAN, f64::INFINITY][n % 2];
            }
            if let Some(spread) = Spread::of(&space, &places) {
                prop_assert!(product(&spread.slabs.count) <= MOST_BOXES * many as u64 + LEAST_BOXES);
                let edges = Edges::for_spread(&space, many, 1e-3, 1.0, 3.0, &spread);
                prop_assert!(product(&edges.count) <= MOST_PER_BODY * (many as u64 + 64));
            }
        }

        /// Bodies thrown evenly have even cells.
        #[test]
        fn an_even_gas_has_even_cells(many in 64..4000usize) {
            let places = places(&[(0.0, 0.0, 0.0, 10.0, many)]);
            prop_assert!(Spread::of(&space_of(&places), &places).is_none());
        }
    }
}
