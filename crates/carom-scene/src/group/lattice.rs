//! Lattices: from the origin along x, then y, then z, as far as a whole body fits.
use super::{Region, fraction};
use crate::geometry::Point;
use crate::grid::{DEEPEST_OVERLAP, Grid, Wrap};
use crate::keys::MOST_BODIES;
use crate::model::{Arrangement, Group};
use crate::problem::Problem;

/// The steps of a lattice: the unit along each axis, which odd rows start half a step later, and which sites are empty.
struct Steps {
    step: Point,
    /// Odd rows are shifted by half a step.
    staggered: bool,
    /// Only sites whose numbers add to an even one hold a body.
    even: bool,
}

fn steps(kind: Arrangement, pitch: f64) -> Steps {
    match kind {
        Arrangement::Hexagonal => {
            Steps { step: [pitch, pitch * (3.0f64.sqrt() / 2.0), pitch], staggered: true, even: false }
        }
        // The face-centred cube has the edge pitch sqrt(2); its sites are every other point of half that edge.
        Arrangement::Fcc => Steps { step: [pitch * 0.5f64.sqrt(); 3], staggered: false, even: true },
        _ => Steps { step: [pitch; 3], staggered: false, even: false },
    }
}

/// The centres of a group on a lattice.
pub(super) fn centres(group: &Group, k: usize, dim: usize, region: &Region, wrap: Wrap) -> Result<Vec<Point>, Problem> {
    let path = |key: &str| format!("group[{}].{key}", k + 1);
    let radius = group.body.radius;
    let lattice = steps(group.kind, 2.0 * radius + group.spacing);
    let origin = crate::geometry::point(group.origin.as_deref().unwrap_or_default());
    let allowed = DEEPEST_OVERLAP * radius;
    for axis in 0..dim {
        let (low, high) = (region.min[axis] + radius, region.max[axis] - radius);
        let inside = origin[axis] >= low - allowed && origin[axis] <= high + allowed;
        if !inside && !region.round[axis] {
            let name = crate::fields::AXES[axis];
            if high - low < -allowed {
                let message = format!(
                    "the group `{}` does not fit: the region is narrower than one body along {name}",
                    group.name
                );
                return Err(Problem::new(path("max"), message).help("a larger region or smaller bodies"));
            }
            let message = format!(
                "the group `{}` does not fit: its first body at {name} = {} reaches out of the region",
                group.name, origin[axis]
            );
            return Err(Problem::new(path("origin"), message)
                .help(format!("centres lie in [min + r, max - r], along {name} in [{low}, {high}]")));
        }
    }
    // How many steps fit along an axis, from a start that is shifted.
    let sites = |axis: usize, shift: f64| -> u64 {
        let room = if region.round[axis] {
            // Up to one whole turn; the first one is met again there.
            region.max[axis] - region.min[axis] - 2.0 * allowed
        } else {
            region.max[axis] - radius + allowed - origin[axis] - shift
        };
        if room < 0.0 { 0 } else { ((room / lattice.step[axis]).floor() + 1.0).min(MOST_BODIES as f64 + 1.0) as u64 }
    };
    let too_many = || {
        let message = format!("the group `{}` would have more than {MOST_BODIES} bodies", group.name);
        Err(Problem::new(path("kind"), message).help("give a count"))
    };
    let all_sites: f64 = (0..dim).map(|axis| sites(axis, 0.0) as f64).product();
    // Half of them may be empty, and half as many go round without room.
    if group.count.is_none() && all_sites > 4.0 * MOST_BODIES as f64 {
        return too_many();
    }
    let most = group.count.unwrap_or(MOST_BODIES as usize + 1);
    // Where the region goes round, a body must also leave room to the images of those before it.
    let mut images = region.round.iter().any(|r| *r).then(|| Grid::new(dim, wrap));
    let mut all = Vec::new();
    let rows = |axis| if axis < dim { sites(axis, 0.0) } else { 1 };
    'filled: for z in 0..rows(2) {
        for y in 0..rows(1) {
            let shift = if lattice.staggered && y % 2 == 1 { 0.5 * lattice.step[0] } else { 0.0 };
            for x in 0..sites(0, shift) {
                if all.len() >= most {
                    break 'filled;
                }
                if lattice.even && (x + y + z) % 2 == 1 {
                    continue;
                }
                let mut p = [
                    origin[0] + x as f64 * lattice.step[0] + shift,
                    origin[1] + y as f64 * lattice.step[1],
                    origin[2] + z as f64 * lattice.step[2],
                ];
                p[dim..].fill(0.0);
                if let Some(images) = &mut images {
                    if !images.has_room(p, radius) {
                        continue;
                    }
                    images.insert(p, radius);
                    p = wrap.in_cell(p);
                }
                all.push(p);
            }
        }
    }
    let kind = group.kind.name();
    match group.count {
        Some(count) if all.len() < count => {
            let fraction = fraction(group, count, dim, region);
            Err(Problem::new(
                path("count"),
                format!("the group `{}` does not fit: {} of {count} fit (\"{kind}\")", group.name, all.len()),
            )
            .help(format!(
                "count = {} or less, a larger region, smaller bodies or less spacing; {count} would fill {fraction:.3} of the \
                 region",
                all.len()
            )))
        }
        None if all.len() as u64 > MOST_BODIES => too_many(),
        _ => Ok(all),
    }
}
