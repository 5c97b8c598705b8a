//! How much memory a world holds.
use super::World;
use crate::{Rotates, Vector};
use alloc::vec::Vec;

/// The bytes that a list holds, used or not.
pub(super) fn held<T>(list: &Vec<T>) -> usize {
    list.capacity() * size_of::<T>()
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// The memory that bodies, cells, queue and reports hold (bytes), capacity that waits to be used included.
    pub fn bytes(&self) -> usize {
        let own = held(&self.next)
            + held(&self.turn)
            + held(&self.crossings)
            + held(&self.piles)
            + held(&self.nulls)
            + held(&self.island_of)
            + held(&self.everywhere)
            + held(&self.impacts)
            + held(&self.touches)
            + self.lists.bytes();
        own + self.store.bodies.bytes() + self.cells.bytes() + self.queue.bytes() + self.instant.bytes()
    }
}
