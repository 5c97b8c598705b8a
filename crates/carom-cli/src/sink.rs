//! What a run tells the files that it writes. A format is one [`Sink`], opened in [`outputs`](crate::outputs).
use crate::draft::Draft;
use crate::source::Ready;
use carom::{Impact, Rotates, Vector, World};
use carom_scene::output::{BodyLine, ImpactLine, Report};
use std::io::{self, Write};

/// When a file wants to look at the bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Looks {
    /// At the end, or never.
    Never,
    /// At the start, and at steps of this size (s).
    Every(f64),
    /// This many times at equal steps, first at the start and last at the end.
    Times(u32),
    /// At the start; and where the scene says when the run ends, at so many equal parts of it.
    Parts(u32),
}

impl Looks {
    /// The step (s) of a run that ends at this time; infinite where there is none.
    pub fn step(self, end: f64) -> f64 {
        match self {
            Self::Every(step) => step,
            Self::Times(n) if n > 1 && end > 0.0 => end / f64::from(n - 1),
            Self::Parts(n) if n > 0 && end > 0.0 => end / f64::from(n),
            _ => f64::INFINITY,
        }
    }
}

/// A file that a run writes.
pub trait Sink<const D: usize>
where
    Vector<D>: Rotates,
{
    /// When it wants to be shown the bodies; asked once, before the run.
    fn looks(&self) -> Looks {
        Looks::Never
    }

    /// True if it wants to be told of impacts; asked once, before the run.
    fn hears(&self) -> bool {
        false
    }

    /// The next impacts, in order; the number of the first of them, from 1.
    fn impacts(&mut self, _ready: &Ready, _first: u64, _impacts: &[Impact<D>]) -> io::Result<()> {
        Ok(())
    }

    /// The world at a time that it wanted to see: all impacts up to then have been told.
    fn look(&mut self, _ready: &Ready, _world: &World<D>) -> io::Result<()> {
        Ok(())
    }

    /// Where the run has come, behind every piece of impacts: for files that keep the world itself now and then.
    fn beat(&mut self, _ready: &Ready, _world: &World<D>) -> io::Result<()> {
        Ok(())
    }

    /// The run is over: writes what is left, completes the file and puts it in its place. Not called when another file
    /// cannot be written, or when there was nothing to run: then nothing may be left behind.
    fn finish(self: Box<Self>, ready: &Ready, world: &World<D>, report: &Report) -> io::Result<()>;
}

/// How rows are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rows {
    Csv,
    Lines,
}

/// The run in one JSON object.
pub struct Whole(pub Draft);

impl<const D: usize> Sink<D> for Whole
where
    Vector<D>: Rotates,
{
    fn finish(mut self: Box<Self>, _ready: &Ready, _world: &World<D>, report: &Report) -> io::Result<()> {
        self.0.write_all(report.json().as_bytes())?;
        self.0.complete()
    }
}

/// A row for each impact.
pub struct Impacts {
    draft: Draft,
    rows: Rows,
}

impl Impacts {
    pub fn start(mut draft: Draft, rows: Rows, dim: usize) -> io::Result<Self> {
        if rows == Rows::Csv {
            writeln!(draft, "{}", ImpactLine::csv_head(dim))?;
        }
        Ok(Self { draft, rows })
    }
}

impl<const D: usize> Sink<D> for Impacts
where
    Vector<D>: Rotates,
{
    fn hears(&self) -> bool {
        true
    }

    fn impacts(&mut self, ready: &Ready, first: u64, impacts: &[Impact<D>]) -> io::Result<()> {
        for (n, impact) in (first..).zip(impacts) {
            let line = ImpactLine::new(n, impact, &ready.plan);
            let line = if self.rows == Rows::Csv { line.csv() } else { line.json() };
            writeln!(self.draft, "{line}")?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>, _ready: &Ready, _world: &World<D>, _report: &Report) -> io::Result<()> {
        self.draft.complete()
    }
}

/// A row for each body, at equal steps of time.
pub struct Bodies {
    draft: Draft,
    rows: Rows,
    step: f64,
}

impl Bodies {
    pub fn start(mut draft: Draft, rows: Rows, step: f64, dim: usize) -> io::Result<Self> {
        if rows == Rows::Csv {
            writeln!(draft, "{}", BodyLine::csv_head(dim))?;
        }
        Ok(Self { draft, rows, step })
    }
}

impl<const D: usize> Sink<D> for Bodies
where
    Vector<D>: Rotates,
{
    fn looks(&self) -> Looks {
        Looks::Every(self.step)
    }

    fn look(&mut self, ready: &Ready, world: &World<D>) -> io::Result<()> {
        for id in world.bodies() {
            let line = BodyLine::new(world, id, &ready.plan);
            let line = if self.rows == Rows::Csv { line.csv() } else { line.json() };
            writeln!(self.draft, "{line}")?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>, _ready: &Ready, _world: &World<D>, _report: &Report) -> io::Result<()> {
        self.draft.complete()
    }
}
