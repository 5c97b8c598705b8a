//! One contact that exchanged an impulse.
use carom::{Impact, Rotates, State, Vector};
use serde::{Deserialize, Serialize};

use super::{compact, csv};
use crate::plan::Plan;

/// How a party moved. A wall has a velocity, and spins that are zero.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Velocity (m/s).
    pub velocity: Vec<f64>,
    /// Spin (rad/s): no number on a line, one in the plane, three in space.
    pub spin: Vec<f64>,
}

/// One contact that exchanged an impulse, with names: a line of `carom events`. Keys in the order of the format.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImpactLine {
    /// The number of the line, from 1.
    pub n: u64,
    /// When (s).
    pub time: f64,
    /// Who: "A", "wall:floor", "boundary:x-". Of two balls the earlier in the file comes first; balls come before walls.
    pub bodies: [String; 2],
    /// Where they touched (m).
    pub point: Vec<f64>,
    /// Unit vector from the first to the second.
    pub normal: Vec<f64>,
    /// (va - vb).n before (m/s).
    pub approach: f64,
    /// -(va - vb).n after (m/s).
    pub departure: f64,
    /// The coefficient of restitution that was used first.
    pub restitution: f64,
    /// J >= 0 along the normal (N s): -J n on the first, +J n on the second.
    pub impulse: f64,
    /// The tangential impulse on the second (N s).
    pub friction_impulse: Vec<f64>,
    /// Both before the instant.
    pub before: [Motion; 2],
    /// Both after it.
    pub after: [Motion; 2],
    /// The kinetic energy that this contact took (J).
    pub lost: f64,
    /// How many contacts exchanged an impulse at this instant.
    pub together: u32,
}

impl ImpactLine {
    /// The `n`-th impact (from 1) of a world that was built from this plan.
    pub fn new<const D: usize>(n: u64, impact: &Impact<D>, plan: &Plan) -> Self
    where
        Vector<D>: Rotates,
    {
        let motion = |state: &State<D>| Motion {
            velocity: state.velocity.0.to_vec(),
            spin: Vector::<D>::spin_slice(&state.spin).to_vec(),
        };
        let both = |states: &[State<D>; 2]| [motion(&states[0]), motion(&states[1])];
        Self {
            n,
            time: impact.time,
            bodies: impact.parties.map(|p| plan.party(p)),
            point: impact.point.0.to_vec(),
            normal: impact.normal.0.to_vec(),
            approach: impact.approach,
            departure: impact.departure,
            restitution: impact.restitution,
            impulse: impact.impulse,
            friction_impulse: impact.friction_impulse.0.to_vec(),
            before: both(&impact.before),
            after: both(&impact.after),
            lost: impact.lost,
            together: impact.together,
        }
    }

    /// One JSON object on one line, without the line's end.
    pub fn json(&self) -> String {
        compact(self)
    }

    /// The head of a table of impacts in this dimension, without the line's end.
    pub fn csv_head(dim: usize) -> String {
        let mut row = csv::Row::default();
        row.texts(["n", "time", "first", "second"]);
        row.components("point", dim).components("normal", dim);
        row.texts(["approach", "departure", "restitution", "impulse"]);
        row.components("friction_impulse", dim);
        for when in ["before", "after"] {
            for who in ["first", "second"] {
                row.components(&format!("{who}_{when}_velocity"), dim);
                row.spins(&format!("{who}_{when}_spin"), dim);
            }
        }
        row.texts(["lost", "together"]);
        row.end()
    }

    /// A row of that table, without the line's end.
    pub fn csv(&self) -> String {
        let mut row = csv::Row::default();
        row.whole(self.n).number(self.time).texts(self.bodies.iter().map(String::as_str));
        row.numbers(&self.point).numbers(&self.normal);
        row.numbers(&[self.approach, self.departure, self.restitution, self.impulse]).numbers(&self.friction_impulse);
        for motion in self.before.iter().chain(&self.after) {
            row.numbers(&motion.velocity).numbers(&motion.spin);
        }
        row.number(self.lost).whole(u64::from(self.together));
        row.end()
    }
}
