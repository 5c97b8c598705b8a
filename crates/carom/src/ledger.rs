//! The accounts of a world: momentum, angular momentum and energy, what walls and gravity handed over, what impacts took,
//! and what is left unexplained.
use crate::codec::codec;
use crate::vector::Exact;
use crate::{Rotates, Vector};

/// A compensated sum (Neumaier 1974): a million small terms cost no digits of the total.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    sum: f64,
    carry: f64,
}

codec!(Sum { sum, carry });

impl Sum {
    /// Adds a term.
    #[inline(always)]
    pub fn add(&mut self, x: f64) {
        let total = self.sum + x;
        self.carry += if self.sum.abs_() >= x.abs_() { (self.sum - total) + x } else { (x - total) + self.sum };
        self.sum = total;
    }

    /// The total.
    pub fn value(&self) -> f64 {
        self.sum + self.carry
    }
}

/// A compensated sum of vectors, or of spins (at most three numbers).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sums([Sum; 3]);

impl crate::codec::Codec for Sums {
    fn layout(hash: &mut crate::codec::Hash) {
        <[Sum; 3]>::layout(hash);
    }
    fn write(&self, to: &mut alloc::vec::Vec<u8>) {
        self.0.write(to);
    }
    fn read(from: &mut crate::codec::Reader<'_>) -> Option<Self> {
        <[Sum; 3]>::read(from).map(Self)
    }
}

impl Sums {
    #[inline(always)]
    pub(crate) fn add(&mut self, terms: &[f64]) {
        for (sum, &x) in self.0.iter_mut().zip(terms) {
            sum.add(x);
        }
    }

    pub(crate) fn vector<const D: usize>(&self) -> Vector<D> {
        Vector::from_fn(|k| self.0[k].value())
    }

    pub(crate) fn spin<const D: usize>(&self) -> <Vector<D> as Rotates>::Spin
    where
        Vector<D>: Rotates,
    {
        let numbers: [f64; 3] = core::array::from_fn(|k| self.0[k].value());
        Vector::<D>::spin_from(&numbers[..Vector::<D>::SPINS]).unwrap_or_default()
    }
}

/// What the moving bodies of a world have at one time, with the magnitudes of which it is the sum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals<const D: usize>
where
    Vector<D>: Rotates,
{
    /// Sum of m v (N s).
    pub momentum: Vector<D>,
    /// Sum of m x cross v + I w about the origin (N m s).
    pub angular_momentum: <Vector<D> as Rotates>::Spin,
    /// Kinetic energy, turning included (J).
    pub kinetic: f64,
    /// Potential energy -m g.x, zero at the origin (J).
    pub potential: f64,
}

codec!(Totals<D> { momentum, angular_momentum, kinetic, potential });

/// The sums of magnitudes that an account's rounding is measured against.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Magnitudes {
    /// Sum of m |v|.
    pub momentum: f64,
    /// Sum of m |x| |v| + |I w|.
    pub angular: f64,
    /// Sum of m v^2 / 2 + I w^2 / 2 + |m g.x|.
    pub energy: f64,
}

codec!(Magnitudes { momentum, angular, energy });

impl Magnitudes {
    #[inline(always)]
    pub(crate) fn add(&mut self, other: &Self, sign: f64) {
        self.momentum += sign * other.momentum;
        self.angular += sign * other.angular;
        self.energy += sign * other.energy;
    }

    #[inline(always)]
    pub(crate) fn raise(&mut self, other: &Self) {
        self.momentum = if other.momentum > self.momentum { other.momentum } else { self.momentum };
        self.angular = if other.angular > self.angular { other.angular } else { self.angular };
        self.energy = if other.energy > self.energy { other.energy } else { self.energy };
    }
}

/// The open books of a world.
#[derive(Clone, Debug)]
pub(crate) struct Books<const D: usize>
where
    Vector<D>: Rotates,
{
    pub start: Option<Totals<D>>,
    pub momentum_given: Sums,
    pub angular_given: Sums,
    pub lost: Sum,
    pub work: Sum,
    /// The magnitudes as the records stand, and the largest they have been.
    pub now: Magnitudes,
    pub largest: Magnitudes,
    pub overlap: f64,
    pub capped: u64,
}

codec!(Books<D> { start, momentum_given, angular_given, lost, work, now, largest, overlap, capped });

impl<const D: usize> Default for Books<D>
where
    Vector<D>: Rotates,
{
    fn default() -> Self {
        Self {
            start: None,
            momentum_given: Sums::default(),
            angular_given: Sums::default(),
            lost: Sum::default(),
            work: Sum::default(),
            now: Magnitudes::default(),
            largest: Magnitudes::default(),
            overlap: 0.0,
            capped: 0,
        }
    }
}

/// One account of a vector quantity: end = start + given, but for the drift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Account<T> {
    /// What there was when the books were opened.
    pub start: T,
    /// What there is now.
    pub end: T,
    /// What gravity, walls, fixed bodies and the user handed over.
    pub given: T,
    /// The length of what is left unexplained, divided by the account's scale: the largest sum of magnitudes over the run, what walls and
    /// fixed bodies were about to take included (or by nothing, if that is 0).
    pub drift: f64,
}

