//! What a run says, as programs read it: one object for the run, one for each impact. Every face writes these.
mod csv;
mod impact;
mod row;
mod run;

pub use impact::{ImpactLine, Motion};
pub use row::BodyLine;
pub use run::{Audit, BodyState, Energy, Report, Share, stop_name};

/// Compact JSON. What is not finite becomes null.
fn compact(value: &impl serde::Serialize) -> String {
    serde_json::to_string(value).unwrap_or_else(|_| "null".into())
}
