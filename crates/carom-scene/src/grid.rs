//! Which balls overlap? A grid for each power of two of the radii, so that one large ball among a million small ones costs
//! nothing. Every ball looks only into the cells that it can reach.
use crate::geometry::{Point, minus, norm};

/// Overlaps deeper than this share of the smaller radius are refused; what touches is fine.
pub(crate) const DEEPEST_OVERLAP: f64 = 1e-9;

/// The axes that go round: where they start, and how long they are.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Wrap {
    pub axes: [Option<(f64, f64)>; 3],
}

impl Wrap {
    /// The image of `p` in the cell.
    pub fn in_cell(&self, mut p: Point) -> Point {
        for (x, axis) in p.iter_mut().zip(self.axes) {
            if let Some((min, length)) = axis {
                *x -= length * ((*x - min) / length).floor();
                // The floor may be off by one where the quotient was rounded.
                if *x < min {
                    *x += length;
                }
                if *x >= min + length {
                    *x -= length;
                }
            }
        }
        p
    }

    /// Calls `see` with the image of `p` in the cell, and with those outside that reach into it by `reach`.
    pub fn images(&self, p: Point, reach: f64, mut see: impl FnMut(Point)) {
        let p = self.in_cell(p);
        let mut shifts = [[0.0; 2]; 3];
        let mut counts = [1; 3];
        for k in 0..3 {
            if let Some((min, length)) = self.axes[k] {
                // Not both: a cell is at least four radii wide.
                if p[k] - min < reach {
                    (shifts[k][1], counts[k]) = (length, 2);
                } else if min + length - p[k] < reach {
                    (shifts[k][1], counts[k]) = (-length, 2);
                }
            }
        }
        for i in 0..counts[0] {
            for j in 0..counts[1] {
                for k in 0..counts[2] {
                    see([p[0] + shifts[0][i], p[1] + shifts[1][j], p[2] + shifts[2][k]]);
                }
            }
        }
    }
}

/// The end of a chain.
const NONE: u32 = u32::MAX;

/// The balls of radius 2^(e-2) to 2^(e-1), in cells of size 2^e.
struct Level {
    exponent: i32,
    size: f64,
    /// The ball of each member.
    members: Vec<u32>,
    /// The next member of the same chain.
    next: Vec<u32>,
    /// The first member of each chain; a power of two of them. Cells that share a chain cost time and nothing else.
    heads: Vec<u32>,
}

/// Balls that can be asked who overlaps.
pub(crate) struct Grid {
    dim: usize,
    wrap: Wrap,
    levels: Vec<Level>,
    centres: Vec<Point>,
    radii: Vec<f64>,
    largest: f64,
}

impl Grid {
    pub fn new(dim: usize, wrap: Wrap) -> Self {
        Self { dim, wrap, levels: Vec::new(), centres: Vec::new(), radii: Vec::new(), largest: 0.0 }
    }

    /// Adds a ball; they are numbered from 0.
    pub fn insert(&mut self, centre: Point, radius: f64) {
        let ball = self.centres.len() as u32;
        let centre = self.wrap.in_cell(centre);
        self.centres.push(centre);
        self.radii.push(radius);
        self.largest = self.largest.max(radius);
        let exponent = libm::frexp(2.0 * radius).1;
        let level = match self.levels.iter().position(|l| l.exponent == exponent) {
            Some(k) => k,
            None => {
                self.levels.push(Level {
                    exponent,
                    size: libm::ldexp(1.0, exponent),
                    members: Vec::new(),
                    next: Vec::new(),
                    heads: vec![NONE; 16],
                });
                self.levels.len() - 1
            }
        };
        let (dim, centres) = (self.dim, &self.centres);
        let level = &mut self.levels[level];
        level.members.push(ball);
        level.next.push(NONE);
        let grown = level.members.len() > level.heads.len();
        if grown {
            level.heads = vec![NONE; 4 * level.heads.len()];
        }
        let from = if grown { 0 } else { level.members.len() - 1 };
        for member in from..level.members.len() {
            let cell = cell(centres[level.members[member] as usize], level.size);
            let chain = chain(cell, dim, level.heads.len());
            level.next[member] = std::mem::replace(&mut level.heads[chain], member as u32);
        }
    }

    /// The ball of the lowest number that this one overlaps more deeply than allowed, and the distance of the centres.
    pub fn overlap(&self, centre: Point, radius: f64) -> Option<(usize, f64)> {
        let mut found: Option<(usize, f64)> = None;
        self.each_overlap(centre, radius, |ball, distance| {
            if found.is_none_or(|(least, _)| ball < least) {
                found = Some((ball, distance));
            }
            true
        });
        found
    }

    /// True if this ball overlaps none more deeply than allowed.
    pub fn has_room(&self, centre: Point, radius: f64) -> bool {
        let mut room = true;
        self.each_overlap(centre, radius, |_, _| {
            room = false;
            false
        });
        room
    }

