//! Runs as files that other programs read: trajectories (extxyz, LAMMPS dump, GSD, VTP), tables (Parquet), and recordings.
//!
//! A trajectory is a [`Cast`] (who plays) and [`Frame`]s (where everybody is); each format is one file of this crate and one
//! writer over anything that can be written. Numbers are written so that they are read back to the last bit, except in GSD,
//! whose schema has single precision.
//!
//! ```
//! use carom_files::{Actor, Bounds, Cast, Frame, Moment, extxyz};
//! let ball = Actor { name: "ball".into(), kind: 1, mass: Some(1.0), radius: 0.5 };
//! let cast = Cast { dim: 2, kinds: vec!["ball".into()], bodies: vec![ball], bounds: Bounds::open(), ..Cast::default() };
//! let moment = Moment { position: [0.25, 1.0, 0.0], ..Moment::default() };
//! let mut text = Vec::new();
//! extxyz::write(&mut text, &cast, &Frame { number: 0, time: 0.1, bodies: &[moment] })?;
//! assert!(String::from_utf8_lossy(&text).lines().nth(2).is_some_and(|row| row.starts_with("X 0.25 1.0 0.0")));
//! # Ok::<(), std::io::Error>(())
//! ```
pub mod cast;
pub mod extxyz;
pub mod gsd;
pub mod lammps;
#[cfg(feature = "parquet")]
pub mod parquet;
pub mod recording;
pub mod vtp;

pub use cast::{Actor, Bounds, Cast, Frame, Moment};
