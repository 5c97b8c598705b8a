//! A run in one object: how it ended, where the bodies are, and what the audit says.
use carom::ledger::Account;
use carom::{Rotates, Stop, Vector, World};
use serde::Serialize;

use super::compact;
use crate::model::Scene;
use crate::plan::Plan;

/// A body at the end of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyState {
    /// Its name.
    pub name: String,
    /// Mass (kg); `None` of a fixed body without one.
    pub mass: Option<f64>,
    /// Radius (m).
    pub radius: f64,
    /// Where its centre is (m).
    pub position: Vec<f64>,
    /// Velocity (m/s).
    pub velocity: Vec<f64>,
    /// Spin (rad/s).
    pub spin: Vec<f64>,
    /// "free", "resting" or "fixed".
    pub state: &'static str,
}

/// The account of momentum or angular momentum: end = start + given, but for the drift.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Share {
    /// What there was.
    pub start: Vec<f64>,
    /// What there is.
    pub end: Vec<f64>,
    /// What gravity, walls and fixed bodies gave.
    pub given: Vec<f64>,
    /// What nothing explains, relative to the account's scale.
    pub drift: f64,
}

/// The account of energy (J): end = start - lost + work, but for the drift.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Energy {
    /// Kinetic and potential energy at the start.
    pub start: f64,
    /// The same at the end.
    pub end: f64,
    /// The kinetic part of the end.
    pub kinetic: f64,
    /// The potential part of the end.
    pub potential: f64,
    /// What impacts, friction and rest took.
    pub lost: f64,
    /// What driven walls and bodies put in.
    pub work: f64,
    /// What nothing explains, relative to the account's scale.
    pub drift: f64,
}

/// The audit of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Audit {
    /// Momentum (N s).
    pub momentum: Share,
    /// Angular momentum about the origin (N m s); `None` in a periodic world.
    pub angular_momentum: Option<Share>,
    /// Energy (J).
    pub energy: Energy,
    /// The deepest overlap that was seen, divided by the smaller radius.
    pub overlap: f64,
    /// How often an iteration limit ended an instant.
    pub capped: u64,
    /// True if everything is explained.
    pub pass: bool,
}

/// A run in one object. Keys in the order of the format.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The version of the engine.
    pub carom: &'static str,
    /// The scene's title.
    pub title: String,
    /// 1, 2 or 3.
    pub dim: usize,
    /// The scene's seed.
    pub seed: u64,
    /// Why it ended: see [`stop_name`].
    pub stopped: &'static str,
    /// When it ended (s).
    pub time: f64,
    /// How many impacts there were.
    pub impacts: u64,
    /// How many events there were: impacts, crossings, slices and the like.
    pub events: u64,
    /// The bodies, in the order of their ids.
    pub bodies: Vec<BodyState>,
    /// The audit.
    pub audit: Audit,
    /// The digest of the final state, in 16 hexadecimal digits.
    pub digest: String,
}

/// How a report names the end of a run: "time", "impacts", "rest" or "quiet" where a limit of the scene was reached,
/// "interrupted", "crushed" or "not-finite" where it was cut short.
pub fn stop_name(stop: Stop) -> &'static str {
    match stop {
        Stop::Time => "time",
        Stop::Impacts => "impacts",
        Stop::Rest => "rest",
        Stop::Quiet => "quiet",
        Stop::Interrupted => "interrupted",
        Stop::Crushed => "crushed",
        Stop::NotFinite => "not-finite",
    }
}

