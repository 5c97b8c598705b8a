//! A Cholesky factor for few contacts.
use alloc::vec::Vec;

use super::columns::Columns;
use crate::vector::Exact;

/// L L^T = C_A^T C_A + diag(shift) for the active columns A, row by row.
#[derive(Clone, Debug, Default)]
pub(super) struct Dense {
    active: Vec<u32>,
    lower: Vec<f64>,
    work: Vec<f64>,
}

impl Dense {
    /// Factors for the columns that are `active`; every `shift` > 0.
    pub fn factor(&mut self, columns: &Columns, active: &[bool], shift: &[f64]) {
        self.active.clear();
        self.active.extend((0..columns.len() as u32).filter(|&i| active[i as usize]));
        let n = self.active.len();
        self.lower.clear();
        self.lower.resize(n * n, 0.0);
        self.work.clear();
        self.work.resize(columns.freedoms, 0.0);
        for r in 0..n {
            let i = self.active[r] as usize;
            columns.add(i, 1.0, &mut self.work);
            for s in 0..=r {
                self.lower[r * n + s] = columns.dot(self.active[s] as usize, &self.work);
            }
            for &(k, _) in columns.column(i) {
                self.work[k as usize] = 0.0;
            }
            let (above, row) = self.lower.split_at_mut(r * n);
            for s in 0..r {
                let other = &above[s * n..s * n + s + 1];
                row[s] = (row[s] - dot(&row[..s], &other[..s])) / other[s];
            }
            let pivot = row[r] + shift[i] - dot(&row[..r], &row[..r]);
            // In exact arithmetic pivot >= shift; rounding takes it below only where that is near eps.
            row[r] = pivot.max(0.5 * shift[i]).sqrt_();
        }
    }

    /// Replaces the active components of `t` by the solution for them as right-hand side.
    pub fn solve(&mut self, t: &mut [f64]) {
        let n = self.active.len();
        self.work.clear();
        self.work.extend(self.active.iter().map(|&i| t[i as usize]));
        for r in 0..n {
            let row = &self.lower[r * n..r * n + r + 1];
            self.work[r] = (self.work[r] - dot(&row[..r], &self.work[..r])) / row[r];
        }
        for r in (0..n).rev() {
            let row = &self.lower[r * n..r * n + r + 1];
            let y = self.work[r] / row[r];
            self.work[r] = y;
            for s in 0..r {
                self.work[s] -= row[s] * y;
            }
        }
        for r in 0..n {
            t[self.active[r] as usize] = self.work[r];
        }
    }
}

#[inline]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sum = 0.0;
    for k in 0..a.len() {
        sum += a[k] * b[k];
    }
    sum
}
