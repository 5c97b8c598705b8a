//! Trajectories, in the formats that other programs read.
use crate::draft::Draft;
use crate::sink::{Looks, Sink};
use crate::source::Ready;
use carom::{Rotates, Vector, World};
use carom_files::{Actor, Bounds, Cast, Frame, Moment, extxyz, gsd, lammps, vtp};
use carom_scene::output::Report;
use std::io;
use std::path::{Path, PathBuf};

/// Frames of a trajectory that says no step of its own, the first at the start and the last at the end.
const FRAMES: u32 = 60;

/// Where frames go.
pub enum Shots {
    Extxyz(Draft),
    Lammps(Draft),
    Gsd(Box<gsd::Writer<Draft>>),
    Vtp(Series),
    #[cfg(feature = "parquet")]
    Parquet(Box<carom_files::parquet::Bodies<Draft>>),
}

impl Shots {
    /// Starts the file of a trajectory with this extension.
    pub fn of(extension: &str, path: &str, draft: Draft, ready: &Ready) -> io::Result<Self> {
        Ok(match extension {
            "lammpstrj" => Self::Lammps(draft),
            "gsd" => Self::Gsd(Box::new(gsd::Writer::new(draft)?)),
            "vtp" => Self::Vtp(Series::new(path, draft)),
            #[cfg(feature = "parquet")]
            "parquet" => Self::Parquet(Box::new(carom_files::parquet::Bodies::new(draft, &cast(ready))?)),
            #[cfg(not(feature = "parquet"))]
            "parquet" => {
                let _ = ready;
                return Err(without_parquet());
            }
            _ => Self::Extxyz(draft),
        })
    }

    fn frame(&mut self, cast: &Cast, frame: &Frame<'_>) -> io::Result<()> {
        match self {
            Self::Extxyz(draft) => extxyz::write(draft, cast, frame),
            Self::Lammps(draft) => lammps::write(draft, cast, frame),
            Self::Gsd(writer) => writer.frame(cast, frame),
            Self::Vtp(series) => series.frame(cast, frame),
            #[cfg(feature = "parquet")]
            Self::Parquet(table) => table.frame(frame),
        }
    }

    fn complete(self) -> io::Result<()> {
        match self {
            Self::Extxyz(draft) | Self::Lammps(draft) => draft.complete(),
            Self::Gsd(writer) => writer.finish()?.complete(),
            Self::Vtp(series) => series.complete(),
            #[cfg(feature = "parquet")]
            Self::Parquet(table) => table.finish()?.complete(),
        }
    }
}

/// What is said where Parquet was left out.
#[cfg(not(feature = "parquet"))]
pub fn without_parquet() -> io::Error {
    io::Error::other("this carom was built without Parquet; build it with its default features, or write a .csv")
}

/// A frame per file: `x-0000.vtp`, ..., and `x.pvd` with their times. `x.vtp` itself is the last frame.
pub struct Series {
    path: PathBuf,
    last: Draft,
    /// The last frame as bytes: it is written when there is no other behind it.
    bytes: Vec<u8>,
    frames: Vec<(f64, String, Draft)>,
}

impl Series {
    fn new(path: &str, last: Draft) -> Self {
        Self { path: PathBuf::from(path), last, bytes: Vec::new(), frames: Vec::new() }
    }

    fn frame(&mut self, cast: &Cast, frame: &Frame<'_>) -> io::Result<()> {
        self.bytes.clear();
        vtp::write(&mut self.bytes, cast, frame)?;
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let name = format!("{stem}-{:04}.vtp", frame.number);
        let mut draft = created(&self.path.with_file_name(&name))?;
        io::Write::write_all(&mut draft, &self.bytes)?;
        draft.close()?;
        self.frames.push((frame.time, name, draft));
        Ok(())
    }

    fn complete(mut self) -> io::Result<()> {
        io::Write::write_all(&mut self.last, &self.bytes)?;
        let mut index = created(&self.path.with_extension("pvd"))?;
        vtp::collection(&mut index, self.frames.iter().map(|(time, name, _)| (*time, name.as_str())))?;
        for (_, _, draft) in self.frames {
            draft.complete()?;
        }
        index.complete()?;
        self.last.complete()
    }
}

