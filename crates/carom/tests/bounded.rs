//! Nothing hangs, nothing becomes NaN, the books close: random worlds of everything at once.
use carom::{Ball, Boundary, Coefficient, Limits, Material, Rotates, Shape, Stop, Together, Vector, Wall, World};

/// A small generator (PCG-XSH-RR 64/32, O'Neill 2014), so that a case is its seed.
struct Pcg(u64);
impl Pcg {
    fn next(&mut self) -> u32 {
        let old = self.0;
        self.0 = old.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((((old >> 18) ^ old) >> 27) as u32).rotate_right((old >> 59) as u32)
    }
    fn unit(&mut self) -> f64 {
        f64::from(self.next()) / 4294967296.0
    }
    fn below(&mut self, n: u32) -> u32 {
        self.next() % n
    }
    fn pick(&mut self, list: &[f64]) -> f64 {
        list[self.below(list.len() as u32) as usize]
    }
}

/// Friction of all kinds for the surfaces of the world, from a generator of its own: a rough world is a smooth one with more.
fn roughness(seed: u64) -> (Material, Pcg) {
    let mut rng = Pcg(seed.wrapping_mul(0xd134_2543_de82_ef95) | 1);
    (0..4).for_each(|_| {
        rng.next();
    });
    let mu = rng.pick(&[0.05, 0.2, 0.5, 1.0, 5.0]);
    let mut said = Material::new().tangential(rng.pick(&[0.0, 0.0, 1.0, 0.5, -0.5]));
    said = match rng.below(4) {
        0 => said.friction(Coefficient::Curve(vec![(0.0, 1.5 * mu), (1.0, mu), (3.0, 0.5 * mu)])),
        _ => said.friction(mu),
    };
    let rolling = rng.pick(&[0.0, 0.0, 0.01, 0.1]);
    let spinning = rng.pick(&[0.0, 0.0, 0.05]);
    (Material { rolling: Some(rolling), spinning: Some(spinning), ..said }, rng)
}