/// The account of energy: end = start - lost + work, but for the drift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyAccount {
    /// Kinetic and potential energy when the books were opened (J).
    pub start: f64,
    /// The same now (J).
    pub end: f64,
    /// The kinetic part of `end` (J).
    pub kinetic: f64,
    /// The potential part of `end` (J), zero at the origin.
    pub potential: f64,
    /// What impacts, friction and rest took (J).
    pub lost: f64,
    /// What driven walls, driven bodies and the user put in (J).
    pub work: f64,
    /// What is left unexplained, divided by the account's scale.
    pub drift: f64,
}

/// The accounts of a world at one time, of its moving bodies. Read with [`World::ledger`](crate::World::ledger).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ledger<const D: usize>
where
    Vector<D>: Rotates,
{
    /// Momentum (N s).
    pub momentum: Account<Vector<D>>,
    /// Angular momentum about the origin (N m s); `None` in a periodic world, which has no such account.
    pub angular_momentum: Option<Account<<Vector<D> as Rotates>::Spin>>,
    /// Energy (J).
    pub energy: EnergyAccount,
    /// The deepest overlap that was seen in the run so far, divided by the smaller of the two radii (a wall has none); 0 if none was.
    ///
    /// Contacts are measured when they exchange an impulse (an impact, or a slice of a lasting contact), since that is where bodies
    /// are nearest; what is between two such instants is free flight, in which no pair can come nearer than where it meets. Nobody
    /// looks at bodies that never exchange anything (sensors, ignored pairs, what overlaps and moves apart):
    /// [`World::deepest_overlap`](crate::World::deepest_overlap) measures all that there is now, and what it finds counts here from
    /// then on. Rounding alone leaves about 1e-15; it never becomes smaller again.
    pub overlap: f64,
    /// How often an iteration limit ended an instant.
    pub capped: u64,
}

/// Every drift of a sound run lies below this.
pub const DRIFT_LIMIT: f64 = 1e-9;
/// The overlap of a sound run lies below this (below 1e-9 without lasting contacts).
pub const OVERLAP_LIMIT: f64 = 1e-6;

impl<const D: usize> Ledger<D>
where
    Vector<D>: Rotates,
{
    /// The largest drift of the accounts: what nothing explains.
    pub fn unexplained(&self) -> f64 {
        let mut worst = self.momentum.drift;
        for drift in [self.angular_momentum.as_ref().map_or(0.0, |a| a.drift), self.energy.drift] {
            if !(drift <= worst) {
                worst = drift; // NaN is the worst of all
            }
        }
        worst
    }

    /// True if every drift is below [`DRIFT_LIMIT`] and the overlap below [`OVERLAP_LIMIT`].
    pub fn pass(&self) -> bool {
        self.unexplained() < DRIFT_LIMIT && self.momentum.drift < DRIFT_LIMIT && self.overlap < OVERLAP_LIMIT
    }
}

impl<const D: usize> Books<D>
where
    Vector<D>: Rotates,
{
    /// The ledger, given what the bodies have now.
    pub(crate) fn read(&self, end: &Totals<D>, magnitudes: &Magnitudes, periodic: bool) -> Ledger<D> {
        let start = self.start.unwrap_or(*end);
        let mut scale = self.largest;
        scale.raise(magnitudes);
        let drift = |remainder: f64, scale: f64| if scale > 0.0 { remainder / scale } else { remainder };
        let given: Vector<D> = self.momentum_given.vector();
        let momentum = Account {
            start: start.momentum,
            end: end.momentum,
            given,
            drift: drift(((end.momentum - start.momentum) - given).norm(), scale.momentum),
        };
        let given = self.angular_given.spin::<D>();
        let remainder = (end.angular_momentum - start.angular_momentum) - given;
        let angular_momentum = (!periodic).then(|| Account {
            start: start.angular_momentum,
            end: end.angular_momentum,
            given,
            drift: drift(Vector::<D>::spin_dot(remainder, remainder).sqrt_(), scale.angular),
        });
        let (first, last) = (start.kinetic + start.potential, end.kinetic + end.potential);
        let (lost, work) = (self.lost.value(), self.work.value());
        let energy = EnergyAccount {
            start: first,
            end: last,
            kinetic: end.kinetic,
            potential: end.potential,
            lost,
            work,
            drift: drift(((last - first) + (lost - work)).abs_(), scale.energy),
        };
        Ledger { momentum, angular_momentum, energy, overlap: self.overlap, capped: self.capped }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_terms_are_not_forgotten() {
        let mut sum = Sum::default();
        sum.add(1e16);
        for _ in 0..1000 {
            sum.add(1.0);
        }
        sum.add(-1e16);
        assert_eq!(sum.value(), 1000.0);
    }
}
