//! R. L. Garwin's superball (1969), e = e_t = 1: floor, underside of the table, floor, and back to the hand: 3/7, -31/49, -333/343 of its speed.
use carom::{Ball, Error, Material, Wall, World};

pub fn run() -> Result<(), Error> {
    let mut world = World::<3>::new();
    world.set_default_material(Material::new().restitution(1.0).friction(10.0).tangential(1.0))?;
    world.wall(Wall::plane([0.0; 3], [0.0, 0.0, 1.0]));
    world.wall(Wall::plane([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]));
    let ball = world.ball(Ball::new(0.1, 0.05).at([0.0, 0.0, 0.5]).moving([1.0, 0.0, -3.0]));
    let mut along = Vec::new();
    for _ in 0..3 {
        world.advance_to_next(10.0);
        along.push(world.velocity(ball)?[0]);
    }
    println!("along the floor: {along:?}");
    for (got, want) in along.iter().zip([3.0 / 7.0, -31.0 / 49.0, -333.0 / 343.0]) {
        assert!((got - want).abs() < 1e-14);
    }
    Ok(())
}
