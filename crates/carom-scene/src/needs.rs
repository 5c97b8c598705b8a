//! What a scene asks for that the engine cannot do yet: refused by name, never silently left out.
use carom::Coefficient;

use crate::model::Scene;
use crate::problem::Problem;

/// Every extension of an output, and whether it is written today.
const EXTENSIONS: [(&str, bool); 13] = [
    ("svg", false),
    ("png", false),
    ("gif", false),
    ("mp4", false),
    ("csv", true),
    ("json", true),
    ("jsonl", true),
    ("parquet", true),
    ("extxyz", true),
    ("lammpstrj", true),
    ("gsd", true),
    ("vtp", true),
    ("carom", true),
];

/// True if an output of this extension has a format.
pub(crate) fn is_known(extension: &str) -> bool {
    EXTENSIONS.iter().any(|e| e.0 == extension)
}

/// All extensions, for a message.
pub(crate) fn known() -> String {
    EXTENSIONS.map(|e| format!(".{}", e.0)).join(" ")
}

/// What is wrong with an output file of this name, given on the command line: nothing, an extension that no format has, or
/// one that is not written yet.
pub fn output(path: &str) -> Option<Problem> {
    let output = crate::model::Output { path: path.to_owned(), every: None };
    let extension = output.extension();
    match EXTENSIONS.iter().find(|e| e.0 == extension) {
        None => Some(
            Problem::new("output", format!("unknown extension of the output `{path}`"))
                .help(format!("the extension picks the format: {}", known())),
        ),
        Some((_, false)) => Some(
            Problem::new("output", format!("`{path}`: .{extension} is not available yet"))
                .help(format!("available: {}", available())),
        ),
        Some((_, true)) => None,
    }
}

fn available() -> String {
    EXTENSIONS.iter().filter(|e| e.1).map(|e| format!(".{}", e.0)).collect::<Vec<_>>().join(" ")
}

/// What this scene needs and cannot have yet.
pub fn needs(scene: &Scene) -> Vec<Problem> {
    let mut all = Vec::new();
    let mut tell = |key: String, what: &str, help: &str| {
        all.push(Problem::new(key, format!("{what} is not available yet")).help(help));
    };
    let rough = |mu: &Option<Coefficient>| mu.as_ref().is_some_and(|mu| mu.range().1 > 0.0);
    let smooth = "0, or leave it out";
    for surface in &scene.materials {
        let path = format!("material.{}", crate::path::quote(&surface.name));
        if rough(&surface.friction) {
            tell(format!("{path}.friction"), "friction", smooth);
        }
        for (key, value) in [("rolling", surface.rolling), ("spinning", surface.spinning)] {
            if value.is_some_and(|v| v > 0.0) {
                let what = if key == "rolling" { "rolling resistance" } else { "spinning friction" };
                tell(format!("{path}.{key}"), what, smooth);
            }
        }
    }
    for (k, pair) in scene.pairs.iter().enumerate().filter(|(_, p)| rough(&p.friction)) {
        let what = format!("friction (of `{}` and `{}`)", pair.materials[0], pair.materials[1]);
        tell(format!("pair[{}].friction", k + 1), &what, smooth);
    }
    for (k, written) in scene.outputs.iter().enumerate() {
        let extension = written.extension();
        if EXTENSIONS.contains(&(extension.as_str(), false)) {
            let what = format!("`{}`: .{extension}", written.path);
            tell(format!("output[{}].path", k + 1), &what, &format!("available: {}", available()));
        }
    }
    all
}
