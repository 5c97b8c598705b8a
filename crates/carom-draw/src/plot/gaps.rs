//! The nearest two surfaces of a world.
use crate::cast::Cast;
use crate::snapshot::{Snapshot, norm};
use carom_scene::Point;

/// The smallest gaps at a time (m); infinite where there is nothing to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaps {
    /// Between two bodies of which at least one is free.
    pub bodies: f64,
    /// Between a free body and a wall.
    pub walls: f64,
}

/// The smallest gaps. Sorted along the first axis, a body is compared with those that could be nearer than the nearest so far.
pub fn nearest(snapshot: &Snapshot, cast: &Cast) -> Gaps {
    let width = |k: usize| match cast.extent {
        Some((min, max)) if cast.periodic[k] => max[k] - min[k],
        _ => f64::INFINITY,
    };
    let widths: Point = std::array::from_fn(width);
    let mut order: Vec<usize> = (0..snapshot.moments.len().min(cast.actors.len())).collect();
    let x = |k: usize| snapshot.moments[k].position[0];
    order.sort_by(|a, b| x(*a).total_cmp(&x(*b)));
    let largest = cast.actors.iter().map(|a| a.radius).fold(0.0, f64::max);
    let mut bodies = f64::INFINITY;
    for (n, &i) in order.iter().enumerate() {
        // Once round, where the first axis closes on itself.
        let rounds = if widths[0].is_finite() { order.len() - 1 } else { order.len() - 1 - n };
        for step in 1..=rounds {
            let m = n + step;
            let (j, round) = (order[m % order.len()], if m >= order.len() { widths[0] } else { 0.0 });
            let ahead = x(j) + round - x(i);
            if !(ahead - cast.actors[i].radius - largest < bodies) {
                break;
            }
            if cast.actors[i].fixed && cast.actors[j].fixed {
                continue;
            }
            let apart: Point = std::array::from_fn(|k| {
                let d = (snapshot.moments[j].position[k] - snapshot.moments[i].position[k]).abs();
                if widths[k].is_finite() { d.min((widths[k] - d).abs()) } else { d }
            });
            bodies = bodies.min(norm(apart) - cast.actors[i].radius - cast.actors[j].radius);
        }
    }
    let mut walls = f64::INFINITY;
    for side in &cast.sides {
        let by = side.velocity.map(|v| v * snapshot.time);
        for k in cast.free() {
            let Some(moment) = snapshot.moments.get(k) else { continue };
            let place: Point = std::array::from_fn(|i| moment.position[i] - by[i]);
            walls = walls.min(side.outline.distance(place) - cast.actors[k].radius);
        }
    }
    Gaps { bodies, walls }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::snapshot::{Energy, Moment};
    use carom_scene::Document;

    #[test]
    fn the_nearest_pair_is_found_also_round_the_box() {
        // Bodies at 0.1, 0.5, 0.97 and 0.7 of radius 0.02 in a periodic square: 0.1 and 0.97 are 0.13 apart round the side.
        let body = |x: f64, y: f64| format!("[[body]]\nmass = 1\nradius = 0.02\nposition = [{x}, {y}]\n");
        let text = format!(
            "carom = 1\n[world]\ndim = 2\nboundary = {{ kind = \"periodic\", min = [0, 0], max = [1, 1] }}\n{}{}{}{}[run]\nuntil = {{ time = 1.0 }}\n",
            body(0.1, 0.5),
            body(0.5, 0.5),
            body(0.97, 0.5),
            body(0.7, 0.2)
        );
        let document = Document::parse("gaps", &text).unwrap();
        let scene = document.scene().unwrap();
        let plan = document.plan(&scene).unwrap();
        let cast = Cast::new(&scene, &plan, "gaps");
        let moments = plan.bodies.iter().map(|b| Moment { position: b.position, velocity: [0.0; 3] }).collect();
        let gaps = nearest(&Snapshot { time: 0.0, moments, energy: Energy::default() }, &cast);
        assert!((gaps.bodies - (0.13 - 0.04)).abs() < 1e-12, "{gaps:?}");
        assert_eq!(gaps.walls, f64::INFINITY);
    }
}
