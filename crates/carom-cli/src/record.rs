//! Recordings: what a run writes into one, and what is read of one.
use crate::draft::Draft;
use crate::figures::{count, short};
use crate::run::start;
use crate::sink::{Looks, Sink};
use crate::source::Ready;
use crate::trouble::Trouble;
use carom::{Impact, Rotates, Vector, World};
use carom_files::recording::coder::{Decoder, Encoder};
use carom_files::recording::{Keyframe, Recording, Stage, Start, Unreadable, Writer};
use carom_scene::model::{Run, Until};
use carom_scene::output::Report;
use carom_scene::{Detail, Document, Format, Scene, to_json};
use std::fs::{File, OpenOptions};
use std::io::{self, Seek, SeekFrom};
use std::path::Path;

/// A keyframe is due after so many impacts, or so many for each body, whichever is more: it costs a few bytes an impact, and a
/// process that is killed loses a second of work or less.
const IMPACTS: u64 = 1 << 16;
const IMPACTS_PER_BODY: u64 = 64;
/// Where the scene says when it ends, this many times on the way as well, if there was something to lose.
const PARTS: u32 = 50;
const EVENTS: u64 = 1 << 12;
/// A slice of a heap costs as much as so many events.
const SLICE: u64 = 16;

/// A recording under way.
pub struct Record<const D: usize>
where
    Vector<D>: Rotates,
{
    state: State<D>,
    /// Impacts and work at the last keyframe.
    impacts: u64,
    work: u64,
    time: f64,
}

enum State<const D: usize>
where
    Vector<D>: Rotates,
{
    /// Nothing is written yet.
    Waits(Draft),
    Writes(Box<Writer<D, File>>),
    /// It could not be written.
    Gone,
}

fn work<const D: usize>(world: &World<D>) -> u64
where
    Vector<D>: Rotates,
{
    world.event_count() + SLICE * world.slice_count()
}

/// The scene as a recording keeps it: what else the run wrote is not done again by whoever reads it.
fn kept(scene: &Scene) -> String {
    let scene = Scene { outputs: Vec::new(), sweep: Vec::new(), ..scene.clone() };
    to_json(&scene, Detail::Short)
}

/// What both ends of a recording know of a scene.
fn stage<const D: usize>(ready: &Ready) -> Result<Stage<D>, Trouble>
where
    Vector<D>: Rotates,
{
    let world = start::<D>(ready)?;
    let scene = &ready.scene;
    let bodies = world.bodies().zip(&ready.plan.bodies).map(|(id, placed)| {
        let mass = placed.mass.filter(|_| !placed.fixed);
        let kappa = placed.inertia.unwrap_or(if D == 3 { 0.4 } else { 0.5 });
        let inertia = mass.map(|m| kappa * m * placed.radius * placed.radius);
        Start {
            id,
            position: world.position(id).unwrap_or_default(),
            velocity: world.velocity(id).unwrap_or_default(),
            spin: world.spin(id).unwrap_or_default(),
            inverse_mass: mass.map_or(0.0, |m| 1.0 / m),
            inverse_inertia: inertia.map_or(0.0, |i| 1.0 / i),
            radius: placed.radius,
        }
    });
    let (mut corner, mut width) = (Vector::ZERO, Vector::ZERO);
    if let Some((min, max)) = scene.world.extent() {
        for k in (0..D).filter(|&k| scene.world.is_periodic(k)) {
            (corner[k], width[k]) = (min[k], max[k] - min[k]);
        }
    }
    let gravity = Vector::from_fn(|k| scene.world.gravity.get(k).copied().unwrap_or(0.0));
    Ok(Stage { bodies: bodies.collect(), walls: world.walls().collect(), gravity, corner, width })
}

impl<const D: usize> Record<D>
where
    Vector<D>: Rotates,
{
    /// A recording that begins with the run.
    pub fn new(draft: Draft) -> Self {
        Self { state: State::Waits(draft), impacts: 0, work: 0, time: 0.0 }
    }

    /// Does it with the recording; one that cannot be written any further is cut where it is whole.
    fn write(&mut self, act: impl FnOnce(&mut Writer<D, File>) -> io::Result<()>) -> io::Result<()> {
        let State::Writes(writer) = &mut self.state else { return Ok(()) };
        let Err(error) = act(writer) else { return Ok(()) };
        let whole = writer.whole();
        let cut = writer.get_mut().set_len(whole).is_ok();
        self.state = State::Gone;
        let left = if cut { "; what is recorded so far is whole, and --resume goes on from there" } else { "" };
        Err(io::Error::new(error.kind(), format!("{error}{left}")))
    }

    fn keyframe(&mut self, world: &World<D>) -> io::Result<()> {
        (self.impacts, self.work, self.time) = (world.impact_count(), work(world), world.time());
        let (time, snapshot) = (world.time(), world.snapshot());
        self.write(|writer| {
            writer.keyframe(time, &snapshot)?;
            // Also if the machine stops. What cannot be synchronised (a pipe) has no need to be.
            let _ = writer.get_ref().sync_data();
            Ok(())
        })
    }
}

