//! The laws of one contact side by side: where they differ and by how much, what they make of measured balls, what they cost.
//! The numbers of `guide/laws.md`:
//!
//! ```text
//! cargo run --release -p carom --example laws
//! ```
use std::hint::black_box;
use std::time::Instant;

use carom::law::rough::{self, Turning};
use carom::law::smooth::Moving;
use carom::law::{Contact, Side};
use carom::material::Coefficients;
use carom::{Law, Matrix, Vector};

fn said(e: f64, e_t: f64, mu: f64) -> Coefficients {
    Coefficients { restitution: e, tangential: e_t, friction: mu, ..Default::default() }
}

/// A uniform rod (1 kg, 2 m) at an angle (degrees) with a floor, whose lower end comes down at unit speed, `lean` degrees from
/// the vertical (positive: away from its centre).
fn rod(angle: f64, lean: f64) -> Contact<2> {
    let (a, l) = (angle.to_radians(), lean.to_radians());
    let side = Side {
        velocity: Vector([-libm::sin(l), -libm::cos(l)]),
        spin: Vector([0.0]),
        inverse_mass: 1.0,
        inverse_inertia: 3.0,
        arm: Vector([-libm::cos(a), -libm::sin(a)]),
    };
    Contact { normal: Vector([0.0, -1.0]), sides: [side, Side::driven(Vector::ZERO)] }
}

fn one_rod() {
    println!("The rod at 45 degrees, coming down at (1, -1) m/s, e = 1, mu = 1/2");
    let mut contact = rod(45.0, 0.0);
    contact.sides[0].velocity = Vector([1.0, -1.0]);
    for (law, e_t) in
        [(Law::ChatterjeeRuina, 0.0), (Law::ChatterjeeRuina, 1.0), (Law::Stronge, 0.0), (Law::Newton, 0.0)]
    {
        let impulse = law.impulse(&contact, said(1.0, e_t, 0.5));
        let after = contact.after(impulse);
        println!(
            "  {:<17} e_t = {e_t}: P = ({:+.4}, {:.4}) N s, departs at {:.4} m/s, energy {:+.4} J",
            law.as_str(),
            -impulse[0],
            -impulse[1],
            -after.approach(),
            -contact.energy_lost(impulse)
        );
    }
}

/// Every rod from 1 to 89 degrees, coming down from 85 degrees on one side to 85 on the other.
fn all_rods() {
    println!("\nRods of every angle and lean: how the laws differ from the default (e_t = 0), |P - P'|/|P|");
    println!("    e   mu   Stronge: same  mean   most  e seen        Newton: same  mean   most  gains energy  most");
    for e in [0.0, 0.5, 0.9, 1.0] {
        for mu in [0.1, 0.3, 1.0] {
            let mut laws = [(0u32, 0.0, 0.0f64); 2];
            let (mut number, mut gains, mut most_gain) = (0u32, 0u32, 0.0f64);
            let mut seen = (f64::INFINITY, 0.0f64);
            for angle in 1..90 {
                for lean in -85..=85 {
                    let contact = rod(f64::from(angle), f64::from(lean));
                    let default = Law::ChatterjeeRuina.impulse(&contact, said(e, 0.0, mu));
                    number += 1;
                    for (law, sums) in [Law::Stronge, Law::Newton].into_iter().zip(&mut laws) {
                        let impulse = law.impulse(&contact, said(e, 0.0, mu));
                        let differs = (impulse - default).norm() / default.norm();
                        *sums = (sums.0 + u32::from(differs < 1e-9), sums.1 + differs, sums.2.max(differs));
                        if law == Law::Stronge {
                            let ratio = -contact.after(impulse).approach() / contact.approach();
                            seen = (seen.0.min(ratio), seen.1.max(ratio));
                        } else {
                            let gain = -contact.energy_lost(impulse) / 0.5;
                            gains += u32::from(gain > 1e-12);
                            most_gain = most_gain.max(gain);
                        }
                    }
                }
            }
            let share = |n: u32| 100.0 * f64::from(n) / f64::from(number);
            let [stronge, newton] = laws.map(|(same, sum, most)| (share(same), sum / f64::from(number), most));
            println!(
                "  {e:.1}  {mu:.1}        {:5.1} %  {:.3}  {:.3}  {:.2} to {:.2}         {:5.1} %  {:.3}  {:.3}     {:5.1} %     {:+.3} of its energy",
                stronge.0,
                stronge.1,
                stronge.2,
                seen.0,
                seen.1,
                newton.0,
                newton.1,
                newton.2,
                share(gains),
                most_gain
            );
        }
    }
}

