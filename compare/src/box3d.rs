//! Box3D, through its C interface.
use box3d_sys::*;

use crate::engine::{Engine, FRAME, Settings, State};
use crate::scene::Scene;

struct Box3d {
    world: b3WorldId,
    balls: Vec<b3BodyId>,
    steps: u32,
    sub_steps: i32,
}

/// Box3D's own suggestion.
const SUB_STEPS: i32 = 4;

fn vector(v: [f64; 3]) -> b3Vec3 {
    b3Vec3 { x: v[0] as f32, y: v[1] as f32, z: v[2] as f32 }
}

/// The scene as a world.
pub fn make(scene: &Scene, settings: Settings) -> Box<dyn Engine> {
    let best = settings != Settings::Default;
    // SAFETY: definitions come from Box3D's own defaults, pointers to them live for the call, and ids are used while the world
    // that made them exists.
    unsafe {
        let mut definition = b3DefaultWorldDef();
        definition.gravity = vector(scene.gravity);
        definition.enableSleep = false;
        if best {
            definition.restitutionThreshold = 0.0;
        }
        let world = b3CreateWorld(&definition);
        let mut surface = b3DefaultShapeDef();
        surface.baseMaterial.restitution = scene.restitution as f32;
        surface.baseMaterial.friction = 0.0;
        for wall in &scene.walls {
            let (min, max) = wall.block();
            let body = b3CreateBody(world, &b3DefaultBodyDef());
            let half = |k: usize| 0.5 * (max[k] - min[k]) as f32;
            let middle = vector(core::array::from_fn(|k| 0.5 * (min[k] + max[k])));
            let block = b3MakeOffsetBoxHull(half(0), half(1), half(2), middle);
            b3CreateHullShape(body, &surface, &block.base);
        }
        let balls = scene
            .balls
            .iter()
            .map(|ball| {
                let mut definition = b3DefaultBodyDef();
                definition.type_ = b3BodyType_b3_dynamicBody;
                definition.position = vector(ball.at);
                definition.linearVelocity = vector(ball.velocity);
                definition.enableSleep = false;
                definition.isBullet = best && ball.velocity != [0.0; 3];
                let body = b3CreateBody(world, &definition);
                let mut shape = surface;
                let volume = 4.0 / 3.0 * core::f64::consts::PI * ball.radius * ball.radius * ball.radius;
                shape.density = (ball.mass / volume) as f32;
                b3CreateSphereShape(body, &shape, &b3Sphere { center: vector([0.0; 3]), radius: ball.radius as f32 });
                body
            })
            .collect();
        Box::new(Box3d { world, balls, steps: settings.steps(), sub_steps: SUB_STEPS * settings.sub_steps() as i32 })
    }
}

impl Engine for Box3d {
    fn frame(&mut self) {
        for _ in 0..self.steps {
            // SAFETY: the world exists until `drop`.
            unsafe { b3World_Step(self.world, (FRAME / f64::from(self.steps)) as f32, self.sub_steps) };
        }
    }

    fn balls(&self) -> Vec<State> {
        let long = |v: b3Vec3| [f64::from(v.x), f64::from(v.y), f64::from(v.z)];
        self.balls
            .iter()
            // SAFETY: bodies exist as long as their world.
            .map(|&id| unsafe {
                State { at: long(b3Body_GetPosition(id)), velocity: long(b3Body_GetLinearVelocity(id)) }
            })
            .collect()
    }
}

impl Drop for Box3d {
    fn drop(&mut self) {
        // SAFETY: made in `make`, destroyed once.
        unsafe { b3DestroyWorld(self.world) };
    }
}
