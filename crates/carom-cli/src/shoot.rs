//! Pictures of a scene: the run is seen once to know what to show, and once more, stopped exactly at the times of the frames.
use crate::draft::Draft;
use crate::drive::PIECE;
use crate::figures::plural;
use crate::interrupt::INTERRUPT;
use crate::progress::Progress;
use crate::run::start;
use crate::source::Ready;
use crate::trouble::Trouble;
use crate::wrote::wrote;
use carom::{Limits, Rotates, Stop, Vector, World};
use carom_draw::figure::nice_below;
use carom_draw::gif::Gif;
use carom_draw::mp4::Mp4;
use carom_draw::palette::Census;
use carom_draw::{Cast, Drawing, Hit, Look, MOST_PIXELS, Snapshot, Survey, Tint, Trace, still};
use carom_scene::model::Until;
use std::io::Write;

/// Frames a second, unless somebody wants another number.
const RATE: f64 = 25.0;
/// Frames of the longest film.
const MOST_FRAMES: f64 = 20_000.0;
/// Bodies times looks on the way, to find out where everything goes.
const LOOKS: usize = 20_000_000;
/// Most looks on the way; of a still with paths a multiple of a strobe's positions.
const MOST_LOOKS: usize = 1000;
const STILL_LOOKS: usize = 14 * 28;
/// Frames from which the palette of a film is chosen.
const PROOFS: usize = 8;
/// A run that goes on for more than so many times as long as until its last impact is shown for a part of that only.
const TOO_LONG: f64 = 2.5;
const ENOUGH: f64 = 1.5;
/// How long the last frame is seen (s).
const LAST: f64 = 1.0;
/// More bodies in an open world are not followed to find the view of a still.
const MOST_FOLLOWED: usize = 5000;

/// What a picture file holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Svg,
    Png,
    Gif,
    Mp4,
}

impl Kind {
    /// By the extension; `None` of a file that is no picture.
    pub fn of(path: &str) -> Option<Self> {
        let extension = carom_scene::model::Output { path: path.into(), every: None }.extension();
        match extension.as_str() {
            "svg" => Some(Self::Svg),
            "png" => Some(Self::Png),
            "gif" => Some(Self::Gif),
            "mp4" => Some(Self::Mp4),
            _ => None,
        }
    }

    /// True if it moves.
    pub fn moves(self) -> bool {
        matches!(self, Self::Gif | Self::Mp4)
    }
}

/// What picture is wanted.
#[derive(Clone, Debug, Default)]
pub struct Order {
    pub look: Look,
    /// The time of a still (s); `None`: the end.
    pub at: Option<f64>,
    /// Frames a second.
    pub rate: Option<f64>,
    /// Seconds of the scene in a second of the film.
    pub pace: Option<f64>,
    /// Seconds of the scene between two frames.
    pub every: Option<f64>,
    /// Show all of the run, however long nothing happens.
    pub whole: bool,
    /// The run has been seen: when it ended (s), and what is known of its impacts.
    pub seen: Option<(f64, Survey)>,
}

/// A scene, and what is known of its run.
struct Shoot<'a> {
    ready: &'a Ready,
    cast: Cast,
    survey: Survey,
    /// The paths of the whole run, where they are shown.
    whole: Trace,
    /// Some frames, for the palette.
    proofs: Vec<(Snapshot, Trace)>,
    /// Ctrl-C ends it: not where it has ended the run before, of which a picture is still wanted.
    listens: bool,
}

/// Makes a picture. What Ctrl-C leaves of a film is a film.
pub fn picture<const D: usize>(ready: &Ready, draft: Draft, kind: Kind, mut order: Order) -> Result<(), Trouble>
where
    Vector<D>: Rotates,
{
    order.look.film = kind.moves();
    let cast = Cast::new(&ready.scene, &ready.plan, &ready.name);
    let listens = order.seen.is_none();
    let mut shoot =
        Shoot { ready, cast, survey: Survey::default(), whole: Trace::default(), proofs: Vec::new(), listens };
    if kind.moves() { shoot.film::<D>(draft, kind, order) } else { shoot.still::<D>(draft, kind, order) }
}

