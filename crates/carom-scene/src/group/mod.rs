//! Many bodies from one line: where they lie, and how they move.
mod lattice;
mod random;
mod velocity;

use crate::geometry::{Point, plus, point, unit};
use crate::grid::Wrap;
use crate::model::{Arrangement, Group, Scene};
use crate::pack::Packing;
use crate::problem::Problem;

pub(crate) use velocity::velocities;

/// The region a group fills.
struct Region {
    min: Point,
    max: Point,
    /// Axes that the region goes round: periodic, and the region is as long as the boundary. There every body is whole,
    /// wherever its centre lies.
    round: [bool; 3],
}

/// The centres of the `k`-th group, from 0. Random ones avoid what `packing` holds.
pub(crate) fn centres(scene: &Scene, k: usize, packing: &mut Packing, seed: u64) -> Result<Vec<Point>, Problem> {
    let group = &scene.groups[k];
    let dim = scene.world.dim;
    let pitch = 2.0 * group.body.radius + group.spacing;
    let origin = point(group.origin.as_deref().unwrap_or_default());
    let along = unit(point(&group.direction));
    match group.kind {
        Arrangement::Line => Ok((0..group.count.unwrap_or(0)).map(|i| plus(origin, i as f64 * pitch, along)).collect()),
        Arrangement::Rack => Ok(rack(group.rows, origin, along, pitch)),
        Arrangement::Random => random::centres(group, k, dim, &region(scene, group)?, packing, seed),
        Arrangement::Square | Arrangement::Hexagonal | Arrangement::Fcc => {
            lattice::centres(group, k, dim, &region(scene, group)?, packing.wrap())
        }
    }
}

/// The region of a group; its rules have been checked.
fn region(scene: &Scene, group: &Group) -> Result<Region, Problem> {
    let (Some(min), Some(max)) = (&group.min, &group.max) else {
        return Err(Problem::new("group", format!("the group `{}` needs a region", group.name)));
    };
    let round = [0, 1, 2].map(|k| {
        k < scene.world.dim
            && scene.world.is_periodic(k)
            && scene.world.extent().is_some_and(|(low, high)| low[k] == min[k] && high[k] == max[k])
    });
    Ok(Region { min: point(min), max: point(max), round })
}

/// The triangle of billiards: row i, from 0, holds i + 1 bodies across the direction it grows to, from its right to its left.
fn rack(rows: usize, apex: Point, along: Point, pitch: f64) -> Vec<Point> {
    let across = [-along[1], along[0], 0.0];
    let step = pitch * (3.0f64.sqrt() / 2.0);
    (0..rows)
        .flat_map(|i| (0..=i).map(move |j| (i as f64, j as f64)))
        .map(|(i, j)| plus(plus(apex, i * step, along), (j - 0.5 * i) * pitch, across))
        .collect()
}

/// The wrap of a scene's boundary.
pub(crate) fn wrap(scene: &Scene) -> Wrap {
    let mut wrap = Wrap::default();
    if let Some((min, max)) = scene.world.extent() {
        for k in (0..scene.world.dim).filter(|&k| scene.world.is_periodic(k)) {
            wrap.axes[k] = Some((min[k], max[k] - min[k]));
        }
    }
    wrap
}

/// The share of the region that the bodies fill.
fn fraction(group: &Group, count: usize, dim: usize, region: &Region) -> f64 {
    let room: f64 = (0..dim).map(|k| region.max[k] - region.min[k]).product();
    let one = crate::model::Mass::Density(1.0).of(dim, group.body.radius).unwrap_or(0.0);
    count as f64 * one / room
}
