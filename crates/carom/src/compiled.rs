//! The worlds of one to three dimensions, compiled with the library in builds that check themselves: the compiler shares such code
//! with the crates that use it as long as it does not optimise for speed, and every test, tool and example would compile it again.
use crate::world::{Limits, Stop, World};
use crate::{Ball, Error, Ledger, Rotates, Vector, Wall};
use alloc::vec::Vec;

/// What most of a world hangs on.
type Roots<const D: usize> = (
    fn(&mut World<D>, &Limits<'_>) -> Stop,
    fn(&mut World<D>, f64) -> &[crate::Impact<D>],
    fn(&mut World<D>, Ball<D>) -> Result<crate::BodyId, Error>,
    fn(&mut World<D>, Wall<D>) -> Result<crate::WallId, Error>,
    fn(&mut World<D>, crate::BodyId) -> Result<(), Error>,
    fn(&World<D>) -> Ledger<D>,
    fn(&World<D>) -> Vec<u8>,
    fn(&[u8]) -> Result<World<D>, Error>,
);

fn roots<const D: usize>() -> Roots<D>
where
    Vector<D>: Rotates,
{
    (
        World::run,
        World::advance,
        World::add,
        World::add_wall,
        World::remove,
        World::ledger,
        World::snapshot,
        World::restore,
    )
}

/// Compiles them; nobody needs to call it.
#[doc(hidden)]
pub fn worlds() -> (Roots<1>, Roots<2>, Roots<3>) {
    (roots(), roots(), roots())
}
