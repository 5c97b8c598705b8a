//! Carom's own benchmarks: gases of hard discs and spheres in equilibrium, measured beside a yardstick.
//!
//! Machines differ, and a shared one differs from minute to minute. So every row is measured in slices that take turns with slices
//! of a [yardstick](Yardstick), a plain kernel whose work never changes, and says how many yardsticks an impact costs. Times are
//! the thread's own CPU time, and the best slice counts.
//!
//! A [`Workload`] has a name (`spheres-0.49`, `discs-0.30-gravity`, ...) and builds the same world every time.
mod clock;
mod dice;
mod gas;
mod pack;
mod row;
pub mod soak;
mod workload;
mod yardstick;

pub use clock::{cpu_seconds, seconds};
pub use gas::Gas;
pub use row::{Effort, Row, measure};
pub use workload::{NAMES, Variant, Workload};
pub use yardstick::Yardstick;
