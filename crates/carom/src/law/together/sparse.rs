//! A Cholesky factor for many contacts: heaps, in which every contact knows only its neighbours.
//!
//! Contacts are neighbours where they share a body. To eliminate a contact is to merge its bodies into one, with the
//! contacts of both; the order takes the contact of (nearly) fewest neighbours first (minimum degree on the quotient graph;
//! Amestoy, Davis & Duff 1996), ties by number. It is found once for all contacts; the numbers are then computed column by
//! column, looking left, for those that are active.
use alloc::vec::Vec;

use super::columns::Columns;
use crate::vector::Exact;

/// The end of a list.
const NONE: u32 = u32::MAX;

/// L L^T = C_A^T C_A + diag(shift) for the active columns A, in an order that keeps L sparse.
#[derive(Clone, Debug, Default)]
pub(super) struct Sparse {
    /// The contact at each place of the order, and the place of each contact.
    order: Vec<u32>,
    place: Vec<u32>,
    /// For each degree of freedom the columns that have it: `users[user_ends[k - 1]..user_ends[k]]`.
    user_ends: Vec<usize>,
    users: Vec<(u32, f64)>,
    /// What L could have below the diagonal, were all contacts active: by column the places, rising.
    pattern_ends: Vec<usize>,
    pattern: Vec<u32>,
    /// L itself: by column the places and values below the diagonal, and the diagonal. Inactive columns are empty.
    ends: Vec<usize>,
    rows: Vec<u32>,
    values: Vec<f64>,
    diagonal: Vec<f64>,
    active: Vec<bool>,
    /// Columns whose next row is this one (a list through `next`), and where in the column that row stands.
    first: Vec<u32>,
    next: Vec<u32>,
    reached: Vec<usize>,
    work: Vec<f64>,
    graph: Graph,
}

/// The quotient graph: groups (degrees of freedom, later merged ones) of contacts.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    members: Vec<Vec<u32>>,
    groups: Vec<Vec<u32>>,
    degree: Vec<u32>,
    /// Contacts by degree: lists through `before` and `after`.
    head: Vec<u32>,
    before: Vec<u32>,
    after: Vec<u32>,
    mark: Vec<u32>,
}

impl Graph {
    fn load(&mut self, columns: &Columns) {
        let m = columns.len();
        for list in self.members.iter_mut().chain(self.groups.iter_mut()) {
            list.clear();
        }
        self.members.resize_with(columns.freedoms.max(self.members.len()), Vec::new);
        self.groups.resize_with(m.max(self.groups.len()), Vec::new);
        for i in 0..m {
            for &(k, _) in columns.column(i) {
                self.members[k as usize].push(i as u32);
            }
        }
        for k in 0..columns.freedoms {
            // The components of one body have the same contacts: one group is enough.
            if k > 0 && self.members[k] == self.members[k - 1] {
                continue;
            }
            for at in 0..self.members[k].len() {
                let i = self.members[k][at] as usize;
                self.groups[i].push(k as u32);
            }
        }
        self.start(m);
    }

    /// `n` bodies, and who is near whom; a pair may be one body twice.
    pub fn load_pairs(&mut self, n: usize, pairs: &[(u32, u32)]) {
        for list in self.members.iter_mut().chain(self.groups.iter_mut()) {
            list.clear();
        }
        self.members.resize_with(pairs.len().max(self.members.len()), Vec::new);
        self.groups.resize_with(n.max(self.groups.len()), Vec::new);
        for (k, &(a, b)) in pairs.iter().enumerate() {
            if a != b {
                self.members[k].extend([a, b]);
                self.groups[a as usize].push(k as u32);
                self.groups[b as usize].push(k as u32);
            }
        }
        self.start(n);
    }

