//! Scene files, and what is told about them.
pub mod explain;
