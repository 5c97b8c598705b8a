//! The broad phase: a grid of cells that says who is near whom. It never changes what happens, only what is looked at.
//!
//! A cell is at least as wide as the largest ball, so that two balls that touch lie in the same cell or in neighbouring ones.
//! Along an axis that is not periodic the outermost cells reach to infinity: a ball that flies away crosses a finite number of
//! cells and then none, and a world in which nothing can ever meet again has an empty queue.
use super::edges::{Edges, Spread};
use super::machine::{FOUR, fetch, in_large_pages};
use super::memory::held;
use crate::Vector;
use alloc::vec::Vec;

/// No body.
const NONE: u32 = u32::MAX;

/// The size of arrays into which the bodies around one are gathered: those around a body, and those around an anchor, whose cells are
/// wider. Four less must be a power of two.
pub(super) const AROUND: usize = 128 + 4;
pub(super) const WIDE_AROUND: usize = 256 + 4;

/// Three bodies of a cell, how many they are, and where more of them are. A cell's bodies fill its chunks from behind: only the first
/// chunk, which stands in the grid itself, may have empty places, and these come last.
///
/// The fourth word is four times the number of the next chunk, from 1 on, or 0, and the number of bodies of this one.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
struct Chunk([u32; 4]);

impl Chunk {
    const EMPTY: Self = Self([NONE, NONE, NONE, 0]);

    #[inline(always)]
    fn count(&self) -> usize {
        self.0[3] as usize & 3
    }

    fn bodies(&self) -> &[u32] {
        &self.0[..self.count()]
    }

    /// The bodies of a chunk, and whatever stands in its empty places.
    fn places(&mut self) -> &mut [u32] {
        &mut self.0[..3]
    }

    #[inline(always)]
    fn is_last(&self) -> bool {
        self.0[3] <= 3
    }

    /// The place of the next chunk among those of crowded cells.
    #[inline(always)]
    fn next(&self) -> Option<usize> {
        (self.0[3] >> 2).checked_sub(1).map(|k| k as usize)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Cells<const D: usize> {
    edges: Edges<D>,
    /// How far apart neighbours along an axis lie in the grid.
    stride: [usize; D],
    space: Space<D>,
    grid: Vec<Chunk>,
    /// Chunks of crowded cells, and those of them that wait to be used.
    more: Vec<Chunk>,
    spare: Vec<u32>,
    /// The walls that a ball in this cell can touch; empty where no cell has any.
    walls: Vec<Vec<u32>>,
    /// The cell of a body, by axes, and how often it has gone round each periodic axis since its record was written.
    place: Vec<Place<D>>,
    /// The largest radius the cells are made for (m).
    pub(crate) reach: f64,
}

/// Where a body is: its cell by axes, and the number of times round.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<const D: usize> {
    pub cell: [u32; D],
    pub wraps: [i32; D],
}

/// The space that the cells divide.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Space<const D: usize> {
    pub low: Vector<D>,
    pub high: Vector<D>,
    pub periodic: [bool; D],
}

/// A cell must be a little wider than the largest ball: a ball that crosses into it is then still at a distance from those
/// it comes near, and the crossing is seen before the meeting.
pub(super) const SLACK: f64 = 1.0 + 1e-6;
/// With gravity, slices look this much further (twice what both bodies of a pair may move).
pub(super) const SLICE_SLACK: f64 = 1.15;
/// Fewer bodies than this in a world without periodic axes share one cell: looking at all is cheaper than crossing.
const FEW: usize = 24;

/// What cells are made for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Needs {
    pub bodies: usize,
    /// The radius of the largest (m), and how many times as wide as that ball a cell is at least.
    pub reach: f64,
    pub slack: f64,
    /// Multiplies the width of the cells (1 is the engine's own choice); results do not depend on it.
    pub scale: f64,
    /// So many cells a body are made where they are wide enough.
    pub wanted: f64,
}

impl<const D: usize> Cells<D> {
    pub(crate) fn none() -> Self {
        let space = Space { low: Vector::ZERO, high: Vector::from_fn(|_| 1.0), periodic: [false; D] };
        Self::over(&space, Edges::one(&space), 0, 0.0)
    }

