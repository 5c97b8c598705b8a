//! Linear momentum, impulse and mean force: steps 1 to 4 of the lecture.
//!
//! # Accuracy
//! One rounding a component and operation; a total of n bodies is good to n units in the last place of the largest partial sum (the
//! [ledger](crate::ledger) sums with compensation).
use crate::Vector;

/// Linear momentum p = m v (kg m/s), component by component.
///
/// It characterises the state of a moving body; the force is its rate of change, F = dp/dt.
pub fn momentum<const D: usize>(mass: f64, velocity: Vector<D>) -> Vector<D> {
    velocity * mass
}

/// The linear impulse (N s) that takes a body from velocity `before` to velocity `after`: the change of its momentum,
/// m (v' - v), which is the integral of F dt over the contact.
pub fn impulse<const D: usize>(mass: f64, before: Vector<D>, after: Vector<D>) -> Vector<D> {
    (after - before) * mass
}

/// The mean force (N) of an impulse (N s) over a contact of `duration` (s): the impulse divided by the time.
///
/// The impulse itself does not depend on the duration: a padded fist and a bare one hand over the same momentum.
/// A duration of 0 gives an infinite force, as it must.
pub fn mean_force<const D: usize>(impulse: Vector<D>, duration: f64) -> Vector<D> {
    impulse / duration
}

/// The total momentum of bodies given as (mass, velocity). Without external forces it is constant in each component
/// (0 = dp/dt): an impact moves momentum from one body to the other and makes none.
pub fn total<const D: usize>(bodies: impl IntoIterator<Item = (f64, Vector<D>)>) -> Vector<D> {
    bodies.into_iter().fold(Vector::ZERO, |sum, (m, v)| sum + momentum(m, v))
}

/// Kinetic energy m v^2 / 2 (J).
pub fn kinetic_energy<const D: usize>(mass: f64, velocity: Vector<D>) -> f64 {
    0.5 * mass * velocity.norm_squared()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lecture_s_first_page() {
        let (before, after) = (Vector([3.0, 1.0, -2.0]), Vector([1.0, 1.0, 2.0]));
        assert_eq!(momentum(2.0, before), Vector([6.0, 2.0, -4.0]));
        let change = impulse(2.0, before, after);
        assert_eq!(change, momentum(2.0, after) - momentum(2.0, before));
        assert_eq!(mean_force(change, 0.5), Vector([-8.0, 0.0, 16.0]));
        assert_eq!(total([(2.0, before), (1.0, -before * 2.0)]), Vector::ZERO);
        assert_eq!(kinetic_energy(2.0, before), 14.0);
    }
}
