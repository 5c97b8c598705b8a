//! A Cholesky factor over the bodies of a heap, for slices: fewer unknowns than contacts, and dense blocks.
//!
//! ```text
//! K = shift 1 + C_A C_A^T,      (C_A^T C_A + shift)^-1 r = (r - C_A^T K^-1 C_A r) / shift
//! ```
//!
//! Bodies are neighbours where they share a contact. The order takes the body of fewest neighbours first (`sparse.rs`); bodies
//! that have nearly the same neighbours then are eliminated together, as one front: a small dense matrix of them and of their
//! neighbours, to which the fronts below add what they leave (the multifrontal method; Duff & Reid 1983). Order and fronts
//! serve as long as the same bodies are near each other, whichever of their contacts are active.
//!
//! K loses digits as the shift falls: lambda comes out to eps / shift. Slices, which need eight digits, can have that.
use alloc::{vec, vec::Vec};

use super::columns::Columns;
use super::sparse::Graph;
use crate::vector::Exact;

/// A front takes in one below it if the numbers it stores in vain are at most this part of what the lower one has.
const VAIN: f64 = 0.25;
/// So many bodies are a small front, which is always taken in.
const SMALL: usize = 5;
/// Columns that are eliminated together.
const BLOCK: usize = 4;
const NONE: u32 = u32::MAX;

/// Bodies that are eliminated together.
#[derive(Clone, Copy, Debug, Default)]
struct Front {
    /// Its rows: `rows[first..last]`, of which the first `own` are eliminated here.
    first: usize,
    last: usize,
    own: usize,
    /// Where its numbers stand in `lower`.
    at: usize,
    /// Its columns: `assigned[columns.0..columns.1]`.
    columns: (usize, usize),
    /// How many of the fronts just before it in the stack are its own.
    below: usize,
}

/// The factor.
#[derive(Clone, Debug, Default)]
pub(super) struct Frame {
    /// For what it was ordered: the degrees of freedom of each column.
    known: Vec<u32>,
    known_ends: Vec<usize>,
    freedoms: usize,
    graph: Graph,
    fronts: Vec<Front>,
    /// Degrees of freedom by front; for those that are handed up, their place in the front above.
    rows: Vec<u32>,
    upward: Vec<u32>,
    assigned: Vec<u32>,
    /// For each entry of each column its row in the front.
    entry_rows: Vec<u32>,
    /// The lower triangles of the eliminated columns, each as high as its front.
    lower: Vec<f64>,
    /// What fronts hand up, the last one on top.
    stack: Vec<f64>,
    front: Vec<f64>,
    part: Vec<f64>,
}

impl Frame {
    /// Finds the order and the fronts for these columns, if it has not done so last time.
    pub fn order(&mut self, columns: &Columns) {
        let m = columns.len();
        let same = self.known_ends.len() == m
            && self.freedoms == columns.freedoms
            && (0..m).all(|i| {
                let start = if i == 0 { 0 } else { self.known_ends[i - 1] };
                let (old, new) = (&self.known[start..self.known_ends[i]], columns.column(i));
                old.len() == new.len() && old.iter().zip(new).all(|(a, b)| *a == b.0)
            });
        if same {
            return;
        }
        self.known.clear();
        self.known_ends.clear();
        self.freedoms = columns.freedoms;
        for i in 0..m {
            self.known.extend(columns.column(i).iter().map(|e| e.0));
            self.known_ends.push(self.known.len());
        }
        self.find(columns);
    }

