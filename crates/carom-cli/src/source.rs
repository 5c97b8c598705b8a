//! Finding the SCENE of a command: a path, `-` or the name of a built-in scene; and what the command line changes in it.
use crate::trouble::Trouble;
use carom_files::recording::Recording;
use carom_scene::model::{Scene, Until};
use carom_scene::{Document, Format, Plan, Problem, Problems, builtin, nearest_builtin};
use clap::Args;
use std::io::Read;
use std::path::Path;

/// The SCENE of a command, and what is changed in it.
#[derive(Args)]
pub struct Source {
    /// A file (.toml or .json), - for standard input, a recording (.carom), or the name of a built-in scene (`carom scenes`)
    pub scene: String,
    #[command(flatten)]
    pub changes: Changes,
}

/// What the command line changes in a scene.
#[derive(Args, Clone)]
pub struct Changes {
    /// Change a key of the scene by its path: run.seed=7, body.A.mass=2.5, world.gravity=[0,-9.81]
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// End by time=S, impacts=N or rest=true instead of the scene's `until`; repeat for the first that holds
    #[arg(long, value_name = "KEY=VALUE", value_parser = end)]
    pub until: Vec<End>,
}

/// One condition of `--until`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    Time(f64),
    Impacts(u64),
    Rest(bool),
}

fn end(text: &str) -> Result<End, String> {
    const EXPECTS: &str = "expects time=SECONDS, impacts=NUMBER or rest=true";
    let (key, value) = text.split_once('=').ok_or(EXPECTS)?;
    let value = value.trim();
    match key.trim() {
        "time" => match value.parse() {
            Ok(time) if f64::is_finite(time) && time >= 0.0 => Ok(End::Time(time)),
            _ => Err("time must be a number of seconds, finite and not negative".into()),
        },
        "impacts" => {
            let digits = value.replace('_', "");
            digits.parse().map(End::Impacts).map_err(|_| "impacts must be a whole number, not negative".into())
        }
        "rest" => value.parse().map(End::Rest).map_err(|_| "rest must be true or false".into()),
        other => Err(format!("`{other}` ends no run: {EXPECTS}")),
    }
}

/// The value of `run.until` that these conditions make, as TOML.
fn until(ends: &[End]) -> String {
    // Of two times the last one counts, as with any option.
    let mut until = Until::default();
    for end in ends {
        match *end {
            End::Time(time) => until.time = Some(time),
            End::Impacts(impacts) => until.impacts = Some(impacts),
            End::Rest(rest) => until.rest = rest,
        }
    }
    let keys = [
        until.time.map(|t| format!("time = {t:?}")),
        until.impacts.map(|n| format!("impacts = {n}")),
        until.rest.then(|| "rest = true".to_string()),
    ];
    format!("{{ {} }}", keys.into_iter().flatten().collect::<Vec<_>>().join(", "))
}

/// A scene that is read, checked and placed.
pub struct Ready {
    /// What to call it on the command line.
    pub name: String,
    pub document: Document,
    pub scene: Scene,
    pub plan: Plan,
    /// The recording that the scene was read from, if it is unchanged: it holds what happens.
    pub recording: Option<Recording>,
}

impl Source {
    /// Reads, checks and places the scene.
    pub fn ready(&self) -> Result<Ready, Trouble> {
        let (document, recording) = open(&self.scene)?;
        let document = self.changes.apply(document)?;
        let recording = recording.filter(|_| self.changes.set.is_empty() && self.changes.until.is_empty());
        Ok(Ready { recording, ..check(&self.scene, document)? })
    }

    /// Reads and checks the scene of a sweep, of which no body is placed: every run places its own.
    pub fn scene(&self) -> Result<Ready, Trouble> {
        let document = self.changes.apply(open(&self.scene)?.0)?;
        let scene = document.scene().map_err(Trouble::scene)?;
        Ok(Ready { name: self.scene.clone(), document, scene, plan: Plan::default(), recording: None })
    }
}

/// Checks a document, and places what is in it.
pub fn check(name: &str, document: Document) -> Result<Ready, Trouble> {
    let scene = document.scene().map_err(Trouble::scene)?;
    let plan = document.plan(&scene).map_err(Trouble::scene)?;
    Ok(Ready { name: name.into(), document, scene, plan, recording: None })
}

