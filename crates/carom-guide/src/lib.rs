//! The guide's pages, read by machine. The build script gathers every Rust block of the guide and the README into one test program
//! (`tests/guide.rs`), so that what is shown there compiles and holds; `carom-cli/tests/guide.rs` does the same for commands and scenes.
pub mod markdown;
