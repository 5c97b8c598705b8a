//! `carom events`: one line per impact.
use crate::drive::{News, PIECE, drive};
use crate::figures::{count, digits};
use crate::interrupt::{self, INTERRUPT};
use crate::record;
use crate::run::{start, verdict};
use crate::source::{Ready, Source};
use crate::tally::numbers;
use crate::trouble::{Trouble, colour};
use carom::{Impact, Rotates, Vector};
use carom_scene::output::{ImpactLine, Report};
use clap::{Args, ValueEnum};
use std::io::{self, BufWriter, Write, stdout};
use std::sync::atomic::Ordering;

const AFTER: &str = "\
Every line is one contact that exchanged an impulse. With --format json it is an object on a
line of its own: n, time, bodies, point, normal, approach, departure, restitution, impulse,
friction_impulse, before, after, lost, together.

Examples:
  carom events pi-31
  carom events break --format csv > break.csv
  carom events gas --until impacts=1000 --format json | tail -1
  carom explain oblique --event 1";

/// Print every impact of a scene, a line each
#[derive(Args)]
#[command(after_help = AFTER)]
pub struct Events {
    #[command(flatten)]
    source: Source,
    /// How to print them
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// for people
    Text,
    /// for programs: an object per line
    Json,
    /// for tables
    Csv,
}

impl Events {
    pub fn run(self) -> Result<(), Trouble> {
        interrupt::listen();
        let ready = self.source.ready()?;
        match ready.scene.world.dim {
            1 => self.go::<1>(&ready),
            2 => self.go::<2>(&ready),
            _ => self.go::<3>(&ready),
        }
    }

    fn go<const D: usize>(&self, ready: &Ready) -> Result<(), Trouble>
    where
        Vector<D>: Rotates,
    {
        let mut out = BufWriter::new(stdout().lock());
        let head = match self.format {
            Format::Text => Some(head(colour())),
            Format::Csv => Some(ImpactLine::csv_head(D)),
            Format::Json => None,
        };
        if let Some(head) = head {
            sent(writeln!(out, "{head}"))?;
        }
        let mut tell = |first: u64, impacts: &[Impact<D>]| {
            for (n, impact) in (first..).zip(impacts) {
                let line = ImpactLine::new(n, impact, &ready.plan);
                let line = match self.format {
                    Format::Text => row(&line),
                    Format::Json => line.json(),
                    Format::Csv => line.csv(),
                };
                sent(writeln!(out, "{line}"))?;
            }
            sent(out.flush())
        };
        if let Some(recording) = &ready.recording {
            record::tell::<D>(ready, recording, u64::MAX, |first, impacts| {
                tell(first, impacts)?;
                Ok(!INTERRUPT.load(Ordering::Relaxed))
            })?;
            if INTERRUPT.load(Ordering::Relaxed) {
                return Err(Trouble::interrupted());
            }
            if let Some(note) = record::unfinished(&ready.name, recording) {
                let _ = writeln!(io::stderr(), "{note}");
            }
            return Ok(());
        }
        let mut world = start::<D>(ready)?;
        let stop = drive(&mut world, &ready.scene.run.until, PIECE, &mut [], |world, news| match news {
            News::Impacts { first } => tell(first, world.impacts()),
            News::Mark(_) => Ok(()),
        })?;
        let report = Report::new(&ready.scene, &ready.plan, &mut world, stop);
        verdict(&report, stop)
    }
}

/// Where the columns of the text begin: who comes last, as nobody knows how long a name is.
fn columns(cells: [String; 8]) -> String {
    let [n, time, approach, e, departure, impulse, lost, who] = cells;
    format!("{n:>6} {time:>12} {approach:>10} {e:>7} {departure:>10} {impulse:>11} {lost:>11}  {who}")
}

fn head(colour: bool) -> String {
    let head = columns(["n", "time s", "approach", "e", "departure", "impulse Ns", "lost J", "who"].map(String::from));
    if colour { format!("\x1b[2m{head}\x1b[0m") } else { head }
}

fn row(x: &ImpactLine) -> String {
    let who = x.bodies.join(" - ");
    let who = if x.together > 1 { format!("{who}  ({} together)", x.together) } else { who };
    let [approach, e, departure, impulse, lost] = numbers(x);
    columns([count(x.n), digits(x.time, 8), approach, e, departure, impulse, lost, who])
}

/// What became of a line.
fn sent(result: io::Result<()>) -> Result<(), Trouble> {
    result.map_err(|e| match e.kind() {
        io::ErrorKind::BrokenPipe => Trouble::unread(),
        _ => Trouble::unwritten("to standard output", &e),
    })
}
