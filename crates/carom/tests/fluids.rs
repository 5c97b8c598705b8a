//! Hard discs and hard spheres against the equations of state, Maxwell and Haff. Seeds are fixed; every error is a statistical
//! one, derived where it stands.
//!
//! Units: diameter, mass and temperature 1. Z = p V/(N kT); Gamma = impacts per ball and time.
//! * Spheres: Kolafa's Z (Kolafa, Labik and Malijevsky 2004, in the short form of Carnahan-Starling-Kolafa),
//!   Z = 1 + sqrt(pi) Gamma/6.
//! * Discs: Henderson (1975), g = (1 - 7 phi/16)/(1 - phi)^2, Z = 1 + 2 phi g, Gamma = 8 phi g/sqrt(pi),
//!   Z = 1 + sqrt(pi) Gamma/4. At 0.30 the virial series to the tenth coefficient gives the same 2.063.
use carom::{Ball, Boundary, Limits, Material, Rotates, Vector, World};

/// A small generator (xorshift64*): fixed seeds.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        ((self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    /// A normal variate (Box and Muller 1958).
    fn normal(&mut self) -> f64 {
        (-2.0 * self.next().ln()).sqrt() * (std::f64::consts::TAU * self.next()).cos()
    }
}

/// n^D balls of diameter 1 and mass 1 on a square or cubic lattice in a periodic box at this fraction, their velocities Maxwell's
/// at total momentum 0 and temperature 1, with D (N - 1) degrees of freedom.
fn gas<const D: usize>(n: usize, fraction: f64, e: f64, seed: u64) -> World<D>
where
    Vector<D>: Rotates,
{
    let count = n.pow(D as u32);
    let ball = if D == 2 { std::f64::consts::PI / 4.0 } else { std::f64::consts::PI / 6.0 };
    let side = (count as f64 * ball / fraction).powf(1.0 / D as f64);
    assert!(side / n as f64 > 1.0, "the lattice has room");
    let mut dice = Dice(seed);
    let mut v: Vec<Vector<D>> = (0..count).map(|_| Vector::from_fn(|_| dice.normal())).collect();
    let mean = v.iter().fold(Vector::ZERO, |s, v| s + *v) / count as f64;
    v.iter_mut().for_each(|v| *v -= mean);
    let energy: f64 = v.iter().map(|v| v.norm_squared()).sum();
    let scale = ((D * (count - 1)) as f64 / energy).sqrt();
    let mut world = World::new().boundary(Boundary::periodic(Vector::ZERO, Vector::from_fn(|_| side)));
    world.set_default_material(Material::new().restitution(e)).unwrap();
    for (i, v) in v.iter().enumerate() {
        let x = Vector::from_fn(|k| ((i / n.pow(k as u32) % n) as f64 + 0.5) * side / n as f64);
        world.ball(Ball::new(1.0, 0.5).at(x).moving(*v * scale));
    }
    world
}

/// How much more the number of impacts scatters than if they were independent: the impacts of a ball that moves fast, or in a
/// crowd, come in groups that last about one impact each. For one ball of a dilute gas the variance is 1.1 to 1.2 of Poisson's
/// (Visco, van Wijland and Trizac 2008); waves of density that cross the box add to it in the plane. 2 in the variance.
const GROUPED: f64 = 2.0;

struct Measured {
    rate_z: f64,
    virial_z: f64,
    mean_square: f64,
    impacts: f64,
}

/// 60 impacts per ball to forget the lattice (sound crosses the box a few times), then `per_ball` to measure.
fn measure<const D: usize>(n: usize, fraction: f64, per_ball: u64, seed: u64) -> Measured
where
    Vector<D>: Rotates,
{
    let mut world = gas::<D>(n, fraction, 1.0, seed);
    let count = n.pow(D as u32) as f64;
    let first = 30 * count as u64;
    let last = first + per_ball * count as u64 / 2;
    world.run(&Limits { impacts: Some(first), ..Limits::default() });
    let (t0, n0) = (world.time(), world.impact_count());
    let (mut virial, mut squares) = (0.0, 0.0);
    while world.impact_count() < last {
        world.run(&Limits { impacts: Some(last.min(world.impact_count() + 10_000)), ..Limits::default() });
        for i in world.impacts() {
            virial += i.impulse; // times the distance of the centres, which is 1
            squares += i.approach * i.approach;
        }
    }
    let (time, impacts) = (world.time() - t0, (world.impact_count() - n0) as f64);
    let gamma = 2.0 * impacts / (count * time);
    let d = D as f64;
    assert!(world.ledger().unexplained() < 1e-12 && world.deepest_overlap() < 1e-9);
    Measured {
        rate_z: 1.0 + gamma * std::f64::consts::PI.sqrt() / (2.0 * d),
        virial_z: 1.0 + virial / (d * count * time),
        mean_square: squares / impacts,
        impacts,
    }
}