    /// An empty grid over `space`, even unless it is said how the bodies are spread.
    pub(super) fn new(space: &Space<D>, spread: Option<&Spread<D>>, needs: Needs) -> Self {
        let Needs { bodies, reach, slack, scale, wanted } = needs;
        let least = 2.0 * reach * slack;
        let few = bodies < FEW && !space.periodic.contains(&true) && scale >= 1.0;
        let mean = || Edges::for_mean(space, bodies, least, scale, wanted);
        let edges = match spread {
            _ if few => Edges::one(space),
            Some(spread) => {
                let edges = Edges::for_spread(space, bodies, least, scale, wanted, spread);
                // Images of a periodic box must not be in doubt where they would not be among even cells.
                let wide = (0..D).all(|k| !space.periodic[k] || edges.is_wide(k));
                if wide { edges } else { mean() }
            }
            None => mean(),
        };
        Self::over(space, edges, bodies, reach)
    }

    fn over(space: &Space<D>, edges: Edges<D>, bodies: usize, reach: f64) -> Self {
        let cells = edges.count.iter().map(|&n| n as usize).product();
        let mut stride = [1; D];
        for k in 1..D {
            stride[k] = stride[k - 1] * edges.count[k - 1] as usize;
        }
        let (mut grid, place) = (Vec::with_capacity(cells), Vec::with_capacity(bodies));
        in_large_pages(&grid, false);
        in_large_pages(&place, false);
        grid.resize(cells, Chunk::EMPTY);
        Self {
            edges,
            stride,
            space: *space,
            grid,
            more: Vec::new(),
            spare: Vec::new(),
            walls: Vec::new(),
            place,
            reach,
        }
    }

    /// The space that was divided.
    pub(crate) fn space(&self) -> &Space<D> {
        &self.space
    }

    /// The number of cells.
    pub(crate) fn len(&self) -> usize {
        self.grid.len()
    }

    /// How many bodies are in the cell of a body, on average.
    pub(super) fn crowding(&self) -> f64 {
        let (mut bodies, mut squares) = (0.0, 0.0);
        for first in &self.grid {
            let (mut chunk, mut count) = (first, first.count());
            while let Some(next) = chunk.next() {
                chunk = &self.more[next];
                count += chunk.count();
            }
            bodies += count as f64;
            squares += (count * count) as f64;
        }
        if bodies > 0.0 { squares / bodies } else { 0.0 }
    }

    fn index(&self, cell: [u32; D]) -> usize {
        let mut index = 0;
        for k in 0..D {
            index += self.stride[k] * cell[k] as usize;
        }
        index
    }

    /// The cell of a position: along a periodic axis the position lies in the box, or by a rounding outside it.
    fn cell_of(&self, x: Vector<D>) -> [u32; D] {
        core::array::from_fn(|k| self.edges.cell(k, x[k]))
    }

    /// Puts a body in. Its position must be that of now; `wraps` says how often it has gone round since its record.
    pub(crate) fn insert(&mut self, body: u32, x: Vector<D>, wraps: [i32; D]) {
        let i = body as usize;
        if self.place.len() <= i {
            self.place.resize(i + 1, Place { cell: [0; D], wraps: [0; D] });
        }
        self.place[i] = Place { cell: self.cell_of(x), wraps };
        self.link(body);
    }

    fn link(&mut self, body: u32) {
        let c = self.index(self.place[body as usize].cell);
        let first = &mut self.grid[c];
        let count = first.count();
        if count < 3 {
            first.0[count] = body;
            first.0[3] += 1;
            return;
        }
        // Full: what is there moves behind.
        let full = *first;
        let behind = match self.spare.pop() {
            Some(k) => {
                self.more[k as usize] = full;
                k
            }
            None => {
                self.more.push(full);
                (self.more.len() - 1) as u32
            }
        };
        self.grid[c] = Chunk([body, NONE, NONE, (behind + 1) << 2 | 1]);
    }

