//! The guide holds: its Rust runs, its links lead somewhere, its table of contents is complete, its reference is the program's.
use std::fs;
use std::path::{Path, PathBuf};

use carom_guide::markdown;

/// The Rust blocks of all pages.
mod blocks {
    include!(concat!(env!("OUT_DIR"), "/blocks.rs"));
}

fn guide() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../guide")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

#[test]
fn the_blocks_were_found() {
    println!("{} blocks of Rust", blocks::BLOCKS);
    assert!(blocks::BLOCKS >= 20);
}

#[test]
fn every_link_leads_somewhere() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for path in markdown::pages(&guide()) {
        for (line, target) in markdown::links(&read(&path)) {
            if target.contains("://") || target.starts_with('#') {
                continue;
            }
            count += 1;
            let file = target.split('#').next().unwrap();
            // Within the guide, or mdBook would leave a hole.
            let to = path.parent().unwrap().join(file);
            let inside = fs::canonicalize(&to).is_ok_and(|to| to.starts_with(fs::canonicalize(guide()).unwrap()));
            if !inside {
                wrong.push(format!("{}:{line}: {target}", path.display()));
            }
        }
    }
    println!("{count} links");
    assert!(count > 30 && wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_summary_has_every_page() {
    let summary = guide().join("SUMMARY.md");
    let listed: Vec<PathBuf> = markdown::links(&read(&summary)).into_iter().map(|(_, to)| guide().join(to)).collect();
    for page in markdown::pages(&guide()) {
        assert!(page == summary || listed.contains(&page), "{} is not in SUMMARY.md", page.display());
    }
    for (k, page) in listed.iter().enumerate() {
        assert!(!listed[..k].contains(page), "{} is twice in SUMMARY.md", page.display());
    }
}

/// The page is written by `carom schema --format markdown`, from the table by which scenes are read.
#[test]
fn the_scene_reference_is_the_program_s() {
    let page = read(&guide().join("scene-reference.md"));
    assert!(
        page == carom_scene::reference(),
        "the keys of a scene have changed: `cargo run -p carom-cli -- schema --format markdown > guide/scene-reference.md`"
    );
}

/// The programs of `cargo run -p carom --example tour`.
#[path = "../../carom/examples/tour/main.rs"]
mod tour;

#[test]
fn the_tour_keeps_its_word() {
    let page = read(&guide().join("examples.md"));
    for (name, about, run) in tour::TOUR {
        println!("== {name}");
        run().unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(page.contains(&format!("`{name}`")) && page.contains(about), "{name} is not on its page");
    }
    assert_eq!(tour::TOUR.len(), 12);
}
