//! What holds of every impact, law by law: 100,000 random ones each (fewer where the law integrates).
use carom::law::routh::{STEPS, Slip, TOLERANCE};
use carom::law::{Contact, Law};
use carom::material::Coefficients;
use carom::{Rotates, Vector};

use crate::draw::{self, Draw, Shapes, cases};

/// What a rounding of u, of K or of P may change, relative to the largest number in it. The relative motion is computed from
/// a dozen products (1e-15); K of the shapes drawn has a condition below 1 + 1.5^2/0.02 (about 100), which is how much of it
/// reaches the impulse.
const ROUNDING: f64 = 100.0 * 20.0 * f64::EPSILON;

/// The numbers that an impact is judged by.
struct Judged {
    /// Largest speeds at the contact, before and after.
    speed: f64,
    impulse: f64,
    push: f64,
    friction: f64,
    lost: f64,
    approach: f64,
    departure: f64,
}

fn judge<const D: usize>(contact: &Contact<D>, impulse: Vector<D>) -> Judged
where
    Vector<D>: Rotates,
{
    let after = contact.after(impulse);
    let push = impulse.dot(contact.normal);
    let parts = |c: &Contact<D>| {
        c.sides.iter().map(|s| s.velocity.norm() + Vector::<D>::turned(s.spin, s.arm).norm()).sum::<f64>()
    };
    Judged {
        speed: parts(contact) + parts(&after),
        impulse: impulse.norm(),
        push,
        friction: (impulse - contact.normal * push).norm(),
        lost: contact.energy_lost(impulse),
        approach: contact.approach(),
        departure: -after.approach(),
    }
}

/// Draws impacts and returns the largest gain of energy over |P| times the largest speed.
fn every_impact<const D: usize>(law: Law, seed: u64, number: u64, tolerance: f64) -> f64
where
    Vector<D>: Shapes,
{
    let mut draw = Draw::new(seed);
    let (mut worst_gain, mut worst_cone, mut worst_e) = (0.0f64, 0.0f64, 0.0f64);
    let (mut stuck, mut turned, mut steps, mut integrated, mut all_steps) = (0u64, 0u64, 0u32, 0u64, 0u64);
    for n in 0..number {
        let contact = draw::contact::<D>(&mut draw);
        let c = draw.coefficients();
        let course = law.course(&contact, c);
        let j = judge(&contact, course.impulse);
        assert!(!course.fell_back && course.steps <= STEPS, "impact {n}: {} steps", course.steps);
        assert!(j.push > 0.0, "impact {n} pulls: {}", j.push);
        let cone = (j.friction - c.friction * j.push) / (j.impulse * (1.0 + c.friction));
        worst_cone = worst_cone.max(cone);
        assert!(cone <= ROUNDING, "impact {n} leaves the cone: {} > {} {}", j.friction, c.friction, j.push);
        let gain = -j.lost / (j.impulse * j.speed);
        worst_gain = worst_gain.max(gain);
        if law != Law::Newton {
            assert!(gain <= tolerance, "impact {n} gains {} J: {contact:?} {c:?}", -j.lost);
        }
        if law != Law::Stronge {
            let off = (j.departure - c.restitution * j.approach).abs() / j.speed;
            worst_e = worst_e.max(off);
            assert!(off <= tolerance, "impact {n}: departs at {}, e = {}", j.departure, c.restitution);
        }
        stuck += u64::from(course.slip == Slip::Stuck);
        turned += u64::from(course.slip == Slip::Turned);
        integrated += u64::from(course.steps > 0);
        steps = steps.max(course.steps);
        all_steps += u64::from(course.steps);
    }
    println!(
        "{law:?} in {D}D: {number} impacts, {stuck} stuck, {turned} turned; worst gain {worst_gain:.1e}, cone \
         {worst_cone:.1e}, e {worst_e:.1e}; {integrated} integrated, {:.0} steps in the \
         mean, at most {steps}",
        all_steps as f64 / integrated.max(1) as f64
    );
    assert!(stuck > number / 20, "the draws stick, too");
    worst_gain
}

#[test]
fn the_default_in_the_plane() {
    every_impact::<2>(Law::ChatterjeeRuina, 1, cases(100_000), ROUNDING);
}

#[test]
fn the_default_in_space() {
    every_impact::<3>(Law::ChatterjeeRuina, 2, cases(100_000), ROUNDING);
}

#[test]
fn stronge_in_the_plane() {
    every_impact::<2>(Law::Stronge, 3, cases(100_000), ROUNDING);
}

/// Where it integrates, impulses and work are good to its tolerance a step.
#[test]
fn stronge_in_space() {
    every_impact::<3>(Law::Stronge, 4, cases(10_000), 100.0 * TOLERANCE);
}

/// The textbook's rule returns e, pushes, stays in the cone, and gains energy.
#[test]
fn newton_gains_energy_and_says_so() {
    let plane = every_impact::<2>(Law::Newton, 5, cases(100_000), ROUNDING);
    let space = every_impact::<3>(Law::Newton, 6, cases(10_000), 100.0 * TOLERANCE);
    assert!(plane > 0.01 && space > 0.01, "gains by much more than rounding");
}

fn smooth_limits<const D: usize>(seed: u64, number: u64)
where
    Vector<D>: Shapes,
{
    let mut draw = Draw::new(seed);
    for _ in 0..number {
        let contact = draw::contact::<D>(&mut draw);
        let c = draw.coefficients();
        let (k, n) = (contact.matrix(), contact.normal);
        let want = n * ((1.0 + c.restitution) * contact.approach() / n.dot(k * n));
        // The same division with K in other axes: roundings of the sums only, none of them magnified.
        let near = |p: Vector<D>, what: &str| {
            assert!((p - want).norm() <= 100.0 * f64::EPSILON * want.norm(), "{what}: {p:?} {want:?}");
        };
        for law in Law::ALL {
            near(law.impulse(&contact, Coefficients { friction: 0.0, ..c }), law.as_str());
        }
        near(Law::ChatterjeeRuina.impulse(&contact, Coefficients { tangential: -1.0, ..c }), "e_t = -1");
    }
}

#[test]
fn without_friction_every_law_is_smooth() {
    smooth_limits::<2>(7, cases(100_000));
    smooth_limits::<3>(8, cases(100_000));
}

/// A little friction changes little: the laws are continuous at mu = 0.
#[test]
fn a_little_friction_changes_little() {
    let mut draw = Draw::new(9);
    for _ in 0..1000 {
        let contact = draw::contact::<3>(&mut draw);
        let c = Coefficients { friction: 1e-6, ..draw.coefficients() };
        let smooth = Law::ChatterjeeRuina.impulse(&contact, Coefficients { friction: 0.0, ..c });
        for law in Law::ALL {
            let change = (law.impulse(&contact, c) - smooth).norm() / smooth.norm();
            // P_t <= mu P_n, and K passes on at most its condition's share of it.
            assert!(change < 1e-6 * 200.0, "{law:?}: {change}");
        }
    }
}
