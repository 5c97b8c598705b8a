//! What the fuzzer found stays found: every input of `fuzz/corpus` and `fuzz/found` goes through its target again, which must end
//! and must not panic. (`tools/fuzz` looks for more; `fuzz/src` says what is looked at.)
use std::fs;
use std::path::{Path, PathBuf};

#[path = "../../../fuzz/src/lib.rs"]
mod targets;

/// The inputs of a target, in the order of their names.
fn inputs(target: &str) -> Vec<PathBuf> {
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz");
    let mut inputs = Vec::new();
    for folder in ["corpus", "found"] {
        let Ok(files) = fs::read_dir(fuzz.join(folder).join(target)) else { continue };
        inputs.extend(files.map(|f| f.expect("a file can be listed").path()));
    }
    inputs.sort();
    inputs
}

fn replay(target: &str, run: fn(&[u8])) {
    let inputs = inputs(target);
    println!("{target}: {} inputs", inputs.len());
    for input in &inputs {
        let bytes = fs::read(input).expect("a file can be read");
        if let Err(panic) = std::panic::catch_unwind(|| run(&bytes)) {
            eprintln!("the input is {}", input.display());
            std::panic::resume_unwind(panic);
        }
    }
    assert!(inputs.len() >= 20, "the corpus of {target} is missing");
}

#[test]
fn scenes() {
    replay("scene", targets::scene);
}

#[test]
fn worlds() {
    replay("world", targets::world);
}

#[test]
fn snapshots() {
    replay("snapshot", targets::snapshot);
}
