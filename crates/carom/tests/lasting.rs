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

fn pour_spheres(n: usize, e: f64) -> World<3> {
    let r = 0.01;
    let wide = (1..).find(|w| w * w * w >= n).unwrap();
    let side = wide as f64 * 2.4 * r;
    let mut world =
        World::<3>::new().gravity([0.0, 0.0, -9.81]).boundary(Boundary::walls([0.0, 0.0, 0.0], [side, side, 10.0]));
    for k in 0..n {
        let at = [k % wide, k / wide % wide, k / wide / wide].map(|c| (c as f64 * 2.4 + 1.2) * r);
        let jitter = |f: f64| ((k as f64) * f).sin() * 0.15 * r;
        world.ball(Ball::new(1.0, r).at([at[0] + jitter(12.9898), at[1] + jitter(78.233), at[2]]).restitution(e));
    }
    world
}

/// Runs to rest within 20 s of its time, and asserts what must hold: the audit, and no overlap beyond a millionth of a radius.
fn comes_to_rest<const D: usize>(name: &str, mut world: World<D>)
where
    carom::Vector<D>: carom::Rotates,
{
    let start = std::time::Instant::now();
    let stop = world.run(&Limits { time: Some(20.0), rest: true, ..Limits::default() });
    let deepest = world.deepest_overlap();
    let ledger = world.ledger();
    println!(
        "{name}: {stop:?} at {:.3} after {:.2?}, {} impacts {} events {} slices, capped {}, unexplained {:.1e}, deepest {deepest:.1e}, \
         ever {:.1e}",
        world.time(),
        start.elapsed(),
        world.impact_count(),
        world.event_count(),
        world.slice_count(),
        ledger.capped,
        ledger.unexplained(),
        ledger.overlap
    );
    assert_eq!(stop, Stop::Rest);
    assert!(ledger.pass(), "{ledger:?}");
    assert!(deepest < 1e-6 && ledger.overlap < 1e-6, "{deepest:e} {:e}", ledger.overlap);
}

#[test]
fn a_poured_heap_comes_to_rest() {
    for (n, e) in [(10, 0.5), (100, 0.5), (100, 0.9)] {
        comes_to_rest(&format!("{n} discs, e = {e}"), pour(n, e));
    }
    // Without friction a single ball may slide for ever, faster than the speed of rest: 60 spheres at 0.5 leave one at 1e-8 m/s.
    for (n, e) in [(64, 0.5), (60, 0.9)] {
        comes_to_rest(&format!("{n} spheres, e = {e}"), pour_spheres(n, e));
    }
}

/// By hand, in release: minutes.
#[test]
#[ignore = "minutes"]
fn a_large_heap_comes_to_rest() {
    for (n, e) in [(400, 0.5), (1000, 0.5), (1000, 0.9)] {
        comes_to_rest(&format!("{n} discs, e = {e}"), pour(n, e));
    }
    for (n, e) in [(500, 0.5), (500, 0.9)] {
        comes_to_rest(&format!("{n} spheres, e = {e}"), pour_spheres(n, e));
    }
}

/// Seen at t = 0.073 s of 400 discs: a free disc touched one of an island and parted from it faster than those that join. The
/// island's own impacts, at the start of its next slice, threw its disc back at the free one, which nobody looked at; the meeting
/// was cut back to the start of the slice, behind the clock, and the two ended 1e-3 of a radius inside each other.
#[test]
fn a_disc_that_parts_from_an_island_is_not_run_into() {
    let mut world = pour(400, 0.5);
    world.run(&Limits { time: Some(0.1), ..Limits::default() });
    let ledger = world.ledger();
    println!("{} slices, overlap {:e}, capped {}", world.slice_count(), ledger.overlap, ledger.capped);
    assert!(ledger.overlap < 1e-6 && ledger.capped == 0);
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
