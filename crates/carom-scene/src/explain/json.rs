//! The explanation as programs read it. Never a decimal comma, never a rounded number.
use super::{Explanation, State};
use serde::Serialize;

#[derive(Serialize)]
struct Numbers<'a> {
    velocity: &'a [Vec<f64>; 2],
    spin: &'a [Vec<f64>; 2],
    momentum: &'a Option<Vec<f64>>,
    energy: f64,
}

impl<'a> From<&'a State> for Numbers<'a> {
    fn from(s: &'a State) -> Self {
        Self { velocity: &s.velocity, spin: &s.spin, momentum: &s.momentum, energy: s.energy }
    }
}

#[derive(Serialize)]
struct Frame {
    theta: f64,
    before: [[f64; 2]; 2],
    after: [[f64; 2]; 2],
}

#[derive(Serialize)]
struct Slip<'a> {
    before: &'a [f64],
    after: &'a [f64],
    tangential_mass: f64,
    stick: f64,
    limit: f64,
    sticks: bool,
}

fn compact(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_else(|_| "null".into())
}

impl Explanation {
    /// One JSON object, a line per key. Lengths, units and signs are those of the fields; an infinite mass is null;
    /// `mean_force` is there with a duration, `rotated` in the plane. With friction there are also `tangential`, `law`, `slip`
    /// (m/s before and after, the mass of the slip, the impulse that would stick, Coulomb's limit, and which of them holds),
    /// `lost_normal` and `lost_friction`. Of an impact of a run `origins` says where each coefficient comes from.
    pub fn json(&self) -> String {
        let masses = self.masses.map(|m| m.is_finite().then_some(m));
        let mut fields = vec![
            ("dim", compact(&self.dim)),
            ("masses", compact(&masses)),
            ("normal", compact(&self.normal)),
            ("restitution", compact(&self.restitution)),
            ("friction", compact(&self.friction)),
            ("before", compact(&Numbers::from(&self.before))),
            ("approach", compact(&self.approach)),
            ("reduced_mass", compact(&self.reduced_mass)),
            ("impulse", compact(&self.impulse)),
            ("friction_impulse", compact(&self.friction_impulse)),
            ("after", compact(&Numbers::from(&self.after))),
            ("departure", compact(&self.departure)),
            ("lost", compact(&self.lost)),
        ];
        if let Some(r) = &self.rough {
            let slip = Slip {
                before: &r.slip[0],
                after: &r.slip[1],
                tangential_mass: r.tangential_mass,
                stick: r.stick,
                limit: r.limit,
                sticks: r.sticks,
            };
            fields.push(("tangential", compact(&self.tangential)));
            fields.push(("law", compact(&self.law.as_str())));
            fields.push(("slip", compact(&slip)));
            fields.push(("lost_normal", compact(&r.lost_normal)));
            fields.push(("lost_friction", compact(&r.lost_friction)));
        }
        if let Some(origins) = &self.origins {
            fields.push(("origins", compact(origins)));
        }
        if let Some(force) = &self.mean_force {
            fields.push(("mean_force", compact(force)));
        }
        if let Some(r) = &self.rotated {
            fields.push(("rotated", compact(&Frame { theta: r.theta, before: r.before, after: r.after })));
        }
        let lines: Vec<String> = fields.into_iter().map(|(key, value)| format!("  \"{key}\": {value}")).collect();
        format!("{{\n{}\n}}\n", lines.join(",\n"))
    }
}
