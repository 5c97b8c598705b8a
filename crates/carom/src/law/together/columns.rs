//! Contacts as unit columns, in which mass has no say any more.
use alloc::vec::Vec;

use super::System;
use crate::vector::Exact;

/// The columns c_i = M^-1/2 N_i / sqrt(Q_ii) of some contacts, over the degrees of freedom that can move: all of length one,
/// whatever the masses and the units, so that pivots and tolerances mean the same for all of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Columns {
    ends: Vec<usize>,
    entries: Vec<(u32, f64)>,
    /// sqrt(Q_ii): a velocity u_i is u_i / sqrt(Q_ii) here, an impulse lambda_i is lambda_i sqrt(Q_ii).
    pub root: Vec<f64>,
    /// How many degrees of freedom the columns have between them.
    pub freedoms: usize,
    /// For each degree of freedom of the system: (the load that last saw it, its number here).
    seen: Vec<(u64, u32)>,
    /// For each degree of freedom the number of its body, and how many bodies there are.
    body: Vec<u32>,
    bodies: usize,
    seen_body: Vec<(u64, u32)>,
    loads: u64,
}

impl Columns {
    /// Takes the contacts `rows`, all of which must yield.
    pub fn load(&mut self, system: &System, rows: &[u32]) {
        self.ends.clear();
        self.entries.clear();
        self.root.clear();
        self.freedoms = 0;
        self.body.clear();
        self.bodies = 0;
        self.loads += 1;
        if self.seen.len() < system.velocities().len() {
            self.seen.resize(system.velocities().len(), (0, 0));
            self.seen_body.resize(system.velocities().len(), (0, 0));
        }
        for &i in rows {
            let root = system.yielding(i as usize).sqrt_();
            for &(k, value) in system.column(i as usize) {
                let w = system.movable(k);
                if w > 0.0 && value != 0.0 {
                    let seen = &mut self.seen[k as usize];
                    if seen.0 != self.loads {
                        *seen = (self.loads, self.freedoms as u32);
                        self.freedoms += 1;
                        let body = &mut self.seen_body[system.owner(k) as usize];
                        if body.0 != self.loads {
                            *body = (self.loads, self.bodies as u32);
                            self.bodies += 1;
                        }
                        self.body.push(body.1);
                    }
                    self.entries.push((seen.1, w.sqrt_() * value / root));
                }
            }
            self.ends.push(self.entries.len());
            self.root.push(root);
        }
    }

    /// How many columns there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// The number of the body of degree of freedom `k`.
    pub fn body(&self, k: u32) -> u32 {
        self.body[k as usize]
    }

    /// How many bodies the columns have between them.
    pub fn bodies(&self) -> usize {
        self.bodies
    }

    /// c_i as (degree of freedom, value).
    #[inline]
    pub fn column(&self, i: usize) -> &[(u32, f64)] {
        let start = if i == 0 { 0 } else { self.ends[i - 1] };
        &self.entries[start..self.ends[i]]
    }

    /// c_i . x
    #[inline]
    pub fn dot(&self, i: usize, x: &[f64]) -> f64 {
        let mut sum = 0.0;
        for &(k, value) in self.column(i) {
            sum += value * x[k as usize];
        }
        sum
    }

    /// x += c_i t
    #[inline]
    pub fn add(&self, i: usize, t: f64, x: &mut [f64]) {
        for &(k, value) in self.column(i) {
            x[k as usize] += value * t;
        }
    }

    /// x = C t over the columns for which t is not 0.
    pub fn combine(&self, t: &[f64], x: &mut Vec<f64>) {
        x.clear();
        x.resize(self.freedoms, 0.0);
        for i in 0..self.len() {
            if t[i] != 0.0 {
                self.add(i, t[i], x);
            }
        }
    }
}