    fn find(&mut self, columns: &Columns) {
        let (m, n) = (columns.len(), columns.bodies());
        // Which bodies each column joins, and the degrees of freedom of each body.
        let mut pairs: Vec<(u32, u32)> = Vec::with_capacity(m);
        for i in 0..m {
            let (mut low, mut high) = (NONE, 0);
            for &(k, _) in columns.column(i) {
                let body = columns.body(k);
                low = low.min(body);
                high = high.max(body);
            }
            pairs.push((low, high));
        }
        let mut of_body: Vec<Vec<u32>> = Vec::new();
        of_body.resize_with(n, Vec::new);
        for k in 0..columns.freedoms as u32 {
            of_body[columns.body(k) as usize].push(k);
        }
        self.graph.load_pairs(n, &pairs);
        let mut place: Vec<u32> = vec![0; n];
        let (mut order, mut pattern, mut ends) = (Vec::<u32>::new(), Vec::<u32>::new(), Vec::<usize>::new());
        while order.len() < n {
            let i = self.graph.least();
            place[i as usize] = order.len() as u32;
            order.push(i);
            self.graph.eliminate(i, &mut pattern);
            ends.push(pattern.len());
        }
        // From here on bodies go by their places.
        for p in &mut pattern {
            *p = place[*p as usize];
        }
        let mut start = 0;
        for &end in &ends {
            pattern[start..end].sort_unstable();
            start = end;
        }
        let beyond = |j: usize| {
            let start = if j == 0 { 0 } else { ends[j - 1] };
            &pattern[start..ends[j]]
        };
        // Fronts: each is known by its last body.
        let mut own: Vec<Vec<u32>> = (0..n as u32).map(|j| alloc::vec![j]).collect();
        let mut below: Vec<Vec<u32>> = Vec::new();
        below.resize_with(n, Vec::new);
        let mut roots: Vec<u32> = Vec::new();
        for j in 0..n {
            let mut kept: Vec<u32> = Vec::new();
            for c in core::mem::take(&mut below[j]) {
                let c = c as usize;
                let (whole, had) = (own[j].len() + beyond(j).len(), beyond(c).len());
                let vain = (whole - had) as f64;
                if whole + own[c].len() <= SMALL || vain <= VAIN * had as f64 {
                    let mut merged = core::mem::take(&mut own[c]);
                    merged.append(&mut own[j]);
                    own[j] = merged;
                    kept.append(&mut below[c]);
                } else {
                    kept.push(c as u32);
                }
            }
            below[j] = kept;
            match beyond(j).first() {
                Some(&parent) => below[parent as usize].push(j as u32),
                None => roots.push(j as u32),
            }
        }
        // Children before their parents.
        let mut sequence: Vec<u32> = Vec::new();
        let mut todo = roots;
        while let Some(j) = todo.pop() {
            sequence.push(j);
            todo.extend_from_slice(&below[j as usize]);
        }
        sequence.reverse();
        // Rows, and who hands up to where.
        let mut front_of: Vec<u32> = vec![0; n];
        for (f, &j) in sequence.iter().enumerate() {
            for &b in &own[j as usize] {
                front_of[b as usize] = f as u32;
            }
        }
        self.fronts.clear();
        self.rows.clear();
        let mut size = 0;
        for &j in &sequence {
            let j = j as usize;
            let first = self.rows.len();
            for &b in &own[j] {
                self.rows.extend_from_slice(&of_body[order[b as usize] as usize]);
            }
            let eliminated = self.rows.len() - first;
            for &b in beyond(j) {
                self.rows.extend_from_slice(&of_body[order[b as usize] as usize]);
            }
            let last = self.rows.len();
            self.fronts.push(Front { first, last, own: eliminated, at: size, columns: (0, 0), below: below[j].len() });
            size += eliminated * (last - first);
        }
        self.lower.clear();
        self.lower.resize(size, 0.0);
        // Columns belong to the front that eliminates the first of their bodies.
        let home = |i: usize| {
            let (a, b) = pairs[i];
            let (a, b) = (place[a as usize], place[b as usize]);
            front_of[a as usize].min(front_of[b as usize])
        };
        let mut counts: Vec<usize> = vec![0; self.fronts.len() + 1];
        for i in 0..m {
            counts[home(i) as usize + 1] += 1;
        }
        for f in 0..self.fronts.len() {
            counts[f + 1] += counts[f];
            self.fronts[f].columns = (counts[f], counts[f + 1]);
        }
        self.assigned.clear();
        self.assigned.resize(m, 0);
        for i in 0..m {
            let f = home(i) as usize;
            self.assigned[counts[f]] = i as u32;
            counts[f] += 1;
        }
        let mut row_of: Vec<u32> = vec![0; columns.freedoms];
        self.entry_rows.clear();
        self.entry_rows.resize(self.known.len(), 0);
        self.upward.clear();
        self.upward.resize(self.rows.len(), 0);
        let mut waiting: Vec<usize> = Vec::new();
        for f in 0..self.fronts.len() {
            let front = self.fronts[f];
            for (r, &k) in self.rows[front.first..front.last].iter().enumerate() {
                row_of[k as usize] = r as u32;
            }
            for &i in &self.assigned[front.columns.0..front.columns.1] {
                let i = i as usize;
                let start = if i == 0 { 0 } else { self.known_ends[i - 1] };
                for e in start..self.known_ends[i] {
                    self.entry_rows[e] = row_of[self.known[e] as usize];
                }
            }
            for _ in 0..front.below {
                let child = self.fronts[waiting.pop().expect("a front below")];
                for r in child.first + child.own..child.last {
                    self.upward[r] = row_of[self.rows[r] as usize];
                }
            }
            waiting.push(f);
            if front.last - front.first == front.own {
                waiting.pop(); // a root hands nothing up
            }
        }
    }

