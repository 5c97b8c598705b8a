//! What is asked: two bodies, as they meet.
use super::{Explanation, Origins};
use carom::Law;
use thiserror::Error;

/// Two balls as they meet, or a ball and a wall. Every list of two is for the first and the second body.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// Mass (kg); infinite for a wall.
    pub masses: [f64; 2],
    /// Velocity (m/s), one, two or three numbers.
    pub velocity: [Vec<f64>; 2],
    /// The line of centres, from the first body to the second, of any length but 0. Left out on the line: +x.
    pub normal: Option<Vec<f64>>,
    /// Coefficient of restitution e in [0, 1].
    pub restitution: f64,
    /// Coulomb's coefficient of friction mu >= 0 between the bodies. With friction the radii must be known.
    pub friction: f64,
    /// Tangential restitution e_t in [-1, 1], which matters only with friction: 0 the slip stops, 1 it turns round.
    pub tangential: f64,
    /// The law of the impact. For balls all of them agree, but that only the default knows e_t: the others take it as 0.
    pub law: Law,
    /// Spin (rad/s): no number on the line, one in the plane, three in space. Left out: none.
    pub spin: Option<[Vec<f64>; 2]>,
    /// Radius (m): with it, the energy of the spins is known. Of a wall it counts only if the wall spins.
    pub radius: Option<[f64; 2]>,
    /// kappa in I = kappa m R^2. Left out: 1/2 in the plane (disc), 2/5 in space (ball).
    pub inertia: Option<[f64; 2]>,
    /// How long the contact lasts (s): with it, the mean force is known.
    pub duration: Option<f64>,
    /// Where the coefficients come from, of an impact of a run.
    pub origins: Option<Origins>,
}

/// What is wrong with a question, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{key}: {rule}")]
pub struct Mistake {
    /// The quantity that is wrong, as the command line names it: "mass", "velocity", ...
    pub key: &'static str,
    /// The rule it breaks.
    pub rule: String,
}

impl Mistake {
    pub(crate) fn new(key: &'static str, rule: impl Into<String>) -> Self {
        Self { key, rule: rule.into() }
    }
}

const EACH: [&str; 2] = ["the first body", "the second body"];

impl Question {
    /// Two bodies of these masses (kg) and velocities (m/s): elastic, smooth, without spin.
    pub fn new(masses: [f64; 2], velocity: [Vec<f64>; 2]) -> Self {
        Self {
            masses,
            velocity,
            normal: None,
            restitution: 1.0,
            friction: 0.0,
            tangential: 0.0,
            law: Law::default(),
            spin: None,
            radius: None,
            inertia: None,
            duration: None,
            origins: None,
        }
    }

    /// The line of centres, from the first body to the second, of any length but 0.
    pub fn normal(self, normal: impl Into<Vec<f64>>) -> Self {
        Self { normal: Some(normal.into()), ..self }
    }

    /// The coefficient of restitution.
    pub fn restitution(self, restitution: f64) -> Self {
        Self { restitution, ..self }
    }

    /// Coulomb's coefficient of friction, and the radii (m), which tell how far from the centres it acts.
    pub fn friction(self, friction: f64, radius: [f64; 2]) -> Self {
        Self { friction, radius: Some(radius), ..self }
    }

    /// The tangential restitution.
    pub fn tangential(self, tangential: f64) -> Self {
        Self { tangential, ..self }
    }

    /// The spins (rad/s).
    pub fn spin(self, spin: [Vec<f64>; 2]) -> Self {
        Self { spin: Some(spin), ..self }
    }

    /// How long the contact lasts (s).
    pub fn duration(self, duration: f64) -> Self {
        Self { duration: Some(duration), ..self }
    }

    /// k in I = k m R^2 of each: what was said, or that of a disc or a ball.
    pub(super) fn kappa(&self) -> [f64; 2] {
        self.inertia.unwrap_or(if self.dim() == 2 { [0.5; 2] } else { [0.4; 2] })
    }

    /// How many numbers a velocity has.
    pub fn dim(&self) -> usize {
        self.velocity[0].len()
    }

    /// The explanation of the impact, or the first thing that is wrong with the question.
    pub fn answer(&self) -> Result<Explanation, Mistake> {
        self.check()?;
        match self.dim() {
            1 => Explanation::of::<1>(self),
            2 => Explanation::of::<2>(self),
            _ => Explanation::of::<3>(self),
        }
    }

    fn check(&self) -> Result<(), Mistake> {
        for (mass, body) in self.masses.iter().zip(EACH) {
            if !(*mass > 0.0) {
                let rule = format!("mass must be positive, and {body} has {mass}; a wall has mass inf");
                return Err(Mistake::new("mass", rule));
            }
        }
        if self.masses.iter().all(|m| m.is_infinite()) {
            return Err(Mistake::new(
                "mass",
                "both bodies are immovable, so nothing can happen; give one a finite mass",
            ));
        }
        self.check_vectors()?;
        if !(0.0..=1.0).contains(&self.restitution) {
            let rule = "restitution must lie in [0, 1]: 1 is elastic, 0 perfectly inelastic";
            return Err(Mistake::new("restitution", format!("{rule}; got {}", self.restitution)));
        }
        if !(self.friction >= 0.0 && self.friction.is_finite()) {
            return Err(Mistake::new("friction", format!("must be finite and not negative; got {}", self.friction)));
        }
        if !(-1.0..=1.0).contains(&self.tangential) {
            let rule = "must lie in [-1, 1]: -1 smooth, 0 the slip stops, 1 it turns round";
            return Err(Mistake::new("tangential", format!("{rule}; got {}", self.tangential)));
        }
        if self.friction > 0.0 && self.dim() > 1 && self.radius.is_none() {
            let rule = "friction acts at the surfaces, and how far they are from the centres is not said; for two balls of \
                        10 cm: --radius 0.1 0.1";
            return Err(Mistake::new("radius", rule));
        }
        for (key, pair, what) in [("radius", self.radius, "radius"), ("inertia", self.inertia, "inertia factor")] {
            for (x, body) in pair.iter().flatten().zip(EACH) {
                if !(*x > 0.0 && x.is_finite()) {
                    let rule = format!("{what} must be positive and finite, and {body} has {x}");
                    return Err(Mistake::new(key, rule));
                }
            }
        }
        match self.duration {
            Some(s) if !(s > 0.0 && s.is_finite()) => {
                Err(Mistake::new("duration", format!("duration must be positive and finite (seconds); got {s}")))
            }
            _ => Ok(()),
        }
    }

