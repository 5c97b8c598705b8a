//! `carom run`: simulate, tell what happened, and audit it.
use crate::drive::{Grid, News, PIECE, drive};
use crate::figures::{count, digits, plural, short};
use crate::interrupt::INTERRUPT;
use crate::log::Log;
use crate::outputs::Outputs;
use crate::progress::Progress;
use crate::record;
use crate::source::{Changes, Ready, Source, recording};
use crate::tally::Tally;
use crate::trouble::{Trouble, colour, say};
use crate::{audit, interrupt, picture};
use carom::{Rotates, Stop, Vector, World};
use carom_files::recording::Recording;
use carom_scene::model::Until;
use carom_scene::output::Report;
use clap::{Args, ValueEnum};
use std::io::{Write, stderr, stdout};
use std::sync::atomic::Ordering;
use std::time::Instant;

const AFTER: &str = "\
Files (-o, or [[output]] in the scene), by extension:
  .csv      a row per impact                          with `every` in the scene: a row
  .jsonl    an object per impact, one on each line    per body, every so many seconds
  .parquet  a table of impacts
  .extxyz .lammpstrj .gsd .vtp   the bodies, 60 times over the run or by `every`
  .json     the whole run in one object, as --format json prints it
  .svg .png   a picture of the end      .gif .mp4   a film; `carom render` has the choices
  .carom    a recording: to be resumed, or given as SCENE to other commands
A file appears under its name when it is complete; a recording when it has begun.

Exit codes: 0 fine, 1 the audit failed, 2 wrong usage or scene, 3 the run stopped itself
(a body crushed, numbers no longer finite), 130 Ctrl-C. On 3 and 130 all is written first.

Examples:
  carom run two-balls
  carom run two-balls --set material.default.restitution=1
  carom run break -o break.gif
  carom run gas --until impacts=20000 --format json
  carom scenes bounce | carom run - -o impacts.csv
  carom run gas --until time=100 -o gas.carom      (Ctrl-C, and later:)
  carom run --resume gas.carom";

/// Run a scene: what happened, the impacts, and the audit
#[derive(Args)]
#[command(after_help = AFTER)]
pub struct Run {
    /// A file (.toml or .json), - for standard input, a recording (.carom), or the name of a built-in scene (`carom scenes`)
    #[arg(required_unless_present = "resume")]
    scene: Option<String>,
    #[command(flatten)]
    changes: Changes,
    /// Go on with a recording behind its last keyframe, to the very same digest, and keep recording; with --until, to
    /// another end
    #[arg(long, value_name = "FILE.carom")]
    resume: Option<String>,
    /// Write to a file; repeat for several
    #[arg(short, long = "output", value_name = "FILE")]
    output: Vec<String>,
    /// How to print it
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    /// Leave out the picture of the motion
    #[arg(long)]
    no_picture: bool,
    /// Threads that share the set-up of a large world; results never depend on their number
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: u16,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// for people
    Text,
    /// for programs: one object
    Json,
}

impl Run {
    pub fn run(self) -> Result<(), Trouble> {
        interrupt::listen();
        let ready = self.ready()?;
        match ready.scene.world.dim {
            1 => self.go::<1>(&ready),
            2 => self.go::<2>(&ready),
            _ => self.go::<3>(&ready),
        }
    }

    /// The scene: that of a recording that is to go on, or the one that is asked for.
    fn ready(&self) -> Result<Ready, Trouble> {
        let asked = || self.scene.clone().map(|scene| Source { scene, changes: self.changes.clone() });
        let Some(name) = &self.resume else {
            return asked().ok_or_else(|| Trouble::usage("which SCENE?"))?.ready();
        };
        let recording = recording(name)?;
        let changes = match &self.scene {
            None if !self.changes.set.is_empty() => {
                let help = format!("`carom run {name} --set ...` runs its scene from the start");
                return Err(Trouble::usage(format!("--set: {name} holds a run that has begun\nhelp: {help}")));
            }
            None => self.changes.clone(),
            Some(scene) => {
                let ready = asked().ok_or_else(|| Trouble::usage("which SCENE?"))?.ready()?;
                if !record::is_of(&recording, &ready.scene) {
                    return Err(Trouble::usage(format!("{name} is a recording of another scene than {scene}")));
                }
                Changes { set: Vec::new(), ..self.changes.clone() }
            }
        };
        let mut ready = Source { scene: name.clone(), changes }.ready()?;
        let (until, last) = (ready.scene.run.until, recording.last());
        if until.time.is_some_and(|end| end < last.time) || until.impacts.is_some_and(|n| n < last.impacts) {
            let there = format!("t = {} s and {}", short(last.time), plural(last.impacts, "impact"));
            return Err(Trouble::usage(format!("--until: {name} has come to {there} already")));
        }
        ready.recording = Some(recording);
        Ok(ready)
    }

