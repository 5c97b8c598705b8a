//! The projection of a large island for a slice, without a factor: as many digits as a slice needs, in sweeps.
//!
//! ```text
//! min |C l|^2 / 2 - beta.l,  l >= 0       in unit columns (`columns.rs`)
//! ```
//!
//! by Nesterov's accelerated projected gradient with adaptive restart and a step that adapts to the curvature it meets (Nesterov
//! 1983; O'Donoghue & Candes 2015; for contacts Mazhar, Heyn, Negrut & Tasora 2015). A sweep is one pass over the contacts. The
//! number of sweeps grows with the depth of the heap, not with its size, whatever the contacts depend on each other (crystals, of
//! which heaps of equal balls are full), and no contact comes before another: what is not solved to the end does not depend on the
//! order of the file either, but for rounding. Sums run in the order of the contacts, so that runs repeat to the bit.
//!
//! Whatever it ends with, impulses are >= 0 and momentum is kept. Slices watch over energy and gaps themselves (`world/slices.rs`).
use alloc::vec::Vec;

use super::System;
use crate::vector::Exact;

/// Sweeps between two looks at the error.
const LOOK: u32 = 12;
/// The first guess at the largest eigenvalue of C^T C (1 for a contact alone, near 4 in a dense heap), and how it is let down.
const CURVATURE: f64 = 2.0;
const EASE: f64 = 0.995;
/// A contact that opens while it pushes is an error of energy, which is watched over, not of the gap: this part of it counts.
const OPENING: f64 = 0.1;
/// How often a step is shortened at most.
const SHORTER: u32 = 30;
/// The most degrees of freedom of a body that are swept: a ball in space with its spin has six.
const WIDEST: usize = 6;

/// The method with its memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Relax {
    /// The impulses l: those to start from, then the best that was seen.
    pub l: Vec<f64>,
    /// C times l, C times the point that runs ahead of it, and C times the next l.
    x: Vec<f64>,
    x_ahead: Vec<f64>,
    x_next: Vec<f64>,
    /// The largest error of `l`, in units of the goal.
    pub error: f64,
    pub sweeps: u32,
}

impl Relax {
    /// Runs from the impulses in `l` (in the units of `columns.rs`) until no contact misses `beta` by more than its `goal`, `most` sweeps
    /// at most.
    pub fn run(&mut self, system: &System, rows: &[u32], root: &[f64], beta: &[f64], goal: &[f64], most: u32) {
        match Rows::<1>::width(system, rows) {
            0 | 1 => self.sweep(&mut Rows::<1>::new(system, rows, root, beta, goal, &self.l), most),
            2 => self.sweep(&mut Rows::<2>::new(system, rows, root, beta, goal, &self.l), most),
            3 => self.sweep(&mut Rows::<3>::new(system, rows, root, beta, goal, &self.l), most),
            4..=WIDEST => self.sweep(&mut Rows::<WIDEST>::new(system, rows, root, beta, goal, &self.l), most),
            _ => {
                self.l.fill(0.0);
                (self.error, self.sweeps) = (f64::INFINITY, 0);
            }
        }
    }

    fn sweep<const S: usize>(&mut self, rows: &mut Rows<S>, most: u32) {
        self.x.clear();
        self.x.resize(rows.freedoms, 0.0);
        for r in &rows.list {
            r.add(r.l, &mut self.x);
        }
        self.x_ahead.clone_from(&self.x);
        self.x_next.clone_from(&self.x);
        let mut least = rows.missing(&self.x);
        self.sweeps = 0;
        let (mut theta, mut curvature) = (1.0f64, CURVATURE);
        while least > 1.0 && self.sweeps < most {
            self.sweeps += 1;
            let (mut square, mut down) = self.step(rows, 1.0 / curvature, true);
            for _ in 0..SHORTER {
                let by = self.x_next.iter().zip(&self.x_ahead).map(|(to, from)| (to - from) * (to - from));
                let bent: f64 = by.sum();
                if !(bent > curvature * square * (1.0 + 1e-9)) {
                    break;
                }
                // There is more curvature along the step: a shorter one.
                curvature = (1.02 * bent / square).max(1.1 * curvature);
                (square, down) = self.step(rows, 1.0 / curvature, false);
            }
            let after = 0.5 * (theta * (theta * theta + 4.0).sqrt_() - theta * theta);
            let mut momentum = theta * (1.0 - theta) / (theta * theta + after);
            theta = after;
            if down > 0.0 {
                // The way ahead leads up again.
                (theta, momentum) = (1.0, 0.0);
            }
            for r in &mut rows.list {
                r.ahead = r.next + momentum * (r.next - r.l);
                r.l = r.next;
            }
            for ((ahead, to), from) in self.x_ahead.iter_mut().zip(&self.x_next).zip(&self.x) {
                *ahead = to + momentum * (to - from);
            }
            core::mem::swap(&mut self.x, &mut self.x_next);
            curvature *= EASE;
            if self.sweeps.is_multiple_of(LOOK) || self.sweeps == most {
                let error = rows.missing(&self.x);
                if error < least {
                    least = error;
                    for (best, r) in self.l.iter_mut().zip(&rows.list) {
                        *best = r.l;
                    }
                }
            }
        }
        self.error = least;
    }

