//! What part of the world is shown, and where on the sheet.
use crate::cast::{Cast, corners};
use crate::look::Look;
use crate::sheet::{At, Window};
use crate::snapshot::Survey;
use carom_scene::{Outline, Point};

/// A range along each axis (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// The least.
    pub low: Point,
    /// The largest.
    pub high: Point,
}

impl Region {
    fn none() -> Self {
        Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] }
    }

    fn include(&mut self, p: Point) {
        for k in 0..3 {
            if p[k].is_finite() {
                self.low[k] = self.low[k].min(p[k]);
                self.high[k] = self.high[k].max(p[k]);
            }
        }
    }

    fn is_empty(&self, dim: usize) -> bool {
        (0..dim).any(|k| !(self.low[k] <= self.high[k]))
    }

    /// Its size along an axis (m).
    pub fn size(&self, k: usize) -> f64 {
        self.high[k] - self.low[k]
    }
}

/// What leaves the stage by more than this part of its size is not followed.
const WINGS: f64 = 0.15;
/// A box of which more than this part stays empty at the top is cut there, where the run was followed so many times.
const EMPTY: f64 = 0.4;
const FOLLOWED: u64 = 10;
/// The least height of a stage, by its width, and the other way round.
const SLIM: f64 = 0.28;

/// What is worth showing: the boundary; else walls and fixed bodies and what is around them; else all that moves.
pub fn region(cast: &Cast, survey: &Survey) -> Region {
    let dim = cast.dim;
    let mut all = Region { low: survey.low, high: survey.high };
    let mut stage = Region::none();
    for side in &cast.sides {
        corners(&side.outline).into_iter().for_each(|p| stage.include(p));
    }
    for (actor, p) in cast.actors.iter().zip(&cast.start).filter(|(a, _)| a.fixed) {
        stage.include(p.map(|x| x - actor.radius));
        stage.include(p.map(|x| x + actor.radius));
    }
    if !stage.is_empty(dim) {
        for (actor, p) in cast.actors.iter().zip(&cast.start) {
            stage.include(p.map(|x| x - actor.radius));
            stage.include(p.map(|x| x + actor.radius));
        }
        let wings = WINGS * (0..dim).map(|k| stage.size(k)).fold(0.0, f64::max);
        for k in 0..dim {
            all.low[k] = all.low[k].max(stage.low[k] - wings).min(stage.low[k]);
            all.high[k] = all.high[k].min(stage.high[k] + wings).max(stage.high[k]);
        }
    }
    if let Some((min, max)) = cast.extent {
        for k in 0..dim {
            // A box may be open along an axis.
            let (low, high) = (min[k], max[k]);
            all.low[k] = if low.is_finite() { low } else { all.low[k] };
            all.high[k] = if high.is_finite() { high } else { all.high[k] };
        }
    }
    // A box in which everything stays low is not shown up to its lid.
    let down = (0..dim).fold(0, |best, k| if cast.gravity[k].abs() > cast.gravity[best].abs() { k } else { best });
    if dim == 2 && cast.gravity[down] != 0.0 && cast.extent.is_some() && survey.seen > FOLLOWED {
        let room = EMPTY * all.size(down);
        let (low, high) = (survey.low[down] - 0.12 * room, survey.high[down] + 0.12 * room);
        if cast.gravity[down] < 0.0 && all.high[down] - high > room && stage.is_empty(dim) {
            all.high[down] = high;
        } else if cast.gravity[down] > 0.0 && low - all.low[down] > room && stage.is_empty(dim) {
            all.low[down] = low;
        }
    }
    // Planes are shown where they pass the stage.
    for side in &cast.sides {
        if let Outline::Plane(p, n) = side.outline {
            let axis = (0..dim).fold(0, |best, k| if n[k].abs() > n[best].abs() { k } else { best });
            let straight = (0..dim).all(|k| k == axis || n[k] == 0.0);
            if straight {
                let lid = side.label.starts_with("boundary:");
                for t in [0.0, survey.end] {
                    let x = p[axis] + side.velocity[axis] * t;
                    if x.is_finite() && !lid {
                        all.low[axis] = all.low[axis].min(x);
                        all.high[axis] = all.high[axis].max(x);
                    }
                }
            }
        }
    }
    for k in 0..3 {
        if k >= dim || !(all.low[k] <= all.high[k]) {
            (all.low[k], all.high[k]) = (0.0, 0.0);
        }
    }
    let widest = (0..dim).map(|k| all.size(k)).fold(0.0, f64::max);
    let widest = if widest > 0.0 { widest } else { 1.0 };
    for k in 0..dim {
        // Room to breathe where nothing ends the stage, and no stage thinner than a ribbon.
        let ends = cast.extent.is_some_and(|(min, max)| all.low[k] == min[k] && all.high[k] == max[k]);
        if !ends {
            let floor = |at: f64| {
                cast.sides.iter().any(|s| matches!(s.outline, Outline::Plane(p, n) if n[k] != 0.0 && p[k] == at))
            };
            let (low, high) = (all.low[k], all.high[k]);
            all.low[k] -= if floor(low) { 0.0 } else { 0.04 * widest };
            all.high[k] += if floor(high) { 0.0 } else { 0.04 * widest };
            let lack = SLIM * widest - all.size(k);
            if lack > 0.0 {
                all.low[k] -= if floor(low) { 0.0 } else { 0.5 * lack };
                all.high[k] += if floor(low) { lack } else { 0.5 * lack };
            }
        }
    }
    all
}

