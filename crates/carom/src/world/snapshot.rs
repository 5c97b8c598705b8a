//! A world as bytes, and back: everything that the bits of its future depend on.
//!
//! What is a pure function of the rest is made anew: cells, queue and predictions ([`prepare`](super::prepare)), and what is
//! read of slices under way. So a snapshot does not depend on how meetings are found.
use alloc::vec::Vec;

use super::pile::Null;
use super::slices::{Island, NO_ISLAND};
use super::store::Motion;
use super::{WALL, World};
use crate::codec::{Codec, Hash, Reader, codec};
use crate::{Error, MaterialId, Rotates, Vector};

/// The first bytes of every snapshot.
const MAGIC: &[u8; 8] = b"carom-w1";

const TORN: Error = Error::Snapshot("these bytes are no snapshot of a world, or they are damaged");
const DIMENSION: Error = Error::Snapshot("this is a snapshot of a world of another dimension");
const LAYOUT: Error = Error::Snapshot("this snapshot was made by another version of the engine");

// Every field stands in one of the two lists, or this does not compile.
codec!(World<D> {
    time,
    rest_speed,
    store,
    due,
    nulls,
    cell_scale,
    held,
    grips,
    sides,
    books,
    told,
    keep_reports,
    impact_count,
    events,
    crossed,
    broken,
    crushed,
    together,
    law,
    islands,
    free_islands,
    island_of,
    island_turn,
    warm,
    warm_drag,
    slices,
    pending,
} anew {
    any_null,
    cells,
    crowding,
    lists,
    queue,
    crew,
    everywhere,
    wrapped_walls,
    restless,
    resting,
    bound,
    instant,
    plain,
    common_layers,
    inverse_width,
    ready,
    impacts,
    touches,
    system,
    solver,
    partial,
    largest,
}: Self::new());

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// The world as bytes, for [`World::restore`]: a restored world goes on exactly as this one does, to the last bit. The
    /// impacts and touches of the last call are not in it.
    ///
    /// About 70 bytes a body in a gas in the plane, 130 in a heap. Snapshots are for the version of the engine that
    /// made them; another one refuses them if it keeps other things.
    ///
    /// ```
    /// use carom::{Ball, Wall, World};
    /// let mut world = World::<2>::new().gravity([0.0, -9.81]);
    /// world.wall(Wall::plane([0.0, 0.0], [0.0, 1.0]));
    /// world.ball(Ball::new(1.0, 0.1).at([0.0, 2.0]).restitution(0.8));
    /// world.advance(1.0);
    /// let mut again = World::<2>::restore(&world.snapshot())?;
    /// assert_eq!(world.advance(1.0), again.advance(1.0));
    /// assert_eq!(world.digest(), again.digest());
    /// # Ok::<(), carom::Error>(())
    /// ```
    pub fn snapshot(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        bytes.extend_from_slice(MAGIC);
        bytes.push(D as u8);
        bytes.extend_from_slice(&layout::<D>().to_le_bytes());
        self.write(&mut bytes);
        let seal = sealed(&bytes);
        bytes.extend_from_slice(&seal.to_le_bytes());
        bytes
    }

    /// The world of a [`World::snapshot`].
    ///
    /// # Errors
    /// [`Error::Snapshot`] for bytes that are none, are damaged, or come from another dimension or version.
    pub fn restore(bytes: &[u8]) -> Result<Self, Error> {
        let (body, seal) = bytes.split_last_chunk::<8>().ok_or(TORN)?;
        let (magic, rest) = body.split_first_chunk::<8>().ok_or(TORN)?;
        let (&dim, rest) = rest.split_first().ok_or(TORN)?;
        let (made, rest) = rest.split_first_chunk::<8>().ok_or(TORN)?;
        if magic != MAGIC || sealed(body) != u64::from_le_bytes(*seal) {
            return Err(TORN);
        }
        if usize::from(dim) != D {
            return Err(DIMENSION);
        }
        if u64::from_le_bytes(*made) != layout::<D>() {
            return Err(LAYOUT);
        }
        let mut from = Reader::new(rest);
        let mut world = Self::read(&mut from).filter(|world| from.is_empty() && world.is_sound()).ok_or(TORN)?;
        let motions: Vec<Motion> = world.store.bodies.living().map(|i| world.store.bodies.motion[i]).collect();
        world.resting = motions.iter().filter(|&&m| m == Motion::Resting).count();
        world.bound = motions.iter().filter(|m| !matches!(m, Motion::Free | Motion::Fixed)).count();
        world.restless = motions.iter().filter(|&&m| !matches!(m, Motion::Resting | Motion::Fixed)).count();
        world.read_slices();
        Ok(world)
    }

    /// True if every number that leads somewhere leads to something, so that no bytes can make the engine panic.
    fn is_sound(&self) -> bool {
        let b = &self.store.bodies;
        let (n, walls) = (b.record.len(), self.store.walls.len());
        let lengths = [
            b.motion.len(),
            b.matter.len(),
            b.acceleration.len(),
            b.image.len(),
            b.spin.len(),
            b.inertia.len(),
            b.layers.len(),
            b.sensor.len(),
            b.user.len(),
            b.generation.len(),
            b.alive.len(),
            self.due.len(),
            self.nulls.len(),
            self.island_of.len(),
        ];
        if n >= WALL as usize || walls >= (WALL - 8) as usize || lengths.iter().any(|&length| length != n) {
            return false;
        }
        let body = |i: u32| (i as usize) < n && b.alive[i as usize];
        let wall = |w: u32| (w as usize) < walls;
        let moves = |i: u32| body(i) && b.matter[i as usize].inverse_mass > 0.0;
        let material = |id: MaterialId| self.store.materials.get(id).is_some();
        let records = (0..n).all(|i| {
            let r = &b.record[i];
            let finite = r.x.is_finite() && r.v.is_finite() || self.broken;
            finite && r.time.is_finite() && r.radius >= 0.0 && r.radius.is_finite() && material(b.matter[i].material)
        });
        let axes =
            (0..D).all(|k| !self.store.periodic[k] || self.store.width[k] > 0.0 && self.store.width[k].is_finite());
        let island = |k: usize, island: &Island<D>| {
            let member = |i: u32| island.bodies.binary_search(&i).is_ok();
            let sides = |a: u32, b: u32| {
                member(a) && (if b & WALL != 0 { wall(b & !WALL) } else { body(b) && (member(b) || !moves(b)) })
            };
            let planned = island.planned.as_ref().is_none_or(|p| {
                let (bodies, near) = (island.bodies.len(), island.near.len());
                (p.x.len(), p.v.len(), p.spin.len(), p.lambda.len()) == (bodies, bodies, bodies, near)
                    && (p.drag.is_empty() || p.drag.len() == near)
            });
            island.bodies.windows(2).all(|w| w[0] < w[1])
                && island.bodies.iter().all(|&i| moves(i) && (!island.alive || self.island_of[i as usize] == k as u32))
                && island.near.iter().all(|n| sides(n.a, n.b))
                && (island.lambda.len(), island.before.len()) == (island.near.len(), island.bodies.len())
                && (island.drag.is_empty() || island.drag.len() == island.near.len())
                && (island.start + island.length).is_finite()
                && planned
        };
        let lies = |i: usize| match self.island_of[i] {
            NO_ISLAND => true,
            k => self.islands.get(k as usize).is_some_and(|k| k.alive && k.bodies.binary_search(&(i as u32)).is_ok()),
        };
        records
            && axes
            && self.time >= 0.0
            && self.time.is_finite()
            && self.store.gravity.is_finite()
            && self.store.materials.is_sound()
            && self.store.walls.iter().all(|w| material(w.material) && w.velocity.is_finite() && w.since.is_finite())
            && self.store.ignored.iter().all(|&(i, j)| i < j && body(i) && body(j))
            && b.free.iter().all(|&i| (i as usize) < n && !b.alive[i as usize])
            && self.nulls.iter().all(Null::is_sound)
            && self.held.iter().all(|(&i, walls)| body(i) && walls.iter().all(|&w| wall(w)))
            && self.grips.keys().all(|&i| body(i))
            && self.sides.iter().flatten().flatten().all(|&w| wall(w))
            && self.islands.iter().enumerate().all(|(k, i)| island(k, i))
            && self.free_islands.iter().all(|&k| self.islands.get(k as usize).is_some_and(|k| !k.alive))
            && (0..n).all(lies)
            && self.pending.iter().all(|&i| moves(i))
    }
}

/// What a world of this version is made of.
fn layout<const D: usize>() -> u64
where
    Vector<D>: Rotates,
{
    let mut hash = Hash::new();
    World::<D>::layout(&mut hash);
    hash.0
}

fn sealed(bytes: &[u8]) -> u64 {
    let mut hash = Hash::new();
    hash.add(bytes);
    hash.0
}