impl Shoot<'_> {
    /// Moves a world to a time; true if it got there.
    fn go<const D: usize>(&self, world: &mut World<D>, time: f64, mut hit: impl FnMut(&Hit)) -> Result<bool, Trouble>
    where
        Vector<D>: Rotates,
    {
        loop {
            let impacts = Some(world.impact_count() + PIECE);
            let interrupt = self.listens.then_some(&INTERRUPT);
            let stop = world.run(&Limits { time: Some(time), impacts, rest: false, interrupt });
            world.impacts().iter().for_each(|impact| hit(&Hit::of(impact)));
            match stop {
                Stop::Impacts => {}
                Stop::Time | Stop::Quiet | Stop::Rest => return Ok(true),
                Stop::Interrupted => return Err(Trouble::interrupted()),
                Stop::Crushed | Stop::NotFinite => return Ok(false),
            }
        }
    }

    /// When the run ends, and what is known of its impacts.
    fn scout<const D: usize>(&mut self, order: &Order) -> Result<f64, Trouble>
    where
        Vector<D>: Rotates,
    {
        if let Some((end, survey)) = &order.seen {
            self.survey = survey.clone();
            return Ok(*end);
        }
        let until = match order.at {
            Some(at) if !order.look.film => Until { time: Some(at), ..Until::default() },
            _ => self.ready.scene.run.until,
        };
        let mut world = start::<D>(self.ready)?;
        self.survey.look(&Snapshot::of(&world), &self.cast);
        let mut progress = Progress::new(&until);
        let Self { survey, cast, .. } = self;
        let stop = crate::drive::drive(&mut world, &until, PIECE, &mut [], |world, _| {
            world.impacts().iter().for_each(|impact| survey.hit(&Hit::of(impact)));
            progress.show(world.time(), world.impact_count());
            Ok(())
        })?;
        if stop == Stop::Interrupted {
            return Err(Trouble::interrupted());
        }
        survey.look(&Snapshot::of(&world), cast);
        Ok(world.time())
    }

    /// How much of a run that ends at this time is shown.
    fn shown(&self, end: f64, order: &Order) -> f64 {
        if order.whole { end } else { shown(end, self.survey.last) }
    }

    /// Follows the run to this time: where everything goes, and some frames on the way.
    fn follow<const D: usize>(&mut self, end: f64, looks: usize, look: &Look) -> Result<(), Trouble>
    where
        Vector<D>: Rotates,
    {
        let keeps = look.memory().is_infinite() || self.cast.dim == 1;
        let (mut whole, mut recent) = (
            Trace::new(if keeps { f64::INFINITY } else { 0.0 }, 0.0),
            Trace::new(if look.film { look.memory() } else { 0.0 }, look.flash()),
        );
        let mut survey = Survey { last: self.survey.last, hardest: self.survey.hardest, ..Survey::default() };
        let mut world = start::<D>(self.ready)?;
        let looks = looks.min(LOOKS / self.cast.actors.len().max(1)).max(14);
        let mut progress = Progress::new(&Until { time: Some(end), ..Until::default() });
        for k in 0..=looks {
            let time = if k == looks { end } else { end * k as f64 / looks as f64 };
            let there = self.go(&mut world, time, |hit| {
                whole.hit(hit, &self.cast);
                recent.hit(hit, &self.cast);
                survey.hit(hit);
            })?;
            let snapshot = Snapshot::of(&world);
            whole.look(&snapshot, &self.cast);
            recent.look(&snapshot, &self.cast);
            survey.look(&snapshot, &self.cast);
            progress.show(world.time(), world.impact_count());
            let proof = k * PROOFS / (looks + 1) != (k + 1) * PROOFS / (looks + 1);
            if !there {
                break;
            }
            if look.film && proof {
                self.proofs.push((snapshot, recent.clone()));
            }
        }
        survey.end = end;
        self.survey = survey;
        self.whole = whole;
        Ok(())
    }

    fn still<const D: usize>(&mut self, draft: Draft, kind: Kind, mut order: Order) -> Result<(), Trouble>
    where
        Vector<D>: Rotates,
    {
        let keeps = order.look.memory().is_infinite() || self.cast.dim == 1;
        // What falls may leave much of its box empty.
        let falls = self.cast.gravity != [0.0; 3];
        let open = (!self.cast.is_closed() || falls) && self.cast.actors.len() <= MOST_FOLLOWED;
        let (mut at, mut end) = (order.at, order.at);
        if keeps || open || at.is_none() {
            // Stills of one scene at several times show the same part of the world.
            let known = self.scout::<D>(&Order { at: None, ..order.clone() })?;
            let shown = self.shown(known, &order);
            at = at.or(Some(if keeps { shown } else { known }));
            end = Some(shown.max(at.unwrap_or(shown)));
        }
        let (at, end) = (at.unwrap_or(0.0), end.unwrap_or(0.0));
        order.look.step = clock(end);
        order.look.pace = pace(end);
        if keeps || open {
            self.follow::<D>(end, STILL_LOOKS, &order.look)?;
        }
        let mut world = start::<D>(self.ready)?;
        let mut trace = Trace::new(if self.cast.dim == 1 { 0.0 } else { order.look.memory() }, order.look.flash());
        let stops = if trace_is_kept(&order.look, &self.cast) { STILL_LOOKS } else { 1 };
        let mut progress = Progress::new(&Until { time: Some(at), ..Until::default() });
        let mut survey = std::mem::take(&mut self.survey);
        let mut snapshot = Snapshot::of(&world);
        survey.look(&snapshot, &self.cast);
        for k in 0..=stops {
            let time = if k == stops { at } else { at * k as f64 / stops as f64 };
            let there = self.go(&mut world, time, |hit| {
                trace.hit(hit, &self.cast);
                survey.hardest = survey.hardest.max(hit.impulse.iter().map(|x| x * x).sum::<f64>().sqrt());
            })?;
            progress.show(world.time(), world.impact_count());
            if k > 0 || stops > 1 {
                snapshot = Snapshot::of(&world);
                trace.look(&snapshot, &self.cast);
            }
            if !there {
                break;
            }
        }
        survey.look(&snapshot, &self.cast);
        survey.end = end.max(at);
        drop(progress);
        let drawing = Drawing::new(self.cast.clone(), order.look, survey, std::mem::take(&mut self.whole));
        let mut draft = draft;
        let (name, [wide, high]) = (draft.name().to_owned(), drawing.size());
        let written = match kind {
            Kind::Svg => draft.write_all(drawing.svg(&snapshot, &trace).as_bytes()),
            _ => {
                let mut canvas = drawing.canvas().ok_or_else(too_large)?;
                canvas.draw(&drawing.frame(&snapshot, &trace));
                still::png(&canvas, &mut draft)
            }
        };
        written.and_then(|()| draft.complete()).map_err(unwritten)?;
        wrote(&name, &format!("{wide} x {high} pixels"));
        Ok(())
    }

    fn film<const D: usize>(&mut self, draft: Draft, kind: Kind, mut order: Order) -> Result<(), Trouble>
    where
        Vector<D>: Rotates,
    {
        let end = self.scout::<D>(&order)?;
        let end = self.shown(end, &order);
        let rate = match (order.rate, order.every) {
            (Some(rate), _) => rate,
            (None, Some(every)) if (0.02..=0.2).contains(&every) => 1.0 / every,
            _ => RATE,
        };
        let pace = order.pace.or(order.every.map(|every| every * rate)).unwrap_or_else(|| pace(end));
        let step = order.every.unwrap_or(pace / rate);
        let frames = (end / step).round();
        if !(frames <= MOST_FRAMES) {
            let faster = nice_below(end / 8.0);
            return Err(Trouble::usage(format!(
                "the film would have {frames:.0} frames, and {MOST_FRAMES:.0} are the limit\nhelp: show more of the scene in a \
                 second of the film (--speed {faster}), or less of the scene (--until time=..)"
            )));
        }
        order.look.pace = pace;
        order.look.step = step;
        let look = &order.look;
        let told = look.arrows != Default::default() || matches!(look.tint, Some(Tint::Speed | Tint::Energy));
        let falls = self.cast.gravity != [0.0; 3] || self.cast.sides.iter().any(|s| s.velocity != [0.0; 3]);
        if !self.cast.is_closed() || self.cast.dim == 1 || told || falls || self.survey.seen == 0 {
            let look = order.look.clone();
            self.follow::<D>(end, (frames as usize).clamp(200, MOST_LOOKS), &look)?;
        }
        self.survey.end = end;
        let survey = self.survey.clone();
        let drawing = Drawing::new(self.cast.clone(), order.look, survey, std::mem::take(&mut self.whole));
        let ground = drawing.canvas().ok_or_else(too_large)?;
        let name = draft.name().to_owned();
        let mut canvas = ground.copy();
        let mut world = start::<D>(self.ready)?;
        let mut trace = Trace::new(drawing.look.memory(), drawing.look.flash());
        let mut reel = if kind == Kind::Gif {
            if self.proofs.is_empty() {
                // What is fast at the start is fast somewhere at any time: two frames have all colours.
                self.proofs::<D>(end, &drawing.look)?;
            }
            let mut census = Census::default();
            for (snapshot, trace) in &self.proofs {
                canvas.draw(&drawing.frame(snapshot, trace));
                census.count(canvas.pixels());
                canvas.restore(&ground);
            }
            Reel::Gif(Box::new(Gif::new(canvas.size(), &census, draft)))
        } else {
            Reel::Mp4(Mp4::new(canvas.size(), rate, draft.path()).map_err(unwritten)?, draft)
        };
        let mut progress = Progress::new(&Until { time: Some(end), ..Until::default() });
        let mut cut_short = None;
        let mut shown = 0;
        for k in 0..=frames as u64 {
            let time = if k == frames as u64 { end } else { k as f64 * step };
            let there = match self.go(&mut world, time, |hit| trace.hit(hit, &self.cast)) {
                Ok(there) => there,
                Err(trouble) => {
                    cut_short = Some(trouble);
                    break;
                }
            };
            let snapshot = Snapshot::of(&world);
            trace.look(&snapshot, &self.cast);
            canvas.restore(&ground);
            canvas.draw(&drawing.frame(&snapshot, &trace));
            match &mut reel {
                Reel::Gif(gif) => gif.frame(&canvas, k as f64 / rate),
                Reel::Mp4(mp4, _) => mp4.frame(&canvas),
            }
            .map_err(unwritten)?;
            shown = k + 1;
            progress.show(world.time(), world.impact_count());
            if !there {
                break;
            }
        }
        drop(progress);
        if shown == 0 {
            return Err(cut_short.unwrap_or_else(Trouble::interrupted));
        }
        let draft = match reel {
            Reel::Gif(gif) => gif.finish((shown as f64 - 1.0) / rate + LAST.max(1.0 / rate)),
            Reel::Mp4(mp4, draft) => mp4.finish().map(|()| draft),
        };
        draft.and_then(Draft::complete).map_err(unwritten)?;
        let [wide, high] = canvas.size();
        wrote(&name, &format!("{} of {wide} x {high} pixels", plural(shown, "frame")));
        cut_short.map_or(Ok(()), Err)
    }

    /// Some frames of a run that was not followed.
    fn proofs<const D: usize>(&mut self, end: f64, look: &Look) -> Result<(), Trouble>
    where
        Vector<D>: Rotates,
    {
        let mut world = start::<D>(self.ready)?;
        let mut trace = Trace::new(look.memory(), look.flash());
        for k in 1..=2 {
            self.go(&mut world, end * 0.1 * f64::from(k), |hit| trace.hit(hit, &self.cast))?;
            let snapshot = Snapshot::of(&world);
            trace.look(&snapshot, &self.cast);
            self.proofs.push((snapshot, trace.clone()));
        }
        Ok(())
    }
}

