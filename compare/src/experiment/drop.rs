//! A ball falls on a floor: how high does it come back?
use super::{Cell, Column, Make, PHASES};
use crate::engine::FRAME;
use crate::scene::{Scene, Wall};

pub const TITLE: &str = "A ball dropped on a floor";
pub const WHAT: &str =
    "r = 0.5 m, from a gap of 2 m, g = 9.81 m/s²: rebound over drop, the span over 16 phases of the step.";
pub const COLUMNS: &[Column] =
    &[("e = 1", "1"), ("e = 0.5", "0.25"), ("e = 1, after 10 bounces", "1"), ("e = 1, after 50 bounces", "1")];

const RADIUS: f64 = 0.5;
const GAP: f64 = 2.0;
const G: f64 = 9.81;
/// Fifty bounces of 1.3 s are 3,900 frames; an engine that gains height needs longer.
const MOST_FRAMES: u32 = 20_000;

pub fn row(dim: usize, make: Make<'_>) -> Vec<Cell> {
    let bounces = |e: f64, which: &[usize]| {
        let mut apexes = vec![Vec::new(); which.len()];
        for phase in 0..PHASES {
            for (k, height) in apexes_after(dim, make, e, phase, which).into_iter().enumerate() {
                apexes[k].push(height);
            }
        }
        apexes
    };
    let (elastic, half) = (bounces(1.0, &[1, 10, 50]), bounces(0.5, &[1]));
    vec![Cell::span(&elastic[0]), Cell::span(&half[0]), Cell::span(&elastic[1]), Cell::span(&elastic[2])]
}

/// The heights (over the drop) at the apexes of these numbers; 0 if the ball comes to none.
fn apexes_after(dim: usize, make: Make<'_>, e: f64, phase: u32, which: &[usize]) -> Vec<f64> {
    let travel = (2.0 * G * GAP).sqrt() * FRAME;
    let drop = GAP + travel * f64::from(phase) / f64::from(PHASES);
    let mut scene = Scene::new(dim, e).ball(1.0, RADIUS, [0.0, RADIUS + drop, 0.0], [0.0; 3]).wall(Wall::Half {
        axis: 1,
        at: 0.0,
        above: false,
    });
    scene.gravity = [0.0, -G, 0.0];
    let mut world = make(&scene);
    let (mut found, mut rising, mut count) = (vec![0.0; which.len()], false, 0);
    for _ in 0..MOST_FRAMES {
        world.frame();
        let ball = world.balls()[0];
        let v = ball.velocity[1];
        if rising && v <= 0.0 {
            count += 1;
            if let Some(k) = which.iter().position(|&n| n == count) {
                // The apex lies between two frames; what is left of the speed says how much higher.
                found[k] = (ball.at[1] + v * v / (2.0 * G) - RADIUS) / drop;
            }
            if count >= which[which.len() - 1] {
                break;
            }
        }
        rising = v > 0.0;
    }
    found
}
