//! What the user changes between two calls: bodies and walls come, go, and are given other states. A change is written at the
//! present time, wakes what leaned on it, and is entered into the books as the user's.
use alloc::vec::Vec;

use super::machine::in_large_pages;
use super::pile::{Null, Pile};
use super::rounds::is_beyond;
use super::slices::NO_ISLAND;
use super::store::{Motion, WallRecord};
use super::{Due, WALL, World};
use crate::{Ball, BodyId, Error, Rotates, Vector, Wall, WallId};

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// Adds a ball that is known to be sound.
    ///
    /// # Panics
    /// If it is not; [`World::add`] returns an error instead.
    #[track_caller]
    pub fn ball(&mut self, ball: Ball<D>) -> BodyId {
        match self.add(ball) {
            Ok(id) => id,
            Err(why) => panic!("World::ball: {why} (World::add returns an error instead)"),
        }
    }

    /// Adds a wall that is known to be sound.
    ///
    /// # Panics
    /// If it is not; [`World::add_wall`] returns an error instead.
    #[track_caller]
    pub fn wall(&mut self, wall: Wall<D>) -> WallId {
        match self.add_wall(wall) {
            Ok(id) => id,
            Err(why) => panic!("World::wall: {why} (World::add_wall returns an error instead)"),
        }
    }

    /// Takes the memory that so many bodies more will need, at once: a large world is made faster that way.
    ///
    /// ```
    /// use carom::{Ball, World};
    /// let mut world = World::<3>::new();
    /// world.reserve(1000);
    /// for k in 0..1000 {
    ///     world.ball(Ball::new(1.0, 0.5).at([(k % 10) as f64, (k / 10 % 10) as f64, (k / 100) as f64]));
    /// }
    /// assert_eq!(world.bodies().count(), 1000);
    /// ```
    pub fn reserve(&mut self, bodies: usize) {
        self.store.bodies.reserve(bodies);
        self.due.reserve(bodies);
        self.nulls.reserve(bodies);
        self.island_of.reserve(bodies);
        in_large_pages(&self.due, false);
    }

    /// Adds a ball, now. It may touch others; where it overlaps them, they part if they move apart and collide if they close.
    ///
    /// # Errors
    /// What [`Ball::check`] finds, a stale material, [`Error::Boundary`] if a periodic box is narrower than four radii or the
    /// ball lies 1,000,000,000 of its widths or more beyond it,
    /// [`Error::Full`].
    pub fn add(&mut self, ball: Ball<D>) -> Result<BodyId, Error> {
        ball.check()?;
        for k in 0..D {
            if self.store.periodic[k] && !(self.store.width[k] >= 4.0 * ball.radius) {
                return Err(Error::Boundary("a periodic box must be at least four radii wide"));
            }
        }
        self.within_rounds(ball.position)?;
        let material = self.surface(ball.material, &ball.restitution)?;
        let i = self.store.bodies.add(&ball, material, self.time)?;
        let turns = self.store.turns(ball.position);
        let x = self.store.wrapped(ball.position, turns);
        self.store.bodies.record[i].x = x;
        self.store.bodies.image[i] = turns;
        if !ball.fixed {
            self.restless += 1;
        }
        if self.due.len() <= i {
            self.due.resize(i + 1, Due::new(Pile::default()));
            self.nulls.resize(i + 1, Null::default());
            self.island_of.resize(i + 1, NO_ISLAND);
        }
        self.due[i].pile = Pile::default();
        self.nulls[i] = Null::default();
        self.book_user(i, 1.0);
        self.keep_plain(i);
        self.largest = None;
        if self.ready && self.cells.fits(ball.radius) {
            self.cells.insert(i as u32, x, [0; D]);
            self.list_anew(i, x);
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
            self.unlist(i);
        }
        self.due[i].turn = self.due[i].turn.wrapping_add(1);
        self.store.ignored.retain(|pair| pair.0 != i as u32 && pair.1 != i as u32);
        self.store.bodies.remove(i);
        self.largest = None;
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
    pub(super) fn wake(&mut self, k: usize) {
        if self.islands[k].alive {
            let bodies = self.dissolve(k, self.time);
            self.pending.extend(bodies);
        }
    }

    /// Wakes all that lies with body `i`, or that it carries as a fixed body; the body itself leaves the slices.
    pub(super) fn disturb(&mut self, i: usize) {
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
    pub(super) fn group_pending(&mut self) {
        if self.ready {
            let pending = core::mem::take(&mut self.pending);
            if !pending.is_empty() {
                self.regroup(self.time, pending);
            }
            self.read_slices();
        }
    }

    pub(super) fn release(&mut self, w: usize) {
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
    pub(super) fn renew(&mut self, i: usize) {
        let (x, v) = self.store.at(i, self.time);
        self.write(i, self.time, x, v);
    }

    /// A change by the user to the body `i`: books what it had with a minus and what it has with a plus.
    pub(super) fn change(&mut self, id: BodyId, apply: impl FnOnce(&mut Self, usize)) -> Result<(), Error> {
        let i = self.store.bodies.find(id)?;
        self.disturb(i);
        self.renew(i);
        self.book_user(i, -1.0);
        if !self.store.bodies.is_fixed(i) {
            self.set_motion(i, Motion::Free);
        }
        apply(self, i);
        self.nulls[i] = Null::default();
        self.largest = None;
        self.keep_plain(i);
        self.store.bodies.matter[i].stamp = self.store.bodies.matter[i].stamp.wrapping_add(1);
        self.book_user(i, 1.0);
        if self.ready && self.cells.fits(self.store.bodies.record[i].radius) {
            self.cells.remove(i as u32);
            let x = self.store.bodies.record[i].x;
            self.cells.insert(i as u32, x, [0; D]);
            self.list_anew(i, x);
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
    /// [`Error::Stale`], [`Error::NotFinite`], [`Error::Boundary`] if it lies 1,000,000,000 widths or more beyond a periodic box.
    pub fn set_position(&mut self, id: BodyId, position: impl Into<Vector<D>>) -> Result<(), Error> {
        let position = position.into();
        if !position.is_finite() {
            return Err(Error::NotFinite("position"));
        }
        self.within_rounds(position)?;
        self.change(id, |world, i| {
            let turns = world.store.turns(position);
            world.store.bodies.record[i].x = world.store.wrapped(position, turns);
            world.store.bodies.image[i] = turns;
        })
    }

    /// What lies further from a periodic box than rounds are counted has no place in it.
    fn within_rounds(&self, position: Vector<D>) -> Result<(), Error> {
        if is_beyond(&self.store.turns(position)) {
            return Err(Error::Boundary("a position must lie within 1,000,000,000 widths of a periodic box"));
        }
        Ok(())
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

    /// Lets two bodies pass through each other (`true`), or meet again. A body and itself never meet: nothing happens.
    ///
    /// # Errors
    /// [`Error::Stale`].
    pub fn ignore(&mut self, a: BodyId, b: BodyId, ignored: bool) -> Result<(), Error> {
        let (i, j) = (self.store.bodies.find(a)? as u32, self.store.bodies.find(b)? as u32);
        if i == j {
            return Ok(());
        }
        let pair = if i < j { (i, j) } else { (j, i) };
        match (self.store.ignored.binary_search(&pair), ignored) {
            (Err(k), true) => self.store.ignored.insert(k, pair),
            (Ok(k), false) => {
                self.store.ignored.remove(k);
            }
            _ => return Ok(()),
        }
        self.plain &= self.store.ignored.is_empty();
        self.change(a, |_, _| {})?;
        self.change(b, |_, _| {})
    }
}
