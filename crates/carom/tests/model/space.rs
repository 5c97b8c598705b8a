//! Vectors of space, for the simulator alone. The line is the first axis, the plane the first two; a disc spins about the third.
use std::ops::{Add, Mul, Neg, Sub};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct V(pub [f64; 3]);

impl V {
    pub const ZERO: Self = Self([0.0; 3]);

    pub fn dot(self, b: Self) -> f64 {
        self.0[0] * b.0[0] + self.0[1] * b.0[1] + self.0[2] * b.0[2]
    }

    pub fn cross(self, b: Self) -> Self {
        let (a, b) = (self.0, b.0);
        Self([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
    }

    pub fn length(self) -> f64 {
        self.dot(self).sqrt()
    }
}

impl Add for V {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self([self.0[0] + b.0[0], self.0[1] + b.0[1], self.0[2] + b.0[2]])
    }
}

impl Sub for V {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Neg for V {
    type Output = Self;
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl Mul<f64> for V {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self([self.0[0] * s, self.0[1] * s, self.0[2] * s])
    }
}
