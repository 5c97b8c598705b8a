//! What two surfaces say of each other: coefficients, how two materials combine, and the table of pairs.
use alloc::vec::Vec;

use crate::codec::{Codec, Hash, Reader, codec};
use crate::vector::Exact;

mod law;
mod table;

pub use law::Law;
pub use table::{MaterialId, Materials, Pair};

/// A coefficient: one number, or a curve over speed.
#[derive(Clone, Debug, PartialEq)]
pub enum Coefficient {
    /// The same at every speed.
    Constant(f64),
    /// Points (speed in m/s, value) of rising speed: linear between them, constant outside.
    Curve(Vec<(f64, f64)>),
}

impl Coefficient {
    /// The value at this speed (m/s).
    pub fn at(&self, speed: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Curve(points) => {
                let after = points.partition_point(|&(s, _)| s <= speed);
                match (after.checked_sub(1).and_then(|k| points.get(k)), points.get(after)) {
                    (Some(&(s0, v0)), Some(&(s1, v1))) => v0 + (v1 - v0) * ((speed - s0) / (s1 - s0)),
                    (Some(&(_, v)), None) | (None, Some(&(_, v))) => v,
                    (None, None) => 0.0,
                }
            }
        }
    }

    /// The lowest and the highest value the coefficient can take. Of a curve without points: (0, 0).
    pub fn range(&self) -> (f64, f64) {
        match self {
            Self::Constant(value) => (*value, *value),
            Self::Curve(points) => {
                points
                    .iter()
                    .map(|p| p.1)
                    .fold(None, |range: Option<(f64, f64)>, v| {
                        Some(range.map_or((v, v), |(low, high)| {
                            (if v < low { v } else { low }, if v > high { v } else { high })
                        }))
                    })
                    .unwrap_or((0.0, 0.0))
            }
        }
    }

    /// True if the coefficient is well formed: finite, in [`low`, `high`], a curve's speeds not negative and rising, and at
    /// least one point.
    pub fn is_valid(&self, low: f64, high: f64) -> bool {
        let fits = |v: f64| v >= low && v <= high && v.is_finite();
        match self {
            Self::Constant(value) => fits(*value),
            Self::Curve(points) => {
                !points.is_empty()
                    && points.iter().all(|&(s, v)| s.is_finite() && s >= 0.0 && fits(v))
                    && points.windows(2).all(|w| w[0].0 < w[1].0)
            }
        }
    }
}

impl Codec for Coefficient {
    fn layout(hash: &mut Hash) {
        hash.add(b"Coefficient");
    }
    fn write(&self, to: &mut Vec<u8>) {
        match self {
            Self::Constant(value) => (0u8, *value).write(to),
            Self::Curve(points) => {
                1u8.write(to);
                points.write(to);
            }
        }
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        match u8::read(from)? {
            0 => f64::read(from).map(Self::Constant),
            1 => Vec::read(from).map(Self::Curve),
            _ => None,
        }
    }
}

impl From<f64> for Coefficient {
    fn from(value: f64) -> Self {
        Self::Constant(value)
    }
}

/// What a surface says. A coefficient left out (`None`) leaves the word to the other surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Material {
    /// Coefficient of restitution e in [0, 1], by approach speed.
    pub restitution: Option<Coefficient>,
    /// Coulomb's coefficient of friction mu >= 0, by slip speed.
    pub friction: Option<Coefficient>,
    /// Tangential restitution e_t in [-1, 1].
    pub tangential: Option<f64>,
    /// Coefficient of rolling resistance >= 0 of a contact that lasts: what resists rolling is the moment
    /// `rolling` N R, with N the normal force and R the ball's radius.
    pub rolling: Option<f64>,
    /// Coefficient of spinning friction >= 0 of a contact that lasts: what resists spinning about the normal is the moment
    /// `spinning` N R.
    pub spinning: Option<f64>,
}

codec!(Material { restitution, friction, tangential, rolling, spinning });

impl Material {
    /// A material that says nothing: two of them meet as the lecture's smooth elastic balls.
    pub fn new() -> Self {
        Self::default()
    }

    /// This material with the coefficient of restitution `e`, a number in [0, 1] or a curve.
    pub fn restitution(mut self, e: impl Into<Coefficient>) -> Self {
        self.restitution = Some(e.into());
        self
    }

    /// This material with the coefficient of friction `mu` >= 0, a number or a curve.
    pub fn friction(mut self, mu: impl Into<Coefficient>) -> Self {
        self.friction = Some(mu.into());
        self
    }

    /// This material with the tangential restitution `e_t` in [-1, 1].
    pub fn tangential(mut self, e_t: f64) -> Self {
        self.tangential = Some(e_t);
        self
    }

