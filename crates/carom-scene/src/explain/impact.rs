//! Every quantity of one impact, as the engine computes it.
use super::{Check, Friction, Mistake, Origins, Question, Special, check, special};
use carom::law::rough::{self, Turning};
use carom::law::smooth::{self, Moving};
use carom::law::{Law, momentum, rotated};
use carom::material::Coefficients;
use carom::{Rotates, Vector};

/// Both bodies before or after.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Velocity (m/s) of each.
    pub velocity: [Vec<f64>; 2],
    /// Spin (rad/s) of each: no number on the line, one in the plane, three in space.
    pub spin: [Vec<f64>; 2],
    /// The momentum of both (kg m/s); `None` with a wall.
    pub momentum: Option<Vec<f64>>,
    /// Kinetic energy (J) of the bodies of finite mass, with that of their spins where their radius is known.
    pub energy: f64,
}

/// The impact in the lecture's rotated frame (2D): v_p lies along the line of centres, v_n across it.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotated {
    /// The angle of the line of centres against the x axis (rad).
    pub theta: f64,
    /// [v_p, v_n] of each body before (m/s).
    pub before: [[f64; 2]; 2],
    /// The same after.
    pub after: [[f64; 2]; 2],
}

/// Every quantity of one impact of two balls. The velocities, the spins, the impulse and the lost energy are those of
/// [`carom::law::rough`] and, without friction, of [`carom::law::smooth`], to the bit.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// 1, 2 or 3.
    pub dim: usize,
    /// Mass (kg) of each; infinite for a wall.
    pub masses: [f64; 2],
    /// The line of centres as it was given, from the first body to the second.
    pub along: Vec<f64>,
    /// The same with length 1.
    pub normal: Vec<f64>,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Tangential restitution, as it was asked for.
    pub tangential: f64,
    /// The law of the impact.
    pub law: Law,
    /// Radius (m) of each, if it was said.
    pub radius: Option<[f64; 2]>,
    /// k in I = k m R^2 of each.
    pub inertia: [f64; 2],
    /// Before the impact.
    pub before: State,
    /// After the impact.
    pub after: State,
    /// (v1 - v2)·n before (m/s): positive if the bodies approach.
    pub approach: f64,
    /// -(v1' - v2')·n (m/s): positive if they part.
    pub departure: f64,
    /// 1/(1/m1 + 1/m2) (kg).
    pub reduced_mass: f64,
    /// J >= 0 along the normal (N s): -J n acts on the first body, +J n on the second.
    pub impulse: f64,
    /// The whole impulse on the second body (N s): J n, and the tangential impulse.
    pub exchanged: Vec<f64>,
    /// The tangential impulse on the second body (N s): zero without friction.
    pub friction_impulse: Vec<f64>,
    /// What friction did, where there is friction and the bodies meet in the plane or in space.
    pub rough: Option<Friction>,
    /// Kinetic energy lost to heat, sound and deformation (J).
    pub lost: f64,
    /// The work that a driven wall does (J): 0 if it stands still, or if there is none.
    pub work: f64,
    /// Kinetic energy of the spins (J) before, part of the energies; a smooth impact leaves it alone.
    pub spin_energy: f64,
    /// How long the contact lasts (s), if that was said.
    pub duration: Option<f64>,
    /// The mean force on each body (N), with a duration.
    pub mean_force: Option<[Vec<f64>; 2]>,
    /// Where the coefficients come from, of an impact of a run.
    pub origins: Option<Origins>,
    /// The lecture's rotated frame, in the plane.
    pub rotated: Option<Rotated>,
    /// The special cases that hold.
    pub special: Vec<Special>,
    /// Momentum, restitution and energy, checked.
    pub checks: [Check; 3],
}

/// The same vector without negative zeros.
fn plain<const D: usize>(v: Vector<D>) -> Vec<f64> {
    v.0.iter().map(|x| x + 0.0).collect()
}

