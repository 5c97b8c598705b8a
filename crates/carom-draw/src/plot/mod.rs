//! Plots of a run: energy, momentum, speeds, gaps, space and time.
//!
//! Charts are drawn here, on the same sheets as the pictures: `kuva` 0.6 was judged by its source and passed over. Its letters are the
//! reader's fonts, or 350 kB of them in every file, its PNG has a second rasteriser and other letters again, so that plots
//! would neither look like the pictures nor be the same bytes everywhere; and it brings 95,000 lines for five plots.
mod chart;
mod gaps;
mod history;
mod maxwell;
mod what;

pub use chart::{Axis, Chart, Key, Layer, Sort};
pub use gaps::{Gaps, nearest};
pub use history::{History, Sample};
pub use maxwell::maxwell;
pub use what::{What, chart};
