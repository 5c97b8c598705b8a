//! Collision response, exactly: bodies meet, and they part with the right velocities.
//!
//! # What it is
//! A world of balls and walls on the line, in the plane or in space ([`World`]`<1>`, `<2>`, `<3>`, from one source). There is no
//! time step: every body moves exactly from one event to the next, every impact happens at its own time, is resolved by a law
//! with a name ([`law`]), is reported with its impulse ([`Impact`]), and is entered into the books ([`Ledger`]), which
//! account for every joule and newton-second of the run.
//!
//! ```
//! use carom::{Ball, World};
//! // The lecture's two balls: 2 kg at 3 m/s meets 1 kg at -1 m/s, e = 1/2.
//! let mut world = World::<1>::new();
//! let a = world.ball(Ball::new(2.0, 0.1).at([-1.0]).moving([3.0]).restitution(0.5));
//! let b = world.ball(Ball::new(1.0, 0.1).at([1.0]).moving([-1.0]).restitution(0.5));
//! let impact = world.advance(1.0)[0];
//! assert_eq!((impact.time, impact.impulse, impact.lost), (0.45, 4.0, 4.0));
//! assert_eq!(world.velocity(a).unwrap(), [1.0].into());
//! assert_eq!(world.velocity(b).unwrap(), [3.0].into());
//! assert!(world.ledger().pass());
//! ```
//!
//! # Why
//! An engine with a time step finds two bodies inside each other, or past each other, and mends that. How high a ball bounces then depends on
//! when in the step it lands; a cradle or a gas loses its energy; a fast ball is late. Here an impact is where and when it is, with the
//! impulse it has (the guide's comparison has the numbers).
//!
//! # When, and when not
//! For balls and walls whose impacts matter: teaching, billiards and pinball, gases and granular matter, as a referee of another engine.
//! The laws ([`law`]) are pure functions that serve bodies of any shape. Not for joints, polygons and large heaps in real time.
//!
//! # The floors
//! A module knows only those below it: [`world`] (the clock) uses [`meet`] (when will these two touch?) and [`law`] (what
//! happens when they do?); a law knows no time, a meeting knows no law. Both are pure functions and useful on their own.
//!
//! # What it costs
//! An impact costs the prediction of what its two bodies meet next: a few dozen pairs, about a microsecond or two in a
//! moderately dense gas of 10,000 discs, whatever the size of the world. A frame without an event costs nothing.
//! Memory is 340 to 520 bytes a ball.
//!
//! # What is exact, and what is a model
//! Times of impact are roots in closed form or bracketed to a few units in the last place; momentum is kept to rounding; a gas
//! of 10,000 discs loses less than 1e-12 of its energy in a million impacts (`tests/world.rs`). The coefficient of
//! restitution is a model of what happens inside an impact, and so is the operator for several contacts at one instant
//! ([`law::together`]). Islands in lasting contact (heaps) move by slices of a millisecond ([`world::SLICE`]), which take no
//! energy that the books do not show. The same scene gives the same bits on every machine, in debug and in release,
//! in one call of `advance` or a thousand (`tests/determinism.rs`).
//!
//! # Units
//! SI throughout: m, kg, s, rad.
#![no_std]
#![deny(unsafe_code)]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

mod body;
mod codec;
#[cfg(debug_assertions)]
mod compiled;
mod error;
pub mod law;
pub mod ledger;
pub mod material;
pub mod matrix;
pub mod meet;
pub mod report;
pub mod vector;
pub mod wall;
pub mod world;

pub use body::{Ball, BodyId};
#[cfg(debug_assertions)]
#[doc(hidden)]
pub use compiled::worlds;
pub use error::Error;
pub use law::{Law, together::Together};
pub use ledger::Ledger;
pub use material::{Coefficient, Material, MaterialId};
pub use matrix::Matrix;
pub use report::{Impact, Party, State, Touch};
pub use vector::{Rotates, Vector};
pub use wall::{Shape, Wall, WallId};
pub use world::{Boundary, Limits, Stop, World};