fn against_equation_of_state<const D: usize>(n: usize, cases: &[(f64, f64, f64)])
where
    Vector<D>: Rotates,
{
    println!("{D}D  fraction   Z        from the rate     from the virial   <u^2>     impacts");
    for &(fraction, z, seed) in cases {
        let m = measure::<D>(n, fraction, 400, seed as u64);
        let count = n.pow(D as u32) as f64;
        // The rate: K impacts scatter by sqrt(2 K); three of these. The virial: each impulse J = u has the mean sqrt(pi) and the
        // variance 4 - pi (p(u) ~ u exp(-u^2/4)): (4 - pi)/pi = 0.273 more a impact. u^2 is exponential: the variance is the
        // square of its mean. A finite periodic system at fixed energy and momentum differs by terms of order 1/N: 2/N.
        let finite = 2.0 / count;
        let rate = 3.0 * (GROUPED / m.impacts).sqrt() + finite;
        let virial = 3.0 * ((GROUPED + 0.273) / m.impacts).sqrt() + finite;
        let square = 3.0 * (GROUPED / m.impacts).sqrt() + finite;
        println!(
            "      {fraction:.2}  {z:8.5}  {:8.5} {:+.2} %  {:8.5} {:+.2} %  {:.4} {:+.2} %  {}   (3 sigma: {:.2} %)",
            m.rate_z,
            100.0 * ((m.rate_z - 1.0) / (z - 1.0) - 1.0),
            m.virial_z,
            100.0 * ((m.virial_z - 1.0) / (z - 1.0) - 1.0),
            m.mean_square,
            100.0 * (m.mean_square / 4.0 - 1.0),
            m.impacts,
            100.0 * rate,
        );
        assert!(((m.rate_z - 1.0) / (z - 1.0) - 1.0).abs() < rate, "the rate of impacts");
        assert!(((m.virial_z - 1.0) / (z - 1.0) - 1.0).abs() < virial, "the pressure");
        assert!((m.mean_square / 4.0 - 1.0).abs() < square, "Maxwell's <u^2> = 4 kT/m");
    }
}

#[test]
fn hard_discs_follow_their_equation_of_state() {
    against_equation_of_state::<2>(32, &[(0.10, 1.2361, 1.0), (0.30, 2.0631, 2.0)]);
}

#[test]
fn hard_spheres_follow_their_equation_of_state() {
    // Z = 1 + sqrt(pi) Gamma/6 with Gamma = 1.76578 and 10.10212.
    let z = |gamma: f64| 1.0 + std::f64::consts::PI.sqrt() * gamma / 6.0;
    assert!((z(1.76578) - 1.52163).abs() < 1e-5 && (z(10.10212) - 3.98426).abs() < 1e-5);
    against_equation_of_state::<3>(10, &[(0.10, z(1.76578), 3.0), (0.30, z(10.10212), 4.0)]);
}

/// Haff (1983), in the form that knows no time: an impact takes (1 - e^2) u^2/4 with <u^2> = 4 T, so that after s impacts per ball
/// T = exp(-(1 - e^2) s/d), as long as the gas stays uniform (s below about 10 at this density).
fn cools<const D: usize>(n: usize, fraction: f64, seed: u64)
where
    Vector<D>: Rotates,
{
    let e: f64 = 0.95;
    let mut world = gas::<D>(n, fraction, e, seed);
    let count = n.pow(D as u32) as f64;
    world.keep_reports(false);
    let start = world.ledger().energy.kinetic;
    let d = D as f64;
    println!("{D}D   s    T/T0      Haff");
    for s in [1.0, 2.0, 4.0, 6.0, 8.0, 10.0] {
        world.run(&Limits { impacts: Some((s * count / 2.0) as u64), ..Limits::default() });
        let s = 2.0 * world.impact_count() as f64 / count;
        let got = world.ledger().energy.kinetic / start;
        let want = (-(1.0 - e * e) * s / d).exp();
        // What K impacts take in ln T scatters like a sum of K exponential variates of mean (1 - e^2) 2/(d N): by
        // (1 - e^2) (s/d) sqrt(1/K). Three of these, and 0.5 % for the velocities' distance from Maxwell's at e = 0.95 (the second
        // Sonine coefficient is about -0.02) and for the start on a lattice.
        let sigma = (1.0 - e * e) * s / d / world.impact_count() as f64;
        let tolerance = 0.005 + 3.0 * sigma * (world.impact_count() as f64).sqrt();
        println!("   {s:5.2}  {got:.5}  {want:.5}  {:+.2} % of {:.2} %", 100.0 * (got / want - 1.0), 100.0 * tolerance);
        assert!((got / want - 1.0).abs() < tolerance);
    }
    let ledger = world.ledger();
    assert!(ledger.unexplained() < 1e-12 && (ledger.energy.lost / start + got(&world, start) - 1.0).abs() < 1e-12);
}

fn got<const D: usize>(world: &World<D>, start: f64) -> f64
where
    Vector<D>: Rotates,
{
    world.ledger().energy.kinetic / start
}

#[test]
fn a_granular_gas_cools_as_haff_says() {
    cools::<2>(64, 0.05, 5);
    cools::<3>(16, 0.05, 6);
}
