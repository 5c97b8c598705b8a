//! Two smooth elastic balls: the lecture's formula is the answer.
use super::{Cell, Column, Make, PHASES, distance};
use crate::engine::FRAME;
use crate::scene::Scene;

pub const TITLE: &str = "Two balls";
pub const WHAT: &str = "r = 0.5 m, e = 1, masses 1:1, 1:3 and 1:1000, the light one moves: error of the velocities after, over the approach speed, the \
worst of 16 phases. Oblique: the impact parameter is half the sum of the radii.";
pub const COLUMNS: &[Column] = &[("head-on, 3 m/s", "0"), ("head-on, 0.5 m/s", "0"), ("oblique, 3 m/s", "0")];

const RADIUS: f64 = 0.5;

pub fn row(dim: usize, make: Make<'_>) -> Vec<Cell> {
    [(3.0, 0.0), (0.5, 0.0), (3.0, RADIUS)]
        .map(|(speed, across)| {
            let errors: Vec<f64> = [1.0, 3.0, 1000.0]
                .into_iter()
                .flat_map(|mass| (0..PHASES).map(move |phase| (mass, phase)))
                .map(|(mass, phase)| error(dim, make, mass, speed, across, phase))
                .collect();
            Cell::worst(&errors)
        })
        .into()
}

fn error(dim: usize, make: Make<'_>, mass: f64, speed: f64, across: f64, phase: u32) -> f64 {
    let sum = 2.0 * RADIUS;
    let along = (sum * sum - across * across).sqrt();
    let gap = 0.5 + speed * FRAME * f64::from(phase) / f64::from(PHASES);
    let scene = Scene::new(dim, 1.0)
        .ball(1.0, RADIUS, [-along - gap, -across, 0.0], [speed, 0.0, 0.0])
        .ball(mass, RADIUS, [0.0; 3], [0.0; 3]);
    let mut world = make(&scene);
    let frames = (2.0 * gap / speed / FRAME) as u32 + 30;
    (0..frames).for_each(|_| world.frame());
    let normal = [along / sum, across / sum, 0.0];
    let impulse = 2.0 * speed * normal[0] * mass / (1.0 + mass);
    let after = [
        [speed - impulse * normal[0], -impulse * normal[1], 0.0],
        [impulse / mass * normal[0], impulse / mass * normal[1], 0.0],
    ];
    let balls = world.balls();
    (0..2).map(|k| distance(balls[k].velocity, after[k]) / speed).fold(0.0, f64::max)
}
