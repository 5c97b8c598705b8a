//! A scene's bodies and walls, one by one, in the order of their ids: what a world is made from.
use std::collections::HashMap;

use crate::fields::AXES;
use crate::geometry::{Outline, Point, point};
use crate::group;
use crate::model::{Ball, Boundary, Law, Pair, Scene, Surface};
use crate::pack::{Clash, Packing};
use crate::problem::{MOST_PROBLEMS, Problem};

/// A body, ready to be placed. Vectors are padded with zeros.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Where its centre starts (m).
    pub position: Point,
    /// Velocity (m/s).
    pub velocity: Point,
    /// Angular velocity (rad/s): nothing in 1D, the first number in 2D, all three in 3D.
    pub spin: Point,
    /// Mass (kg); `None` of a fixed body that has none.
    pub mass: Option<f64>,
    /// Radius (m).
    pub radius: f64,
    /// kappa in I = kappa m R^2; `None`: that of a disc or a sphere.
    pub inertia: Option<f64>,
    /// True if nothing moves it.
    pub fixed: bool,
    /// The number of its material in [`Scene::materials`].
    pub material: usize,
}

/// A wall or a side of the boundary, ready to be placed. Vectors are padded with zeros.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    /// As impacts name it: "wall:floor", "boundary:x-".
    pub label: String,
    /// Its shape.
    pub outline: Outline,
    /// Velocity (m/s).
    pub velocity: Point,
    /// The number of its material in [`Scene::materials`].
    pub material: usize,
}

/// All bodies and walls of a scene, checked. That of no scene is empty.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// 1, 2 or 3.
    pub dim: usize,
    /// All `[[body]]`, then all `[[group]]`.
    pub bodies: Vec<Placed>,
    /// All walls, then the boundary: x-, x+, y-, ...
    pub sides: Vec<Side>,
    /// What the surfaces say, the default first.
    pub materials: Vec<Surface>,
    /// The pair table.
    pub pairs: Vec<Pair>,
    /// The law of whatever pair names none.
    pub law: Law,
    /// Names of the bodies given one by one.
    names: Vec<String>,
    /// The first body of each group, and the group's name.
    groups: Vec<(usize, String)>,
}

impl Plan {
    /// The name of the `k`-th body, from 0; empty if there is none.
    pub fn name(&self, k: usize) -> String {
        if let Some(name) = self.names.get(k) {
            return name.clone();
        }
        let group = self.groups.partition_point(|g| g.0 <= k).checked_sub(1).and_then(|g| self.groups.get(g));
        match group {
            Some((first, name)) if k < self.bodies.len() => format!("{name}-{}", k - first + 1),
            _ => String::new(),
        }
    }

    /// The dotted path of what placed the `k`-th body, from 0.
    fn path(&self, k: usize) -> String {
        if k < self.names.len() {
            return format!("body[{}].position", k + 1);
        }
        format!("group[{}]", self.groups.partition_point(|g| g.0 <= k))
    }
}

