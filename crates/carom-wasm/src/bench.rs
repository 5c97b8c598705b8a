//! A scene on the bench: opened, surveyed, looked at.
use carom::{Rotates, Vector, World};
use carom_scene::explain::Question;
use carom_scene::model::Scene;
use carom_scene::output::{ImpactLine, Report};
use carom_scene::{Document, Plan, Problem, Problems, build};

use crate::posed::Posed;
use crate::survey::Survey;
use crate::told::{json, tell};
use crate::{books, describe, samples};

/// How many numbers stand before the bodies in a frame. In this order: time, impacts, kinetic, potential, lost, work, momentum (three),
/// bodies, numbers per body, digest (high and low half), drift of momentum, drift of energy, deepest overlap.
const HEADER: usize = 16;

/// A scene that the page works with, whatever its dimension.
pub trait Bench {
    /// Title, bodies, walls and the like as one JSON object.
    fn describe(&self) -> String;
    /// Runs ahead by a piece of at most so many impacts; true when the run is over.
    fn survey(&mut self, impacts: u64) -> bool;
    /// How far the survey has come, as JSON; with the report of the run when it is over.
    fn surveyed(&mut self) -> String;
    /// The times of all impacts that the survey has seen.
    fn marks(&self) -> &[f64];
    /// The lines of impacts `from..from + count` (from 1), as a JSON array of those that were kept.
    fn lines(&self, from: u64, count: u64) -> String;
    /// What the n-th impact asks of the lecture; `None` if it was not kept, or was not alone in its instant.
    fn question(&self, n: u64) -> Option<Posed>;
    /// Momentum and energy before and after the instant of the n-th impact, as JSON.
    fn ledger_of(&self, n: u64) -> String;
    /// Momentum and energy from the start to where the page looks, as JSON.
    fn ledger(&self) -> String;
    /// Goes to a time (s) and says which one it is.
    fn seek(&mut self, time: f64) -> f64;
    /// Goes to the next impact before `horizon` and says when it is; not a number if there is none.
    fn next(&mut self, horizon: f64) -> f64;
    /// What the page looks at: see `HEADER`, then position, velocity, spin and a flag (1: at rest, 2: fixed) of every body.
    fn frame(&self, into: &mut Vec<f64>);
    /// Rows for plots: see the module `samples`.
    fn samples(&self, count: u32, into: &mut Vec<f64>);
    /// Turns every velocity round.
    fn reverse(&mut self) -> bool;
    /// The report of the world where the page looks, as `carom run --format json` prints it.
    fn report(&mut self) -> String;
}

pub(crate) struct Opened<const D: usize>
where
    Vector<D>: Rotates,
{
    pub scene: Scene,
    pub plan: Plan,
    pub notes: Vec<Problem>,
    pub survey: Survey<D>,
    pub world: World<D>,
    /// The world has been changed since it was built, and goes a way that the survey does not know.
    pub own_way: bool,
}

/// Why a scene is not on the bench.
#[derive(Debug)]
pub enum Refused {
    /// What is wrong with it, as a JSON array of `{ key, message, help, line, column }`.
    Problems(String),
    /// It is a scene of so many dimensions, which this build has not.
    Elsewhere(usize),
}

/// Reads a scene (TOML, or JSON if it begins with `{`) and puts it on the bench.
///
/// # Errors
/// See [`Refused`].
pub fn open(text: &str) -> Result<Box<dyn Bench>, Refused> {
    let told = |problems: Problems| Refused::Problems(tell(&problems.into_iter().collect::<Vec<_>>()));
    let document = Document::parse("scene", text).map_err(told)?;
    let scene = document.scene().map_err(told)?;
    let plan = document.plan(&scene).map_err(told)?;
    let notes = document.notes();
    match scene.world.dim {
        #[cfg(feature = "line")]
        1 => opened::<1>(scene, plan, notes),
        #[cfg(feature = "plane")]
        2 => opened::<2>(scene, plan, notes),
        #[cfg(feature = "space")]
        3 => opened::<3>(scene, plan, notes),
        other => Err(Refused::Elsewhere(other)),
    }
}

fn opened<const D: usize>(scene: Scene, plan: Plan, notes: Vec<Problem>) -> Result<Box<dyn Bench>, Refused>
where
    Vector<D>: Rotates,
{
    let told = |e: carom::Error| Refused::Problems(tell(&[Problem::new("", e.to_string())]));
    let start = || build::<D>(&scene, &plan).map_err(told);
    let (world, ahead) = (start()?, start()?);
    Ok(Box::new(Opened { survey: Survey::new(ahead), world, own_way: false, scene, plan, notes }))
}

