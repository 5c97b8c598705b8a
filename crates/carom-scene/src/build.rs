//! From a plan to a world: nothing is decided here any more.
use carom::material::{Law, Pair};
use carom::{Ball, Boundary, Error, Limits, Material, MaterialId, Party, Rotates, Together, Vector, Wall, World};

use crate::geometry::{Outline, Point};
use crate::model::{self, Scene, Surface, Until};
use crate::plan::Plan;

/// The world of a scene and its plan. Bodies, walls and sides of the boundary have the indices that they have in the plan.
///
/// # Errors
/// [`Error::WrongDimension`] if `D` is not the scene's. Whatever else the library refuses, the plan has refused before.
pub fn build<const D: usize>(scene: &Scene, plan: &Plan) -> Result<World<D>, Error>
where
    Vector<D>: Rotates,
{
    if plan.dim != D || scene.world.dim != D {
        return Err(Error::WrongDimension("the world's dimension is not the scene's"));
    }
    let together = match scene.run.together {
        model::Together::Reflect => Together::Reflect,
        model::Together::Sequential => Together::Sequential,
        model::Together::Lcp => Together::Lcp,
    };
    let mut world = World::<D>::new().rest_speed(scene.run.rest_speed).together(together).law(scene.run.law.into());
    world.set_gravity(vector::<D>(&crate::geometry::point(&scene.world.gravity)))?;
    let materials = materials(&mut world, scene)?;
    let material = |k: usize| materials.get(k).copied().unwrap_or_default();
    for side in plan.sides.iter().take(scene.walls.len()) {
        let wall = match &side.outline {
            Outline::Plane(point, normal) => Wall::plane(vector::<D>(point), vector::<D>(normal)),
            Outline::Segment(from, to) => Wall::segment(vector::<D>(from), vector::<D>(to)),
            Outline::Arc { centre, radius, from, to } => Wall::arc(vector::<D>(centre), *radius, *from, *to),
            Outline::Triangle(a, b, c) => Wall::triangle(vector::<D>(a), vector::<D>(b), vector::<D>(c)),
        };
        world.add_wall(wall.moving(vector::<D>(&side.velocity)).material(material(side.material)))?;
    }
    // The boundary after the walls: so it is numbered.
    if let Some((min, max)) = scene.world.extent() {
        let (min, max) = (crate::geometry::point(min), crate::geometry::point(max));
        let mut boundary = Boundary::walls(vector::<D>(&min), vector::<D>(&max));
        for axis in (0..D).filter(|&k| scene.world.is_periodic(k)) {
            boundary = boundary.closed_along(axis);
        }
        if let model::Boundary::Box { material: name, .. } = &scene.world.boundary {
            let k = scene.materials.iter().position(|m| m.name == *name).unwrap_or(0);
            boundary = boundary.material(material(k));
        }
        world.set_boundary(boundary)?;
    }
    world.reserve(plan.bodies.len());
    for body in &plan.bodies {
        let mut ball = match body.mass {
            Some(mass) => Ball { fixed: body.fixed, ..Ball::new(mass, body.radius) },
            None => Ball::fixed(body.radius),
        };
        if let Some(inertia) = body.inertia {
            ball = ball.inertia(inertia);
        }
        let spins = <Vector<D> as Rotates>::SPINS.min(body.spin.len());
        if let Some(spin) = Vector::<D>::spin_from(&body.spin[..spins]) {
            ball.spin = spin;
        }
        let ball = ball.at(vector::<D>(&body.position)).moving(vector::<D>(&body.velocity));
        world.add(ball.material(material(body.material)))?;
    }
    Ok(world)
}

/// The first components of a padded vector.
fn vector<const D: usize>(p: &Point) -> Vector<D> {
    Vector::from_fn(|k| p[k])
}

fn materials<const D: usize>(world: &mut World<D>, scene: &Scene) -> Result<Vec<MaterialId>, Error>
where
    Vector<D>: Rotates,
{
    let says = |s: &Surface| Material {
        restitution: s.restitution.clone(),
        friction: s.friction.clone(),
        tangential: s.tangential,
        rolling: s.rolling,
        spinning: s.spinning,
    };
    let mut ids = Vec::with_capacity(scene.materials.len());
    for (k, surface) in scene.materials.iter().enumerate() {
        ids.push(if k == 0 {
            world.set_default_material(says(surface))?;
            MaterialId::default()
        } else {
            world.material(says(surface))?
        });
    }
    let id = |name: &str| scene.materials.iter().position(|m| m.name == name).and_then(|k| ids.get(k).copied());
    for pair in &scene.pairs {
        let [Some(a), Some(b)] = [id(&pair.materials[0]), id(&pair.materials[1])] else {
            return Err(Error::Stale("material"));
        };
        let says = Material {
            restitution: pair.restitution.clone(),
            friction: pair.friction.clone(),
            tangential: pair.tangential,
            ..Material::default()
        };
        world.pair(a, b, Pair { says, law: pair.law.map(Law::from) })?;
    }
    Ok(ids)
}

impl From<model::Law> for Law {
    fn from(law: model::Law) -> Self {
        match law {
            model::Law::ChatterjeeRuina => Self::ChatterjeeRuina,
            model::Law::Stronge => Self::Stronge,
            model::Law::Newton => Self::Newton,
        }
    }
}

impl Until {
    /// The limits of a run.
    pub fn limits(&self) -> Limits<'static> {
        Limits { time: self.time, impacts: self.impacts, rest: self.rest, interrupt: None }
    }
}

impl Plan {
    /// The name of who took part in an impact: "A", "wall:floor", "boundary:x-".
    pub fn party(&self, party: Party) -> String {
        match party {
            Party::Body(id) => self.name(id.index()),
            Party::Wall(id) => self.sides.get(id.index()).map(|s| s.label.clone()).unwrap_or_default(),
        }
    }
}
