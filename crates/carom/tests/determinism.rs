//! The same scene, the same bits: twice in a row, with cells of any width or lists of neighbours, with one `advance` or a thousand. What
//! `tools/determinism` compares besides are levels of optimisation, and wasm.
#[allow(dead_code)]
#[path = "../examples/digest.rs"]
mod digest;

use digest::{How, PLAIN, SCENES};

fn equal(hows: &[How]) {
    let mut different = Vec::new();
    for (name, scene) in SCENES {
        let want = scene(PLAIN);
        println!("{name:8} {:016x} {:016x} {:6} impacts", want.digest, want.impacts, want.count);
        for how in hows {
            let got = scene(*how);
            if got != want {
                println!("{name:8} {:016x} {:016x} {:6} impacts with {how:?}", got.digest, got.impacts, got.count);
                different.push((name, *how));
            }
        }
    }
    assert!(different.is_empty(), "{different:?}");
}

#[test]
fn twice_in_a_row() {
    equal(&[PLAIN, PLAIN]);
}

#[test]
fn with_cells_of_any_width() {
    equal(&[0.5, 1.3, 2.0, 5.0, 1000.0].map(|cells| How { cells, ..PLAIN }));
}

/// Cells of a thousand widths have no lean way, lists of neighbours or cells that doubt no image have one: all the same bits.
#[test]
fn with_lists_of_neighbours_or_without() {
    equal(&[0.0, 0.05, 0.3, 1.0].map(|margin| How { lists: Some(margin), ..PLAIN }));
}

#[test]
fn with_any_number_of_frames() {
    equal(&[2, 60, 1000, 1001].map(|frames| How { frames, ..PLAIN }));
}

#[test]
fn something_happens() {
    let count = |name: &str| SCENES.iter().find(|s| s.0 == name).unwrap().1(PLAIN).count;
    // Galperin: floor(pi 10^2). Dropped from h = 1 with e = 0.9: THEORY 4.1 counts 58 bounces, and the one that lasts.
    assert_eq!((count("pi"), count("bounce")), (314, 59));
    assert!(["gas", "spheres", "rough", "gravity", "cradle", "heap"].iter().all(|name| count(name) > 10));
}
