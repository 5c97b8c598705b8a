//! Where the coefficients of an impact of a run come from: a material, two of them, a line of the pair table.
use carom::{Coefficient, Law};
use serde::Serialize;

use crate::model::{Pair, Surface};
use crate::output::ImpactLine;
use crate::plan::Plan;

/// Who gave a coefficient its value.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "from", rename_all = "kebab-case")]
pub enum Source {
    /// A line of the pair table, for these two materials.
    Pair {
        /// The two materials.
        materials: [String; 2],
    },
    /// Both materials, each with its value: the geometric mean, or the mean of a tangential restitution.
    Both {
        /// The two materials.
        materials: [String; 2],
        /// What each of them says.
        said: [f64; 2],
    },
    /// The one material that says anything, or the material that both have.
    One {
        /// The material.
        material: String,
    },
    /// Neither says a word: the lecture's smooth elastic ball.
    Unsaid,
    /// The impact was plastic, whatever the materials say: slower than `rest_speed` in a contact that lasts.
    Rest,
}

/// A coefficient of an impact and where it comes from.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Origin {
    /// Its value in this impact.
    pub value: f64,
    /// Who gave it.
    #[serde(flatten)]
    pub source: Source,
    /// The speed (m/s) at which a curve was read, if the value is a curve's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed: Option<f64>,
}

/// Where the coefficients of an impact come from.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Origins {
    /// e, by approach speed.
    pub restitution: Origin,
    /// mu, by slip speed.
    pub friction: Origin,
    /// e_t.
    pub tangential: Origin,
    /// The law: the pair's, or that of the run.
    #[serde(serialize_with = "name")]
    pub law: Law,
}

fn name<S: serde::Serializer>(law: &Law, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(law.as_str())
}

/// How the value of two materials is made from what they say.
type Mean = fn(f64, f64) -> f64;

fn geometric(a: f64, b: f64) -> f64 {
    // As the library combines them: equal values need no root.
    if a == b { a } else { (a * b).sqrt() }
}

fn arithmetic(a: f64, b: f64) -> f64 {
    0.5 * (a + b)
}

/// One coefficient: what the pair says, else what the surfaces say, read at a speed.
fn one(
    pair: Option<&Coefficient>,
    says: [Option<&Coefficient>; 2],
    names: &[String; 2],
    speed: f64,
    mean: Mean,
    unsaid: f64,
) -> Origin {
    let curve = |c: &Coefficient| matches!(c, Coefficient::Curve(_));
    let read = |all: &[&Coefficient]| all.iter().any(|c| curve(c)).then_some(speed);
    match (pair, says) {
        (Some(c), _) => {
            Origin { value: c.at(speed), source: Source::Pair { materials: names.clone() }, speed: read(&[c]) }
        }
        (_, [Some(a), Some(b)]) if names[0] != names[1] => {
            let said = [a.at(speed), b.at(speed)];
            let value = mean(said[0], said[1]);
            Origin { value, source: Source::Both { materials: names.clone(), said }, speed: read(&[a, b]) }
        }
        (_, [Some(c), _]) => {
            Origin { value: c.at(speed), source: Source::One { material: names[0].clone() }, speed: read(&[c]) }
        }
        (_, [None, Some(c)]) => {
            Origin { value: c.at(speed), source: Source::One { material: names[1].clone() }, speed: read(&[c]) }
        }
        (None, [None, None]) => Origin { value: unsaid, source: Source::Unsaid, speed: None },
    }
}

/// The coefficients of the impact of two materials (by their numbers) at its speeds; `None` if a number is no material.
pub(super) fn of(plan: &Plan, materials: [usize; 2], line: &ImpactLine, slip: f64) -> Option<Origins> {
    let surfaces: [&Surface; 2] = [plan.materials.get(materials[0])?, plan.materials.get(materials[1])?];
    let names = surfaces.map(|s| s.name.clone());
    let about = |p: &&Pair| p.materials == names || (p.materials[0] == names[1] && p.materials[1] == names[0]);
    let pair = plan.pairs.iter().find(about);
    let unsaid = carom::material::UNSAID;
    let e = one(
        pair.and_then(|p| p.restitution.as_ref()),
        surfaces.map(|s| s.restitution.as_ref()),
        &names,
        line.approach,
        geometric,
        unsaid.restitution,
    );
    let friction = one(
        pair.and_then(|p| p.friction.as_ref()),
        surfaces.map(|s| s.friction.as_ref()),
        &names,
        slip,
        geometric,
        unsaid.friction,
    );
    let constant = |t: Option<f64>| t.map(Coefficient::Constant);
    let (of_pair, of_each) = (constant(pair.and_then(|p| p.tangential)), surfaces.map(|s| constant(s.tangential)));
    let tangential =
        one(of_pair.as_ref(), of_each.each_ref().map(Option::as_ref), &names, slip, arithmetic, unsaid.tangential);
    // What was used is what the run says; if it is not what the surfaces say, the contact was at rest.
    let at_rest = (e.value - line.restitution).abs() > 1e-12;
    let restitution = if at_rest { Origin { value: line.restitution, source: Source::Rest, speed: None } } else { e };
    let law = pair.and_then(|p| p.law).unwrap_or(plan.law).into();
    Some(Origins { restitution, friction, tangential, law })
}
