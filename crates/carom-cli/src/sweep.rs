//! `carom sweep`: a scene run for every combination of values, a row each.
mod summary;
mod table;

use crate::drive::{PIECE, drive};
use crate::figures::{count, plural};
use crate::interrupt::{self, INTERRUPT};
use crate::source::{Ready, Source, check};
use crate::trouble::{Trouble, say};
use carom::{Rotates, Stop, Vector};
use carom_scene::build;
use carom_scene::output::Report;
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::collections::BTreeMap;
use std::io::{IsTerminal, stderr, stdout};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::time::Instant;
use table::{Row, Table};

const AFTER: &str = "\
The values stand in the scene:
  [sweep]
  \"material.default.restitution\" = [1.0, 0.9, 0.8]
  \"run.seed\" = { range = [1, 8] }              integers; or { range = [0, 1], steps = 11 }
The last line changes fastest. A row holds the number of the run, its values, and how it ended; no
row depends on the number of threads. Everything else the scene would write is not written.

With -o, rows go to FILE.part as they are known; --resume goes on with it after Ctrl-C or a kill.
--summary groups the rows by everything but run.seed: mean and standard error of each number.

Exit codes: 0 fine, 1 the audit of a run failed, 2 wrong usage or scene, 3 a run stopped itself,
130 Ctrl-C.

Examples:
  carom sweep drops.toml -o drops.csv --summary means.csv
  carom sweep drops.toml --shard 2/4 -o drops-2.csv";

/// Run a scene for all combinations of the values in its [sweep], in parallel
#[derive(Args)]
#[command(after_help = AFTER)]
pub struct Sweep {
    #[command(flatten)]
    source: Source,
    /// Runs at a time [default: one for each processor]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Run the i-th of n parts only, from 1: their rows one behind the other are the whole table's
    #[arg(long, value_name = "i/n", value_parser = shard)]
    shard: Option<(usize, usize)>,
    /// Write the table to a file (.csv) instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<String>,
    /// Write means and standard errors over the seeds to a file (.csv)
    #[arg(long, value_name = "FILE")]
    summary: Option<String>,
    /// Go on with the rows in FILE.part
    #[arg(long, requires = "output")]
    resume: bool,
}

fn shard(text: &str) -> Result<(usize, usize), String> {
    const EXPECTS: &str = "expects i/n, the i-th of n parts, as in 1/4";
    let (i, n) = text.split_once('/').ok_or(EXPECTS)?;
    let (i, n) = (i.trim().parse().map_err(|_| EXPECTS)?, n.trim().parse().map_err(|_| EXPECTS)?);
    if i < 1 || n < 1 || i > n {
        return Err("parts count from 1 to n".into());
    }
    Ok((i, n))
}

/// The runs of a part, from 0: as equal as can be, one behind the other.
fn part(runs: usize, (i, n): (usize, usize)) -> Range<usize> {
    let bound = |k: usize| (runs as u128 * k as u128 / n as u128) as usize;
    bound(i - 1)..bound(i)
}

impl Sweep {
    pub fn run(self) -> Result<(), Trouble> {
        interrupt::listen();
        for file in self.output.iter().chain(&self.summary) {
            if !file.to_ascii_lowercase().ends_with(".csv") {
                return Err(Trouble::usage(format!("{file}: a sweep writes tables, as .csv")));
            }
        }
        if self.output.is_some() && self.output == self.summary {
            return Err(Trouble::usage("--summary and -o are the same file; give them different names"));
        }
        let ready = self.source.scene()?;
        if ready.scene.sweep.is_empty() {
            let message = format!("{} has no [sweep]: there is one run", ready.name);
            let help = "name the values, as in --set 'sweep.\"run.seed\"={ range = [1, 8] }' or in the file:\n  [sweep]\n  \"run.seed\" = { range = [1, 8] }";
            return Err(Trouble::usage(format!("{message}\nhelp: {help}")));
        }
        let runs = part(ready.scene.combinations(), self.shard.unwrap_or((1, 1)));
        let keys: Vec<String> = ready.scene.sweep.iter().map(|s| s.path.clone()).collect();
        let what =
            format!("{} {}-{}", carom_scene::to_json(&ready.scene, carom_scene::Detail::Short), runs.start, runs.end);
        let mut table = Table::start(self.output.as_deref(), self.resume, &keys, &runs, &what)?;
        // Two drafts, so that a summary that cannot be written is known before hours are spent.
        let summary = self.summary.as_deref().map(crate::draft::Draft::create).transpose()?;
        let first = runs.start + table.rows().len();
        let done = all(&ready, first..runs.end, &runs, self.jobs, &mut table);
        let finished = match done {
            Ok(finished) => finished,
            Err(trouble) => return Err(table.keep(trouble)),
        };
        if !finished {
            return Err(table.interrupted(&runs));
        }
        if let (Some(draft), Some(name)) = (summary, &self.summary) {
            summary::write(draft, &keys, table.rows()).map_err(|e| Trouble::unwritten(name, &e))?;
        }
        let verdict = verdict(table.rows());
        table.finish()?;
        verdict
    }
}

