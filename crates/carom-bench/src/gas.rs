//! A gas in equilibrium: the world of a workload, ready to be measured.
use crate::dice::Dice;
use crate::pack::pack;
use crate::workload::{Variant, Workload};
use carom::{Ball, BodyId, Boundary, Limits, Material, Rotates, Vector, World};

/// A tile that is repeated has this many balls at least; a larger gas consists of copies of one, with velocities of their own.
const TILE: std::ops::RangeInclusive<usize> = 2_000..=16_000;
/// Impacts for each ball before a gas counts as a fluid; before a tile does, whose copies are measured soon after; and after it was
/// copied. After 20 the pressure of spheres at 0.49 is still a tenth too high.
const MELT: u64 = 20;
const MELT_TILE: u64 = 150;
const SETTLE: u64 = 4;

/// So much friction that no impact slips.
const GRIP: f64 = 1e6;

/// A gas of discs or spheres: diameter 1 (the smallest, if they differ), mass 1, temperature 1.
pub struct Gas<const D: usize>
where
    Vector<D>: Rotates,
{
    /// The world, warmed up.
    pub world: World<D>,
    /// The number of balls: as many as were asked for, or the nearest number of copies of a tile.
    pub count: usize,
    /// CPU time that the warmed up world's set-up took: adding the balls, and the first predictions (s).
    pub set_up: f64,
    ids: Vec<BodyId>,
    radii: Vec<f64>,
    masses: Vec<f64>,
    /// False under gravity, where pressure depends on height, and where impacts take energy.
    even: bool,
}

impl<const D: usize> Gas<D>
where
    Vector<D>: Rotates,
{
    /// Builds the gas of a workload with about `n` balls.
    ///
    /// # Errors
    /// In words, if so few balls do not fit.
    pub fn new(workload: &Workload, n: usize) -> Result<Self, String> {
        Self::with_threads(workload, n, 1)
    }

    /// The same, with so many threads at work from the start.
    ///
    /// # Errors
    /// As [`Gas::new`].
    pub fn with_threads(workload: &Workload, n: usize, threads: usize) -> Result<Self, String> {
        let no_room = || format!("{} needs more than {n} balls: try 500 or more", workload.name());
        if n < 8 {
            return Err(no_room());
        }
        let copies = copies(n, D);
        let tile = (n as f64 / copies.pow(D as u32) as f64).round() as usize;
        let mut dice = Dice::new(1);
        let poly = workload.variant == Variant::Poly;
        let radii: Vec<f64> = (0..tile).map(|_| 0.5 * if poly { 1.0 + 0.4 * dice.unit() } else { 1.0 }).collect();
        let masses: Vec<f64> =
            (0..tile).map(|_| if poly { libm::exp(dice.unit() * libm::log(100.0)) } else { 1.0 }).collect();
        let size = |r: f64| std::f64::consts::PI * if D == 2 { r * r } else { 4.0 / 3.0 * r * r * r };
        let filled: f64 = radii.iter().map(|&r| size(r)).sum();
        let side = libm::pow(filled / workload.fraction, 1.0 / D as f64);
        let largest = radii.iter().fold(0.0, |m: f64, &r| m.max(r));
        if side < 4.0 * largest {
            return Err(no_room());
        }
        let mut places = pack::<D>(&radii, side, &mut dice).ok_or_else(no_room)?;
        if copies > 1 {
            // One tile becomes a fluid by itself; the copies take its places.
            let mut small = Self::filled(&places, &radii, &masses, side, true, &mut dice, 1);
            small.warm(MELT_TILE);
            places = small.ids.iter().map(|&id| small.world.position(id).unwrap_or_default().0).collect();
        }
        let total = copies.pow(D as u32);
        let mut all = Vec::with_capacity(tile * total);
        for code in 0..total {
            let mut rest = code;
            let corner: [f64; D] = std::array::from_fn(|_| {
                let c = rest % copies;
                rest /= copies;
                c as f64 * side
            });
            all.extend(places.iter().map(|p| std::array::from_fn::<f64, D, _>(|k| p[k] + corner[k])));
        }
        let repeat = |numbers: &[f64]| numbers.repeat(total);
        let periodic = workload.variant != Variant::Gravity;
        let (radii, masses) = (repeat(&radii), repeat(&masses));
        let mut gas = Self::filled(&all, &radii, &masses, side * copies as f64, periodic, &mut dice, threads);
        gas.warm(if copies > 1 { SETTLE } else { MELT });
        match workload.variant {
            Variant::E09 => {
                let _ = gas.world.set_default_material(Material::new().restitution(0.9));
                // It cools while it is measured: there is no one temperature to divide the pressure by.
                gas.even = false;
                gas.warm(1);
            }
            Variant::Rough => {
                let rough = Material::new().restitution(1.0).tangential(1.0).friction(GRIP);
                let _ = gas.world.set_default_material(rough);
                // Until they turn as much as they move.
                gas.warm(MELT);
            }
            _ => {}
        }
        Ok(gas)
    }

    fn filled(
        places: &[[f64; D]],
        radii: &[f64],
        masses: &[f64],
        side: f64,
        periodic: bool,
        dice: &mut Dice,
        threads: usize,
    ) -> Self {
        let v = maxwell::<D>(masses, dice);
        let start = crate::clock::seconds(threads);
        let mut world = World::new();
        world = if periodic {
            world.boundary(Boundary::periodic(Vector::ZERO, Vector::from_fn(|_| side)))
        } else {
            // The places lie in a periodic box: walls stand a radius outside it. Potential energy over the height is about kT.
            let (edge, down) =
                (radii.iter().fold(0.0, |m: f64, &r| m.max(r)), Vector::<D>::axis(D - 1) * (-1.0 / side));
            let (low, high) = (Vector::from_fn(|_| -edge), Vector::from_fn(|_| side + edge));
            world.boundary(Boundary::walls(low, high)).gravity(down).rest_speed(0.0)
        };
        world.keep_reports(false);
        world.set_threads(threads);
        world.reserve(places.len());
        let ids =
            (0..places.len()).map(|i| world.ball(Ball::new(masses[i], radii[i]).at(places[i]).moving(v[i]))).collect();
        world.advance(0.0);
        let set_up = crate::clock::seconds(threads) - start;
        Self { world, count: places.len(), set_up, ids, radii: radii.to_vec(), masses: masses.to_vec(), even: periodic }
    }

    /// Runs until each ball has had so many impacts, on average.
    fn warm(&mut self, each: u64) {
        let until = self.world.impact_count() + each * self.count as u64 / 2;
        self.run_to(until);
    }

    fn run_to(&mut self, impacts: u64) {
        self.world.run(&Limits { impacts: Some(impacts), ..Limits::default() });
    }

    /// Runs so many impacts more (or one or two above, where an instant has several); how many it were.
    #[inline(never)]
    pub fn steps(&mut self, impacts: u64) -> u64 {
        let before = self.world.impact_count();
        self.run_to(before + impacts);
        self.world.impact_count() - before
    }

    /// The kinetic energy of motion, without that of turning (J).
    fn moving(&self) -> f64 {
        let of = |(&id, m): (&BodyId, &f64)| 0.5 * m * self.world.velocity(id).unwrap_or_default().norm_squared();
        self.ids.iter().zip(&self.masses).map(of).sum()
    }

    /// The compressibility factor p V / (N kT) from the virial of the impacts, over so many of them:
    /// Z = 1 + sum of J |r| / (2 K t), where 2 K = D N kT. `None` under gravity, where pressure depends on height, and in a gas
    /// that cools.
    pub fn z(&mut self, impacts: u64) -> Option<f64> {
        if !self.even {
            return None;
        }
        let index = |party: carom::Party| match party {
            carom::Party::Body(id) => self.ids.binary_search(&id).ok().map(|i| self.radii[i]),
            carom::Party::Wall(_) => None,
        };
        let (start, energy) = (self.world.time(), self.moving());
        self.world.keep_reports(true);
        let mut virial = 0.0;
        let mut left = impacts;
        while left > 0 {
            let before = self.world.impact_count();
            self.world.run(&Limits { impacts: Some(before + left.min(20_000)), ..Limits::default() });
            for i in self.world.impacts() {
                virial += i.impulse * i.parties.iter().filter_map(|&p| index(p)).sum::<f64>();
            }
            let done = self.world.impact_count() - before;
            if done == 0 {
                break;
            }
            left = left.saturating_sub(done);
        }
        self.world.keep_reports(false);
        let kinetic = 0.5 * (energy + self.moving());
        Some(1.0 + virial / (2.0 * kinetic * (self.world.time() - start)))
    }
}

