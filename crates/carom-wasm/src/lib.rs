//! The engine for Carom Lab: one scene at a time on a [`Bench`], behind plain C exports.
//!
//! Text goes in and out through two buffers, states go out as views of `f64` on the module's memory ([`exports`]). A bench holds
//! two worlds of the scene: one that has run ahead to the end (the survey: every impact, the audit, the digest), and one that
//! stands where the page looks. Going back is exact: the scene anew, run to that time. A world gives the same bits in one call
//! or a thousand, so that nothing depends on how the page got there.
mod bench;
mod books;
mod describe;
pub mod exports;
mod samples;
mod survey;

pub use bench::{Bench, open};
