//! Friction and spin in a world: impacts on rough walls, sliding and rolling, slopes, and the accounts behind them.
use carom::{Ball, Limits, Material, Party, Rotates, Stop, Vector, Wall, World};

const G: f64 = 9.81;

/// A world with one material, and a floor through the origin under a slope's angle: down is -z (or -y), the floor's normal is
/// (sin, 0, cos).
fn floor3(said: Material, angle: f64) -> (World<3>, Vector<3>) {
    let mut world = World::<3>::new().gravity([0.0, 0.0, -G]);
    world.set_default_material(said).unwrap();
    let normal = Vector([angle.sin(), 0.0, angle.cos()]);
    world.wall(Wall::plane([0.0; 3], normal));
    (world, normal)
}

fn floor2(said: Material, angle: f64) -> (World<2>, Vector<2>) {
    let mut world = World::<2>::new().gravity([0.0, -G]);
    world.set_default_material(said).unwrap();
    let normal = Vector([angle.sin(), angle.cos()]);
    world.wall(Wall::plane([0.0; 2], normal));
    (world, normal)
}

fn plastic(mu: f64) -> Material {
    Material::new().restitution(0.0).friction(mu)
}

fn close(what: &str, got: f64, want: f64, tolerance: f64) {
    println!("{what:40} got {got:24.17} expected {want:24.17} error {:9.2e}", got - want);
    assert!((got - want).abs() <= tolerance, "{what}: {got} instead of {want}");
}

fn closes<const D: usize>(world: &World<D>)
where
    Vector<D>: Rotates,
{
    let ledger = world.ledger();
    assert!(ledger.unexplained() < 1e-12, "{ledger:#?}");
    assert_eq!(ledger.capped, 0);
}

/// THEORY 2.2, exact: a solid ball m = R = 1 on a floor, (vx, vz, wy) before and after.
#[test]
fn one_bounce_of_a_rough_ball() {
    let cases = [
        ([3.0, -2.0, 0.0], 0.5, 0.0, 10.0, [15.0 / 7.0, 1.0, 15.0 / 7.0], 39.0 / 14.0),
        ([3.0, -2.0, 0.0], 0.5, 0.0, 0.1, [2.7, 1.0, 0.75], 897.0 / 400.0),
        ([3.0, -2.0, 0.0], 1.0, 1.0, 10.0, [9.0 / 7.0, 2.0, 30.0 / 7.0], 0.0),
        ([0.0, -2.0, 5.0], 0.8, 0.0, 10.0, [10.0 / 7.0, 1.6, 10.0 / 7.0], 751.0 / 175.0),
        ([7.0, -1.0, 0.0], 0.0, 0.0, 0.25, [6.75, 0.0, 0.625], 137.0 / 64.0),
        ([7.0, -1.0, 0.0], 0.0, 0.0, 3.0, [5.0, 0.0, 5.0], 7.5),
    ];
    for (before, e, e_t, mu, after, lost) in cases {
        let said = Material::new().restitution(e).tangential(e_t).friction(mu);
        let mut world = World::<3>::new();
        world.set_default_material(said).unwrap();
        world.wall(Wall::plane([0.0; 3], [0.0, 0.0, 1.0]));
        let ball = Ball::new(1.0, 1.0).at([0.0, 0.0, 2.0]).moving([before[0], 0.0, before[1]]);
        let ball = world.ball(ball.spinning([0.0, before[2], 0.0]));
        let impact = world.advance_to_next(10.0)[0];
        let (v, w) = (world.velocity(ball).unwrap(), world.spin(ball).unwrap());
        close("vx", v[0], after[0], 1e-14 * 8.0);
        close("vz", v[2], after[1], 1e-14 * 8.0);
        close("wy", w[1], after[2], 1e-14 * 8.0);
        close("lost", impact.lost, lost, 1e-13);
        assert!(matches!(impact.parties, [Party::Body(_), Party::Wall(_)]));
        assert!(impact.friction_impulse.norm() <= mu * impact.impulse * (1.0 + 1e-14));
        // The impulse on the ball is what changed it.
        let push = -(impact.normal * impact.impulse) - impact.friction_impulse;
        assert!((impact.before[0].velocity + push - v).norm() < 1e-14);
        closes(&world);
    }
}

