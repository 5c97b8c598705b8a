//! Two equal elastic balls, one at rest, met off centre: they part at right angles.
use carom::{Ball, Error, World};

pub fn run() -> Result<(), Error> {
    let mut world = World::<2>::new();
    let a = world.ball(Ball::new(1.0, 0.1).at([-1.0, 0.08]).moving([2.0, 0.0]));
    let b = world.ball(Ball::new(1.0, 0.1));
    world.advance(2.0);
    let (v, w) = (world.velocity(a)?, world.velocity(b)?);
    println!("{v:?} and {w:?}: their product is {:.0e}", v.dot(w));
    assert!(v.dot(w).abs() < 1e-15);
    Ok(())
}
