//! A scene as a file: JSON as short as possible, for links, and TOML.
#![allow(unsafe_code)]
use carom_scene::{Detail, Document, Problems, Scene, to_json, to_toml};

use crate::desk::with;
use crate::told::tell;

fn scene(text: &str) -> Result<Scene, Problems> {
    Document::parse("scene", text)?.scene()
}

/// Leaves the scene of the input (JSON) as JSON (0: short) or TOML (1: short, 2: every default filled in): 1. Or leaves what is wrong
/// with it: 0.
#[unsafe(no_mangle)]
pub extern "C" fn write_scene(form: u32) -> u32 {
    with(|desk| {
        let (verdict, output) = match scene(desk.text()) {
            Ok(scene) => (
                1,
                match form {
                    0 => to_json(&scene, Detail::Short),
                    1 => to_toml(&scene, Detail::Short),
                    _ => to_toml(&scene, Detail::Full),
                },
            ),
            Err(problems) => (0, tell(&problems.into_iter().collect::<Vec<_>>())),
        };
        desk.output = output;
        verdict
    })
}
