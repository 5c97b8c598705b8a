//! The one store: a hot record for each body, everything else in side arrays; walls; materials.
use super::machine::in_large_pages;
use super::memory::{fit, held};
use super::rounds::MOST_ROUNDS;
use super::{Boundary, WALL};
use crate::codec::codec;
use crate::law::together::rub::Turning;
use crate::material::{Coefficients, Materials};
use crate::vector::Exact;
use crate::wall::Over;
use crate::{Ball, BodyId, Error, MaterialId, Rotates, Shape, Vector, WallId};
use alloc::{vec, vec::Vec};

/// What a prediction reads of a body: one cache line in space. Written only by an impact, a slice or the user, never by the
/// end of a frame, an output, or a cell crossing.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Record<const D: usize> {
    /// Position (m) at `time`, in the box along periodic axes.
    pub x: Vector<D>,
    /// Velocity (m/s) at `time`.
    pub v: Vector<D>,
    /// The time of the record (s).
    pub time: f64,
    pub radius: f64,
}

codec!(Record<D> { x, v, time, radius });

/// What moves a body between events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Motion {
    /// Gravity alone.
    Free,
    /// Nothing: a fixed or a driven body.
    Fixed,
    /// Held by its supports: accelerated as they leave it.
    Held,
    /// Held, or part of an island, and at rest for as long as nothing hits it.
    Resting,
    /// Slices: with others, or on something curved.
    Sliced,
}

codec!(enum Motion: [Motion::Free, Motion::Fixed, Motion::Held, Motion::Resting, Motion::Sliced]);

/// What an impact reads of a body besides its record: half a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Matter {
    /// One over the mass (1/kg); 0 for what nothing can move.
    pub inverse_mass: f64,
    pub mass: f64,
    pub material: MaterialId,
    /// Counts the records: a prediction that was made with another one is void.
    pub stamp: u32,
}

codec!(Matter { inverse_mass, mass, material, stamp });

#[derive(Debug)]
pub(crate) struct Bodies<const D: usize>
where
    Vector<D>: Rotates,
{
    pub record: Vec<Record<D>>,
    pub motion: Vec<Motion>,
    pub matter: Vec<Matter>,
    /// The acceleration of a held body (m/s^2).
    pub acceleration: Vec<Vector<D>>,
    /// How often the body has gone round each periodic axis.
    pub image: Vec<[i32; D]>,
    pub spin: Vec<<Vector<D> as Rotates>::Spin>,
    pub inertia: Vec<f64>,
    pub layers: Vec<(u32, u32)>,
    pub sensor: Vec<bool>,
    pub user: Vec<u64>,
    pub generation: Vec<u32>,
    pub alive: Vec<bool>,
    /// Places of removed bodies, the last one first to be used again.
    pub free: Vec<u32>,
}

codec!(Bodies<D> {
    record,
    motion,
    matter,
    acceleration,
    image,
    spin,
    inertia,
    layers,
    sensor,
    user,
    generation,
    alive,
    free,
});

/// Does the same to every list that has an element for each body.
macro_rules! each_list {
    ($bodies:ident, $does:path $(, $with:expr)?) => {
        $does(&mut $bodies.record $(, $with)?);
        $does(&mut $bodies.motion $(, $with)?);
        $does(&mut $bodies.matter $(, $with)?);
        $does(&mut $bodies.acceleration $(, $with)?);
        $does(&mut $bodies.image $(, $with)?);
        $does(&mut $bodies.spin $(, $with)?);
        $does(&mut $bodies.inertia $(, $with)?);
        $does(&mut $bodies.layers $(, $with)?);
        $does(&mut $bodies.sensor $(, $with)?);
        $does(&mut $bodies.user $(, $with)?);
        $does(&mut $bodies.generation $(, $with)?);
        $does(&mut $bodies.alive $(, $with)?);
    };
}