/// Places every body: groups become bodies, and what overlaps is refused.
pub(crate) fn plan(scene: &Scene) -> Result<Plan, Vec<Problem>> {
    let dim = scene.world.dim;
    let numbers: HashMap<&str, usize> = scene.materials.iter().enumerate().map(|(k, m)| (m.name.as_str(), k)).collect();
    let material = |name: &str| numbers.get(name).copied().unwrap_or(0);
    let mut sides: Vec<Side> = scene
        .walls
        .iter()
        .map(|wall| Side {
            label: format!("wall:{}", wall.name),
            outline: Outline::from(&wall.form),
            velocity: point(&wall.velocity),
            material: material(&wall.material),
        })
        .collect();
    if let Boundary::Box { min, max, material: name, .. } = &scene.world.boundary {
        let material = material(name);
        for axis in (0..dim).filter(|&axis| !scene.world.is_periodic(axis)) {
            for (sign, letter, corner) in [(1.0, '-', min), (-1.0, '+', max)] {
                let mut normal = [0.0; 3];
                normal[axis] = sign;
                sides.push(Side {
                    label: format!("boundary:{}{letter}", AXES[axis]),
                    outline: Outline::Plane(point(corner), normal),
                    velocity: [0.0; 3],
                    material,
                });
            }
        }
    }
    let mut packing = Packing::new(dim, group::wrap(scene), sides.iter().map(|s| s.outline));
    let mut plan = Plan {
        dim,
        bodies: Vec::with_capacity(scene.bodies.len()),
        sides,
        materials: scene.materials.clone(),
        pairs: scene.pairs.clone(),
        law: scene.run.law,
        names: scene.bodies.iter().map(|b| b.name.clone()).collect(),
        groups: Vec::new(),
    };
    let mut problems = Vec::new();
    for body in &scene.bodies {
        plan.bodies.push(placed(&body.ball, dim, point(&body.position), material(&body.ball.material)));
        check(&plan, &mut packing, &mut problems);
    }
    for (k, group) in scene.groups.iter().enumerate() {
        if problems.len() >= MOST_PROBLEMS {
            break;
        }
        plan.groups.push((plan.bodies.len(), group.name.clone()));
        let random = group.kind == crate::model::Arrangement::Random;
        let centres = group::centres(scene, k, &mut packing, scene.run.seed);
        let placed_at = centres.and_then(|centres| {
            let velocities = group::velocities(scene, k, centres.len(), scene.run.seed)?;
            Ok((centres, velocities))
        });
        let (centres, velocities) = match placed_at {
            Ok(both) => both,
            Err(problem) => {
                problems.push(problem);
                return Err(problems);
            }
        };
        let like = placed(&group.body, dim, [0.0; 3], material(&group.body.material));
        let mut clashes = 0;
        for (i, position) in centres.into_iter().enumerate() {
            let velocity = velocities.get(i).or(velocities.first()).copied().unwrap_or_default();
            plan.bodies.push(Placed { position, velocity, ..like });
            if !random {
                let before = problems.len();
                check(&plan, &mut packing, &mut problems);
                clashes += problems.len() - before;
                // One misplaced group is one problem, not ten thousand.
                if clashes >= 3 {
                    return Err(problems);
                }
            }
        }
    }
    if problems.is_empty() { Ok(plan) } else { Err(problems) }
}

fn placed(ball: &Ball, dim: usize, position: Point, material: usize) -> Placed {
    Placed {
        position,
        velocity: point(&ball.velocity),
        spin: point(&ball.spin),
        mass: ball.mass.of(dim, ball.radius),
        radius: ball.radius,
        inertia: ball.inertia,
        fixed: ball.fixed,
        material,
    }
}

/// Checks the last body against everything before it, and adds it to what is in the way.
fn check(plan: &Plan, packing: &mut Packing, problems: &mut Vec<Problem>) {
    let k = plan.bodies.len() - 1;
    let body = &plan.bodies[k];
    let path = plan.path(k);
    if !body.position.iter().all(|x| x.is_finite()) {
        problems.push(
            Problem::new(path, format!("the position of `{}` must be finite", plan.name(k))).help("smaller numbers"),
        );
        return;
    }
    let clash = if problems.len() < MOST_PROBLEMS { packing.clash(body.position, body.radius) } else { None };
    match clash {
        Some(Clash::Body(other, distance)) => {
            let sum = body.radius + plan.bodies[other].radius;
            let message = format!(
                "`{}` overlaps `{}` by {} m: the distance of their centres is {}, the sum of their radii {sum}",
                plan.name(k),
                plan.name(other),
                short(sum - distance),
                short(distance),
            );
            problems.push(Problem::new(path, message).help("move one of them, or make one smaller; touching is fine"));
        }
        Some(Clash::Wall(side, distance)) => {
            let side = &plan.sides[side];
            let depth = short(body.radius - distance);
            let message = if distance < 0.0 {
                format!("`{}` overlaps `{}` by {depth} m: its centre lies behind it", plan.name(k), side.label)
            } else {
                format!(
                    "`{}` overlaps `{}` by {depth} m: its centre lies {} away, and its radius is {}",
                    plan.name(k),
                    side.label,
                    short(distance),
                    body.radius
                )
            };
            let help = match side.outline {
                Outline::Plane(..) => "move it to the side the normal points to, or turn the normal; touching is fine",
                _ => "move it away, or make it smaller; touching is fine",
            };
            problems.push(Problem::new(path, message).help(help));
        }
        None => {}
    }
    packing.insert(body.position, body.radius);
}

/// A length for a message: six digits are enough to act on.
fn short(x: f64) -> String {
    let rounded = crate::number(&format!("{x:.5e}")).unwrap_or(x);
    format!("{rounded:?}")
}
