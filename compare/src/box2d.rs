//! Box2D, through its C interface.
use boxdd_sys::ffi::*;

use crate::engine::{Engine, FRAME, Settings, State};
use crate::scene::Scene;

struct Box2d {
    world: b2WorldId,
    balls: Vec<b2BodyId>,
    steps: u32,
    sub_steps: i32,
}

/// Box2D's own suggestion.
const SUB_STEPS: i32 = 4;

fn vector(v: [f64; 3]) -> b2Vec2 {
    b2Vec2 { x: v[0] as f32, y: v[1] as f32 }
}

/// The scene as a world.
pub fn make(scene: &Scene, settings: Settings) -> Box<dyn Engine> {
    let best = settings != Settings::Default;
    // SAFETY: definitions come from Box2D's own defaults, pointers to them live for the call, and ids are used while the world
    // that made them exists.
    unsafe {
        let mut definition = b2DefaultWorldDef();
        definition.gravity = vector(scene.gravity);
        definition.enableSleep = false;
        if best {
            definition.restitutionThreshold = 0.0;
        }
        let world = b2CreateWorld(&definition);
        let mut surface = b2DefaultShapeDef();
        surface.material.restitution = scene.restitution as f32;
        surface.material.friction = 0.0;
        for wall in &scene.walls {
            let (min, max) = wall.block();
            let body = b2CreateBody(world, &b2DefaultBodyDef());
            let half = |k: usize| 0.5 * (max[k] - min[k]) as f32;
            let middle = vector(core::array::from_fn(|k| 0.5 * (min[k] + max[k])));
            let block = b2MakeOffsetBox(half(0), half(1), middle, b2Rot { c: 1.0, s: 0.0 });
            b2CreatePolygonShape(body, &surface, &block);
        }
        let balls = scene
            .balls
            .iter()
            .map(|ball| {
                let mut definition = b2DefaultBodyDef();
                definition.type_ = b2BodyType_b2_dynamicBody;
                definition.position = vector(ball.at);
                definition.linearVelocity = vector(ball.velocity);
                definition.enableSleep = false;
                definition.isBullet = best && ball.velocity != [0.0; 3];
                let body = b2CreateBody(world, &definition);
                let mut shape = surface;
                shape.density = (ball.mass / (core::f64::consts::PI * ball.radius * ball.radius)) as f32;
                b2CreateCircleShape(
                    body,
                    &shape,
                    &b2Circle { center: b2Vec2 { x: 0.0, y: 0.0 }, radius: ball.radius as f32 },
                );
                body
            })
            .collect();
        Box::new(Box2d { world, balls, steps: settings.steps(), sub_steps: SUB_STEPS * settings.sub_steps() as i32 })
    }
}

impl Engine for Box2d {
    fn frame(&mut self) {
        for _ in 0..self.steps {
            // SAFETY: the world exists until `drop`.
            unsafe { b2World_Step(self.world, (FRAME / f64::from(self.steps)) as f32, self.sub_steps) };
        }
    }

    fn balls(&self) -> Vec<State> {
        let long = |v: b2Vec2| [f64::from(v.x), f64::from(v.y), 0.0];
        self.balls
            .iter()
            // SAFETY: bodies exist as long as their world.
            .map(|&id| unsafe {
                State { at: long(b2Body_GetPosition(id)), velocity: long(b2Body_GetLinearVelocity(id)) }
            })
            .collect()
    }
}

impl Drop for Box2d {
    fn drop(&mut self) {
        // SAFETY: made in `make`, destroyed once.
        unsafe { b2DestroyWorld(self.world) };
    }
}