    /// A step down from `ahead`: the square of its length, and how much it leads down.
    fn step<const S: usize>(&mut self, rows: &mut Rows<S>, step: f64, fresh: bool) -> (f64, f64) {
        let (mut square, mut down) = (0.0, 0.0);
        self.x_next.fill(0.0);
        for r in &mut rows.list {
            if fresh {
                r.slope = r.dot(&self.x_ahead) - r.beta;
            }
            let to = r.ahead - step * r.slope;
            let to = if to > 0.0 { to } else { 0.0 };
            square += (to - r.ahead) * (to - r.ahead);
            down += r.slope * (to - r.l);
            r.next = to;
            r.add(to, &mut self.x_next);
        }
        (square, down)
    }
}

/// A contact: its column, as one run of degrees of freedom for each of its two bodies, and where the method stands with it.
#[derive(Clone, Copy)]
struct Row<const S: usize> {
    a: u32,
    b: u32,
    na: [f64; S],
    nb: [f64; S],
    beta: f64,
    goal: f64,
    l: f64,
    ahead: f64,
    next: f64,
    slope: f64,
}

impl<const S: usize> Row<S> {
    #[inline(always)]
    fn dot(&self, x: &[f64]) -> f64 {
        let (a, b) = (&x[self.a as usize..][..S], &x[self.b as usize..][..S]);
        let mut sum = 0.0;
        for k in 0..S {
            sum += self.na[k] * a[k] + self.nb[k] * b[k];
        }
        sum
    }

    #[inline(always)]
    fn add(&self, t: f64, x: &mut [f64]) {
        let a = &mut x[self.a as usize..][..S];
        for k in 0..S {
            a[k] += self.na[k] * t;
        }
        let b = &mut x[self.b as usize..][..S];
        for k in 0..S {
            b[k] += self.nb[k] * t;
        }
    }
}

/// The contacts, laid out so that a sweep runs straight through.
struct Rows<const S: usize> {
    list: Vec<Row<S>>,
    freedoms: usize,
}

impl<const S: usize> Rows<S> {
    /// How many degrees of freedom the widest part of a column spans, where each has at most two bodies; more than any width if one
    /// has more.
    fn width(system: &System, rows: &[u32]) -> usize {
        let mut widest = 0;
        for &i in rows {
            let column = system.column(i as usize);
            let Some(first) = column.first().map(|e| system.owner(e.0)) else { continue };
            let mut other = None;
            for &(k, _) in column {
                let owner = system.owner(k);
                if owner != first && *other.get_or_insert(owner) != owner {
                    return usize::MAX;
                }
                widest = widest.max((k - owner) as usize + 1);
            }
        }
        widest
    }

    fn new(system: &System, rows: &[u32], root: &[f64], beta: &[f64], goal: &[f64], start: &[f64]) -> Self {
        let nobody = system.velocities().len() as u32;
        let mut list = Vec::with_capacity(rows.len());
        for (r, &i) in rows.iter().enumerate() {
            let column = system.column(i as usize);
            let a = column.first().map_or(nobody, |e| system.owner(e.0));
            let b = column.iter().map(|e| system.owner(e.0)).find(|&k| k != a).unwrap_or(nobody);
            let (mut na, mut nb) = ([0.0; S], [0.0; S]);
            for &(k, value) in column {
                let value = system.movable(k).sqrt_() * value / root[r];
                let owner = system.owner(k);
                (if owner == a { &mut na } else { &mut nb })[(k - owner) as usize] = value;
            }
            let l = start[r];
            list.push(Row { a, b, na, nb, beta: beta[r], goal: goal[r], l, ahead: l, next: l, slope: 0.0 });
        }
        // Room for nobody, and for what a narrow body's run reaches into.
        Self { list, freedoms: nobody as usize + S }
    }

    /// The largest error, in units of the goal: how far a contact falls short, or, while it pushes, [`OPENING`] of how far it opens,
    /// if that is not more than it pushes.
    fn missing(&self, x: &[f64]) -> f64 {
        let mut largest = 0.0;
        for r in &self.list {
            let short = r.beta - r.dot(x);
            let opens = OPENING * if -short < r.l { -short } else { r.l };
            let error = if short < 0.0 { opens } else { short } / r.goal;
            if !(error <= largest) {
                largest = error;
            }
        }
        largest
    }
}
