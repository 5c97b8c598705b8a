//! `carom render`: a picture or a film of a scene, without a window.
use crate::draft::Draft;
use crate::interrupt;
use crate::outputs::Wrong;
use crate::shoot::{Kind, Order, picture};
use crate::sink::Sink;
use crate::source::{Ready, Source};
use crate::trouble::Trouble;
use carom::{Impact, Rotates, Vector, World};
use carom_draw::theme::Paper;
use carom_draw::{Arrows, Hit, Look, MOST_PIXELS, Survey, Tint};
use carom_scene::model::Output;
use carom_scene::output::Report;
use clap::{Args, ValueEnum};
use std::io::{self, Write, stderr};

const AFTER: &str = "\
The extension picks the kind: .svg and .png are stills, .gif and .mp4 are films (.mp4 needs the
program ffmpeg). Every frame shows the motion exactly as it is at its time, and the same scene
gives the same bytes everywhere.

Examples:
  carom render break -o break.gif
  carom render break -o break.png --at 0.5 --arrows v
  carom render bounce -o bounce.svg --strobe
  carom render two-balls -o two-balls.gif --theme dark --arrows p,J
  carom render spheres -o spheres.png --size 1600x1200";

/// Draw a scene: a picture or a film, without a window
#[derive(Args)]
#[command(after_help = AFTER)]
pub struct Render {
    #[command(flatten)]
    source: Source,
    /// The file: .svg, .png, .gif or .mp4; repeat for several
    #[arg(short, long = "output", value_name = "FILE", required = true)]
    output: Vec<String>,
    /// The time of a still (s); without it, the end
    #[arg(long, value_name = "S", value_parser = time)]
    at: Option<f64>,
    /// Arrows: velocities v, momenta p, impulses J
    #[arg(long, value_name = "v,p,J", value_delimiter = ',', ignore_case = true)]
    arrows: Vec<Arrow>,
    /// Paths of bodies: all of them in a still, the last of them in a film
    #[arg(long)]
    trails: bool,
    /// One still that shows the motion: where the bodies were at equal steps of time
    #[arg(long)]
    strobe: bool,
    /// What the colour of a body says; without it: names of few, groups of several, speeds of many
    #[arg(long, alias = "color", value_enum)]
    colour: Option<Colour>,
    /// Show the centre of mass, or not; without it: of a few bodies that nothing else acts on
    #[arg(long, alias = "center", value_name = "BOOL", num_args = 0..=1, default_missing_value = "true")]
    centre: Option<bool>,
    /// Light or dark paper
    #[arg(long, value_enum, default_value = "light")]
    theme: Theme,
    /// Width and height in pixels; without it, as the scene wants it
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Frames a second of a film [default: 25]
    #[arg(long, value_name = "N", value_parser = rate)]
    fps: Option<f64>,
    /// Seconds of the scene in a second of the film; without it 1, or slower or faster if that would be too short or too long
    #[arg(long, value_name = "X", value_parser = positive)]
    speed: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Arrow {
    /// velocities
    V,
    /// momenta
    P,
    /// impulses, on both bodies
    #[value(name = "J")]
    J,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Colour {
    /// who it is
    Name,
    /// which group it belongs to
    Group,
    /// how fast it is
    Speed,
    /// how much kinetic energy it has
    Energy,
}

/// The paper of a picture.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Theme {
    /// dark on light
    Light,
    /// light on dark
    Dark,
}

impl Theme {
    pub fn paper(self) -> Paper {
        match self {
            Self::Light => Paper::Light,
            Self::Dark => Paper::Dark,
        }
    }
}

fn time(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(t) if f64::is_finite(t) && t >= 0.0 => Ok(t),
        _ => Err("expects a number of seconds, finite and not negative".into()),
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(x) if f64::is_finite(x) && x > 0.0 => Ok(x),
        _ => Err("expects a positive number".into()),
    }
}

fn rate(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(x) if (1.0..=240.0).contains(&x) => Ok(x),
        _ => Err("expects frames a second, from 1 to 240".into()),
    }
}

/// Width and height.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.trim().parse().ok().filter(|n| (64..=MOST_PIXELS).contains(n));
    let both = text.split_once(['x', 'X', '×']).and_then(|(w, h)| Some([side(w)?, side(h)?]));
    both.ok_or_else(|| format!("expects a width and a height of 64 to {MOST_PIXELS} pixels, as in 1280x720"))
}

