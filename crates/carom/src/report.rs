//! What an impact did: before, impulse, after, lost.
use crate::{BodyId, Rotates, Vector, WallId};

/// Who took part in an impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Party {
    /// A body.
    Body(BodyId),
    /// A wall, or a side of the boundary.
    Wall(WallId),
}

impl From<BodyId> for Party {
    fn from(id: BodyId) -> Self {
        Self::Body(id)
    }
}

impl From<WallId> for Party {
    fn from(id: WallId) -> Self {
        Self::Wall(id)
    }
}

/// How a party moved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State<const D: usize>
where
    Vector<D>: Rotates,
{
    /// Velocity (m/s).
    pub velocity: Vector<D>,
    /// Spin (rad/s).
    pub spin: <Vector<D> as Rotates>::Spin,
}

/// One contact that exchanged an impulse.
///
/// Of two bodies the one added earlier comes first; bodies come before walls. `-impulse * normal` acts on the first,
/// `+impulse * normal` on the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<const D: usize>
where
    Vector<D>: Rotates,
{
    /// When (s).
    pub time: f64,
    /// Who.
    pub parties: [Party; 2],
    /// Where they touched (m).
    pub point: Vector<D>,
    /// Unit vector from the first to the second.
    pub normal: Vector<D>,
    /// (va - vb).n before (m/s). Where several contacts share the instant it may be zero or negative: a contact that
    /// transmits.
    pub approach: f64,
    /// -(va - vb).n after (m/s).
    pub departure: f64,
    /// The coefficient of restitution that was used (first, where the instant took several iterations).
    pub restitution: f64,
    /// The normal impulse J >= 0 (N s), summed over the iterations of the instant.
    pub impulse: f64,
    /// The tangential impulse on the second (N s).
    pub friction_impulse: Vector<D>,
    /// Both parties before the instant.
    pub before: [State<D>; 2],
    /// Both parties after it.
    pub after: [State<D>; 2],
    /// The kinetic energy that this contact took (J), in the frame of a wall that takes part. Where several contacts share an
    /// instant a line of its own may be negative; their sum is the instant's.
    pub lost: f64,
    /// How many contacts exchanged an impulse at this instant.
    pub together: u32,
}

/// A body that entered a sensor, or the other way round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// When (s).
    pub time: f64,
    /// The two bodies; at least one is a sensor.
    pub bodies: [BodyId; 2],
}
