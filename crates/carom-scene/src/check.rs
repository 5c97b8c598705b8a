//! The rules that bind two tables of a scene: names, periodic boxes, the end of the run, what a group needs.
use std::collections::{HashMap, HashSet};

use crate::fields::AXES;
use crate::geometry::Outline;
use crate::keys::MOST_BODIES;
use crate::model::{Arrangement, Boundary, Scene};
use crate::nearest::meant;
use crate::path::quote;
use crate::problem::Problem;

/// Names that are given twice, and names of nothing.
pub(crate) fn names(scene: &Scene) -> Vec<Problem> {
    let mut all = Vec::new();
    let mut seen: HashMap<&str, usize> = HashMap::new();
    for (k, body) in scene.bodies.iter().enumerate() {
        let path = format!("body[{}].name", k + 1);
        if let Some(first) = seen.insert(&body.name, k) {
            all.push(
                Problem::new(path, format!("two bodies are called `{}`", body.name))
                    .help(format!("body[{}] has that name; every body needs its own", first + 1)),
            );
        } else if body.name.starts_with("wall:") || body.name.starts_with("boundary:") {
            all.push(
                Problem::new(path, format!("a body cannot be called `{}`", body.name))
                    .help("impacts name walls so: wall:floor, boundary:x-"),
            );
        }
    }
    let mut groups = HashMap::new();
    for (k, group) in scene.groups.iter().enumerate() {
        let path = format!("group[{}].name", k + 1);
        if let Some(first) = groups.insert(group.name.as_str(), k) {
            all.push(
                Problem::new(path, format!("two groups are called `{}`", group.name))
                    .help(format!("group[{}] has that name; every group needs its own", first + 1)),
            );
        } else if group.name.starts_with("wall:") || group.name.starts_with("boundary:") {
            all.push(
                Problem::new(path, format!("a group cannot be called `{}`", group.name))
                    .help("impacts name walls so: wall:floor, boundary:x-"),
            );
        }
    }
    // gas-7 may be the seventh of the group gas.
    for (k, body) in scene.bodies.iter().enumerate() {
        let Some((stem, number)) = body.name.rsplit_once('-') else { continue };
        let Some(&group) = groups.get(stem) else { continue };
        let size = size(scene, group);
        if let Ok(number) = number.parse::<usize>()
            && (1..=size).contains(&number)
            && body.name == format!("{stem}-{number}")
        {
            all.push(
                Problem::new(
                    format!("body[{}].name", k + 1),
                    format!(
                        "two bodies are called `{}`: this one and number {number} of the group `{stem}`",
                        body.name
                    ),
                )
                .help("every body needs its own name"),
            );
        }
    }
    let mut walls: HashMap<&str, usize> = HashMap::new();
    for (k, wall) in scene.walls.iter().enumerate() {
        if let Some(first) = walls.insert(&wall.name, k) {
            all.push(
                Problem::new(format!("wall[{}].name", k + 1), format!("two walls are called `{}`", wall.name))
                    .help(format!("wall[{}] has that name; every wall needs its own", first + 1)),
            );
        }
    }
    all.extend(materials(scene));
    all
}

/// The most bodies a group can have.
fn size(scene: &Scene, group: usize) -> usize {
    let group = &scene.groups[group];
    match (group.kind, group.count) {
        (Arrangement::Rack, _) => group.rows * (group.rows + 1) / 2,
        (_, Some(count)) => count,
        (_, None) => MOST_BODIES as usize,
    }
}

