//! The `carom` command. Each verb is a file with its arguments and a `run`, and one line in [`Verb`].
mod audit;
mod bench;
mod canvas;
mod check;
mod completions;
mod draft;
mod drive;
mod event;
mod events;
mod explain;
mod figures;
mod film;
mod instant;
mod interrupt;
mod lab;
mod link;
mod log;
mod minus;
mod outputs;
mod picture;
mod plot;
mod plot_text;
mod progress;
mod record;
mod render;
mod run;
mod scenes;
mod schema;
mod shoot;
mod sink;
mod source;
mod sweep;
mod table;
mod tally;
mod trouble;
mod verify;
mod welcome;
mod wrote;

use clap::{Parser, Subcommand};
use std::process::ExitCode;
use trouble::Trouble;

/// Collision response, exactly: bodies meet, and they part with the right velocities.
#[derive(Parser)]
#[command(name = "carom", version, disable_help_subcommand = true)]
struct Carom {
    #[command(subcommand)]
    verb: Option<Verb>,
}

#[derive(Subcommand)]
enum Verb {
    Run(run::Run),
    Events(events::Events),
    Explain(explain::Explain),
    Check(check::Check),
    Verify(verify::Verify),
    Bench(bench::Bench),
    Render(render::Render),
    Plot(plot::Plot),
    Sweep(sweep::Sweep),
    Scenes(scenes::Scenes),
    Lab(lab::Lab),
    Link(link::Link),
    Schema(schema::Schema),
    Completions(completions::Completions),
}

fn run(carom: Carom) -> Result<(), Trouble> {
    match carom.verb {
        None => welcome::run(),
        Some(Verb::Run(verb)) => verb.run(),
        Some(Verb::Events(verb)) => verb.run(),
        Some(Verb::Explain(verb)) => verb.run(),
        Some(Verb::Check(verb)) => verb.run(),
        Some(Verb::Verify(verb)) => verb.run(),
        Some(Verb::Bench(verb)) => verb.run(),
        Some(Verb::Render(verb)) => verb.run(),
        Some(Verb::Plot(verb)) => verb.run(),
        Some(Verb::Sweep(verb)) => verb.run(),
        Some(Verb::Scenes(verb)) => verb.run(),
        Some(Verb::Lab(verb)) => verb.run(),
        Some(Verb::Link(verb)) => verb.run(),
        Some(Verb::Schema(verb)) => verb.run(),
        Some(Verb::Completions(verb)) => verb.run(),
    }
}

fn main() -> ExitCode {
    let carom = Carom::parse_from(minus::readable(std::env::args_os()));
    match run(carom) {
        Ok(()) => ExitCode::SUCCESS,
        Err(trouble) => trouble.tell(),
    }
}