impl<const D: usize> Sink<D> for Record<D>
where
    Vector<D>: Rotates,
{
    fn looks(&self) -> Looks {
        Looks::Parts(PARTS)
    }

    fn hears(&self) -> bool {
        true
    }

    fn impacts(&mut self, _ready: &Ready, _first: u64, impacts: &[Impact<D>]) -> io::Result<()> {
        self.write(|writer| writer.impacts(impacts))
    }

    fn beat(&mut self, ready: &Ready, world: &World<D>) -> io::Result<()> {
        let bodies = ready.plan.bodies.len() as u64;
        let due = world.impact_count() - self.impacts >= IMPACTS.max(IMPACTS_PER_BODY * bodies);
        if due { self.keyframe(world) } else { Ok(()) }
    }

    fn look(&mut self, ready: &Ready, world: &World<D>) -> io::Result<()> {
        if let State::Waits(_) = self.state {
            let State::Waits(mut draft) = std::mem::replace(&mut self.state, State::Gone) else { return Ok(()) };
            let stage = stage::<D>(ready).map_err(|trouble| io::Error::other(trouble.message()))?;
            // Under its name from the first keyframe on: then it is a recording, however it ends.
            let scene = kept(&ready.scene);
            let mut first = Writer::new(&mut draft, Encoder::new(stage.clone()), &scene)?;
            first.keyframe(world.time(), &world.snapshot())?;
            let whole = first.whole();
            let file = draft.go_on()?;
            self.state = State::Writes(Box::new(Writer::resume(file, Encoder::new(stage), 0, whole)));
            return Ok(());
        }
        if work(world) - self.work >= EVENTS { self.keyframe(world) } else { Ok(()) }
    }

    fn finish(mut self: Box<Self>, _ready: &Ready, world: &World<D>, report: &Report) -> io::Result<()> {
        if (self.impacts, self.work, self.time) != (world.impact_count(), work(world), world.time()) {
            self.keyframe(world)?;
        }
        self.write(|writer| writer.end(report.stopped, &report.digest))
    }
}

/// What is wrong with a recording.
pub fn unreadable(name: &str, error: &Unreadable) -> Trouble {
    match error {
        Unreadable::Io(error) => Trouble::usage(format!("cannot read {name}: {error}")),
        Unreadable::Wrong(what) => Trouble::usage(format!("{name}: {what}")),
    }
}

/// True if a recording is of this scene, whenever it was to end and whatever else was written.
pub fn is_of(recording: &Recording, scene: &Scene) -> bool {
    let Ok(recorded) = Document::parse_as("", &recording.scene, Format::Json).and_then(|d| d.scene()) else {
        return false;
    };
    let alike =
        |scene: &Scene| kept(&Scene { run: Run { until: Until::default(), ..scene.run.clone() }, ..scene.clone() });
    alike(&recorded) == alike(scene)
}

/// Whether a run came out as it was recorded.
pub fn compared(name: &str, recording: &Recording, report: &Report) -> String {
    match &recording.stopped {
        Some((why, digest)) if why == report.stopped => match *digest == report.digest {
            true => format!("(the digest is the one of {name})"),
            false => format!("note: {name} was recorded with the digest {digest}: another version of the engine?"),
        },
        _ => format!("(the run of {name} did not come so far)"),
    }
}

/// What to say of a recording whose run did not come to its end; `None` of one that did.
pub fn unfinished(name: &str, recording: &Recording) -> Option<String> {
    let how = match &recording.stopped {
        None => "was cut short",
        Some((why, _)) if why == "interrupted" => "was interrupted",
        Some(_) => return None,
    };
    let (last, impacts) = (recording.last(), count(recording.impacts));
    let head =
        format!("note: the run {how}; recorded are {impacts} impacts, and the world at t = {} s", short(last.time));
    Some(format!("{head}\nhelp: `carom run --resume {name}` goes on from there"))
}

/// Tells the first `count` impacts of a recording, until `tell` has heard enough.
pub fn tell<const D: usize>(
    ready: &Ready,
    recording: &Recording,
    count: u64,
    tell: impl FnMut(u64, &[Impact<D>]) -> Result<bool, Trouble>,
) -> Result<Decoder<D>, Trouble>
where
    Vector<D>: Rotates,
{
    recording.read(stage::<D>(ready)?, count, tell).map_err(|e| unreadable(&ready.name, &e))?
}

/// The world of a keyframe.
pub fn world<const D: usize>(name: &str, recording: &Recording, keyframe: &Keyframe) -> Result<World<D>, Trouble>
where
    Vector<D>: Rotates,
{
    let bytes = recording.snapshot(keyframe).map_err(|e| unreadable(name, &e))?;
    World::restore(&bytes).map_err(|e| {
        let help = format!("`carom run {name}` runs its scene from the start");
        Trouble::usage(format!("{name}: {e}\nhelp: {help}"))
    })
}

/// Goes on writing a recording behind its last keyframe: what was recorded behind that is recorded again.
pub fn go_on<const D: usize>(
    ready: &Ready,
    recording: &Recording,
    decoder: &Decoder<D>,
    world: &World<D>,
) -> Result<Record<D>, Trouble>
where
    Vector<D>: Rotates,
{
    let last = recording.last();
    let opened = OpenOptions::new().write(true).open(Path::new(&ready.name)).and_then(|mut file| {
        file.set_len(last.end())?;
        file.seek(SeekFrom::End(0))?;
        let mut writer = Writer::resume(file, decoder.encoder(), last.impacts, last.end());
        let scene = kept(&ready.scene);
        if scene != recording.scene {
            // It ends otherwise than it was going to.
            writer.scene(&scene)?;
        }
        Ok(writer)
    });
    let writer = opened.map_err(|e| Trouble::unwritten(&ready.name, &e))?;
    let state = State::Writes(Box::new(writer));
    Ok(Record { state, impacts: world.impact_count(), work: work(world), time: world.time() })
}