fn materials(scene: &Scene) -> Vec<Problem> {
    let known: HashSet<&str> = scene.materials.iter().map(|m| m.name.as_str()).collect();
    let mut all = Vec::new();
    let mut ask = |path: String, name: &str| {
        if !known.contains(name) {
            let names = scene.materials.iter().map(|m| m.name.as_str());
            all.push(
                Problem::new(path, format!("unknown material `{name}`{}", meant(name, names)))
                    .help(format!("a material is made by [material.{}]", quote(name))),
            );
        }
    };
    if let Boundary::Box { material, .. } = &scene.world.boundary {
        ask("world.boundary.material".to_owned(), material);
    }
    for (k, pair) in scene.pairs.iter().enumerate() {
        for (i, name) in pair.materials.iter().enumerate() {
            ask(format!("pair[{}].materials[{}]", k + 1, i + 1), name);
        }
    }
    for (k, body) in scene.bodies.iter().enumerate() {
        ask(format!("body[{}].material", k + 1), &body.ball.material);
    }
    for (k, wall) in scene.walls.iter().enumerate() {
        ask(format!("wall[{}].material", k + 1), &wall.material);
    }
    for (k, group) in scene.groups.iter().enumerate() {
        ask(format!("group[{}].body.material", k + 1), &group.body.material);
    }
    let mut pairs: HashMap<[&str; 2], usize> = HashMap::new();
    for (k, pair) in scene.pairs.iter().enumerate() {
        let mut names = [pair.materials[0].as_str(), pair.materials[1].as_str()];
        names.sort_unstable();
        if let Some(first) = pairs.insert(names, k) {
            let message = format!("two lines of the pair table are about `{}` and `{}`", names[0], names[1]);
            all.push(
                Problem::new(format!("pair[{}].materials", k + 1), message)
                    .help(format!("pair[{}] is; keep one of them", first + 1)),
            );
        }
    }
    all
}

/// The rules of run, boundary and groups, of a scene whose every key is right by itself.
pub(crate) fn rules(scene: &Scene) -> Vec<Problem> {
    let mut all = until(scene);
    all.extend(periodic(scene));
    all.extend(groups(scene));
    all
}

fn until(scene: &Scene) -> Vec<Problem> {
    let until = &scene.run.until;
    if until.time.is_some() || until.impacts.is_some() {
        return Vec::new();
    }
    let why = if scene.world.gravity.iter().any(|g| *g != 0.0) {
        "gravity"
    } else if scene.world.boundary != Boundary::Open {
        "a boundary"
    } else if !scene.walls.is_empty() {
        "walls"
    } else {
        return Vec::new();
    };
    vec![
        Problem::new("run.until", format!("`until` needs time or impacts: a world with {why} may never end"))
            .help("as in until = { time = 10.0 }; only an open world without gravity and walls may leave both out"),
    ]
}

fn periodic(scene: &Scene) -> Vec<Problem> {
    let mut all = Vec::new();
    let world = &scene.world;
    let Some((min, max)) = world.extent() else { return all };
    let bodies = scene.bodies.iter().enumerate().map(|(k, b)| (b.ball.radius, format!("body[{}].radius", k + 1)));
    let groups = scene.groups.iter().enumerate().map(|(k, g)| (g.body.radius, format!("group[{}].body.radius", k + 1)));
    let largest = bodies.chain(groups).fold(None, |most: Option<(f64, String)>, next| match most {
        Some(most) if most.0 >= next.0 => Some(most),
        _ => Some(next),
    });
    for axis in (0..world.dim).filter(|&a| world.is_periodic(a)) {
        let name = AXES[axis];
        let width = max[axis] - min[axis];
        if let Some((radius, path)) = &largest
            && width < 4.0 * radius
        {
            let message = format!("the periodic box is narrower than 4 r along {name}: {width} < 4 x {radius}");
            all.push(Problem::new(path.clone(), message).help(format!(
                "a box at least {} wide, or smaller bodies: a body must not meet another one twice at once",
                4.0 * radius
            )));
        }
        if world.gravity[axis] != 0.0 {
            let message = format!("gravity along {name}, which is periodic: bodies would fall for ever faster");
            all.push(
                Problem::new(format!("world.gravity[{}]", axis + 1), message)
                    .help(format!("gravity 0 along {name}, or walls there")),
            );
        }
        for (k, wall) in scene.walls.iter().enumerate() {
            let path = format!("wall[{}]", k + 1);
            let outline = Outline::from(&wall.form);
            let crosses = match (&outline, outline.extent()) {
                (Outline::Plane(_, normal), _) => normal[axis] != 0.0,
                (_, Some((low, high))) => low[axis] < min[axis] || high[axis] > max[axis],
                _ => false,
            };
            let help = match outline {
                Outline::Plane(..) => format!("a plane along {name} (normal[{}] = 0), or walls on {name}", axis + 1),
                _ => format!("a wall between {} and {} along {name}", min[axis], max[axis]),
            };
            if crosses {
                let message = format!("the wall `{}` crosses the periodic box along {name}", wall.name);
                all.push(Problem::new(path, message).help(help));
            } else if wall.velocity[axis] != 0.0 && !matches!(outline, Outline::Plane(..)) {
                let message = format!("the wall `{}` would move across the periodic box along {name}", wall.name);
                all.push(Problem::new(format!("{path}.velocity"), message).help(format!("velocity 0 along {name}")));
            }
        }
    }
    all
}

