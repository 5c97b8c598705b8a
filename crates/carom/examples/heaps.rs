//! Heaps that are poured into a box and come to rest, and what they cost:
//!
//! ```text
//! cargo run --release -p carom --example heaps -- DIM COUNT E [SECONDS] [--log]
//! cargo run --release -p carom --example heaps -- 2 1000 0.5
//! ```
use std::time::Instant;

use carom::{Ball, Boundary, Limits, Rotates, Stop, Vector, World};

const RADIUS: f64 = 0.01;

/// `count` balls on a loose lattice, each a little off its place, over the floor of a box as wide as the lattice.
fn pour<const D: usize>(count: usize, e: f64) -> World<D>
where
    Vector<D>: Rotates,
{
    let wide = if D == 2 {
        (count as f64).sqrt() as usize
    } else {
        (1..).find(|w| w * w * w >= count).expect("a cube that holds them")
    };
    let side = wide as f64 * 2.4 * RADIUS;
    let high = Vector::<D>::from_fn(|k| if k + 1 == D { 10.0 } else { side });
    let mut world =
        World::<D>::new().gravity(Vector::axis(D - 1) * -9.81).boundary(Boundary::walls(Vector::ZERO, high));
    for k in 0..count {
        let mut rest = k;
        let x = Vector::<D>::from_fn(|axis| {
            let place = if axis + 1 == D { rest } else { rest % wide };
            rest /= wide;
            let off = if axis + 1 == D { 0.0 } else { (k as f64 * [12.9898, 78.233][axis.min(1)]).sin() * 0.15 };
            (place as f64 * 2.4 + 1.2 + off) * RADIUS
        });
        world.ball(Ball::new(1.0, RADIUS).at(x).restitution(e));
    }
    world.keep_reports(false);
    world
}

fn measure<const D: usize>(count: usize, e: f64, seconds: f64, log: bool)
where
    Vector<D>: Rotates,
{
    let mut world = pour::<D>(count, e);
    let clock = Instant::now();
    let mut stop = Stop::Time;
    let mut at = 0.0;
    let mut before = [0u64; 3];
    while stop == Stop::Time && at < seconds {
        at += 0.1;
        stop = world.run(&Limits { time: Some(at), rest: true, ..Limits::default() });
        if log {
            let now = [world.impact_count(), world.event_count(), world.slice_count()];
            let grown: Vec<u64> = now.iter().zip(before).map(|(a, b)| a - b).collect();
            before = now;
            let ledger = world.ledger();
            println!(
                "t = {:5.2} | {:6.2} s | {:7} impacts | {:7} events | {:6} slices | kinetic {:.1e} J | overlap {:.1e}",
                world.time(),
                clock.elapsed().as_secs_f64(),
                grown[0],
                grown[1],
                grown[2],
                ledger.energy.kinetic,
                ledger.overlap
            );
        }
    }
    let deepest = world.deepest_overlap();
    let ledger = world.ledger();
    println!(
        "{D}D {count:5} e = {e}: {stop:?} at {:.3} s | {:.2} s of wall | {} impacts, {} events, {} slices | overlap {deepest:.1e}, ever \
         {:.1e} | capped {} | unexplained {:.1e}, angular {:.1e} | {}",
        world.time(),
        clock.elapsed().as_secs_f64(),
        world.impact_count(),
        world.event_count(),
        world.slice_count(),
        ledger.overlap,
        ledger.capped,
        ledger.unexplained(),
        ledger.angular_momentum.as_ref().map_or(0.0, |a| a.drift),
        if ledger.pass() { "pass" } else { "FAIL" }
    );
}

fn main() {
    let log = std::env::args().any(|a| a == "--log");
    let numbers: Vec<f64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let [dim, count, e, ..] = numbers[..] else {
        eprintln!("usage: heaps DIM COUNT E [SECONDS] [--log]");
        std::process::exit(2);
    };
    let seconds = numbers.get(3).copied().unwrap_or(20.0);
    match dim as usize {
        2 => measure::<2>(count as usize, e, seconds, log),
        3 => measure::<3>(count as usize, e, seconds, log),
        _ => eprintln!("DIM is 2 or 3"),
    }
}
