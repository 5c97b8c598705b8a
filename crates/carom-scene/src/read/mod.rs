//! From the tree of a text to the model: every key once, every default filled in, every problem noted.
//!
//! What needs only one table to be judged is judged here; what needs two (names, overlaps, the end of the run) is judged by
//! [`crate::check`] on the model. Where a value is wrong, reading goes on with a stand-in, and the model is thrown away.
mod body;
mod group;
mod material;
mod run;
mod sweep;
mod wall;
mod world;

use std::cell::{Cell, RefCell};

use crate::fields::{Fields, Reader};
use crate::keys::SCENE;
use crate::model::Scene;
use crate::node::{Node, Source};
use crate::problem::Problem;

/// The model of a tree, and the problems. There is no model where the dimension is not known; with an error among the
/// problems the model holds stand-ins.
pub(crate) fn scene(root: &Node, sources: &[Source]) -> (Option<Scene>, Vec<Problem>) {
    let reader = Reader { sources, dim: Cell::new(None), problems: RefCell::new(Vec::new()) };
    let scene = Fields::new(&reader, root, &SCENE, String::new()).and_then(|fields| whole(&fields));
    (scene, reader.problems.into_inner())
}

fn whole(fields: &Fields<'_>) -> Option<Scene> {
    fields.integer("carom");
    let title = fields.text("title").unwrap_or_default().to_owned();
    // The dimension first: every vector is checked by it.
    let world = world::read(&fields.table("world")?)?;
    let bodies = fields.list("body").iter().map(|(k, f)| body::read(f, *k, world.dim)).collect();
    let walls = fields.list("wall").iter().map(|(k, f)| wall::read(f, *k, world.dim)).collect();
    let groups = fields.list("group").iter().map(|(k, f)| group::read(f, *k, &world)).collect();
    Some(Scene {
        title,
        materials: material::all(fields),
        pairs: fields.list("pair").iter().map(|(_, f)| material::pair(f)).collect(),
        bodies,
        walls,
        groups,
        run: run::read(fields.table("run").as_ref()),
        outputs: fields.list("output").iter().map(|(_, f)| run::output(f)).collect(),
        sweep: sweep::read(fields),
        world,
    })
}

/// The name of the `k`-th `kind`, from 1: its own, or the default one.
fn name(fields: &Fields<'_>, kind: &str, k: usize) -> String {
    fields.name("name").map_or_else(|| format!("{kind}-{k}"), str::to_owned)
}