    fn start(&mut self, m: usize) {
        self.degree.clear();
        self.degree.resize(m, 0);
        self.mark.clear();
        self.mark.resize(m, 0);
        for list in [&mut self.head, &mut self.before, &mut self.after] {
            list.clear();
            list.resize(m, NONE);
        }
        for i in (0..m as u32).rev() {
            self.degree[i as usize] = self.bound(i);
            self.insert(i);
        }
    }

    /// An upper bound of the number of neighbours of contact `i`.
    fn bound(&self, i: u32) -> u32 {
        let sum: usize = self.groups[i as usize].iter().map(|&g| self.members[g as usize].len() - 1).sum();
        sum.min(self.degree.len() - 1) as u32
    }

    /// A contact of least degree.
    pub fn least(&self) -> u32 {
        *self.head.iter().find(|&&i| i != NONE).expect("a contact that is left")
    }

    fn insert(&mut self, i: u32) {
        let list = &mut self.head[self.degree[i as usize] as usize];
        (self.before[i as usize], self.after[i as usize]) = (NONE, *list);
        if *list != NONE {
            self.before[*list as usize] = i;
        }
        *list = i;
    }

    fn remove(&mut self, i: u32) {
        let (before, after) = (self.before[i as usize], self.after[i as usize]);
        if before == NONE {
            self.head[self.degree[i as usize] as usize] = after;
        } else {
            self.after[before as usize] = after;
        }
        if after != NONE {
            self.before[after as usize] = before;
        }
    }

    /// Eliminates contact `i`; its neighbours come out in `neighbours`.
    pub fn eliminate(&mut self, i: u32, neighbours: &mut Vec<u32>) {
        self.remove(i);
        self.mark[i as usize] = i + 1;
        let start = neighbours.len();
        let merged = core::mem::take(&mut self.groups[i as usize]);
        for &g in &merged {
            for &j in &self.members[g as usize] {
                if self.mark[j as usize] != i + 1 {
                    self.mark[j as usize] = i + 1;
                    neighbours.push(j);
                }
            }
            self.members[g as usize].clear();
        }
        let Some(&group) = merged.first() else { return };
        self.members[group as usize].extend_from_slice(&neighbours[start..]);
        for &j in &neighbours[start..] {
            self.groups[j as usize].retain(|g| !merged.contains(g));
            self.groups[j as usize].push(group);
        }
        for &j in &neighbours[start..] {
            self.remove(j);
            self.degree[j as usize] = self.bound(j);
            self.insert(j);
        }
    }
}

impl Sparse {
    /// Finds the order and the pattern for these columns.
    pub fn order(&mut self, columns: &Columns) {
        let m = columns.len();
        self.graph.load(columns);
        self.order.clear();
        self.place.clear();
        self.place.resize(m, 0);
        self.pattern.clear();
        self.pattern_ends.clear();
        while self.order.len() < m {
            let i = self.graph.least();
            self.place[i as usize] = self.order.len() as u32;
            self.order.push(i);
            self.graph.eliminate(i, &mut self.pattern);
            self.pattern_ends.push(self.pattern.len());
        }
        self.sort_pattern(m);
    }

    /// Turns the pattern's contacts into places and sorts each column, by transposing twice.
    fn sort_pattern(&mut self, m: usize) {
        let mut ends = core::mem::take(&mut self.ends);
        ends.clear();
        ends.resize(m + 1, 0);
        for i in &mut self.pattern {
            *i = self.place[*i as usize];
            ends[*i as usize + 1] += 1;
        }
        for r in 0..m {
            ends[r + 1] += ends[r];
        }
        self.rows.clear();
        self.rows.resize(self.pattern.len(), 0);
        for j in 0..m {
            let start = if j == 0 { 0 } else { self.pattern_ends[j - 1] };
            for p in start..self.pattern_ends[j] {
                let r = self.pattern[p] as usize;
                self.rows[ends[r]] = j as u32;
                ends[r] += 1;
            }
        }
        self.reached.clear();
        self.reached.push(0);
        self.reached.extend_from_slice(&self.pattern_ends);
        let mut at = 0;
        for r in 0..m {
            while at < ends[r] {
                let j = self.rows[at] as usize;
                self.pattern[self.reached[j]] = r as u32;
                self.reached[j] += 1;
                at += 1;
            }
        }
        self.ends = ends;
    }

