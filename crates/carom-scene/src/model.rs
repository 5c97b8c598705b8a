//! What a scene file says, as plain values: SI units, vectors of `dim` components, every default filled in.
use carom::Coefficient;

use crate::node::Data;

/// A scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What it is called; may be empty.
    pub title: String,
    /// Dimension, gravity and boundary.
    pub world: Surroundings,
    /// The materials; the first is "default", whether the file names it or not.
    pub materials: Vec<Surface>,
    /// The pair table.
    pub pairs: Vec<Pair>,
    /// The bodies that are given one by one.
    pub bodies: Vec<Body>,
    /// The walls, without the boundary.
    pub walls: Vec<Wall>,
    /// The groups.
    pub groups: Vec<Group>,
    /// When it ends, and by which rules.
    pub run: Run,
    /// What to write.
    pub outputs: Vec<Output>,
    /// What a sweep varies, in the order of the file.
    pub sweep: Vec<Sweep>,
}

/// `[world]`
#[derive(Clone, Debug, PartialEq)]
pub struct Surroundings {
    /// 1, 2 or 3.
    pub dim: usize,
    /// Acceleration (m/s^2).
    pub gravity: Vec<f64>,
    /// What lies around.
    pub boundary: Boundary,
}

impl Surroundings {
    /// The corners of a box or a periodic cell.
    pub fn extent(&self) -> Option<(&[f64], &[f64])> {
        match &self.boundary {
            Boundary::Open => None,
            Boundary::Box { min, max, .. } | Boundary::Periodic { min, max } => Some((min, max)),
        }
    }

    /// True if this axis goes round.
    pub fn is_periodic(&self, axis: usize) -> bool {
        match &self.boundary {
            Boundary::Open => false,
            Boundary::Box { periodic, .. } => periodic.contains(&axis),
            Boundary::Periodic { .. } => true,
        }
    }
}

/// `world.boundary`
#[derive(Clone, Debug, PartialEq)]
pub enum Boundary {
    /// Nothing.
    Open,
    /// Walls at min and max.
    Box {
        /// The lower corner (m).
        min: Vec<f64>,
        /// The upper corner (m).
        max: Vec<f64>,
        /// The material of the walls.
        material: String,
        /// The axes that go round instead.
        periodic: Vec<usize>,
    },
    /// Every axis goes round.
    Periodic {
        /// The lower corner (m).
        min: Vec<f64>,
        /// The upper corner (m).
        max: Vec<f64>,
    },
}

/// `[material.name]`; `None` is unsaid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Its name.
    pub name: String,
    /// e, by approach speed.
    pub restitution: Option<Coefficient>,
    /// mu, by slip speed.
    pub friction: Option<Coefficient>,
    /// e_t.
    pub tangential: Option<f64>,
    /// Rolling resistance.
    pub rolling: Option<f64>,
    /// Spinning friction.
    pub spinning: Option<f64>,
}

/// `[[pair]]`; `None` is unsaid.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The two materials.
    pub materials: [String; 2],
    /// e, by approach speed.
    pub restitution: Option<Coefficient>,
    /// mu, by slip speed.
    pub friction: Option<Coefficient>,
    /// e_t.
    pub tangential: Option<f64>,
    /// The law of one contact.
    pub law: Option<Law>,
}

/// What a body or the bodies of a group are, but for name and place.
#[derive(Clone, Debug, PartialEq)]
pub struct Ball {
    /// How heavy.
    pub mass: Mass,
    /// True if nothing moves it.
    pub fixed: bool,
    /// Radius (m).
    pub radius: f64,
    /// Velocity (m/s).
    pub velocity: Vec<f64>,
    /// Angular velocity (rad/s): 0, 1 or 3 numbers.
    pub spin: Vec<f64>,
    /// The name of its material.
    pub material: String,
    /// kappa in I = kappa m R^2; `None`: that of a disc or a sphere.
    pub inertia: Option<f64>,
}

/// How heavy a body is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mass {
    /// kg
    Mass(f64),
    /// kg per length, area or volume
    Density(f64),
    /// Only of a fixed body.
    Unsaid,
}

impl Mass {
    /// The mass (kg) of a ball of this radius (m); `None` if unsaid.
    pub fn of(self, dim: usize, radius: f64) -> Option<f64> {
        use std::f64::consts::PI;
        match self {
            Self::Mass(mass) => Some(mass),
            Self::Density(density) => Some(
                density
                    * match dim {
                        1 => 2.0 * radius,
                        2 => PI * radius * radius,
                        _ => 4.0 / 3.0 * PI * radius * radius * radius,
                    },
            ),
            Self::Unsaid => None,
        }
    }
}

/// `[[body]]`
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its name; no other body has it.
    pub name: String,
    /// Where its centre starts (m).
    pub position: Vec<f64>,
    /// What it is.
    pub ball: Ball,
}

/// `[[wall]]`
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Its name; no other wall has it.
    pub name: String,
    /// Its shape.
    pub form: Form,
    /// Velocity (m/s), of a driven wall.
    pub velocity: Vec<f64>,
    /// The name of its material.
    pub material: String,
}

/// The shape of a wall.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// A half-space.
    Plane {
        /// A point of it (m).
        point: Vec<f64>,
        /// Towards the balls; any length but 0.
        normal: Vec<f64>,
    },
    /// A thin segment of the plane.
    Segment {
        /// One end (m).
        from: Vec<f64>,
        /// The other end (m).
        to: Vec<f64>,
    },
    /// A thin arc of the plane, counter-clockwise.
    Arc {
        /// The centre (m).
        centre: Vec<f64>,
        /// The radius (m).
        radius: f64,
        /// Where it starts (degrees).
        from: f64,
        /// Where it ends (degrees).
        to: f64,
    },
    /// A thin triangle of space: its corners (m).
    Triangle([Vec<f64>; 3]),
}

