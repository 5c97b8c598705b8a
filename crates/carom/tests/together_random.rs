//! Several contacts at one instant: what must hold whatever the model, for thousands of random systems.
//!
//! Where the tolerances come from: an exchange is solved to about 1e-14 of the scale of the velocities, and the reflections
//! and projections it is made of are non-expansive in the metric of kinetic energy, so that errors add up over the
//! iterations and do not grow. The scale itself can be sqrt(mass ratio) times the velocities that energy allows a heavy body.
use carom::{
    Vector,
    law::together::{Outcome, Solver, System, TOLERANCE, Together, VIOLATION},
};
use proptest::prelude::*;

/// splitmix64: enough for drawing systems.
#[derive(Clone)]
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
    fn shuffled(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        for k in (1..n).rev() {
            order.swap(k, self.below(k + 1));
        }
        order
    }
}

/// A drawn system, before it is written down in some order.
#[derive(Clone, Debug)]
struct Scene<const D: usize> {
    bodies: Vec<(f64, Vector<D>)>,
    /// (first, second or none for a wall at rest, normal, e)
    contacts: Vec<(usize, Option<usize>, Vector<D>, f64)>,
}

impl<const D: usize> Scene<D> {
    /// Balls of masses within 10^+-`decades` and contacts with normals from anywhere. Normals are mostly those of a geometry
    /// (positions of touching balls need not exist for the operators), some are doubled or opposite, some coefficients 0 or 1.
    fn draw(draw: &mut Draw, decades: f64, walls: bool) -> Self {
        let n = 2 + draw.below(7);
        let normal = |draw: &mut Draw| loop {
            let v = Vector::<D>::from_fn(|_| draw.between(-1.0, 1.0));
            if v.norm() > 0.1
                && let Some(unit) = v.unit()
            {
                return unit;
            }
        };
        let at: Vec<Vector<D>> = (0..n).map(|_| Vector::from_fn(|_| draw.between(-1.0, 1.0))).collect();
        let bodies = (0..n)
            .map(|k| {
                let still = k > 0 && draw.below(3) == 0;
                let v = Vector::from_fn(|_| if still { 0.0 } else { draw.between(-1.0, 1.0) });
                (10f64.powf(draw.between(-decades, decades)), v)
            })
            .collect();
        let style = draw.below(4);
        let mut contacts: Vec<(usize, Option<usize>, Vector<D>, f64)> = Vec::new();
        for _ in 0..1 + draw.below(2 * n) {
            let e = match style {
                0 => 1.0,
                1 => 0.7,
                _ => [0.0, 1.0, draw.unit()][draw.below(3)],
            };
            let a = draw.below(n);
            if walls && draw.below(4) == 0 {
                let n = normal(draw);
                contacts.push((a, None, n, e));
                if draw.below(6) == 0 {
                    contacts.push((a, None, -n, e)); // pinned
                }
                continue;
            }
            let b = (a + 1 + draw.below(n - 1)) % n;
            let Some(along) = (at[b] - at[a]).unit() else { continue };
            contacts.push((a, Some(b), along, e));
            if draw.below(8) == 0 {
                contacts.push((b, Some(a), -along, e)); // the same contact again, the other way round
            }
        }
        Self { bodies, contacts }
    }

    /// Written down with bodies and contacts in these orders. Returns the system and e by contact.
    fn system(&self, bodies: &[usize], contacts: &[usize]) -> (System, Vec<f64>) {
        let mut system = System::new();
        let mut name = vec![0; bodies.len()];
        for &b in bodies {
            name[b] = system.ball(1.0 / self.bodies[b].0, self.bodies[b].1);
        }
        let mut e = Vec::new();
        for &c in contacts {
            let (a, b, n, restitution) = self.contacts[c];
            match b {
                Some(b) => system.pair(name[a], name[b], n),
                None => system.wall(name[a], n, Vector::ZERO),
            };
            e.push(restitution);
        }
        (system, e)
    }

    fn plain(&self) -> (System, Vec<f64>) {
        let (bodies, contacts): (Vec<_>, Vec<_>) =
            ((0..self.bodies.len()).collect(), (0..self.contacts.len()).collect());
        self.system(&bodies, &contacts)
    }
}

/// Mass ratios up to 100: everything holds. Up to 1e9: where bodies are that unequal, impulses are large against what they
/// do to the light ones, and the order of the contacts may show in the ninth digit. Up to 1e18: the matrix of the contacts
/// does not resolve that any more (1e13 is its limit); what does not need it still holds.
const DECADES: [f64; 3] = [1.0, 4.5, 9.0];

