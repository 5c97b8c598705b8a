//! What happens when they touch: pure functions from a state to an impulse. A law knows no time and no world.
//!
//! The chapters of the lecture, in its order:
//! [`momentum`] (p = m v, F = dp/dt, impulse), [`line`](mod@line) (the closed forms on a line), [`rotated`] (the plane, by angles)
//! and [`smooth`] (any dimension, by projection: what the engine runs). [`together`] goes on where several bodies meet at
//! one instant.
pub mod line;
pub mod momentum;
pub mod rotated;
pub mod smooth;
pub mod together;
