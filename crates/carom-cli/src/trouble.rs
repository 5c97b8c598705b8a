//! How a verb ends: data on standard output, trouble on standard error, and the exit code.
use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

/// Why a verb stopped, and the exit code that says so.
#[derive(Debug)]
pub struct Trouble {
    message: String,
    code: u8,
    /// The message says by itself that it is an error, and where.
    told: bool,
}

impl Trouble {
    /// The command or the scene is wrong (exit code 2).
    pub fn usage(message: impl Into<String>) -> Self {
        Self { message: message.into(), code: 2, told: false }
    }

    /// A scene that is wrong: its problems tell themselves (exit code 2).
    pub fn scene(problems: impl std::fmt::Display) -> Self {
        Self { message: problems.to_string(), code: 2, told: true }
    }

    /// An audit failed (exit code 1).
    pub fn audit(message: impl Into<String>) -> Self {
        Self { message: message.into(), code: 1, told: false }
    }

    /// The run stopped itself (exit code 3).
    pub fn stopped(message: impl Into<String>) -> Self {
        Self { message: message.into(), code: 3, told: false }
    }

    /// Ctrl-C (exit code 130).
    pub fn interrupted() -> Self {
        Self { message: String::new(), code: 130, told: false }
    }

    /// Whoever reads standard output stopped reading: nothing is wrong, and nothing is left to do.
    pub fn unread() -> Self {
        Self { message: String::new(), code: 0, told: false }
    }

    /// True of [`Trouble::unread`].
    pub fn is_unread(&self) -> bool {
        self.code == 0
    }

    /// A file or standard output cannot be written (exit code 2).
    pub fn unwritten(what: &str, error: &io::Error) -> Self {
        Self::usage(format!("cannot write {what}: {error}"))
    }

    /// The same trouble, with something said below it.
    pub fn with(self, note: &str) -> Self {
        let message = match self.message.is_empty() {
            true => note.to_owned(),
            false => format!("{}\n{note}", self.message.trim_end()),
        };
        // What is no error (Ctrl-C) is not called one.
        Self { told: self.told || self.message.is_empty(), message, ..self }
    }

    /// What it says.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Says what is wrong on standard error; the exit code. An empty message says nothing.
    pub fn tell(self) -> ExitCode {
        if !self.message.is_empty() {
            let open = if self.told { "" } else { "error: " };
            let _ = writeln!(io::stderr(), "{open}{}", self.message.trim_end());
        }
        ExitCode::from(self.code)
    }
}

/// Writes data to standard output. Whoever reads it may stop reading (`carom ... | head`): that is no trouble.
pub fn print(text: &str) -> Result<(), Trouble> {
    say(&mut io::stdout().lock(), text)
}

/// Writes a piece of data to standard output, of which more is to come; [`Trouble::unread`] if nobody reads it any more.
pub fn say(out: &mut impl Write, text: &str) -> Result<(), Trouble> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Ok(()) => Ok(()),
        Err(e) if e.kind() == io::ErrorKind::BrokenPipe => Err(Trouble::unread()),
        Err(e) => Err(Trouble::unwritten("to standard output", &e)),
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
