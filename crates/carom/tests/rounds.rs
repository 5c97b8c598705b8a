//! Periodic boxes and bodies that go round them more often, or faster, than numbers can tell: runs end, and say so.
use carom::{Ball, Boundary, Error, Limits, Stop, World};

fn until(time: f64) -> Limits<'static> {
    Limits { time: Some(time), ..Limits::default() }
}

fn ring(width: f64) -> World<1> {
    World::<1>::new().boundary(Boundary::periodic([0.0], [width]))
}

/// Seen by the fuzzer: a body that goes round between two neighbouring numbers of the clock crossed cells at one instant, for ever.
#[test]
fn who_goes_round_faster_than_the_clock_stops_the_run() {
    for speed in [1e19, 1e100, -1e154, 1e300] {
        let mut world = ring(8.0);
        world.advance(1.0);
        // At 1 s neighbouring numbers of the clock are 2.2e-16 s apart: 2,000 m at the slowest of these speeds.
        let a = world.ball(Ball::new(1.0, 0.1).at([1.0]).moving([speed]));
        let b = world.ball(Ball::new(1.0, 0.1).at([3.0]));
        world.ignore(a, b, true).expect("both are there");
        world.add(Ball::new(1.0, 0.1).at([5.0]).sensor()).expect("there is room");
        assert_eq!(world.run(&until(2.0)), Stop::NotFinite, "{speed:e} m/s");
        assert!(world.time() < 1.0 + 1e-14, "the clock stands where it can no longer be told");
        assert_eq!(world.run(&until(2.0)), Stop::NotFinite, "and it stays so");
    }
}

/// The same in space, with a driven body, as the fuzzer had it.
#[test]
fn a_driven_body_too_fast_for_its_box() {
    let mut world = World::<3>::new().boundary(Boundary::periodic([-4.0; 3], [4.0; 3]));
    world.advance(0.03);
    world.add(Ball::fixed(0.421875).at([3.9375, 5e-324, 1.375]).moving([1e100, 1e-30, 3.75])).expect("sound");
    world.add(Ball::new(1.0, 0.1).at([0.0; 3]).sensor()).expect("sound");
    assert_eq!(world.run(&until(1.0)), Stop::NotFinite);
}

/// Just slow enough: 1e12 m/s in a box of 8 m are 1.25e11 rounds a second, and the first impact is where it must be.
#[test]
fn a_fast_ball_that_meets_something_is_no_trouble() {
    let mut world = ring(8.0);
    world.ball(Ball::new(1.0, 0.5).at([1.0]).moving([1e12]));
    let fixed = world.add(Ball::fixed(0.5).at([5.0])).expect("sound");
    let impacts = world.advance_to_next(1.0);
    assert_eq!(impacts.len(), 1);
    // 3 m between the surfaces, to an ulp or two.
    assert!((impacts[0].time - 3e-12).abs() < 2e-27, "{:e}", impacts[0].time);
    assert_eq!(world.position(fixed).expect("it is there")[0], 5.0);
}

/// Alone it needs no crossings: 8,388,608 rounds in a few hundred events, to where it must be, and it meets there who comes later.
#[test]
fn alone_in_a_periodic_box_it_coasts() {
    let mut world = ring(1.0);
    let speed = f64::from(1 << 20);
    let ball = world.ball(Ball::new(1.0, 0.125).at([0.25]).moving([speed]));
    assert_eq!(world.run(&until(8.0)), Stop::Quiet);
    assert_eq!(world.time(), 8.0);
    assert!(world.event_count() < 1_000, "{} events", world.event_count());
    // All of these are whole multiples of powers of two: no rounding.
    assert_eq!(world.position(ball).expect("it is there")[0], 0.25);
    assert_eq!(world.unwrapped_position(ball).expect("it is there")[0], 0.25 + 8.0 * speed);
    world.add(Ball::fixed(0.125).at([0.75])).expect("there is room");
    let next = world.advance_to_next(9.0)[0].time;
    assert_eq!(next, 8.0 + 0.25 / speed);
}

/// Sensors are told of whoever passes, alone or not.
#[test]
fn a_sensor_is_told_of_every_round() {
    let mut world = ring(1.0);
    world.ball(Ball::new(1.0, 0.125).at([0.25]).moving([1.0]));
    world.add(Ball::new(1.0, 0.125).at([0.75]).sensor()).expect("there is room");
    world.run(&until(400.5));
    assert_eq!(world.touches().len(), 401);
}

/// Seen by the fuzzer: a ball at 1e300 m could not be taken back into a box of 8 m, and crossed its edge for ever.
#[test]
fn what_lies_too_many_widths_away_is_refused() {
    let mut world = ring(8.0);
    for x in [1e300, -1e154, 8.1e9] {
        let refused = world.add(Ball::new(1.0, 0.1).at([x]));
        assert!(matches!(refused, Err(Error::Boundary(_))), "{x:e}: {refused:?}");
    }
    let ball = world.ball(Ball::new(1.0, 0.1).at([7.9e9 + 1.0]).moving([1.0]));
    assert_eq!(world.position(ball).expect("it is there")[0], 1.0, "7.9e9 + 1 is 987,500,000 widths and 1");
    assert!(matches!(world.set_position(ball, [1e300]), Err(Error::Boundary(_))));
    // Along an axis that does not close, far is far.
    let mut strip =
        World::<2>::new().boundary(Boundary::walls([0.0, f64::NEG_INFINITY], [1.0, f64::INFINITY]).closed_along(0));
    assert!(strip.add(Ball::new(1.0, 0.1).at([0.5, 1e300]).moving([1.0, 0.0])).is_ok());
    assert_eq!(strip.run(&until(1.0)), Stop::Quiet);
}

/// Dense enough for lists of neighbours, which are left behind at every instant by who is faster than the clock: it flies away.
#[test]
fn lists_are_left_for_who_is_faster_than_the_clock() {
    let mut world = World::<2>::new();
    world.advance(1.0);
    for i in 0..400 {
        let at = [f64::from(i % 20) * 1.02, f64::from(i / 20) * 1.02];
        let ball = Ball::new(1.0, 0.5).at(at);
        world.ball(if i == 399 { ball.moving([1e18, 0.0]) } else { ball });
    }
    assert_eq!(world.run(&until(2.0)), Stop::Quiet);
    assert_eq!(world.impact_count(), 0);
}