impl<const D: usize> Bodies<D>
where
    Vector<D>: Rotates,
{
    pub(crate) fn new() -> Self {
        Self {
            record: vec![],
            motion: vec![],
            matter: vec![],
            acceleration: vec![],
            image: vec![],
            spin: vec![],
            inertia: vec![],
            layers: vec![],
            sensor: vec![],
            user: vec![],
            generation: vec![],
            alive: vec![],
            free: vec![],
        }
    }

    /// The number of places, dead ones included.
    pub(crate) fn len(&self) -> usize {
        self.record.len()
    }

    /// The memory that the bodies hold (bytes).
    pub(crate) fn bytes(&self) -> usize {
        held(&self.record)
            + held(&self.motion)
            + held(&self.matter)
            + held(&self.acceleration)
            + held(&self.image)
            + held(&self.spin)
            + held(&self.inertia)
            + held(&self.layers)
            + held(&self.sensor)
            + held(&self.user)
            + held(&self.generation)
            + held(&self.alive)
            + held(&self.free)
    }

    /// Takes the memory that so many bodies more will need.
    pub(crate) fn reserve(&mut self, bodies: usize) {
        each_list!(self, Vec::reserve, bodies);
        in_large_pages(&self.record, false);
        in_large_pages(&self.matter, false);
    }

    /// Gives back memory that a growing world took ahead and does not use.
    pub(crate) fn fit(&mut self) {
        each_list!(self, fit);
    }

    pub(crate) fn living(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.len()).filter(|&i| self.alive[i])
    }

    pub(crate) fn id(&self, i: usize) -> BodyId {
        BodyId { index: i as u32, generation: self.generation[i] }
    }

    pub(crate) fn find(&self, id: BodyId) -> Result<usize, Error> {
        let i = id.index as usize;
        if i < self.len() && self.alive[i] && self.generation[i] == id.generation {
            Ok(i)
        } else {
            Err(Error::Stale("body"))
        }
    }

    /// Stores a ball that was checked. A place that a removed body left is used again.
    pub(crate) fn add(&mut self, ball: &Ball<D>, material: MaterialId, time: f64) -> Result<usize, Error> {
        let i = match self.free.pop() {
            Some(i) => i as usize,
            None => {
                if self.len() >= WALL as usize {
                    return Err(Error::Full);
                }
                let i = self.len();
                self.record.push(Record { x: Vector::ZERO, v: Vector::ZERO, time, radius: 0.0 });
                self.motion.push(Motion::Free);
                self.matter.push(Matter { inverse_mass: 0.0, mass: 0.0, material, stamp: 0 });
                self.acceleration.push(Vector::ZERO);
                self.image.push([0; D]);
                self.spin.push(Default::default());
                self.inertia.push(0.0);
                self.layers.push((0, 0));
                self.sensor.push(false);
                self.user.push(0);
                self.generation.push(0);
                self.alive.push(false);
                i
            }
        };
        self.record[i] = Record { x: ball.position, v: ball.velocity, time, radius: ball.radius };
        self.motion[i] = if ball.fixed { Motion::Fixed } else { Motion::Free };
        self.matter[i].inverse_mass = if ball.fixed { 0.0 } else { 1.0 / ball.mass };
        self.matter[i].mass = ball.mass;
        self.acceleration[i] = Vector::ZERO;
        self.image[i] = [0; D];
        self.spin[i] = ball.spin;
        self.inertia[i] = if ball.fixed { 0.0 } else { ball.inertia * ball.mass * ball.radius * ball.radius };
        self.matter[i].material = material;
        self.layers[i] = (ball.layers, ball.meets);
        self.sensor[i] = ball.sensor;
        self.user[i] = ball.user;
        self.alive[i] = true;
        self.matter[i].stamp = self.matter[i].stamp.wrapping_add(1);
        Ok(i)
    }

    pub(crate) fn remove(&mut self, i: usize) {
        self.alive[i] = false;
        self.generation[i] = self.generation[i].wrapping_add(1);
        self.matter[i].stamp = self.matter[i].stamp.wrapping_add(1);
        self.free.push(i as u32);
    }

    pub(crate) fn is_fixed(&self, i: usize) -> bool {
        self.motion[i] == Motion::Fixed
    }

    /// A body that moves, as the laws of friction see it.
    pub(crate) fn turning(&self, i: usize, velocity: Vector<D>, spin: <Vector<D> as Rotates>::Spin) -> Turning<D> {
        Turning { inverse_mass: self.matter[i].inverse_mass, inverse_inertia: 1.0 / self.inertia[i], velocity, spin }
    }

    /// True if two bodies can hit each other (or, where one is a sensor, tell of each other).
    #[inline]
    pub(crate) fn meets(&self, i: usize, j: usize) -> bool {
        let ((li, mi), (lj, mj)) = (self.layers[i], self.layers[j]);
        li & mj != 0 && lj & mi != 0
    }
}

