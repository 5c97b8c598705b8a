//! `[world]`
use crate::fields::{AXES, Fields};
use crate::model::{Boundary, Surroundings};

/// The world; `None` where its dimension is not known.
pub(super) fn read(fields: &Fields<'_>) -> Option<Surroundings> {
    let dim = usize::try_from(fields.integer("dim")?).ok()?;
    fields.reader.dim.set(Some(dim));
    let gravity = fields.vector("gravity").unwrap_or_else(|| vec![0.0; dim]);
    let boundary = fields.table("boundary").and_then(|b| boundary(&b, dim)).unwrap_or(Boundary::Open);
    Some(Surroundings { dim, gravity, boundary })
}

fn boundary(fields: &Fields<'_>, dim: usize) -> Option<Boundary> {
    let kind = fields.choice("kind")?;
    let min = fields.vector("min");
    let max = fields.vector("max");
    let material = fields.text("material");
    let periodic = fields.axes("periodic");
    let unused = match kind {
        "open" => &["min", "max", "material", "periodic"][..],
        "periodic" => &["material", "periodic"],
        _ => &[],
    };
    for key in unused.iter().filter(|k| fields.has(k)) {
        fields.tell_key(
            key,
            format!("`{key}` says nothing of a boundary of kind \"{kind}\""),
            match (kind, *key) {
                ("open", _) => "leave it out, or write kind = \"box\" or kind = \"periodic\"",
                ("periodic", "periodic") => {
                    "leave it out: every axis goes round; kind = \"box\" has axes of both kinds"
                }
                _ => "leave it out: a periodic boundary has no walls",
            },
        );
    }
    if kind == "open" {
        return Some(Boundary::Open);
    }
    for key in ["min", "max"].iter().filter(|k| !fields.has(k)) {
        fields.tell_key(
            key,
            format!("`{key}` is missing: a boundary of kind \"{kind}\" needs it"),
            format!("as in {key} = [{}]", vec![if *key == "min" { "0.0" } else { "1.0" }; dim].join(", ")),
        );
    }
    let (min, max) = (min?, max?);
    for (k, axis) in AXES.iter().enumerate().take(dim) {
        if !(min[k] < max[k]) {
            fields.tell_key(
                "max",
                format!("max must lie above min along {axis}, got min {} and max {}", min[k], max[k]),
                "min is the corner of the smallest coordinates, max that of the largest",
            );
        } else if !(max[k] - min[k]).is_finite() {
            fields.tell_key("max", format!("the width along {axis} must be finite"), "a smaller box");
        }
    }
    Some(match kind {
        "periodic" => Boundary::Periodic { min, max },
        _ => Boundary::Box {
            min,
            max,
            material: material.unwrap_or("default").to_owned(),
            periodic: periodic.unwrap_or_default(),
        },
    })
}
