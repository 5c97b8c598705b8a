//! The angle of repose: discs are poured on a rough floor, one after the other, and the slope at which they stand is measured.
//!
//! ```text
//! cargo run --release -p carom --example repose -- COUNT FRICTION ROLLING [--places]
//! cargo run --release -p carom --example repose -- 100 0.5 0.1
//! ```
//!
//! A triangle of height H and half its width W has its centre at H/3, and W/3 from its middle on average: the slope is the one mean
//! over the other, without a line to be fitted.
use std::time::Instant;

use carom::{Ball, BodyId, Limits, Material, Stop, Vector, Wall, World};

const RADIUS: f64 = 0.01;

/// The time (s) between two discs, and how long the heap may take to come to rest at the end.
const PAUSE: f64 = 0.12;
const LAST: f64 = 20.0;

fn main() {
    let places = std::env::args().any(|a| a == "--places");
    let numbers: Vec<f64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let [count, friction, rolling] = numbers[..] else {
        eprintln!("usage: repose COUNT FRICTION ROLLING [--places]");
        std::process::exit(2);
    };
    let clock = Instant::now();
    let mut world = World::<2>::new().gravity([0.0, -9.81]);
    let material = Material::new().restitution(0.1).friction(friction).rolling(rolling);
    world.set_default_material(material).expect("coefficients in range");
    world.wall(Wall::plane([0.0, 0.0], [0.0, 1.0]));
    world.keep_reports(false);
    let mut discs: Vec<BodyId> = Vec::new();
    let place = |world: &World<2>, id: BodyId| world.position(id).expect("a disc of this world");
    for k in 0..count as usize {
        // Radii from 0.8 to 1.2 of the mean, so that no crystal forms.
        let radius = RADIUS * (1.0 + 0.2 * (k as f64 * 12.9898).sin());
        let x = RADIUS * (k as f64 * 78.233).sin();
        // A little above whatever is below.
        let near = discs.iter().map(|&id| place(&world, id)).filter(|p| (p[0] - x).abs() < 2.5 * RADIUS);
        let y = near.map(|p| p[1]).fold(0.0, f64::max) + 3.0 * RADIUS;
        discs.push(world.ball(Ball::new((radius / RADIUS).powi(2), radius).at([x, y])));
        world.run(&Limits { time: Some(world.time() + PAUSE), ..Limits::default() });
    }
    let stop = world.run(&Limits { time: Some(world.time() + LAST), rest: true, ..Limits::default() });
    let ledger = world.ledger();
    let centres: Vec<Vector<2>> = discs.iter().map(|&id| place(&world, id)).collect();
    let mean = |of: &dyn Fn(&Vector<2>) -> f64| centres.iter().map(of).sum::<f64>() / centres.len() as f64;
    let middle = mean(&|p| p[0]);
    let slope = mean(&|p| p[1]) / mean(&|p| (p[0] - middle).abs());
    let said = if stop == Stop::Rest { "at rest" } else { "still moving" };
    println!(
        "{count} discs, mu {friction}, rolling {rolling}: {:.1} degrees, {said} at {:.1} s | {:.1} s of wall | {} impacts, {} slices | \
         overlap {:.0e} | {}",
        slope.atan().to_degrees(),
        world.time(),
        clock.elapsed().as_secs_f64(),
        world.impact_count(),
        world.slice_count(),
        ledger.overlap,
        if ledger.pass() { "audit pass" } else { "audit FAIL" }
    );
    if places {
        centres.iter().for_each(|p| println!("{:.4} {:.4}", p[0], p[1]));
    }
}
