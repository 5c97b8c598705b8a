//! The clock: which meeting is next, and then?
//!
//! No time step. Every body moves exactly from its record (uniformly, or in a parabola) until an event; the queue hands out
//! the events in the order of their times; an impact rewrites the records of those that took part and predicts what they
//! meet next.
mod calendar;
mod cells;
mod instant;
mod islands;
mod predict;
mod query;
mod run;
mod slices;
mod store;
mod support;

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use crate::body::own_material;
use crate::law::together::{Solver, System, Together};
use crate::ledger::{Books, Ledger, Magnitudes, Totals};
use crate::material::Materials;
use crate::report::{Impact, Touch};
use crate::{Ball, BodyId, Coefficient, Error, Material, MaterialId, Rotates, Vector, Wall, WallId};
use calendar::{Calendar, Entry};
use cells::{Cells, Space};
use instant::{Instant, Null, Pile};
use slices::{Island, NO_ISLAND, Partial};
use store::{Bodies, Motion, Store, WallRecord};

pub use instant::{PILE_UP, PILE_UP_WINDOW, PRESSED_PILE_UP, SAME_INSTANT, TOUCHING};
pub use islands::EQUILIBRIUM;
pub use query::Hit;
pub use run::{Limits, Stop};
pub use slices::SLICE;
pub use support::REST_EPS;

/// Codes of partners: bodies are below this bit, walls have it.
const WALL: u32 = 1 << 31;
const CROSSING: u32 = u32::MAX;
const SUPPORT_END: u32 = u32::MAX - 1;
const NOTHING: u32 = u32::MAX - 2;
const SLICE_END: u32 = u32::MAX - 3;
/// Owners of entries that are islands have this bit.
const ISLAND: u32 = 1 << 31;

/// Below this approach speed (m/s) a contact that gravity presses together is plastic and lasts, unless a scene says
/// otherwise: a ball then leaves out hops of less than 5 micrometres (v^2 / 2g).
pub const REST_SPEED: f64 = 0.01;

const DOWNHILL: &str = "gravity must not point along a periodic axis";

/// The edge of a world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary<const D: usize> {
    /// The lower corner of the box (m); minus infinity where there is none.
    pub min: Vector<D>,
    /// The upper corner (m).
    pub max: Vector<D>,
    /// Along these axes the box closes on itself; along the others it has walls.
    pub periodic: [bool; D],
    /// The material of its walls.
    pub material: MaterialId,
}

impl<const D: usize> Boundary<D> {
    /// No edge at all.
    pub fn open() -> Self {
        Self {
            min: Vector::from_fn(|_| f64::NEG_INFINITY),
            max: Vector::from_fn(|_| f64::INFINITY),
            periodic: [false; D],
            material: MaterialId::default(),
        }
    }

    /// A box with walls, from one corner to the other (m).
    pub fn walls(min: impl Into<Vector<D>>, max: impl Into<Vector<D>>) -> Self {
        Self { min: min.into(), max: max.into(), ..Self::open() }
    }

    /// A box that closes on itself along every axis.
    pub fn periodic(min: impl Into<Vector<D>>, max: impl Into<Vector<D>>) -> Self {
        Self { periodic: [true; D], ..Self::walls(min, max) }
    }

    /// The box with axis `k` closed on itself.
    ///
    /// # Panics
    /// If `k >= D`.
    pub fn closed_along(mut self, k: usize) -> Self {
        self.periodic[k] = true;
        self
    }

    /// The walls of the box of this material.
    pub fn material(self, material: MaterialId) -> Self {
        Self { material, ..self }
    }
}

/// What a body meets first.
#[derive(Clone, Copy, Debug)]
struct Next {
    time: f64,
    partner: u32,
    /// The partner's stamp when this was predicted: if it has another one by now, the prediction is void.
    stamp: u32,
}