/// A file beside the one that was asked for.
fn created(path: &Path) -> io::Result<Draft> {
    Draft::create(&path.to_string_lossy()).map_err(|trouble| io::Error::other(trouble.message()))
}

/// A trajectory under way.
pub struct Film {
    shots: Shots,
    cast: Cast,
    looks: Looks,
    number: u64,
    moments: Vec<Moment>,
}

impl Film {
    pub fn new(shots: Shots, ready: &Ready, every: Option<f64>) -> Self {
        let looks = every.map_or(Looks::Times(FRAMES), Looks::Every);
        Self { shots, cast: cast(ready), looks, number: 0, moments: Vec::new() }
    }
}

impl<const D: usize> Sink<D> for Film
where
    Vector<D>: Rotates,
{
    fn looks(&self) -> Looks {
        self.looks
    }

    fn look(&mut self, _ready: &Ready, world: &World<D>) -> io::Result<()> {
        self.moments.clear();
        for id in world.bodies() {
            let mut moment = Moment::default();
            let (x, v) = (world.position(id).unwrap_or_default(), world.velocity(id).unwrap_or_default());
            moment.position[..D].copy_from_slice(&x.0);
            moment.velocity[..D].copy_from_slice(&v.0);
            let spin = world.spin(id).unwrap_or_default();
            // In the plane, about z.
            let first = if D == 2 { 2 } else { 0 };
            let numbers = Vector::<D>::spin_slice(&spin);
            moment.spin[first..first + numbers.len()].copy_from_slice(numbers);
            self.moments.push(moment);
        }
        let frame = Frame { number: self.number, time: world.time(), bodies: &self.moments };
        self.number += 1;
        self.shots.frame(&self.cast, &frame)
    }

    fn finish(self: Box<Self>, _ready: &Ready, _world: &World<D>, _report: &Report) -> io::Result<()> {
        self.shots.complete()
    }
}

/// Who plays in a scene.
pub fn cast(ready: &Ready) -> Cast {
    let (scene, plan) = (&ready.scene, &ready.plan);
    let named = scene.bodies.len();
    let mut kinds: Vec<String> = scene.bodies.iter().map(|b| b.name.clone()).collect();
    kinds.extend(scene.groups.iter().map(|g| g.name.clone()));
    let bodies = plan.bodies.iter().enumerate().map(|(k, body)| {
        let name = plan.name(k);
        let group = name.rsplit_once('-').and_then(|(group, _)| scene.groups.iter().position(|g| g.name == group));
        let kind = if k < named { k } else { named + group.unwrap_or(0) };
        Actor { name, kind: kind as u32 + 1, mass: body.mass, radius: body.radius }
    });
    let mut bounds = Bounds::open();
    if let Some((min, max)) = scene.world.extent() {
        for k in 0..plan.dim {
            (bounds.min[k], bounds.max[k]) = (min[k], max[k]);
            bounds.periodic[k] = scene.world.is_periodic(k);
        }
    }
    let bodies = bodies.collect();
    Cast { title: scene.title.clone(), dim: plan.dim, kinds, bodies, bounds }
}

/// The impacts as a Parquet table.
#[cfg(feature = "parquet")]
pub struct Table(carom_files::parquet::Impacts<Draft>);

#[cfg(feature = "parquet")]
impl Table {
    pub fn start(draft: Draft, ready: &Ready) -> io::Result<Self> {
        let plan = &ready.plan;
        let bodies: Vec<String> = (0..plan.bodies.len()).map(|k| plan.name(k)).collect();
        let walls: Vec<String> = plan.sides.iter().map(|s| s.label.clone()).collect();
        Ok(Self(carom_files::parquet::Impacts::new(draft, plan.dim, &bodies, &walls)?))
    }
}

#[cfg(feature = "parquet")]
impl<const D: usize> Sink<D> for Table
where
    Vector<D>: Rotates,
{
    fn hears(&self) -> bool {
        true
    }

    fn impacts(&mut self, _ready: &Ready, first: u64, impacts: &[carom::Impact<D>]) -> io::Result<()> {
        self.0.add(first, impacts)
    }

    fn finish(self: Box<Self>, _ready: &Ready, _world: &World<D>, _report: &Report) -> io::Result<()> {
        self.0.finish()?.complete()
    }
}
