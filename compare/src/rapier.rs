//! Rapier in the plane and in space: two crates with the same names in them, so the code is written once.

macro_rules! rapier {
    ($name:ident, $crate_name:ident, $vector:expr, $cuboid:expr) => {
        /// Rapier in this dimension.
        pub mod $name {
            use $crate_name::prelude::*;

            use crate::engine::{Engine, FRAME, Settings, State};
            use crate::scene::Scene;

            struct Rapier {
                world: PhysicsWorld,
                balls: Vec<RigidBodyHandle>,
                steps: u32,
            }

            /// The scene as a world.
            pub fn make(scene: &Scene, settings: Settings) -> Box<dyn Engine> {
                let vector = $vector;
                let cuboid = $cuboid;
                let best = settings != Settings::Default;
                let steps = settings.steps();
                let mut world = PhysicsWorld { gravity: vector(scene.gravity), ..PhysicsWorld::default() };
                world.integration_parameters.dt = (FRAME / f64::from(steps)) as Real;
                world.integration_parameters.num_solver_iterations *= settings.sub_steps() as usize;
                if best {
                    // More than one impact of a fast ball in a step.
                    world.integration_parameters.max_ccd_substeps = 4;
                }
                let surface = |shape: ColliderBuilder| shape.restitution(scene.restitution as Real).friction(0.0);
                for wall in &scene.walls {
                    let (min, max) = wall.block();
                    let middle = core::array::from_fn(|k| 0.5 * (min[k] + max[k]));
                    let half: [f64; 3] = core::array::from_fn(|k| 0.5 * (max[k] - min[k]));
                    world.insert(RigidBodyBuilder::fixed().translation(vector(middle)), surface(cuboid(half)));
                }
                let balls = scene
                    .balls
                    .iter()
                    .map(|b| {
                        let body = RigidBodyBuilder::dynamic()
                            .translation(vector(b.at))
                            .linvel(vector(b.velocity))
                            .can_sleep(false)
                            .ccd_enabled(best && b.velocity != [0.0; 3]);
                        world.insert(body, surface(ColliderBuilder::ball(b.radius as Real)).mass(b.mass as Real)).0
                    })
                    .collect();
                Box::new(Rapier { world, balls, steps })
            }

            impl Engine for Rapier {
                fn frame(&mut self) {
                    for _ in 0..self.steps {
                        self.world.step();
                    }
                }

                fn balls(&self) -> Vec<State> {
                    let long = |v: Vector| {
                        let numbers: Vec<f64> = v.to_array().iter().map(|&x| f64::from(x)).collect();
                        core::array::from_fn(|k| numbers.get(k).copied().unwrap_or(0.0))
                    };
                    self.balls
                        .iter()
                        .map(|&id| {
                            let body = &self.world.bodies[id];
                            State { at: long(body.translation()), velocity: long(body.linvel()) }
                        })
                        .collect()
                }
            }
        }
    };
}

rapier!(plane, rapier2d, |v: [f64; 3]| Vector::new(v[0] as Real, v[1] as Real), |h: [f64; 3]| ColliderBuilder::cuboid(
    h[0] as Real,
    h[1] as Real
));
rapier!(space, rapier3d, |v: [f64; 3]| Vector::new(v[0] as Real, v[1] as Real, v[2] as Real), |h: [f64; 3]| {
    ColliderBuilder::cuboid(h[0] as Real, h[1] as Real, h[2] as Real)
});
