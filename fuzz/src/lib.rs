//! What is fuzzed: each target is a function of bytes that must end, and must not panic, whatever they are.
//!
//! The fuzzer (`tools/fuzz`) and the replay of what it found (`crates/carom-scene/tests/fuzzed.rs`, which takes these files in by
//! their path) run the same functions.
mod bytes;
mod go;
mod scene;
mod snapshot;
mod world;

pub use scene::scene;
pub use snapshot::snapshot;
pub use world::world;
