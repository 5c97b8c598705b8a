//! What is kept of a run for its plots.
use super::gaps::{Gaps, nearest};
use super::what::What;
use crate::cast::Cast;
use crate::snapshot::{Energy, Hit, Snapshot};
use crate::trace::Trace;
use carom::{Rotates, Vector, World};
use carom_scene::Point;

/// Speeds kept for the histogram.
const MOST_SPEEDS: usize = 200_000;
/// Bodies whose paths are drawn.
pub(super) const MOST_PATHS: usize = 60;

/// The accounts at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// s
    pub time: f64,
    /// J
    pub energy: Energy,
    /// The momentum of all (N s).
    pub momentum: Point,
    /// What gravity, walls and fixed bodies gave of it since the start (N s).
    pub given: Point,
}

/// A run, as its plots need it.
#[derive(Clone, Debug)]
pub struct History {
    /// Who is in it.
    pub cast: Cast,
    what: What,
    /// The accounts, at the times that were looked at.
    pub samples: Vec<Sample>,
    /// The smallest gaps, at the same times.
    pub gaps: Vec<Gaps>,
    /// Speeds (m/s) and masses (kg), of the later half of the run.
    pub speeds: Vec<(f64, f64)>,
    /// Paths of bodies, with a corner at every impact.
    pub trace: Trace,
    end: f64,
}

impl History {
    /// Nothing yet of a run that ends at this time (s).
    pub fn new(cast: Cast, what: What, end: f64) -> Self {
        let trace = Trace::new(if what == What::Spacetime { f64::INFINITY } else { 0.0 }, 0.0);
        Self { cast, what, samples: Vec::new(), gaps: Vec::new(), speeds: Vec::new(), trace, end }
    }

    /// Takes note of an impact.
    pub fn hit(&mut self, hit: &Hit) {
        self.trace.hit(hit, &self.cast);
    }

    /// What is plotted.
    pub fn what(&self) -> What {
        self.what
    }

    /// Takes a look.
    pub fn look<const D: usize>(&mut self, world: &World<D>)
    where
        Vector<D>: Rotates,
    {
        let snapshot = Snapshot::of(world);
        let ledger = world.ledger();
        let padded = |v: Vector<D>| -> Point { std::array::from_fn(|k| if k < D { v[k] } else { 0.0 }) };
        self.samples.push(Sample {
            time: snapshot.time,
            energy: snapshot.energy,
            momentum: padded(ledger.momentum.end),
            given: padded(ledger.momentum.given),
        });
        match self.what {
            What::Gaps => self.gaps.push(nearest(&snapshot, &self.cast)),
            What::Spacetime => self.trace.look(&snapshot, &self.cast),
            What::Speed if snapshot.time >= 0.5 * self.end => {
                for k in self.cast.free() {
                    if let (Some(moment), Some(mass)) = (snapshot.moments.get(k), self.cast.actors[k].mass)
                        && self.speeds.len() < MOST_SPEEDS
                    {
                        self.speeds.push((moment.speed(), mass));
                    }
                }
            }
            _ => {}
        }
    }
}
