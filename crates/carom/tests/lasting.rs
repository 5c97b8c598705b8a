//! Contacts that last: heaps, bowls, notches, rest.
use carom::{Ball, Boundary, Limits, Stop, Wall, World};

fn pour(n: usize, e: f64) -> World<2> {
    let r = 0.01;
    let wide = (n as f64).sqrt() as usize;
    let mut world =
        World::<2>::new().gravity([0.0, -9.81]).boundary(Boundary::walls([0.0, 0.0], [wide as f64 * 2.4 * r, 10.0]));
    for k in 0..n {
        let (column, row) = ((k % wide) as f64, (k / wide) as f64);
        let jitter = ((k as f64) * 12.9898).sin() * 0.15 * r;
        world.ball(Ball::new(1.0, r).at([(column * 2.4 + 1.2) * r + jitter, (row * 2.4 + 1.2) * r]).restitution(e));
    }
    world
}

#[test]
fn a_poured_heap_comes_to_rest() {
    for (n, e) in [(10, 0.5), (100, 0.5), (100, 0.9)] {
        let mut world = pour(n, e);
        let start = std::time::Instant::now();
        let mut stop = Stop::Time;
        for k in 1..=200 {
            stop = world.run(&Limits { time: Some(0.1 * k as f64), rest: true, ..Limits::default() });
            if stop != Stop::Time {
                break;
            }
        }
        let ledger = world.ledger();
        println!(
            "{n} e={e}: {stop:?} at {} after {:?}, {} impacts {} events {} slices; {ledger:?}",
            world.time(),
            start.elapsed(),
            world.impact_count(),
            world.event_count(),
            world.slice_count()
        );
        println!("deepest {:e}", world.deepest_overlap());
        assert_eq!(stop, Stop::Rest);
        assert!(ledger.pass(), "{ledger:?}");
    }
}

#[test]
fn a_marble_in_a_bowl_keeps_its_energy_and_stays_inside() {
    let mut world = World::<2>::new().gravity([0.0, -9.81]);
    world.wall(Wall::arc([0.0, 0.0], 1.0, std::f64::consts::PI, std::f64::consts::TAU).restitution(0.0));
    let ball = world.ball(Ball::new(1.0, 0.05).at([-0.94, 0.0]));
    world.run(&Limits { time: Some(3.0), ..Limits::default() });
    let ledger = world.ledger();
    println!("{:?} {:?} {} slices; {ledger:?}", world.position(ball), world.velocity(ball), world.slice_count());
    assert!(ledger.pass());
}

#[test]
fn a_ball_on_a_ball() {
    let mut world = World::<2>::new().gravity([0.0, -9.81]);
    world.wall(Wall::plane([0.0, 0.0], [0.0, 1.0]));
    let a = world.ball(Ball::new(1.0, 0.1).at([0.0, 0.1]));
    let b = world.ball(Ball::new(1.0, 0.1).at([0.0, 0.3]));
    let stop = world.run(&Limits { time: Some(1.0), rest: true, ..Limits::default() });
    println!("{stop:?} {} {:?} {:?}", world.time(), world.position(a), world.position(b));
    assert_eq!(stop, Stop::Rest);
}