    /// Lists the columns by degree of freedom.
    fn index(&mut self, columns: &Columns) {
        let m = columns.len();
        self.user_ends.clear();
        self.user_ends.resize(columns.freedoms + 1, 0);
        for i in 0..m {
            for &(k, _) in columns.column(i) {
                self.user_ends[k as usize + 1] += 1;
            }
        }
        for k in 0..columns.freedoms {
            self.user_ends[k + 1] += self.user_ends[k];
        }
        self.users.clear();
        self.users.resize(self.user_ends[columns.freedoms], (0, 0.0));
        for i in 0..m {
            for &(k, value) in columns.column(i) {
                // The end of the one before moves up to its own end while the list fills.
                self.users[self.user_ends[k as usize]] = (i as u32, value);
                self.user_ends[k as usize] += 1;
            }
        }
    }

    /// Factors for the columns that are `active`; every `shift` > 0.
    pub fn factor(&mut self, columns: &Columns, active: &[bool], shift: &[f64]) {
        let m = columns.len();
        self.index(columns);
        self.active.clear();
        self.active.extend(self.order.iter().map(|&i| active[i as usize]));
        self.ends.clear();
        self.rows.clear();
        self.diagonal.clear();
        self.diagonal.resize(m, 1.0);
        self.work.clear();
        self.work.resize(m, 0.0);
        self.values.clear();
        for list in [&mut self.first, &mut self.next] {
            list.clear();
            list.resize(m, NONE);
        }
        self.reached.clear();
        self.reached.resize(m, 0);
        for j in 0..m {
            let start = self.rows.len();
            if !self.active[j] {
                self.ends.push(start);
                continue;
            }
            let from = if j == 0 { 0 } else { self.pattern_ends[j - 1] };
            let below = &self.pattern[from..self.pattern_ends[j]];
            let active = &self.active;
            self.rows.extend(below.iter().copied().filter(|&r| active[r as usize]));
            for &(k, value) in columns.column(self.order[j] as usize) {
                let from = if k == 0 { 0 } else { self.user_ends[k as usize - 1] };
                for &(i, other) in &self.users[from..self.user_ends[k as usize]] {
                    self.work[self.place[i as usize] as usize] += other * value;
                }
            }
            let mut k = self.first[j];
            while k != NONE {
                let (at, end) = (self.reached[k as usize], self.ends[k as usize]);
                let here = self.values[at];
                for (r, value) in self.rows[at..end].iter().zip(&self.values[at..end]) {
                    self.work[*r as usize] -= here * value;
                }
                let follower = self.next[k as usize];
                self.queue(k, at + 1, end);
                k = follower;
            }
            let shift = shift[self.order[j] as usize];
            // In exact arithmetic pivot >= shift; rounding takes it below only where that is near eps.
            let root = (self.work[j] + shift).max(0.5 * shift).sqrt_();
            self.diagonal[j] = root;
            for p in start..self.rows.len() {
                self.values.push(self.work[self.rows[p] as usize] / root);
            }
            // Everything that was written to lies in the pattern, active or not.
            self.work[j] = 0.0;
            for &r in &self.pattern[from..self.pattern_ends[j]] {
                self.work[r as usize] = 0.0;
            }
            for &(k, _) in columns.column(self.order[j] as usize) {
                let from = if k == 0 { 0 } else { self.user_ends[k as usize - 1] };
                for &(i, _) in &self.users[from..self.user_ends[k as usize]] {
                    self.work[self.place[i as usize] as usize] = 0.0;
                }
            }
            self.ends.push(self.rows.len());
            self.queue(j as u32, start, self.rows.len());
        }
    }

