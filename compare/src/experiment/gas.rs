//! A gas in a closed box: energy has nowhere to go.
use super::{Cell, Column, Make, distance, kinetic};
use crate::clock;
use crate::scene::{Scene, Wall};

pub const TITLE: &str = "A gas in a box";
pub const WHAT: &str = "1,000 balls of r = 0.1 m, e = 1, in a closed box (area fraction 0.3, volume fraction 0.15), all at first at the same speed: \
the change of the kinetic energy after 1,000 and after 10,000 frames, the deepest overlap of two balls in radii (looked at every tenth frame), and CPU time a frame.";
pub const COLUMNS: &[Column] = &[
    ("1 m/s: 1,000", "0"),
    ("10,000", "0"),
    ("overlap", "0"),
    ("ms", ""),
    ("10 m/s: 1,000", "0"),
    ("10,000", "0"),
    ("overlap", "0"),
    ("ms", ""),
];

const COUNT: usize = 1_000;
const RADIUS: f64 = 0.1;
const LONG: u32 = 10_000;
const SHORT: u32 = 1_000;

pub fn row(dim: usize, make: Make<'_>) -> Vec<Cell> {
    let mut cells = Vec::new();
    for speed in [1.0, 10.0] {
        let scene = scene(dim, speed);
        let start = clock::cpu_seconds();
        let mut world = make(&scene);
        let energy = 0.5 * COUNT as f64 * speed * speed;
        let (mut deepest, mut looking) = (0.0f64, 0.0);
        for frame in 1..=LONG {
            world.frame();
            if frame % 10 == 0 {
                let from = clock::cpu_seconds();
                let balls = world.balls();
                deepest = deepest.max(overlap(&balls.iter().map(|b| b.at).collect::<Vec<_>>()));
                if frame == SHORT || frame == LONG {
                    let change = kinetic(&scene, &balls) / energy - 1.0;
                    cells.push(Cell::percent(change));
                }
                looking += clock::cpu_seconds() - from;
            }
        }
        cells.push(Cell::words(super::number(deepest), vec![deepest]));
        let each = 1e3 * (clock::cpu_seconds() - start - looking) / f64::from(LONG);
        cells.push(Cell::words(format!("{each:.2}"), vec![each]));
    }
    cells
}

/// Balls at the points of a square or cubic lattice, each at the same speed in a direction of its own.
fn scene(dim: usize, speed: f64) -> Scene {
    let pi = std::f64::consts::PI;
    let side = if dim == 2 {
        (COUNT as f64 * pi * RADIUS * RADIUS / 0.3).sqrt()
    } else {
        (COUNT as f64 * 4.0 / 3.0 * pi * RADIUS.powi(3) / 0.15).cbrt()
    };
    let mut scene = Scene::new(dim, 1.0);
    for axis in 0..dim {
        scene = scene.wall(Wall::Half { axis, at: 0.0, above: false }).wall(Wall::Half { axis, at: side, above: true });
    }
    let edge = if dim == 2 { 32 } else { 10 };
    let pitch = side / edge as f64;
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    let mut roll = move || {
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        (state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64
    };
    for k in 0..COUNT {
        let place = |j: usize| (j as f64 + 0.5) * pitch;
        let at = if dim == 2 {
            [place(k % edge), place(k / edge), 0.0]
        } else {
            [place(k % edge), place(k / edge % edge), place(k / edge / edge)]
        };
        // A direction: a point of the unit ball that is not too close to its centre.
        let velocity = loop {
            let mut d: [f64; 3] = std::array::from_fn(|k| if k < dim { 2.0 * roll() - 1.0 } else { 0.0 });
            let length = distance(d, [0.0; 3]);
            if length > 0.1 && length <= 1.0 {
                d.iter_mut().for_each(|x| *x *= speed / length);
                break d;
            }
        };
        scene = scene.ball(1.0, RADIUS, at, velocity);
    }
    scene
}

/// The deepest overlap of two balls, in radii.
fn overlap(at: &[[f64; 3]]) -> f64 {
    let mut sorted = at.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut deepest = 0.0f64;
    for (i, a) in sorted.iter().enumerate() {
        for b in sorted[i + 1..].iter().take_while(|b| b[0] - a[0] < 2.0 * RADIUS) {
            deepest = deepest.max((2.0 * RADIUS - distance(*a, *b)) / RADIUS);
        }
    }
    deepest
}
