//! A ball dropped from 2 m with e = 0.8: it meets the floor for the last time after t (1 + e)/(1 - e), and rests.
use carom::{Ball, Error, Limits, Stop, Wall, World};

pub fn run() -> Result<(), Error> {
    let (g, e) = (9.81, 0.8);
    let mut world = World::<2>::new().gravity([0.0, -g]);
    world.wall(Wall::plane([0.0, 0.0], [0.0, 1.0]));
    let ball = world.ball(Ball::new(1.0, 0.1).at([0.0, 2.1]).restitution(e));
    let stop = world.run(&Limits { time: Some(20.0), rest: true, ..Limits::default() });
    let fall = (2.0 * 2.0 / g as f64).sqrt();
    println!(
        "{} bounces in {:.4} s; without rest it would be {:.4} s",
        world.impact_count(),
        world.time(),
        fall * (1.0 + e) / (1.0 - e)
    );
    assert!(stop == Stop::Rest && world.rests(ball)?);
    // What is left out are the hops slower than rest_speed: 2 v/g (1 + e + e^2 + ...) at most.
    assert!((fall * (1.0 + e) / (1.0 - e) - world.time()).abs() < 2.0 * carom::world::REST_SPEED / g / (1.0 - e));
    Ok(())
}
