//! Rounds of a periodic box, and who makes more of them than can be told.
//!
//! A body's record stays as it is while the body goes round and round; its place in the box is what is left of the way it went when
//! whole widths are taken off. After n rounds that is known to n 2^-53 of a width, and between two neighbouring numbers of the clock
//! the body moves by its speed times their distance. Where either comes to nothing that deserves to be called a place, the run stops
//! itself, instead of counting rounds for ever.
use super::World;
use super::run::{Limits, Stop};
use crate::{Rotates, Vector};

/// Rounds since a body's record was written, along one axis. Its place is then known to 1e-7 of a width; and the difference of two
/// such numbers is still one of 32 bits.
pub(super) const MOST_ROUNDS: i32 = 1_000_000_000;

/// Rounds at one instant, per body. One that moves as the clock can tell makes none or, where it turns back at the edge, a few; one
/// that goes round between two neighbouring numbers of the clock makes them without an end, and the clock stands still.
pub(super) const ROUNDS_AT_ONCE: u64 = 64;

/// True if a body went round more often than its place can tell.
#[inline]
pub(super) fn is_beyond<const D: usize>(rounds: &[i32; D]) -> bool {
    rounds.iter().any(|&n| n >= MOST_ROUNDS || n <= -MOST_ROUNDS)
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// The clock stands still while a body crosses and crosses. Lists of neighbours are left for cells, which in an open world end;
    /// otherwise nobody can tell where that body is.
    pub(super) fn outrun(&mut self) {
        if self.lists.on {
            self.lists.short = true;
        } else {
            self.broken = true;
        }
    }

    /// Nothing can ever meet again, though bodies go round: they are put where they will be.
    pub(super) fn coast(&mut self, limits: &Limits<'_>, end: f64) -> Stop {
        let stop = self.nothing_left(limits, end);
        if end.is_finite() {
            self.prepare();
        }
        if self.broken { Stop::NotFinite } else { stop }
    }
}