/// Balls that were measured, by the three numbers that were fitted to them: where the grip ends.
fn measured() {
    println!("\nTwo equal spheres, psi = slip/approach before and after (Foerster et al. 1994)");
    for (name, e, e_t, mu) in [("glass, 3 mm", 0.97, 0.44, 0.092), ("acetate, 6 mm", 0.87, 0.43, 0.25)] {
        print!("  {name:<14} e = {e}, e_t = {e_t}, mu = {mu}; psi after:");
        for before in [0.2, 0.4, 0.6, 1.0, 2.0] {
            let ball =
                |v: [f64; 3]| Turning { moving: Moving::new(1.0, v), spin: Vector::<3>::ZERO, radius: 1.0, kappa: 0.4 };
            let (mut a, mut b) = (ball([before, 0.0, -1.0]), ball([0.0; 3]));
            let down = Vector([0.0, 0.0, -1.0]);
            let parts = rough::parts(&a, &b, down, said(e, e_t, mu));
            rough::exchange(&mut a, &mut b, down, parts);
            print!("  {before:.1} -> {:+.3}", rough::slip(&a, &b, down)[0]);
        }
        println!("   grips up to {:.3}", 3.5 * (1.0 + e) * mu / (1.0 + e_t));
    }
    println!("\nGarwin's ball under a table: vx, R w after floor, underside, floor");
    let mut ball =
        Turning::<3> { moving: Moving::new(1.0, [1.0, 0.0, -2.0]), spin: Vector::ZERO, radius: 1.0, kappa: 0.4 };
    for up in [1.0, -1.0, 1.0] {
        let (along, mut wall) = (Vector([0.0, 0.0, -up]), Turning::wall([0.0; 3]));
        let parts = rough::parts(&ball, &wall, along, said(1.0, 1.0, 10.0));
        rough::exchange(&mut ball, &mut wall, along, parts);
        print!("  ({:+.6}, {:+.6})", ball.moving.velocity[0], ball.spin[1]);
    }
    println!();
}

/// Nanoseconds for one impulse, the best of many rounds over contacts that differ; of one round only if this row was asked for
/// by name, and nothing if another one was.
fn cost<T>(what: &str, contacts: &[T], impulse: impl Fn(&T) -> f64) {
    let mut best = f64::INFINITY;
    let mut sum = 0.0;
    let asked = std::env::args().nth(1);
    let rounds = match asked {
        Some(name) if name != what => return,
        Some(_) => 1,
        None => 30,
    };
    for _ in 0..rounds {
        let start = Instant::now();
        for contact in contacts {
            sum += impulse(black_box(contact));
        }
        best = best.min(start.elapsed().as_secs_f64() / contacts.len() as f64);
    }
    println!("  {what:<36} {:8.1} ns", 1e9 * best);
    black_box(sum);
}

fn costs() {
    println!("\nOne impulse");
    let c = said(0.7, 0.3, 0.3);
    let flat: Vec<Contact<2>> = (0..1000)
        .map(|k| rod(1.0 + 88.0 * f64::from(k % 89) / 89.0, -80.0 + 160.0 * f64::from(k % 71) / 71.0))
        .collect();
    // Bricks of three different moments, every one at its own lean, spinning.
    let solid: Vec<Contact<3>> = flat
        .iter()
        .enumerate()
        .map(|(k, contact)| {
            let [rod, _] = contact.sides;
            let spin = f64::from(k as u32 % 13) / 13.0 - 0.5;
            let brick = Side {
                velocity: Vector([rod.velocity[0], rod.velocity[1], spin]),
                spin: Vector([0.0, spin, 0.0]),
                inverse_mass: 1.0,
                inverse_inertia: Matrix([[3.0, 0.4, 0.0], [0.4, 2.0, 0.2], [0.0, 0.2, 5.0]]),
                arm: Vector([rod.arm[0], rod.arm[1], 0.3]),
            };
            Contact { normal: Vector([0.0, -1.0, 0.0]), sides: [brick, Side::driven(Vector::ZERO)] }
        })
        .collect();
    let balls: Vec<[Turning<3>; 2]> = solid
        .iter()
        .map(|contact| {
            let moving = Moving { inverse_mass: 1.0, velocity: contact.sides[0].velocity };
            let ball = Turning { moving, spin: contact.sides[0].spin, radius: 1.0, kappa: 0.4 };
            [ball, Turning { moving: Moving::new(1.0, [0.0; 3]), spin: Vector::ZERO, ..ball }]
        })
        .collect();
    let down = Vector([0.0, -1.0, 0.0]);
    cost("smooth, space", &balls, |[a, b]| carom::law::smooth::impulse(&a.moving, &b.moving, down, 0.7)[1]);
    cost("rough spheres, space", &balls, |[a, b]| rough::impulse(a, b, down, c)[1]);
    for law in Law::ALL {
        cost(&format!("{}, plane", law.as_str()), &flat, |contact| law.impulse(contact, c)[1]);
    }
    for law in Law::ALL {
        cost(&format!("{}, space", law.as_str()), &solid, |contact| law.impulse(contact, c)[1]);
    }
    if std::env::args().len() > 1 {
        return;
    }
    let steps: u32 = solid.iter().map(|contact| Law::Stronge.course(contact, c).steps).sum();
    println!("  Stronge in space takes {:.0} steps in the mean", f64::from(steps) / solid.len() as f64);
}

/// With the name of a row of the costs: one round of it alone, 1000 impulses, for a counter of instructions
/// (`valgrind --tool=callgrind`; a name that is no row's gives what has to be taken off).
fn main() {
    if std::env::args().len() == 1 {
        one_rod();
        all_rods();
        measured();
    }
    costs();
}
