//! The files that a run writes: which there are, and what they are told.
use crate::draft::Draft;
use crate::film::{Film, Shots};
use crate::record::Record;
use crate::render::Picture;
use crate::shoot::Kind;
use crate::sink::{Bodies, Impacts, Looks, Rows, Sink, Whole};
use crate::source::{Ready, told};
use crate::trouble::Trouble;
use crate::wrote::wrote;
use carom::{Impact, Rotates, Vector, World};
use carom_scene::Problem;
use carom_scene::model::Output;
use carom_scene::output::Report;
use std::io;

/// All files of a run.
pub struct Outputs<const D: usize>
where
    Vector<D>: Rotates,
{
    all: Vec<Opened<D>>,
}

struct Opened<const D: usize>
where
    Vector<D>: Rotates,
{
    name: String,
    looks: Looks,
    hears: bool,
    sink: Box<dyn Sink<D>>,
}

/// Opens the file of an output; an error is what is wrong with the scene's `every`, or with the file.
fn sink<const D: usize>(output: &Output, ready: &Ready) -> Result<Box<dyn Sink<D>>, Wrong>
where
    Vector<D>: Rotates,
{
    let extension = output.extension();
    let draft = || Draft::create(&output.path);
    let failed = |e: io::Error| Trouble::unwritten(&output.path, &e);
    let rows = match extension.as_str() {
        "csv" => Rows::Csv,
        "jsonl" => Rows::Lines,
        "json" if output.every.is_some() => {
            return Err(Wrong::Every(
                format!("`{}` is written once, when the run is over", output.path),
                "leave `every` out, or write the bodies on the way to a .csv or .jsonl",
            ));
        }
        "json" => return Ok(Box::new(Whole(draft()?))),
        "svg" | "png" | "gif" | "mp4" => return Picture::open(output),
        "carom" if output.every.is_some() => {
            return Err(Wrong::Every(
                format!("`{}` is a recording, and keeps the whole run", output.path),
                "leave `every` out; what is to be seen on the way can be read from the recording",
            ));
        }
        "carom" => return Ok(Box::new(Record::<D>::new(draft()?))),
        "parquet" if output.every.is_none() => {
            return impacts_as_parquet(draft()?, ready).map_err(|e| failed(e).into());
        }
        "extxyz" | "lammpstrj" | "gsd" | "vtp" | "parquet" => {
            let shots = Shots::of(&extension, &output.path, draft()?, ready).map_err(failed)?;
            return Ok(Box::new(Film::new(shots, ready, output.every)));
        }
        other => return Err(Trouble::usage(format!("{}: .{other} cannot be written by a run", output.path)).into()),
    };
    Ok(match output.every {
        None => Box::new(Impacts::start(draft()?, rows, D).map_err(failed)?),
        Some(step) => Box::new(Bodies::start(draft()?, rows, step, D).map_err(failed)?),
    })
}

#[cfg(feature = "parquet")]
fn impacts_as_parquet<const D: usize>(draft: Draft, ready: &Ready) -> io::Result<Box<dyn Sink<D>>>
where
    Vector<D>: Rotates,
{
    Ok(Box::new(crate::film::Table::start(draft, ready)?))
}

#[cfg(not(feature = "parquet"))]
fn impacts_as_parquet<const D: usize>(_: Draft, _: &Ready) -> io::Result<Box<dyn Sink<D>>>
where
    Vector<D>: Rotates,
{
    Err(crate::film::without_parquet())
}

