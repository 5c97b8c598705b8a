//! What an experiment says, in words that every engine understands: balls and walls, one coefficient of restitution, no
//! friction. In the plane the third number of a vector is not used.

/// A ball.
#[derive(Clone, Copy)]
pub struct Ball {
    /// kg.
    pub mass: f64,
    /// m.
    pub radius: f64,
    /// m.
    pub at: [f64; 3],
    /// m/s.
    pub velocity: [f64; 3],
}

/// A wall, along the axes.
#[derive(Clone, Copy)]
pub enum Wall {
    /// All that lies beyond `at` along `axis`: above it or below it.
    Half { axis: usize, at: f64, above: bool },
    /// A block.
    Slab { min: [f64; 3], max: [f64; 3] },
}

/// How far a half-space reaches in engines that have blocks only (m): to the sides, and in depth.
const WIDE: f64 = 200.0;
const DEEP: f64 = 5.0;

impl Wall {
    /// The wall as a block.
    pub fn block(&self) -> ([f64; 3], [f64; 3]) {
        match *self {
            Self::Slab { min, max } => (min, max),
            Self::Half { axis, at, above } => {
                let (mut min, mut max) = ([-WIDE; 3], [WIDE; 3]);
                (min[axis], max[axis]) = if above { (at, at + DEEP) } else { (at - DEEP, at) };
                (min, max)
            }
        }
    }
}

/// A scene.
#[derive(Clone)]
pub struct Scene {
    /// 2 or 3.
    pub dim: usize,
    /// m/s^2.
    pub gravity: [f64; 3],
    /// Of every contact.
    pub restitution: f64,
    pub balls: Vec<Ball>,
    pub walls: Vec<Wall>,
}

impl Scene {
    /// Nothing yet.
    pub fn new(dim: usize, restitution: f64) -> Self {
        Self { dim, gravity: [0.0; 3], restitution, balls: Vec::new(), walls: Vec::new() }
    }

    /// With a ball more.
    pub fn ball(mut self, mass: f64, radius: f64, at: [f64; 3], velocity: [f64; 3]) -> Self {
        self.balls.push(Ball { mass, radius, at, velocity });
        self
    }

    /// With a wall more.
    pub fn wall(mut self, wall: Wall) -> Self {
        self.walls.push(wall);
        self
    }
}
