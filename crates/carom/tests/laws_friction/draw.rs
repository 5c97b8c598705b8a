//! Random impacts: the same ones in every run.
use carom::law::{Contact, Side};
use carom::material::Coefficients;
use carom::{Matrix, Rotates, Vector};

/// How many impacts a property draws: `usual`, unless the environment asks for another number.
pub fn cases(usual: u64) -> u64 {
    std::env::var("CAROM_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(usual)
}

/// SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, 2014).
pub struct Draw(u64);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e3779b97f4a7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58476d1ce4e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d049bb133111eb);
        z ^ (z >> 31)
    }

    /// Uniform in [low, high).
    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    pub fn one_in(&mut self, n: u64) -> bool {
        self.bits().is_multiple_of(n)
    }

    /// 10 to a uniform power.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        libm::pow(10.0, self.number(low, high))
    }

    pub fn vector<const D: usize>(&mut self) -> Vector<D> {
        Vector::from_fn(|_| self.number(-1.0, 1.0))
    }

    /// A direction, every one equally likely.
    pub fn unit<const D: usize>(&mut self) -> Vector<D> {
        for _ in 0..1000 {
            let v = self.vector::<D>();
            if v.norm_squared() <= 1.0
                && let Some(unit) = v.unit()
            {
                return unit;
            }
        }
        Vector::axis(0)
    }

    /// e in [0, 1], e_t in [-1, 1] and mu, each at its ends now and then.
    pub fn coefficients(&mut self) -> Coefficients {
        let at_end = |draw: &mut Self, low: f64, high: f64| match draw.bits() % 8 {
            0 => low,
            1 => high,
            _ => draw.number(low, high),
        };
        let friction = match self.bits() % 8 {
            0 => 0.0,
            1 => self.magnitude(0.0, 3.0),
            _ => self.magnitude(-2.0, 0.5),
        };
        Coefficients {
            restitution: at_end(self, 0.0, 1.0),
            tangential: at_end(self, -1.0, 1.0),
            friction,
            ..Default::default()
        }
    }
}

/// Spaces in which bodies of random shape can be drawn.
pub trait Shapes: Rotates {
    fn inverse_inertia(draw: &mut Draw, mass: f64) -> Self::InverseInertia;
    fn spin(draw: &mut Draw) -> Self::Spin;
}

impl Shapes for Vector<2> {
    fn inverse_inertia(draw: &mut Draw, mass: f64) -> f64 {
        1.0 / (mass * draw.number(0.05, 1.0))
    }
    fn spin(draw: &mut Draw) -> Vector<1> {
        draw.vector()
    }
}

impl Shapes for Vector<3> {
    /// Three masses on three axes give principal moments that a body can have (none exceeds the sum of the other two), turned
    /// every way.
    fn inverse_inertia(draw: &mut Draw, mass: f64) -> Matrix<3> {
        let [x, y, z] = [0; 3].map(|_| mass * draw.number(0.02, 1.0));
        let inverse = [1.0 / (y + z), 1.0 / (x + z), 1.0 / (x + y)];
        let r = rotation(draw);
        Matrix::from_fn(|i, j| (0..3).map(|k| r.0[i][k] * inverse[k] * r.0[j][k]).sum())
    }
    fn spin(draw: &mut Draw) -> Vector<3> {
        draw.vector()
    }
}

/// A rotation of space: an orthonormal right-handed triad, as rows.
pub fn rotation(draw: &mut Draw) -> Matrix<3> {
    let x = draw.unit::<3>();
    let z = Vector::<3>::moment(x, draw.unit()).unit().unwrap_or(Vector([0.0, 0.0, 1.0]));
    Matrix([x.0, Vector::<3>::moment(z, x).0, z.0])
}

/// Bodies of any shape, sizes of order 1, masses from 1e-3 to 1e3 (so that ratios go to 1e6), arms of any direction and up to
/// 1.5 in length; one time in three the second is a wall. They approach.
pub fn contact<const D: usize>(draw: &mut Draw) -> Contact<D>
where
    Vector<D>: Shapes,
{
    let body = |draw: &mut Draw| {
        let mass = draw.magnitude(-3.0, 3.0);
        Side {
            velocity: draw.vector(),
            spin: Vector::<D>::spin(draw),
            inverse_mass: 1.0 / mass,
            inverse_inertia: Vector::<D>::inverse_inertia(draw, mass),
            arm: draw.unit() * draw.number(0.0, 1.5),
        }
    };
    let first = body(draw);
    let second = if draw.one_in(3) { Side::driven(draw.vector()) } else { body(draw) };
    let mut contact = Contact { normal: draw.unit(), sides: [first, second] };
    if contact.approach() < 0.0 {
        contact.normal = -contact.normal;
    }
    contact
}

/// A ball, and a ball or a wall, that approach; with the direction from the first to the second.
pub fn balls<const D: usize>(draw: &mut Draw) -> [carom::law::rough::Turning<D>; 2]
where
    Vector<D>: Shapes,
{
    use carom::law::{rough::Turning, smooth::Moving};
    let ball = |draw: &mut Draw| Turning {
        moving: Moving::new(draw.magnitude(-6.0, 6.0), draw.vector::<D>()),
        spin: Vector::<D>::spin(draw),
        radius: draw.magnitude(-1.0, 1.0),
        kappa: draw.number(0.1, 1.0),
    };
    let first = ball(draw);
    [first, if draw.one_in(3) { Turning::wall(draw.vector::<D>()) } else { ball(draw) }]
}