/// Garwin (1969): a superball thrown under a table comes back. Floor, underside, floor: vx = 3/7, -31/49, -333/343.
#[test]
fn a_superball_comes_back_from_under_a_table() {
    let mut world = World::<3>::new();
    world.set_default_material(Material::new().restitution(1.0).tangential(1.0).friction(10.0)).unwrap();
    world.wall(Wall::plane([0.0; 3], [0.0, 0.0, 1.0]));
    world.wall(Wall::plane([0.0, 0.0, 4.0], [0.0, 0.0, -1.0]));
    let ball = world.ball(Ball::new(1.0, 1.0).at([0.0, 0.0, 2.0]).moving([1.0, 0.0, -2.0]));
    for (vx, wy) in [(3.0 / 7.0, 10.0 / 7.0), (-31.0 / 49.0, -60.0 / 49.0), (-333.0 / 343.0, -130.0 / 343.0)] {
        world.advance_to_next(100.0);
        close("vx", world.velocity(ball).unwrap()[0], vx, 1e-14);
        close("wy", world.spin(ball).unwrap()[1], wy, 1e-14);
    }
    closes(&world);
}

/// A solid sphere that starts to slide at v0 rolls after 2 v0 / (7 mu g), at 5/7 v0; what it lost is 1/7 of m v0^2.
#[test]
fn slides_then_rolls() {
    let (mu, v0) = (0.2, 3.0);
    let (mut world, _) = floor3(plastic(mu), 0.0);
    let ball = world.ball(Ball::new(2.0, 0.1).at([0.0, 0.0, 0.1]).moving([v0, 0.0, 0.0]));
    let t = 2.0 * v0 / (7.0 * mu * G);
    world.advance_to(0.5 * t);
    close("speed half-way", world.velocity(ball).unwrap()[0], v0 - 0.5 * mu * G * t, 1e-13);
    close("spin half-way", world.spin(ball).unwrap()[1], 2.5 * mu * G * 0.5 * t / 0.1, 1e-12);
    closes(&world);
    world.advance_to(t * (1.0 + 1e-9));
    close("speed", world.velocity(ball).unwrap()[0], v0 * 5.0 / 7.0, 1e-13);
    close("way", world.position(ball).unwrap()[0], v0 * t - 0.5 * mu * G * t * t, 1e-8);
    world.advance_to(5.0);
    close("speed later", world.velocity(ball).unwrap()[0], v0 * 5.0 / 7.0, 1e-13);
    close("rolls", world.spin(ball).unwrap()[1], v0 * 5.0 / 7.0 / 0.1, 1e-12);
    close("lost", world.ledger().energy.lost, v0 * v0 * 2.0 / 7.0, 1e-12);
    closes(&world);
}

/// Backspin: angular momentum about the point of contact decides, v = (5 v0 + 2 R w) / 7; a ball with enough of it comes back.
#[test]
fn backspin_turns_a_ball_round() {
    for (v0, w) in [(2.0, -100.0), (2.0, -50.0), (2.0, 30.0), (0.0, 40.0)] {
        let (mut world, _) = floor3(plastic(0.3), 0.0);
        let ball = Ball::new(0.17, 0.03).at([0.0, 0.0, 0.03]).moving([v0, 0.0, 0.0]).spinning([0.0, w, 0.0]);
        let ball = world.ball(ball);
        world.advance_to(10.0);
        let want = (5.0 * v0 + 2.0 * 0.03 * w) / 7.0;
        close("speed", world.velocity(ball).unwrap()[0], want, 1e-13);
        close("spin", world.spin(ball).unwrap()[1], want / 0.03, 1e-11);
        closes(&world);
    }
}

