//! The laws of one contact with friction: exact answers, an independent integration, and what holds of every impact.
//!
//! `CAROM_CASES=1000000 cargo test --release -p carom --test laws_friction` draws that many impacts a law instead of the
//! usual number.
mod draw;
mod exact;
mod frames;
mod integrated;
mod invariants;
mod spheres;
mod trouble;
