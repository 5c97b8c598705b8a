//! Balls: the closed form of Walton and Luding is the default law, and keeps what it promises at any ratio of masses.
use carom::law::rough::{self, Turning};
use carom::law::smooth;
use carom::law::{Contact, Law, Side};
use carom::material::Coefficients;
use carom::{Rotates, Vector};

use crate::draw::{self, Draw, Shapes, cases};

fn as_bodies<const D: usize>(balls: &[Turning<D>; 2], normal: Vector<D>) -> Contact<D>
where
    Vector<D>: Rotates,
{
    let side = |ball: &Turning<D>, sign: f64| {
        if ball.radius > 0.0 {
            let m = &ball.moving;
            Side::ball(m.inverse_mass, ball.radius, ball.kappa, m.velocity, ball.spin, normal * (sign * ball.radius))
        } else {
            Side::driven(ball.moving.velocity)
        }
    };
    Contact { normal, sides: [side(&balls[0], 1.0), side(&balls[1], -1.0)] }
}

fn approaching<const D: usize>(draw: &mut Draw) -> ([Turning<D>; 2], Vector<D>)
where
    Vector<D>: Shapes,
{
    let balls = draw::balls::<D>(draw);
    let n = draw.unit::<D>();
    let approach = (balls[0].moving.velocity - balls[1].moving.velocity).dot(n);
    (balls, if approach < 0.0 { -n } else { n })
}

fn the_two_agree<const D: usize>(seed: u64, number: u64)
where
    Vector<D>: Shapes,
{
    let mut draw = Draw::new(seed);
    let mut worst = [0.0f64; 2];
    for n in 0..number {
        let (balls, normal) = approaching::<D>(&mut draw);
        let c = draw.coefficients();
        let contact = as_bodies(&balls, normal);
        // Relative to the speeds of the surfaces: where the two nearly cancel in the slip, no form keeps its digits.
        let speed: f64 =
            contact.sides.iter().map(|s| s.velocity.norm() + Vector::<D>::turned(s.spin, s.arm).norm()).sum();
        let scale = 4.0 * speed / contact.sides.iter().map(|s| s.inverse_mass).sum::<f64>();
        let want = rough::impulse(&balls[0], &balls[1], normal, c);
        let got = Law::ChatterjeeRuina.impulse(&contact, c);
        worst[0] = worst[0].max((got - want).norm() / scale);
        assert!((got - want).norm() <= 1e-14 * scale, "pair {n}: {got:?} {want:?}");
        // Coulomb's law through the impact gives the same with e_t = 0: nothing couples the directions.
        let rolls = Coefficients { tangential: 0.0, ..c };
        let want = rough::impulse(&balls[0], &balls[1], normal, rolls);
        for law in [Law::Stronge, Law::Newton] {
            let course = law.course(&contact, rolls);
            worst[1] = worst[1].max((course.impulse - want).norm() / scale);
            assert_eq!(course.steps, 0, "pair {n}: a ball's slip keeps its line");
            assert!(
                (course.impulse - want).norm() <= 1e-13 * scale,
                "pair {n}, {law:?}: {:?} {want:?}",
                course.impulse
            );
        }
    }
    println!("{D}D: {number} pairs of balls, default {:.1e}, Stronge and Newton {:.1e}", worst[0], worst[1]);
}

/// The oracle: two derivations, one answer.
#[test]
fn for_balls_every_law_is_walton_and_luding_s() {
    the_two_agree::<2>(21, cases(20_000));
    the_two_agree::<3>(22, cases(20_000));
}

fn what_balls_keep<const D: usize>(seed: u64, number: u64)
where
    Vector<D>: Shapes,
{
    let mut draw = Draw::new(seed);
    for n in 0..number {
        let (before, normal) = approaching::<D>(&mut draw);
        let c = draw.coefficients();
        let along = normal * draw.magnitude(-3.0, 3.0);
        let [push, across] = rough::parts(&before[0], &before[1], along, c);
        // Its normal part is the lecture's, to the bit, and its friction lies on it or in the cone.
        assert_eq!(push, smooth::impulse(&before[0].moving, &before[1].moving, along, c.restitution));
        assert!(across.norm() <= c.friction * push.norm() * (1.0 + 4.0 * f64::EPSILON));
        let [mut a, mut b] = before;
        rough::exchange(&mut a, &mut b, along, [push, across]);
        assert!(across != Vector::ZERO || (a.spin, b.spin) == (before[0].spin, before[1].spin));
        let (r, s) = (before[0].moving.velocity - before[1].moving.velocity, a.moving.velocity - b.moving.velocity);
        let spins = |p: &Turning<D>| Vector::<D>::spin_dot(p.spin, p.spin).sqrt() * p.radius;
        let speed = r.norm() + s.norm() + [before[0], before[1], a, b].iter().map(spins).sum::<f64>();
        // e: one rounding of each product and sum of the exchange, a dozen in all.
        assert!((s.dot(normal) + c.restitution * r.dot(normal)).abs() <= 12.0 * f64::EPSILON * speed, "pair {n}: e");
        // The slip ends between -e_t times itself (stick) and itself.
        let (first, last) = (rough::slip(&before[0], &before[1], along), rough::slip(&a, &b, along));
        let room = 50.0 * f64::EPSILON * speed;
        let share = if c.friction > 0.0 { last.dot(first) } else { first.norm_squared() };
        assert!(share >= -c.tangential.max(0.0) * first.norm_squared() - room * speed, "pair {n}: slip");
        assert!(last.norm() <= first.norm() + room, "pair {n}: slip grows");
        // Energy, as P.(u + u')/2 at the contact.
        let u = |r: Vector<D>, slip: Vector<D>| normal * r.dot(normal) + slip;
        let lost = 0.5 * (push + across).dot(u(r, first) + u(s, last));
        assert!(lost >= -50.0 * f64::EPSILON * speed * (push + across).norm(), "pair {n} gains {}", -lost);
        if before[1].moving.inverse_mass == 0.0 {
            assert_eq!(b, before[1], "what cannot be moved keeps its bits");
        }
    }
}

/// Mass ratios to 1e12, radii to 100 : 1, lines of centres of any length.
#[test]
fn balls_keep_e_the_cone_and_the_energy() {
    what_balls_keep::<2>(23, cases(100_000));
    what_balls_keep::<3>(24, cases(100_000));
}

/// A solid sphere against a wall weighs 2/7 m across the normal, a disc m/3, a shell 2/5 m.
#[test]
fn what_a_ball_weighs_across_the_normal() {
    for (kappa, want) in [(0.4, 2.0 / 7.0), (0.5, 1.0 / 3.0), (2.0 / 3.0, 0.4)] {
        let ball = Turning::<2> { moving: smooth::Moving::new(3.0, [0.0; 2]), spin: Vector([0.0]), radius: 0.7, kappa };
        let mass = 1.0 / rough::inverse_tangential_mass(&ball, &Turning::wall([0.0; 2]));
        assert!((mass - 3.0 * want).abs() < 1e-15 * 3.0);
    }
}
