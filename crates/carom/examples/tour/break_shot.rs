//! A rack of fifteen that touch, struck on its axis: sixteen velocities in one instant, each with its mirror image.
use carom::{Ball, Error, World};

pub fn run() -> Result<(), Error> {
    let (m, r) = (0.17, 0.028575);
    let mut world = World::<2>::new();
    world.ball(Ball::new(m, r).at([-0.5, 0.0]).moving([8.0, 0.0]));
    let mut rows = Vec::new();
    for n in 0..5 {
        let row =
            (0..=n).map(|k| world.ball(Ball::new(m, r).at([3f64.sqrt() * r * f64::from(n), f64::from(2 * k - n) * r])));
        rows.push(row.collect::<Vec<_>>());
    }
    let together = world.advance(1.0)[0].together;
    let mut worst = 0.0f64;
    for row in &rows {
        for (a, b) in row.iter().zip(row.iter().rev()) {
            let (v, w) = (world.velocity(*a)?, world.velocity(*b)?);
            worst = worst.max((v[0] - w[0]).abs()).max((v[1] + w[1]).abs());
        }
    }
    println!("{together} contacts exchanged an impulse in one instant; the mirror image is off by {worst:.0e} m/s");
    assert!(worst < 1e-12);
    Ok(())
}