fn random_world<const D: usize>(seed: u64, rough: bool) -> World<D>
where
    Vector<D>: Rotates,
{
    let mut rng = Pcg(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    (0..4).for_each(|_| {
        rng.next();
    });
    let size = 1.0;
    let mut gravity = Vector::<D>::ZERO;
    if rng.below(4) > 0 {
        gravity[D - 1] = -rng.pick(&[9.81, 9.81, 1.0, 100.0]);
        if D > 1 && rng.below(3) == 0 {
            gravity[0] = 3.0 * (rng.unit() - 0.5);
        }
    }
    let together = Together::ALL[rng.below(3) as usize];
    let rest = rng.pick(&[0.01, 0.01, 0.01, 0.0, 0.1]);
    let mut world = World::<D>::new().gravity(gravity).rest_speed(rest).together(together);
    let (said, mut turning) = roughness(seed);
    if rough {
        world.set_default_material(said).unwrap();
    }
    let es = [1.0, 0.0, 0.5, 0.9, 0.1, 0.99];
    let same = rng.below(2) == 0;
    let e0 = rng.pick(&es);
    let e = |rng: &mut Pcg| if same { e0 } else { rng.pick(&es) };
    if D == 2 {
        for _ in 0..rng.below(4) {
            let p = Vector::<D>::from_fn(|_| rng.unit() * size);
            let wall = if rng.below(2) == 0 {
                Wall::segment(p, Vector::from_fn(|_| rng.unit() * size))
            } else {
                let from = rng.unit() * 6.0;
                Wall::arc(p, 0.1 + 0.3 * rng.unit(), from, from + 0.5 + 5.5 * rng.unit())
            };
            let _ = world.add_wall(wall.restitution(e(&mut rng)));
        }
    }
    if D == 3 {
        for _ in 0..rng.below(3) {
            let mut p = || Vector::<D>::from_fn(|_| rng.unit() * size);
            let (a, b, c) = (p(), p(), p());
            let _ = world.add_wall(Wall::triangle(a, b, c).restitution(e(&mut rng)));
        }
    }
    world.set_boundary(Boundary::walls([0.0; D], [size; D])).unwrap();
    let n = 2 + rng.below(if D == 1 { 6 } else { 14 });
    let mut placed: Vec<(Vector<D>, f64)> = Vec::new();
    let masses = rng.pick(&[0.0, 1.0, 3.0, 4.5]);
    for _ in 0..n {
        for _ in 0..50 {
            let r = 0.02 + 0.05 * rng.unit();
            let mut x = Vector::<D>::from_fn(|_| r + (size - 2.0 * r) * rng.unit());
            if let Some((other, ro)) = placed.last()
                && rng.below(2) == 0
            {
                // Touching the last one, along an axis or a 3-4-5 direction.
                let mut d = Vector::<D>::ZERO;
                d[D - 1] = 1.0;
                if D > 1 && rng.below(2) == 0 {
                    (d[0], d[D - 1]) = (0.6, 0.8);
                }
                x = *other + d * (r + ro);
            }
            let free = placed.iter().all(|(y, s)| (x - *y).norm() >= (r + s) * (1.0 - 1e-12))
                && x.0.iter().all(|&c| c >= r && c <= size - r)
                && world.walls().all(|w| clear(&world, w, x, r));
            if !free {
                continue;
            }
            let v = Vector::<D>::from_fn(|_| if rng.below(3) == 0 { 0.0 } else { 4.0 * (rng.unit() - 0.5) });
            let mass = 10f64.powf(masses * 2.0 * (rng.unit() - 0.5));
            let mut ball = Ball::new(mass, r).at(x).moving(v).restitution(e(&mut rng));
            if rng.below(8) == 0 {
                ball = Ball { fixed: true, velocity: Vector::ZERO, ..ball };
            }
            if rough && !ball.fixed {
                let spin: Vec<f64> = (0..3).map(|_| 60.0 * (turning.unit() - 0.5)).collect();
                ball.spin = Vector::<D>::spin_from(&spin[..<Vector<D> as Rotates>::SPINS]).unwrap();
            }
            world.ball(ball);
            placed.push((x, r));
            break;
        }
    }
    world
}

fn clear<const D: usize>(world: &World<D>, wall: carom::WallId, x: Vector<D>, r: f64) -> bool
where
    Vector<D>: Rotates,
{
    let shape: Shape<D> = world.shape(wall).unwrap();
    shape.over(x, r).gap >= 0.0
}

fn check<const D: usize>(seed: u64, until: f64, rough: bool) -> (u64, u64)
where
    Vector<D>: Rotates,
{
    let mut world = random_world::<D>(seed, rough);
    world.keep_reports(false);
    let (mut energy, mut steps) = (f64::INFINITY, 0u64);
    world.advance_to(0.0);
    let start = world.ledger().energy.start;
    // A slice with friction never ends with more energy than it started with, but half-way it may have had less, for as long as a
    // millisecond: by what friction takes in one.
    let slack = if rough { 1e-2 } else { 1e-9 };
    for k in 1..=20 {
        let end = until * f64::from(k) / 20.0;
        let mut rounds = 0;
        loop {
            // Chunks of impacts, so that a pile-up shows as many rounds rather than as silence.
            let limits = Limits { time: Some(end), impacts: Some(world.impact_count() + 20_000), ..Limits::default() };
            let stop = world.run(&limits);
            rounds += 1;
            assert!(rounds < 100, "D = {D}, seed {seed}: two million impacts between {} and {end}", world.time());
            if stop != Stop::Impacts {
                assert!(matches!(stop, Stop::Time | Stop::Quiet | Stop::Rest), "D = {D}, seed {seed}: {stop:?}");
                break;
            }
        }
        let ledger = world.ledger();
        assert!(ledger.unexplained() < 1e-9, "D = {D}, seed {seed}, t = {}: {ledger:?}", world.time());
        let now = ledger.energy.end;
        let scale = ledger.energy.kinetic + ledger.energy.potential.abs() + ledger.energy.lost.abs();
        assert!(
            now <= energy + slack * scale && now <= start + 1e-9 * scale,
            "D = {D}, seed {seed}, t = {}: energy rises, {energy} {now}",
            world.time()
        );
        energy = now;
        steps = world.event_count() + world.slice_count();
    }
    let deepest = world.deepest_overlap();
    let overlap = world.ledger().overlap;
    assert!(overlap < 1e-6, "D = {D}, seed {seed}: overlap {overlap:e}, at the end {deepest:e}");
    (world.impact_count(), steps)
}

fn many<const D: usize>(default: u64, until: f64, rough: bool)
where
    Vector<D>: Rotates,
{
    // By hand: BOUNDED=1000 cargo test --release -p carom --test bounded; BOUNDED_SHOW=1 names each seed.
    let count = std::env::var("BOUNDED").ok().and_then(|n| n.parse().ok()).unwrap_or(default);
    let first = std::env::var("BOUNDED_FROM").ok().and_then(|n| n.parse().ok()).unwrap_or(0);
    let mut most = (0, 0, 0);
    for seed in first..first + count {
        if std::env::var("BOUNDED_SHOW").is_ok() {
            eprintln!("D = {D} seed {seed}");
        }
        let (impacts, steps) = check::<D>(seed, until, rough);
        if steps > most.1 {
            most = (impacts, steps, seed);
        }
    }
    println!("D = {D}: {count} worlds, at most {} impacts and {} events and slices (seed {})", most.0, most.1, most.2);
}

#[test]
fn on_the_line() {
    many::<1>(300, 3.0, false);
}

#[test]
fn in_the_plane() {
    many::<2>(150, 3.0, false);
}

#[test]
fn in_the_plane_with_friction() {
    many::<2>(100, 3.0, true);
}

#[test]
fn in_space_with_friction() {
    many::<3>(60, 3.0, true);
}

#[test]
fn in_space() {
    many::<3>(100, 3.0, false);
}

/// Seen at rest_speed = 0: a ball that bounces on another, which bounces on the floor, came to overlap it by 1e-7 of a radius. Its hops
/// did not lift it out again, so that it met the other 17,000 times a millisecond, for ever, and sank by 5e-7 of a radius in each.
/// A hop that does not leave the overlap is the end of the bounces.
#[test]
fn a_ball_does_not_sink_into_the_one_it_hops_on() {
    let (_, steps) = check::<1>(572, 3.0, false);
    assert!(steps < 10_000, "{steps}");
}

/// Seen: two balls of 0.1 g and 4 g between two of two tonnes, sliding down a slope as an island. The projection left contacts that
/// closed, and the overlap grew to 3e-3 of a radius. What closes is projected again, and overlaps open as far as energy allows.
#[test]
fn light_balls_between_heavy_ones_are_not_overlapped() {
    check::<2>(488, 3.0, false);
}

/// Seen at rest_speed = 0: an elastic ball that lies on a fixed one, let fall through one rounding of its position, hopped on at
/// 6e-8 m/s, 9,000 times a millisecond. Its flights are not to be told from rest.
#[test]
fn a_ball_that_hops_by_a_rounding_lies_still() {
    let (_, steps) = check::<3>(763, 3.0, false);
    assert!(steps < 100_000, "{steps}");
}

/// Seen at rest_speed = 0: a ball in a corner, on which another one slides, hopped against both walls and the other in turn, each time too
/// low for its position to tell, eight thousand times in 25 microseconds.
#[test]
fn a_ball_that_hops_among_three_lies_still() {
    let (_, steps) = check::<2>(845, 3.0, false);
    assert!(steps < 100_000, "{steps}");
}

/// Seen with friction: an island took in a body out of another island where that had been before its slice, 1e-4 m away, and turned their
/// contact by as much: the torque of 1e6 N was booked nowhere.
#[test]
fn islands_that_merge_know_where_their_bodies_are() {
    check::<2>(128, 3.0, true);
}

/// Seen with friction and rest_speed = 0: a ball that rolled along the edge of floor and wall, lifted off the one by the friction of the
/// other by less than its position can tell, met them in turn every 1e-8 s.
#[test]
fn a_ball_that_rolls_along_an_edge_touches_both() {
    let (_, steps) = check::<3>(97, 3.0, true);
    assert!(steps < 100_000, "{steps}");
}
