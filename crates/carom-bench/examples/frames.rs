//! Small worlds: what a game's frame costs (a sixtieth of a second of a table with 16, 200 and 2,000 balls), and 10,000 break shots.
use carom::{Ball, Boundary, Limits, Material, World};
use carom_bench::cpu_seconds;

/// Balls on a square lattice between four cushions, at about walking pace: e = 0.95.
fn table(n: usize) -> World<2> {
    let side = (n as f64).sqrt().ceil();
    let mut world = World::<2>::new().boundary(Boundary::walls([0.0, 0.0], [side * 0.1, side * 0.1]));
    world.set_default_material(Material::new().restitution(0.95)).expect("a material");
    for i in 0..n {
        let (column, row) = ((i % side as usize) as f64, (i / side as usize) as f64);
        // Directions by the golden angle: all different, and the same everywhere.
        let angle = 2.399_963_229_728_653 * i as f64;
        let (y, x) = (libm::sin(angle), libm::cos(angle));
        world.ball(Ball::new(0.17, 0.028).at([(column + 0.5) * 0.1, (row + 0.5) * 0.1]).moving([x, y]));
    }
    world.advance(0.0);
    world
}

/// Fifteen balls that touch, struck by a sixteenth from a place of its own: a second of it.
fn shot(k: u32) -> u64 {
    let mut world = World::<2>::new().boundary(Boundary::walls([0.0, 0.0], [2.54, 1.27]));
    world.set_default_material(Material::new().restitution(0.95)).expect("a material");
    let (r, step) = (0.028575, 0.028575 * 3.0f64.sqrt());
    for row in 0..5 {
        for place in 0..=row {
            let y = 0.635 + (2.0 * f64::from(place) - f64::from(row)) * r;
            world.ball(Ball::new(0.17, r).at([1.9 + f64::from(row) * step, y]));
        }
    }
    let aside = (f64::from(k) / 10_000.0 - 0.5) * r;
    world.ball(Ball::new(0.17, r).at([0.6, 0.635 + aside]).moving([8.0, 0.0]));
    world.run(&Limits { time: Some(1.0), ..Limits::default() });
    world.impact_count()
}

fn main() {
    for n in [16, 200, 2_000] {
        let mut world = table(n);
        let frames = 20_000 / n as u32 + 60;
        let (mut best, mut impacts) = (f64::INFINITY, 0);
        for _ in 0..5 {
            let (start, before) = (cpu_seconds(), world.impact_count());
            for _ in 0..frames {
                world.advance(1.0 / 60.0);
            }
            let taken = (cpu_seconds() - start) / f64::from(frames);
            if taken < best {
                (best, impacts) = (taken, world.impact_count() - before);
            }
        }
        let each = f64::from(frames) * best / impacts.max(1) as f64;
        println!("{n:6} balls: {:8.2} us a frame, {:6.0} ns an impact", best * 1e6, each * 1e9);
    }
    let start = cpu_seconds();
    let impacts: u64 = (0..10_000).map(shot).sum();
    let taken = cpu_seconds() - start;
    println!(
        "10,000 break shots: {taken:.2} s, {:.1} us a shot, {:.0} ns an impact",
        taken * 100.0,
        taken * 1e9 / impacts as f64
    );
}