/// Problems under one another.
pub fn told(problems: &[Problem]) -> Trouble {
    Trouble::scene(problems.iter().map(Problem::to_string).collect::<Vec<_>>().join("\n\n"))
}

impl Changes {
    /// True if nothing is to be changed.
    pub fn is_empty(&self) -> bool {
        self.set.is_empty() && self.until.is_empty()
    }

    fn apply(&self, mut document: Document) -> Result<Document, Trouble> {
        let changed = |document: &mut Document| -> Result<(), Problems> {
            for argument in &self.set {
                document.set_from(argument)?;
            }
            if !self.until.is_empty() {
                document.set("run.until", &until(&self.until))?;
            }
            Ok(())
        };
        changed(&mut document).map_err(Trouble::scene)?;
        Ok(document)
    }
}

/// Looks through a recording.
pub fn recording(name: &str) -> Result<Recording, Trouble> {
    Recording::open(Path::new(name)).map_err(|e| crate::record::unreadable(name, &e))
}

/// Reads the text of a scene. A file goes before a built-in scene of the same name.
fn open(name: &str) -> Result<(Document, Option<Recording>), Trouble> {
    let text = |name: &str, bytes: &[u8]| Document::read(name, bytes).map(|d| (d, None)).map_err(Trouble::scene);
    if name == "-" {
        let mut bytes = Vec::new();
        std::io::stdin()
            .read_to_end(&mut bytes)
            .map_err(|e| Trouble::usage(format!("cannot read standard input: {e}")))?;
        return text("<stdin>", &bytes);
    }
    let path = Path::new(name);
    if path.exists() && !path.is_dir() {
        let cannot = |e: std::io::Error| Trouble::usage(format!("cannot read {name}: {e}"));
        let mut file = std::fs::File::open(path).map_err(cannot)?;
        let mut bytes = Vec::new();
        file.by_ref().take(8).read_to_end(&mut bytes).map_err(cannot)?;
        if Recording::is_one(&bytes) || name.ends_with(".carom") {
            let recording = recording(name)?;
            let document = Document::parse_as(name, &recording.scene, Format::Json).map_err(Trouble::scene)?;
            return Ok((document, Some(recording)));
        }
        file.read_to_end(&mut bytes).map_err(cannot)?;
        return text(name, &bytes);
    }
    if let Some(scene) = builtin(name) {
        return text(name, scene.as_bytes());
    }
    Err(unknown(name))
}

/// Nobody knows this scene.
pub fn unknown(name: &str) -> Trouble {
    let extensions = [".toml", ".json", ".carom"];
    let looks_like_a_path = name.contains(['/', '\\']) || extensions.iter().any(|e| name.ends_with(e));
    let what = if Path::new(name).is_dir() {
        format!("{name} is a folder, not a scene")
    } else if looks_like_a_path {
        format!("there is no file {name}")
    } else {
        format!("there is no file and no built-in scene `{name}`")
    };
    let stem = Path::new(name).file_stem().and_then(|s| s.to_str()).unwrap_or(name);
    let help = match nearest_builtin(stem) {
        Some(near) => format!("did you mean the built-in scene `{near}`?"),
        None => "`carom scenes` lists the built-in scenes; - reads standard input".into(),
    };
    Trouble::usage(format!("{what}\nhelp: {help}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conditions_become_one_table() {
        let ends: Vec<End> = ["time=0.5", "impacts=1_000", "rest=true"].map(|t| end(t).unwrap()).into();
        assert_eq!(until(&ends), "{ time = 0.5, impacts = 1000, rest = true }");
        assert_eq!(until(&[End::Time(1.0), End::Time(2.0)]), "{ time = 2.0 }");
        assert_eq!(until(&[End::Rest(false)]), "{  }");
        for wrong in ["time", "time=-1", "time=nan", "time=inf", "impacts=1.5", "impacts=-1", "rest=yes", "tim=1"] {
            println!("{}", end(wrong).unwrap_err());
        }
    }
}
