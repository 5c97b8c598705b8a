//! `[[group]]`
use super::body::ball;
use crate::fields::Fields;
use crate::model::{Arrangement, Ball, Distribution, Group, Mass, Surroundings};
use crate::problem::Problem;

/// Rows of a rack that names none: the fifteen balls of pool.
const ROWS: usize = 5;

/// The `k`-th group, from 1.
pub(super) fn read(fields: &Fields<'_>, k: usize, world: &Surroundings) -> Group {
    let dim = world.dim;
    let kind = fields.choice("kind").and_then(Arrangement::named);
    let count = fields.integer("count").and_then(|n| usize::try_from(n).ok());
    let (min, max) = (fields.vector("min"), fields.vector("max"));
    for (key, other) in [("min", "max"), ("max", "min")] {
        if fields.has(key) && !fields.has(other) && world.extent().is_none() {
            fields.tell_key(key, format!("`{other}` is missing: a region needs both corners"), "or leave both out");
        }
    }
    let extent = world.extent();
    let min = min.or_else(|| extent.map(|e| e.0.to_vec()));
    let max = max.or_else(|| extent.map(|e| e.1.to_vec()));
    if let (Some(min), Some(max)) = (&min, &max)
        && let Some(axis) = (0..dim).find(|&a| !(min[a] < max[a]))
    {
        fields.tell_key(
            if fields.has("max") { "max" } else { "min" },
            format!(
                "max must lie above min along {}, got min {} and max {}",
                crate::fields::AXES[axis],
                min[axis],
                max[axis]
            ),
            "min is the corner of the smallest coordinates, max that of the largest",
        );
    }
    let body = fields.table("body");
    let velocity_of_body = body.as_ref().is_some_and(|b| b.has("velocity"));
    let body = body.map(|b| ball(&b, dim)).unwrap_or_else(|| stand_in(dim));
    let origin = fields.vector("origin").or_else(|| Some(min.as_ref()?.iter().map(|x| x + body.radius).collect()));
    let direction = fields.vector("direction");
    if direction.as_ref().is_some_and(|d| d.iter().all(|x| *x == 0.0)) {
        fields.tell_key("direction", "direction must not be zero", "any length but 0");
    }
    if velocity_of_body && fields.has("velocity") {
        fields.tell_key("velocity", "body.velocity and velocity cannot both be given", "keep one of them");
    }
    let kind = kind.unwrap_or(Arrangement::Random);
    for key in unused(kind) {
        fields.note_key(key, format!("`{key}` says nothing of a group of kind \"{}\"", kind.name()));
    }
    let spacing = fields.number("spacing").unwrap_or(0.0);
    let rows = fields.integer("rows").map_or(ROWS, |n| usize::try_from(n).unwrap_or(ROWS));
    Group {
        name: super::name(fields, "group", k),
        kind,
        count,
        spacing,
        origin,
        direction: direction.unwrap_or_else(|| (0..dim).map(|k| if k == 0 { 1.0 } else { 0.0 }).collect()),
        rows,
        velocity: fields.table("velocity").and_then(|v| distribution(&v, count)),
        min,
        max,
        body,
    }
}

/// Keys that do nothing for this kind.
fn unused(kind: Arrangement) -> &'static [&'static str] {
    match kind {
        Arrangement::Random => &["origin", "direction", "rows"],
        Arrangement::Square | Arrangement::Hexagonal | Arrangement::Fcc => &["direction", "rows"],
        Arrangement::Line => &["rows"],
        Arrangement::Rack => &[],
    }
}

fn stand_in(dim: usize) -> Ball {
    Ball {
        mass: Mass::Mass(1.0),
        fixed: false,
        radius: 1.0,
        velocity: vec![0.0; dim],
        spin: vec![0.0; crate::fields::spin_length(dim)],
        material: "default".to_owned(),
        inertia: None,
    }
}

fn distribution(fields: &Fields<'_>, count: Option<usize>) -> Option<Distribution> {
    let name = fields.choice("distribution")?;
    let temperature = fields.number("temperature");
    let zero_momentum = fields.flag("zero_momentum");
    let value = fields.vector("value");
    let speed = fields.number("speed");
    let mut missing = false;
    for (key, of) in
        [("temperature", "maxwell"), ("zero_momentum", "maxwell"), ("value", "fixed"), ("speed", "uniform")]
    {
        if of == name && !fields.has(key) && key != "zero_momentum" {
            let problem = Problem::new(fields.join(key), format!("`{key}` is missing: \"{name}\" needs it"));
            fields.tell(problem.help(match key {
                "temperature" => "temperature = <m v^2> / dim (J), as in temperature = 1.0",
                "value" => "the velocity of all of them (m/s), dim numbers",
                _ => "the speed of all of them (m/s)",
            }));
            missing = true;
        } else if of != name && fields.has(key) {
            fields.tell_key(key, format!("`{key}` says nothing of \"{name}\": it belongs to \"{of}\""), "leave it out");
            missing = true;
        }
    }
    if missing {
        return None;
    }
    Some(match name {
        // One body whose momentum is zero has no temperature.
        "maxwell" => Distribution::Maxwell {
            temperature: temperature?,
            zero_momentum: zero_momentum.unwrap_or(count != Some(1)),
        },
        "fixed" => Distribution::Fixed(value?),
        _ => Distribution::Uniform(speed?),
    })
}