impl<const D: usize> Bench for Opened<D>
where
    Vector<D>: Rotates,
{
    fn describe(&self) -> String {
        describe::scene(&self.scene, &self.plan, &self.notes)
    }

    fn survey(&mut self, impacts: u64) -> bool {
        self.survey.piece(&self.scene.run.until, impacts)
    }

    fn surveyed(&mut self) -> String {
        self.survey.told(&self.scene, &self.plan)
    }

    fn marks(&self) -> &[f64] {
        &self.survey.marks
    }

    fn lines(&self, from: u64, count: u64) -> String {
        let lines: Vec<ImpactLine> = (from..from.saturating_add(count))
            .map_while(|n| self.survey.kept(n).map(|kept| ImpactLine::new(n, &kept.impact, &self.plan)))
            .collect();
        json(&lines)
    }

    fn question(&self, n: u64) -> Option<Posed> {
        let kept = self.survey.kept(n)?;
        let line = ImpactLine::new(n, &kept.impact, &self.plan);
        (line.together <= 1).then(|| Posed {
            question: Question::of_contact(&self.plan, kept.bodies(), &line),
            impulse: line.impulse,
            friction_impulse: line.friction_impulse,
        })
    }

    fn ledger_of(&self, n: u64) -> String {
        books::instant(self, n).map_or_else(|| "null".into(), |b| json(&b))
    }

    fn ledger(&self) -> String {
        json(&books::whole(self))
    }

    fn seek(&mut self, time: f64) -> f64 {
        let time = if time > 0.0 { time } else { 0.0 };
        let keys = &self.survey.keys;
        if time < self.world.time() {
            if let Some(world) = keys.before(time, None).or_else(|| build::<D>(&self.scene, &self.plan).ok()) {
                self.world = world;
                self.own_way = false;
            }
        } else if !self.own_way
            && let Some(world) = keys.before(time, Some(self.world.time()))
        {
            // A jump ahead over what has been computed already.
            self.world = world;
        }
        self.world.advance_to(time);
        self.world.time()
    }

    fn next(&mut self, horizon: f64) -> f64 {
        let found = !self.world.advance_to_next(horizon).is_empty();
        if found { self.world.time() } else { f64::NAN }
    }

    fn frame(&self, into: &mut Vec<f64>) {
        into.clear();
        let world = &self.world;
        let ledger = world.ledger();
        let digest = world.digest();
        let momentum = ledger.momentum.end;
        let p = |k: usize| momentum.0.get(k).copied().unwrap_or(0.0);
        into.extend([
            world.time(),
            world.impact_count() as f64,
            ledger.energy.kinetic,
            ledger.energy.potential,
            ledger.energy.lost,
            ledger.energy.work,
            p(0),
            p(1),
            p(2),
            self.plan.bodies.len() as f64,
            (2 * D + Vector::<D>::SPINS + 1) as f64,
            (digest >> 32) as f64,
            (digest & 0xffff_ffff) as f64,
            ledger.momentum.drift,
            ledger.energy.drift,
            ledger.overlap,
        ]);
        debug_assert_eq!(into.len(), HEADER);
        for id in world.bodies() {
            let zero = Vector::<D>::ZERO;
            into.extend(world.position(id).unwrap_or(zero).0);
            into.extend(world.velocity(id).unwrap_or(zero).0);
            into.extend(Vector::<D>::spin_slice(&world.spin(id).unwrap_or_default()));
            let (fixed, rests) = (world.is_fixed(id).unwrap_or(false), world.rests(id).unwrap_or(false));
            into.push(if fixed { 2.0 } else { f64::from(u8::from(rests)) });
        }
    }

    fn samples(&self, count: u32, into: &mut Vec<f64>) {
        samples::of(self, count, into);
    }

    fn reverse(&mut self) -> bool {
        self.own_way = true;
        let ids: Vec<_> = self.world.bodies().collect();
        ids.into_iter().all(|id| {
            let velocity = self.world.velocity(id).unwrap_or(Vector::ZERO);
            self.world.set_velocity(id, -velocity).is_ok()
        })
    }

    fn report(&mut self) -> String {
        let stop = self.survey.stop.unwrap_or(carom::Stop::Time);
        Report::new(&self.scene, &self.plan, &mut self.world, stop).json()
    }
}
