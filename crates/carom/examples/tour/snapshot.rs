//! A world written down half-way and read again goes on to the same bits.
use carom::{Ball, Boundary, Error, World};

pub fn run() -> Result<(), Error> {
    let mut world = World::<2>::new().gravity([0.0, -1.0]).boundary(Boundary::walls([0.0, 0.0], [1.0, 1.0]));
    for k in 0..16 {
        let (x, y) = (f64::from(k % 4), f64::from(k / 4));
        world.ball(Ball::new(1.0, 0.05).at([0.15 + 0.23 * x, 0.15 + 0.23 * y]).moving([y - x, x - 1.0]));
    }
    world.advance_to(1.0);
    let bytes = world.snapshot();
    let mut again = World::<2>::restore(&bytes)?;
    world.advance_to(3.0);
    again.advance_to(3.0);
    println!("{} bytes; both come to {:016x}", bytes.len(), world.digest());
    assert_eq!(world.digest(), again.digest());
    Ok(())
}
