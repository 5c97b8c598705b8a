//! A small fast ball: does it hit what is in its way?
use super::{Cell, Column, Make, PHASES, distance};
use crate::engine::FRAME;
use crate::scene::{Scene, Wall};

pub const TITLE: &str = "A small fast ball";
pub const WHAT: &str = "r = 0.05 m at 200 m/s (3.3 m a frame), e = 1, against a wall 0.05 m thick, against a ball of its own size at rest, and against one \
that comes at 200 m/s: hits of 16 phases, and how far from its true place it is ten frames later (the worst of those that hit).";
pub const COLUMNS: &[Column] = &[
    ("wall", "16"),
    ("off by", "0"),
    ("ball at rest", "16"),
    ("off by", "0"),
    ("ball that comes", "16"),
    ("off by", "0"),
];

const RADIUS: f64 = 0.05;
const SPEED: f64 = 200.0;
const HALF_WALL: f64 = 0.025;
const FRAMES: u32 = 10;

pub fn row(dim: usize, make: Make<'_>) -> Vec<Cell> {
    let mut cells = Vec::new();
    for case in 0..3 {
        let errors: Vec<f64> = (0..PHASES).filter_map(|phase| hit(dim, make, case, phase)).collect();
        cells.push(Cell::words(format!("{} of {PHASES}", errors.len()), vec![errors.len() as f64]));
        cells.push(if errors.is_empty() {
            Cell::words("—".into(), vec![])
        } else {
            let worst = Cell::worst(&errors);
            Cell { shown: format!("{} m", worst.shown), ..worst }
        });
    }
    cells
}

/// How far off the first ball is at the end; `None` if it flew through.
fn hit(dim: usize, make: Make<'_>, case: u32, phase: u32) -> Option<f64> {
    let start = -8.0 - SPEED * FRAME * f64::from(phase) / f64::from(PHASES);
    let mut scene = Scene::new(dim, 1.0).ball(1.0, RADIUS, [start, 0.0, 0.0], [SPEED, 0.0, 0.0]);
    let time = f64::from(FRAMES) * FRAME;
    // Where its centre turns or stops, and with what velocity it goes on.
    let (reach, after) = match case {
        0 => {
            scene = scene.wall(Wall::Slab { min: [-HALF_WALL, -5.0, -5.0], max: [HALF_WALL, 5.0, 5.0] });
            (-HALF_WALL - RADIUS, -SPEED)
        }
        1 => {
            scene = scene.ball(1.0, RADIUS, [0.0; 3], [0.0; 3]);
            (-2.0 * RADIUS, 0.0)
        }
        _ => {
            scene = scene.ball(1.0, RADIUS, [-start, 0.0, 0.0], [-SPEED, 0.0, 0.0]);
            (-RADIUS, -SPEED)
        }
    };
    let mut world = make(&scene);
    (0..FRAMES).for_each(|_| world.frame());
    let ball = world.balls()[0];
    let truth = reach + after * (time - (reach - start) / SPEED);
    (ball.velocity[0] < 0.9 * SPEED).then(|| distance(ball.at, [truth, 0.0, 0.0]))
}