/// A wall in the store.
#[derive(Clone, Debug)]
pub(crate) struct WallRecord<const D: usize> {
    /// The shape, where it stands at time `since`.
    pub shape: Shape<D>,
    pub velocity: Vector<D>,
    pub since: f64,
    pub material: MaterialId,
    pub generation: u32,
    pub alive: bool,
}

codec!(WallRecord<D> { shape, velocity, since, material, generation, alive });

impl<const D: usize> WallRecord<D> {
    /// How far the wall has come since its shape was written.
    #[inline]
    pub(crate) fn shift(&self, time: f64) -> Vector<D> {
        self.velocity * (time - self.since)
    }

    pub(crate) fn over(&self, time: f64, x: Vector<D>, radius: f64) -> Over<D> {
        let shift = self.shift(time);
        let mut over = self.shape.over(x - shift, radius);
        over.point += shift;
        over
    }
}

#[derive(Debug)]
pub(crate) struct Store<const D: usize>
where
    Vector<D>: Rotates,
{
    pub bodies: Bodies<D>,
    pub walls: Vec<WallRecord<D>>,
    pub materials: Materials,
    pub gravity: Vector<D>,
    pub weightless: bool,
    /// Every body moves uniformly between events: no gravity, and nothing in slices so far.
    pub uniform: bool,
    pub boundary: Boundary<D>,
    /// Widths of the box along periodic axes.
    pub width: Vector<D>,
    pub periodic: [bool; D],
    pub any_periodic: bool,
    /// Pairs that the user wants to pass through each other, sorted, smaller id first.
    pub ignored: Vec<(u32, u32)>,
}

codec!(Store<D> {
    bodies,
    walls,
    materials,
    gravity,
    weightless,
    uniform,
    boundary,
    width,
    periodic,
    any_periodic,
    ignored,
});

