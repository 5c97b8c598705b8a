//! Pictures and plots of worlds, without a window: SVG, PNG, GIF and MP4.
//!
//! A [`Cast`] is what of a scene never changes, a [`Snapshot`] where everything is at one time, a [`Survey`] what is known of
//! the whole run, a [`Trace`] what is remembered of the way. A [`Drawing`] turns them into a [`Sheet`](sheet::Sheet) of marks:
//! a ground that stays and a frame for each time. A sheet becomes SVG ([`svg`]) or pixels ([`raster`]), and pixels become a
//! PNG ([`still`]), a [`gif`] or an [`mp4`].
//!
//! Whoever draws stops the world's clock at the times of the frames: every frame shows the motion exactly as it is.
//!
//! The same scene gives the same bytes on every machine: letters are outlines that come along, functions are `libm`'s, and
//! nothing is drawn by the graphics hardware.
#![deny(unsafe_code)]
mod ball;
mod camera;
mod cast;
pub mod colour;
mod drawing;
pub mod figure;
pub mod font;
pub mod gif;
mod hud;
mod line;
mod look;
pub mod mp4;
mod names;
pub mod palette;
mod plane;
pub mod plot;
pub mod raster;
pub mod sheet;
mod snapshot;
mod space;
pub mod still;
pub mod svg;
pub mod theme;
mod tint;
mod trace;
mod view;

pub use cast::{Actor, Cast};
pub use drawing::Drawing;
pub use look::{Arrows, Look, Tint};
pub use snapshot::{Energy, Hit, Moment, Snapshot, Survey};
pub use trace::Trace;
pub use view::MOST_PIXELS;
