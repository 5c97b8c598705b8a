//! Key snapshots of the world that has run ahead, so that going back costs a short way instead of the whole run.
//!
//! A restored world goes on to the very same bits, so that it does not matter from which key a time is reached. The keys lie evenly
//! by what there is to compute, impacts and slices, not by time. When they are many every second one goes.
use carom::{Rotates, Vector, World};

/// The work between the first keys, in impacts and slices.
const SPACING: u64 = 64;
/// So many keys at most,
const MOST: usize = 64;
/// of so many bytes together at most.
const MOST_BYTES: usize = 16 << 20;

/// What was kept of a run, in the order of time.
#[derive(Debug)]
pub(crate) struct Keys {
    kept: Vec<(f64, Vec<u8>)>,
    bytes: usize,
    spacing: u64,
    /// The work that is done when the next key is due.
    due: u64,
}

impl Keys {
    pub fn new() -> Self {
        Self { kept: Vec::new(), bytes: 0, spacing: SPACING, due: SPACING }
    }

    /// Keeps the world as it is if enough was computed since the last key.
    pub fn pass<const D: usize>(&mut self, world: &World<D>)
    where
        Vector<D>: Rotates,
    {
        let done = world.impact_count() + world.slice_count();
        if done < self.due {
            return;
        }
        let bytes = world.snapshot();
        if bytes.len() > MOST_BYTES {
            self.due = u64::MAX;
            return;
        }
        self.bytes += bytes.len();
        self.kept.push((world.time(), bytes));
        while self.kept.len() > MOST || self.bytes > MOST_BYTES {
            let mut turn = false;
            self.kept.retain(|_| {
                turn = !turn;
                !turn
            });
            self.bytes = self.kept.iter().map(|k| k.1.len()).sum();
            self.spacing *= 2;
        }
        self.due = done + self.spacing;
    }

    /// The last world not after `time` and, if one is named, after `later_than`.
    pub fn before<const D: usize>(&self, time: f64, later_than: Option<f64>) -> Option<World<D>>
    where
        Vector<D>: Rotates,
    {
        let n = self.kept.partition_point(|key| key.0 <= time);
        let (at, bytes) = self.kept.get(n.checked_sub(1)?)?;
        if later_than.is_some_and(|t| *at <= t) {
            return None;
        }
        World::restore(bytes).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use carom::{Ball, Limits, Wall};

    /// Three balls under gravity in a corner, e below 1: impacts, then slices when they lie.
    fn world() -> World<2> {
        let mut world = World::<2>::new().gravity([0.0, -9.81]);
        world.wall(Wall::plane([0.0, 0.0], [0.0, 1.0]));
        world.wall(Wall::plane([0.0, 0.0], [1.0, 0.0]));
        world.wall(Wall::plane([2.0, 0.0], [-1.0, 0.0]));
        for (k, x) in [0.4, 1.0, 1.6].into_iter().enumerate() {
            let y = 1.0 + 0.3 * k as f64;
            world.ball(Ball::new(1.0 + k as f64, 0.2).at([x, y]).moving([1.0 - k as f64, 0.5]).restitution(0.9));
        }
        world
    }

    #[test]
    fn a_key_goes_on_as_the_straight_run_does() {
        let (mut ahead, mut keys) = (world(), Keys::new());
        keys.due = 8;
        keys.spacing = 8;
        for _ in 0..40 {
            let most = ahead.impact_count() + 4;
            ahead.run(&Limits { time: Some(8.0), impacts: Some(most), rest: false, interrupt: None });
            keys.pass(&ahead);
        }
        assert!(keys.kept.len() > 5, "{}", keys.kept.len());
        let end = ahead.time();
        for part in 1..20 {
            let time = end * f64::from(part) / 20.0;
            let mut straight = world();
            straight.advance_to(time);
            if let Some(mut again) = keys.before::<2>(time, None) {
                again.advance_to(time);
                assert_eq!(again.digest(), straight.digest(), "{time}");
                assert_eq!(again.impact_count(), straight.impact_count());
            } else {
                assert!(time < keys.kept[0].0);
            }
        }
        assert!(keys.before::<2>(end, Some(end)).is_none(), "nothing is later than the end");
    }

    #[test]
    fn keys_stay_few() {
        let (world, mut keys) = (world(), Keys::new());
        for _ in 0..1000 {
            keys.due = 0;
            keys.pass(&world);
        }
        assert!(keys.kept.len() <= MOST && keys.spacing > SPACING);
    }
}