/// Runs all of a range, in parallel, and hands the rows to the table in their order; false if it was interrupted.
fn all(
    ready: &Ready,
    todo: Range<usize>,
    runs: &Range<usize>,
    jobs: Option<u16>,
    table: &mut Table,
) -> Result<bool, Trouble> {
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let jobs = jobs.map_or(processors, usize::from).min(todo.len().max(1));
    let next = AtomicUsize::new(todo.start);
    let enough = AtomicBool::new(false);
    let (send, receive) = channel();
    let mut progress = Progress::new(runs.len(), todo.start - runs.start);
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            let send = send.clone();
            scope.spawn(|| work(ready, &next, todo.end, &enough, send));
        }
        drop(send);
        let mut waiting = BTreeMap::new();
        let mut due = todo.start;
        for (index, row) in receive {
            waiting.insert(index, row);
            while let Some(row) = waiting.remove(&due) {
                let written = match row {
                    Ok(Some(row)) => progress.aside(|| table.add(row)),
                    Ok(None) => return Ok(false),
                    Err(trouble) => Err(trouble),
                };
                if let Err(trouble) = written {
                    enough.store(true, Ordering::Relaxed);
                    return Err(trouble);
                }
                due += 1;
                progress.show(due - runs.start);
            }
        }
        Ok(due == todo.end)
    })
}

type Outcome = (usize, Result<Option<Row>, Trouble>);

/// Takes one run after the other.
fn work(ready: &Ready, next: &AtomicUsize, end: usize, enough: &AtomicBool, send: Sender<Outcome>) {
    loop {
        let index = next.fetch_add(1, Ordering::Relaxed);
        if index >= end || enough.load(Ordering::Relaxed) {
            return;
        }
        let row = one(ready, index);
        let last = !matches!(row, Ok(Some(_)));
        if send.send((index, row)).is_err() || last {
            return;
        }
    }
}

/// The row of a run; `None` if it was interrupted.
fn one(ready: &Ready, index: usize) -> Result<Option<Row>, Trouble> {
    if INTERRUPT.load(Ordering::Relaxed) {
        return Ok(None);
    }
    let values = ready.scene.combination(index);
    let told = |trouble: Trouble| {
        let values: Vec<String> =
            values.iter().map(|(path, value)| format!("{path} = {}", table::shown(value))).collect();
        let head = format!("run {} ({})", count(index as u64 + 1), values.join(", "));
        Trouble::scene(format!("{head}:\n{}", trouble.message()))
    };
    let run = ready.document.combination(&ready.scene, index).map_err(Trouble::scene).and_then(|document| {
        let ready = check(&ready.name, document)?;
        match ready.scene.world.dim {
            1 => simulate::<1>(&ready),
            2 => simulate::<2>(&ready),
            _ => simulate::<3>(&ready),
        }
    });
    let report = run.map_err(told)?;
    Ok(report.map(|report| Row::new(index, &values, &report)))
}