impl Explanation {
    /// The answer to a checked question in `D` dimensions.
    pub(super) fn of<const D: usize>(question: &Question) -> Result<Self, Mistake>
    where
        Vector<D>: Rotates,
    {
        let vector = |v: &Vec<f64>| Vector::<D>::from_fn(|k| v[k]);
        let masses = question.masses;
        let before = [vector(&question.velocity[0]), vector(&question.velocity[1])];
        let given = question.normal.as_ref().map_or(Vector::axis(0), vector);
        let Some(normal) = given.unit() else {
            return Err(Mistake::new("normal", "normal must not be zero"));
        };
        // The law asks for a length whose square is an ordinary number.
        let square = given.norm_squared();
        let along = if square > 1e-200 && square < 1e200 { given } else { normal };
        let length = along.norm();
        let e = question.restitution;

        // Coulomb's law alone knows no e_t.
        let tangential = if question.law == Law::ChatterjeeRuina { question.tangential } else { 0.0 };
        let friction = if D > 1 { question.friction } else { 0.0 };
        let c = Coefficients { restitution: e, friction, tangential, ..Default::default() };
        let kappa = question.kappa();
        let spin =
            question.spin.clone().unwrap_or_else(|| [vec![0.0; Vector::<D>::SPINS], vec![0.0; Vector::<D>::SPINS]]);
        let balls = [0, 1].map(|k| Turning {
            moving: Moving::new(masses[k], before[k]),
            spin: Vector::<D>::spin_from(&spin[k]).unwrap_or_default(),
            radius: question.radius.map_or(0.0, |r| r[k]),
            kappa: kappa[k],
        });
        let [mut a, mut b] = balls;
        let approach = (before[0] - before[1]).dot(along) / length;
        let reduced_mass = match masses.iter().position(|m| m.is_infinite()) {
            Some(wall) => masses[1 - wall],
            None => smooth::reduced_mass(&a.moving, &b.moving),
        };
        let parts = rough::parts(&a, &b, along, c);
        rough::exchange(&mut a, &mut b, along, parts);
        let (impulse, after) = (parts[0] + parts[1], [a.moving.velocity, b.moving.velocity]);
        let departure = -((after[0] - after[1]).dot(along) / length);
        let lost_normal = smooth::energy_lost(reduced_mass, approach, e);
        let rough =
            (friction > 0.0 && approach > 0.0).then(|| Friction::of(&balls, &[a, b], normal, parts, c, lost_normal));
        let lost = lost_normal + rough.as_ref().map_or(0.0, |r| r.lost_friction);
        // What drives a wall or turns it does the work of its surface.
        let surface =
            |k: usize, arm: f64| before[k] + Vector::<D>::turned(balls[k].spin, normal * (arm * balls[k].radius));
        let work = match masses.map(f64::is_infinite) {
            [true, _] => parts[0].dot(before[0]) + parts[1].dot(surface(0, 1.0)),
            [_, true] => -(parts[0].dot(before[1]) + parts[1].dot(surface(1, -1.0))),
            _ => 0.0,
        };

        let spins = [spin, [a, b].map(|ball| Vector::<D>::spin_slice(&ball.spin).iter().map(|w| w + 0.0).collect())];
        let spin_energy = [0, 1].map(|when| spin_energy(question, &spins[when]));
        let state = |when: usize, velocity: [Vector<D>; 2]| {
            let bodies = || masses.into_iter().zip(velocity).filter(|(m, _)| m.is_finite());
            State {
                velocity: velocity.map(plain),
                spin: spins[when].clone(),
                momentum: masses.iter().all(|m| m.is_finite()).then(|| plain(momentum::total(bodies()))),
                energy: bodies().map(|(m, v)| momentum::kinetic_energy(m, v)).sum::<f64>() + spin_energy[when],
            }
        };
        let mean_force = question.duration.map(|s| {
            let force = momentum::mean_force(impulse, s);
            [plain(-force), plain(force)]
        });
        let mut explanation = Self {
            dim: D,
            masses,
            along: plain(given),
            normal: plain(normal),
            restitution: e,
            friction: question.friction,
            tangential: question.tangential,
            law: question.law,
            radius: question.radius,
            inertia: kappa,
            before: state(0, before),
            after: state(1, after),
            approach: approach + 0.0,
            departure: departure + 0.0,
            reduced_mass,
            impulse: parts[0].norm(),
            exchanged: plain(impulse),
            friction_impulse: plain(parts[1]),
            rough,
            lost,
            work: work + 0.0,
            spin_energy: spin_energy[0],
            duration: question.duration,
            mean_force,
            origins: question.origins.clone(),
            rotated: in_the_plane(question, &plain(given), &plain(parts[1])),
            special: Vec::new(),
            checks: Default::default(),
        };
        explanation.refuse_overflow()?;
        explanation.special = special::holding(&explanation);
        explanation.checks = check::all(&explanation);
        Ok(explanation)
    }