fn check<const D: usize>(seed: u64, decades: f64, how: Together) -> Result<(), TestCaseError> {
    let mut draw = Draw(seed);
    let walls = draw.below(2) == 0;
    let scene = Scene::<D>::draw(&mut draw, decades, walls);
    let (start, e) = scene.plain();
    let mut end = start.clone();
    let mut solver = Solver::new();
    let outcome: Outcome = solver
        .resolve(how, &mut end, |i, approach| {
            assert!(approach >= 0.0);
            e[i]
        })
        .clone();
    // As fast as energy allows the lightest two to close.
    let lightest = scene.bodies.iter().map(|b| b.0).fold(f64::INFINITY, f64::min);
    let fastest = 2.0 * (2.0 * start.kinetic_energy() / lightest).sqrt();
    let told = || format!("{how:?} {scene:?}\n{outcome:?}\n{:?} -> {:?}", start.velocities(), end.velocities());

    prop_assert!(end.velocities().iter().all(|v| v.is_finite()), "finite: {}", told());
    prop_assert!(outcome.lambda.iter().all(|l| *l >= 0.0), "one-sided: {}", told());
    let steps = f64::from(1 + outcome.iterations);
    // Energy, and its book.
    let (before, after) = (start.kinetic_energy(), end.kinetic_energy());
    prop_assert!(after <= before * (1.0 + 1e-12), "energy {before} -> {after}: {}", told());
    prop_assert!((after + outcome.lost - before).abs() <= 1e-13 * steps * before, "book: {}", told());
    let (sum, sizes) = outcome.losses.iter().fold((0.0, 0.0), |(sum, sizes), l: &f64| (sum + l, sizes + l.abs()));
    let fine = if decades > 5.0 { f64::MAX } else { 1e-12 * steps };
    prop_assert!((sum - outcome.lost).abs() <= fine * (before + sizes), "losses: {}", told());
    if e.iter().all(|e| *e == 1.0) && !outcome.capped && outcome.locked == 0 && decades < 5.0 {
        prop_assert!(outcome.lost.abs() <= 1e-13 * steps * before, "elastic: {}", told());
    }
    // Momentum, component by component.
    if scene.contacts.iter().all(|c| c.1.is_some()) {
        for k in 0..D {
            let total = |s: &System| -> f64 {
                s.velocities().iter().zip(s.inverse_masses()).skip(k).step_by(D).map(|(v, w)| v / w).sum()
            };
            let size: f64 = start
                .velocities()
                .iter()
                .chain(end.velocities())
                .zip(start.inverse_masses().iter().chain(end.inverse_masses()))
                .map(|(v, w)| (v / w).abs())
                .sum();
            prop_assert!((total(&end) - total(&start)).abs() <= 1e-13 * steps * size, "momentum: {}", told());
        }
    }
    if decades > 5.0 {
        return Ok(());
    }
    prop_assert!(!outcome.crushed, "nothing is driven: {}", told());
    // Nothing closes. A cap ends with a projection, good to its own tolerance.
    let changes = (0..end.contacts()).map(|i| end.yielding(i) * outcome.lambda[i]).fold(fastest, f64::max);
    let slack = if outcome.capped { TOLERANCE * changes } else { VIOLATION * fastest };
    for i in 0..end.contacts() {
        prop_assert!(end.opening(i) >= -slack, "contact {i} closes at {}: {}", -end.opening(i), told());
    }

    // In another order, and told the other way round.
    if how != Together::Sequential && decades < 2.0 {
        let bodies = draw.shuffled(scene.bodies.len());
        let contacts = draw.shuffled(scene.contacts.len());
        let (mut other, e) = scene.system(&bodies, &contacts);
        let there = solver.resolve(how, &mut other, |i, _| e[i]);
        if !outcome.capped && !there.capped {
            let mut distance = 0.0;
            for (at, &b) in bodies.iter().enumerate() {
                let d = other.velocity::<D>(at * D) - end.velocity::<D>(b * D);
                distance += 0.5 * scene.bodies[b].0 * d.norm_squared();
            }
            // Nearly opposite walls make impulses l = sum sqrt(Q_ii) lambda_i that are large against what they do, |P| <=
            // sqrt(2 E): an error of eps l in u is one of eps l/s in v, with a singular value s of about |P|/l.
            let l: f64 = (0..end.contacts()).map(|i| end.yielding(i).sqrt() * outcome.lambda[i]).sum();
            let allowed = 1e-12 * steps * before.sqrt() + 1e3 * f64::EPSILON * l * l / (2.0 * before).sqrt();
            prop_assert!(distance.sqrt() <= allowed, "order, {:e}: {}", distance.sqrt(), told());
        }
    }
    Ok(())
}