/// A slope of angle A: a sphere rolls at 5/7 g sin A if tan A <= 7/2 mu, and else slides at g (sin A - mu cos A); a disc in
/// the plane rolls at 2/3 g sin A up to tan A = 3 mu.
#[test]
fn rolls_or_slides_down_a_slope() {
    let mu: f64 = 0.2;
    for (angle, steep3) in
        [(0.2, false), ((3.5f64 * mu).atan() - 1e-6, false), ((3.5f64 * mu).atan() + 1e-6, true), (0.9, true)]
    {
        let (mut world, normal) = floor3(plastic(mu), angle);
        let ball = world.ball(Ball::new(1.0, 0.1).at(normal * 0.1));
        world.advance_to(2.0);
        let downhill = Vector([angle.cos(), 0.0, -angle.sin()]);
        let a = if steep3 { G * (angle.sin() - mu * angle.cos()) } else { G * angle.sin() * 5.0 / 7.0 };
        close("speed of a sphere", world.velocity(ball).unwrap().dot(downhill), 2.0 * a, 1e-12);
        let turn = if steep3 { 2.5 * mu * G * angle.cos() * 2.0 / 0.1 } else { 2.0 * a / 0.1 };
        close("its spin", world.spin(ball).unwrap()[1], turn, 1e-11);
        close("its way", world.position(ball).unwrap().dot(downhill), 2.0 * a, 1e-12);
        closes(&world);
        let steep2 = angle.tan() > 3.0 * mu;
        let (mut world, normal) = floor2(plastic(mu), angle);
        let ball = world.ball(Ball::new(1.0, 0.1).at(normal * 0.1));
        world.advance_to(2.0);
        let a = if steep2 { G * (angle.sin() - mu * angle.cos()) } else { G * angle.sin() * 2.0 / 3.0 };
        close("speed of a disc", world.velocity(ball).unwrap().norm(), 2.0 * a, 1e-12);
        closes(&world);
    }
}

/// Rolling resistance: the ball slows down by c g and stops after v^2 / (2 c g). Spinning friction: a moment s N R.
#[test]
fn a_rolling_and_a_spinning_ball_come_to_rest() {
    let (c, s, v, w) = (0.01, 0.02, 1.5, 20.0);
    let (mut world, _) = floor3(Material { rolling: Some(c), spinning: Some(s), ..plastic(0.2) }, 0.0);
    let ball = Ball::new(1.0, 0.05).at([0.0, 0.0, 0.05]).moving([v, 0.0, 0.0]).spinning([0.0, v / 0.05, w]);
    let ball = world.ball(ball);
    let ends = w * 0.4 * 0.05 / (s * G);
    world.advance_to(0.5 * ends);
    close("spin about the vertical", world.spin(ball).unwrap()[2], 0.5 * w, 1e-12);
    let stop = world.run(&carom::world::Limits { time: Some(100.0), rest: true, ..Default::default() });
    assert_eq!(stop, carom::world::Stop::Rest);
    close("when", world.time(), (v / (c * G)).max(ends), 1e-11);
    close("where", world.position(ball).unwrap()[0], v * v / (2.0 * c * G), 1e-11);
    assert_eq!(world.velocity(ball).unwrap(), Vector([0.0; 3]));
    assert_eq!(world.spin(ball).unwrap(), Vector([0.0; 3]));
    close("lost", world.ledger().energy.lost, 0.5 * v * v * 1.4 + 0.5 * 0.4 * 0.0025 * w * w, 1e-13);
    closes(&world);
}