    /// Goes on with a recording: what has happened is told again, and the world of its last keyframe is the one that runs.
    fn go_on<const D: usize>(
        &self,
        ready: &Ready,
        recording: &Recording,
        outputs: &mut Outputs<D>,
        tally: &mut Tally,
    ) -> Result<World<D>, Trouble>
    where
        Vector<D>: Rotates,
    {
        let name = &ready.name;
        if let Some(file) = outputs.that_looks() {
            let help = format!("finish the run with --resume, then `carom run {name} -o {file}`");
            let message = format!("{file} shows the whole run, and this one begins in the middle");
            return Err(Trouble::usage(format!("{message}\nhelp: {help}")));
        }
        let last = recording.last();
        let world = record::world::<D>(name, recording, &last)?;
        let decoder = record::tell::<D>(ready, recording, last.impacts, |first, impacts| {
            for (n, impact) in (first..).zip(impacts) {
                tally.add(n, impact, &ready.plan);
            }
            outputs.impacts(ready, first, impacts)?;
            Ok(true)
        })?;
        if !outputs.contains(name) {
            outputs.push(name.clone(), Box::new(record::go_on(ready, recording, &decoder, &world)?));
        }
        Ok(world)
    }

    fn go<const D: usize>(&self, ready: &Ready) -> Result<(), Trouble>
    where
        Vector<D>: Rotates,
    {
        let wanted: Vec<String> =
            self.output.iter().filter(|path| Some(*path) != self.resume.as_ref()).cloned().collect();
        let mut outputs = Outputs::<D>::open(ready, &wanted)?;
        let mut paper = Paper { text: self.format == Format::Text, unread: false };
        let idle = ready.document.notes().len() as u64;
        if idle > 0 {
            let keys = plural(idle, "key");
            let _ = writeln!(stderr(), "note: {keys} without effect; `carom check {}` says which", ready.name);
        }
        let clock = Instant::now();
        let mut tally = Tally::new(&ready.plan, ready.scene.bodies.len());
        let mut world = match (&ready.recording, &self.resume) {
            (Some(recording), Some(_)) => self.go_on::<D>(ready, recording, &mut outputs, &mut tally)?,
            _ => start::<D>(ready)?,
        };
        world.set_threads(self.threads.into());
        let until = ready.scene.run.until;
        // Looking at the bodies on the way needs to know where the way ends: a run of which that is not said is run twice.
        let unsure = until.time.is_none() || (outputs.any_divides() && (until.rest || until.impacts.is_some()));
        let (until, ended) = if outputs.that_looks().is_some() && unsure {
            let mut first = start::<D>(ready)?;
            first.set_threads(self.threads.into());
            let stop = drive(&mut first, &until, PIECE, &mut [], |_, _| Ok(()))?;
            // What had been reached by Ctrl-C is written; another one ends that, too.
            INTERRUPT.store(false, Ordering::Relaxed);
            (Until { time: Some(first.time()), ..until }, Some(stop))
        } else {
            (until, None)
        };
        let mut log = Log::new(&until);
        paper.say(&heading(ready))?;
        paper.say(&log.head())?;
        paper.say(&log.line(&world))?;
        let mut progress = Progress::new(&until);
        let mut grids: Vec<Grid> = log.step.map(|step| Grid::new(step, false)).into_iter().collect();
        let logged = grids.len();
        grids.extend(outputs.steps(until.time.unwrap_or(0.0)).into_iter().map(|step| Grid::new(step, true)));
        if self.resume.is_some() {
            grids.iter_mut().for_each(|grid| *grid = grid.from(world.time()));
        } else {
            outputs.look_first(ready, &world)?;
        }
        let stop = drive(&mut world, &until, log.beat(), &mut grids, |world, news| {
            match news {
                News::Impacts { first } => {
                    for (n, impact) in (first..).zip(world.impacts()) {
                        tally.add(n, impact, &ready.plan);
                    }
                    outputs.impacts(ready, first, world.impacts())?;
                    outputs.beat(ready, world)?;
                    if let Some(line) = log.due(world) {
                        progress.aside(|| paper.say(&line))?;
                    }
                }
                News::Mark(k) if k < logged => {
                    let line = log.line(world);
                    progress.aside(|| paper.say(&line))?;
                }
                News::Mark(k) => outputs.look(ready, world, k - logged)?,
            }
            progress.show(world.time(), world.impact_count());
            if paper.unread && outputs.is_empty() { Err(Trouble::unread()) } else { Ok(()) }
        })?;
        drop(progress);
        let stop = match ended {
            Some(ended) if stop != Stop::Interrupted => ended,
            _ => stop,
        };
        let report = Report::new(&ready.scene, &ready.plan, &mut world, stop);
        let took = clock.elapsed().as_secs_f64();
        outputs.finish(ready, &world, &report)?;
        if paper.text {
            paper.say(&log.last(&world))?;
            if !self.no_picture && !matches!(stop, Stop::NotFinite) {
                paper.say(&picture::of::<D>(ready, &report, tally.last())?)?;
            }
            paper.say(&format!("\n{}", tally.text(report.time, colour())))?;
            paper.say(&format!("\n{}", audit::text(&report, colour())))?;
            paper.say(&format!("\n{}\n", ending(&report, stop)))?;
            let _ = writeln!(stderr(), "{}", speed(&report, took));
            if let (Some(recording), None) = (&ready.recording, &self.resume) {
                let _ = writeln!(stderr(), "{}", record::compared(&ready.name, recording, &report));
            }
        } else if !paper.unread {
            written(say(&mut stdout().lock(), &report.json()))?;
        }
        verdict(&report, stop)
    }
}

