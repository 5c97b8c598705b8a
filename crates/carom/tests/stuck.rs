//! Worlds over which the clock stands still: the run ends, and says why.
use carom::{Ball, Limits, Stop, Wall, World};

/// Two balls, one on the other beside a wall, that gravity moves through their own size in less than the clock can tell.
#[test]
fn balls_too_small_for_the_clock() {
    let mut world = World::<2>::new().gravity([0.0, -9.81]);
    world.wall(Wall::plane([0.0, 0.0], [0.0, 1.0]));
    world.advance(1.0);
    let r = 1e-100;
    world.ball(Ball::new(1.0, r).at([0.0, r]));
    world.ball(Ball::new(1.0, r).at([1.2 * r, 2.6 * r]));
    let stop = world.run(&Limits { time: Some(2.0), impacts: Some(100_000), ..Limits::default() });
    assert_eq!(stop, Stop::NotFinite);
}

/// A ball between two that are so much heavier that no impulse which moves it is in their numbers.
#[test]
fn a_ball_too_light_to_part_two() {
    let mut world = World::<1>::new();
    world.ball(Ball::new(1e-12, 0.1).at([-1.0]).restitution(0.25));
    world.ball(Ball::new(7e-304, 0.1).at([0.0]).restitution(0.25));
    world.ball(Ball::new(1.0, 0.1).at([1.0]).moving([-7.0]).restitution(0.25));
    let stop = world.run(&Limits { time: Some(10.0), impacts: Some(1_000_000), ..Limits::default() });
    assert_eq!(stop, Stop::Crushed);
}