impl Render {
    pub fn run(self) -> Result<(), Trouble> {
        interrupt::listen();
        let ready = self.source.ready()?;
        for (n, path) in self.output.iter().enumerate() {
            let Some(kind) = Kind::of(path) else {
                return Err(Trouble::usage(format!(
                    "-o {path}: a picture is a .svg, .png, .gif or .mp4\nhelp: `carom run {} -o {path}` writes data",
                    ready.name
                )));
            };
            if self.output[..n].contains(path) {
                return Err(Trouble::usage(format!(
                    "{path} would be written twice; give the pictures different names"
                )));
            }
            if kind.moves() && self.at.is_some() {
                return Err(Trouble::usage(format!(
                    "--at is the time of a still, and {path} is a film\nhelp: --until time=S ends a film"
                )));
            }
            if kind.moves() && self.strobe {
                return Err(Trouble::usage(format!("--strobe makes a still, and {path} is a film\nhelp: --trails")));
            }
        }
        for path in &self.output {
            let Some(kind) = Kind::of(path) else { continue };
            let draft = Draft::create(path)?;
            let order = self.order();
            if kind == Kind::Gif && self.fps.is_some_and(|fps| fps > 50.0) {
                let _ = writeln!(
                    stderr(),
                    "note: most viewers slow down GIFs of more than 50 frames a second; --fps 50 runs smoothly everywhere"
                );
            }
            match ready.scene.world.dim {
                1 => picture::<1>(&ready, draft, kind, order)?,
                2 => picture::<2>(&ready, draft, kind, order)?,
                _ => picture::<3>(&ready, draft, kind, order)?,
            }
        }
        Ok(())
    }

    fn order(&self) -> Order {
        let wants = |arrow| self.arrows.contains(&arrow);
        let tint = self.colour.map(|colour| match colour {
            Colour::Name => Tint::Name,
            Colour::Group => Tint::Group,
            Colour::Speed => Tint::Speed,
            Colour::Energy => Tint::Energy,
        });
        Order {
            look: Look {
                paper: self.theme.paper(),
                tint,
                arrows: Arrows { velocity: wants(Arrow::V), momentum: wants(Arrow::P), impulse: wants(Arrow::J) },
                trails: self.trails,
                strobe: self.strobe,
                centre: self.centre,
                size: self.size,
                ..Look::default()
            },
            at: self.at,
            rate: self.fps,
            pace: self.speed,
            every: None,
            whole: !self.source.changes.until.is_empty(),
            seen: None,
        }
    }
}

/// A picture that a run writes.
pub struct Picture {
    draft: Draft,
    kind: Kind,
    every: Option<f64>,
    survey: Survey,
}

impl Picture {
    /// Opens the file of a picture.
    pub fn open<const D: usize>(output: &Output) -> Result<Box<dyn Sink<D>>, Wrong>
    where
        Vector<D>: Rotates,
    {
        let kind = Kind::of(&output.path).unwrap_or(Kind::Svg);
        if output.every.is_some() && !kind.moves() {
            let what = format!("`{}` is a still: it shows the end of the run", output.path);
            return Err(Wrong::Every(what, "leave `every` out, or make it a .gif or .mp4"));
        }
        let draft = Draft::create(&output.path)?;
        Ok(Box::new(Self { draft, kind, every: output.every, survey: Survey::default() }))
    }
}

impl<const D: usize> Sink<D> for Picture
where
    Vector<D>: Rotates,
{
    fn hears(&self) -> bool {
        true
    }

    fn impacts(&mut self, _ready: &Ready, _first: u64, impacts: &[Impact<D>]) -> io::Result<()> {
        impacts.iter().for_each(|impact| self.survey.hit(&Hit::of(impact)));
        Ok(())
    }

    fn finish(self: Box<Self>, ready: &Ready, _world: &World<D>, report: &Report) -> io::Result<()> {
        let Self { draft, kind, every, survey } = *self;
        let order = Order { every, whole: every.is_some(), seen: Some((report.time, survey)), ..Order::default() };
        picture::<D>(ready, draft, kind, order).map_err(|trouble| io::Error::other(trouble.message()))
    }
}
