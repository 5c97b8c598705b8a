//! In the place of the module `toml` where TOML is left out: what it is asked for cannot be.
use crate::node::{Node, Source};
use crate::problem::Problem;

fn refused() -> Problem {
    Problem::new("", "this build of carom reads scenes as JSON alone").help("a scene as JSON begins with `{`")
}

/// Refuses.
pub(crate) fn parse(_: &[Source], _: usize) -> Result<Node, Problem> {
    Err(refused())
}

/// Refuses.
pub(crate) fn parse_value(_: &[Source], _: usize, _: usize) -> Result<Node, Problem> {
    Err(refused())
}
