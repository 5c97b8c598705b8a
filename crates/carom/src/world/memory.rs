//! How much memory a world holds.
use super::World;
use crate::{Rotates, Vector};
use alloc::vec::Vec;

/// The bytes that a list holds, used or not.
pub(super) fn held<T>(list: &Vec<T>) -> usize {
    list.capacity() * size_of::<T>()
}

/// Gives back what a list holds and does not use, where that is more than an eighth.
pub(super) fn fit<T>(list: &mut Vec<T>) {
    if list.capacity() - list.len() > list.len() / 8 + 64 {
        list.shrink_to_fit();
    }
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// Gives back memory that a growing world took ahead and does not use.
    pub(super) fn fit(&mut self) {
        self.store.bodies.fit();
        fit(&mut self.due);
        fit(&mut self.nulls);
        fit(&mut self.island_of);
    }

    /// The memory that bodies, cells, queue and reports hold (bytes), capacity that waits to be used included.
    pub fn bytes(&self) -> usize {
        let own = held(&self.due)
            + held(&self.nulls)
            + held(&self.island_of)
            + held(&self.everywhere)
            + held(&self.impacts)
            + held(&self.touches)
            + self.lists.bytes();
        own + self.store.bodies.bytes() + self.cells.bytes() + self.queue.bytes() + self.instant.bytes()
    }
}