/// How much of a run is shown, given when it ended and when its last impact was (s): not for long that nothing happens.
pub fn shown(end: f64, last: Option<f64>) -> f64 {
    match last {
        Some(last) if last > 0.0 && end > TOO_LONG * last => ENOUGH * last,
        _ => end,
    }
}

/// Where frames go.
enum Reel {
    Gif(Box<Gif<Draft>>),
    Mp4(Mp4, Draft),
}

/// What the clock of a still tells apart (s): a thousandth or so of the run.
fn clock(end: f64) -> f64 {
    if end > 0.0 { nice_below(2e-3 * end).min(1.0) } else { 0.01 }
}

fn trace_is_kept(look: &Look, cast: &Cast) -> bool {
    look.memory().is_infinite() && cast.dim > 1
}

/// Seconds of the scene in a second of a film: as it is, if that makes a film of a reasonable length.
fn pace(end: f64) -> f64 {
    if (1.5..=20.0).contains(&end) || !(end > 0.0) { 1.0 } else { nice_below(end / 5.0) }
}

fn too_large() -> Trouble {
    Trouble::usage(format!("the picture is too large\nhelp: at most {MOST_PIXELS} pixels wide and high"))
}

fn unwritten(e: std::io::Error) -> Trouble {
    Trouble::usage(format!("cannot write the picture: {e}"))
}
