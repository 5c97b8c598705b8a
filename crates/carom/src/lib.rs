//! Collision response, exactly: bodies meet, and they part with the right velocities.
#![no_std]
#![deny(unsafe_code)]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

pub mod law;
pub mod material;
pub mod meet;
pub mod vector;

pub use material::{Coefficient, Material, MaterialId};
pub use vector::{Rotates, Vector};
