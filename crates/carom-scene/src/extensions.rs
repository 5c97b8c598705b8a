//! The formats of outputs, by the extension of a file's name.
use crate::problem::Problem;

/// Every extension of an output.
const EXTENSIONS: [&str; 13] =
    ["svg", "png", "gif", "mp4", "csv", "json", "jsonl", "parquet", "extxyz", "lammpstrj", "gsd", "vtp", "carom"];

/// True if an output of this extension has a format.
pub(crate) fn is_known(extension: &str) -> bool {
    EXTENSIONS.contains(&extension)
}

/// All extensions, for a message.
pub(crate) fn known() -> String {
    EXTENSIONS.map(|e| format!(".{e}")).join(" ")
}

/// What is wrong with an output file of this name, given on the command line: an extension that no format has.
pub fn output(path: &str) -> Option<Problem> {
    let output = crate::model::Output { path: path.to_owned(), every: None };
    (!is_known(&output.extension())).then(|| {
        Problem::new("output", format!("unknown extension of the output `{path}`"))
            .help(format!("the extension picks the format: {}", known()))
    })
}
