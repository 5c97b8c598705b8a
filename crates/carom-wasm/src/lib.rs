//! The engine for Carom Lab: one scene at a time on a [`Bench`], behind plain C exports.
//!
//! Text goes in and out through two buffers, states go out as views of `f64` on the module's memory ([`desk`]). A bench holds
//! two worlds of the scene: one that has run ahead to the end (the survey: every impact, the audit, the digest), and one that
//! stands where the page looks. Going back is exact: from a key snapshot of the run ahead, or from the scene anew, on to that
//! time. A world gives the same bits in one call or a thousand, restored or not, so that nothing depends on how the page got there.
//!
//! What an impact means, step by step, is told by [`words`], in a module of its own: it needs no world and no scene, only the
//! question that a bench poses ([`posed`]). [`files`], a third, writes scenes.
#[cfg(feature = "engine")]
mod bench;
#[cfg(feature = "engine")]
mod books;
#[cfg(feature = "engine")]
mod describe;
pub mod desk;
#[cfg(feature = "files")]
pub mod files;
#[cfg(feature = "engine")]
mod keys;
#[cfg(any(feature = "engine", feature = "words"))]
pub mod posed;
#[cfg(feature = "engine")]
mod samples;
#[cfg(feature = "engine")]
mod survey;
#[cfg(any(feature = "engine", feature = "files"))]
mod told;
#[cfg(feature = "engine")]
pub mod verbs;
#[cfg(feature = "words")]
pub mod words;

#[cfg(feature = "engine")]
pub use bench::{Bench, Refused, open};