    /// This material with the coefficient of rolling resistance `c` >= 0.
    pub fn rolling(mut self, c: f64) -> Self {
        self.rolling = Some(c);
        self
    }

    /// This material with the coefficient of spinning friction `c` >= 0.
    pub fn spinning(mut self, c: f64) -> Self {
        self.spinning = Some(c);
        self
    }

    /// True if every coefficient that is said lies in its range.
    pub fn is_valid(&self) -> bool {
        self.restitution.as_ref().is_none_or(|e| e.is_valid(0.0, 1.0))
            && self.friction.as_ref().is_none_or(|mu| mu.is_valid(0.0, f64::MAX))
            && self.tangential.is_none_or(|t| (-1.0..=1.0).contains(&t))
            && [self.rolling, self.spinning].iter().flatten().all(|&c| c >= 0.0 && c.is_finite())
    }
}

/// The coefficients of one impact, as two surfaces gave them at its speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// e.
    pub restitution: f64,
    /// mu.
    pub friction: f64,
    /// e_t.
    pub tangential: f64,
    /// Rolling resistance; of contacts that last.
    pub rolling: f64,
    /// Spinning friction; of contacts that last.
    pub spinning: f64,
}

codec!(Coefficients { restitution, friction, tangential, rolling, spinning });

/// The lecture's ball, where neither surface says a word: smooth and elastic.
pub const UNSAID: Coefficients =
    Coefficients { restitution: 1.0, friction: 0.0, tangential: 0.0, rolling: 0.0, spinning: 0.0 };

impl Default for Coefficients {
    fn default() -> Self {
        UNSAID
    }
}

/// How two materials combine, coefficient by coefficient: where both say a value, the geometric mean (for the tangential
/// restitution, which may be negative, the mean); where one says it, that one; where neither does, [`UNSAID`].
///
/// `approach` and `slip` are the speeds of the impact (m/s), at which curves are read.
pub fn combine(a: &Material, b: &Material, approach: f64, slip: f64) -> Coefficients {
    let geometric = |a: Option<f64>, b: Option<f64>, unsaid| match (a, b) {
        // The mean of two equal values is that value, without the rounding of a square root.
        (Some(a), Some(b)) if a == b => a,
        (Some(a), Some(b)) => (a * b).sqrt_(),
        (Some(one), None) | (None, Some(one)) => one,
        (None, None) => unsaid,
    };
    let at = |c: &Option<Coefficient>, speed| c.as_ref().map(|c| c.at(speed));
    Coefficients {
        restitution: geometric(at(&a.restitution, approach), at(&b.restitution, approach), UNSAID.restitution),
        friction: geometric(at(&a.friction, slip), at(&b.friction, slip), UNSAID.friction),
        tangential: match (a.tangential, b.tangential) {
            (Some(a), Some(b)) => 0.5 * (a + b),
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => UNSAID.tangential,
        },
        rolling: geometric(a.rolling, b.rolling, UNSAID.rolling),
        spinning: geometric(a.spinning, b.spinning, UNSAID.spinning),
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use super::*;

    #[test]
    fn the_rule_of_the_contract() {
        let (none, half, eighth) =
            (Material::new(), Material::new().restitution(0.5), Material::new().restitution(0.125));
        let e = |a, b| combine(a, b, 1.0, 0.0).restitution;
        assert_eq!((e(&none, &none), e(&none, &half), e(&half, &none)), (1.0, 0.5, 0.5));
        assert_eq!((e(&half, &eighth), e(&half, &half)), (0.25, 0.5));
        let t = |a: f64, b: f64| {
            combine(&Material::new().tangential(a), &Material::new().tangential(b), 1.0, 0.0).tangential
        };
        assert_eq!(t(-1.0, 0.5), -0.25);
    }

    #[test]
    fn curves_are_linear_between_and_constant_outside() {
        let curve = Coefficient::Curve(vec![(0.1, 0.98), (1.0, 0.9), (5.0, 0.8)]);
        assert!(curve.is_valid(0.0, 1.0));
        for (speed, want) in [(0.0, 0.98), (0.1, 0.98), (0.55, 0.94), (1.0, 0.9), (3.0, 0.85), (5.0, 0.8), (99.0, 0.8)]
        {
            assert!((curve.at(speed) - want).abs() < 1e-15, "{speed}");
        }
        assert_eq!(curve.range(), (0.8, 0.98));
        assert!(!Coefficient::Curve(vec![(1.0, 0.5), (1.0, 0.4)]).is_valid(0.0, 1.0));
        assert!(!Coefficient::Curve(vec![]).is_valid(0.0, 1.0));
        assert!(!Coefficient::Constant(f64::NAN).is_valid(0.0, 1.0));
    }
}
