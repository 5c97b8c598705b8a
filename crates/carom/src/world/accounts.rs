//! The accounts of a world: what its bodies have, and the ledger.
use super::World;
use super::store::Motion;
use crate::ledger::{Ledger, Magnitudes, Sum, Sums, Totals};
use crate::{Rotates, Vector};

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// Books what the user adds (+1) or takes (-1) with a body.
    pub(super) fn book_user(&mut self, i: usize, sign: f64) {
        if self.books.start.is_none() || self.store.bodies.is_fixed(i) {
            return;
        }
        let own = self.totals_of(i);
        self.books.momentum_given.add(&(own.momentum * sign).0);
        self.books.angular_given.add(Vector::<D>::spin_slice(&(own.angular_momentum * sign)));
        self.books.work.add(sign * (own.kinetic + own.potential));
        let magnitudes = self.magnitudes(i);
        self.books.now.add(&magnitudes, sign);
        let now = self.books.now;
        self.books.largest.raise(&now);
    }

    /// What body `i` has now.
    pub(super) fn totals_of(&self, i: usize) -> Totals<D> {
        let b = &self.store.bodies;
        let (x, v) = self.state_now(i);
        let spin = self.spin_now(i);
        let m = b.matter[i].mass;
        Totals {
            momentum: v * m,
            angular_momentum: Vector::<D>::moment(x, v * m) + spin * b.inertia[i],
            kinetic: 0.5 * (m * v.norm_squared() + b.inertia[i] * Vector::<D>::spin_dot(spin, spin)),
            potential: -m * self.store.gravity.dot(x),
        }
    }

    /// What the moving bodies have now, and the sums of magnitudes behind it. Compensated.
    pub(super) fn totals(&self) -> (Totals<D>, Magnitudes) {
        let mut momentum = Sums::default();
        let mut angular = Sums::default();
        let (mut kinetic, mut potential) = (Sum::default(), Sum::default());
        let mut magnitudes = Magnitudes::default();
        for i in self.store.bodies.living().filter(|&i| !self.store.bodies.is_fixed(i)) {
            let own = self.totals_of(i);
            momentum.add(&own.momentum.0);
            angular.add(Vector::<D>::spin_slice(&own.angular_momentum));
            kinetic.add(own.kinetic);
            potential.add(own.potential);
            magnitudes.momentum += own.momentum.norm();
            let (x, _) = self.state_now(i);
            magnitudes.angular += x.norm() * own.momentum.norm();
            magnitudes.energy += own.kinetic + if own.potential < 0.0 { -own.potential } else { own.potential };
        }
        let totals = Totals {
            momentum: momentum.vector(),
            angular_momentum: angular.spin::<D>(),
            kinetic: kinetic.value(),
            potential: potential.value(),
        };
        (totals, magnitudes)
    }

    /// The accounts, now: what there was, what there is, who gave and who took, and what nothing explains. Reads every body;
    /// writes nothing.
    pub fn ledger(&self) -> Ledger<D> {
        let (totals, magnitudes) = self.totals();
        let mut books = self.books.clone();
        if books.start.is_some() && !self.store.uniform {
            // What gravity and supports have given since the last record of each.
            books.momentum_given.add(&self.partial.momentum.0);
            books.angular_given.add(Vector::<D>::spin_slice(&self.partial.moment));
            books.lost.add(self.partial.lost);
            books.work.add(self.partial.work);
            let counted = |i: &usize| !self.store.bodies.is_fixed(*i) && self.store.bodies.motion[*i] != Motion::Sliced;
            for i in self.store.bodies.living().filter(counted) {
                let given = self.flight(i, self.time - self.store.bodies.record[i].time);
                books.momentum_given.add(&given.momentum.0);
                books.angular_given.add(Vector::<D>::spin_slice(&given.moment));
                if given.work != 0.0 {
                    books.work.add(given.work);
                }
                if given.lost != 0.0 {
                    books.lost.add(given.lost);
                }
            }
        }
        books.read(&totals, &magnitudes, self.store.any_periodic)
    }
}
