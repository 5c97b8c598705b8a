//! Cases of a world: a scene runs, and what the book asks for is read from it.
//!
//! Words of the world: `time` (s), `impacts`, `kinetic`, `potential`, `energy`, `start`, `lost`, `work` (J), `momentum_x` ..., `given_x` ... (N s),
//! `unexplained`, `overlap`, `capped`, `resting` (how many bodies rest), `quiet` (1 or 0).
//! Of a body: `x[A] y[A] z[A]` (m), `vx[A] vy[A] vz[A]`, `speed[A]` (m/s), `spin[A]` in the plane, `wx[A] wy[A] wz[A]` in space (rad/s), `rests[A]`.
//! Of the n-th impact, from 1: `t[n]`, `impulse[n]`, `rub[n]` (the length of the tangential impulse), `approach[n]`, `departure[n]`, `restitution[n]`,
//! `loss[n]`, `together[n]`, `nx[n] ny[n] nz[n]`; `hits[A]`: how many impacts A had a part in.
//! Of another run of the same scene: `differs[how]` ([`twin`](crate::twin)).
use carom::{Impact, Limits, Party, Rotates, Stop, Vector, World};
use carom_scene::{Document, Plan, Problems, Scene, build, builtin};

use crate::case::{Case, Check, Names, Topic};
use crate::contact::component;
use crate::formula::{Formula, Misread, Words};
use crate::{gas, twin};

/// A scene that is ready to be built, as often as a case wants.
pub struct Stage {
    pub scene: Scene,
    pub plan: Plan,
}

/// What a check came to, or why it could not be read.
pub type Got = Result<f64, Misread>;

impl Stage {
    /// Reads a case's scene.
    pub fn set(case: &Case, topic: &Topic, written: &str, names: &Names<'_>) -> Result<Self, Misread> {
        let text = match topic.scenes.get(written) {
            Some(text) => text,
            None if written.contains('\n') => written,
            None => builtin(written).ok_or_else(|| Misread(format!("no scene is called `{written}`")))?,
        };
        let told = |problems: Problems| Misread(problems.to_string());
        // What a scene of the program says with `$` would be text in a comment.
        let text = if text.contains('$') { names.fill(text)? } else { text.to_owned() };
        let mut document = Document::parse(&case.name, &text).map_err(told)?;
        for (path, value) in &case.set {
            let value = match value {
                crate::case::Number::Formula(text) => names.fill(text)?,
                number => format!("{:?}", names.value(number)?),
            };
            document.set(path, &value).map_err(told)?;
        }
        let scene = document.scene().map_err(told)?;
        let plan = document.plan(&scene).map_err(told)?;
        Ok(Self { scene, plan })
    }

    /// Runs the scene and reads the checks of a case, in order.
    pub fn perform(&self, case: &Case, names: &Names<'_>) -> Vec<Got> {
        match self.scene.world.dim {
            1 => self.perform_in::<1>(case, names),
            2 => self.perform_in::<2>(case, names),
            _ => self.perform_in::<3>(case, names),
        }
    }

    /// The scene's world, as new.
    pub fn world<const D: usize>(&self) -> Result<World<D>, Misread>
    where
        Vector<D>: Rotates,
    {
        build::<D>(&self.scene, &self.plan).map_err(|e| Misread(e.to_string()))
    }

