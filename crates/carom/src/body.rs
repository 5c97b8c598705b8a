//! What a ball is.
use crate::{Coefficient, Error, Material, MaterialId, Rotates, Vector};

/// A body of a world. The handle of a removed body stays invalid for ever; its place may be used again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BodyId {
    pub(crate) index: u32,
    pub(crate) generation: u32,
}

impl BodyId {
    /// The place of the body in the world: bodies are numbered from 0 in the order in which they were added.
    pub fn index(self) -> usize {
        self.index as usize
    }
}

/// A ball: the segment [x - r, x + r] on the line, a disc in the plane, a sphere in space.
///
/// ```
/// use carom::Ball;
/// let ball = Ball::<2>::new(1.0, 0.1).at([0.0, 2.0]).moving([3.0, 0.0]).restitution(0.8);
/// assert!(ball.check().is_ok());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Ball<const D: usize>
where
    Vector<D>: Rotates,
{
    /// Mass (kg). Infinite only for a fixed body that was given none.
    pub mass: f64,
    /// Radius (m).
    pub radius: f64,
    /// Position of the centre (m).
    pub position: Vector<D>,
    /// Velocity (m/s).
    pub velocity: Vector<D>,
    /// Spin (rad/s).
    pub spin: <Vector<D> as Rotates>::Spin,
    /// kappa in I = kappa m R^2: 1/2 for a disc, 2/5 for a solid sphere.
    pub inertia: f64,
    /// Immovable: inverse mass 0, untouched by gravity. With a velocity it is driven.
    pub fixed: bool,
    /// Its material; that of the world's default unless said otherwise.
    pub material: MaterialId,
    /// What this ball alone says of its surface, in place of what its material says.
    pub restitution: Option<Coefficient>,
    /// The layers it lies in, one bit each.
    pub layers: u32,
    /// The layers it meets. Two bodies meet if each lies in a layer that the other meets.
    pub meets: u32,
    /// A sensor tells who enters it, and hits nobody.
    pub sensor: bool,
    /// Whatever the user wants to keep with it.
    pub user: u64,
}

impl<const D: usize> Ball<D>
where
    Vector<D>: Rotates,
{
    /// A ball of this mass (kg) and radius (m), still, at the origin.
    pub fn new(mass: f64, radius: f64) -> Self {
        Self {
            mass,
            radius,
            position: Vector::ZERO,
            velocity: Vector::ZERO,
            spin: Default::default(),
            inertia: if D == 3 { 0.4 } else { 0.5 },
            fixed: false,
            material: MaterialId::default(),
            restitution: None,
            layers: 1,
            meets: u32::MAX,
            sensor: false,
            user: 0,
        }
    }

    /// A ball that nothing can move, of this radius (m); with a velocity it is driven.
    pub fn fixed(radius: f64) -> Self {
        Self { fixed: true, ..Self::new(f64::INFINITY, radius) }
    }

    /// Its centre at this position (m).
    pub fn at(self, position: impl Into<Vector<D>>) -> Self {
        Self { position: position.into(), ..self }
    }

    /// Moving at this velocity (m/s).
    pub fn moving(self, velocity: impl Into<Vector<D>>) -> Self {
        Self { velocity: velocity.into(), ..self }
    }

    /// Turning at this spin (rad/s).
    pub fn spinning(self, spin: impl Into<<Vector<D> as Rotates>::Spin>) -> Self {
        Self { spin: spin.into(), ..self }
    }

    /// Of this material.
    pub fn material(self, material: MaterialId) -> Self {
        Self { material, ..self }
    }

    /// With this coefficient of restitution, a number in [0, 1] or a curve over approach speed, whatever its material says.
    pub fn restitution(self, e: impl Into<Coefficient>) -> Self {
        Self { restitution: Some(e.into()), ..self }
    }

    /// With I = `kappa` m R^2.
    pub fn inertia(self, kappa: f64) -> Self {
        Self { inertia: kappa, ..self }
    }

    /// In these `layers`, meeting those of `meets` (one bit a layer).
    pub fn layers(self, layers: u32, meets: u32) -> Self {
        Self { layers, meets, ..self }
    }

    /// As a sensor: it tells who enters it, and hits nobody.
    pub fn sensor(self) -> Self {
        Self { sensor: true, ..self }
    }

    /// With the user's number.
    pub fn user(self, user: u64) -> Self {
        Self { user, ..self }
    }

    /// `Ok` if the ball could be added to a world.
    ///
    /// # Errors
    /// The first rule it breaks: finite numbers, positive radius, mass and inertia, e in [0, 1].
    pub fn check(&self) -> Result<(), Error> {
        if !self.radius.is_finite() {
            return Err(Error::NotFinite("radius"));
        }
        if !(self.radius > 0.0) {
            return Err(Error::NotPositive("radius"));
        }
        if !(self.mass > 0.0) {
            return Err(if self.mass.is_nan() { Error::NotFinite("mass") } else { Error::NotPositive("mass") });
        }
        if !self.fixed && !self.mass.is_finite() {
            return Err(Error::NotFinite("mass"));
        }
        if !self.position.is_finite() {
            return Err(Error::NotFinite("position"));
        }
        if !self.velocity.is_finite() {
            return Err(Error::NotFinite("velocity"));
        }
        if !Vector::<D>::spin_slice(&self.spin).iter().all(|w| w.is_finite()) {
            return Err(Error::NotFinite("spin"));
        }
        if !(self.inertia > 0.0) || !self.inertia.is_finite() {
            return Err(Error::NotPositive("inertia"));
        }
        if !self.restitution.as_ref().is_none_or(|e| e.is_valid(0.0, 1.0)) {
            return Err(Error::OutOfRange("restitution must lie in [0, 1]"));
        }
        Ok(())
    }
}

/// The material that results where a ball or a wall says a restitution of its own.
pub(crate) fn own_material(base: &Material, restitution: &Option<Coefficient>) -> Option<Material> {
    restitution.as_ref().map(|e| Material { restitution: Some(e.clone()), ..base.clone() })
}