    /// Takes a body out.
    pub(crate) fn remove(&mut self, body: u32) {
        let c = self.index(self.place[body as usize].cell);
        // The last body of the first chunk takes its place.
        let first = &mut self.grid[c];
        let Some(last) = first.count().checked_sub(1) else { return };
        let filler = core::mem::replace(&mut first.0[last], NONE);
        first.0[3] -= 1;
        if filler != body {
            if let Some(place) = first.places().iter_mut().find(|b| **b == body) {
                *place = filler;
            } else {
                let mut next = first.next();
                while let Some(k) = next {
                    let chunk = &mut self.more[k];
                    if let Some(place) = chunk.places().iter_mut().find(|b| **b == body) {
                        *place = filler;
                        break;
                    }
                    next = chunk.next();
                }
            }
        }
        if last == 0
            && let Some(behind) = self.grid[c].next()
        {
            self.grid[c] = self.more[behind];
            self.spare.push(behind as u32);
        }
    }

    /// True if an image of the box is never in doubt: along every periodic axis there are so many cells that of all images of a ball
    /// in a cell nearby only one is nearest.
    pub(crate) fn is_wide(&self) -> bool {
        (0..D).all(|k| !self.space.periodic[k] || self.edges.is_wide(k))
    }

    /// The bodies near `body`, as [`Cells::near`] visits them, and `body` itself, in groups of four, the last of which is filled up with `body`.
    /// `None` if they do not fit in `found`. Only where [`Cells::is_wide`].
    #[inline]
    pub(crate) fn gather<'a, const ROOM: usize>(
        &self,
        body: u32,
        side: Option<(usize, bool)>,
        found: &'a mut [u32; ROOM],
    ) -> Option<&'a [[u32; FOUR]]> {
        let most = const {
            assert!((ROOM - 4).is_power_of_two());
            ROOM - 4
        };
        let cell = &self.place[body as usize].cell;
        // Along each axis, where the cells to look at lie in the grid: those that exist.
        let (mut at, mut many) = ([[0usize; 3]; 3], [1usize; 3]);
        for k in 0..D.min(3) {
            let (n, c, stride) = (self.edges.count[k], cell[k], self.stride[k]);
            let only = match side {
                Some((axis, up)) if axis == k => Some(up),
                _ => None,
            };
            // Inside, nothing goes round.
            let (below, above) = if c > 0 && c + 1 < n {
                (Some(c - 1), Some(c + 1))
            } else {
                let round = |there: bool, beside: u32, other: u32| {
                    if there { Some(beside) } else { self.space.periodic[k].then_some(other) }
                };
                (round(c > 0, c.wrapping_sub(1), n - 1), round(c + 1 < n, c + 1, 0))
            };
            let of = |c: Option<u32>| c.map_or(0, |c| c as usize * stride);
            (at[k], many[k]) = match only {
                Some(true) => ([of(above); 3], usize::from(above.is_some())),
                Some(false) => ([of(below); 3], usize::from(below.is_some())),
                None => {
                    let own = c as usize * stride;
                    match (below, above) {
                        (Some(_), Some(_)) => ([of(below), own, of(above)], 3),
                        (Some(_), None) => ([of(below), own, 0], 2),
                        (None, _) => ([own, of(above), 0], 1 + usize::from(above.is_some())),
                    }
                }
            };
        }
        let mut count = 0;
        for &z in &at[2][..many[2]] {
            for &y in &at[1][..many[1]] {
                for &x in &at[0][..many[0]] {
                    let mut chunk = &self.grid[z + y + x];
                    loop {
                        // All four words are copied, and those count that are bodies: they come first. The mask tells the compiler what
                        // the test below sees to.
                        let room = count & (most - 1);
                        if let Some(place) = found[room..].first_chunk_mut() {
                            *place = chunk.0;
                        }
                        count += chunk.count();
                        if chunk.is_last() {
                            break;
                        }
                        if count >= most {
                            return None;
                        }
                        chunk = &self.more[chunk.next()?];
                    }
                }
                // Three cells more than were tested for fit, or what they are is of no account.
                if count >= most {
                    return None;
                }
            }
        }
        if let Some(last) = found[count & (most - 1)..].first_chunk_mut::<FOUR>() {
            *last = [body; FOUR];
        }
        Some(&found.as_chunks::<FOUR>().0[..count.div_ceil(FOUR)])
    }

    /// Asks for the memory that [`Cells::gather`] is about to read, of a body whose place was asked for before.
    pub(crate) fn fetch_around(&self, body: u32) {
        let Some(place) = self.place.get(body as usize) else { return };
        let index = self.index(place.cell);
        // Rows of three cells along the first axis lie side by side: the cells above and below, and before and behind.
        let mut step = [0usize; 3];
        step[1..D.min(3)].copy_from_slice(&self.stride[1..D.min(3)]);
        for row in [0, step[1], step[2], step[1] + step[2], step[2].wrapping_sub(step[1])] {
            fetch(&self.grid, index.wrapping_add(row));
            fetch(&self.grid, index.wrapping_sub(row));
        }
    }

    /// Asks for the place of a body.
    pub(crate) fn fetch_place(&self, body: u32) {
        fetch(&self.place, body as usize);
    }

    pub(crate) fn place(&self, body: u32) -> &Place<D> {
        &self.place[body as usize]
    }

    /// The record of a body was written with its position taken back into the box by `turns` widths. A body without a place (it
    /// came after the cells were laid, or before there were any) will get one that says so.
    pub(crate) fn rewrapped(&mut self, body: u32, turns: [i32; D]) {
        let Some(place) = self.place.get_mut(body as usize) else { return };
        for k in 0..D {
            place.wraps[k] = place.wraps[k].saturating_sub(turns[k]);
        }
    }

    /// The interval of coordinate `k` that a body's cell covers, in the frame of its record (which `wraps` box widths
    /// separate from the box).
    pub(crate) fn interval(&self, body: u32, k: usize) -> (f64, f64) {
        let place = &self.place[body as usize];
        let (n, c) = (self.edges.count[k], place.cell[k]);
        let turned = if self.space.periodic[k] { f64::from(place.wraps[k]) * self.edges.extent(k) } else { 0.0 };
        let low = if c == 0 && !self.space.periodic[k] { f64::NEG_INFINITY } else { self.edges.at(k, c) + turned };
        let high = if c + 1 == n && !self.space.periodic[k] { f64::INFINITY } else { self.edges.at(k, c + 1) + turned };
        (low, high)
    }

    /// When a body at `x` (in the frame of its record) with velocity `v` leaves its cell, from now on, along which axis, and whether
    /// upwards.
    #[inline(always)]
    pub(crate) fn exit(&self, body: u32, x: Vector<D>, v: Vector<D>) -> (f64, usize, bool) {
        let place = &self.place[body as usize];
        let mut first = (f64::INFINITY, 0, false);
        for k in 0..D {
            let (n, c) = (self.edges.count[k], place.cell[k]);
            let up = v[k] > 0.0;
            // The edge ahead; beyond the last one there is none.
            let turned = if self.space.periodic[k] { f64::from(place.wraps[k]) * self.edges.extent(k) } else { 0.0 };
            let edge = self.edges.at(k, c + u32::from(up)) + turned;
            let outermost = !self.space.periodic[k] && if up { c + 1 == n } else { c == 0 };
            let way = edge - x[k];
            // At the edge, or a rounding beyond it, and moving outward: now.
            let dt = if way * v[k] > 0.0 { way / v[k] } else { 0.0 };
            if v[k] != 0.0 && !outermost && dt < first.0 {
                first = (dt, k, up);
            }
        }
        first
    }

    /// Moves a body into the next cell along axis `k`, up or down. Returns false if there is none.
    pub(crate) fn cross(&mut self, body: u32, k: usize, up: bool) -> bool {
        self.remove(body);
        let n = self.edges.count[k];
        let periodic = self.space.periodic[k];
        let place = &mut self.place[body as usize];
        let moved = match (up, periodic) {
            (true, _) if place.cell[k] + 1 < n => {
                place.cell[k] += 1;
                true
            }
            (false, _) if place.cell[k] > 0 => {
                place.cell[k] -= 1;
                true
            }
            (true, true) => {
                place.cell[k] = 0;
                place.wraps[k] += 1;
                true
            }
            (false, true) => {
                place.cell[k] = n - 1;
                place.wraps[k] -= 1;
                true
            }
            _ => false,
        };
        self.link(body);
        moved
    }

    /// True if a body that has just crossed along a periodic axis went over the edge of the box.
    #[inline]
    pub(crate) fn has_come_round(&self, body: u32, k: usize, up: bool) -> bool {
        self.place[body as usize].cell[k] == if up { 0 } else { self.edges.count[k] - 1 }
    }

    /// Every body near `body`, with the number of box widths by which its *record* must be shifted along each axis to stand
    /// beside this body's record. `side` limits the search to the layer of cells on that side of an axis.
    ///
    /// A neighbour may come more than once, with different shifts, where the box is narrow.
    #[inline]
    pub(crate) fn near(&self, body: u32, side: Option<(usize, bool)>, mut visit: impl FnMut(u32, [i32; D])) {
        let place = &self.place[body as usize];
        let mut offset = [-1i64; D];
        if let Some((k, up)) = side {
            offset[k] = if up { 1 } else { -1 };
        }
        'cells: loop {
            let mut index = 0usize;
            let mut turns = [0i32; D];
            let mut exists = true;
            for k in (0..D).rev() {
                let n = i64::from(self.edges.count[k]);
                let mut c = i64::from(place.cell[k]) + offset[k];
                if c < 0 || c >= n {
                    if !self.space.periodic[k] {
                        exists = false;
                        break;
                    }
                    turns[k] = if c < 0 { -1 } else { 1 };
                    c -= n * i64::from(turns[k]);
                }
                index = index * n as usize + c as usize;
            }
            if exists {
                let mut chunk = &self.grid[index];
                loop {
                    for &other in chunk.bodies() {
                        if other != body {
                            let theirs = &self.place[other as usize].wraps;
                            let shift = |k: usize| place.wraps[k].wrapping_add(turns[k]).wrapping_sub(theirs[k]);
                            visit(other, core::array::from_fn(shift));
                        }
                    }
                    match chunk.next() {
                        Some(next) => chunk = &self.more[next],
                        None => break,
                    }
                }
            }
            for k in 0..D {
                if side.is_some_and(|(fixed, _)| fixed == k) {
                    continue;
                }
                offset[k] += 1;
                if offset[k] <= 1 {
                    continue 'cells;
                }
                offset[k] = -1;
            }
            return;
        }
    }

    /// Registers a wall whose box is [low, high] in every cell from which a ball can touch it.
    pub(crate) fn add_wall(&mut self, wall: u32, low: Vector<D>, high: Vector<D>) {
        let margin = Vector::from_fn(|_| self.reach * SLICE_SLACK);
        // A rounding at a cell's edge must not lose a wall: one ulp of the grid's extent is far below the slack.
        let (first, last) = (self.cell_of(low - margin), self.cell_of(high + margin));
        if self.walls.is_empty() {
            self.walls.resize(self.grid.len(), Vec::new());
        }
        let mut cell = first;
        'cells: loop {
            let c = self.index(cell);
            self.walls[c].push(wall);
            for k in 0..D {
                if cell[k] < last[k] {
                    cell[k] += 1;
                    continue 'cells;
                }
                cell[k] = first[k];
            }
            return;
        }
    }

    /// The walls registered in a body's cell.
    pub(crate) fn walls(&self, body: u32) -> &[u32] {
        if self.walls.is_empty() {
            return &[];
        }
        &self.walls[self.index(self.place[body as usize].cell)]
    }

    /// True if walls are registered in cells.
    pub(crate) fn has_walls(&self) -> bool {
        !self.walls.is_empty()
    }

    /// The memory that the cells hold (bytes).
    pub(crate) fn bytes(&self) -> usize {
        let walls: usize = self.walls.iter().map(held).sum();
        held(&self.grid) + held(&self.more) + held(&self.spare) + held(&self.walls) + walls + held(&self.place)
    }

    /// True if a body of this radius fits the cells.
    pub(crate) fn fits(&self, radius: f64) -> bool {
        radius <= self.reach
    }
}
