//! Cells, queue and predictions, made anew from the records: a prediction is a pure function of them, so that this changes nothing of
//! what happens.
use super::calendar::Entry;
use super::cells::{self, Cells, Needs, Space};
use super::edges::Spread;
use super::machine::in_large_pages;
use super::rounds::is_beyond;
use super::store::WallRecord;
use super::{ISLAND, SLICE_END, World};
use crate::ledger::Magnitudes;
use crate::{Rotates, Vector};

/// Cells a body, where bodies move uniformly: a look at fewer bodies and more empty cells is worth more crossings.
const FINE: f64 = 3.0;

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// The smallest box around the bodies as they are now (the whole width of a periodic axis), for the cells to divide: a heap on
    /// the floor of a high box needs small ones.
    pub(super) fn space(&self) -> Space<D> {
        let (mut low, mut high) = (Vector::from_fn(|_| f64::INFINITY), Vector::from_fn(|_| f64::NEG_INFINITY));
        for i in self.store.bodies.living() {
            let (x, _) = self.store.at(i, self.time);
            for k in 0..D {
                low[k] = if x[k] < low[k] { x[k] } else { low[k] };
                high[k] = if x[k] > high[k] { x[k] } else { high[k] };
            }
        }
        for k in 0..D {
            let boundary = &self.store.boundary;
            if self.store.periodic[k] {
                (low[k], high[k]) = (boundary.min[k], boundary.max[k]);
            }
            if !(low[k] < high[k]) || !(high[k] - low[k]).is_finite() {
                let middle = if low[k].is_finite() { low[k] } else { 0.0 };
                (low[k], high[k]) = (middle, middle + 1.0);
            }
        }
        Space { low, high, periodic: self.store.periodic }
    }

    /// The largest radius (m) of the bodies that there are.
    pub(super) fn largest_radius(&mut self) -> f64 {
        let bodies = &self.store.bodies;
        *self.largest.get_or_insert_with(|| bodies.living().map(|i| bodies.record[i].radius).fold(0.0, f64::max))
    }

    /// Multiplies the width of the cells. Results do not depend on it; the tests show that.
    #[doc(hidden)]
    pub fn set_cell_scale(&mut self, scale: f64) {
        self.cell_scale = scale;
        self.ready = false;
    }

    /// Makes cells, queue and predictions anew from the records. A prediction is a pure function of the records, so that this
    /// changes nothing of what happens.
    pub(super) fn prepare(&mut self) {
        if self.books.start.is_none() {
            let (totals, _) = self.totals();
            self.books.start = Some(totals);
            let mut now = Magnitudes::default();
            for i in self.store.bodies.living() {
                now.add(&self.magnitudes(i), 1.0);
            }
            self.books.now = now;
            self.books.largest.raise(&now);
        }
        self.fit();
        in_large_pages(&self.store.bodies.record, true);
        in_large_pages(&self.store.bodies.matter, true);
        in_large_pages(&self.due, true);
        let count = self.store.bodies.living().count();
        let reach = self.largest_radius();
        let space = self.space();
        let slack = if self.store.weightless { cells::SLACK } else { cells::SLICE_SLACK };
        self.choose_broad_phase(&space, count, reach, slack);
        for i in 0..self.store.bodies.len() {
            if self.store.bodies.alive[i] {
                let (x, _) = self.store.at(i, self.time);
                let turns = self.store.turns(x);
                let x = self.store.wrapped(x, turns);
                self.broken |= is_beyond(&turns);
                self.cells.insert(i as u32, x, turns);
            }
        }
        self.crowding = self.cells.crowding();
        if self.lists.on {
            self.make_lists();
        }
        // A guess at the time between two events of a body; the calendar finds its own width soon enough.
        let fastest = self
            .store
            .bodies
            .living()
            .map(|i| self.store.at(i, self.time).1.norm())
            .fold(self.store.gravity.norm(), f64::max);
        let span = (space.high - space.low).norm() / (1.0 + count as f64) / if fastest > 0.0 { fastest } else { 1.0 };
        self.queue.reset(self.time, count, span * 4.0);
        self.ready = true;
        #[cfg(feature = "rayon")]
        let looks = self.first_looks();
        for i in 0..self.store.bodies.len() {
            #[cfg(feature = "rayon")]
            if let Some(&Some(next)) = looks.get(i) {
                self.due[i].next = next;
                self.look_at_walls(i);
                self.schedule(i);
                continue;
            }
            if self.store.bodies.alive[i] {
                self.predict(i);
            }
        }
        for (k, island) in self.islands.iter().enumerate().filter(|(_, island)| island.alive && !island.resting) {
            let time = island.start + island.length;
            self.queue.push(Entry { time, owner: ISLAND | k as u32, partner: SLICE_END, stamp: island.stamp });
        }
        self.group_pending();
    }

    /// Cells, and lists of neighbours where these pay: cells are then so much wider that all of a list lie in those around. Both choices
    /// go by the density in which bodies find themselves, wherever they are.
    fn choose_broad_phase(&mut self, space: &Space<D>, bodies: usize, reach: f64, slack: f64) {
        let place = |i: usize| {
            let (x, _) = self.store.at(i, self.time);
            self.store.wrapped(x, self.store.turns(x))
        };
        let places: alloc::vec::Vec<Vector<D>> = self.store.bodies.living().map(place).collect();
        let spread = Spread::of(space, &places);
        drop(places);
        let volume: f64 = (space.high - space.low).0.iter().product();
        let density = spread.as_ref().map_or(bodies as f64 / volume, |spread| spread.around);
        let needs = Needs { bodies, reach, slack, scale: self.cell_scale, wanted: 1.0 };
        let margin = self.margin_of_lists(density);
        if let Some(margin) = margin {
            let slack = slack + margin / reach * (1.0 + 1e-6);
            self.cells = Cells::new(space, spread.as_ref(), Needs { slack, ..needs });
            self.look_at_plainness();
            self.place_walls();
            if self.plain && !self.cells.has_walls() {
                self.lists.start(true, margin, self.store.bodies.len());
                return;
            }
        }
        self.lists.start(false, 0.0, 0);
        let wanted = if self.store.uniform { FINE } else { 1.0 };
        self.cells = Cells::new(space, spread.as_ref(), Needs { wanted, ..needs });
        self.look_at_plainness();
        self.place_walls();
    }

    pub(super) fn place_walls(&mut self) {
        /// A body looks at this many walls without a thought.
        const FEW_WALLS: usize = 8;
        self.everywhere.clear();
        self.wrapped_walls = false;
        let solid = |w: &&WallRecord<D>| w.alive && w.shape.bounds().is_some();
        let few = self.store.walls.iter().filter(solid).count() <= FEW_WALLS;
        for (w, wall) in self.store.walls.iter().enumerate().filter(|(_, wall)| wall.alive) {
            match wall.shape.bounds() {
                Some((low, high)) if !few && wall.velocity == Vector::ZERO && !self.store.any_periodic => {
                    self.cells.add_wall(w as u32, low, high);
                }
                bounds => {
                    self.everywhere.push(w as u32);
                    self.wrapped_walls |= bounds.is_some() && self.store.any_periodic;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ball, Boundary};

    /// 196 discs in the middle of a box of 160,000 times the area of one, with lists of neighbours or without, and one at each corner.
    fn clump(periodic: bool, lists: Option<f64>) -> World<2> {
        let (low, high) = ([-400.0; 2], [400.0; 2]);
        let boundary = if periodic { Boundary::periodic(low, high) } else { Boundary::walls(low, high) };
        let mut world = World::<2>::new().boundary(boundary);
        world.set_lists(lists);
        for n in 0..196 {
            world.ball(Ball::new(1.0, 1.0).at([2.2 * (n % 14) as f64 - 15.0, 2.2 * (n / 14) as f64 - 15.0]));
        }
        for corner in [[-390.0, -390.0], [390.0, -390.0], [-390.0, 390.0], [390.0, 390.0]] {
            world.ball(Ball::new(1.0, 1.0).at(corner));
        }
        world
    }

    #[test]
    fn a_clump_in_a_wide_box_has_narrow_cells() {
        for (periodic, lists) in [(false, None), (true, None), (false, Some(0.0)), (true, Some(0.0))] {
            let mut world = clump(periodic, lists);
            world.prepare();
            // Even cells of 800 m / sqrt(3 x 200) hold the clump in four, 49 discs in each.
            let first = world.crowding;
            assert!(first < 8.0, "{first} discs in a disc's cell, periodic: {periodic}, lists: {lists:?}");
        }
    }

    #[test]
    fn cells_that_got_crowded_are_made_anew() {
        let mut world = clump(false, Some(0.0));
        world.set_cell_scale(1000.0);
        world.prepare();
        // All in one cell, as they were when it was made; then as if they had been one in each.
        assert!(world.crowding > 100.0 && !world.outgrown());
        world.crowding = 1.0;
        assert!(world.outgrown());
    }
}
