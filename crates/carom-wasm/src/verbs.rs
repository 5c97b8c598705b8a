//! The verbs of the engine, as C exports.
#![allow(unsafe_code)]
use crate::bench::{Refused, open};
use crate::desk::{Desk, with};

/// Opens a scene (JSON; TOML where the build has it) and leaves its description: 1. Or leaves what is wrong with
/// it: 0. Or leaves how many dimensions it has, if it is one for another build: 2.
#[unsafe(no_mangle)]
pub extern "C" fn open_scene() -> u32 {
    with(|desk| match open(desk.text()) {
        Ok(bench) => {
            desk.output = bench.describe();
            desk.bench = Some(bench);
            1
        }
        Err(Refused::Problems(problems)) => {
            desk.output = problems;
            0
        }
        Err(Refused::Elsewhere(dim)) => {
            desk.output = dim.to_string();
            2
        }
    })
}

/// Runs the survey on by at most so many impacts; 1 when the run is over.
#[unsafe(no_mangle)]
pub extern "C" fn survey(impacts: u32) -> u32 {
    with(|desk| desk.bench.as_mut().map_or(1, |bench| u32::from(bench.survey(u64::from(impacts)))))
}

/// Leaves how far the survey has come.
#[unsafe(no_mangle)]
pub extern "C" fn surveyed() {
    with(|desk| desk.say(|bench| bench.surveyed()));
}

/// Leaves the times of all impacts as numbers.
#[unsafe(no_mangle)]
pub extern "C" fn marks() {
    with(|desk| {
        desk.numbers.clear();
        if let Some(bench) = &desk.bench {
            desk.numbers.extend_from_slice(bench.marks());
        }
    });
}

/// Leaves the lines of `count` impacts from the `from`-th (from 1).
#[unsafe(no_mangle)]
pub extern "C" fn lines(from: u32, count: u32) {
    with(|desk| desk.say(|bench| bench.lines(u64::from(from), u64::from(count))));
}

/// Leaves what the words have to know of the n-th impact: numbers, and names; 1. Or 0, if it was not kept or shared its instant with
/// others.
#[unsafe(no_mangle)]
pub extern "C" fn question(n: u32) -> u32 {
    with(|desk| match desk.bench.as_ref().and_then(|bench| bench.question(u64::from(n))) {
        Some(posed) => {
            (desk.numbers, desk.output) = posed.pack();
            1
        }
        None => 0,
    })
}

/// Leaves the ledger of the instant of the n-th impact; with 0, the ledger from the start to where the page looks.
#[unsafe(no_mangle)]
pub extern "C" fn ledger(n: u32) {
    with(|desk| desk.say(|bench| if n == 0 { bench.ledger() } else { bench.ledger_of(u64::from(n)) }));
}

/// Goes to a time; returns it.
#[unsafe(no_mangle)]
pub extern "C" fn seek(time: f64) -> f64 {
    with(|desk| desk.bench.as_mut().map_or(0.0, |bench| bench.seek(time)))
}

/// Goes to the next impact not after `horizon`; returns its time, or not a number.
#[unsafe(no_mangle)]
pub extern "C" fn next(horizon: f64) -> f64 {
    with(|desk| desk.bench.as_mut().map_or(f64::NAN, |bench| bench.next(horizon)))
}

/// Leaves the frame where the page looks as numbers.
#[unsafe(no_mangle)]
pub extern "C" fn frame() {
    with(|desk| {
        let Desk { bench, numbers, .. } = desk;
        numbers.clear();
        if let Some(bench) = bench {
            bench.frame(numbers);
        }
    });
}

/// Leaves rows for plots as numbers.
#[unsafe(no_mangle)]
pub extern "C" fn samples(count: u32) {
    with(|desk| {
        let Desk { bench, numbers, .. } = desk;
        numbers.clear();
        if let Some(bench) = bench {
            bench.samples(count, numbers);
        }
    });
}

/// Turns every velocity round; 1 if that was possible.
#[unsafe(no_mangle)]
pub extern "C" fn reverse() -> u32 {
    with(|desk| desk.bench.as_mut().map_or(0, |bench| u32::from(bench.reverse())))
}

/// Leaves the report of the world where the page looks.
#[unsafe(no_mangle)]
pub extern "C" fn report() {
    with(|desk| desk.say(|bench| bench.report()));
}