/// A ball that slides across a slope: no closed form, so an independent integration (Runge-Kutta, 200,000 steps) in the test.
/// Arcs of 0.01 rad make an error of about 0.01^2.
#[test]
fn slides_across_a_slope() {
    let (angle, mu, v0, end) = (0.3f64, 0.25, 2.0, 0.4);
    let (mut world, normal) = floor3(plastic(mu), angle);
    let ball = world.ball(Ball::new(1.0, 0.1).at(normal * 0.1).moving([0.0, v0, 0.0]));
    world.advance_to(end);
    let downhill = Vector([angle.cos(), 0.0, -angle.sin()]);
    let v = world.velocity(ball).unwrap();
    // (velocity, slip) in the slope's own axes, downhill and across.
    let rate = |u: [f64; 2]| {
        let size = u[0].hypot(u[1]);
        let push = if size > 1e-12 { mu * G * angle.cos() / size } else { 0.0 };
        let force = [-push * u[0], -push * u[1]];
        ([G * angle.sin() + force[0], force[1]], [G * angle.sin() + 3.5 * force[0], 3.5 * force[1]])
    };
    let (mut vel, mut u) = ([0.0, v0], [0.0, v0]);
    let steps = 200_000;
    let h = end / f64::from(steps);
    for _ in 0..steps {
        let shifted = |k: ([f64; 2], [f64; 2]), f: f64| [u[0] + k.1[0] * h * f, u[1] + k.1[1] * h * f];
        let k1 = rate(u);
        let k2 = rate(shifted(k1, 0.5));
        let k3 = rate(shifted(k2, 0.5));
        let k4 = rate(shifted(k3, 1.0));
        for j in 0..2 {
            vel[j] += h / 6.0 * (k1.0[j] + 2.0 * k2.0[j] + 2.0 * k3.0[j] + k4.0[j]);
            u[j] += h / 6.0 * (k1.1[j] + 2.0 * k2.1[j] + 2.0 * k3.1[j] + k4.1[j]);
        }
    }
    close("downhill", v.dot(downhill), vel[0], 2e-4);
    close("across", v[1], vel[1], 2e-4);
    closes(&world);
}

/// Throw: two equal balls meet half full. The law of rough spheres by hand: J = (1 + e) m u / 2, and the tangential impulse is the
/// smaller of mu J and m_t (1 + e_t) s with m_t = m / (2 (1 + 1/kappa)). All three laws say so (with e_t = 0), in the world as well.
#[test]
fn two_balls_throw_each_other() {
    let (m, r, e): (f64, f64, f64) = (0.17, 0.0286, 0.95);
    for (mu, spin) in [(0.06, 0.0), (0.06, 40.0), (0.06, -40.0), (5.0, 0.0), (5.0, 25.0)] {
        for law in carom::Law::ALL {
            let mut world = World::<2>::new().law(law);
            world.set_default_material(Material::new().restitution(e).friction(mu)).unwrap();
            let cue = Ball::new(m, r).inertia(0.4).at([-1.0, r]).moving([1.0, 0.0]).spinning([spin]);
            let (cue, object) = (world.ball(cue), world.ball(Ball::new(m, r).inertia(0.4)));
            let impact = world.advance_to_next(10.0)[0];
            // The line of centres falls by 30 degrees to the right; across it to the left of that, (1/2, sqrt 3 / 2).
            let (n, t) = (Vector([0.75f64.sqrt(), -0.5]), Vector([0.5, 0.75f64.sqrt()]));
            let j = (1.0 + e) * m * 0.75f64.sqrt() / 2.0;
            let slip = 0.5 + r * spin;
            let most = m / 7.0 * slip.abs();
            let side = slip.signum() * most.min(mu * j);
            close("J", impact.impulse, j, 1e-14);
            close("friction", impact.friction_impulse.dot(t), side, 1e-14);
            let v = (n * j + t * side) * (1.0 / m);
            assert!((world.velocity(object).unwrap() - v).norm() < 1e-13, "{law:?}");
            close("spin of the object", world.spin(object).unwrap()[0], -r * side / (0.4 * m * r * r), 1e-10);
            close("spin of the cue ball", world.spin(cue).unwrap()[0], spin - r * side / (0.4 * m * r * r), 1e-10);
            closes(&world);
        }
    }
}

/// A belt that runs at V under a ball at rest drags it along: it slides for 2 V / (7 mu g) and then rolls, seen from the belt, as one
/// that was thrown at -V: its speed is V (1 - 5/7). The belt does the work that friction takes, and that the ball has got.
#[test]
fn a_belt_drags_a_ball_along() {
    let (mu, belt) = (0.3, 2.0);
    let mut world = World::<3>::new().gravity([0.0, 0.0, -G]);
    world.set_default_material(plastic(mu)).unwrap();
    world.wall(Wall::plane([0.0; 3], [0.0, 0.0, 1.0]).moving([belt, 0.0, 0.0]));
    let ball = world.ball(Ball::new(2.0, 0.1).at([0.0, 0.0, 0.1]));
    world.advance_to(3.0);
    close("speed", world.velocity(ball).unwrap()[0], belt * 2.0 / 7.0, 1e-13);
    close("spin", world.spin(ball).unwrap()[1], -(belt * 5.0 / 7.0) / 0.1, 1e-12);
    let energy = world.ledger().energy;
    // From the belt's frame: 2/7 of m V^2 / 2 is lost. Momentum m (2/7) V given at speed V is the work.
    close("lost", energy.lost, 2.0 * belt * belt / 7.0, 1e-12);
    close("work", energy.work, 2.0 * (2.0 / 7.0) * belt * belt, 1e-12);
    closes(&world);
}

