//! A soak: worlds that live long, with everything in them and changes all the time, and their books read again and again.
//!
//! `cargo run --release -p carom-bench --example soak -- [MINUTES] [FIRST SEED]` (10 minutes, seed 1). Round after round, as
//! `carom_bench::soak` describes it; one world, a gas, lives through the whole soak. Once a minute a line says what there was and how
//! much memory the process holds: it must not grow. Whatever is wrong is told with its seed, and makes the exit code 1.
use std::time::{Duration, Instant};

use carom_bench::soak::{Old, Tally, round};

/// The memory that this process holds (MB); 0 where the system does not tell.
fn resident() -> f64 {
    let told = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    told.split_whitespace().nth(1).and_then(|pages| pages.parse::<f64>().ok()).unwrap_or(0.0) * 4096.0 / 1e6
}

fn main() -> std::process::ExitCode {
    let mut arguments = std::env::args().skip(1).map(|a| a.parse::<f64>());
    let minutes = arguments.next().and_then(Result::ok).unwrap_or(10.0);
    let first = arguments.next().and_then(Result::ok).unwrap_or(1.0) as u64;
    let start = Instant::now();
    let end = Duration::from_secs_f64(60.0 * minutes);
    let mut tally = Tally::default();
    let mut old = Old::default();
    let (mut seed, mut told) = (first, 0);
    println!(
        "min    rounds    frames     impacts      slices   changes  restored  given up  capped   drift  overlap     MB   old world: t  impacts"
    );
    while start.elapsed() < end {
        let (wrong, given_up) = (tally.wrong.len(), tally.given_up);
        round(seed, &mut tally);
        tally.wrong[wrong..].iter().for_each(|what| println!("WRONG: {what}"));
        if tally.given_up > given_up {
            println!("given up: seed {seed} had too many impacts in a frame");
        }
        seed += 1;
        if seed % 10 == 0 {
            old.live(&mut tally);
        }
        let minute = start.elapsed().as_secs() / 60;
        if minute > told || start.elapsed() >= end {
            told = minute;
            println!(
                "{minute:3} {:9} {:9} {:11} {:11} {:9} {:9} {:9} {:7} {:7.0e} {:8.0e} {:6.1} {:14} {:8}",
                tally.rounds,
                tally.frames,
                tally.impacts,
                tally.slices,
                tally.changes,
                tally.restored,
                tally.given_up,
                tally.capped,
                tally.drift,
                tally.overlap,
                resident(),
                old.world.time().round(),
                old.world.impact_count(),
            );
        }
    }
    println!("{} wrong; seeds {first} to {}", tally.wrong.len(), seed - 1);
    std::process::ExitCode::from(u8::from(!tally.wrong.is_empty()))
}
