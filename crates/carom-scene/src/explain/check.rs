//! Does it add up? Momentum, restitution and energy of an explained impact.
use super::Explanation;

/// What a check weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Balance {
    /// Total momentum, or the ball's change against what the wall was given.
    #[default]
    Momentum,
    /// Departure = e approach.
    Restitution,
    /// Energy before + work = energy after + lost.
    Energy,
}

/// One balance, with its remainder.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Check {
    /// What was weighed.
    pub balance: Balance,
    /// What is left unexplained, divided by the scale of the quantity.
    pub error: f64,
    /// True if the remainder is below `TOLERANCE`.
    pub holds: bool,
}

/// A dozen roundings of 1.1e-16 lie between the numbers given and each balance: 1e-12 of the scale is far above them, and
/// far below what any person would notice.
pub const TOLERANCE: f64 = 1e-12;

/// The three checks.
pub(super) fn all(x: &Explanation) -> [Check; 3] {
    let check = |balance, remainder: f64, scale: f64| {
        let error = if remainder == 0.0 { 0.0 } else { remainder.abs() / scale };
        Check { balance, error, holds: error < TOLERANCE }
    };
    let moved = |body: usize| x.masses[body].is_finite();
    let mut remainder: f64 = 0.0;
    let mut scale: f64 = 0.0;
    for k in 0..x.dim {
        let mut left = 0.0;
        for body in (0..2).filter(|b| moved(*b)) {
            let (before, after) =
                (x.masses[body] * x.before.velocity[body][k], x.masses[body] * x.after.velocity[body][k]);
            left += after - before;
            scale = scale.max(before.abs()).max(after.abs());
        }
        // A wall keeps what it was given; without one the changes cancel.
        left -= match x.wall() {
            Some(0) => x.exchanged[k],
            Some(_) => -x.exchanged[k],
            None => 0.0,
        };
        remainder = remainder.max(left.abs());
    }
    let momentum = check(Balance::Momentum, remainder, scale);

    let speeds = x.before.velocity.iter().chain(&x.after.velocity).flatten();
    let fastest = speeds.fold(0.0, |most: f64, v| most.max(v.abs()));
    let wanted = if x.meets() { x.restitution * x.approach } else { -x.approach };
    let restitution = check(Balance::Restitution, x.departure - wanted, fastest);

    let remainder = (x.before.energy - x.after.energy) + (x.work - x.lost);
    let energy = check(Balance::Energy, remainder, x.before.energy.max(x.after.energy).max(x.work.abs()));
    [momentum, restitution, energy]
}
