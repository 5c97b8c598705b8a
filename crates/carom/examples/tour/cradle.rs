//! Five balls, four of them touching: what comes out depends on how contacts at one instant are solved.
use carom::{Ball, Error, Together, World};

pub fn run() -> Result<(), Error> {
    for together in Together::ALL {
        let mut world = World::<1>::new().together(together);
        let balls: Vec<_> = (0..5)
            .map(|k| {
                let (x, v) = if k == 0 { (-0.6, 1.0) } else { (0.2 * f64::from(k) - 0.2, 0.0) };
                world.ball(Ball::new(1.0, 0.1).at([x]).moving([v]))
            })
            .collect();
        world.advance(1.0);
        let v: Result<Vec<f64>, Error> = balls.iter().map(|&id| Ok(world.velocity(id)?[0])).collect();
        println!("{together:?}: {:.3?}", v?);
        assert!(world.ledger().unexplained() < 1e-15);
    }
    Ok(())
}
