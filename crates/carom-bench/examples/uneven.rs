//! What unevenness costs: `uneven [BALLS]` measures an impact where all balls are a dense fluid that fills its box; where one more ball is
//! far away; where a fifth of them is a thin gas above the fluid, and around it in whose corner the fluid lies (before it has had the time
//! to spread); and in a thin gas. ns of CPU time an impact, the best of five slices, and how many times what the fluid alone takes.
use carom::{Ball, Boundary, Limits, Vector, World};
use carom_bench::seconds;

/// Fractions of the space in the fluid and in the gas.
const FLUID: f64 = 0.45;
const GAS: f64 = 0.001;

fn main() {
    let balls = std::env::args().nth(1).map_or(10_000, |n| n.parse().expect("a number of balls"));
    println!("{:<28} {:>8} {:>9} {:>7}", "world", "balls", "ns/impact", "ratio");
    let mut alone = None;
    for (name, make) in WORLDS {
        let mut world = make(balls);
        let count = world.bodies().count();
        world.keep_reports(false);
        let mut run = |impacts: u64| {
            let (start, before) = (seconds(1), world.impact_count());
            world.run(&Limits { impacts: Some(before + impacts), ..Limits::default() });
            (seconds(1) - start) * 1e9 / (world.impact_count() - before) as f64
        };
        run(5 * count as u64);
        let ns = (0..5).map(|_| run(2 * count as u64)).fold(f64::INFINITY, f64::min);
        let of = *alone.get_or_insert(ns);
        println!("{name:<28} {count:>8} {ns:>9.0} {:>7.2}", ns / of);
    }
}

type Make = fn(usize) -> World<3>;
const WORLDS: [(&str, Make); 5] = [
    ("a fluid", |n| fluid(n, [0.0; 3])),
    ("and a ball far away", |n| {
        let mut world = fluid(n, [0.0; 3]);
        world.ball(Ball::new(1.0, 0.5).at([1e5 * side(n), 0.0, 0.0]));
        world
    }),
    ("under a thin gas", |n| {
        let (low, side) = (4 * n / 5, side(4 * n / 5));
        let high = (n / 5) as f64 * VOLUME / GAS / (side * side);
        let mut world = fluid(low, [side, side, side + high]);
        fill(&mut world, n / 5, [side, side, high], |at| Some(at + Vector([0.0, 0.0, side])));
        world
    }),
    ("in the corner of a thin gas", |n| {
        let (low, side) = (4 * n / 5, side(4 * n / 5));
        let wide = ((n / 5) as f64 * VOLUME / GAS + side.powi(3)).cbrt();
        let mut world = fluid(low, [wide; 3]);
        let around = (wide.powi(3) * GAS / VOLUME) as usize;
        fill(&mut world, around, [wide; 3], |at| (0..3).any(|k| at[k] > side + 0.5).then_some(at));
        world
    }),
    ("a thin gas", |n| {
        let wide = (n as f64 * VOLUME / GAS).cbrt();
        let mut world = World::new().boundary(Boundary::walls([0.0; 3], [wide; 3]));
        fill(&mut world, n, [wide; 3], Some);
        world
    }),
];

/// The volume of a ball (m^3).
const VOLUME: f64 = std::f64::consts::PI / 6.0;

/// The side (m) of the box that `n` balls fill as a fluid.
fn side(n: usize) -> f64 {
    (n as f64 * VOLUME / FLUID).cbrt() + 1.0
}

/// `n` balls as a fluid in the corner of a box of walls; of their own where it has no size.
fn fluid(n: usize, size: [f64; 3]) -> World<3> {
    let own = [side(n); 3];
    let mut world = World::new().boundary(Boundary::walls([0.0; 3], if size[0] > 0.0 { size } else { own }));
    fill(&mut world, n, own, Some);
    world
}

/// Balls on a lattice of `n` places in a box, where `keep` puts each, if it does.
fn fill(world: &mut World<3>, n: usize, size: [f64; 3], keep: impl Fn(Vector<3>) -> Option<Vector<3>>) {
    for at in lattice(size, n).into_iter().filter_map(keep) {
        let k = world.bodies().count();
        world.ball(Ball::new(1.0, 0.5).at(at).moving(thrown(k)));
    }
}

/// Places on a lattice in a box, a radius and a little from its walls.
fn lattice(sides: [f64; 3], n: usize) -> Vec<Vector<3>> {
    let room = sides.map(|side| side - 1.02);
    let volume: f64 = room.iter().product();
    let mut pitch = (volume / n as f64).cbrt();
    loop {
        let count = room.map(|room| (room / pitch) as usize + 1);
        if count.iter().product::<usize>() >= n {
            let at = |k: usize, i: usize| 0.51 + room[k] * i as f64 / (count[k].max(2) - 1) as f64;
            let all = (0..n).map(|i| {
                let (x, y, z) = (i % count[0], i / count[0] % count[1], i / (count[0] * count[1]));
                Vector([at(0, x), at(1, y), at(2, z)])
            });
            return all.collect();
        }
        pitch *= 0.999;
    }
}

/// The velocity of ball `k`: by a small generator, of a speed near 1.
fn thrown(k: usize) -> Vector<3> {
    let mut state = (k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    Vector::from_fn(|_| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64 * 2.0 - 1.0
    })
}
