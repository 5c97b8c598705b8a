//! Collision response, exactly: bodies meet, and they part with the right velocities.
#![no_std]
#![deny(unsafe_code)]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

mod body;
mod error;
pub mod law;
pub mod ledger;
pub mod material;
pub mod meet;
pub mod report;
pub mod vector;
pub mod wall;
pub mod world;

pub use body::{Ball, BodyId};
pub use error::Error;
pub use ledger::Ledger;
pub use material::{Coefficient, Material, MaterialId};
pub use report::{Impact, Party, State, Touch};
pub use vector::{Rotates, Vector};
pub use wall::{Shape, Wall, WallId};
pub use world::{Boundary, Limits, Stop, World};