/// Why a file is not opened.
pub enum Wrong {
    /// The scene's `every` makes no sense here: what is wrong, and the remedy.
    Every(String, &'static str),
    Trouble(Trouble),
}

impl From<Trouble> for Wrong {
    fn from(trouble: Trouble) -> Self {
        Self::Trouble(trouble)
    }
}

impl<const D: usize> Outputs<D>
where
    Vector<D>: Rotates,
{
    /// Opens what the command line and the scene want written, in that order.
    pub fn open(ready: &Ready, wanted: &[String]) -> Result<Self, Trouble> {
        for path in wanted {
            if let Some(problem) = carom_scene::output(path) {
                return Err(told(&[Problem { key: "-o".into(), ..problem }]));
            }
        }
        let wanted = wanted.iter().map(|path| Output { path: path.clone(), every: None });
        let first = wanted.len();
        let outputs: Vec<Output> = wanted.chain(ready.scene.outputs.iter().cloned()).collect();
        for (k, Output { path, .. }) in outputs.iter().enumerate() {
            if outputs[..k].iter().any(|other| other.path == *path) {
                return Err(Trouble::usage(format!("{path} would be written twice; give the outputs different names")));
            }
        }
        let mut all = Vec::new();
        for (k, output) in outputs.iter().enumerate() {
            let sink = sink::<D>(output, ready).map_err(|wrong| match wrong {
                Wrong::Trouble(trouble) => trouble,
                Wrong::Every(message, help) => {
                    let key = format!("output[{}].every", (k + 1).saturating_sub(first));
                    told(&[ready.document.place(Problem::new(key, message).help(help))])
                }
            })?;
            let (looks, hears) = (sink.looks(), sink.hears());
            all.push(Opened { name: output.path.clone(), looks, hears, sink });
        }
        Ok(Self { all })
    }

    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Adds a file that is open already.
    pub fn push(&mut self, name: String, sink: Box<dyn Sink<D>>) {
        let (looks, hears) = (sink.looks(), sink.hears());
        self.all.push(Opened { name, looks, hears, sink });
    }

    /// True if a file of this name is among them.
    pub fn contains(&self, name: &str) -> bool {
        self.all.iter().any(|o| o.name == name)
    }

    /// The first file that looks at the bodies on the way, at times that depend on where the way ends.
    pub fn that_looks(&self) -> Option<&str> {
        let looks = |o: &&Opened<D>| matches!(o.looks, Looks::Every(_) | Looks::Times(_));
        self.all.iter().find(looks).map(|o| o.name.as_str())
    }

    /// True if some file divides the whole run, and so has to know how long it is.
    pub fn any_divides(&self) -> bool {
        self.all.iter().any(|o| matches!(o.looks, Looks::Times(_)))
    }

    /// The steps (s) at which files look at the bodies of a run that ends at this time.
    pub fn steps(&self, end: f64) -> Vec<f64> {
        self.all.iter().filter(|o| o.looks != Looks::Never).map(|o| o.looks.step(end)).collect()
    }

    /// Tells of impacts.
    pub fn impacts(&mut self, ready: &Ready, first: u64, impacts: &[Impact<D>]) -> Result<(), Trouble> {
        let hears = self.all.iter_mut().filter(|o| o.hears && !impacts.is_empty());
        each(hears, |sink| sink.impacts(ready, first, impacts))
    }

    /// Says where the run has come.
    pub fn beat(&mut self, ready: &Ready, world: &World<D>) -> Result<(), Trouble> {
        each(self.all.iter_mut(), |sink| sink.beat(ready, world))
    }

    /// Shows the world to the file of the `k`-th of the [`Outputs::steps`].
    pub fn look(&mut self, ready: &Ready, world: &World<D>, k: usize) -> Result<(), Trouble> {
        let looks = self.all.iter_mut().filter(|o| o.looks != Looks::Never);
        each(looks.skip(k).take(1), |sink| sink.look(ready, world))
    }

    /// Shows the start to all files that look.
    pub fn look_first(&mut self, ready: &Ready, world: &World<D>) -> Result<(), Trouble> {
        let looks = self.all.iter_mut().filter(|o| o.looks != Looks::Never);
        each(looks, |sink| sink.look(ready, world))
    }

    /// Completes all files, and puts them in their places.
    pub fn finish(self, ready: &Ready, world: &World<D>, report: &Report) -> Result<(), Trouble> {
        self.all.into_iter().try_for_each(|o| {
            o.sink.finish(ready, world, report).map_err(|e| Trouble::unwritten(&o.name, &e))?;
            // A picture has said so itself, and how large it is.
            if Kind::of(&o.name).is_none() {
                wrote(&o.name, "");
            }
            Ok(())
        })
    }
}

/// Does it with each; what goes wrong is told with the file's name.
fn each<'a, const D: usize>(
    mut outputs: impl Iterator<Item = &'a mut Opened<D>>,
    mut act: impl FnMut(&mut dyn Sink<D>) -> io::Result<()>,
) -> Result<(), Trouble>
where
    Vector<D>: Rotates,
{
    outputs.try_for_each(|o| act(&mut *o.sink).map_err(|e| Trouble::unwritten(&o.name, &e)))
}
