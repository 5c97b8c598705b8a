//! Which contacts push? An interior point method, where the active set would have to be found contact by contact.
//!
//! ```text
//! C^T C l - s = beta,   l, s > 0,   all l_i s_i -> 0 together          (Mehrotra 1992: predictor and corrector)
//! ```
//!
//! It takes 15 to 40 factors whatever the contacts. The linear systems are those of the degrees of freedom, 1 + C W C^T with
//! a weight for each contact (`frame.rs`); they lose digits as the weights spread, so what is found here tells who pushes, and
//! the proximal steps make it exact. A slice is content with it as it is.
use alloc::vec::Vec;

use super::{columns::Columns, frame::Frame};
use crate::vector::Exact;

/// At most so many steps, each this part of the way to the boundary.
const STEPS: u32 = 60;
const INWARD: f64 = 0.995;
/// They end when the mean of l_i s_i and what the equations miss are this small, relative to the largest beta.
const CENTRED: f64 = 1e-18;
const MISSING: f64 = 1e-11;
/// An impulse that is this part of how fast the contact opens is left out.
const FAINT: f64 = 1e-3;
/// Keeps the weights finite where contacts depend on each other; it slows the steps, it does not move their end.
const SHIFT: f64 = 1e-11;

/// The method with its memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Interior {
    l: Vec<f64>,
    s: Vec<f64>,
    /// What the linear equations miss.
    short: Vec<f64>,
    /// The step; of `d_s` first the products that the step has to remove.
    d_l: Vec<f64>,
    d_s: Vec<f64>,
    weight: Vec<f64>,
    right: Vec<f64>,
    x: Vec<f64>,
}

impl Interior {
    /// Runs the method; `largest` > 0 is the largest of `beta`. `warm` may give impulses to start near, the part of `largest` whose
    /// square l_i s_i shall be there, and the mean of l_i s_i at which it ends, relative to the square of `largest`. Returns the
    /// number of factors.
    pub fn solve(
        &mut self,
        columns: &Columns,
        beta: &[f64],
        largest: f64,
        frame: &mut Frame,
        warm: Option<(&[f64], f64, f64)>,
    ) -> u32 {
        let m = columns.len();
        for (list, value) in [
            (&mut self.l, largest),
            (&mut self.s, largest),
            (&mut self.short, 0.0),
            (&mut self.d_l, 0.0),
            (&mut self.d_s, 0.0),
            (&mut self.weight, 0.0),
            (&mut self.right, 0.0),
        ] {
            list.clear();
            list.resize(m, value);
        }
        let (mut centred, mut least) = (CENTRED, MISSING);
        if let Some((start, inside, end)) = warm {
            (centred, least) = (end, end.sqrt_());
            columns.combine(start, &mut self.x);
            for i in 0..m {
                // The l and s whose product is that and whose difference is what the start says.
                let half = 0.5 * (columns.dot(i, &self.x) - beta[i] - start[i]);
                let product = (inside * largest) * (inside * largest);
                let far = half.abs_() + (half * half + product).sqrt_();
                (self.l[i], self.s[i]) = if half > 0.0 { (product / far, far) } else { (far, product / far) };
            }
        }
        frame.order(columns);
        for step in 0..STEPS {
            columns.combine(&self.l, &mut self.x);
            let (mut mean, mut missing) = (0.0, 0.0f64);
            for i in 0..m {
                self.short[i] = beta[i] - columns.dot(i, &self.x) + self.s[i];
                missing = missing.max(self.short[i].abs_());
                mean += self.l[i] * self.s[i] / m as f64;
                self.weight[i] = 1.0 / (SHIFT + self.s[i] / self.l[i]);
            }
            let done = !(mean > centred * largest * largest) && missing <= least * largest;
            if done || !mean.is_finite() {
                return step;
            }
            let weight = &self.weight;
            frame.factor(columns, |i| weight[i], 1.0);
            // The predictor aims at products of 0, the corrector at what the predictor makes plausible.
            self.step(columns, frame, None);
            let length = self.length();
            let ahead: f64 = (0..m)
                .map(|i| (self.l[i] + length * self.d_l[i]) * (self.s[i] + length * self.d_s[i]) / m as f64)
                .sum();
            let ratio = ahead / mean;
            self.step(columns, frame, Some(ratio * ratio * ratio * mean));
            let length = INWARD * self.length();
            for i in 0..m {
                self.l[i] += length * self.d_l[i];
                self.s[i] += length * self.d_s[i];
            }
        }
        STEPS
    }

    /// l_i of a contact that pushes more than it opens.
    pub fn pushes(&self, i: usize) -> Option<f64> {
        (self.l[i] > self.s[i] && self.l[i].is_finite()).then_some(self.l[i])
    }

    /// The impulses. Those of contacts that are as good as open are left out: together they do less than what is missing.
    pub fn impulses(&self, lambda: &mut Vec<f64>) {
        lambda.clear();
        lambda.extend(self.l.iter().zip(&self.s).map(|(l, s)| if *l > FAINT * s { *l } else { 0.0 }));
    }

    /// The step towards products `aim`, with the second-order term of the step before; the predictor has neither.
    fn step(&mut self, columns: &Columns, frame: &mut Frame, aim: Option<f64>) {
        let m = columns.len();
        for i in 0..m {
            let (l, s) = (self.l[i], self.s[i]);
            self.d_s[i] = l * s + aim.map_or(0.0, |aim| self.d_l[i] * self.d_s[i] - aim);
            self.right[i] = self.short[i] - self.d_s[i] / l;
            // (C^T C + 1/W)^-1 r = W (r - C^T (1 + C W C^T)^-1 C W r)
            self.d_l[i] = self.weight[i] * self.right[i];
        }
        columns.combine(&self.d_l, &mut self.x);
        frame.solve(&mut self.x);
        for i in 0..m {
            self.d_l[i] = self.weight[i] * (self.right[i] - columns.dot(i, &self.x));
            self.d_s[i] = -(self.d_s[i] + self.s[i] * self.d_l[i]) / self.l[i];
        }
    }

    /// How much of the step keeps l and s from being negative, at most 1.
    fn length(&self) -> f64 {
        let mut length = 1.0;
        for (list, step) in [(&self.l, &self.d_l), (&self.s, &self.d_s)] {
            for (x, d) in list.iter().zip(step) {
                if x + length * d < 0.0 {
                    length = -x / d;
                }
            }
        }
        length
    }
}
