//! Who is in the picture, and on what stage: what of a scene never changes.
use carom_scene::{Outline, Plan, Point, Scene, Side};

/// A body.
#[derive(Clone, Debug, PartialEq)]
pub struct Actor {
    /// Radius (m).
    pub radius: f64,
    /// Mass (kg); `None` of a fixed body that has none.
    pub mass: Option<f64>,
    /// True if nothing moves it.
    pub fixed: bool,
    /// What is written on it: its name, or its number in its group.
    pub label: String,
    /// The number of its group; bodies given one by one are groups of their own.
    pub group: usize,
}

/// All that never changes.
#[derive(Clone, Debug)]
pub struct Cast {
    /// 1, 2 or 3.
    pub dim: usize,
    /// The title.
    pub title: String,
    /// The bodies, in the order of the plan.
    pub actors: Vec<Actor>,
    /// How many of them have names of their own, and come first.
    pub named: usize,
    /// The names of the groups.
    pub groups: Vec<String>,
    /// Walls and sides of the boundary.
    pub sides: Vec<Side>,
    /// How many of these are walls, and come first.
    pub walls: usize,
    /// Gravity (m/s^2).
    pub gravity: Point,
    /// The corners of the boundary (m), if there is one.
    pub extent: Option<(Point, Point)>,
    /// The axes that close on themselves.
    pub periodic: [bool; 3],
    /// Where the bodies start (m).
    pub start: Vec<Point>,
}

fn padded(x: &[f64]) -> Point {
    std::array::from_fn(|k| x.get(k).copied().unwrap_or(0.0))
}

impl Cast {
    /// The cast of a scene; `name` stands for a title where there is none.
    pub fn new(scene: &Scene, plan: &Plan, name: &str) -> Self {
        let named = scene.bodies.len();
        let mut groups: Vec<String> = Vec::new();
        let actor = |(k, body): (usize, &carom_scene::Placed)| {
            let whole = plan.name(k);
            let (group, label) = match whole.rsplit_once('-') {
                Some((group, number)) if k >= named => (group.to_owned(), number.to_owned()),
                _ => (whole.clone(), whole),
            };
            if groups.last() != Some(&group) || k < named {
                groups.push(group);
            }
            let (radius, mass, fixed) = (body.radius, body.mass, body.fixed);
            Actor { radius, mass, fixed, label, group: groups.len() - 1 }
        };
        let actors = plan.bodies.iter().enumerate().map(actor).collect();
        Self {
            dim: plan.dim,
            title: if scene.title.is_empty() { name.to_owned() } else { scene.title.clone() },
            actors,
            named,
            groups,
            sides: plan.sides.clone(),
            walls: scene.walls.len(),
            gravity: padded(&scene.world.gravity),
            extent: scene.world.extent().map(|(min, max)| (padded(min), padded(max))),
            periodic: std::array::from_fn(|k| k < plan.dim && scene.world.is_periodic(k)),
            start: plan.bodies.iter().map(|b| b.position).collect(),
        }
    }

    /// The bodies that something moves.
    pub fn free(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.actors.len()).filter(|&k| !self.actors[k].fixed)
    }

    /// True if nothing but the bodies acts on the bodies.
    pub fn is_isolated(&self) -> bool {
        self.gravity == [0.0; 3] && self.sides.is_empty() && !self.actors.iter().any(|a| a.fixed)
    }

    /// True if the boundary encloses everything.
    pub fn is_closed(&self) -> bool {
        self.extent.is_some()
    }
}

/// Points of a wall that a picture should show: none of a plane, which has no end.
pub(crate) fn corners(outline: &Outline) -> Vec<Point> {
    match *outline {
        Outline::Segment(a, b) => vec![a, b],
        Outline::Triangle(a, b, c) => vec![a, b, c],
        Outline::Arc { .. } => curve(outline, 24),
        Outline::Plane(..) => Vec::new(),
    }
}

/// Points along an arc.
pub(crate) fn curve(outline: &Outline, steps: usize) -> Vec<Point> {
    let Outline::Arc { centre, radius, from, to } = *outline else { return Vec::new() };
    (0..=steps)
        .map(|k| {
            let angle = from + (to - from) * k as f64 / steps as f64;
            [centre[0] + radius * libm::cos(angle), centre[1] + radius * libm::sin(angle), 0.0]
        })
        .collect()
}