/// Pool: half full, smooth balls, e = 1. A sliding cue ball leaves at 90 degrees to the object ball; a rolling one, once it rolls
/// again, at atan(sin 30 cos 30 / (sin^2 30 + 2/5)) = 33.67 degrees to its first line.
#[test]
fn the_rules_of_ninety_and_thirty_degrees() {
    for rolling in [false, true] {
        let mut world = World::<3>::new().gravity([0.0, 0.0, -G]);
        let cloth = world.material(Material::new().restitution(0.0)).unwrap();
        let ball = world.material(Material::new().restitution(1.0)).unwrap();
        world.pair(ball, cloth, Material::new().restitution(0.0).friction(0.2)).unwrap();
        world.wall(Wall::plane([0.0; 3], [0.0, 0.0, 1.0]).material(cloth));
        let r = 0.0286;
        let new = |x: f64, y: f64| Ball::new(0.17, r).at([x, y, r]).material(ball);
        let cue = new(-2.01 * r, r).moving([2.0, 0.0, 0.0]);
        let cue = world.ball(if rolling { cue.spinning([0.0, 2.0 / r, 0.0]) } else { cue });
        let object = world.ball(new(0.0, 0.0));
        while world.velocity(object).unwrap().norm() == 0.0 {
            world.advance_to_next(1.0);
        }
        let (a, b) = (world.velocity(cue).unwrap(), world.velocity(object).unwrap());
        if !rolling {
            // It slid for a hundredth of a radius, which its spin does not show before the impact.
            close("90 degrees", a.dot(b) / (a.norm() * b.norm()), 0.0, 1e-12);
            continue;
        }
        world.advance_to(world.time() + 2.0);
        let v = world.velocity(cue).unwrap();
        let want = (30f64.to_radians().sin() * 30f64.to_radians().cos()) / (0.25 + 0.4);
        close("tangent of the angle", v[1] / v[0], want, 1e-9);
        closes(&world);
    }
}

/// A rough bowl: a disc that rolls from rest without slip has, after a drop h, v^2 = 2 g h / (1 + kappa). By slices, which lose O(h).
#[test]
fn a_disc_rolls_in_a_bowl() {
    let mut world = World::<2>::new().gravity([0.0, -G]);
    world.set_default_material(plastic(1.0)).unwrap();
    world.wall(Wall::arc([0.0, 0.0], 1.0, std::f64::consts::PI, std::f64::consts::TAU));
    let (r, way) = (0.05, 0.95);
    let start = 20f64.to_radians();
    let ball = world.ball(Ball::new(1.0, r).at([way * start.sin(), -way * start.cos()]));
    let mut fastest = 0.0f64;
    for _ in 0..1000 {
        world.advance(1e-3);
        let (v, w) = (world.velocity(ball).unwrap(), world.spin(ball).unwrap()[0]);
        fastest = fastest.max(v.norm());
        // Once it moves, it rolls: v = R |w|.
        assert!((v.norm() - r * w.abs()).abs() < 2e-3, "{v:?} {w}");
    }
    let want = (2.0 * G * way * (1.0 - start.cos()) / 1.5f64).sqrt();
    println!("fastest {fastest} expected {want}");
    assert!(fastest <= want * (1.0 + 1e-3) && fastest > want * 0.99);
    assert!(world.ledger().pass());
}

