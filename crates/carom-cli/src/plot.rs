//! `carom plot`: energy, momentum, speeds, gaps, space and time; in a file or in the terminal.
use crate::draft::Draft;
use crate::drive::{Grid, News, PIECE, drive};
use crate::interrupt;
use crate::plot_text;
use crate::progress::Progress;
use crate::render::{Theme, size};
use crate::run::start;
use crate::shoot::{Kind, shown};
use crate::source::{Ready, Source};
use crate::trouble::{Trouble, colour, print};
use crate::wrote::wrote;
use carom::{Rotates, Stop, Vector};
use carom_draw::plot::{Chart, History, What as Shows, chart};
use carom_draw::raster::Canvas;
use carom_draw::svg::svg;
use carom_draw::{Cast, Hit, MOST_PIXELS, still};
use carom_scene::model::Until;
use clap::{Args, ValueEnum};
use std::io::Write;

const AFTER: &str = "\
energy    kinetic, potential and lost energy, stacked: their sum is flat
momentum  of all bodies, and less what walls and gravity gave of it: that is flat
speed     how often which speed, with Maxwell's curve at the temperature of the scene
gaps      the smallest gap of two bodies, and of a body and a wall
spacetime where the bodies are by time; in the plane and in space x alone

Without -o the plot is drawn in the terminal.

Examples:
  carom plot break --what energy
  carom plot gas --what speed -o speeds.svg
  carom plot pi-31 --what spacetime -o pi.png --theme dark";

/// Looks on the way, and in all for all bodies together.
const LOOKS: usize = 800;
const MOST_LOOKS: usize = 20_000_000;
/// Width and height of a plot, unless somebody wants another size (pixels).
const SIZE: [u32; 2] = [900, 520];

/// Impacts whose jumps are drawn upright, each by a look before it and one after it; of more, the hardest.
const MOST_JUMPS: usize = 400;

/// The hardest impacts of a run.
#[derive(Default)]
struct Jumps {
    /// Impulses (N s) and times (s).
    hardest: Vec<(f64, f64)>,
}

impl Jumps {
    fn hit(&mut self, hit: &Hit) {
        let impulse = hit.impulse.iter().map(|x| x * x).sum::<f64>().sqrt();
        self.hardest.push((impulse, hit.time));
        if self.hardest.len() >= 16 * MOST_JUMPS {
            self.thin();
        }
    }

    fn thin(&mut self) {
        self.hardest.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.total_cmp(&b.1)));
        self.hardest.truncate(MOST_JUMPS);
    }

    /// When to look: at each of these instants, and just before.
    fn stops(mut self, end: f64) -> Vec<f64> {
        self.thin();
        let mut times: Vec<f64> = self.hardest.iter().map(|hit| hit.1).filter(|&t| t > 0.0 && t <= end).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        times.iter().flat_map(|&t| [t.next_down(), t]).collect()
    }
}

/// Plot a run: energy, momentum, speeds, gaps, space and time
#[derive(Args)]
#[command(after_help = AFTER)]
pub struct Plot {
    #[command(flatten)]
    source: Source,
    /// What to plot
    #[arg(long, value_enum)]
    what: What,
    /// The file: .svg or .png; without it the plot is drawn in the terminal
    #[arg(short, long = "output", value_name = "FILE")]
    output: Vec<String>,
    /// Light or dark paper
    #[arg(long, value_enum, default_value = "light")]
    theme: Theme,
    /// Width and height in pixels [default: 900x520]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum What {
    Energy,
    Momentum,
    Speed,
    Gaps,
    Spacetime,
}

impl What {
    fn shows(self) -> Shows {
        match self {
            Self::Energy => Shows::Energy,
            Self::Momentum => Shows::Momentum,
            Self::Speed => Shows::Speed,
            Self::Gaps => Shows::Gaps,
            Self::Spacetime => Shows::Spacetime,
        }
    }
}

