//! `carom schema`: the JSON Schema of scene files.
use crate::trouble::{Trouble, print};
use clap::Args;

/// Print the JSON Schema of scene files, for editors
#[derive(Args)]
pub struct Schema {}

impl Schema {
    pub fn run(self) -> Result<(), Trouble> {
        let schema = serde_json::to_string_pretty(&carom_scene::schema());
        print(&format!("{}\n", schema.map_err(|e| Trouble::usage(e.to_string()))?))
    }
}
