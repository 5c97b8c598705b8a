//! A scene as the page needs it to draw: bodies one by one, walls as outlines, what can be changed.
use carom_scene::model::{Boundary, Scene};
use carom_scene::{Outline, Plan, Problem};
use serde::Serialize;

use crate::told::json;

#[derive(Serialize)]
struct Body {
    name: String,
    mass: Option<f64>,
    radius: f64,
    fixed: bool,
    /// kappa in I = kappa m R^2; 0 on the line.
    inertia: f64,
    material: String,
    /// The number of its `[[body]]`; `None` if a group placed it.
    own: Option<usize>,
}

#[derive(Serialize)]
struct Wall {
    label: String,
    kind: &'static str,
    /// Plane: point, normal. Segment: its ends. Arc: centre, then radius, from, to. Triangle: its corners.
    numbers: Vec<Vec<f64>>,
    velocity: Vec<f64>,
}

#[derive(Serialize)]
struct Description<'a> {
    dim: usize,
    title: &'a str,
    gravity: &'a [f64],
    bodies: Vec<Body>,
    walls: Vec<Wall>,
    /// The box: its corners and the axes that go round.
    corners: Option<[Vec<f64>; 2]>,
    periodic: Vec<usize>,
    together: &'static str,
    law: &'static str,
    until: Until,
    notes: Vec<String>,
}

#[derive(Serialize)]
struct Until {
    time: Option<f64>,
    impacts: Option<u64>,
    rest: bool,
}

/// The scene as one JSON object.
pub(crate) fn scene(scene: &Scene, plan: &Plan, notes: &[Problem]) -> String {
    let dim = plan.dim;
    let default = match dim {
        1 => 0.0,
        2 => 0.5,
        _ => 0.4,
    };
    let bodies = plan
        .bodies
        .iter()
        .enumerate()
        .map(|(k, body)| Body {
            name: plan.name(k),
            mass: body.mass,
            radius: body.radius,
            fixed: body.fixed,
            inertia: body.inertia.unwrap_or(default),
            material: scene.materials.get(body.material).map(|m| m.name.clone()).unwrap_or_default(),
            own: (k < scene.bodies.len()).then_some(k),
        })
        .collect();
    let cut = |p: &[f64; 3]| p[..dim].to_vec();
    let walls = plan
        .sides
        .iter()
        .map(|side| {
            let (kind, numbers) = match &side.outline {
                Outline::Plane(point, normal) => ("plane", vec![cut(point), cut(normal)]),
                Outline::Segment(from, to) => ("segment", vec![cut(from), cut(to)]),
                Outline::Arc { centre, radius, from, to } => ("arc", vec![cut(centre), vec![*radius, *from, *to]]),
                Outline::Triangle(a, b, c) => ("triangle", vec![cut(a), cut(b), cut(c)]),
            };
            Wall { label: side.label.clone(), kind, numbers, velocity: cut(&side.velocity) }
        })
        .collect();
    let periodic = match &scene.world.boundary {
        Boundary::Open => Vec::new(),
        _ => (0..dim).filter(|&k| scene.world.is_periodic(k)).collect(),
    };
    json(&Description {
        dim,
        title: &scene.title,
        gravity: &scene.world.gravity,
        bodies,
        walls,
        corners: scene.world.extent().map(|(min, max)| [min.to_vec(), max.to_vec()]),
        periodic,
        together: scene.run.together.name(),
        law: scene.run.law.name(),
        until: Until { time: scene.run.until.time, impacts: scene.run.until.impacts, rest: scene.run.until.rest },
        notes: notes.iter().map(|n| n.message.clone()).collect(),
    })
}
