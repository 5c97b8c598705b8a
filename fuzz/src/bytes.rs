//! Bytes as choices and numbers: read from the front; when they are used up, everything is zero.
use carom::Vector;

/// What is left of an input.
pub struct Bytes<'a> {
    rest: &'a [u8],
    /// Numbers may be anything that 64 bits can say; else they are those of a world that somebody might have made.
    pub wild: bool,
}

/// Numbers at the ends of what a number can be, and where formulas change their case.
const WILD: [f64; 24] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    -0.0,
    5e-324,
    -5e-324,
    f64::MIN_POSITIVE,
    f64::MAX,
    f64::MIN,
    f64::EPSILON,
    1e-300,
    1e-160,
    1e-100,
    1e-30,
    1e-12,
    1e-9,
    1e9,
    1e12,
    1e16,
    -1e16,
    1e100,
    1e154,
    -1e160,
    1e300,
];

const MASSES: [f64; 8] = [1.0, 2.0, 0.5, 1e-3, 1e3, 1e6, 1e-6, 3.0];

impl<'a> Bytes<'a> {
    pub fn new(bytes: &'a [u8], wild: bool) -> Self {
        Self { rest: bytes, wild }
    }

    pub fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        match self.rest.split_first() {
            Some((&first, rest)) => {
                self.rest = rest;
                first
            }
            None => 0,
        }
    }

    /// One of `n`.
    pub fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }

    pub fn coin(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// In a wild world, now and then, any number at all.
    pub fn any(&mut self) -> Option<f64> {
        if !self.wild {
            return None;
        }
        match self.byte() {
            k @ 0..24 => Some(WILD[usize::from(k)]),
            24..40 => Some(f64::from_le_bytes(std::array::from_fn(|_| self.byte()))),
            _ => None,
        }
    }

    /// A whole number of sixteenths between -8 and 8: so coarse that many things happen at one instant.
    pub fn number(&mut self) -> f64 {
        self.any().unwrap_or_else(|| f64::from(self.byte() as i8) / 16.0)
    }

    pub fn vector<const D: usize>(&mut self) -> Vector<D> {
        Vector::from_fn(|_| self.number())
    }

    /// A length between 1/64 and 1/2.
    pub fn radius(&mut self) -> f64 {
        self.any().unwrap_or_else(|| f64::from(1 + self.byte() % 32) / 64.0)
    }

    pub fn mass(&mut self) -> f64 {
        self.any().unwrap_or_else(|| MASSES[self.below(MASSES.len())])
    }

    /// A number of [0, 1], its ends included.
    pub fn share(&mut self) -> f64 {
        self.any().unwrap_or_else(|| f64::from(self.byte() % 17) / 16.0)
    }

    /// A piece of time of up to a quarter of a second.
    pub fn piece(&mut self) -> f64 {
        self.any().unwrap_or_else(|| f64::from(1 + self.byte() % 64) / 256.0)
    }
}
