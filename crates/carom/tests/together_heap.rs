//! The projection of a heap: thousands of contacts, in time for a slice.
use std::time::Instant;

use carom::{
    Vector,
    law::together::{Solver, System, TOLERANCE, Together},
};

/// Gravity times the length of a slice, g h (m/s).
const GH: f64 = 9.81e-3;
const H: f64 = 1e-3;

fn noise(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Discs of diameter 1 (mass 1) on a hexagonal lattice, `rows` of `wide`, displaced by up to `jitter`, on a floor, between
/// two walls if `walls`. Velocities g h down. Returns the system and the bounds -gap/h.
fn heap(wide: usize, rows: usize, jitter: f64, walls: bool, seed: u64) -> (System, Vec<f64>) {
    let mut state = seed;
    let mut at = Vec::new();
    for r in 0..rows {
        for k in 0..wide - if walls { r % 2 } else { 0 } {
            let x = k as f64 + if r % 2 == 1 { 0.5 } else { 0.0 };
            at.push([x + jitter * noise(&mut state), r as f64 * 0.75f64.sqrt() + jitter * noise(&mut state)]);
        }
    }
    let (mut system, mut bounds) = (System::new(), Vec::new());
    for _ in &at {
        system.ball(1.0, Vector([0.0, -GH]));
    }
    for a in 0..at.len() {
        for b in a + 1..at.len().min(a + 2 * wide) {
            let d = Vector([at[b][0] - at[a][0], at[b][1] - at[a][1]]);
            if d.norm() < 1.0 + 1e-3 {
                system.pair(2 * a, 2 * b, d.unit().unwrap());
                bounds.push(-(d.norm() - 1.0).max(0.0) / H);
            }
        }
        let gaps = [(at[a][1], [0.0, -1.0]), (at[a][0], [-1.0, 0.0]), (wide as f64 - 1.0 - at[a][0], [1.0, 0.0])];
        for (gap, n) in gaps.into_iter().take(if walls { 3 } else { 1 }) {
            if gap < 1e-3 {
                system.wall(2 * a, Vector(n), Vector::ZERO);
                bounds.push(-gap.max(0.0) / H);
            }
        }
    }
    (system, bounds)
}

/// The time is printed, not asserted: it belongs to the machine. What a solve costs is its factors, about 5 ms each for 2,800
/// contacts.
#[test]
fn heaps_in_time() {
    println!("  discs | contacts | jitter | walls | start | factors | residual | ms");
    let mut solver = Solver::new();
    for (wide, rows) in [(10, 10), (33, 30)] {
        for jitter in [0.0, 1e-9, 1e-6] {
            for walls in [false, true] {
                let (start, bounds) = heap(wide, rows, jitter, walls, 1);
                let mut warm = Vec::new();
                for name in ["cold", "warm", "next"] {
                    let mut system = start.clone();
                    if name == "next" {
                        // Another slice: a tenth slower, and a thousandth of it to the side.
                        for (k, v) in system.velocities_mut().iter_mut().enumerate() {
                            *v = if k % 2 == 0 { 1e-4 * GH * ((k * 7919) % 13) as f64 } else { 0.9 * *v };
                        }
                    }
                    let clock = Instant::now();
                    let found = solver.project(&mut system, &bounds, &warm);
                    let ms = clock.elapsed().as_secs_f64() * 1e3;
                    println!(
                        "  {:5} | {:8} | {jitter:6.0e} | {walls:5} | {name:5} | {:7} | {:8.1e} | {ms:.1}",
                        start.velocities().len() / 2,
                        start.contacts(),
                        found.factors,
                        found.residual
                    );
                    assert!(found.converged && found.residual <= 1e-13);
                    // Ten Newton steps, at most sixty interior ones, and what it takes to finish.
                    assert!(found.factors <= if name == "warm" { 2 } else { 100 });
                    warm.clone_from(&found.lambda);
                    assert!(warm.iter().all(|l| *l >= 0.0));
                    for i in 0..system.contacts() {
                        let over = system.opening(i) - bounds[i];
                        assert!(over >= -TOLERANCE && (warm[i] == 0.0 || over <= TOLERANCE));
                    }
                    // Held between walls and without gaps, nothing moves, and the floor carries the weight times h.
                    if walls && jitter == 0.0 && name != "next" {
                        let floor = (0..system.contacts())
                            .filter(|&i| system.column(i).len() == 2 && system.column(i)[1].1 == 1.0);
                        let carried: f64 = floor.map(|i| warm[i]).sum();
                        let weight = GH * (start.velocities().len() / 2) as f64;
                        assert!((carried / weight - 1.0).abs() < 1e-9, "{carried} of {weight}");
                        // Gaps of one rounding, 1e-16, leave room for 1e-13 m/s each, and rows add theirs up.
                        let fastest = system.velocities().iter().fold(0.0, |a: f64, v| a.max(v.abs()));
                        assert!(fastest < 1e-10, "{fastest:e}");
                    }
                }
            }
        }
    }
}

#[test]
fn small_sets_are_quick() {
    println!("  set          | iterations | us per instant");
    let chain = |n: usize| {
        let mut system = System::new();
        for k in 0..n {
            system.ball(1.0, Vector([if k == 0 { 1.0 } else { 0.0 }, 0.0]));
        }
        for k in 1..n {
            system.pair(2 * (k - 1), 2 * k, Vector([1.0, 0.0]));
        }
        system
    };
    let mut solver = Solver::new();
    for n in [2, 3, 5, 17] {
        for e in [1.0, 0.5] {
            let start = chain(n);
            let mut system = start.clone();
            let (clock, rounds) = (Instant::now(), 2000);
            let mut iterations = 0;
            for _ in 0..rounds {
                system.velocities_mut().copy_from_slice(start.velocities());
                iterations = solver.resolve(Together::Reflect, &mut system, |_, _| e).iterations;
            }
            let us = clock.elapsed().as_secs_f64() * 1e6 / f64::from(rounds);
            println!("  chain of {n:2}, e = {e:3} | {iterations:3} | {us:.2}");
            assert!(e < 1.0 || iterations == n as u32 - 1);
        }
    }
}
