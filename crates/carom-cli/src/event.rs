//! The N-th line of `carom events`, to be explained.
use crate::drive::{News, PIECE, drive};
use crate::figures::{count, plural};
use crate::record;
use crate::run::start;
use crate::source::{Changes, Ready, Source};
use crate::trouble::Trouble;
use carom::{Impact, Party, Rotates, Stop, Vector};
use carom_scene::explain::Explanation;
use carom_scene::model::Until;
use carom_scene::output::ImpactLine;

/// An impact of a scene, and all that happened at its instant.
pub struct Event {
    pub ready: Ready,
    /// Which of the lines is asked for.
    pub asked: usize,
    /// All lines of the instant, in order.
    pub lines: Vec<ImpactLine>,
    /// Who took part in each: the numbers of bodies, none for a wall.
    pub parties: Vec<[Option<usize>; 2]>,
}

/// Runs the scene up to its `n`-th impact.
pub fn find(scene: String, changes: Changes, n: u64) -> Result<Event, Trouble> {
    crate::interrupt::listen();
    let ready = Source { scene, changes }.ready()?;
    match ready.scene.world.dim {
        1 => at::<1>(ready, n),
        2 => at::<2>(ready, n),
        _ => at::<3>(ready, n),
    }
}

fn at<const D: usize>(ready: Ready, n: u64) -> Result<Event, Trouble>
where
    Vector<D>: Rotates,
{
    let until = &ready.scene.run.until;
    // An instant is never split: the piece that holds this impact holds all of its instant.
    let until = Until { impacts: Some(until.impacts.map_or(n, |most| most.min(n))), ..*until };
    let mut lines: Vec<ImpactLine> = Vec::new();
    let mut parties = Vec::new();
    // Takes the impacts of a piece; whether there is more to be heard.
    let mut take = |first: u64, impacts: &[Impact<D>]| {
        for (k, impact) in (first..).zip(impacts) {
            if lines.first().is_some_and(|l| l.time != impact.time) {
                if lines.iter().any(|l| l.n == n) {
                    return false;
                }
                lines.clear();
                parties.clear();
            }
            lines.push(ImpactLine::new(k, impact, &ready.plan));
            parties.push(impact.parties.map(|party| match party {
                Party::Body(id) => Some(id.index()),
                Party::Wall(_) => None,
            }));
        }
        true
    };
    let all = match &ready.recording {
        Some(recording) => {
            record::tell::<D>(&ready, recording, u64::MAX, |first, impacts| Ok(take(first, impacts)))?;
            recording.impacts
        }
        None => {
            let mut world = start::<D>(&ready)?;
            let stop = drive(&mut world, &until, PIECE, &mut [], |world, news| {
                if let News::Impacts { first } = news {
                    take(first, world.impacts());
                }
                Ok(())
            })?;
            if stop == Stop::Interrupted {
                return Err(Trouble::interrupted());
            }
            world.impact_count()
        }
    };
    match lines.iter().position(|l| l.n == n) {
        Some(asked) => Ok(Event { ready, asked, lines, parties }),
        None => Err(Trouble::usage(format!(
            "--event {}: the run of {} has {}; `carom events {}` lists them",
            count(n),
            ready.name,
            plural(all, "impact"),
            ready.name
        ))),
    }
}

impl Event {
    /// The line that is asked for.
    pub fn line(&self) -> &ImpactLine {
        &self.lines[self.asked]
    }

    /// The impact of two bodies, if the contact was alone in its instant.
    pub fn alone(&self, duration: Option<f64>) -> Result<Option<Explanation>, Trouble> {
        Explanation::of_contact(&self.ready.plan, self.parties[self.asked], self.line(), duration)
            .map_err(|m| Trouble::usage(format!("--{}: {}", m.key, m.rule)))
    }
}
