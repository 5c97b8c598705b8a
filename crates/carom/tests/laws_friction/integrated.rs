//! Coulomb's friction through the impact against an integration that knows nothing of closed forms, other variables or
//! adaptive steps: the normal impulse grows by small equal steps, and friction is looked up anew at each.
use carom::law::{Contact, Law};
use carom::material::Coefficients;
use carom::{Rotates, Vector};

use crate::draw::{self, Draw, Shapes, cases};

/// What friction does per unit of normal impulse where there is no slip: the one that holds it (K_tt f = -K_tn), if the cone
/// has it; else mu times the direction in which a slip can grow, found by trying all of them.
fn at_rest<const D: usize>(contact: &Contact<D>, mu: f64) -> Vector<D>
where
    Vector<D>: Rotates,
{
    let (k, n) = (contact.matrix(), contact.normal);
    let across = |v: Vector<D>| v - n * v.dot(n);
    let pull = across(k * n);
    // Steepest descent on f.K f/2 + f.K n over the plane across n: it converges for every symmetric positive K.
    let mut hold = Vector::ZERO;
    for _ in 0..20_000 {
        let residual = across(k * hold) + pull;
        let square = residual.norm_squared();
        if square < 1e-28 * pull.norm_squared() {
            break;
        }
        hold -= residual * (square / residual.dot(k * residual));
    }
    if hold.norm() <= mu {
        return hold;
    }
    // A slip along t grows straight if -(K_tn + mu K_tt t) is a positive multiple of t: iterate t = -(pull + mu K t) +
    // shift t, normalised; the shift makes it a contraction towards the only such direction.
    let shift = mu * (0..D).map(|i| k.0[i][i]).sum::<f64>();
    let mut t = (-pull).unit().unwrap_or(Vector::ZERO);
    for _ in 0..200_000 {
        let next = (t * shift - pull - across(k * t) * mu).unit().unwrap_or(t);
        let moved = (next - t).norm();
        t = next;
        if moved < 1e-15 {
            break;
        }
    }
    t * mu
}

/// The impulse on the second body after `steps` equal steps of what a plastic frictionless impact takes.
fn followed<const D: usize>(contact: &Contact<D>, c: Coefficients, law: Law, steps: f64) -> Vector<D>
where
    Vector<D>: Rotates,
{
    let (k, n, mu) = (contact.matrix(), contact.normal, c.friction);
    let across = |v: Vector<D>| v - n * v.dot(n);
    let first = contact.relative_velocity();
    let dp = first.dot(n) / n.dot(k * n) / steps;
    let rest = at_rest(contact, mu);
    // What a step does to a slip at most: below it, the slip has stopped.
    let small = dp * (k * n).norm() * (1.0 + mu) + dp * mu * (0..D).map(|i| k.0[i][i]).sum::<f64>();
    let (mut impulse, mut u, mut work, mut stopped) = (Vector::ZERO, first, 0.0, false);
    let mut due = None;
    for _ in 0..200 * steps as u64 {
        let slip = across(u);
        stopped |= slip.norm() < small;
        let friction = |u: Vector<D>| {
            if stopped { rest } else { across(u).unit().map_or(rest, |t| t * mu) }
        };
        // The midpoint rule, of second order until the slip stops.
        let middle = u - k * (n + friction(u)) * (0.5 * dp);
        let push = (n + friction(middle)) * dp;
        let next = u - k * push;
        let spent = 0.5 * (u.dot(n) + next.dot(n)) * dp;
        match law {
            Law::Stronge => {
                if next.dot(n) <= 0.0 && due.is_none() {
                    due = Some(c.restitution * c.restitution * work);
                }
                work += spent;
                if let Some(left) = &mut due {
                    *left += spent;
                    if *left <= 0.0 {
                        return impulse + push;
                    }
                }
            }
            _ => {
                if next.dot(n) <= -c.restitution * first.dot(n) {
                    return impulse + push;
                }
            }
        }
        (impulse, u) = (impulse + push, next);
    }
    panic!("the integration does not end");
}

fn compare<const D: usize>(law: Law, seed: u64, number: u64, steps: f64)
where
    Vector<D>: Shapes,
{
    let mut draw = Draw::new(seed);
    let (mut worst, mut sum) = (0.0f64, 0.0);
    for n in 0..number {
        let contact = draw::contact::<D>(&mut draw);
        let c = Coefficients { friction: draw.magnitude(-1.3, 0.3), ..draw.coefficients() };
        let course = law.course(&contact, c);
        let want = followed(&contact, c, law, steps);
        // In units of the impulse that a step takes. Each of three events (stop, end of compression, end) is seen a step
        // late, and K (condition 100) passes that on; an end that is reached slowly (e^2 of the work, at a departure speed
        // near 0) is late by the root of a step's work.
        let step = contact.approach() / contact.normal.dot(contact.matrix() * contact.normal) / steps;
        let off = (course.impulse - want).norm() / (course.impulse.norm() + step * steps);
        worst = worst.max(off);
        sum += off;
        assert!(off < 0.02, "impact {n}: {:?} {want:?}, {course:?} {contact:?} {c:?}", course.impulse);
    }
    let mean = sum / number as f64;
    println!("{law:?} in {D}D: {number} impacts in {steps} steps, off by {mean:.1e} in the mean, {worst:.1e} at most");
    assert!(mean < 10.0 / steps, "of first order in the step");
}

#[test]
fn in_the_plane() {
    compare::<2>(Law::Stronge, 31, cases(400).min(20_000), 5_000.0);
    compare::<2>(Law::Newton, 32, cases(400).min(20_000), 5_000.0);
}

#[test]
fn in_space() {
    compare::<3>(Law::Stronge, 33, cases(400).min(20_000), 5_000.0);
    compare::<3>(Law::Newton, 34, cases(400).min(20_000), 5_000.0);
}