    fn check_vectors(&self) -> Result<(), Mistake> {
        let dim = self.dim();
        if !(1..=3).contains(&dim) {
            let rule = format!("expects one number (on a line), two (in the plane) or three (in space); got {dim}");
            return Err(Mistake::new("velocity", rule));
        }
        if self.velocity[1].len() != dim {
            let got = self.velocity[1].len();
            let rule = format!("expects dim = {} for both bodies; the second velocity has {got}", numbers(dim));
            return Err(Mistake::new("velocity", rule));
        }
        finite("velocity", &self.velocity)?;
        match &self.normal {
            None if dim > 1 => {
                let like = if dim == 2 { "3,4" } else { "2,3,6" };
                let rule =
                    "is needed in the plane and in space: the line of centres, from the first body to the second";
                return Err(Mistake::new("normal", format!("{rule}, of any length, for example {like}")));
            }
            Some(normal) if normal.len() != dim => {
                let rule = format!("expects dim = {}, as the velocities have; got {}", numbers(dim), normal.len());
                return Err(Mistake::new("normal", rule));
            }
            Some(normal) => {
                finite("normal", core::slice::from_ref(normal))?;
                if normal.iter().all(|x| *x == 0.0) {
                    let rule = "normal must not be zero: it points from the first body to the second";
                    return Err(Mistake::new("normal", rule));
                }
            }
            None => {}
        }
        if let Some(spin) = &self.spin {
            let want = [0, 1, 3][dim - 1];
            for (w, body) in spin.iter().zip(EACH) {
                if w.len() != want {
                    let rule = match dim {
                        1 => "nothing turns on a line; leave spin out".into(),
                        _ => format!("expects {} for {body} in {dim}D; got {}", numbers(want), w.len()),
                    };
                    return Err(Mistake::new("spin", rule));
                }
            }
            finite("spin", spin)?;
        }
        Ok(())
    }
}

fn numbers(n: usize) -> String {
    if n == 1 { "1 number".into() } else { format!("{n} numbers") }
}

fn finite(key: &'static str, vectors: &[Vec<f64>]) -> Result<(), Mistake> {
    match vectors.iter().flatten().find(|x| !x.is_finite()) {
        Some(x) => Err(Mistake::new(key, format!("must be finite; got {x}"))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane() -> Question {
        Question::new([2.0, 3.0], [vec![5.0, 0.0], vec![-1.0, 2.0]]).normal([3.0, 4.0])
    }

    #[test]
    fn wrong_questions_are_refused_by_name() {
        let q = plane();
        let table = [
            (Question { masses: [0.0, 1.0], ..q.clone() }, "mass", "positive"),
            (Question { masses: [f64::NAN, 1.0], ..q.clone() }, "mass", "positive"),
            (Question { masses: [f64::INFINITY; 2], ..q.clone() }, "mass", "immovable"),
            (Question { velocity: [vec![], vec![]], ..q.clone() }, "velocity", "one number"),
            (Question { velocity: [vec![1.0, 2.0], vec![1.0]], ..q.clone() }, "velocity", "dim = 2 numbers"),
            (Question { velocity: [vec![1.0, f64::NAN], vec![1.0, 1.0]], ..q.clone() }, "velocity", "must be finite"),
            (Question { normal: None, ..q.clone() }, "normal", "needed"),
            (Question { normal: Some(vec![1.0]), ..q.clone() }, "normal", "dim = 2 numbers"),
            (Question { normal: Some(vec![0.0, -0.0]), ..q.clone() }, "normal", "must not be zero"),
            (Question { restitution: 1.1, ..q.clone() }, "restitution", "[0, 1]"),
            (Question { restitution: f64::NAN, ..q.clone() }, "restitution", "[0, 1]"),
            (Question { friction: 0.1, ..q.clone() }, "radius", "friction acts at the surfaces"),
            (Question { tangential: 1.1, ..q.clone() }, "tangential", "[-1, 1]"),
            (Question { friction: -0.1, ..q.clone() }, "friction", "not negative"),
            (Question { spin: Some([vec![1.0], vec![]]), ..q.clone() }, "spin", "1 number"),
            (Question { radius: Some([1.0, 0.0]), ..q.clone() }, "radius", "positive"),
            (Question { inertia: Some([-1.0, 1.0]), ..q.clone() }, "inertia", "positive"),
            (Question { duration: Some(0.0), ..q.clone() }, "duration", "positive"),
            (Question { velocity: [vec![1e300, 0.0], vec![0.0, 0.0]], ..q.clone() }, "velocity", "too large"),
        ];
        for (question, key, rule) in table {
            let mistake = question.answer().expect_err(rule);
            println!("{mistake}");
            assert_eq!(mistake.key, key);
            assert!(mistake.rule.contains(rule), "{mistake}");
        }
    }
}
