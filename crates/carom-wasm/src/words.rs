//! What an impact means: the chain of `carom explain` for a line of a run, from the scene and that line alone. And the scene as a
//! file.
#![allow(unsafe_code)]
use carom_scene::explain::{Explanation, Language, Symbols};
use carom_scene::output::ImpactLine;
use carom_scene::{Detail, Document, Plan, Problems, Scene, to_json, to_toml};

use crate::desk::with;
use crate::told::tell;

/// The scene whose impacts are explained.
#[derive(Debug)]
pub(crate) struct Words {
    scene: Scene,
    plan: Plan,
}

impl Words {
    /// Reads a scene.
    fn open(text: &str) -> Result<Self, Problems> {
        let document = Document::parse("scene", text)?;
        let scene = document.scene()?;
        Ok(Self { plan: document.plan(&scene)?, scene })
    }

    /// The explanation of an impact that was alone in its instant; its line as `carom events --format json` prints it.
    fn explained(&self, line: &str) -> Option<Explanation> {
        let line: ImpactLine = serde_json::from_str(line).ok()?;
        // Whoever is no body is a wall.
        let parties = [0, 1].map(|k| (0..self.plan.bodies.len()).find(|&b| self.plan.name(b) == line.bodies[k]));
        Explanation::of_contact(&self.plan, parties, &line, None).ok().flatten()
    }
}

/// Opens a scene to explain its impacts: 1. Or leaves what is wrong with it: 0.
#[unsafe(no_mangle)]
pub extern "C" fn words_open() -> u32 {
    with(|desk| match Words::open(desk.text()) {
        Ok(words) => {
            desk.words = Some(words);
            1
        }
        Err(problems) => {
            desk.output = tell(&problems.into_iter().collect::<Vec<_>>());
            0
        }
    })
}

/// Leaves the chain of an impact, `null` where several contacts share the instant. The input is a line that names the language and
/// the letters ("pt-BR Q,I"), and a line that is the impact.
#[unsafe(no_mangle)]
pub extern "C" fn words_explain() {
    with(|desk| {
        let (how, line) = desk.text().split_once('\n').unwrap_or_default();
        let (language, letters) = how.split_once(' ').unwrap_or((how, ""));
        let language: Language = language.parse().unwrap_or_default();
        let chain =
            desk.words.as_ref().and_then(|w| w.explained(line)).map(|x| x.page(language, Symbols::named(letters)));
        desk.output = chain.unwrap_or_else(|| "null".into());
    });
}

/// Leaves the numbers of an impact, the input, as `carom explain --format json` prints them.
#[unsafe(no_mangle)]
pub extern "C" fn words_numbers() {
    with(|desk| {
        let numbers = desk.words.as_ref().and_then(|w| w.explained(desk.text())).map(|x| x.json());
        desk.output = numbers.unwrap_or_else(|| "null".into());
    });
}

/// Leaves the scene as JSON (0: short) or TOML (1: short, 2: every default filled in).
#[unsafe(no_mangle)]
pub extern "C" fn words_write(form: u32) {
    with(|desk| {
        let written = desk.words.as_ref().map(|words| match form {
            0 => to_json(&words.scene, Detail::Short),
            1 => to_toml(&words.scene, Detail::Short),
            _ => to_toml(&words.scene, Detail::Full),
        });
        desk.output = written.unwrap_or_default();
    });
}