    /// Which body is a wall (of infinite mass), if one is.
    pub fn wall(&self) -> Option<usize> {
        self.masses.iter().position(|m| m.is_infinite())
    }

    /// True if the bodies approach and so exchange an impulse.
    pub fn meets(&self) -> bool {
        self.approach > 0.0
    }

    /// The component of a vector along the line of centres.
    pub(super) fn normal_part(&self, v: &[f64]) -> f64 {
        v.iter().zip(&self.normal).map(|(v, n)| v * n).sum()
    }

    fn refuse_overflow(&self) -> Result<(), Mistake> {
        let states = [&self.before, &self.after].into_iter();
        let mut numbers: Vec<f64> = states
            .flat_map(|s| s.velocity.iter().flatten().chain(s.momentum.iter().flatten()).chain([&s.energy]))
            .copied()
            .collect();
        numbers.extend([self.approach, self.departure, self.reduced_mass, self.impulse, self.lost, self.work]);
        numbers.extend(self.mean_force.iter().flatten().flatten());
        numbers.extend(self.after.spin.iter().flatten());
        if numbers.iter().all(|x| x.is_finite()) {
            return Ok(());
        }
        Err(Mistake::new(
            "velocity",
            "masses or velocities are too large or too small: the result is no longer a finite number",
        ))
    }
}

/// The energy of the spins of the bodies whose mass is finite, with I = kappa m R^2; 0 without radii.
fn spin_energy(question: &Question, spin: &[Vec<f64>; 2]) -> f64 {
    let Some(radius) = question.radius else { return 0.0 };
    let kappa = question.kappa();
    let one = |k: usize| {
        let square: f64 = spin[k].iter().map(|w| w * w).sum();
        0.5 * kappa[k] * question.masses[k] * radius[k] * radius[k] * square
    };
    (0..2).filter(|k| question.masses[*k].is_finite()).map(one).sum()
}

