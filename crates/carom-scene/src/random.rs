//! Random numbers that are the same on every platform: PCG, and `libm` for what is not + - * / or a square root.
use rand_core::Rng;
use rand_pcg::Pcg64;

/// What a group draws numbers for: each has a stream of its own, so that one more try for a place changes no velocity.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Purpose {
    Places = 0,
    Velocities = 1,
}

/// A stream of random numbers.
pub(crate) struct Random {
    source: Pcg64,
    /// The second number of a Gaussian pair.
    spare: Option<f64>,
}

impl Random {
    /// The stream of a run's seed, a group's number and a purpose.
    pub fn new(seed: u64, group: usize, purpose: Purpose) -> Self {
        // Seeds and groups are small numbers; PCG wants all its bits to differ.
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            u128::from(mix(state))
        };
        let (a, b) = (next(), next());
        let mut state = 2 * group as u64 + purpose as u64;
        let mut next = || {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            u128::from(mix(state))
        };
        let (c, d) = (next(), next());
        Self { source: Pcg64::new(((a << 64) | b) ^ (d << 64), (c << 64) | d), spare: None }
    }

    /// Evenly spread in [0, 1), in steps of 2^-53.
    pub fn unit(&mut self) -> f64 {
        (self.source.next_u64() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Normally spread, with mean 0 and variance 1 (Marsaglia's polar method).
    pub fn normal(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        loop {
            let (x, y) = (2.0 * self.unit() - 1.0, 2.0 * self.unit() - 1.0);
            let square = x * x + y * y;
            // Of 2^106 pairs one is the origin: this ends.
            if square < 1.0 && square > 0.0 {
                let stretch = libm::sqrt(-2.0 * libm::log(square) / square);
                self.spare = Some(y * stretch);
                return x * stretch;
            }
        }
    }
}

/// SplitMix64's finaliser (Steele, Lea and Flood 2014).
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_differ_and_repeat() {
        let draw = |seed, group, purpose| {
            let mut random = Random::new(seed, group, purpose);
            (0..4).map(|_| random.unit().to_bits()).collect::<Vec<_>>()
        };
        let mut all = vec![];
        for seed in [0, 1, 2, u64::MAX] {
            for group in 0..3 {
                for purpose in [Purpose::Places, Purpose::Velocities] {
                    assert_eq!(draw(seed, group, purpose), draw(seed, group, purpose));
                    all.push(draw(seed, group, purpose));
                }
            }
        }
        let count = all.len();
        all.sort();
        all.dedup();
        assert_eq!(all.len(), count);
    }

    #[test]
    fn moments_are_those_of_the_distributions() {
        let mut random = Random::new(1, 0, Purpose::Velocities);
        let n = 200_000;
        let mean = |f: &mut dyn FnMut() -> f64| (0..n).map(|_| f()).sum::<f64>() / n as f64;
        // Five standard errors: of the mean of a unit 0.29/sqrt(n), of normal 1/sqrt(n), of x^2 1.41/sqrt(n), of x^4
        // 9.8/sqrt(n), with 1/sqrt(n) = 0.00224.
        assert!((mean(&mut || random.unit()) - 0.5).abs() < 0.0033);
        assert!(mean(&mut || random.normal()).abs() < 0.0112);
        assert!((mean(&mut || random.normal().powi(2)) - 1.0).abs() < 0.0158);
        assert!((mean(&mut || random.normal().powi(4)) - 3.0).abs() < 0.11);
    }
}