/// `[[group]]`
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The bodies are name-1, name-2, ...
    pub name: String,
    /// How they are placed.
    pub kind: Arrangement,
    /// How many; `None`: of a rack, what the rows hold; of a lattice, what the region holds.
    pub count: Option<usize>,
    /// The lower corner of the region (m), if there is one.
    pub min: Option<Vec<f64>>,
    /// The upper corner of the region (m), if there is one.
    pub max: Option<Vec<f64>>,
    /// The gap between neighbours (m).
    pub spacing: f64,
    /// The centre of the first body (m); `None` only where no region gives one.
    pub origin: Option<Vec<f64>>,
    /// Where line and rack grow to; any length but 0.
    pub direction: Vec<f64>,
    /// The rows of a rack.
    pub rows: usize,
    /// What each of them is.
    pub body: Ball,
    /// How they move; `None`: as `body` says.
    pub velocity: Option<Distribution>,
}

/// How a group is placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    /// Anywhere in the region.
    Random,
    /// Rows and columns, in 3D layers.
    Square,
    /// Rows shifted by half a pitch (2D).
    Hexagonal,
    /// Face-centred cubic (3D).
    Fcc,
    /// One after the other.
    Line,
    /// The triangle of billiards (2D).
    Rack,
}

/// The velocities of a group.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// A temperature.
    Maxwell {
        /// <m v^2> / dim (J).
        temperature: f64,
        /// Whether the momenta add to zero.
        zero_momentum: bool,
    },
    /// All the same (m/s).
    Fixed(Vec<f64>),
    /// All the same speed (m/s), directions spread evenly.
    Uniform(f64),
}

/// `[run]`
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// What ends it.
    pub until: Until,
    /// Where random numbers start.
    pub seed: u64,
    /// Contacts at one instant.
    pub together: Together,
    /// The law of one contact.
    pub law: Law,
    /// m/s; 0 turns rest off.
    pub rest_speed: f64,
}

/// `run.until`: the first that holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Until {
    /// s
    pub time: Option<f64>,
    /// This many, or more if an instant has more.
    pub impacts: Option<u64>,
    /// Every body rests or is fixed.
    pub rest: bool,
}

/// Contacts at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Together {
    /// Generalised reflections (GR-e).
    #[default]
    Reflect,
    /// One after the other.
    Sequential,
    /// A linear complementarity problem.
    Lcp,
}

/// The law of one contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Law {
    /// Chatterjee and Ruina.
    #[default]
    ChatterjeeRuina,
    /// Stronge.
    Stronge,
    /// Newton.
    Newton,
}

/// Names of an enumeration's values, as they stand in a file.
macro_rules! names {
    ($type:ty { $($value:ident = $name:literal),* $(,)? }) => {
        impl $type {
            /// The name in a scene file.
            pub fn name(self) -> &'static str {
                match self { $(Self::$value => $name),* }
            }

            /// The value of this name.
            pub fn named(name: &str) -> Option<Self> {
                match name { $($name => Some(Self::$value),)* _ => None }
            }
        }
    };
}
names!(Together { Reflect = "reflect", Sequential = "sequential", Lcp = "lcp" });
names!(Law { ChatterjeeRuina = "chatterjee-ruina", Stronge = "stronge", Newton = "newton" });
names!(Arrangement {
    Random = "random",
    Square = "square",
    Hexagonal = "hexagonal",
    Fcc = "fcc",
    Line = "line",
    Rack = "rack",
});

/// `[[output]]`
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// The file.
    pub path: String,
    /// The time between two frames or samples (s).
    pub every: Option<f64>,
}

impl Output {
    /// The extension that picks the format, in small letters and without the dot.
    pub fn extension(&self) -> String {
        let file = self.path.rsplit(['/', '\\']).next().unwrap_or_default();
        match file.rsplit_once('.') {
            Some((stem, extension)) if !stem.is_empty() => extension.to_ascii_lowercase(),
            _ => String::new(),
        }
    }
}

/// One line of `[sweep]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The dotted path of the key it varies.
    pub path: String,
    /// The values it takes.
    pub values: Values,
}

/// The values of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// These.
    List(Vec<Data>),
    /// Every integer from the first to the second.
    Range(i64, i64),
    /// This many numbers at equal steps, from the first to the second.
    Steps(f64, f64, usize),
}

impl Values {
    /// How many.
    pub fn len(&self) -> usize {
        match self {
            Self::List(values) => values.len(),
            Self::Range(from, to) => usize::try_from(i128::from(*to) - i128::from(*from) + 1).unwrap_or(0),
            Self::Steps(_, _, steps) => *steps,
        }
    }

    /// True if there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The k-th value, from 0.
    pub fn get(&self, k: usize) -> Option<Data> {
        if k >= self.len() {
            return None;
        }
        Some(match self {
            Self::List(values) => values.get(k)?.clone(),
            Self::Range(from, _) => Data::Integer(i128::from(*from) + k as i128),
            // The ends are met exactly.
            Self::Steps(from, _, _) if k == 0 => Data::Number(*from),
            Self::Steps(_, to, steps) if k + 1 == *steps => Data::Number(*to),
            Self::Steps(from, to, steps) => {
                // One division at the end: tenths come out as the tenths that one would write.
                Data::Number(from + (to - from) * k as f64 / (steps - 1) as f64)
            }
        })
    }
}
