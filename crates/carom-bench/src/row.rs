//! One row: a workload at one size, measured.
use crate::clock::{cpu_seconds, seconds};
use crate::gas::Gas;
use crate::workload::Workload;
use crate::yardstick::Yardstick;
use carom::{Rotates, Vector};

/// How much time a measurement may take.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// CPU time for the slices (s).
    pub seconds: f64,
    /// The most slices.
    pub slices: usize,
    /// Threads that work on the world. With more than one, its times are wall times.
    pub threads: usize,
}

impl Default for Effort {
    fn default() -> Self {
        Self { seconds: 5.0, slices: 24, threads: 1 }
    }
}

/// What was measured.
#[derive(Clone, Debug)]
pub struct Row {
    /// The workload's name.
    pub name: String,
    /// The number of balls.
    pub n: usize,
    /// CPU time an impact (wall time with many threads), everything paid (ns): the best slice.
    pub ns_per_impact: f64,
    /// The yardstick for as many balls, in the same minute (ns).
    pub yardstick_ns: f64,
    /// The one over the other.
    pub yardsticks: f64,
    /// What the world holds in memory, over the number of balls (bytes).
    pub bytes_per_ball: f64,
    /// What the ledger cannot explain of the energy, over the whole run.
    pub energy_drift: f64,
    /// The compressibility factor from the virial; none under gravity and in a gas that cools.
    pub z: Option<f64>,
    /// The same by the equation of state, where one is good enough.
    pub expected_z: Option<f64>,
    /// CPU time to set the world up: adding the balls, first predictions (s).
    pub set_up: f64,
}

/// A slice of the engine has this many impacts at least, and half as many as there are balls, up to the most.
const LEAST: u64 = 20_000;
const MOST: u64 = 250_000;
/// A slice of the yardstick.
const PAIRS: usize = 30_000;

/// Measures a workload with about `n` balls.
///
/// # Errors
/// In words, if so few balls do not fit.
pub fn measure(workload: &Workload, n: usize, effort: Effort) -> Result<Row, String> {
    match workload.dim {
        2 => row::<2>(workload, n, effort),
        _ => row::<3>(workload, n, effort),
    }
}

fn row<const D: usize>(workload: &Workload, n: usize, effort: Effort) -> Result<Row, String>
where
    Vector<D>: Rotates,
{
    let mut gas = Gas::<D>::with_threads(workload, n, effort.threads)?;
    let mut yardstick = Yardstick::new(gas.count);
    let steps = (gas.count as u64 / 2).clamp(LEAST, MOST);
    let (mut best, mut stick) = (f64::INFINITY, f64::INFINITY);
    let start = cpu_seconds();
    for _ in 0..effort.slices {
        let then = seconds(effort.threads);
        let done = gas.steps(steps);
        let taken = (seconds(effort.threads) - then) * 1e9 / done.max(1) as f64;
        best = best.min(taken);
        stick = stick.min(yardstick.slice(PAIRS));
        if cpu_seconds() - start > effort.seconds {
            break;
        }
    }
    // Before reports are kept: these are not the world's.
    let bytes_per_ball = gas.world.bytes() as f64 / gas.count as f64;
    let z = gas.z((2 * steps).clamp(100_000, MOST));
    Ok(Row {
        name: workload.name(),
        n: gas.count,
        ns_per_impact: best,
        yardstick_ns: stick,
        yardsticks: best / stick,
        bytes_per_ball,
        energy_drift: gas.world.ledger().energy.drift,
        z,
        expected_z: workload.expected_z(),
        set_up: gas.set_up,
    })
}
