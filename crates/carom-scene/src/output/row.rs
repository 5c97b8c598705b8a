//! One body at one time: a row of a trajectory.
use carom::{BodyId, Rotates, Vector, World};
use serde::Serialize;

use super::{compact, csv};
use crate::plan::Plan;

/// One body at one time. Keys in the order of the format.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyLine {
    /// When (s).
    pub time: f64,
    /// Who.
    pub name: String,
    /// Where its centre is (m).
    pub position: Vec<f64>,
    /// Velocity (m/s).
    pub velocity: Vec<f64>,
    /// Spin (rad/s).
    pub spin: Vec<f64>,
}

impl BodyLine {
    /// A body as it is now, of a world that was built from this plan.
    pub fn new<const D: usize>(world: &World<D>, id: BodyId, plan: &Plan) -> Self
    where
        Vector<D>: Rotates,
    {
        Self {
            time: world.time(),
            name: plan.name(id.index()),
            position: world.position(id).map(|v| v.0.to_vec()).unwrap_or_default(),
            velocity: world.velocity(id).map(|v| v.0.to_vec()).unwrap_or_default(),
            spin: world.spin(id).map(|w| Vector::<D>::spin_slice(&w).to_vec()).unwrap_or_default(),
        }
    }

    /// One JSON object on one line, without the line's end.
    pub fn json(&self) -> String {
        compact(self)
    }

    /// The head of a table of bodies in this dimension, without the line's end.
    pub fn csv_head(dim: usize) -> String {
        let mut row = csv::Row::default();
        row.texts(["time", "name"]).components("position", dim).components("velocity", dim).spins("spin", dim);
        row.end()
    }

    /// A row of that table, without the line's end.
    pub fn csv(&self) -> String {
        let mut row = csv::Row::default();
        row.number(self.time).text(&self.name);
        row.numbers(&self.position).numbers(&self.velocity).numbers(&self.spin);
        row.end()
    }
}
