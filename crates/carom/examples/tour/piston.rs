//! A piston comes at a ball in a box: each bounce off it adds twice its speed, and the work is in the books.
use carom::{Ball, Boundary, Error, Wall, World};

pub fn run() -> Result<(), Error> {
    let mut world = World::<1>::new().boundary(Boundary::walls([0.0], [10.0]));
    let piston = world.wall(Wall::plane([0.0], [1.0]).moving([0.5]));
    let ball = world.ball(Ball::new(2.0, 0.1).at([5.0]).moving([-1.0]));
    world.advance_to(8.0);
    world.set_wall_velocity(piston, [0.0])?;
    world.advance_to(30.0);
    let energy = world.ledger().energy;
    println!("{} J of work took the ball to {:?} m/s", energy.work, world.velocity(ball)?);
    assert!((energy.end - energy.start - energy.work).abs() < 1e-12 && energy.work > 0.0);
    // 1 m/s and twice 0.5 m/s for each bounce off the moving piston: whole numbers.
    assert!((world.velocity(ball)?.norm().fract()).abs() < 1e-12);
    Ok(())
}
