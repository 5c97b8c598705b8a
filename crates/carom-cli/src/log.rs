//! The log of a run: a line at equal intervals.
use crate::drive::PIECE;
use crate::figures::{beside, count, short};
use crate::trouble::colour;
use carom::{Rotates, Vector, World};
use carom_scene::model::Until;

/// Lines of a log, but for the first.
const LINES: u32 = 5;
/// The second line of a run of which nobody knows how long it will be; the third comes after ten times as many impacts.
const FIRST: u64 = 1000;

/// What is written when.
pub struct Log {
    /// The interval of time (s), for runs that end at a time.
    pub step: Option<f64>,
    /// The interval in impacts, for runs that end at a number of them.
    every: Option<u64>,
    /// The impacts at which the next line is due.
    next: u64,
    /// When the last line was written, and how many impacts there were.
    written: Option<(f64, u64)>,
}

impl Log {
    pub fn new(until: &Until) -> Self {
        let step = until.time.map(|t| t / f64::from(LINES)).filter(|step| *step > 0.0);
        let every = match step {
            Some(_) => None,
            None => until.impacts.map(|n| (n / u64::from(LINES)).max(1)),
        };
        let next = if step.is_some() { u64::MAX } else { every.unwrap_or(FIRST) };
        Self { step, every, next, written: None }
    }

    /// After so many impacts a run is asked at the latest whether a line is due.
    pub fn beat(&self) -> u64 {
        self.every.unwrap_or(PIECE)
    }

    pub fn head(&self) -> String {
        let head = format!("{:>12}{:>14}{:>16}{:>16}", "time s", "impacts", "kinetic J", "lost J");
        if colour() { format!("\x1b[2m{head}\x1b[0m\n") } else { format!("{head}\n") }
    }

    /// A line, if this number of impacts is worth one.
    pub fn due<const D: usize>(&mut self, world: &World<D>) -> Option<String>
    where
        Vector<D>: Rotates,
    {
        let impacts = world.impact_count();
        if impacts < self.next {
            return None;
        }
        self.next = match self.every {
            Some(n) => (impacts / n + 1) * n,
            None => self.next.saturating_mul(10),
        };
        Some(self.line(world))
    }

    /// The line of this time.
    pub fn line<const D: usize>(&mut self, world: &World<D>) -> String
    where
        Vector<D>: Rotates,
    {
        let energy = world.ledger().energy;
        let scale = energy.start.abs().max(energy.kinetic);
        let lost = beside(energy.lost, scale);
        let [time, kinetic] = [world.time(), energy.kinetic].map(short);
        self.written = Some((world.time(), world.impact_count()));
        format!("{time:>12}{:>14}{kinetic:>16}{lost:>16}\n", count(world.impact_count()))
    }

    /// The line of the end, unless it is written already.
    pub fn last<const D: usize>(&mut self, world: &World<D>) -> String
    where
        Vector<D>: Rotates,
    {
        if self.written == Some((world.time(), world.impact_count())) { String::new() } else { self.line(world) }
    }
}
