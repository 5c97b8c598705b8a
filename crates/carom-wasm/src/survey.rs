//! Running ahead to the end of the scene, a piece at a time so that the page stays awake: every impact, the audit, the digest.
use carom::{Impact, Limits, Party, Rotates, Stop, Vector, World};
use carom_scene::Plan;
use carom_scene::model::{Scene, Until};
use carom_scene::output::{Report, stop_name};
use serde::Serialize;
use serde_json::value::RawValue;

use crate::keys::Keys;
use crate::told::json;

/// How many impacts are kept with all they say. More are counted, and their times are kept.
const MOST_KEPT: usize = 4000;
/// How many times of impacts are kept.
const MOST_MARKS: usize = 400_000;
/// The first piece of time (s); where bodies in lasting contact move by slices of a millisecond it stays this short.
const PIECE: f64 = 0.02;

/// An impact with all it says.
pub(crate) struct Kept<const D: usize>
where
    Vector<D>: Rotates,
{
    pub impact: Impact<D>,
}

impl<const D: usize> Kept<D>
where
    Vector<D>: Rotates,
{
    /// The numbers of the bodies that took part, none for a wall.
    pub fn bodies(&self) -> [Option<usize>; 2] {
        self.impact.parties.map(|party| match party {
            Party::Body(id) => Some(id.index()),
            Party::Wall(_) => None,
        })
    }
}

/// The world that has run ahead.
pub(crate) struct Survey<const D: usize>
where
    Vector<D>: Rotates,
{
    world: World<D>,
    kept: Vec<Kept<D>>,
    /// The times of all impacts.
    pub marks: Vec<f64>,
    /// How it ended, when it has.
    pub stop: Option<Stop>,
    /// Worlds on the way, to go back to.
    pub keys: Keys,
    piece: f64,
}

#[derive(Serialize)]
struct Told<'a> {
    done: bool,
    time: f64,
    impacts: u64,
    kept: usize,
    stopped: Option<&'a str>,
    report: Option<Box<RawValue>>,
}

impl<const D: usize> Survey<D>
where
    Vector<D>: Rotates,
{
    pub fn new(world: World<D>) -> Self {
        Self { world, kept: Vec::new(), marks: Vec::new(), stop: None, keys: Keys::new(), piece: PIECE }
    }

    /// The n-th impact, from 1.
    pub fn kept(&self, n: u64) -> Option<&Kept<D>> {
        self.kept.get(usize::try_from(n).ok()?.checked_sub(1)?)
    }

    /// All kept impacts, in order.
    pub fn all(&self) -> &[Kept<D>] {
        &self.kept
    }

    /// When the run ends, or how far it has come.
    pub fn end(&self) -> f64 {
        self.world.time()
    }

    /// Runs ahead by at most so many impacts; true when the run is over.
    pub fn piece(&mut self, until: &Until, impacts: u64) -> bool {
        if self.stop.is_some() {
            return true;
        }
        let (count, slices) = (self.world.impact_count(), self.world.slice_count());
        let most = count + impacts.max(1);
        let until_here = self.world.time() + self.piece;
        let limits = Limits {
            // Without a time the run ends with its last impact, and must not coast beyond it.
            time: until.time.map(|end| end.min(until_here)),
            impacts: Some(until.impacts.map_or(most, |n| n.min(most))),
            rest: until.rest,
            interrupt: None,
        };
        let stop = self.world.run(&limits);
        for impact in self.world.impacts() {
            if self.marks.len() < MOST_MARKS {
                self.marks.push(impact.time);
            }
            if self.kept.len() < MOST_KEPT {
                self.kept.push(Kept { impact: *impact });
            }
        }
        self.keys.pass(&self.world);
        let over = match stop {
            Stop::Impacts => until.impacts.is_some_and(|n| self.world.impact_count() >= n),
            Stop::Time => until.time.is_some_and(|end| self.world.time() >= end),
            Stop::Quiet => {
                // With a time the bodies coast to it; without one the last impact was the end of the run.
                self.world.run(&Limits { time: until.time, impacts: None, rest: until.rest, interrupt: None });
                true
            }
            Stop::Interrupted => false,
            Stop::Rest | Stop::Crushed | Stop::NotFinite => true,
        };
        if over {
            self.stop = Some(stop);
        }
        self.piece = if self.world.slice_count() == slices { self.piece * 2.0 } else { PIECE };
        over
    }

    /// How far it has come, and the report when it is over.
    pub fn told(&mut self, scene: &Scene, plan: &Plan) -> String {
        let report = self.stop.map(|stop| Report::new(scene, plan, &mut self.world, stop).json());
        json(&Told {
            done: self.stop.is_some(),
            time: self.world.time(),
            impacts: self.world.impact_count(),
            kept: self.kept.len(),
            stopped: self.stop.map(stop_name),
            report: report.and_then(|r| RawValue::from_string(r).ok()),
        })
    }
}
