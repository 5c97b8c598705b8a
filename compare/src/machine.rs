//! What the numbers were measured with.
use std::fmt::Write;

use serde_json::{Value, json};

use crate::engine::ENGINES;

/// The processor's model, as the system tells it.
fn processor() -> String {
    let told = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = told.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    line.map_or_else(|| std::env::consts::ARCH.into(), |(_, name)| name.trim().into())
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// As Markdown.
pub fn markdown() -> String {
    let mut text = format!("\nMachine: {}, {} cores; every engine on one thread.\n\n", processor(), cores());
    text += "| engine | version | made for |\n|---|---|---|\n";
    for kind in ENGINES {
        let _ = writeln!(text, "| {} | {} | {} |", kind.name, kind.version, kind.made_for);
    }
    text += "\n*default*: as the engine comes, 60 steps a second. *240 Hz*: four steps a frame; *16 sub-steps*: four times the default number inside one step; *threshold 0*: no approach speed below which \
a bounce is swallowed; *CCD*, *bullets*: continuous detection for every ball that moves at the start. In every engine: friction 0, \
damping 0, sleeping off, and both surfaces of a contact say the same e.\n";
    text
}

/// As JSON.
pub fn json() -> Value {
    let engines: Vec<Value> = ENGINES.iter().map(|k| json!({ "name": k.name, "version": k.version })).collect();
    json!({ "processor": processor(), "cores": cores(), "engines": engines })
}