fn groups(scene: &Scene) -> Vec<Problem> {
    use Arrangement::*;
    let mut all = Vec::new();
    let dim = scene.world.dim;
    let mut total = scene.bodies.len() as u64;
    for (k, group) in scene.groups.iter().enumerate() {
        let path = |key: &str| format!("group[{}].{key}", k + 1);
        let kind = group.kind.name();
        let place = match (group.kind, dim) {
            (Hexagonal, 1) | (Rack, 1) => Some((2, "line")),
            (Hexagonal, 3) => Some((2, "fcc")),
            (Rack, 3) => Some((2, "fcc")),
            (Fcc, 1) => Some((3, "line")),
            (Fcc, 2) => Some((3, "hexagonal")),
            _ => None,
        };
        if let Some((needs, instead)) = place {
            all.push(
                Problem::new(path("kind"), format!("\"{kind}\" lives in {needs}D, and dim = {dim}"))
                    .help(format!("in {dim}D: kind = \"{instead}\"")),
            );
            continue;
        }
        if group.kind == Rack && group.count.is_some() {
            all.push(Problem::new(path("count"), "`count` says nothing of a rack").help(format!(
                "leave it out: rows = {} holds {} bodies",
                group.rows,
                size(scene, k)
            )));
        }
        if matches!(group.kind, Random | Line) && group.count.is_none() {
            all.push(
                Problem::new(path("count"), format!("`count` is missing: \"{kind}\" needs it"))
                    .help("how many bodies, as in count = 100"),
            );
        }
        let region = group.min.is_some() && group.max.is_some();
        if matches!(group.kind, Random | Square | Hexagonal | Fcc) && !region {
            all.push(
                Problem::new(
                    path("min"),
                    format!("`min` and `max` are missing: \"{kind}\" needs a region in an open world"),
                )
                .help("the corners of the region, dim numbers each"),
            );
        }
        if matches!(group.kind, Line | Rack) && group.origin.is_none() {
            all.push(
                Problem::new(path("origin"), format!("`origin` is missing: \"{kind}\" needs it in an open world"))
                    .help("the centre of the first body, dim numbers"),
            );
        }
        if !(2.0 * group.body.radius + group.spacing).is_finite() {
            all.push(Problem::new(path("spacing"), "the pitch 2 r + spacing must be finite").help("smaller numbers"));
        }
        total += match group.kind {
            Rack => size(scene, k) as u64,
            _ => group.count.unwrap_or(0) as u64,
        };
        if total > MOST_BODIES {
            all.push(
                Problem::new(path("count"), format!("{total} bodies are more than {MOST_BODIES}")).help("fewer bodies"),
            );
            break;
        }
    }
    all
}
