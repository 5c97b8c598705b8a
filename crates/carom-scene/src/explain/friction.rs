//! What friction does in an impact of two balls: slip, stick or slide, and where the energy goes.
use carom::law::rough::{self, Turning};
use carom::material::Coefficients;
use carom::{Rotates, Vector};

/// Friction in one impact of two balls, in the plane or in space. Vectors have as many numbers as velocities.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// How the contact point of the first surface moves over that of the second, before and after (m/s).
    pub slip: [Vec<f64>; 2],
    /// The speed of that slip before (m/s).
    pub slip_speed: f64,
    /// 1/((1 + 1/k1)/m1 + (1 + 1/k2)/m2) (kg): what the slip weighs.
    pub tangential_mass: f64,
    /// The impulse that would bring back e_t times the slip (N s): (1 + e_t) m_t |s|.
    pub stick: f64,
    /// Coulomb's limit mu J (N s).
    pub limit: f64,
    /// True if the surfaces stick: the impulse that it takes lies within the limit.
    pub sticks: bool,
    /// The size of the tangential impulse (N s).
    pub impulse: f64,
    /// What the normal impulse takes (J): (1 - e^2) mu u^2 / 2.
    pub lost_normal: f64,
    /// What friction takes (J).
    pub lost_friction: f64,
}

impl Friction {
    /// Friction between two balls before and after they exchanged the two parts of an impulse.
    pub(super) fn of<const D: usize>(
        before: &[Turning<D>; 2],
        after: &[Turning<D>; 2],
        normal: Vector<D>,
        [push, across]: [Vector<D>; 2],
        c: Coefficients,
        lost_normal: f64,
    ) -> Self
    where
        Vector<D>: Rotates,
    {
        let slip = [before, after].map(|[a, b]| rough::slip(a, b, normal));
        let tangential_mass = 1.0 / rough::inverse_tangential_mass(&before[0], &before[1]);
        let slip_speed = slip[0].norm();
        let stick = (1.0 + c.tangential) * tangential_mass * slip_speed;
        let limit = c.friction * push.norm();
        Self {
            slip: slip.map(|s| s.0.iter().map(|x| x + 0.0).collect()),
            slip_speed,
            tangential_mass,
            stick,
            limit,
            sticks: stick <= limit,
            impulse: across.norm(),
            lost_normal,
            lost_friction: 0.5 * across.dot(slip[0] + slip[1]),
        }
    }
}
