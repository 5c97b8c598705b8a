//! A run, moved on piece by piece: impacts stream out, and the clock is stopped at the times that someone wants to see.
use crate::interrupt::INTERRUPT;
use crate::trouble::Trouble;
use carom::{Limits, Rotates, Stop, Vector, World};
use carom_scene::model::Until;

/// Impacts of one piece: few enough to be held in memory, many enough that starting again costs nothing.
pub const PIECE: u64 = 4096;

/// Times at equal steps, from one step on.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    pub step: f64,
    /// How many steps have been taken.
    taken: u64,
    /// Whether a world in which nothing can meet any more is still looked at.
    pub when_quiet: bool,
}

impl Grid {
    pub fn new(step: f64, when_quiet: bool) -> Self {
        Self { step, taken: 0, when_quiet }
    }

    /// For a run that has come so far (s) already.
    pub fn from(self, time: f64) -> Self {
        // A step that ended there but for rounding is taken.
        let taken = time / self.step + 1e-9;
        Self { taken: if taken >= 1.0 { taken as u64 } else { 0 }, ..self }
    }

    /// The next time, given when the run ends: a step that ends there but for rounding ends there exactly.
    fn next(&self, end: f64) -> f64 {
        let time = (self.taken + 1) as f64 * self.step;
        if (time - end).abs() <= 1e-9 * self.step { end } else { time }
    }
}

/// What is new.
#[derive(Clone, Copy, Debug)]
pub enum News {
    /// Impacts, possibly none; the number, from 1, of the first of them.
    Impacts { first: u64 },
    /// The next time of this grid has come.
    Mark(usize),
}

/// Runs a world to its end and tells what happens on the way: after every `beat` impacts at the latest, and at the times of
/// the grids, which are for runs that end at a known time.
pub fn drive<const D: usize>(
    world: &mut World<D>,
    until: &Until,
    beat: u64,
    grids: &mut [Grid],
    mut tell: impl FnMut(&mut World<D>, News) -> Result<(), Trouble>,
) -> Result<Stop, Trouble>
where
    Vector<D>: Rotates,
{
    let end = until.time.unwrap_or(f64::INFINITY);
    let mut quiet = false;
    loop {
        let watched = |g: &&mut Grid| !quiet || g.when_quiet;
        let mark = grids.iter_mut().filter(watched).map(|g| g.next(end)).fold(f64::INFINITY, f64::min);
        let time = if mark < end { Some(mark) } else { until.time };
        let before = world.impact_count();
        let piece = (before + PIECE).min((before / beat + 1) * beat);
        let impacts = Some(until.impacts.map_or(piece, |n| n.min(piece)));
        let stop = world.run(&Limits { time, impacts, rest: until.rest, interrupt: Some(&INTERRUPT) });
        tell(world, News::Impacts { first: before + 1 })?;
        let under_way = match stop {
            Stop::Impacts => until.impacts.is_none_or(|n| world.impact_count() < n),
            Stop::Time | Stop::Quiet => {
                quiet |= stop == Stop::Quiet;
                for (k, grid) in grids.iter_mut().enumerate() {
                    if grid.next(end) <= world.time() {
                        grid.taken += 1;
                        tell(world, News::Mark(k))?;
                    }
                }
                time != until.time
            }
            _ => false,
        };
        if !under_way {
            return Ok(if is_finite(world) { stop } else { Stop::NotFinite });
        }
    }
}

/// True unless a body has left the numbers, as one does that nothing meets any more.
fn is_finite<const D: usize>(world: &World<D>) -> bool
where
    Vector<D>: Rotates,
{
    let finite = |v: Result<Vector<D>, carom::Error>| v.is_ok_and(Vector::is_finite);
    world.bodies().all(|id| finite(world.position(id)) && finite(world.velocity(id)))
}