/// Bodies that meet and part, exactly.
///
/// ```
/// use carom::{Ball, Wall, World};
/// let mut world = World::<2>::new().gravity([0.0, -9.81]);
/// world.wall(Wall::plane([0.0, 0.0], [0.0, 1.0]));
/// world.ball(Ball::new(1.0, 0.1).at([0.0, 2.0]).restitution(0.8));
/// let mut hardest = 0.0f64;
/// for _ in 0..120 {
///     for impact in world.advance(1.0 / 60.0) {
///         hardest = hardest.max(impact.impulse);
///     }
/// }
/// assert!((hardest - 1.8 * (2.0f64 * 9.81 * 1.9).sqrt()).abs() < 1e-12);
/// assert!(world.ledger().unexplained() < 1e-12);
/// ```
#[derive(Debug)]
pub struct World<const D: usize>
where
    Vector<D>: Rotates,
{
    time: f64,
    rest_speed: f64,
    store: Store<D>,
    next: Vec<Next>,
    /// The stamp of a body's entry in the queue.
    turn: Vec<u32>,
    /// The axis and direction in which a body crosses into its next cell.
    crossings: Vec<u8>,
    piles: Vec<Pile>,
    /// The last meeting of a body that came to nothing.
    nulls: Vec<Null>,
    cells: Cells<D>,
    cell_scale: f64,
    queue: Calendar,
    /// Walls that every body looks at: planes, driven walls, and all walls where there are few.
    everywhere: Vec<u32>,
    /// Walls other than planes in a periodic box have images, and are looked at from every cell.
    wrapped_walls: bool,
    /// The walls that hold a body.
    held: BTreeMap<u32, Vec<u32>>,
    /// Bodies that are neither fixed nor at rest; bodies at rest.
    restless: usize,
    resting: usize,
    /// The sides of the boundary as walls, by axis: low and high.
    sides: [[Option<u32>; 2]; D],
    instant: Instant<D>,
    /// Cells, queue and predictions are up to date.
    ready: bool,
    books: Books<D>,
    impacts: Vec<Impact<D>>,
    touches: Vec<Touch>,
    /// Meetings with sensors that were told at this very time.
    told: BTreeSet<(u32, u32, u64)>,
    keep_reports: bool,
    impact_count: u64,
    events: u64,
    crossed: u64,
    broken: bool,
    crushed: bool,
    together: Together,
    system: System,
    solver: Solver,
    islands: Vec<Island<D>>,
    free_islands: Vec<u32>,
    island_of: Vec<u32>,
    island_turn: u32,
    /// Impulses over slice lengths of the islands that were just dissolved: where the next solution starts.
    warm: BTreeMap<(u32, u32), f64>,
    partial: Partial<D>,
    slices: u64,
    /// Bodies that wait to be grouped into islands when cells and queue are ready.
    pending: Vec<u32>,
}

