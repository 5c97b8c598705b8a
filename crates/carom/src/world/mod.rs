//! The clock: which meeting is next, and then?
//!
//! No time step. Every body moves exactly from its record (uniformly, or in a parabola) until an event; the queue hands out
//! the events in the order of their times; an impact rewrites the records of those that took part and predicts what they
//! meet next.
mod accounts;
mod ahead;
mod booking;
mod calendar;
mod cells;
mod change;
#[cfg(feature = "rayon")]
mod crew;
#[cfg(not(feature = "rayon"))]
mod crew {
    /// One thread does all the work.
    #[derive(Debug, Default)]
    pub(super) struct Crew;
}
mod drag;
mod edges;
#[cfg(any(test, all(feature = "std", target_arch = "x86_64")))]
mod fours;
mod friction;
mod grip;
mod instant;
mod islands;
mod lean;
mod lists;
mod machine;
mod memory;
mod pile;
mod predict;
mod prepare;
mod query;
mod rounds;
mod run;
mod sight;
mod slices;
mod snapshot;
mod store;
mod support;

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use crate::body::own_material;
use crate::codec::{Codec, Hash, Reader, codec};
use crate::law::Law;
use crate::law::together::{Solver, System, Together};
use crate::ledger::Books;
use crate::material::{Materials, Pair};
use crate::report::{Impact, Touch};
use crate::{Coefficient, Error, Material, MaterialId, Rotates, Vector, Wall, WallId};
use calendar::Calendar;
use cells::Cells;
use instant::Instant;
use lists::Lists;
use pile::{Null, Pile};
use slices::{Island, Partial};
use store::{Bodies, Motion, Store};

pub use grip::TURN;
pub use instant::TOUCHING;
pub use islands::EQUILIBRIUM;
pub use pile::{PILE_UP, PILE_UP_WINDOW, PRESSED_PILE_UP, SAME_INSTANT};
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
const GRIP_END: u32 = u32::MAX - 4;
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

codec!(Boundary<D> { min, max, periodic, material });

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

/// What is due for a body: one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Due {
    /// What it meets first.
    next: Next,
    /// How often it was hit of late.
    pile: Pile,
    /// The stamp of its entry in the queue.
    turn: u32,
    /// The axis and direction in which it crosses into its next cell.
    crossing: u8,
}

impl Due {
    /// Nothing.
    fn new(pile: Pile) -> Self {
        Self { next: Next { time: f64::INFINITY, partner: NOTHING, stamp: 0 }, pile, turn: 0, crossing: 0 }
    }
}

/// Everything else is predicted anew.
impl Codec for Due {
    fn layout(hash: &mut Hash) {
        Pile::layout(hash);
    }
    fn write(&self, to: &mut Vec<u8>) {
        self.pile.write(to);
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        Pile::read(from).map(Self::new)
    }
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
    due: Vec<Due>,
    /// The last meeting of a body that came to nothing.
    nulls: Vec<Null>,
    /// False while there was none of these.
    any_null: bool,
    cells: Cells<D>,
    /// How many bodies were in the cell of a body when the cells were made, on average.
    crowding: f64,
    lists: Lists<D>,
    cell_scale: f64,
    queue: Calendar,
    #[cfg_attr(not(feature = "rayon"), expect(dead_code))]
    crew: crew::Crew,
    /// Walls that every body looks at: planes, driven walls, and all walls where there are few.
    everywhere: Vec<u32>,
    /// Walls other than planes in a periodic box have images, and are looked at from every cell.
    wrapped_walls: bool,
    /// The walls that hold a body.
    held: BTreeMap<u32, Vec<u32>>,
    /// How friction moves the bodies that one rough wall holds.
    grips: BTreeMap<u32, grip::Grip<D>>,
    /// Bodies that are neither fixed nor at rest; bodies at rest.
    restless: usize,
    resting: usize,
    /// Bodies that something holds, rest included.
    bound: usize,
    /// The sides of the boundary as walls, by axis: low and high.
    sides: [[Option<u32>; 2]; D],
    instant: Instant<D>,
    /// All bodies can move and may meet all others; see [`lean`].
    plain: bool,
    /// The layers that all bodies lie in and meet.
    common_layers: u32,
    /// One over the widths of the box along periodic axes, else zero.
    inverse_width: Vector<D>,
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
    law: Law,
    system: System,
    solver: Solver,
    islands: Vec<Island<D>>,
    free_islands: Vec<u32>,
    island_of: Vec<u32>,
    island_turn: u32,
    /// Impulses over slice lengths of the islands that were just dissolved: where the next solution starts.
    warm: BTreeMap<(u32, u32), f64>,
    /// The same of friction.
    warm_drag: BTreeMap<(u32, u32), drag::Dragged<D>>,
    partial: Partial<D>,
    slices: u64,
    /// Bodies that wait to be grouped into islands when cells and queue are ready.
    pending: Vec<u32>,
    /// The largest radius (m) of all bodies, where it is known: cells may have been made for more.
    largest: Option<f64>,
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
            due: Vec::new(),
            nulls: Vec::new(),
            any_null: false,
            cells: Cells::none(),
            crowding: 0.0,
            lists: Lists::default(),
            cell_scale: 1.0,
            queue: Calendar::default(),
            crew: Default::default(),
            everywhere: Vec::new(),
            wrapped_walls: false,
            held: BTreeMap::new(),
            grips: BTreeMap::new(),
            restless: 0,
            resting: 0,
            bound: 0,
            sides: [[None; 2]; D],
            instant: Instant::default(),
            plain: false,
            common_layers: 0,
            inverse_width: Vector::ZERO,
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
            law: Law::default(),
            system: System::new(),
            solver: Solver::new(),
            islands: Vec::new(),
            free_islands: Vec::new(),
            island_of: Vec::new(),
            island_turn: 0,
            warm: BTreeMap::new(),
            warm_drag: BTreeMap::new(),
            partial: Partial::default(),
            slices: 0,
            pending: Vec::new(),
            largest: None,
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

    /// The world with this law for one contact with friction, where a pair of materials names none of its own. Where several
    /// contacts share an instant, and where they last, friction is Coulomb's whatever the law.
    pub fn law(mut self, law: Law) -> Self {
        self.law = law;
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
                "a material's restitution must lie in [0, 1], its friction, rolling and spinning be >= 0, its tangential restitution lie in [-1, 1]",
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
                "a material's restitution must lie in [0, 1], its friction, rolling and spinning be >= 0, its tangential restitution lie in [-1, 1]",
            ));
        }
        self.store.materials.set_default(material);
        Ok(())
    }

    /// Sets what two materials say of each other, in place of what they combine to.
    ///
    /// # Errors
    /// [`Error::Stale`] for a material of another world, [`Error::OutOfRange`].
    pub fn pair(&mut self, a: MaterialId, b: MaterialId, line: impl Into<Pair>) -> Result<(), Error> {
        let line = line.into();
        self.known(a)?;
        self.known(b)?;
        if !line.says.is_valid() {
            return Err(Error::OutOfRange(
                "a pair's restitution must lie in [0, 1], its friction, rolling and spinning be >= 0, its tangential restitution lie in [-1, 1]",
            ));
        }
        self.store.materials.set_pair(a, b, line);
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
            Some(own) => self.store.materials.variant(base, own),
            None => base,
        })
    }
}