impl Plot {
    pub fn run(self) -> Result<(), Trouble> {
        interrupt::listen();
        let ready = self.source.ready()?;
        for (n, path) in self.output.iter().enumerate() {
            if !matches!(Kind::of(path), Some(Kind::Svg | Kind::Png)) {
                return Err(Trouble::usage(format!("-o {path}: a plot is a .svg or a .png")));
            }
            if self.output[..n].contains(path) {
                return Err(Trouble::usage(format!("{path} would be written twice; give the plots different names")));
            }
        }
        let history = match ready.scene.world.dim {
            1 => self.history::<1>(&ready)?,
            2 => self.history::<2>(&ready)?,
            _ => self.history::<3>(&ready)?,
        };
        let theme = self.theme.paper().theme();
        let chart = chart(&history, &theme);
        if self.output.is_empty() {
            return print(&plot_text::text(&chart, colour()));
        }
        self.output.iter().try_for_each(|path| self.write(path, &chart))
    }

    fn history<const D: usize>(&self, ready: &Ready) -> Result<History, Trouble>
    where
        Vector<D>: Rotates,
    {
        let until = ready.scene.run.until;
        let interrupted = |stop| if stop == Stop::Interrupted { Err(Trouble::interrupted()) } else { Ok(()) };
        // Where the run ends, and when its last impact is.
        let mut world = start::<D>(ready)?;
        let mut progress = Progress::new(&until);
        let mut last = None;
        let mut jumps = Jumps::default();
        interrupted(drive(&mut world, &until, PIECE, &mut [], |world, _| {
            world.impacts().iter().for_each(|impact| jumps.hit(&Hit::of(impact)));
            last = world.impacts().last().map(|impact| impact.time).or(last);
            progress.show(world.time(), world.impact_count());
            Ok(())
        })?)?;
        drop(progress);
        let whole = !self.source.changes.until.is_empty();
        let end = if whole { world.time() } else { shown(world.time(), last) };
        let mut world = start::<D>(ready)?;
        let cast = Cast::new(&ready.scene, &ready.plan, &ready.name);
        let looks = (MOST_LOOKS / cast.actors.len().max(1)).clamp(20, LOOKS);
        let mut history = History::new(cast, self.what.shows(), end);
        history.look(&world);
        let mut progress = Progress::new(&Until { time: Some(end), ..Until::default() });
        let mut grids = [Grid::new(end / looks as f64, true)];
        let grids = if end > 0.0 { &mut grids[..] } else { &mut [] };
        let stops = if matches!(self.what, What::Energy | What::Momentum) { jumps.stops(end) } else { Vec::new() };
        for stop in stops.into_iter().chain([end]) {
            let until = Until { time: Some(stop), ..Until::default() };
            interrupted(drive(&mut world, &until, PIECE, grids, |world, news| {
                match news {
                    News::Impacts { .. } => world.impacts().iter().for_each(|impact| history.hit(&Hit::of(impact))),
                    News::Mark(_) => history.look(world),
                }
                progress.show(world.time(), world.impact_count());
                Ok(())
            })?)?;
            if history.samples.last().is_none_or(|s| s.time < world.time()) {
                history.look(&world);
            }
        }
        Ok(history)
    }

    fn write(&self, path: &str, chart: &Chart) -> Result<(), Trouble> {
        let theme = self.theme.paper().theme();
        let size = self.size.unwrap_or(SIZE);
        let sheet = chart.sheet(size, &theme);
        let mut draft = Draft::create(path)?;
        let written = match Kind::of(path) {
            Some(Kind::Png) => {
                let mut canvas = Canvas::new(size, theme.paper).ok_or_else(|| {
                    Trouble::usage(format!("the plot is too large\nhelp: at most {MOST_PIXELS} pixels wide and high"))
                })?;
                canvas.draw(&sheet);
                still::png(&canvas, &mut draft)
            }
            _ => draft.write_all(svg(size, theme.paper, &chart.title, &[&sheet]).as_bytes()),
        };
        written.and_then(|()| draft.complete()).map_err(|e| Trouble::unwritten(path, &e))?;
        wrote(path, &format!("{} x {} pixels", size[0], size[1]));
        Ok(())
    }
}