fn project<const D: usize>(seed: u64) -> Result<(), TestCaseError> {
    let mut draw = Draw(seed);
    let scene = Scene::<D>::draw(&mut draw, 2.0, true);
    let (start, _) = scene.plain();
    let m = start.contacts();
    // 0 is feasible: bounds as gaps give them.
    let bounds: Vec<f64> = (0..m).map(|_| if draw.below(2) == 0 { 0.0 } else { -draw.unit() }).collect();
    let mut cold = start.clone();
    let mut solver = Solver::new();
    let found = solver.project(&mut cold, &bounds, &[]).clone();
    prop_assert!(found.converged && !found.infeasible, "{scene:?} {bounds:?} {found:?}");
    let changes = (0..m).map(|i| start.yielding(i) * found.lambda[i]);
    let tolerance = TOLERANCE * changes.fold(start.scale(), f64::max);
    for i in 0..m {
        let (u, l) = (cold.opening(i), found.lambda[i]);
        prop_assert!(l >= 0.0 && u - bounds[i] >= -tolerance && (l == 0.0 || u - bounds[i] <= tolerance));
    }
    // The variational inequality against other feasible velocities: (w - v').M (v' - v) >= 0 for w = 0 and w = v'/2.
    let inner = |w: &dyn Fn(usize) -> f64| -> f64 {
        (0..cold.velocities().len())
            .map(|k| {
                (w(k) - cold.velocities()[k]) * (cold.velocities()[k] - start.velocities()[k])
                    / start.inverse_masses()[k]
            })
            .sum()
    };
    let energy = start.kinetic_energy();
    for part in [0.0, 0.5] {
        prop_assert!(inner(&|k| part * cold.velocities()[k]) >= -1e-11 * energy);
    }
    // From the impulses it found, and from nonsense, it finds the same velocities. Between two answers with opening errors r
    // and r', |v1 - v2|_M^2 = (l1 - l2).(u1 - u2) <= sum l1 r2 + l2 r1: walls that are nearly parallel hold a body loosely.
    let first = found.clone();
    for warm in [found.lambda.clone(), (0..m).map(|_| draw.between(-1.0, 3.0)).collect()] {
        let mut again = start.clone();
        let found = solver.project(&mut again, &bounds, &warm);
        prop_assert!(found.converged, "{found:?}");
        let distance: f64 = (0..again.velocities().len())
            .map(|k| (again.velocities()[k] - cold.velocities()[k]).powi(2) / start.inverse_masses()[k])
            .sum();
        let impulses: f64 = found.lambda.iter().chain(&first.lambda).sum();
        let error = found.residual + first.residual + 4.0 * f64::EPSILON;
        let bound = (impulses * error * tolerance / TOLERANCE).max(1e-28 * energy);
        prop_assert!(distance <= bound, "{distance:e} {bound:e} {scene:?} {found:?}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn reflect_keeps_the_rules(seed: u64) {
        for decades in DECADES {
            check::<1>(seed, decades, Together::Reflect)?;
            check::<2>(seed, decades, Together::Reflect)?;
            check::<3>(seed, decades, Together::Reflect)?;
        }
    }

    #[test]
    fn lcp_keeps_the_rules(seed: u64) {
        for decades in DECADES {
            check::<1>(seed, decades, Together::Lcp)?;
            check::<2>(seed, decades, Together::Lcp)?;
            check::<3>(seed, decades, Together::Lcp)?;
        }
    }

    #[test]
    fn sequential_keeps_the_rules(seed: u64) {
        for decades in DECADES {
            check::<1>(seed, decades, Together::Sequential)?;
            check::<2>(seed, decades, Together::Sequential)?;
            check::<3>(seed, decades, Together::Sequential)?;
        }
    }

    #[test]
    fn projections_are_optimal(seed: u64) {
        project::<1>(seed)?;
        project::<2>(seed)?;
        project::<3>(seed)?;
    }
}
