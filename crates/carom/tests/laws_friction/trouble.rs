//! Input that no one should give: nothing panics, nothing moves that cannot, nothing runs away.
use carom::law::{Contact, Law, Side};
use carom::material::Coefficients;
use carom::{Matrix, Vector};

fn rough(mu: f64) -> Coefficients {
    Coefficients { restitution: 0.5, friction: mu, tangential: 0.3, ..Default::default() }
}

fn brick() -> Side<3> {
    Side {
        velocity: Vector([1.0, -2.0, 0.5]),
        spin: Vector([0.5, 3.0, -1.0]),
        inverse_mass: 0.5,
        inverse_inertia: Matrix([[2.0, 0.5, 0.0], [0.5, 3.0, -0.25], [0.0, -0.25, 1.0]]),
        arm: Vector([1.0, -0.5, -0.25]),
    }
}

fn on_the_floor(brick: Side<3>) -> Contact<3> {
    Contact { normal: Vector([0.0, -1.0, 0.0]), sides: [brick, Side::driven(Vector::ZERO)] }
}

#[test]
fn parting_grazing_immovable_and_not_a_number_do_nothing() {
    let nan = f64::NAN;
    let still = Side { inverse_mass: 0.0, inverse_inertia: Matrix::ZERO, ..brick() };
    let cases = [
        on_the_floor(Side { velocity: Vector([1.0, 5.0, 0.0]), ..brick() }),
        on_the_floor(Side { velocity: Vector([1.0, 0.0, 0.0]), spin: Vector::ZERO, ..brick() }),
        on_the_floor(still),
        on_the_floor(Side { velocity: Vector([nan, nan, nan]), ..brick() }),
        on_the_floor(Side { inverse_mass: nan, ..brick() }),
        on_the_floor(Side { spin: Vector([nan, 0.0, 0.0]), ..brick() }),
    ];
    for law in Law::ALL {
        for contact in &cases {
            assert_eq!(law.impulse(contact, rough(0.4)), Vector::ZERO, "{law:?} {contact:?}");
        }
        let blind = Coefficients { restitution: nan, ..rough(0.4) };
        assert_eq!(law.impulse(&on_the_floor(brick()), blind), Vector::ZERO, "{law:?}");
        // Friction that is not a number is none.
        let p = law.impulse(&on_the_floor(brick()), rough(nan));
        assert_eq!(p, law.impulse(&on_the_floor(brick()), rough(0.0)), "{law:?}");
    }
}

/// A body on an axle: nothing moves its centre, and it turns about one axis only. K has rank 1.
#[test]
fn a_door() {
    let door = Side {
        velocity: Vector::ZERO,
        spin: Vector([0.0, 0.0, 2.0]),
        inverse_mass: 0.0,
        inverse_inertia: Matrix([[0.0; 3], [0.0; 3], [0.0, 0.0, 4.0]]),
        arm: Vector([1.0, 0.25, 0.5]),
    };
    // Its point moves at 2 z x r = (-0.5, 2, 0) against a wall above.
    let contact = Contact { normal: Vector([0.0, 1.0, 0.0]), sides: [door, Side::driven(Vector::ZERO)] };
    for law in Law::ALL {
        for mu in [0.0, 0.1, 0.5, 10.0] {
            let course = law.course(&contact, Coefficients { tangential: 0.0, ..rough(mu) });
            let after = contact.after(course.impulse);
            println!("{law:?} mu = {mu}: {course:?}");
            assert!(course.impulse.is_finite());
            assert!(!course.fell_back || mu == 10.0, "where it sticks it jams, and the default law answers");
            // One freedom: to stop the approach is to stop the slip, and e = 1/2 sends the door back at half its spin,
            // whichever way the impulse leans. Under Stronge's law friction takes its share on the way: slip and approach
            // stay at 1 : 4, so the normal work of compression is E/(1 + mu/4), and of the e^2 of it that comes back
            // friction leaves 1 - mu/4.
            let share =
                if law == Law::Stronge && !course.fell_back { (1.0 - mu / 4.0) / (1.0 + mu / 4.0) } else { 1.0 };
            let spin = after.sides[0].spin[2];
            assert!((spin + share.sqrt()).abs() < 1e-14, "{law:?} mu = {mu}: {spin}");
            assert!(contact.energy_lost(course.impulse) > 0.0);
        }
    }
    // A push towards the axle turns nothing.
    let blocked = Contact {
        normal: Vector([1.0, 0.0, 0.0]),
        sides: [
            Side { arm: Vector([1.0, 0.0, 0.0]), velocity: Vector([1.0, 0.0, 0.0]), ..door },
            Side::driven(Vector::ZERO),
        ],
    };
    for law in Law::ALL {
        assert_eq!(law.impulse(&blocked, rough(0.4)), Vector::ZERO);
    }
}

/// Friction without bound sticks at once, whatever its number.
#[test]
fn enormous_friction_sticks() {
    let contact = on_the_floor(brick());
    for law in Law::ALL {
        // Plastic: the default law sticks at the end of compression, and e P_I lets the point slip again.
        let c = Coefficients { tangential: 0.0, restitution: 0.0, ..rough(f64::MAX) };
        let after = contact.after(law.impulse(&contact, c));
        // Slip is stopped within 1e-9 of the impact; with K of order 10 that leaves 1e-8 at most.
        assert!(after.slip().norm() < 1e-7, "{law:?}: {:?}", after.slip());
        let same = law.impulse(&contact, Coefficients { friction: 1e9, ..c });
        assert_eq!(law.impulse(&contact, c), same);
    }
}

/// Masses 24 orders of magnitude apart, and a sliver that turns a million times more easily one way than another.
#[test]
fn extremes_stay_finite_and_lose_energy() {
    let light = Side { inverse_mass: 1e12, inverse_inertia: Matrix::scalar(1e12), ..brick() };
    let heavy = Side {
        inverse_mass: 1e-12,
        inverse_inertia: Matrix::scalar(1e-12),
        velocity: Vector([0.0, 1.0, 0.0]),
        ..brick()
    };
    let sliver = Side { inverse_inertia: Matrix([[1e6, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1e-3]]), ..brick() };
    for (a, b) in
        [(light, heavy), (heavy, Side::driven(Vector::ZERO)), (sliver, Side::driven(Vector::ZERO)), (light, sliver)]
    {
        let a = Side { velocity: a.velocity + Vector([0.0, -2.0, 1.0]), ..a };
        let mut contact = Contact { normal: Vector([0.0, -1.0, 0.0]), sides: [a, b] };
        if contact.approach() < 0.0 {
            contact.normal = -contact.normal;
        }
        for law in [Law::ChatterjeeRuina, Law::Stronge] {
            for mu in [1e-3, 0.3, 5.0] {
                let course = law.course(&contact, rough(mu));
                let lost = contact.energy_lost(course.impulse);
                let u = contact.relative_velocity().norm();
                println!(
                    "{law:?} mu = {mu}: lost {lost:e} of {:e}, {} steps, {}",
                    course.impulse.norm() * u,
                    course.steps,
                    course.fell_back
                );
                assert!(course.impulse.is_finite() && course.steps <= carom::law::routh::STEPS);
                assert!(lost >= -1e-8 * course.impulse.norm() * u, "{law:?} mu = {mu} gains {}", -lost);
                assert!(course.impulse.dot(contact.normal) > 0.0);
            }
        }
    }
}