/// Where things stand on the sheet.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// Width and height (pixels).
    pub size: [u32; 2],
    /// What lengths of letters and lines are measured in (pixels).
    pub unit: f64,
    /// Where the world is shown.
    pub stage: Window,
}

/// The usual room of a stage (pixels).
const USUAL: [f64; 2] = [900.0, 580.0];
/// Left, top, right and bottom of the stage (units).
const MARGIN: Window = [30.0, 56.0, 30.0, 66.0];
/// The largest side of a picture (pixels).
pub const MOST_PIXELS: u32 = 16_384;

impl Layout {
    /// The layout of a stage of this shape.
    pub fn new(look: &Look, wide: f64, high: f64) -> Self {
        let (unit, size) = match look.size {
            Some([width, height]) => {
                let (w, h) = (f64::from(width), f64::from(height));
                ((w / 960.0).min(h / 640.0).clamp(0.45, 4.0), [width, height])
            }
            None => {
                let scale = (USUAL[0] / wide).min(USUAL[1] / high);
                let width = (wide * scale).max(500.0) + MARGIN[0] + MARGIN[2];
                let height = (high * scale).max(120.0) + MARGIN[1] + MARGIN[3];
                // Even, as films want it.
                (1.0, [width, height].map(|x| 2 * (x / 2.0).ceil() as u32))
            }
        };
        let [w, h] = size.map(f64::from);
        let [left, top, right, bottom] = MARGIN.map(|m| m * unit);
        let room = [(w - left - right).max(8.0), (h - top - bottom).max(8.0)];
        let scale = (room[0] / wide).min(room[1] / high);
        let (stage_w, stage_h) = (wide * scale, high * scale);
        let x = left + 0.5 * (room[0] - stage_w);
        let y = top + 0.5 * (room[1] - stage_h);
        Self { size, unit, stage: [x, y, x + stage_w, y + stage_h] }
    }

    /// The size of small letters (pixels): never too small to read.
    pub fn small(&self) -> f64 {
        (12.0 * self.unit).max(10.5)
    }
}

/// From the plane to the sheet.
#[derive(Clone, Copy, Debug)]
pub struct Map {
    region: Region,
    stage: Window,
    /// Pixels per metre.
    pub scale: f64,
}

impl Map {
    /// The region on the stage.
    pub fn new(region: Region, stage: Window) -> Self {
        Self { region, stage, scale: (stage[2] - stage[0]) / region.size(0) }
    }

    /// A point's place.
    pub fn at(&self, p: Point) -> At {
        [
            self.stage[0] + (p[0] - self.region.low[0]) * self.scale,
            self.stage[3] - (p[1] - self.region.low[1]) * self.scale,
        ]
    }
}