    /// Factors for the columns that are `active`; `shift` > 0.
    pub fn factor(&mut self, columns: &Columns, weight: impl Fn(usize) -> f64, shift: f64) {
        self.stack.clear();
        let mut waiting: Vec<(usize, usize)> = Vec::new();
        for f in 0..self.fronts.len() {
            let s = self.fronts[f];
            let (high, own) = (s.last - s.first, s.own);
            self.front.clear();
            self.front.resize(high * high, 0.0);
            for k in 0..own {
                self.front[k * high + k] = shift;
            }
            for &i in &self.assigned[s.columns.0..s.columns.1] {
                let i = i as usize;
                let weight = weight(i);
                if !(weight > 0.0) {
                    continue;
                }
                let start = if i == 0 { 0 } else { self.known_ends[i - 1] };
                let column = columns.column(i);
                for (a, &(_, left)) in column.iter().enumerate() {
                    let p = self.entry_rows[start + a] as usize;
                    let left = left * weight;
                    for (b, &(_, right)) in column.iter().enumerate() {
                        let q = self.entry_rows[start + b] as usize;
                        if p >= q {
                            self.front[q * high + p] += left * right;
                        }
                    }
                }
            }
            for _ in 0..s.below {
                let (child, from) = waiting.pop().expect("a front below");
                let c = self.fronts[child];
                let up = &self.upward[c.first + c.own..c.last];
                let wide = up.len();
                for (q, &to) in up.iter().enumerate() {
                    let to = to as usize;
                    let values = &self.stack[from + q * wide..from + (q + 1) * wide];
                    for p in q..wide {
                        let r = up[p] as usize;
                        let at = if r >= to { to * high + r } else { r * high + to };
                        self.front[at] += values[p];
                    }
                }
                self.stack.truncate(from);
            }
            eliminate(&mut self.front, high, own, shift);
            self.lower[s.at..s.at + own * high].copy_from_slice(&self.front[..own * high]);
            if own < high {
                waiting.push((f, self.stack.len()));
                for q in own..high {
                    self.stack.extend_from_slice(&self.front[q * high + own..(q + 1) * high]);
                }
            }
        }
    }

    /// Replaces `x` by K^-1 x.
    pub fn solve(&mut self, x: &mut [f64]) {
        for s in &self.fronts {
            let rows = &self.rows[s.first..s.last];
            let high = rows.len();
            self.part.clear();
            self.part.extend(rows.iter().map(|&k| x[k as usize]));
            for k in 0..s.own {
                let column = &self.lower[s.at + k * high..s.at + (k + 1) * high];
                let y = self.part[k] / column[k];
                self.part[k] = y;
                for (to, value) in self.part[k + 1..].iter_mut().zip(&column[k + 1..]) {
                    *to -= value * y;
                }
            }
            for (&k, value) in rows.iter().zip(&self.part) {
                x[k as usize] = *value;
            }
        }
        for s in self.fronts.iter().rev() {
            let rows = &self.rows[s.first..s.last];
            let high = rows.len();
            self.part.clear();
            self.part.extend(rows.iter().map(|&k| x[k as usize]));
            for k in (0..s.own).rev() {
                let column = &self.lower[s.at + k * high..s.at + (k + 1) * high];
                let mut y = self.part[k];
                for (value, l) in self.part[k + 1..].iter().zip(&column[k + 1..]) {
                    y -= value * l;
                }
                self.part[k] = y / column[k];
                x[rows[k] as usize] = self.part[k];
            }
        }
    }
}