impl Audit {
    /// The audit of a world as it is now. Looks for overlaps first.
    pub fn new<const D: usize>(world: &mut World<D>) -> Self
    where
        Vector<D>: Rotates,
    {
        world.deepest_overlap();
        let ledger = world.ledger();
        let spin = |s: &<Vector<D> as Rotates>::Spin| Vector::<D>::spin_slice(s).to_vec();
        let Account { start, end, given, drift } = ledger.momentum;
        let energy = ledger.energy;
        Self {
            momentum: Share { start: start.0.to_vec(), end: end.0.to_vec(), given: given.0.to_vec(), drift },
            angular_momentum: ledger.angular_momentum.map(|a| Share {
                start: spin(&a.start),
                end: spin(&a.end),
                given: spin(&a.given),
                drift: a.drift,
            }),
            energy: Energy {
                start: energy.start,
                end: energy.end,
                kinetic: energy.kinetic,
                potential: energy.potential,
                lost: energy.lost,
                work: energy.work,
                drift: energy.drift,
            },
            overlap: ledger.overlap,
            capped: ledger.capped,
            pass: ledger.pass(),
        }
    }

    /// The largest drift of all accounts; not a number if one of them is not.
    pub fn worst(&self) -> f64 {
        let angular = self.angular_momentum.as_ref().map_or(0.0, |a| a.drift);
        [self.momentum.drift, angular, self.energy.drift]
            .into_iter()
            .fold(0.0, |worst, drift| if drift <= worst || f64::is_nan(worst) { worst } else { drift })
    }
}

impl Report {
    /// What there is to say of a world that was built from this plan and has stopped.
    pub fn new<const D: usize>(scene: &Scene, plan: &Plan, world: &mut World<D>, stop: Stop) -> Self
    where
        Vector<D>: Rotates,
    {
        let audit = Audit::new(world);
        let bodies = world.bodies().filter_map(|id| {
            let fixed = world.is_fixed(id).ok()?;
            Some(BodyState {
                name: plan.name(id.index()),
                mass: world.mass(id).ok().filter(|m| m.is_finite()),
                radius: world.radius(id).ok()?,
                position: world.position(id).ok()?.0.to_vec(),
                velocity: world.velocity(id).ok()?.0.to_vec(),
                spin: Vector::<D>::spin_slice(&world.spin(id).ok()?).to_vec(),
                state: match (fixed, world.rests(id).ok()?) {
                    (true, _) => "fixed",
                    (_, true) => "resting",
                    _ => "free",
                },
            })
        });
        Self {
            carom: env!("CARGO_PKG_VERSION"),
            title: scene.title.clone(),
            dim: D,
            seed: scene.run.seed,
            stopped: stop_name(stop),
            time: world.time(),
            impacts: world.impact_count(),
            // An instant is one event of the clock, and may hold several impacts.
            events: (world.event_count() + world.slice_count()).max(world.impact_count()),
            bodies: bodies.collect(),
            audit,
            digest: format!("{:016x}", world.digest()),
        }
    }

    /// One JSON object: a line per key, per body and per account.
    pub fn json(&self) -> String {
        let list = |items: Vec<String>, open: char, close: char| match items.is_empty() {
            true => format!("{open}{close}"),
            false => format!("{open}\n    {}\n  {close}", items.join(",\n    ")),
        };
        let audit = &self.audit;
        let accounts = vec![
            format!("\"momentum\": {}", compact(&audit.momentum)),
            format!("\"angular_momentum\": {}", compact(&audit.angular_momentum)),
            format!("\"energy\": {}", compact(&audit.energy)),
            format!("\"overlap\": {}", compact(&audit.overlap)),
            format!("\"capped\": {}", audit.capped),
            format!("\"pass\": {}", audit.pass),
        ];
        let fields = [
            ("carom", compact(&self.carom)),
            ("title", compact(&self.title)),
            ("dim", compact(&self.dim)),
            ("seed", compact(&self.seed)),
            ("stopped", compact(&self.stopped)),
            ("time", compact(&self.time)),
            ("impacts", compact(&self.impacts)),
            ("events", compact(&self.events)),
            ("bodies", list(self.bodies.iter().map(compact).collect(), '[', ']')),
            ("audit", list(accounts, '{', '}')),
            ("digest", compact(&self.digest)),
        ];
        let lines: Vec<String> = fields.into_iter().map(|(key, value)| format!("  \"{key}\": {value}")).collect();
        format!("{{\n{}\n}}\n", lines.join(",\n"))
    }
}