    /// Calls `tell` with every ball that this one overlaps and the distance of the centres, until it returns false.
    fn each_overlap(&self, centre: Point, radius: f64, mut tell: impl FnMut(usize, f64) -> bool) {
        let mut more = true;
        self.wrap.images(centre, radius + self.largest, |centre| {
            for level in &self.levels {
                more = more && self.overlap_in(level, centre, radius, &mut tell);
            }
        });
    }

    /// False if `tell` has said that it is enough.
    fn overlap_in(&self, level: &Level, centre: Point, radius: f64, tell: &mut impl FnMut(usize, f64) -> bool) -> bool {
        let mut see = |member: u32| {
            let ball = level.members[member as usize] as usize;
            let distance = norm(minus(centre, self.centres[ball]));
            let other = self.radii[ball];
            !(radius + other - distance > DEEPEST_OVERLAP * radius.min(other)) || tell(ball, distance)
        };
        // A level's radii are at most half its cell.
        let reach = radius + 0.5 * level.size;
        let low = cell(centre.map(|x| x - reach), level.size);
        let high = cell(centre.map(|x| x + reach), level.size);
        let cells: f64 = (0..self.dim).map(|k| high[k] as f64 - low[k] as f64 + 1.0).product();
        if !(cells < level.members.len() as f64) {
            return (0..level.members.len() as u32).all(see);
        }
        let last = |k: usize| if k < self.dim { high[k] } else { low[k] };
        for x in low[0]..=last(0) {
            for y in low[1]..=last(1) {
                for z in low[2]..=last(2) {
                    let mut member = level.heads[chain([x, y, z], self.dim, level.heads.len())];
                    while member != NONE {
                        if !see(member) {
                            return false;
                        }
                        member = level.next[member as usize];
                    }
                }
            }
        }
        true
    }
}

/// The cell of a point; far beyond all sense it stays at the last one.
fn cell(p: Point, size: f64) -> [i64; 3] {
    p.map(|x| (x / size).floor() as i64)
}

/// The chain of a cell: a multiplicative hash of its numbers.
fn chain(cell: [i64; 3], dim: usize, chains: usize) -> usize {
    let mut hash = 0u64;
    for k in 0..dim {
        hash = (hash ^ cell[k] as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        hash ^= hash >> 29;
    }
    hash as usize & (chains - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same answer as asking every pair, for radii over six powers of ten and with a wrap.
    #[test]
    fn finds_what_all_pairs_find() {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut overlaps = 0;
        for dim in 1..=3 {
            for wrapped in [false, true] {
                let wrap = Wrap { axes: [0, 1, 2].map(|k| (wrapped && k < dim).then_some((-0.5, 2.0))) };
                let mut grid = Grid::new(dim, wrap);
                let mut balls: Vec<(Point, f64)> = Vec::new();
                for _ in 0..600 {
                    let mut p = [0.0; 3];
                    (0..dim).for_each(|k| p[k] = 4.0 * random() - 2.0);
                    let r = 0.5 * libm::pow(10.0, -5.0 * libm::sqrt(random())) * if dim == 1 { 0.01 } else { 1.0 };
                    let mut want = None;
                    for (k, &(q, s)) in balls.iter().enumerate() {
                        let mut d = minus(p, q);
                        if wrapped {
                            d.iter_mut().for_each(|x| *x -= 2.0 * (*x / 2.0).round());
                        }
                        if want.is_none() && r + s - norm(d) > 1e-9 * r.min(s) {
                            want = Some(k);
                        }
                    }
                    let got = grid.overlap(p, r).map(|g| g.0);
                    assert_eq!(got, want, "dim {dim} wrapped {wrapped} {p:?} {r}");
                    overlaps += usize::from(got.is_some());
                    grid.insert(p, r);
                    balls.push((p, r));
                }
            }
        }
        println!("{overlaps} of 3600 overlap");
        assert!(overlaps > 200 && overlaps < 3500);
    }

    #[test]
    fn what_touches_is_fine_and_no_size_is_too_large() {
        let mut grid = Grid::new(2, Wrap::default());
        grid.insert([0.0; 3], 0.1);
        assert!(grid.overlap([0.3, 0.0, 0.0], 0.2).is_none());
        assert!(grid.overlap([0.3 - 0.9e-10, 0.0, 0.0], 0.2).is_none());
        assert!(grid.overlap([0.3 - 1.1e-10, 0.0, 0.0], 0.2).is_some());
        for r in [1e-320, 1e-30, 1.0, 1e30, 1.7e308] {
            for x in [0.0, 1e-300, -1e300] {
                let _ = grid.overlap([x, -x, 0.0], r);
                grid.insert([x, 1e9 + x, 0.0], r);
            }
        }
    }
}
