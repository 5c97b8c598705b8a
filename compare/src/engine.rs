//! What an experiment asks of an engine, and the engines there are.
use crate::scene::Scene;

/// The frame of a game: one call of [`Engine::frame`] moves the world on by this much (s).
pub const FRAME: f64 = 1.0 / 60.0;

/// A ball, seen between two frames.
#[derive(Clone, Copy, Debug)]
pub struct State {
    /// m.
    pub at: [f64; 3],
    /// m/s.
    pub velocity: [f64; 3],
}

/// A world in one engine.
pub trait Engine {
    /// Goes on by [`FRAME`].
    fn frame(&mut self);
    /// The balls, in the order of the scene.
    fn balls(&self) -> Vec<State>;
}

/// How an engine is set.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Settings {
    /// As it comes, at 60 steps a second; sleeping off, no damping, no friction.
    Default,
    /// Four steps a frame, no threshold below which bounces are swallowed, continuous detection for the balls that move at the start.
    Steps,
    /// The same, but one step a frame with four times the sub-steps inside it.
    SubSteps,
}

impl Settings {
    /// Steps a frame.
    pub fn steps(self) -> u32 {
        if self == Self::Steps { 4 } else { 1 }
    }

    /// By how much the sub-steps of a step are more than the engine's own number.
    pub fn sub_steps(self) -> u32 {
        if self == Self::SubSteps { 4 } else { 1 }
    }
}

/// An engine that can be asked.
pub struct Kind {
    pub name: &'static str,
    pub version: &'static str,
    /// The dimensions it knows.
    pub dims: &'static [usize],
    /// What it is made for.
    pub made_for: &'static str,
    /// Its settings, and what they are called.
    pub settings: &'static [(Settings, &'static str)],
    pub make: fn(&Scene, Settings) -> Box<dyn Engine>,
}

const GAMES: &str = "games: many bodies of any shape, joints and stacks in a fixed time a frame";

const RAPIER: &[(Settings, &str)] = &[
    (Settings::Default, "default"),
    (Settings::Steps, "240 Hz, CCD"),
    (Settings::SubSteps, "60 Hz, 16 sub-steps, CCD"),
];
const BOX: &[(Settings, &str)] = &[
    (Settings::Default, "default"),
    (Settings::Steps, "240 Hz, threshold 0, bullets"),
    (Settings::SubSteps, "60 Hz, 16 sub-steps, threshold 0, bullets"),
];

/// All engines.
pub const ENGINES: &[Kind] = &[
    Kind {
        name: "Carom",
        version: env!("CARGO_PKG_VERSION"),
        dims: &[2, 3],
        made_for: "impacts: balls and walls, every impact at its own time, with books that close",
        settings: &[(Settings::Default, "default (f64, no time step)")],
        make: crate::carom_world::make,
    },
    Kind {
        name: "Rapier 2D",
        version: "0.36.1",
        dims: &[2],
        made_for: GAMES,
        settings: RAPIER,
        make: crate::rapier::plane::make,
    },
    Kind {
        name: "Box2D",
        version: "3.2.0 (boxdd-sys 0.6.0)",
        dims: &[2],
        made_for: GAMES,
        settings: BOX,
        make: crate::box2d::make,
    },
    Kind {
        name: "Rapier 3D",
        version: "0.36.1",
        dims: &[3],
        made_for: GAMES,
        settings: RAPIER,
        make: crate::rapier::space::make,
    },
    Kind {
        name: "Box3D",
        version: "0.1.0 (box3d-sys 0.1.16)",
        dims: &[3],
        made_for: GAMES,
        settings: BOX,
        make: crate::box3d::make,
    },
];
