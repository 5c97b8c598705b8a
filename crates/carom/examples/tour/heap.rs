//! Twelve discs fall into a narrow box and come to rest: all the energy is in the books as lost.
use carom::{Ball, Boundary, Error, Limits, Stop, World};

pub fn run() -> Result<(), Error> {
    let mut world = World::<2>::new().gravity([0.0, -9.81]).boundary(Boundary::walls([0.0, 0.0], [0.5, 4.0]));
    for k in 0..12 {
        let (x, y) = (0.1 + 0.13 * f64::from(k % 3), 0.2 + 0.25 * f64::from(k));
        world.ball(Ball::new(1.0, 0.06).at([x, y]).restitution(0.3));
    }
    let stop = world.run(&Limits { time: Some(60.0), rest: true, ..Limits::default() });
    let ledger = world.ledger();
    println!(
        "at rest after {:.2} s; {:.3} J lost, {:.0e} of it unexplained",
        world.time(),
        ledger.energy.lost,
        ledger.energy.drift
    );
    assert!(stop == Stop::Rest && ledger.pass());
    Ok(())
}