    /// Hangs column `k`, whose next row stands at `at`, into that row's list.
    fn queue(&mut self, k: u32, at: usize, end: usize) {
        if at < end {
            self.reached[k as usize] = at;
            let list = &mut self.first[self.rows[at] as usize];
            self.next[k as usize] = *list;
            *list = k;
        }
    }

    /// Replaces the active components of `t` by the solution for them as right-hand side.
    pub fn solve(&mut self, t: &mut [f64]) {
        let m = self.order.len();
        for j in 0..m {
            if self.active[j] {
                let start = if j == 0 { 0 } else { self.ends[j - 1] };
                let y = t[self.order[j] as usize] / self.diagonal[j];
                self.work[j] = y;
                t[self.order[j] as usize] = y;
                for p in start..self.ends[j] {
                    t[self.order[self.rows[p] as usize] as usize] -= self.values[p] * y;
                }
            }
        }
        for j in (0..m).rev() {
            if self.active[j] {
                let start = if j == 0 { 0 } else { self.ends[j - 1] };
                let mut y = t[self.order[j] as usize];
                for p in start..self.ends[j] {
                    y -= self.values[p] * t[self.order[self.rows[p] as usize] as usize];
                }
                t[self.order[j] as usize] = y / self.diagonal[j];
            }
        }
        self.work.fill(0.0);
    }
}

#[cfg(test)]
mod tests {
    use std::{println, vec};

    use super::*;
    use crate::{
        Vector,
        law::together::{System, dense::Dense},
    };

    /// A square lattice of discs: contacts to the right and up.
    fn lattice(side: usize) -> Columns {
        let mut system = System::new();
        for k in 0..side * side {
            system.ball(1.0 / (1 + k % 3) as f64, Vector([0.0, 0.0]));
        }
        for r in 0..side {
            for c in 0..side {
                let k = r * side + c;
                if c + 1 < side {
                    system.pair(2 * k, 2 * (k + 1), Vector([0.96, 0.28]));
                }
                if r + 1 < side {
                    system.pair(2 * k, 2 * (k + side), Vector([-0.6, 0.8]));
                }
            }
        }
        let mut columns = Columns::default();
        columns.load(&system, &(0..system.contacts() as u32).collect::<Vec<_>>());
        columns
    }

    #[test]
    fn agrees_with_the_dense_factor() {
        let columns = lattice(7);
        let m = columns.len();
        let (mut sparse, mut dense) = (Sparse::default(), Dense::default());
        sparse.order(&columns);
        for every in [1, 2, 3, 5] {
            let active: Vec<bool> = (0..m).map(|i| every == 1 || i % every != 0).collect();
            let shift: Vec<f64> = (0..m).map(|i| 0.1 + i as f64 / m as f64).collect();
            let right: Vec<f64> = (0..m).map(|i| ((i * i) % 17) as f64).collect();
            let (mut a, mut b) = (right.clone(), right);
            sparse.factor(&columns, &active, &shift);
            sparse.solve(&mut a);
            dense.factor(&columns, &active, &shift);
            dense.solve(&mut b);
            // Condition at most (6 + 1)/0.1, entries up to 160: 1e-13 is a hundred eps of that.
            assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-12), "{a:?} {b:?}");
        }
    }

    #[test]
    fn the_order_keeps_the_factor_sparse() {
        println!("  discs | contacts | below the diagonal | by row");
        for side in [8, 16, 32] {
            let columns = lattice(side);
            let m = columns.len();
            let mut sparse = Sparse::default();
            sparse.order(&columns);
            sparse.factor(&columns, &vec![true; m], &vec![1.0; m]);
            println!(
                "  {:5} | {m:8} | {:18} | {:.1}",
                side * side,
                sparse.rows.len(),
                sparse.rows.len() as f64 / m as f64
            );
            // In the order of the lattice all of the band would fill, 2 side numbers a row.
            assert!(side < 32 || sparse.rows.len() < 2 * side * m * 2 / 3);
        }
    }
}