impl<const D: usize> Default for World<D>
where
    Vector<D>: Rotates,
{
    fn default() -> Self {
        Self::new()
    }
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// An open, empty world without gravity, at time 0.
    pub fn new() -> Self {
        Self {
            time: 0.0,
            rest_speed: REST_SPEED,
            store: Store {
                bodies: Bodies::new(),
                walls: Vec::new(),
                materials: Materials::default(),
                gravity: Vector::ZERO,
                weightless: true,
                uniform: true,
                boundary: Boundary::open(),
                width: Vector::ZERO,
                periodic: [false; D],
                any_periodic: false,
                ignored: Vec::new(),
            },
            next: Vec::new(),
            turn: Vec::new(),
            crossings: Vec::new(),
            piles: Vec::new(),
            nulls: Vec::new(),
            cells: Cells::none(),
            cell_scale: 1.0,
            queue: Calendar::default(),
            everywhere: Vec::new(),
            wrapped_walls: false,
            held: BTreeMap::new(),
            restless: 0,
            resting: 0,
            sides: [[None; 2]; D],
            instant: Instant::default(),
            ready: false,
            books: Books::default(),
            impacts: Vec::new(),
            touches: Vec::new(),
            told: BTreeSet::new(),
            keep_reports: true,
            impact_count: 0,
            events: 0,
            crossed: 0,
            broken: false,
            crushed: false,
            together: Together::default(),
            system: System::new(),
            solver: Solver::new(),
            islands: Vec::new(),
            free_islands: Vec::new(),
            island_of: Vec::new(),
            island_turn: 0,
            warm: BTreeMap::new(),
            partial: Partial::default(),
            slices: 0,
            pending: Vec::new(),
        }
    }

    /// The world with this gravity (m/s^2).
    ///
    /// # Panics
    /// If it is not finite; [`World::set_gravity`] returns an error instead.
    pub fn gravity(mut self, gravity: impl Into<Vector<D>>) -> Self {
        self.set_gravity(gravity).expect("gravity");
        self
    }

    /// The world with this boundary.
    ///
    /// # Panics
    /// If it has no room; [`World::set_boundary`] returns an error instead.
    pub fn boundary(mut self, boundary: Boundary<D>) -> Self {
        self.set_boundary(boundary).expect("boundary");
        self
    }

    /// The world with this rest speed (m/s); 0 turns rest off. See [`REST_SPEED`].
    pub fn rest_speed(mut self, speed: f64) -> Self {
        self.rest_speed = speed;
        self
    }

    /// The world with this operator for contacts that share an instant.
    pub fn together(mut self, together: Together) -> Self {
        self.together = together;
        self
    }

    /// Changes gravity (m/s^2).
    ///
    /// # Errors
    /// [`Error::NotFinite`]; [`Error::Boundary`] along a periodic axis, where falling has no end and potential energy no value.
    pub fn set_gravity(&mut self, gravity: impl Into<Vector<D>>) -> Result<(), Error> {
        let gravity = gravity.into();
        if !gravity.is_finite() {
            return Err(Error::NotFinite("gravity"));
        }
        if (0..D).any(|k| self.store.periodic[k] && gravity[k] != 0.0) {
            return Err(Error::Boundary(DOWNHILL));
        }
        for k in 0..self.islands.len() {
            self.wake(k);
        }
        for i in 0..self.store.bodies.len() {
            if self.store.bodies.alive[i] && !self.store.bodies.is_fixed(i) {
                self.renew(i);
                self.set_motion(i, Motion::Free);
            }
        }
        self.pending.clear();
        let before = self.books.start.is_some().then(|| self.totals().0.potential);
        self.store.gravity = gravity;
        self.store.weightless = gravity == Vector::ZERO;
        self.store.uniform &= self.store.weightless;
        if let Some(before) = before {
            // The user lifts or lowers everything at a stroke.
            let work = self.totals().0.potential - before;
            self.books.work.add(work);
        }
        self.ready = false;
        Ok(())
    }

    /// Sets the edge of the world. Its walls come after the walls that are there already.
    ///
    /// # Errors
    /// [`Error::Boundary`] if the box has no room, an axis is closed without two finite ends, or the world has a boundary.
    pub fn set_boundary(&mut self, boundary: Boundary<D>) -> Result<(), Error> {
        if self.sides.iter().flatten().any(Option::is_some) || self.store.any_periodic {
            return Err(Error::Boundary("the world has a boundary already"));
        }
        self.known(boundary.material)?;
        for k in 0..D {
            if !(boundary.min[k] < boundary.max[k]) {
                return Err(Error::Boundary("the boundary's min must be below its max"));
            }
            if boundary.periodic[k] && self.store.gravity[k] != 0.0 {
                return Err(Error::Boundary(DOWNHILL));
            }
            if boundary.periodic[k] && !(boundary.max[k] - boundary.min[k]).is_finite() {
                return Err(Error::Boundary("a periodic axis needs two finite ends"));
            }
        }
        self.store.boundary = boundary;
        self.store.periodic = boundary.periodic;
        self.store.any_periodic = boundary.periodic.contains(&true);
        for k in 0..D {
            self.store.width[k] = if boundary.periodic[k] { boundary.max[k] - boundary.min[k] } else { 0.0 };
            if boundary.periodic[k] {
                continue;
            }
            for (side, at, sign) in [(0, boundary.min[k], 1.0), (1, boundary.max[k], -1.0)] {
                if at.is_finite() {
                    let mut point = Vector::ZERO;
                    point[k] = at;
                    let wall = Wall::plane(point, Vector::axis(k) * sign).material(boundary.material);
                    self.sides[k][side] = Some(self.add_wall(wall)?.index);
                }
            }
        }
        self.ready = false;
        Ok(())
    }

    /// The side of the boundary across axis `k`: the lower one, or the upper one. `None` where there is no wall.
    pub fn side(&self, k: usize, upper: bool) -> Option<WallId> {
        let w = (*self.sides.get(k)?)[usize::from(upper)]?;
        Some(self.store.wall_id(w as usize))
    }

    /// Adds a material.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if a coefficient is not in its range.
    pub fn material(&mut self, material: Material) -> Result<MaterialId, Error> {
        if !material.is_valid() {
            return Err(Error::OutOfRange(
                "a material's restitution must lie in [0, 1], its friction be >= 0, its tangential restitution lie in [-1, 1]",
            ));
        }
        Ok(self.store.materials.add(material))
    }

    /// Changes the material of whatever names none.
    ///
    /// # Errors
    /// As [`World::material`].
    pub fn set_default_material(&mut self, material: Material) -> Result<(), Error> {
        if !material.is_valid() {
            return Err(Error::OutOfRange(
                "a material's restitution must lie in [0, 1], its friction be >= 0, its tangential restitution lie in [-1, 1]",
            ));
        }
        self.store.materials.set_default(material);
        Ok(())
    }

    /// Sets what two materials say of each other, in place of what they combine to.
    ///
    /// # Errors
    /// [`Error::Stale`] for a material of another world, [`Error::OutOfRange`].
    pub fn pair(&mut self, a: MaterialId, b: MaterialId, says: Material) -> Result<(), Error> {
        self.known(a)?;
        self.known(b)?;
        if !says.is_valid() {
            return Err(Error::OutOfRange(
                "a pair's restitution must lie in [0, 1], its friction be >= 0, its tangential restitution lie in [-1, 1]",
            ));
        }
        self.store.materials.set_pair(a, b, says);
        Ok(())
    }

    /// The table of materials.
    pub fn materials(&self) -> &Materials {
        &self.store.materials
    }

    fn known(&self, material: MaterialId) -> Result<(), Error> {
        self.store.materials.get(material).map(|_| ()).ok_or(Error::Stale("material"))
    }

    fn surface(&mut self, base: MaterialId, own: &Option<Coefficient>) -> Result<MaterialId, Error> {
        let material = self.store.materials.get(base).ok_or(Error::Stale("material"))?;
        Ok(match own_material(material, own) {
            Some(own) => self.store.materials.intern(own),
            None => base,
        })
    }

    /// Adds a ball that is known to be sound.
    ///
    /// # Panics
    /// If it is not; [`World::add`] returns an error instead.
    pub fn ball(&mut self, ball: Ball<D>) -> BodyId {
        self.add(ball).expect("a sound ball")
    }

    /// Adds a wall that is known to be sound.
    ///
    /// # Panics
    /// If it is not; [`World::add_wall`] returns an error instead.
    pub fn wall(&mut self, wall: Wall<D>) -> WallId {
        self.add_wall(wall).expect("a sound wall")
    }

    /// Adds a ball, now. It may touch others; where it overlaps them, they part if they move apart and collide if they close.
    ///
    /// # Errors
    /// What [`Ball::check`] finds, a stale material, [`Error::Boundary`] if a periodic box is narrower than four radii,
    /// [`Error::Full`].
    pub fn add(&mut self, ball: Ball<D>) -> Result<BodyId, Error> {
        ball.check()?;
        for k in 0..D {
            if self.store.periodic[k] && !(self.store.width[k] >= 4.0 * ball.radius) {
                return Err(Error::Boundary("a periodic box must be at least four radii wide"));
            }
        }
        let material = self.surface(ball.material, &ball.restitution)?;
        let i = self.store.bodies.add(&ball, material, self.time)?;
        let turns = self.store.turns(ball.position);
        let x = self.store.wrapped(ball.position, turns);
        self.store.bodies.record[i].x = x;
        self.store.bodies.image[i] = turns;
        if !ball.fixed {
            self.restless += 1;
        }
        let nothing = Next { time: f64::INFINITY, partner: NOTHING, stamp: 0 };
        if self.next.len() <= i {
            self.next.resize(i + 1, nothing);
            self.turn.resize(i + 1, 0);
            self.crossings.resize(i + 1, 0);
            self.piles.resize(i + 1, Pile::default());
            self.nulls.resize(i + 1, Null::default());
            self.island_of.resize(i + 1, NO_ISLAND);
        }
        self.piles[i] = Pile::default();
        self.nulls[i] = Null::default();
        self.book_user(i, 1.0);
        if self.ready && self.cells.fits(ball.radius) {
            self.cells.insert(i as u32, x, [0; D]);
            self.predict(i);
        } else {
            self.ready = false;
        }
        Ok(self.store.bodies.id(i))
    }

    /// Removes a body, now. What rested against nothing else but walls is not touched.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn remove(&mut self, id: BodyId) -> Result<(), Error> {
        let i = self.store.bodies.find(id)?;
        self.disturb(i);
        if !self.store.bodies.is_fixed(i) {
            self.renew(i);
            self.set_motion(i, Motion::Free);
            self.restless -= 1;
        }
        self.book_user(i, -1.0);
        if self.ready {
            self.cells.remove(i as u32);
        }
        self.turn[i] = self.turn[i].wrapping_add(1);
        self.store.ignored.retain(|pair| pair.0 != i as u32 && pair.1 != i as u32);
        self.store.bodies.remove(i);
        self.group_pending();
        Ok(())
    }

    /// Adds a wall, now. Everything is predicted anew.
    ///
    /// # Errors
    /// What [`Wall::check`] finds, a stale material, [`Error::Full`].
    pub fn add_wall(&mut self, wall: Wall<D>) -> Result<WallId, Error> {
        wall.check()?;
        if self.store.walls.len() >= (WALL - 8) as usize {
            return Err(Error::Full);
        }
        let material = self.surface(wall.material, &wall.restitution)?;
        self.store.walls.push(WallRecord {
            shape: wall.shape,
            velocity: wall.velocity,
            since: self.time,
            material,
            generation: 0,
            alive: true,
        });
        self.ready = false;
        Ok(self.store.wall_id(self.store.walls.len() - 1))
    }

    /// Removes a wall, now; what it held falls.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn remove_wall(&mut self, id: WallId) -> Result<(), Error> {
        let w = self.store.find_wall(id)?;
        self.release(w);
        let wall = &mut self.store.walls[w];
        wall.alive = false;
        wall.generation = wall.generation.wrapping_add(1);
        for side in self.sides.iter_mut().flatten() {
            if *side == Some(w as u32) {
                *side = None;
            }
        }
        self.ready = false;
        Ok(())
    }

    /// Drives a wall at another velocity (m/s) from now on; what it held is released, and held again if it still presses.
    ///
    /// # Errors
    /// [`Error::Stale`], [`Error::NotFinite`].
    pub fn set_wall_velocity(&mut self, id: WallId, velocity: impl Into<Vector<D>>) -> Result<(), Error> {
        let w = self.store.find_wall(id)?;
        let velocity = velocity.into();
        if !velocity.is_finite() {
            return Err(Error::NotFinite("velocity"));
        }
        self.release(w);
        let time = self.time;
        let wall = &mut self.store.walls[w];
        let shift = wall.shift(time);
        wall.shape = wall.shape.shifted(shift);
        wall.since = time;
        wall.velocity = velocity;
        self.ready = false;
        Ok(())
    }

    /// Ends an island, slices under way or at rest; its bodies wait to be grouped anew.
    fn wake(&mut self, k: usize) {
        if self.islands[k].alive {
            let bodies = self.dissolve(k, self.time);
            self.pending.extend(bodies);
        }
    }

    /// Wakes all that lies with body `i`, or that it carries as a fixed body; the body itself leaves the slices.
    fn disturb(&mut self, i: usize) {
        if self.island_of[i] != NO_ISLAND {
            self.wake(self.island_of[i] as usize);
        }
        self.pending.retain(|&b| b != i as u32);
        for k in 0..self.islands.len() {
            if self.islands[k].near.iter().any(|n| n.b == i as u32) {
                self.wake(k);
            }
        }
    }

    /// Groups what was woken, if there are cells to look for neighbours in; else it is done as soon as there are.
    fn group_pending(&mut self) {
        if self.ready {
            let pending = core::mem::take(&mut self.pending);
            if !pending.is_empty() {
                self.regroup(self.time, pending);
            }
            self.read_slices();
        }
    }

    fn release(&mut self, w: usize) {
        for k in 0..self.islands.len() {
            if self.islands[k].near.iter().any(|n| n.b == WALL | w as u32) {
                self.wake(k);
            }
        }
        let released: Vec<u32> =
            self.held.iter().filter(|(_, walls)| walls.contains(&(w as u32))).map(|(i, _)| *i).collect();
        for i in released.into_iter().filter(|i| !self.pending.contains(i)).collect::<Vec<_>>() {
            self.renew(i as usize);
            self.set_motion(i as usize, Motion::Free);
        }
    }

    /// Writes a body's record at the present time, its motion unchanged.
    fn renew(&mut self, i: usize) {
        let (x, v) = self.store.at(i, self.time);
        self.write(i, self.time, x, v);
    }

    /// A change by the user to the body `i`: books what it had with a minus and what it has with a plus.
    fn change(&mut self, id: BodyId, apply: impl FnOnce(&mut Self, usize)) -> Result<(), Error> {
        let i = self.store.bodies.find(id)?;
        self.disturb(i);
        self.renew(i);
        self.book_user(i, -1.0);
        if !self.store.bodies.is_fixed(i) {
            self.set_motion(i, Motion::Free);
        }
        apply(self, i);
        self.store.bodies.stamp[i] = self.store.bodies.stamp[i].wrapping_add(1);
        self.book_user(i, 1.0);
        if self.ready && self.cells.fits(self.store.bodies.record[i].radius) {
            self.cells.remove(i as u32);
            let x = self.store.bodies.record[i].x;
            self.cells.insert(i as u32, x, [0; D]);
            self.predict(i);
        } else {
            self.ready = false;
        }
        self.group_pending();
        Ok(())
    }

    /// Gives a body another velocity (m/s), now.
    ///
    /// # Errors
    /// [`Error::Stale`], [`Error::NotFinite`].
    pub fn set_velocity(&mut self, id: BodyId, velocity: impl Into<Vector<D>>) -> Result<(), Error> {
        let velocity = velocity.into();
        if !velocity.is_finite() {
            return Err(Error::NotFinite("velocity"));
        }
        self.change(id, |world, i| world.store.bodies.record[i].v = velocity)
    }

    /// Puts a body elsewhere (m), now.
    ///
    /// # Errors
    /// [`Error::Stale`], [`Error::NotFinite`].
    pub fn set_position(&mut self, id: BodyId, position: impl Into<Vector<D>>) -> Result<(), Error> {
        let position = position.into();
        if !position.is_finite() {
            return Err(Error::NotFinite("position"));
        }
        self.change(id, |world, i| {
            let turns = world.store.turns(position);
            world.store.bodies.record[i].x = world.store.wrapped(position, turns);
            world.store.bodies.image[i] = turns;
        })
    }

    /// Gives a body another spin (rad/s), now.
    ///
    /// # Errors
    /// [`Error::Stale`], [`Error::NotFinite`].
    pub fn set_spin(&mut self, id: BodyId, spin: impl Into<<Vector<D> as Rotates>::Spin>) -> Result<(), Error> {
        let spin = spin.into();
        if !Vector::<D>::spin_slice(&spin).iter().all(|w| w.is_finite()) {
            return Err(Error::NotFinite("spin"));
        }
        self.change(id, |world, i| world.store.bodies.spin[i] = spin)
    }

    /// Puts a body into these layers, one bit each, meeting those of `meets`, now.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn set_layers(&mut self, id: BodyId, layers: u32, meets: u32) -> Result<(), Error> {
        self.change(id, |world, i| world.store.bodies.layers[i] = (layers, meets))
    }

    /// Changes the number that the user keeps with a body.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn set_user(&mut self, id: BodyId, user: u64) -> Result<(), Error> {
        let i = self.store.bodies.find(id)?;
        self.store.bodies.user[i] = user;
        Ok(())
    }

    /// Lets two bodies pass through each other (`true`), or meet again.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn ignore(&mut self, a: BodyId, b: BodyId, ignored: bool) -> Result<(), Error> {
        let (i, j) = (self.store.bodies.find(a)? as u32, self.store.bodies.find(b)? as u32);
        let pair = if i < j { (i, j) } else { (j, i) };
        match (self.store.ignored.binary_search(&pair), ignored) {
            (Err(k), true) => self.store.ignored.insert(k, pair),
            (Ok(k), false) => {
                self.store.ignored.remove(k);
            }
            _ => return Ok(()),
        }
        self.change(a, |_, _| {})?;
        self.change(b, |_, _| {})
    }

    /// Books what the user adds (+1) or takes (-1) with a body.
    fn book_user(&mut self, i: usize, sign: f64) {
        if self.books.start.is_none() || self.store.bodies.is_fixed(i) {
            return;
        }
        let own = self.totals_of(i);
        self.books.momentum_given.add(&(own.momentum * sign).0);
        self.books.angular_given.add(Vector::<D>::spin_slice(&(own.angular_momentum * sign)));
        self.books.work.add(sign * (own.kinetic + own.potential));
        let magnitudes = self.magnitudes(i);
        self.books.now.add(&magnitudes, sign);
        let now = self.books.now;
        self.books.largest.raise(&now);
    }

    /// What body `i` has now.
    fn totals_of(&self, i: usize) -> Totals<D> {
        let b = &self.store.bodies;
        let (x, v) = self.state_now(i);
        let m = b.mass[i];
        Totals {
            momentum: v * m,
            angular_momentum: Vector::<D>::moment(x, v * m) + b.spin[i] * b.inertia[i],
            kinetic: 0.5 * (m * v.norm_squared() + b.inertia[i] * Vector::<D>::spin_dot(b.spin[i], b.spin[i])),
            potential: -m * self.store.gravity.dot(x),
        }
    }

    /// What the moving bodies have now, and the sums of magnitudes behind it. Compensated.
    fn totals(&self) -> (Totals<D>, Magnitudes) {
        use crate::ledger::{Sum, Sums};
        let mut momentum = Sums::default();
        let mut angular = Sums::default();
        let (mut kinetic, mut potential) = (Sum::default(), Sum::default());
        let mut magnitudes = Magnitudes::default();
        for i in self.store.bodies.living().filter(|&i| !self.store.bodies.is_fixed(i)) {
            let own = self.totals_of(i);
            momentum.add(&own.momentum.0);
            angular.add(Vector::<D>::spin_slice(&own.angular_momentum));
            kinetic.add(own.kinetic);
            potential.add(own.potential);
            magnitudes.momentum += own.momentum.norm();
            let (x, _) = self.state_now(i);
            magnitudes.angular += x.norm() * own.momentum.norm();
            magnitudes.energy += own.kinetic + if own.potential < 0.0 { -own.potential } else { own.potential };
        }
        let totals = Totals {
            momentum: momentum.vector(),
            angular_momentum: angular.spin::<D>(),
            kinetic: kinetic.value(),
            potential: potential.value(),
        };
        (totals, magnitudes)
    }

    /// The accounts, now: what there was, what there is, who gave and who took, and what nothing explains. Reads every body;
    /// writes nothing.
    pub fn ledger(&self) -> Ledger<D> {
        let (totals, magnitudes) = self.totals();
        let mut books = self.books.clone();
        if books.start.is_some() && !self.store.uniform {
            // What gravity and supports have given since the last record of each.
            books.momentum_given.add(&self.partial.momentum.0);
            books.angular_given.add(Vector::<D>::spin_slice(&self.partial.moment));
            books.lost.add(self.partial.lost);
            books.work.add(self.partial.work);
            let counted = |i: &usize| !self.store.bodies.is_fixed(*i) && self.store.bodies.motion[*i] != Motion::Sliced;
            for i in self.store.bodies.living().filter(counted) {
                let given = self.flight(i, self.time - self.store.bodies.record[i].time);
                books.momentum_given.add(&given.momentum.0);
                books.angular_given.add(Vector::<D>::spin_slice(&given.moment));
                if given.work != 0.0 {
                    books.work.add(given.work);
                }
            }
        }
        books.read(&totals, &magnitudes, self.store.any_periodic)
    }

    /// The smallest box around what can move now, and around the walls, for the cells to divide.
    fn space(&self) -> Space<D> {
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
            if self.store.periodic[k] || boundary.min[k].is_finite() && boundary.max[k].is_finite() {
                (low[k], high[k]) = (boundary.min[k], boundary.max[k]);
            }
            if !(low[k] < high[k]) || !(high[k] - low[k]).is_finite() {
                let middle = if low[k].is_finite() { low[k] } else { 0.0 };
                (low[k], high[k]) = (middle, middle + 1.0);
            }
        }
        Space { low, high, periodic: self.store.periodic }
    }

    /// Multiplies the width of the cells. Results do not depend on it; the tests show that.
    #[doc(hidden)]
    pub fn set_cell_scale(&mut self, scale: f64) {
        self.cell_scale = scale;
        self.ready = false;
    }

    /// Makes cells, queue and predictions anew from the records. A prediction is a pure function of the records, so that this
    /// changes nothing of what happens.
    fn prepare(&mut self) {
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
        let count = self.store.bodies.living().count();
        let reach = self.store.bodies.living().map(|i| self.store.bodies.record[i].radius).fold(0.0, f64::max);
        let space = self.space();
        let slack = if self.store.weightless { cells::SLACK } else { cells::SLICE_SLACK };
        self.cells = Cells::new(&space, count, reach, slack, self.cell_scale);
        self.place_walls();
        for i in 0..self.store.bodies.len() {
            if self.store.bodies.alive[i] {
                let (x, _) = self.store.at(i, self.time);
                let turns = self.store.turns(x);
                let x = self.store.wrapped(x, turns);
                self.cells.insert(i as u32, x, turns);
            }
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
        for i in 0..self.store.bodies.len() {
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

    fn place_walls(&mut self) {
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
