//! A billiard rack, all at one instant.
use super::{Cell, Column, Make, PHASES, kinetic};
use crate::engine::{FRAME, State};
use crate::scene::Scene;

pub const TITLE: &str = "A rack of fifteen";
pub const WHAT: &str = "Fifteen balls of r = 0.5 m that touch exactly; a sixteenth comes at 3 m/s along the axis, e = 1. After 2 s: the part of the energy \
that is left, and by how much the break differs from its mirror image, over 3 m/s (16 phases).";
pub const COLUMNS: &[Column] = &[("energy", "1"), ("asymmetry", "0")];

const RADIUS: f64 = 0.5;
const SPEED: f64 = 3.0;
const ROWS: usize = 5;

pub fn row(dim: usize, make: Make<'_>) -> Vec<Cell> {
    let runs: Vec<(f64, f64)> = (0..PHASES).map(|phase| run(dim, make, phase)).collect();
    vec![
        Cell::span(&runs.iter().map(|r| r.0).collect::<Vec<_>>()),
        Cell::words(
            super::percent(runs.iter().map(|r| r.1).fold(0.0, f64::max)),
            vec![runs.iter().map(|r| r.1).fold(0.0, f64::max)],
        ),
    ]
}

fn run(dim: usize, make: Make<'_>, phase: u32) -> (f64, f64) {
    let gap = 0.5 + SPEED * FRAME * f64::from(phase) / f64::from(PHASES);
    let mut scene = Scene::new(dim, 1.0).ball(1.0, RADIUS, [-2.0 * RADIUS - gap, 0.0, 0.0], [SPEED, 0.0, 0.0]);
    // Each row with its mirror images: ball k of row n mirrors ball n - k.
    let mut mirrors = vec![(0, 0)];
    for n in 0..ROWS {
        let first = scene.balls.len();
        for k in 0..=n {
            let y = (2.0 * k as f64 - n as f64) * RADIUS;
            scene = scene.ball(1.0, RADIUS, [3f64.sqrt() * RADIUS * n as f64, y, 0.0], [0.0; 3]);
            mirrors.push((first + k, first + n - k));
        }
    }
    let mut world = make(&scene);
    (0..120).for_each(|_| world.frame());
    let balls: Vec<State> = world.balls();
    let differs = |(i, j): (usize, usize)| {
        let (v, w) = (balls[i].velocity, balls[j].velocity);
        super::distance(v, [w[0], -w[1], w[2]]) / SPEED
    };
    (kinetic(&scene, &balls) / (0.5 * SPEED * SPEED), mirrors.into_iter().map(differs).fold(0.0, f64::max))
}
