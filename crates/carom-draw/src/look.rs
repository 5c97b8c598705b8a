//! What a picture shows, as its maker wants it.
use crate::theme::Paper;

/// What the colour of a body says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tint {
    /// Who it is.
    Name,
    /// Which group it belongs to.
    Group,
    /// How fast it is.
    Speed,
    /// How much kinetic energy it has.
    Energy,
}

/// Which arrows are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Arrows {
    /// Velocities, from the centres.
    pub velocity: bool,
    /// Momenta, from the centres.
    pub momentum: bool,
    /// Impulses on both, from the point of contact, for a moment after the impact.
    pub impulse: bool,
}

/// What a picture shows.
#[derive(Clone, Debug)]
pub struct Look {
    /// Light or dark.
    pub paper: Paper,
    /// What colours say; `None`: names of few, groups of several, speeds of many.
    pub tint: Option<Tint>,
    /// Arrows.
    pub arrows: Arrows,
    /// Paths: all of it in a still, the last of it in a film.
    pub trails: bool,
    /// One still that shows the motion.
    pub strobe: bool,
    /// The centre of mass; `None`: of a few bodies that nothing else acts on.
    pub centre: Option<bool>,
    /// Width and height (pixels); `None`: as the stage wants it.
    pub size: Option<[u32; 2]>,
    /// True of a film.
    pub film: bool,
    /// Seconds of the scene in a second of the film.
    pub pace: f64,
    /// Seconds of the scene between two frames; of a still, what a clock need not tell apart.
    pub step: f64,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            paper: Paper::Light,
            tint: None,
            arrows: Arrows::default(),
            trails: false,
            strobe: false,
            centre: None,
            size: None,
            film: false,
            pace: 1.0,
            step: 0.001,
        }
    }
}

/// How long an impact is seen (s of the film).
const FLASH: f64 = 0.36;
/// How long a path is seen in a film (s of the film).
const TAIL: f64 = 0.8;

impl Look {
    /// How long an impact is seen (s of the scene).
    pub fn flash(&self) -> f64 {
        FLASH * self.pace
    }

    /// How long paths are remembered (s of the scene).
    pub fn memory(&self) -> f64 {
        match (self.trails || self.strobe, self.film) {
            (false, _) => 0.0,
            (true, true) => TAIL * self.pace,
            (true, false) => f64::INFINITY,
        }
    }
}
