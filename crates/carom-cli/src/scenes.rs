//! `carom scenes`: the scenes that are in the binary.
use crate::source::unknown;
use crate::trouble::{Trouble, print};
use carom_scene::{builtin, builtins};
use clap::Args;

/// List the built-in scenes, or print one
///
/// `carom scenes NAME > my.toml` is a good start for a scene of your own.
#[derive(Args)]
pub struct Scenes {
    /// Print this scene's file
    name: Option<String>,
}

impl Scenes {
    pub fn run(self) -> Result<(), Trouble> {
        match self.name {
            Some(name) => print(builtin(&name).ok_or_else(|| unknown(&name))?),
            None => {
                let width = builtins().map(|b| b.name.len()).max().unwrap_or(0);
                let line = |b: &carom_scene::Builtin| format!("  {:width$}  {}\n", b.name, b.title());
                print(&builtins().map(line).collect::<String>())
            }
        }
    }
}