/// The world of a scene.
pub fn start<const D: usize>(ready: &Ready) -> Result<World<D>, Trouble>
where
    Vector<D>: Rotates,
{
    carom_scene::build::<D>(&ready.scene, &ready.plan).map_err(|e| Trouble::usage(format!("{}: {e}", ready.name)))
}

/// Standard output, which may be closed before the run is over.
struct Paper {
    text: bool,
    unread: bool,
}

impl Paper {
    fn say(&mut self, text: &str) -> Result<(), Trouble> {
        if self.text && !self.unread {
            self.unread = written(say(&mut stdout().lock(), text))?;
        }
        Ok(())
    }
}

/// True if nobody reads what was written.
fn written(said: Result<(), Trouble>) -> Result<bool, Trouble> {
    match said {
        Err(trouble) if trouble.is_unread() => Ok(true),
        other => other.map(|()| false),
    }
}

/// The title, and what is in it.
fn heading(ready: &Ready) -> String {
    let (plan, scene) = (&ready.plan, &ready.scene);
    let title = if scene.title.is_empty() { &ready.name } else { &scene.title };
    let mut what = vec![format!("{}D", plan.dim), plural(plan.bodies.len() as u64, "body")];
    let walls = scene.walls.len() as u64;
    if walls > 0 {
        what.push(plural(walls, "wall"));
    }
    let title = if colour() { format!("\x1b[1m{title}\x1b[0m") } else { title.clone() };
    format!("{title}  ({})\n\n", what.join(", "))
}

/// Why and when it ended, and the digest.
fn ending(report: &Report, stop: Stop) -> String {
    let why = match stop {
        Stop::Time => "time is up",
        Stop::Impacts => "the number of impacts is reached",
        Stop::Rest => "every body is at rest",
        Stop::Quiet => "nothing can meet again",
        Stop::Interrupted => "interrupted",
        Stop::Crushed => "a body has no room left between driven ones",
        Stop::NotFinite => "numbers are no longer finite",
    };
    format!("Ended at t = {} s: {why}. Digest {}", short(report.time), report.digest)
}

/// How long it took.
fn speed(report: &Report, took: f64) -> String {
    let mut text = match took < 0.1 {
        true => format!("({} ms", digits(took * 1e3, 2)),
        false => format!("({} s", digits(took, 2)),
    };
    if report.impacts >= 1000 && took > 0.0 {
        text += &format!(", {} impacts per second", count((report.impacts as f64 / took) as u64));
    }
    text + ")"
}

/// The exit code.
pub fn verdict(report: &Report, stop: Stop) -> Result<(), Trouble> {
    match stop {
        Stop::Interrupted => Err(Trouble::interrupted()),
        Stop::Crushed => Err(Trouble::stopped(format!(
            "the run stopped itself at t = {} s: driven walls or bodies leave a body no room",
            short(report.time)
        ))),
        Stop::NotFinite => Err(Trouble::stopped(format!(
            "the run stopped itself at t = {} s: a position or a velocity is no longer finite",
            short(report.time)
        ))),
        _ if !report.audit.pass => Err(Trouble::audit(format!("the audit failed: {}", audit::failure(&report.audit)))),
        _ => Ok(()),
    }
}
