//! What can be wrong with what a caller hands in.

/// Why a call was refused. Nothing was changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A number is infinite or NaN.
    #[error("{0} must be finite")]
    NotFinite(&'static str),
    /// A number that must be positive is not.
    #[error("{0} must be positive")]
    NotPositive(&'static str),
    /// A coefficient lies outside its range, or a curve is not well formed.
    #[error("{0}")]
    OutOfRange(&'static str),
    /// A direction is the zero vector.
    #[error("{0} must not be the zero vector")]
    ZeroVector(&'static str),
    /// The shape does not exist in this dimension.
    #[error("{0}")]
    WrongDimension(&'static str),
    /// The handle's body, wall or material is not (or no longer) in this world.
    #[error("this {0} is not in the world: it was removed, or belongs to another one")]
    Stale(&'static str),
    /// The boundary has no room, or is too narrow for its balls.
    #[error("{0}")]
    Boundary(&'static str),
    /// The bytes are no snapshot of a world, or one of another dimension or version.
    #[error("{0}")]
    Snapshot(&'static str),
    /// A world holds at most 2^31 bodies and 2^31 walls.
    #[error("the world is full")]
    Full,
}
