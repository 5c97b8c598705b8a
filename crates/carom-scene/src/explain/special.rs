//! The special cases of the lecture and of every billiard room, named where they hold.
use super::Explanation;

/// A special case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Special {
    /// The bodies do not approach: nothing happens.
    Parting,
    /// Equal masses, e = 1: they exchange their velocities (in more than one dimension, along the line of centres).
    Exchange,
    /// e = 0: along the line of centres both go on with one velocity.
    Common,
    /// One body is a wall: its velocity does not change.
    Wall,
    /// Equal masses, e = 1, one at rest, oblique: they part at right angles.
    RightAngle,
    /// With friction: the surfaces stick and e_t = 0, so that they leave rolling over one another.
    Rolls,
    /// With friction: e = e_t = 1 and the surfaces stick: slip and approach both turn round, and no energy is lost.
    Superball,
    /// The centre of mass goes on with the velocity it had (whenever there is no wall).
    CentreOfMass,
}

/// How close counts as equal, relative to the larger of the two.
const CLOSE: f64 = 1e-9;

fn equal(a: f64, b: f64) -> bool {
    a.is_finite() && b.is_finite() && (a - b).abs() <= CLOSE * a.abs().max(b.abs())
}

fn length(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The special cases that hold.
pub(super) fn holding(x: &Explanation) -> Vec<Special> {
    let mut found = Vec::new();
    if !x.meets() {
        found.push(Special::Parting);
    } else {
        let elastic_equals = equal(x.masses[0], x.masses[1]) && equal(x.restitution, 1.0);
        if elastic_equals {
            found.push(Special::Exchange);
        }
        if x.restitution <= CLOSE {
            found.push(Special::Common);
        }
        if x.wall().is_some() {
            found.push(Special::Wall);
        }
        // The mover's velocity must have a part along the line of centres (it does: they meet) and a part across it.
        let at_rest = |body: usize| length(&x.before.velocity[body]) <= CLOSE * length(&x.before.velocity[1 - body]);
        let oblique = |body: usize| {
            let v = &x.before.velocity[body];
            let along = x.normal_part(v);
            let across: Vec<f64> = v.iter().zip(&x.normal).map(|(v, n)| v - along * n).collect();
            length(&across) > CLOSE * length(v) && along.abs() > CLOSE * length(v)
        };
        if elastic_equals && x.rough.is_none() && (at_rest(1) && oblique(0) || at_rest(0) && oblique(1)) {
            found.push(Special::RightAngle);
        }
        let back = if x.law == carom::Law::ChatterjeeRuina { x.tangential } else { 0.0 };
        if x.rough.as_ref().is_some_and(|r| r.sticks && r.slip_speed > 0.0) {
            if back == 0.0 {
                found.push(Special::Rolls);
            } else if back == 1.0 && equal(x.restitution, 1.0) {
                found.push(Special::Superball);
            }
        }
    }
    if x.wall().is_none() {
        found.push(Special::CentreOfMass);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::Question;
    use super::*;

    fn cases(masses: [f64; 2], v: [&[f64]; 2], normal: &[f64], e: f64) -> Vec<Special> {
        let question = Question::new(masses, v.map(<[f64]>::to_vec)).normal(normal).restitution(e);
        question.answer().unwrap().special
    }

    #[test]
    fn special_cases_light_up_when_true() {
        use Special::*;
        let wall = f64::INFINITY;
        assert_eq!(cases([1.0, 1.0], [&[1.0], &[0.0]], &[1.0], 1.0), [Exchange, CentreOfMass]);
        assert_eq!(cases([1.0, 1.0], [&[1.0], &[0.0]], &[1.0], 0.0), [Common, CentreOfMass]);
        assert_eq!(cases([1.0, 2.0], [&[1.0], &[0.0]], &[1.0], 0.5), [CentreOfMass]);
        assert_eq!(cases([1.0, 2.0], [&[-1.0], &[1.0]], &[1.0], 1.0), [Parting, CentreOfMass]);
        assert_eq!(cases([1.0, wall], [&[1.0], &[0.0]], &[1.0], 0.9), [Wall]);
        assert_eq!(cases([1.0, wall], [&[1.0], &[0.0]], &[1.0], 1.0), [Wall]);
        let (oblique, rest): (&[f64], &[f64]) = (&[5.0, 0.0], &[0.0, 0.0]);
        assert_eq!(cases([1.0, 1.0], [oblique, rest], &[3.0, 4.0], 1.0), [Exchange, RightAngle, CentreOfMass]);
        assert_eq!(cases([1.0, 1.0], [rest, oblique], &[-3.0, 4.0], 1.0), [Exchange, RightAngle, CentreOfMass]);
        assert_eq!(cases([1.0, 1.0], [oblique, rest], &[2.0, 0.0], 1.0), [Exchange, CentreOfMass], "head-on");
        assert_eq!(cases([1.0, 1.0], [oblique, rest], &[3.0, 4.0], 0.9), [CentreOfMass]);
    }

    #[test]
    fn the_right_angle_is_one() {
        let question = Question::new([1.0, 1.0], [vec![5.0, 0.0], vec![0.0, 0.0]]).normal([3.0, 4.0]);
        let v = question.answer().unwrap().after.velocity;
        let dot: f64 = v[0].iter().zip(&v[1]).map(|(a, b)| a * b).sum();
        assert!(dot.abs() < 1e-14);
    }
}
