//! Random places: one after the other, each wherever it overlaps nothing (random sequential addition).
use super::{Region, fraction};
use crate::geometry::Point;
use crate::model::Group;
use crate::pack::Packing;
use crate::problem::Problem;
use crate::random::{Purpose, Random};

/// Tries for one body. Near the jamming limit one place in thousands is free, and a lattice is the better start.
const TRIES: u64 = 10_000;
/// Tries for all, for each body on the average, and a number that no small group reaches.
const TRIES_EACH: u64 = 300;
const TRIES_MORE: u64 = 1_000_000;

/// Where random sequential addition jams: the share that is filled in the limit, in 1, 2 and 3 dimensions (Renyi 1958;
/// Feder 1980; Cooper 1987).
const JAMMED: [f64; 3] = [0.7476, 0.547, 0.382];

/// The centres of a random group; `packing` holds them afterwards, too.
pub(super) fn centres(
    group: &Group,
    k: usize,
    dim: usize,
    region: &Region,
    packing: &mut Packing,
    seed: u64,
) -> Result<Vec<Point>, Problem> {
    let count = group.count.unwrap_or(0);
    let radius = group.body.radius;
    let (mut low, mut high) = ([0.0; 3], [0.0; 3]);
    for axis in 0..dim {
        let inset = if region.round[axis] { 0.0 } else { radius };
        (low[axis], high[axis]) = (region.min[axis] + inset, region.max[axis] - inset);
        if !(low[axis] <= high[axis]) {
            let name = crate::fields::AXES[axis];
            return Err(Problem::new(
                format!("group[{}].body.radius", k + 1),
                format!("the group `{}` does not fit: the region is narrower than one body along {name}", group.name),
            )
            .help("a larger region or smaller bodies"));
        }
    }
    let fraction = fraction(group, count, dim, region);
    let does_not_fit = |placed: usize| {
        let lattice = ["line", "hexagonal", "fcc"][dim - 1];
        let jammed = JAMMED[dim - 1];
        let help = if fraction > 0.8 * jammed {
            format!(
                "they would fill {fraction:.3} of the region, and random places jam at about {jammed}; a lattice \
                 (kind = \"{lattice}\") fits more"
            )
        } else {
            format!("fewer or smaller bodies, a larger region, or a lattice (kind = \"{lattice}\")")
        };
        Err(Problem::new(
            format!("group[{}].count", k + 1),
            format!("the group `{}` does not fit: {placed} of {count} found a place", group.name),
        )
        .help(help))
    };
    if fraction > 1.0 {
        return does_not_fit(0);
    }
    let mut random = Random::new(seed, k, Purpose::Places);
    let mut all = Vec::with_capacity(count);
    let mut left = TRIES_EACH.saturating_mul(count as u64).saturating_add(TRIES_MORE);
    // A gap between neighbours is room that no other body takes.
    let guarded = radius + 0.5 * group.spacing;
    let mut neighbours = (group.spacing > 0.0).then(|| crate::grid::Grid::new(dim, packing.wrap()));
    while all.len() < count {
        let mut tries = 0;
        let place = loop {
            if tries == TRIES || left == 0 {
                return does_not_fit(all.len());
            }
            (tries, left) = (tries + 1, left - 1);
            let mut p = [0.0; 3];
            for axis in 0..dim {
                let share = random.unit();
                p[axis] = (low[axis] + (high[axis] - low[axis]) * share).clamp(low[axis], high[axis]);
                if region.round[axis] && p[axis] >= high[axis] {
                    p[axis] = low[axis];
                }
            }
            let crowded = neighbours.as_ref().is_some_and(|n| !n.has_room(p, guarded));
            if !crowded && packing.has_room(p, radius) {
                break p;
            }
        };
        if let Some(neighbours) = &mut neighbours {
            neighbours.insert(place, guarded);
        }
        packing.insert(place, radius);
        all.push(place);
    }
    Ok(all)
}
