//! `[[body]]`, and `body` of a group
use crate::fields::{Fields, spin_length};
use crate::model::{Ball, Body, Mass};
use crate::problem::Problem;

/// The `k`-th body, from 1.
pub(super) fn read(fields: &Fields<'_>, k: usize, dim: usize) -> Body {
    Body {
        name: super::name(fields, "body", k),
        position: fields.vector("position").unwrap_or_else(|| vec![0.0; dim]),
        ball: ball(fields, dim),
    }
}

/// What a body is, but for name and position.
pub(super) fn ball(fields: &Fields<'_>, dim: usize) -> Ball {
    let (mass, density) = (fields.number("mass"), fields.number("density"));
    let fixed = fields.flag("fixed").unwrap_or(false);
    let radius = fields.number("radius").unwrap_or(1.0);
    if fields.has("mass") && fields.has("density") {
        fields.tell_key("density", "mass and density cannot both be given", "keep one of them");
    } else if !fields.has("mass") && !fields.has("density") && !fixed {
        fields.tell(
            Problem::new(fields.join("mass"), "`mass` is missing: a body that can move needs a mass or a density")
                .help("as in mass = 1.0 (kg); a body that nothing moves has fixed = true"),
        );
    }
    let mass = match (mass, density) {
        (Some(mass), _) => Mass::Mass(mass),
        (None, Some(density)) => Mass::Density(density),
        (None, None) => Mass::Unsaid,
    };
    if let (Mass::Density(density), Some(mass)) = (mass, mass.of(dim, radius))
        && !(mass > 0.0 && mass.is_finite())
    {
        let rule = if mass > 0.0 { "finite" } else { "positive" };
        fields.tell_key(
            "density",
            format!("mass must be {rule}, got {mass} from density {density} and radius {radius}"),
            "give the mass itself",
        );
    }
    Ball {
        mass,
        fixed,
        radius,
        velocity: fields.vector("velocity").unwrap_or_else(|| vec![0.0; dim]),
        spin: fields.spin("spin").unwrap_or_else(|| vec![0.0; spin_length(dim)]),
        material: fields.text("material").unwrap_or("default").to_owned(),
        inertia: fields.number("inertia"),
    }
}
