//! Looking at a world without changing it: states, rays, overlaps, the digest.
use alloc::vec::Vec;

use super::World;
use super::store::Motion;
use crate::meet;
use crate::report::{Impact, Party, Touch};
use crate::{BodyId, Error, Rotates, Shape, Vector, WallId};

/// What a ray hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<const D: usize> {
    /// Who.
    pub party: Party,
    /// How far along the ray (m).
    pub distance: f64,
    /// Where (m).
    pub point: Vector<D>,
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// The time (s).
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The impacts of the last [`World::advance`] or [`World::run`], in order.
    pub fn impacts(&self) -> &[Impact<D>] {
        &self.impacts
    }

    /// Who entered a sensor during the last [`World::advance`] or [`World::run`], in order.
    pub fn touches(&self) -> &[Touch] {
        &self.touches
    }

    /// How many impacts there have been.
    pub fn impact_count(&self) -> u64 {
        self.impact_count
    }

    /// How many events there have been: instants with impacts, cell crossings, ends of supports.
    pub fn event_count(&self) -> u64 {
        self.events + self.crossed
    }

    /// How many slices islands in lasting contact have moved by.
    pub fn slice_count(&self) -> u64 {
        self.slices
    }

    /// Whether impacts are kept for [`World::impacts`] (they are); a gas that only wants its totals saves the work.
    pub fn keep_reports(&mut self, keep: bool) {
        self.keep_reports = keep;
    }

    /// The bodies, in the order of their places.
    pub fn bodies(&self) -> impl Iterator<Item = BodyId> + '_ {
        self.store.bodies.living().map(|i| self.store.bodies.id(i))
    }

    /// The walls, the boundary's sides included, in the order of their places.
    pub fn walls(&self) -> impl Iterator<Item = WallId> + '_ {
        (0..self.store.walls.len()).filter(|&w| self.store.walls[w].alive).map(|w| self.store.wall_id(w))
    }

    /// Where a body's centre is now (m); along periodic axes, in the box.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn position(&self, id: BodyId) -> Result<Vector<D>, Error> {
        let x = self.state_now(self.store.bodies.find(id)?).0;
        Ok(self.store.wrapped(x, self.store.turns(x)))
    }

    /// Where a body's centre is now (m), its rounds of the box along periodic axes counted: what a displacement is
    /// measured with.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn unwrapped_position(&self, id: BodyId) -> Result<Vector<D>, Error> {
        let i = self.store.bodies.find(id)?;
        Ok(self.state_now(i).0 + self.store.widths(self.store.bodies.image[i]))
    }

    /// How fast a body moves now (m/s).
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn velocity(&self, id: BodyId) -> Result<Vector<D>, Error> {
        Ok(self.state_now(self.store.bodies.find(id)?).1)
    }

    /// How fast a body turns now (rad/s).
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn spin(&self, id: BodyId) -> Result<<Vector<D> as Rotates>::Spin, Error> {
        Ok(self.spin_now(self.store.bodies.find(id)?))
    }

    /// A body's mass (kg); infinite for a fixed body that was given none.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn mass(&self, id: BodyId) -> Result<f64, Error> {
        Ok(self.store.bodies.matter[self.store.bodies.find(id)?].mass)
    }

    /// A body's radius (m).
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn radius(&self, id: BodyId) -> Result<f64, Error> {
        Ok(self.store.bodies.record[self.store.bodies.find(id)?].radius)
    }

    /// The shape of a wall, where it stands now.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn shape(&self, id: WallId) -> Result<Shape<D>, Error> {
        let wall = &self.store.walls[self.store.find_wall(id)?];
        Ok(wall.shape.shifted(wall.shift(self.time)))
    }

    /// The number that the user keeps with a body.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn user(&self, id: BodyId) -> Result<u64, Error> {
        Ok(self.store.bodies.user[self.store.bodies.find(id)?])
    }

    /// True if a body is fixed (or driven).
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn is_fixed(&self, id: BodyId) -> Result<bool, Error> {
        Ok(self.store.bodies.motion[self.store.bodies.find(id)?] == Motion::Fixed)
    }

    /// True if a body rests on something until something hits it.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn rests(&self, id: BodyId) -> Result<bool, Error> {
        Ok(self.is_resting(self.store.bodies.find(id)?))
    }

    /// The first body or wall that a ray from `origin` (m) along `direction` (any length but 0) hits within `reach` (m). A ray
    /// that starts inside a ball does not hit it; rays do not go round periodic axes. Looks at every body and wall.
    pub fn ray(&self, origin: impl Into<Vector<D>>, direction: impl Into<Vector<D>>, reach: f64) -> Option<Hit<D>> {
        let origin = origin.into();
        let direction = direction.into().unit()?;
        let mut first: Option<Hit<D>> = None;
        let mut offer = |party, distance: f64| {
            if distance <= reach && first.is_none_or(|hit| distance < hit.distance) {
                first = Some(Hit { party, distance, point: origin + direction * distance });
            }
        };
        for i in self.store.bodies.living() {
            let x = self.state_now(i).0;
            let x = self.store.wrapped(x, self.store.turns(x));
            let radius = self.store.bodies.record[i].radius;
            if (x - origin).norm() > radius {
                offer(Party::Body(self.store.bodies.id(i)), meet::ball_ball(x - origin, -direction, radius));
            }
        }
        for (w, wall) in self.store.walls.iter().enumerate().filter(|(_, wall)| wall.alive) {
            offer(Party::Wall(self.store.wall_id(w)), wall.shape.crossed_by(origin - wall.shift(self.time), direction));
        }
        first
    }

    /// The bodies that a ball of `radius` (m) at `centre` would overlap, in order; in any image of the box. Looks at every
    /// body.
    pub fn overlapping(&self, centre: impl Into<Vector<D>>, radius: f64) -> Vec<BodyId> {
        let centre = centre.into();
        let touches = |&i: &usize| {
            let d = self.store.nearest_image(self.state_now(i).0 - centre);
            d.norm() < radius + self.store.bodies.record[i].radius
        };
        self.store.bodies.living().filter(touches).map(|i| self.store.bodies.id(i)).collect()
    }

    /// The deepest overlap there is now between two bodies or a body and a wall, divided by the smaller radius; 0 if there is
    /// none.
    pub fn deepest_overlap(&mut self) -> f64 {
        if !self.ready {
            self.prepare();
        }
        let s = &self.store;
        let mut deepest = 0.0;
        for i in s.bodies.living() {
            let (x, _) = self.state_now(i);
            let radius = s.bodies.record[i].radius;
            self.cells.near(i as u32, None, |j, turns| {
                let j = j as usize;
                if j > i && s.collide(i, j) {
                    let d = self.state_now(j).0 - x + s.widths(turns);
                    let other = s.bodies.record[j].radius;
                    let depth = (radius + other - d.norm()) / if radius < other { radius } else { other };
                    deepest = if depth > deepest { depth } else { deepest };
                }
            });
            if s.bodies.matter[i].inverse_mass == 0.0 || s.bodies.sensor[i] {
                continue;
            }
            let x = s.wrapped(x, s.turns(x));
            for wall in s.walls.iter().filter(|wall| wall.alive) {
                let depth = -wall.over(self.time, x, radius).gap / radius;
                deepest = if depth > deepest { depth } else { deepest };
            }
        }
        if deepest > self.books.overlap {
            self.books.overlap = deepest;
        }
        deepest
    }

    /// A hash (64-bit FNV-1a) of the bits of time, positions, velocities and spins, in the order of the bodies. Two runs with
    /// equal digests agree to the last bit.
    pub fn digest(&self) -> u64 {
        let mut hash = 0xcbf2_9ce4_8422_2325u64;
        let mut add = |x: f64| {
            for byte in x.to_bits().to_le_bytes() {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
            }
        };
        add(self.time);
        for i in self.store.bodies.living() {
            let (x, v) = self.state_now(i);
            self.store.wrapped(x, self.store.turns(x)).0.into_iter().for_each(&mut add);
            v.0.into_iter().for_each(&mut add);
            Vector::<D>::spin_slice(&self.spin_now(i)).iter().copied().for_each(&mut add);
        }
        hash
    }
}
