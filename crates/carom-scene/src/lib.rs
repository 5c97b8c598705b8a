//! Scene files, TOML or JSON in, checked bodies and walls out; and what is told about them.
//!
//! Text becomes a [`Document`] (a tree whose values know their places), that a [`Scene`] (plain values, every default filled
//! in), that a [`Plan`] (all bodies and walls one by one), and that a world. Whatever is wrong is told with its place.
//!
//! ```
//! use carom_scene::{Document, build, builtin};
//! let mut document = Document::parse("two-balls", builtin("two-balls").unwrap_or_default())?;
//! document.set("material.default.restitution", "1.0")?;
//! let scene = document.scene()?;
//! let plan = document.plan(&scene)?;
//! let mut world = build::<1>(&scene, &plan)?;
//! world.run(&scene.run.until.limits());
//! assert_eq!(world.impact_count(), 1);
//! assert_eq!(plan.party(world.impacts()[0].parties[1]), "B");
//!
//! document.set("body.A.mass", "-2")?;
//! let problems = document.scene().unwrap_err();
//! assert!(problems.to_string().starts_with("--set:1:13: error: body[1].mass: mass must be positive, got -2"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
mod build;
mod builtin;
mod check;
#[cfg(any(test, target_family = "wasm"))]
mod decimal;
mod document;
pub mod explain;
mod extensions;
mod fields;
mod geometry;
mod grid;
mod group;
mod json;
mod keys;
pub mod model;
mod nearest;
mod node;
pub mod output;
mod pack;
mod path;
mod plan;
mod problem;
mod random;
mod read;
mod reference;
mod schema;
mod set;
mod sweep;
#[cfg(feature = "toml")]
mod toml;
#[cfg(not(feature = "toml"))]
#[path = "toml_left_out.rs"]
mod toml;
mod write;

pub use build::build;
pub use builtin::{Builtin, builtin, builtins, nearest_builtin};
pub use document::{Document, Format};
pub use extensions::output;
pub use geometry::{Outline, Point};
pub use model::Scene;
pub use nearest::nearest;
pub use node::Data;
pub use plan::{Placed, Plan, Side};
pub use problem::{MOST_PROBLEMS, Place, Problem, Problems, Severity};
pub use reference::reference;
pub use schema::schema;
pub use write::{Detail, to_json, to_toml};

/// The number nearest to a text as JSON has numbers, the same on every target; `None` if it is none.
fn number(text: &str) -> Option<f64> {
    #[cfg(target_family = "wasm")]
    return decimal::read(text);
    #[cfg(not(target_family = "wasm"))]
    text.parse().ok()
}
