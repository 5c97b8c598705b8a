//! 2 kg at 3 m/s meets 1 kg at -1 m/s with e = 1/2: they part at 1 and 3 m/s.
use carom::{Ball, Error, World};

pub fn run() -> Result<(), Error> {
    let mut world = World::<1>::new();
    let a = world.ball(Ball::new(2.0, 0.1).at([-1.0]).moving([3.0]).restitution(0.5));
    let b = world.ball(Ball::new(1.0, 0.1).at([1.0]).moving([-1.0]).restitution(0.5));
    for impact in world.advance(1.0) {
        println!("at {} s: impulse {} N s, {} J lost", impact.time, impact.impulse, impact.lost);
    }
    assert_eq!((world.velocity(a)?, world.velocity(b)?), ([1.0].into(), [3.0].into()));
    Ok(())
}
