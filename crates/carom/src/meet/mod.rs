//! When will these two touch? Pure: motion in, time out.
//!
//! Every function takes the motion of a ball's centre relative to the obstacle (m, m/s, m/s^2), with now as time 0, and
//! returns the time (s, >= 0) of the next event, `f64::INFINITY` for never. What is not a number never meets anything.
//!
//! # The rule
//! With the gap f(t), the *event* is the first t >= 0 at which f <= 0 and f' < 0 (stable event detection: Bannerman, Strobl,
//! Formella & Poeschel 2014). Bodies that overlap a little and part, as they do after an impact because positions round,
//! are left alone; those that overlap and close meet now; those that overlap, part and are pulled back meet at the next
//! turning point of f, or at the next root if f has become positive before. A grazing touch (an even root) is no event.
//!
//! An impact that ends without any speed along the normal leaves f' = 0 give or take a rounding, and gravity then makes the
//! next event follow at once: such a contact lasts, and it is for the caller not to ask about it.
//!
//! # How
//! The event lies in a *window*: a span of time in which one part of the obstacle (face, edge, corner) closes in from
//! `radius` to nothing, while the centre is over that part. Windows are bounded by roots of polynomials of degree at most
//! four, found on pieces on which they are monotone, so none is missed; they have a length, so that nothing falls into the
//! seam between two parts.
mod arc;
mod ball;
mod path;
mod plane;
mod radial;
mod segment;
mod triangle;
mod windows;

pub use arc::{Arc, arc, nearest_on_arc};
pub use ball::{ball_ball, ball_ball_accelerated};
pub use path::Path;
pub use plane::{exit, plane};
pub use segment::{nearest_on_segment, segment};
pub use triangle::{nearest_on_triangle, triangle};