    fn perform_in<const D: usize>(&self, case: &Case, names: &Names<'_>) -> Vec<Got>
    where
        Vector<D>: Rotates,
    {
        let failed = |e: Misread| case.check.iter().map(|_| Err(e.clone())).collect();
        let mut world = match self.world::<D>() {
            Ok(world) => world,
            Err(e) => return failed(e),
        };
        let counted = match &case.window {
            Some(window) => match gas::watch(&mut world, window, names) {
                Ok(counted) => Some(counted),
                Err(e) => return failed(e),
            },
            None => None,
        };
        world.keep_reports(case.check.iter().any(wants_impacts));
        let mut act = Act { stage: self, world, impacts: Vec::new(), stop: None, counted };
        case.check.iter().map(|check| act.read(case, check, names)).collect()
    }
}

/// True if a check reads single impacts, which are then kept.
fn wants_impacts(check: &Check) -> bool {
    let words =
        ["t", "impulse", "rub", "approach", "departure", "restitution", "loss", "together", "nx", "ny", "nz", "hits"];
    // What cannot be read is told when its turn comes.
    Formula::read(&check.got).is_ok_and(|f| f.any(&|word, what| !what.is_empty() && words.contains(&word)))
}

/// A scene under way.
struct Act<'a, const D: usize>
where
    Vector<D>: Rotates,
{
    stage: &'a Stage,
    world: World<D>,
    /// All impacts so far, if anyone wants them.
    impacts: Vec<Impact<D>>,
    stop: Option<Stop>,
    counted: Option<gas::Counted>,
}

impl<const D: usize> Act<'_, D>
where
    Vector<D>: Rotates,
{
    /// Lets the clock run until a check is due, and reads it.
    fn read(&mut self, case: &Case, check: &Check, names: &Names<'_>) -> Got {
        let own = check.at.is_some() || check.after.is_some();
        let (at, after) = if own { (&check.at, &check.after) } else { (&case.at, &case.after) };
        let limits = match (at, after) {
            (Some(time), _) => Limits { time: Some(names.value(time)?), ..Limits::default() },
            (None, Some(n)) => Limits { impacts: Some(names.count(n)?), ..Limits::default() },
            (None, None) => self.stage.scene.run.until.limits(),
        };
        let past = limits.time.is_some_and(|t| t < self.world.time());
        if past {
            return Err(Misread("checks stand in the order of their times".into()));
        }
        if self.counted.is_none() {
            self.stop = Some(self.world.run(&limits));
            self.impacts.extend_from_slice(self.world.impacts());
        }
        let read = names.with(&*self).formula(&check.got);
        if read.is_err() && self.stop == Some(Stop::Quiet) && limits.impacts.is_some() {
            return read.map_err(|e| Misread(format!("{e} (nothing meets any more)")));
        }
        read
    }

    fn body(&self, name: &str) -> Result<carom::BodyId, Misread> {
        let index = (0..self.stage.plan.bodies.len()).find(|&k| self.stage.plan.name(k) == name);
        let id = index.and_then(|k| self.world.bodies().nth(k));
        id.ok_or_else(|| Misread(format!("no body is called `{name}`")))
    }

    fn impact(&self, written: &str) -> Result<&Impact<D>, Misread> {
        let n = written.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
        let found = n.and_then(|n| self.impacts.get(n));
        found.ok_or_else(|| Misread(format!("there is no impact {written} among {}", self.impacts.len())))
    }
}

impl<const D: usize> Words for Act<'_, D>
where
    Vector<D>: Rotates,
{
    fn name(&self, name: &str) -> Result<f64, Misread> {
        if let Some(counted) = &self.counted
            && let Some(value) = counted.word(name)
        {
            return Ok(value);
        }
        let world = &self.world;
        let ledger = world.ledger();
        let axis = |v: &Vector<D>, first: &str| component(name, first).filter(|k| *k < D).map(|k| v[k]);
        Ok(match name {
            "time" => world.time(),
            "impacts" => world.impact_count() as f64,
            "kinetic" => ledger.energy.kinetic,
            "potential" => ledger.energy.potential,
            "energy" => ledger.energy.end,
            "start" => ledger.energy.start,
            "lost" => ledger.energy.lost,
            "work" => ledger.energy.work,
            "unexplained" => ledger.unexplained(),
            "overlap" => ledger.overlap,
            "capped" => ledger.capped as f64,
            "resting" => world.bodies().filter(|id| world.rests(*id).unwrap_or(false)).count() as f64,
            "quiet" => f64::from(u8::from(self.stop == Some(Stop::Quiet))),
            _ => {
                let found = axis(&ledger.momentum.end, "momentum_").or(axis(&ledger.momentum.given, "given_"));
                return found.ok_or_else(|| Misread(format!("a world has no `{name}`")));
            }
        })
    }

    fn of(&self, word: &str, what: &str) -> Result<f64, Misread> {
        let unknown = || Misread(format!("`{word}[{what}]` is not known"));
        let stale = |e: carom::Error| Misread(e.to_string());
        let impact = || self.impact(what);
        match word {
            "differs" => return twin::differs::<D>(self.stage, what),
            "t" => return Ok(impact()?.time),
            "impulse" => return Ok(impact()?.impulse),
            "rub" => return Ok(impact()?.friction_impulse.norm()),
            "approach" => return Ok(impact()?.approach),
            "departure" => return Ok(impact()?.departure),
            "restitution" => return Ok(impact()?.restitution),
            "loss" => return Ok(impact()?.lost),
            "together" => return Ok(f64::from(impact()?.together)),
            "nx" | "ny" | "nz" => {
                let k = component(word, "n").filter(|k| *k < D).ok_or_else(unknown)?;
                return Ok(impact()?.normal[k]);
            }
            _ => {}
        }
        let id = self.body(what)?;
        if let Some(k) = component(word, "") {
            return self.world.unwrapped_position(id).map_err(stale)?.0.get(k).copied().ok_or_else(unknown);
        }
        if let Some(k) = component(word, "v") {
            return self.world.velocity(id).map_err(stale)?.0.get(k).copied().ok_or_else(unknown);
        }
        let spin = self.world.spin(id).map_err(stale)?;
        let spin = Vector::<D>::spin_slice(&spin);
        match word {
            "speed" => Ok(self.world.velocity(id).map_err(stale)?.norm()),
            "rests" => Ok(f64::from(u8::from(self.world.rests(id).map_err(stale)?))),
            "hits" => {
                let with = |i: &&Impact<D>| i.parties.contains(&Party::Body(id));
                Ok(self.impacts.iter().filter(with).count() as f64)
            }
            "spin" if D == 2 => spin.first().copied().ok_or_else(unknown),
            _ if D == 3 => {
                let k = component(word, "w").filter(|k| *k < 3).ok_or_else(unknown)?;
                spin.get(k).copied().ok_or_else(unknown)
            }
            _ => Err(unknown()),
        }
    }
}
