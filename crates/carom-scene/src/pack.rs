//! What is in the way: the bodies so far, the walls and the boundary.
use crate::geometry::{Outline, Point};
use crate::grid::{DEEPEST_OVERLAP, Grid, Wrap};

/// What a body overlaps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Clash {
    /// The body of this number, at this distance of the centres.
    Body(usize, f64),
    /// The wall of this number, at this distance of the centre, negative behind a plane.
    Wall(usize, f64),
}

/// Bodies and walls that can be asked whether there is room.
pub(crate) struct Packing {
    wrap: Wrap,
    grid: Grid,
    walls: Vec<(Outline, Option<(Point, Point)>)>,
}

impl Packing {
    pub fn new(dim: usize, wrap: Wrap, walls: impl Iterator<Item = Outline>) -> Self {
        Self { wrap, grid: Grid::new(dim, wrap), walls: walls.map(|w| (w, w.extent())).collect() }
    }

    pub fn wrap(&self) -> Wrap {
        self.wrap
    }

    /// Adds a body; they are numbered from 0.
    pub fn insert(&mut self, centre: Point, radius: f64) {
        self.grid.insert(centre, radius);
    }

    /// What a body here would overlap: a wall, else the first body.
    pub fn clash(&self, centre: Point, radius: f64) -> Option<Clash> {
        let body = || self.grid.overlap(centre, radius).map(|(k, distance)| Clash::Body(k, distance));
        self.wall(centre, radius).or_else(body)
    }

    /// True if a body here would overlap nothing.
    pub fn has_room(&self, centre: Point, radius: f64) -> bool {
        self.grid.has_room(centre, radius) && self.wall(centre, radius).is_none()
    }

    /// The first wall that a body here would overlap.
    fn wall(&self, centre: Point, radius: f64) -> Option<Clash> {
        let mut found = None;
        self.wrap.images(centre, radius, |p| {
            if found.is_some() {
                return;
            }
            for (k, (wall, extent)) in self.walls.iter().enumerate() {
                // A box around the wall spares most distances.
                let far =
                    extent.is_some_and(|(low, high)| (0..3).any(|k| low[k] - p[k] > radius || p[k] - high[k] > radius));
                if far {
                    continue;
                }
                let distance = wall.distance(p);
                if radius - distance > DEEPEST_OVERLAP * radius {
                    found = Some(Clash::Wall(k, distance));
                    return;
                }
            }
        });
        found
    }
}