/// One cylinder on two that touch each other stands if mu >= tan 15 = 2 - sqrt 3 = 0.26795, and rolls them apart if it is less. The
/// upper one pushes on each of the others where they touch, at 30 degrees off the vertical, with half its weight; in balance that
/// force points at the foot of the lower cylinder, 15 degrees off the line of centres. (The floor needs a third of that mu.)
#[test]
fn three_cylinders_stand_with_enough_friction() {
    let edge = 2.0 - 3f64.sqrt();
    for (mu, stands) in [(0.1, false), (edge - 1e-3, false), (edge + 1e-3, true), (2.0, true)] {
        let mut world = World::<2>::new().gravity([0.0, -G]);
        world.set_default_material(plastic(mu)).unwrap();
        world.wall(Wall::plane([0.0, 0.0], [0.0, 1.0]));
        let r = 0.1;
        world.ball(Ball::new(1.0, r).at([-r, r]));
        world.ball(Ball::new(1.0, r).at([r, r]));
        let top = world.ball(Ball::new(1.0, r).at([0.0, r + 3f64.sqrt() * r]));
        let height = world.position(top).unwrap()[1];
        world.advance_to(2.0);
        let sunk = height - world.position(top).unwrap()[1];
        println!("mu {mu}: the upper one sank by {sunk:e} m; {} slices", world.slice_count());
        assert!(if stands { sunk < 1e-9 } else { sunk > r }, "mu = {mu}: sunk by {sunk}");
        assert!(world.ledger().pass());
    }
}

/// One call or a thousand: the same bits, with balls that slide, roll, spin, throw each other, and lie in slices.
#[test]
fn frames_do_not_change_a_bit() {
    let run = |frames: u32| {
        let said =
            Material { rolling: Some(0.01), spinning: Some(0.02), ..Material::new().restitution(0.7).friction(0.2) };
        let (mut world, _) = floor3(said, 0.0);
        world.wall(Wall::plane([2.0, 0.0, 0.0], [-1.0, 0.0, 0.0]));
        for k in 0..6 {
            let ball =
                Ball::new(0.2, 0.05).at([0.3 * f64::from(k), 0.02 * f64::from(k), 0.05 + 0.1 * f64::from(k % 3)]);
            world.ball(ball.moving([2.0 - f64::from(k), 0.1, 0.0]).spinning([3.0, 20.0 - 9.0 * f64::from(k), 5.0]));
        }
        for k in 1..=frames {
            world.advance_to(3.0 * f64::from(k) / f64::from(frames));
        }
        assert!(world.ledger().pass());
        world.digest()
    };
    let once = run(1);
    assert_eq!((run(7), run(1000)), (once, once));
}

/// Discs poured on a floor: with friction and resistance to rolling they come to rest as a heap that closes its accounts; without, not
/// one stays on another, since nothing holds the lowest ones together.
#[test]
fn a_heap_stands_at_a_slope() {
    let poured = |mu: f64, rolling: f64| {
        let r = 0.01;
        let mut world = World::<2>::new().gravity([0.0, -G]);
        world.set_default_material(plastic(mu).rolling(rolling)).unwrap();
        world.wall(Wall::plane([0.0, 0.0], [0.0, 1.0]));
        let mut discs = Vec::new();
        for k in 0..24 {
            let x = r * (k as f64 * 78.233).sin();
            let top = discs.iter().map(|&id| world.position(id).unwrap()).filter(|p| (p[0] - x).abs() < 2.5 * r);
            let y = top.map(|p| p[1]).fold(0.0, f64::max) + 3.0 * r;
            let radius = r * (1.0 + 0.2 * (k as f64 * 12.9898).sin());
            discs.push(world.ball(Ball::new(1.0, radius).at([x, y])));
            world.advance(0.12);
        }
        let stop = world.run(&Limits { time: Some(world.time() + 10.0), rest: true, ..Limits::default() });
        assert!(world.ledger().pass(), "{:?}", world.ledger());
        let high = discs.iter().map(|&id| world.position(id).unwrap()[1]).fold(0.0, f64::max);
        (stop, high / r)
    };
    let (stop, high) = poured(0.5, 0.1);
    assert!(stop == Stop::Rest && high > 4.0, "{stop:?}, {high} radii high");
    let (_, high) = poured(0.0, 0.0);
    assert!(high <= 1.2, "{high} radii high");
}
