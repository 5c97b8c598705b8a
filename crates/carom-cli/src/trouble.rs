//! How a verb ends: data on standard output, trouble on standard error, and the exit code.
use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

/// Why a verb stopped, and the exit code that says so.
#[derive(Debug)]
pub struct Trouble {
    message: String,
    code: u8,
}

impl Trouble {
    /// The command or the scene is wrong (exit code 2).
    pub fn usage(message: impl Into<String>) -> Self {
        Self { message: message.into(), code: 2 }
    }

    /// Says what is wrong on standard error; the exit code. An empty message says nothing.
    pub fn tell(self) -> ExitCode {
        if !self.message.is_empty() {
            let _ = writeln!(io::stderr(), "error: {}", self.message.trim_end());
        }
        ExitCode::from(self.code)
    }
}

/// Writes data to standard output. Whoever reads it may stop reading (`carom ... | head`): that is no trouble.
pub fn print(text: &str) -> Result<(), Trouble> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => {
            Err(Trouble { message: format!("cannot write to standard output: {e}"), code: 1 })
        }
        _ => Ok(()),
    }
}

/// True if standard output should be bold and coloured: on a terminal that can, and not where `NO_COLOR` says no.
pub fn colour() -> bool {
    coloured(
        io::stdout().is_terminal(),
        std::env::var("NO_COLOR").ok().as_deref(),
        std::env::var("TERM").ok().as_deref(),
    )
}

fn coloured(terminal: bool, no_color: Option<&str>, term: Option<&str>) -> bool {
    terminal && no_color.is_none_or(str::is_empty) && term != Some("dumb")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_only_where_it_is_wanted() {
        assert!(coloured(true, None, Some("xterm")));
        assert!(coloured(true, Some(""), Some("xterm")), "an empty NO_COLOR is none (no-color.org)");
        assert!(!coloured(true, Some("1"), Some("xterm")));
        assert!(!coloured(true, None, Some("dumb")));
        assert!(!coloured(false, None, Some("xterm")));
    }
}