fn simulate<const D: usize>(ready: &Ready) -> Result<Option<Report>, Trouble>
where
    Vector<D>: Rotates,
{
    let world = build::<D>(&ready.scene, &ready.plan);
    let mut world = world.map_err(|e| Trouble::usage(format!("{}: {e}", ready.name)))?;
    world.keep_reports(false);
    let stop = drive(&mut world, &ready.scene.run.until, PIECE, &mut [], |_, _| Ok(()))?;
    Ok((stop != Stop::Interrupted).then(|| Report::new(&ready.scene, &ready.plan, &mut world, stop)))
}

/// The exit code: of all rows, those of an earlier part of the sweep included.
fn verdict(rows: &[Row]) -> Result<(), Trouble> {
    let some = |is: &dyn Fn(&Row) -> bool| {
        let numbers: Vec<String> = rows.iter().filter(|r| is(r)).map(|r| r.number().to_string()).collect();
        let shown = numbers.iter().take(10).cloned().collect::<Vec<_>>().join(", ");
        let more = if numbers.len() > 10 { ", ..." } else { "" };
        (numbers.len() as u64, format!("{shown}{more}"))
    };
    let (stopped, which) = some(&Row::stopped_itself);
    if stopped > 0 {
        return Err(Trouble::stopped(format!("{} stopped itself: number {which}", plural(stopped, "run"))));
    }
    let (failed, which) = some(&|r: &Row| !r.passed());
    if failed > 0 {
        return Err(Trouble::audit(format!("the audit of {} failed: number {which}", plural(failed, "run"))));
    }
    Ok(())
}

/// How many runs are done, and how long the others will take; on a terminal.
struct Progress {
    bar: Option<ProgressBar>,
    started: Instant,
    /// Runs that were done before.
    before: usize,
    all: usize,
}

impl Progress {
    fn new(all: usize, before: usize) -> Self {
        let bar = stderr().is_terminal().then(|| {
            let bar = ProgressBar::with_draw_target(Some(all as u64), ProgressDrawTarget::stderr());
            if let Ok(style) = ProgressStyle::with_template("{bar:20} {pos} of {len} runs{msg}") {
                bar.set_style(style);
            }
            bar.set_position(before as u64);
            bar
        });
        Self { bar, started: Instant::now(), before, all }
    }

    fn show(&self, done: usize) {
        let Some(bar) = &self.bar else { return };
        bar.set_position(done as u64);
        let left = self.started.elapsed().as_secs_f64() / (done - self.before).max(1) as f64 * (self.all - done) as f64;
        bar.set_message(format!(", {} left", duration(left)));
    }

    /// Does something on the terminal that the bar must not be mixed up with.
    fn aside<T>(&mut self, act: impl FnOnce() -> T) -> T {
        match &self.bar {
            Some(bar) if stdout().is_terminal() => bar.suspend(act),
            _ => act(),
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// A time for people: 40 s, 12 min, 3 h 20 min.
fn duration(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round() as u64;
    match seconds {
        s if s < 90.0 => format!("{s:.0} s"),
        _ if minutes < 90 => format!("{minutes} min"),
        _ => format!("{} h {} min", minutes / 60, minutes % 60),
    }
}

/// Writes to standard output; whoever reads it may stop.
fn print(text: &str) -> Result<(), Trouble> {
    say(&mut stdout().lock(), text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_the_whole_one_behind_the_other() {
        for runs in [0, 1, 7, 24, 1000] {
            for n in [1, 2, 3, 7, 30] {
                let parts: Vec<usize> = (1..=n).flat_map(|i| part(runs, (i, n))).collect();
                assert_eq!(parts, (0..runs).collect::<Vec<_>>(), "{runs} in {n}");
                let sizes: Vec<usize> = (1..=n).map(|i| part(runs, (i, n)).len()).collect();
                assert!(sizes.iter().max().unwrap() - sizes.iter().min().unwrap() <= 1);
            }
        }
        assert_eq!(shard("2/4"), Ok((2, 4)));
        for wrong in ["0/4", "5/4", "1/0", "1", "a/b", "-1/2"] {
            assert!(shard(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn times_for_people() {
        assert_eq!([3.2, 89.0, 600.0, 12000.0].map(duration).join(", "), "3 s, 89 s, 10 min, 3 h 20 min");
    }
}
