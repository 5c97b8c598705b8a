//! Newton's cradle: balls that touch, in a row.
use super::{Cell, Column, Make, PHASES, kinetic};
use crate::engine::{FRAME, State};
use crate::scene::Scene;

pub const TITLE: &str = "Newton's cradle";
pub const WHAT: &str = "Five balls of r = 0.5 m, those at rest touch, e = 1; one or two come in at 3 m/s. Velocities after, over 3 m/s, at phase 0; \
the part of the energy that is left; the worst error of a velocity in 16 phases.";
pub const COLUMNS: &[Column] = &[
    ("one in", "0 0 0 0 1"),
    ("energy", "1"),
    ("worst", "0"),
    ("two in", "0 0 0 1 1"),
    ("energy", "1"),
    ("worst", "0"),
];

const RADIUS: f64 = 0.5;
const SPEED: f64 = 3.0;
const COUNT: usize = 5;

pub fn row(dim: usize, make: Make<'_>) -> Vec<Cell> {
    let mut cells = Vec::new();
    for coming in [1, 2] {
        let runs: Vec<(Vec<f64>, f64)> = (0..PHASES).map(|phase| run(dim, make, coming, phase)).collect();
        let exact = |k: usize| if k >= COUNT - coming { 1.0 } else { 0.0 };
        let worst: Vec<f64> =
            runs.iter().flat_map(|(v, _)| v.iter().enumerate().map(|(k, v)| (v - exact(k)).abs())).collect();
        cells.extend([
            Cell::list(&runs[0].0),
            Cell::span(&runs.iter().map(|r| r.1).collect::<Vec<_>>()),
            Cell::worst(&worst),
        ]);
    }
    cells
}

fn run(dim: usize, make: Make<'_>, coming: usize, phase: u32) -> (Vec<f64>, f64) {
    let gap = 0.5 + SPEED * FRAME * f64::from(phase) / f64::from(PHASES);
    let mut scene = Scene::new(dim, 1.0);
    for k in 0..COUNT {
        let moves = k < coming;
        let x = 2.0 * RADIUS * k as f64 - if moves { gap } else { 0.0 };
        scene = scene.ball(1.0, RADIUS, [x, 0.0, 0.0], [if moves { SPEED } else { 0.0 }, 0.0, 0.0]);
    }
    let mut world = make(&scene);
    (0..120).for_each(|_| world.frame());
    let balls: Vec<State> = world.balls();
    let energy = kinetic(&scene, &balls) / (0.5 * coming as f64 * SPEED * SPEED);
    (balls.iter().map(|b| b.velocity[0] / SPEED).collect(), energy)
}
