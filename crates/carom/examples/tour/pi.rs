//! A heavy block pushes a light one against a wall: the impacts count the digits of pi (G. Galperin, 2003).
use carom::{Ball, Error, Wall, World};

pub fn run() -> Result<(), Error> {
    for (digits, count) in [(1, 31), (2, 314), (3, 3141), (4, 31415)] {
        let mut world = World::<1>::new();
        world.keep_reports(false);
        world.wall(Wall::plane([0.0], [1.0]));
        world.ball(Ball::new(1.0, 0.1).at([1.0]));
        world.ball(Ball::new(100f64.powi(digits), 0.1).at([2.0]).moving([-1.0]));
        world.advance(1000.0);
        println!("mass ratio 100^{digits}: {} impacts", world.impact_count());
        assert_eq!(world.impact_count(), count);
    }
    Ok(())
}
