//! The C exports. A verb takes its text from [`input`] and leaves text in [`output`] or numbers in [`numbers`]; both stay until
//! the next verb. A verb that can fail returns 0 and leaves problems as JSON.
//!
//! The one place with attributes that the compiler counts as unsafe: names that the linker must not change.
#![allow(unsafe_code)]
use core::cell::RefCell;

use carom_scene::explain::{Language, Symbols};
use carom_scene::{Detail, builtin, builtins, to_json, to_toml};
use serde::Serialize;

use crate::bench::{Bench, json, open};

#[derive(Default)]
struct Desk {
    input: Vec<u8>,
    output: String,
    numbers: Vec<f64>,
    bench: Option<Box<dyn Bench>>,
}

thread_local! {
    static DESK: RefCell<Desk> = RefCell::default();
}

fn with<T>(work: impl FnOnce(&mut Desk) -> T) -> T {
    DESK.with(|desk| work(&mut desk.borrow_mut()))
}

impl Desk {
    fn text(&self) -> &str {
        core::str::from_utf8(&self.input).unwrap_or("")
    }

    /// Leaves what `work` says of the open scene; "null" without one.
    fn say(&mut self, work: impl FnOnce(&mut dyn Bench) -> String) {
        self.output = match &mut self.bench {
            Some(bench) => work(bench.as_mut()),
            None => "null".into(),
        };
    }
}

/// Room for `len` bytes of UTF-8 for the next verb.
#[unsafe(no_mangle)]
pub extern "C" fn input(len: u32) -> *mut u8 {
    with(|desk| {
        desk.input.clear();
        desk.input.resize(len as usize, 0);
        desk.input.as_mut_ptr()
    })
}

/// The text that the last verb left.
#[unsafe(no_mangle)]
pub extern "C" fn output() -> *const u8 {
    with(|desk| desk.output.as_ptr())
}

/// Its length in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn output_len() -> u32 {
    with(|desk| desk.output.len() as u32)
}

/// The numbers that the last verb left.
#[unsafe(no_mangle)]
pub extern "C" fn numbers() -> *const f64 {
    with(|desk| desk.numbers.as_ptr())
}

/// How many there are.
#[unsafe(no_mangle)]
pub extern "C" fn numbers_len() -> u32 {
    with(|desk| desk.numbers.len() as u32)
}

#[derive(Serialize)]
struct Listed<'a> {
    name: &'a str,
    title: &'a str,
    text: &'a str,
}

/// Leaves the version, and all built-in scenes with their files.
#[unsafe(no_mangle)]
pub extern "C" fn list_builtins() {
    with(|desk| {
        let all: Vec<_> = builtins().map(|b| Listed { name: b.name, title: b.title(), text: b.text }).collect();
        desk.output = json(&all);
    });
}

/// Opens a scene (TOML or JSON; or, if it has that name, a built-in one) and leaves its description, or what is wrong with it.
#[unsafe(no_mangle)]
pub extern "C" fn open_scene() -> u32 {
    with(|desk| {
        let text = builtin(desk.text()).unwrap_or(desk.text());
        match open(text) {
            Ok(bench) => {
                desk.output = bench.describe();
                desk.bench = Some(bench);
                1
            }
            Err(problems) => {
                desk.output = problems;
                0
            }
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

/// Leaves the chain of the n-th impact. The input names the language and the letters: "pt-BR Q,I".
#[unsafe(no_mangle)]
pub extern "C" fn explain(n: u32) {
    with(|desk| {
        let text = desk.text().to_owned();
        let (language, letters) = text.split_once(' ').unwrap_or((&text, ""));
        let language: Language = language.parse().unwrap_or_default();
        let symbols = Symbols::named(letters);
        desk.say(|bench| bench.explain(u64::from(n), language, symbols));
    });
}

/// Leaves the numbers of the n-th impact, as `carom explain --format json` prints them.
#[unsafe(no_mangle)]
pub extern "C" fn explain_numbers(n: u32) {
    with(|desk| desk.say(|bench| bench.numbers(u64::from(n))));
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

/// Leaves the open scene as JSON (0: short) or TOML (1: short, 2: every default filled in).
#[unsafe(no_mangle)]
pub extern "C" fn write_scene(form: u32) {
    with(|desk| {
        desk.say(|bench| match form {
            0 => to_json(bench.scene(), Detail::Short),
            1 => to_toml(bench.scene(), Detail::Short),
            _ => to_toml(bench.scene(), Detail::Full),
        });
    });
}
