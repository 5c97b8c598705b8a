//! Carom, through its public interface.
use carom::{Ball, BodyId, Material, Rotates, Vector, Wall, World};

use crate::engine::{Engine, FRAME, Settings, State};
use crate::scene::{self, Scene};

struct Carom<const D: usize>
where
    Vector<D>: Rotates,
{
    world: World<D>,
    balls: Vec<BodyId>,
    /// Frames so far: the clock is set to whole frames, so that no rounding adds up.
    frames: u32,
}

/// The scene as a world.
pub fn make(scene: &Scene, _: Settings) -> Box<dyn Engine> {
    match scene.dim {
        2 => Box::new(build::<2>(scene, sides)),
        _ => Box::new(build::<3>(scene, faces)),
    }
}

fn cut<const D: usize>(v: [f64; 3]) -> Vector<D> {
    Vector::from_fn(|k| v[k])
}

fn build<const D: usize>(scene: &Scene, block: fn([f64; 3], [f64; 3]) -> Vec<Wall<D>>) -> Carom<D>
where
    Vector<D>: Rotates,
{
    let mut world = World::<D>::new().gravity(cut::<D>(scene.gravity));
    world.set_default_material(Material::new().restitution(scene.restitution)).expect("e in [0, 1]");
    for wall in &scene.walls {
        match *wall {
            scene::Wall::Half { axis, at, above } => {
                let normal = Vector::<D>::axis(axis) * if above { -1.0 } else { 1.0 };
                world.wall(Wall::plane(Vector::<D>::axis(axis) * at, normal));
            }
            scene::Wall::Slab { min, max } => {
                block(min, max).into_iter().for_each(|side| {
                    world.wall(side);
                });
            }
        }
    }
    let balls = scene
        .balls
        .iter()
        .map(|b| world.ball(Ball::new(b.mass, b.radius).at(cut::<D>(b.at)).moving(cut::<D>(b.velocity))))
        .collect();
    Carom { world, balls, frames: 0 }
}

/// A rectangle as its sides.
fn sides(min: [f64; 3], max: [f64; 3]) -> Vec<Wall<2>> {
    let corners = [[min[0], min[1]], [max[0], min[1]], [max[0], max[1]], [min[0], max[1]]];
    (0..4).map(|k| Wall::segment(corners[k], corners[(k + 1) % 4])).collect()
}

/// A block as its faces, two triangles each.
fn faces(min: [f64; 3], max: [f64; 3]) -> Vec<Wall<3>> {
    let mut faces = Vec::new();
    for axis in 0..3 {
        let (p, q) = ((axis + 1) % 3, (axis + 2) % 3);
        for at in [min[axis], max[axis]] {
            let corner = |u: f64, v: f64| {
                let mut c = [0.0; 3];
                (c[axis], c[p], c[q]) = (at, u, v);
                c
            };
            let [a, b, c, d] =
                [corner(min[p], min[q]), corner(max[p], min[q]), corner(max[p], max[q]), corner(min[p], max[q])];
            faces.extend([Wall::triangle(a, b, c), Wall::triangle(a, c, d)]);
        }
    }
    faces
}

impl<const D: usize> Engine for Carom<D>
where
    Vector<D>: Rotates,
{
    fn frame(&mut self) {
        self.frames += 1;
        self.world.advance_to(f64::from(self.frames) * FRAME);
    }

    fn balls(&self) -> Vec<State> {
        let long = |v: Vector<D>| core::array::from_fn(|k| if k < D { v[k] } else { 0.0 });
        self.balls
            .iter()
            .map(|&id| State {
                at: long(self.world.position(id).expect("it is there")),
                velocity: long(self.world.velocity(id).expect("it is there")),
            })
            .collect()
    }
}
