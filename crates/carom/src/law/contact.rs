//! The contact of two rigid bodies, whatever their shape: arms, inertia, and what an impulse does to it.
//!
//! With the normal n from the first body to the second, arms r from the centres of mass to the common contact point, and an
//! impulse P that acts as -P on the first body and as +P on the second,
//!
//! ```text
//! u = (va + wa x ra) - (vb + wb x rb)                    what the first does relative to the second, at the point
//! u' = u - K P        K = sum of (1/m) 1 - [r]x I^-1 [r]x over both bodies
//! kinetic energy lost = P.u - P.K P / 2 = P.(u + u') / 2
//! ```
//!
//! K is symmetric, and positive definite as soon as one of the bodies can be moved. A wall, a fixed and a driven body have
//! inverse mass and inverse inertia 0: they add nothing to K, but their velocity counts in u. No body needs to be a ball.
//!
//! The literature often writes n the other way round, with u.n < 0 for bodies that approach; here, as in [`super::smooth`],
//! the approach speed is u.n > 0.
use crate::{Matrix, Rotates, Vector};

/// One of the two bodies of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side<const D: usize>
where
    Vector<D>: Rotates,
{
    /// Velocity of the centre of mass (m/s).
    pub velocity: Vector<D>,
    /// Spin (rad/s).
    pub spin: <Vector<D> as Rotates>::Spin,
    /// 1/m (1/kg); 0 for what nothing can move.
    pub inverse_mass: f64,
    /// The inverse inertia about the centre of mass, in the axes of the world (1/(kg m^2)); zero for what nothing can turn.
    pub inverse_inertia: <Vector<D> as Rotates>::InverseInertia,
    /// From the centre of mass to the contact point (m).
    pub arm: Vector<D>,
}

impl<const D: usize> Side<D>
where
    Vector<D>: Rotates,
{
    /// What nothing can move, at this velocity (m/s): a wall, a piston.
    pub fn driven(velocity: Vector<D>) -> Self {
        Self {
            velocity,
            spin: Default::default(),
            inverse_mass: 0.0,
            inverse_inertia: Default::default(),
            arm: Vector::ZERO,
        }
    }

    /// A body that turns equally easily about every axis, with I = `kappa` m R^2: a ball of this inverse mass (1/kg), radius
    /// (m), velocity (m/s) and spin (rad/s), touched at the end of `arm` (m).
    pub fn ball(
        inverse_mass: f64,
        radius: f64,
        kappa: f64,
        velocity: Vector<D>,
        spin: <Vector<D> as Rotates>::Spin,
        arm: Vector<D>,
    ) -> Self {
        let inverse_inertia = Vector::<D>::isotropic(inverse_mass / (kappa * radius * radius));
        Self { velocity, spin, inverse_mass, inverse_inertia, arm }
    }

    /// The velocity (m/s) of the body's point at the contact: v + w x r.
    #[inline]
    pub fn at_contact(&self) -> Vector<D> {
        self.velocity + Vector::<D>::turned(self.spin, self.arm)
    }

    /// What an impulse (N s) at the contact does to the body: v + P/m, w + I^-1 (r x P). What cannot be moved keeps both to
    /// the bit.
    #[inline]
    pub fn pushed(&self, impulse: Vector<D>) -> Self {
        let moment = Vector::<D>::moment(self.arm, impulse);
        Self {
            velocity: self.velocity + impulse * self.inverse_mass,
            spin: self.spin + Vector::<D>::spun(&self.inverse_inertia, moment),
            ..*self
        }
    }

    /// How easily the contact point of this body moves: n.K m of the body alone, for two directions n and m.
    #[inline]
    pub(crate) fn mobility(&self, n: Vector<D>, m: Vector<D>) -> f64 {
        let (a, b) = (Vector::<D>::moment(self.arm, n), Vector::<D>::moment(self.arm, m));
        self.inverse_mass * n.dot(m) + Vector::<D>::spin_dot(a, Vector::<D>::spun(&self.inverse_inertia, b))
    }
}

/// Two bodies that touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<const D: usize>
where
    Vector<D>: Rotates,
{
    /// Unit vector from the first body to the second. An error of its length scales impulses by twice that error.
    pub normal: Vector<D>,
    /// The first and the second body. Both arms end in the contact point.
    pub sides: [Side<D>; 2],
}

