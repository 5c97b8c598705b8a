//! What a scene asks for that the engine cannot do yet: refused by name, never silently left out.
use crate::model::Scene;
use crate::problem::Problem;

/// Every extension of an output, and whether it is written today.
const EXTENSIONS: [(&str, bool); 13] = [
    ("svg", true),
    ("png", true),
    ("gif", true),
    ("mp4", true),
    ("csv", true),
    ("json", true),
    ("jsonl", true),
    ("parquet", false),
    ("extxyz", false),
    ("lammpstrj", false),
    ("gsd", false),
    ("vtp", false),
    ("carom", false),
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
    for (k, written) in scene.outputs.iter().enumerate() {
        let extension = written.extension();
        if EXTENSIONS.contains(&(extension.as_str(), false)) {
            let what = format!("`{}`: .{extension}", written.path);
            tell(format!("output[{}].path", k + 1), &what, &format!("available: {}", available()));
        }
    }
    all
}