impl<const D: usize> Store<D>
where
    Vector<D>: Rotates,
{
    pub(crate) fn wall_id(&self, w: usize) -> WallId {
        WallId { index: w as u32, generation: self.walls[w].generation }
    }

    pub(crate) fn find_wall(&self, id: WallId) -> Result<usize, Error> {
        let w = id.index as usize;
        match self.walls.get(w) {
            Some(wall) if wall.alive && wall.generation == id.generation => Ok(w),
            _ => Err(Error::Stale("wall")),
        }
    }

    /// The acceleration of a body between events (m/s^2).
    #[inline(always)]
    pub(crate) fn acceleration(&self, i: usize) -> Vector<D> {
        match self.bodies.motion[i] {
            Motion::Free => self.gravity,
            Motion::Held | Motion::Sliced => self.bodies.acceleration[i],
            Motion::Fixed | Motion::Resting => Vector::ZERO,
        }
    }

    /// Where a body is at a time, and how fast: exact, from its record. Along periodic axes the position is not taken back
    /// into the box.
    #[inline(always)]
    pub(crate) fn at(&self, i: usize, time: f64) -> (Vector<D>, Vector<D>) {
        let r = &self.bodies.record[i];
        let dt = time - r.time;
        if self.uniform || dt == 0.0 {
            return (r.x + r.v * dt, r.v);
        }
        let a = self.acceleration(i);
        (r.x + (r.v + a * (0.5 * dt)) * dt, r.v + a * dt)
    }

    /// How many box widths bring a position back into the box, at most [`MOST_ROUNDS`]. A pure function of the position.
    #[inline]
    pub(crate) fn turns(&self, x: Vector<D>) -> [i32; D] {
        match self.is_inside(x) {
            true => [0; D],
            false => self.turns_outside(x),
        }
    }

    /// True if a place lies in the box, along every axis that is periodic.
    #[inline(always)]
    pub(crate) fn is_inside(&self, x: Vector<D>) -> bool {
        let mut inside = true;
        for k in 0..D {
            let over = x[k] - self.boundary.min[k];
            // The quotient of a smaller number and a larger one is below 1, rounded or not.
            inside &= !self.periodic[k] || over >= 0.0 && over < self.width[k];
        }
        inside
    }

    #[inline(never)]
    fn turns_outside(&self, x: Vector<D>) -> [i32; D] {
        core::array::from_fn(|k| {
            if !self.periodic[k] {
                return 0;
            }
            let n = libm::floor((x[k] - self.boundary.min[k]) / self.width[k]);
            let most = f64::from(MOST_ROUNDS);
            // NaN stays where it is.
            if n.abs_() < most { n as i32 } else { (n as i32).clamp(-MOST_ROUNDS, MOST_ROUNDS) }
        })
    }

    /// A position taken back by so many box widths.
    pub(crate) fn wrapped(&self, x: Vector<D>, turns: [i32; D]) -> Vector<D> {
        if !self.any_periodic {
            return x;
        }
        Vector::from_fn(|k| if turns[k] == 0 { x[k] } else { x[k] - f64::from(turns[k]) * self.width[k] })
    }

    /// So many box widths, as a vector.
    #[inline(always)]
    pub(crate) fn widths(&self, turns: [i32; D]) -> Vector<D> {
        Vector::from_fn(|k| if self.periodic[k] { f64::from(turns[k]) * self.width[k] } else { 0.0 })
    }

    /// The shortest of the images of a vector between two bodies.
    pub(crate) fn nearest_image(&self, d: Vector<D>) -> Vector<D> {
        if !self.any_periodic {
            return d;
        }
        Vector::from_fn(
            |k| {
                if self.periodic[k] { d[k] - libm::rint(d[k] / self.width[k]) * self.width[k] } else { d[k] }
            },
        )
    }

    /// True if two bodies can exchange an impulse: in each other's layers, not both immovable, not ignored.
    #[inline]
    pub(crate) fn collide(&self, i: usize, j: usize) -> bool {
        let b = &self.bodies;
        b.meets(i, j)
            && !b.sensor[i]
            && !b.sensor[j]
            && (b.matter[i].inverse_mass > 0.0 || b.matter[j].inverse_mass > 0.0)
            && !self.ignores(i, j)
    }

    pub(crate) fn ignores(&self, i: usize, j: usize) -> bool {
        if self.ignored.is_empty() {
            return false;
        }
        let (i, j) = (i as u32, j as u32);
        self.ignored.binary_search(&if i < j { (i, j) } else { (j, i) }).is_ok()
    }

    /// True if some surfaces rub: where none does, nothing of friction and spin is computed.
    #[inline(always)]
    pub(crate) fn rough(&self) -> bool {
        D > 1 && self.materials.is_rough()
    }

    /// What two surfaces say of an impact at this approach speed.
    #[inline]
    pub(crate) fn coefficients(&self, a: MaterialId, b: MaterialId, approach: f64) -> Coefficients {
        self.materials.between(a, b, approach, 0.0)
    }
}
