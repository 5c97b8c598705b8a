//! Four hundred discs, all equally fast at first: after some impacts a disc <v^4> is 2 <v^2>^2, as Maxwell says for the plane.
use carom::{Ball, Boundary, Error, Limits, World};

pub fn run() -> Result<(), Error> {
    let mut world = World::<2>::new().boundary(Boundary::periodic([0.0, 0.0], [20.0, 20.0]));
    world.keep_reports(false);
    let ids: Vec<_> = (0..400)
        .map(|k| {
            let (x, y) = (f64::from(k % 20) + 0.5, f64::from(k / 20) + 0.5);
            // Directions a golden angle apart.
            let angle = 2.399963229728653 * f64::from(k);
            world.ball(Ball::new(1.0, 0.3).at([x, y]).moving([angle.cos(), angle.sin()]))
        })
        .collect();
    let (mut second, mut fourth, mut samples) = (0.0, 0.0, 0.0);
    for k in 1..=40 {
        world.run(&Limits { impacts: Some(4_000 + 400 * k), ..Limits::default() });
        for &id in &ids {
            let square = world.velocity(id)?.norm_squared();
            (second, fourth, samples) = (second + square, fourth + square * square, samples + 1.0);
        }
    }
    let ratio = fourth / samples / (second / samples).powi(2);
    println!(
        "<v^4>/<v^2>^2 = {ratio:.3} (Maxwell: 2; at the start: 1); energy off by {:.0e}",
        world.ledger().energy.drift
    );
    // 16,000 velocities, of which some 2,000 are independent: the ratio's error is about sqrt(20/2000) = 0.1.
    assert!((ratio - 2.0).abs() < 0.3);
    Ok(())
}
