//! `carom schema`: the keys of scene files, as JSON Schema or as a page.
use crate::trouble::{Trouble, print};
use clap::{Args, ValueEnum};

/// Print the JSON Schema of scene files, for editors; or the same as a page to read
#[derive(Args)]
pub struct Schema {
    /// What to print
    #[arg(long, value_enum, default_value_t = Format::Json)]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Json,
    Markdown,
}

impl Schema {
    pub fn run(self) -> Result<(), Trouble> {
        match self.format {
            Format::Markdown => print(&carom_scene::reference()),
            Format::Json => {
                let schema = serde_json::to_string_pretty(&carom_scene::schema());
                print(&format!("{}\n", schema.map_err(|e| Trouble::usage(e.to_string()))?))
            }
        }
    }
}