impl<const D: usize> Contact<D>
where
    Vector<D>: Rotates,
{
    /// u: the velocity (m/s) of the first body's point relative to the second's.
    #[inline]
    pub fn relative_velocity(&self) -> Vector<D> {
        let [a, b] = &self.sides;
        // Velocities are subtracted before spins come in: where both bodies move fast together that keeps the digits.
        let moving = a.velocity - b.velocity;
        moving + (Vector::<D>::turned(a.spin, a.arm) - Vector::<D>::turned(b.spin, b.arm))
    }

    /// The approach speed u.n (m/s): positive if the bodies close.
    #[inline]
    pub fn approach(&self) -> f64 {
        self.relative_velocity().dot(self.normal)
    }

    /// The slip (m/s): the part of u across the normal.
    #[inline]
    pub fn slip(&self) -> Vector<D> {
        let u = self.relative_velocity();
        u - self.normal * u.dot(self.normal)
    }

    /// K (1/kg), in the axes of the world: u' = u - K P. Symmetric to the bit.
    pub fn matrix(&self) -> Matrix<D> {
        let mut k = Matrix::ZERO;
        for i in 0..D {
            for j in 0..=i {
                let (x, y) = (Vector::axis(i), Vector::axis(j));
                let entry = self.sides[0].mobility(x, y) + self.sides[1].mobility(x, y);
                (k.0[i][j], k.0[j][i]) = (entry, entry);
            }
        }
        k
    }

    /// The contact after an impulse P (N s): -P on the first body, +P on the second, the same bits on both.
    #[inline]
    pub fn after(&self, impulse: Vector<D>) -> Self {
        Self { normal: self.normal, sides: [self.sides[0].pushed(-impulse), self.sides[1].pushed(impulse)] }
    }

    /// The kinetic energy (J) that an impulse P (N s) takes, in any frame of reference in which what cannot be moved stands
    /// still: P.(u + u')/2, which keeps its digits where energies are large and their change is small.
    pub fn energy_lost(&self, impulse: Vector<D>) -> f64 {
        let (before, after) = (self.relative_velocity(), self.after(impulse).relative_velocity());
        0.5 * impulse.dot(before + after)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A brick and a ball in space, nothing parallel to anything.
    fn two_bodies() -> Contact<3> {
        let brick = Side {
            velocity: Vector([1.0, -2.0, 0.5]),
            spin: Vector([0.25, 3.0, -1.0]),
            inverse_mass: 0.5,
            inverse_inertia: Matrix([[2.0, 0.5, 0.0], [0.5, 3.0, -0.25], [0.0, -0.25, 1.0]]),
            arm: Vector([1.0, 0.5, -0.25]),
        };
        let ball =
            Side::ball(0.25, 2.0, 0.5, Vector([-1.0, 0.0, 4.0]), Vector([0.0, 1.0, 2.0]), Vector([0.0, -2.0, 0.0]));
        Contact { normal: Vector([0.0, 1.0, 0.0]), sides: [brick, ball] }
    }

    #[test]
    fn the_matrix_says_what_an_impulse_does() {
        let contact = two_bodies();
        for k in 0..3 {
            let impulse = Vector::<3>::axis(k) * 2.0;
            let want = contact.relative_velocity() - contact.matrix() * impulse;
            // Every number above is a sum of a few powers of two: nothing rounds.
            assert_eq!(contact.after(impulse).relative_velocity(), want);
        }
        assert_eq!(contact.matrix().0[0][2], contact.matrix().0[2][0]);
    }

    #[test]
    fn energy_is_what_the_bodies_lose() {
        // In the plane the inertia is a number, so that energies can be written down: m = 2, I = 1/2 and m = 4, I = 8.
        let a = Side {
            velocity: Vector([3.0, 1.0]),
            spin: Vector([2.0]),
            inverse_mass: 0.5,
            inverse_inertia: 2.0,
            arm: Vector([0.5, -1.0]),
        };
        let b = Side::ball(0.25, 2.0, 0.5, Vector([-1.0, 0.0]), Vector([-4.0]), Vector([0.0, 2.0]));
        let contact = Contact { normal: Vector([0.0, -1.0]), sides: [a, b] };
        let energy = |c: &Contact<2>| {
            let [a, b] = &c.sides;
            a.velocity.norm_squared()
                + 0.25 * a.spin.norm_squared()
                + 2.0 * b.velocity.norm_squared()
                + 4.0 * b.spin.norm_squared()
        };
        let impulse = Vector([0.5, -2.0]);
        assert_eq!(contact.energy_lost(impulse), energy(&contact) - energy(&contact.after(impulse)));
    }

    #[test]
    fn what_cannot_move_keeps_its_bits() {
        let wall = Side::driven(Vector([0.1, -0.3]));
        assert_eq!(wall.pushed(Vector([1e300, 1e-300])), wall);
    }
}