/// The lecture's frame: its closed form along the line of centres, and friction, if there is any, across it.
fn in_the_plane(question: &Question, along: &[f64], friction: &[f64]) -> Option<Rotated> {
    let two = |v: &[f64]| <[f64; 2]>::try_from(v).ok().map(Vector);
    let velocity = [two(&question.velocity[0])?, two(&question.velocity[1])?];
    let (seen, _) = rotated::impact(question.masses, velocity, two(along)?, question.restitution);
    let (_, across) = seen.frame.enter(two(friction)?);
    let pairs = |pairs: [(f64, f64); 2]| pairs.map(|(p, n)| [p + 0.0, n + 0.0]);
    let mut after = pairs(seen.after);
    after[0][1] -= across / question.masses[0];
    after[1][1] += across / question.masses[1];
    Some(Rotated { theta: seen.frame.theta + 0.0, before: pairs(seen.before), after })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a9_of_the_theory() {
        let question = Question::new([2.0, 3.0], [vec![5.0, 0.0], vec![-1.0, 2.0]]).normal([3.0, 4.0]).restitution(0.5);
        let x = question.answer().unwrap();
        let want = [[98.0 / 25.0, -36.0 / 25.0], [-7.0 / 25.0, 74.0 / 25.0]];
        for (got, want) in x.after.velocity.iter().flatten().zip(want.iter().flatten()) {
            assert!((got - want).abs() < 1e-15, "{got} {want}"); // two units in the last place of 3.92
        }
        assert_eq!((x.approach, x.departure, x.impulse), (2.0, 1.0, 3.6));
        assert!((x.lost - 1.8).abs() < 1e-15 && (x.reduced_mass - 1.2).abs() < 1e-15);
        assert!(x.checks.iter().all(|c| c.holds));
    }

    #[test]
    fn a_normal_of_any_length() {
        for length in [1e-300, 1e-12, 1.0, 1e12, 1e300] {
            let question = Question::new([2.0, 3.0], [vec![5.0, 0.0], vec![-1.0, 2.0]]).restitution(0.5);
            let x = question.normal([0.6 * length, 0.8 * length]).answer().unwrap();
            assert!((x.impulse - 3.6).abs() < 1e-14, "{length} {}", x.impulse);
        }
    }

    #[test]
    fn a_piston_works() {
        // THEORY 1.4, A6: 2 m/s against a wall coming at 3 m/s gives 8 m/s back; 30 J of work, nothing lost.
        let x = Question::new([1.0, f64::INFINITY], [vec![2.0], vec![-3.0]]).answer().unwrap();
        assert_eq!(x.after.velocity, [[-8.0], [-3.0]]);
        assert_eq!((x.before.energy, x.work, x.after.energy, x.lost), (2.0, 30.0, 32.0, 0.0));
        assert_eq!(x.before.momentum, None);
    }

    #[test]
    fn spins_keep_their_energy() {
        let question = Question::new([2.0, 3.0], [vec![5.0, 0.0], vec![-1.0, 2.0]]).normal([3.0, 4.0]);
        let question = Question { spin: Some([vec![4.0], vec![0.0]]), radius: Some([0.5, 1.0]), ..question };
        let x = question.answer().unwrap();
        assert_eq!(x.spin_energy, 0.5 * (0.5 * 2.0 * 0.25) * 16.0);
        assert_eq!(x.before.energy, 25.0 + 7.5 + x.spin_energy);
        assert_eq!(x.after.spin, x.before.spin);
    }

    /// THEORY 2.2: a solid sphere of unit mass and radius on a floor; (vx, vz, wy) in and out, exactly.
    #[test]
    fn a_sphere_on_a_floor() {
        let table = [
            ([3.0, -2.0, 0.0], 0.5, 0.0, 10.0, [15.0 / 7.0, 1.0, 15.0 / 7.0], true, 39.0 / 14.0),
            ([3.0, -2.0, 0.0], 0.5, 0.0, 0.1, [2.7, 1.0, 0.75], false, 897.0 / 400.0),
            ([3.0, -2.0, 0.0], 1.0, 1.0, 10.0, [9.0 / 7.0, 2.0, 30.0 / 7.0], true, 0.0),
            ([0.0, -2.0, 5.0], 0.8, 0.0, 10.0, [10.0 / 7.0, 1.6, 10.0 / 7.0], true, 751.0 / 175.0),
        ];
        for ([vx, vz, wy], e, e_t, mu, want, sticks, lost) in table {
            let question = Question::new([1.0, f64::INFINITY], [vec![vx, 0.0, vz], vec![0.0; 3]])
                .normal([0.0, 0.0, -1.0])
                .restitution(e)
                .friction(mu, [1.0, 1.0])
                .tangential(e_t)
                .spin([vec![0.0, wy, 0.0], vec![0.0; 3]]);
            let x = question.answer().unwrap();
            let got = [x.after.velocity[0][0], x.after.velocity[0][2], x.after.spin[0][1]];
            for (got, want) in got.iter().zip(want) {
                assert!((got - want).abs() < 1e-14, "{got} {want}"); // a dozen roundings of numbers below 5
            }
            assert_eq!(x.rough.as_ref().map(|r| r.sticks), Some(sticks));
            assert!((x.lost - lost).abs() < 1e-14, "{} {lost}", x.lost);
            assert!(x.checks.iter().all(|c| c.holds), "{:?}", x.checks);
        }
    }

    #[test]
    fn without_friction_nothing_changes() {
        // Radii, spins and e_t alone move no bit of the smooth impact.
        let plain = Question::new([2.0, 3.0], [vec![5.0, 0.0], vec![-1.0, 2.0]]).normal([3.0, 4.0]).restitution(0.3);
        let turning = plain.clone().friction(0.0, [0.1, 0.2]).tangential(0.7).spin([vec![3.0], vec![-1.0]]);
        let (x, y) = (plain.answer().unwrap(), turning.answer().unwrap());
        assert_eq!((&x.after.velocity, x.lost, &x.rotated), (&y.after.velocity, y.lost, &y.rotated));
        assert_eq!((&y.after.spin, y.rough), (&y.before.spin, None));
        // On the line friction has nothing to act on.
        let line = Question { friction: 0.5, ..Question::new([2.0, 1.0], [vec![3.0], vec![-1.0]]) };
        assert_eq!(line.answer().unwrap().rough, None);
    }
}
