//! `carom completions SHELL`.
use crate::trouble::{Trouble, print};
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Print completions for a shell
///
/// For bash: carom completions bash > ~/.local/share/bash-completion/completions/carom
#[derive(Args)]
pub struct Completions {
    /// The shell
    shell: Shell,
}

impl Completions {
    pub fn run(self) -> Result<(), Trouble> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut crate::Carom::command(), "carom", &mut script);
        print(&String::from_utf8_lossy(&script))
    }
}
