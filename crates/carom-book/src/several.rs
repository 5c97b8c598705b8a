//! Cases of several contacts at one instant: an operator is asked without a world.
//!
//! Words: `v[1]` ... (the velocity of a degree of freedom after), `lambda[1]` ... (the impulse of a contact, N s), `kinetic`, `lost` (J), `iterations`,
//! `capped` (0 or 1), `locked` (how many contacts).
use carom::law::together::{self, Solver, System, Together};

use crate::case::{Names, Several};
use crate::formula::{Misread, Words};

/// What an operator did.
pub struct Done {
    velocity: Vec<f64>,
    lambda: Vec<f64>,
    kinetic: f64,
    lost: f64,
    iterations: u32,
    capped: bool,
    locked: u32,
}

/// Asks the operator.
pub fn ask(several: &Several, names: &Names<'_>) -> Result<Done, Misread> {
    let (mass, velocity) = (names.list(&several.mass)?, names.list(&several.velocity)?);
    if mass.len() != velocity.len() {
        return Err(Misread(format!("{} masses, {} velocities", mass.len(), velocity.len())));
    }
    let mut system = System::new();
    let freedoms = several.freedoms.unwrap_or(1).max(1);
    let pairs: Vec<(f64, f64)> = velocity.iter().zip(&mass).map(|(v, m)| (*v, 1.0 / m)).collect();
    for body in pairs.chunks(freedoms) {
        system.body(body.iter().copied());
    }
    let drive = names.list(&several.drive)?;
    for (i, column) in several.columns.iter().enumerate() {
        let column = names.list(column)?;
        if column.len() != mass.len() {
            return Err(Misread(format!("column {} has {} entries instead of {}", i + 1, column.len(), mass.len())));
        }
        system.contact(column.into_iter().enumerate(), drive.get(i).copied().unwrap_or(0.0));
    }
    if several.columns.is_empty() {
        for i in 1..mass.len() {
            system.contact([(i - 1, -1.0), (i, 1.0)], 0.0);
        }
    }
    let e = names.list(&several.restitution)?;
    let e_of = |i: usize| e.get(if e.len() == 1 { 0 } else { i }).copied().unwrap_or(f64::NAN);
    let before = system.kinetic_energy();
    let outcome = match several.operator.as_str() {
        "gr" => together::gr(&mut system),
        "grr" => together::grr(&mut system, e_of(0)),
        "project" => {
            let mut solver = Solver::new();
            let projection = solver.project(&mut system, &[], &[]);
            let capped = !projection.converged;
            together::Outcome { lambda: projection.lambda.clone(), iterations: 1, capped, ..Default::default() }
        }
        name => {
            let Some(how) = Together::ALL.into_iter().find(|how| how.as_str() == name) else {
                return Err(Misread(format!("there is no operator \"{name}\"")));
            };
            Solver::new().resolve(how, &mut system, |i, _| e_of(i)).clone()
        }
    };
    let kinetic = system.kinetic_energy();
    Ok(Done {
        velocity: system.velocities().to_vec(),
        kinetic,
        lost: if several.operator == "project" { before - kinetic } else { outcome.lost },
        iterations: outcome.iterations,
        capped: outcome.capped,
        locked: outcome.locked,
        lambda: outcome.lambda,
    })
}

impl Words for Done {
    fn name(&self, name: &str) -> Result<f64, Misread> {
        match name {
            "kinetic" => Ok(self.kinetic),
            "lost" => Ok(self.lost),
            "iterations" => Ok(f64::from(self.iterations)),
            "capped" => Ok(f64::from(u8::from(self.capped))),
            "locked" => Ok(f64::from(self.locked)),
            "momentum" => Err(Misread("write the sum of m v out".into())),
            _ => Err(Misread(format!("several contacts have no `{name}`"))),
        }
    }

    fn of(&self, word: &str, what: &str) -> Result<f64, Misread> {
        let list = match word {
            "v" => &self.velocity,
            "lambda" => &self.lambda,
            _ => return Err(Misread(format!("several contacts have no `{word}[{what}]`"))),
        };
        let k = what.parse::<usize>().ok().and_then(|k| k.checked_sub(1));
        let found = k.and_then(|k| list.get(k)).copied();
        found.ok_or_else(|| Misread(format!("`{word}` goes from 1 to {}, not to `{what}`", list.len())))
    }
}