/// Eliminates the first `own` columns of a matrix of `high` rows that is kept by columns, below the diagonal.
fn eliminate(front: &mut [f64], high: usize, own: usize, shift: f64) {
    let mut start = 0;
    while start < own {
        let wide = BLOCK.min(own - start);
        let (panel, rest) = front[start * high..].split_at_mut(wide * high);
        for k in 0..wide {
            let (before, column) = panel.split_at_mut(k * high);
            let column = &mut column[..high];
            let d = start + k;
            for done in before.chunks_exact(high) {
                let factor = done[d];
                for (to, value) in column[d..].iter_mut().zip(&done[d..]) {
                    *to -= factor * value;
                }
            }
            // In exact arithmetic pivot >= shift.
            let root = column[d].max(0.5 * shift).sqrt_();
            column[d] = root;
            let inverse = 1.0 / root;
            for value in &mut column[d + 1..] {
                *value *= inverse;
            }
        }
        for (k, column) in rest.chunks_exact_mut(high).enumerate() {
            let d = start + wide + k;
            let column = &mut column[d..];
            let length = column.len();
            if wide == BLOCK {
                let (a, b, c, e) = (
                    &panel[d..high],
                    &panel[high + d..2 * high],
                    &panel[2 * high + d..3 * high],
                    &panel[3 * high + d..4 * high],
                );
                let (a, b, c, e) = (&a[..length], &b[..length], &c[..length], &e[..length]);
                let (fa, fb, fc, fe) = (a[0], b[0], c[0], e[0]);
                for r in 0..length {
                    column[r] -= (fa * a[r] + fb * b[r]) + (fc * c[r] + fe * e[r]);
                }
            } else {
                for done in panel.chunks_exact(high) {
                    let factor = done[d];
                    for (to, value) in column.iter_mut().zip(&done[d..]) {
                        *to -= factor * value;
                    }
                }
            }
        }
        start += wide;
    }
}

#[cfg(test)]
mod tests {
    use std::vec;

    use super::*;
    use crate::{Vector, law::together::System};

    /// A square lattice of balls with diagonals, and a floor.
    fn lattice(side: usize) -> Columns {
        let mut system = System::new();
        for k in 0..side * side {
            system.ball(1.0 / (1 + k % 3) as f64, Vector([0.0; 3]));
        }
        for r in 0..side {
            for c in 0..side {
                let k = r * side + c;
                for (right, up, n) in [(1, 0, [0.96, 0.0, 0.28]), (0, 1, [-0.6, 0.8, 0.0]), (1, 1, [0.6, 0.0, 0.8])] {
                    if c + right < side && r + up < side {
                        system.pair(3 * k, 3 * (k + up * side + right), Vector(n));
                    }
                }
                if r == 0 {
                    system.wall(3 * k, Vector([0.0, -1.0, 0.0]), Vector::ZERO);
                }
            }
        }
        let mut columns = Columns::default();
        columns.load(&system, &(0..system.contacts() as u32).collect::<Vec<_>>());
        columns
    }

    #[test]
    fn solves_what_it_factored() {
        let mut frame = Frame::default();
        for side in [3, 9, 4] {
            let columns = lattice(side);
            for every in [1, 2, 5] {
                let weight = |i: usize| if every == 1 || !i.is_multiple_of(every) { 0.5 + (i % 4) as f64 } else { 0.0 };
                let shift = 0.1;
                let right: Vec<f64> = (0..columns.freedoms).map(|k| ((k * k) % 17) as f64).collect();
                let mut x = right.clone();
                frame.order(&columns);
                frame.factor(&columns, weight, shift);
                frame.solve(&mut x);
                let mut back: Vec<f64> = x.iter().map(|x| shift * x).collect();
                for i in 0..columns.len() {
                    columns.add(i, weight(i) * columns.dot(i, &x), &mut back);
                }
                // x up to 160, the matrix up to 3.5 times eight contacts: 1e-10 is a hundred eps of their product.
                assert!(back.iter().zip(&right).all(|(a, b)| (a - b).abs() < 1e-10));
            }
        }
        // A column less, and the order is found anew.
        let mut system = System::new();
        let (a, b) = (system.ball(1.0, Vector([0.0])), system.ball(1.0, Vector([0.0])));
        system.pair(a, b, Vector([1.0]));
        let mut columns = Columns::default();
        columns.load(&system, &[0]);
        let mut x = vec![1.0, 0.0];
        frame.order(&columns);
        frame.factor(&columns, |_| 2.0, 1.0);
        frame.solve(&mut x);
        // 1 + (1, -1)(1, -1)^T, each of length 1 / sqrt 2.
        assert!((x[0] - 2.0 / 3.0).abs() < 1e-15 && (x[1] - 1.0 / 3.0).abs() < 1e-15, "{x:?}");
    }
}
