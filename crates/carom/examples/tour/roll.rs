//! A solid sphere set sliding at v rolls after 2 v/(7 mu g), at 5/7 v, whatever the friction.
use carom::{Ball, Error, Material, Wall, World};

pub fn run() -> Result<(), Error> {
    let (g, mu, v) = (9.81, 0.2, 3.0);
    let mut world = World::<3>::new().gravity([0.0, 0.0, -g]);
    world.set_default_material(Material::new().restitution(0.5).friction(mu))?;
    world.wall(Wall::plane([0.0; 3], [0.0, 0.0, 1.0]));
    let ball = world.ball(Ball::new(1.0, 0.1).at([0.0, 0.0, 0.1]).moving([v, 0.0, 0.0]));
    let grips = 2.0 * v / (7.0 * mu * g);
    world.advance_to(0.5 * grips);
    let sliding = world.velocity(ball)?[0];
    world.advance_to(2.0 * grips);
    let rolling = world.velocity(ball)?[0];
    println!("slides at {sliding:.4} m/s half-way, rolls at {rolling:.4} m/s from {grips:.4} s on");
    assert!((sliding - (v - mu * g * 0.5 * grips)).abs() < 1e-12 && (rolling - 5.0 / 7.0 * v).abs() < 1e-12);
    assert!((world.spin(ball)?[1] - rolling / 0.1).abs() < 1e-10);
    Ok(())
}