/// Velocities after Maxwell: temperature 1 (<m v^2> = D), no momentum in all.
fn maxwell<const D: usize>(masses: &[f64], dice: &mut Dice) -> Vec<Vector<D>> {
    let mut v: Vec<Vector<D>> = masses.iter().map(|m| Vector::from_fn(|_| dice.normal() / m.sqrt())).collect();
    let mass: f64 = masses.iter().sum();
    let mean = v.iter().zip(masses).fold(Vector::ZERO, |s, (v, &m)| s + *v * m) / mass;
    v.iter_mut().for_each(|v| *v -= mean);
    let energy: f64 = v.iter().zip(masses).map(|(v, m)| m * v.norm_squared()).sum();
    let scale = ((D * (masses.len() - 1)) as f64 / energy).sqrt();
    v.iter_mut().for_each(|v| *v = *v * scale);
    v
}

/// Along each axis, how many copies of a tile make about `n` balls: exactly, if a tile of fitting size divides it.
fn copies(n: usize, dim: usize) -> usize {
    if n <= *TILE.end() {
        return 1;
    }
    let fits = |c: &usize| TILE.contains(&(n / c.pow(dim as u32)));
    let exact = (2..2_000usize).filter(fits).find(|c| n.is_multiple_of(c.pow(dim as u32)));
    exact.or_else(|| (2..2_000usize).find(fits)).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_add_up() {
        for (n, dim) in [(100_000, 3), (1_000_000, 3), (4_000_000, 3), (100_000, 2), (1_000_000, 2)] {
            let c = copies(n, dim).pow(dim as u32);
            assert!(TILE.contains(&(n / c)), "{n} {dim}: {c}");
        }
        assert_eq!(1_000_000 % copies(1_000_000, 3).pow(3), 0);
        assert_eq!(copies(10_000, 3), 1);
    }

    /// The virial's Z against Henderson's. Over 40,000 impacts its error is about sqrt(2 / 40,000) of Z - 1: 0.7 %.
    #[test]
    fn discs_have_their_pressure() {
        let workload = Workload::named("discs-0.30").unwrap();
        let mut gas = Gas::<2>::new(&workload, 500).unwrap();
        let (z, expected) = (gas.z(40_000).unwrap(), workload.expected_z().unwrap());
        println!("Z = {z}, expected {expected}");
        assert!((z - expected).abs() < 4.0 * 0.007 * (expected - 1.0));
    }

    #[test]
    fn too_few_balls_are_refused() {
        let workload = Workload::named("spheres-0.49").unwrap();
        assert!(Gas::<3>::new(&workload, 3).is_err());
    }
}
