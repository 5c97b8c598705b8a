//! Text and numbers in and out. A verb takes its text from [`input`] and leaves text in [`output`] or numbers in [`numbers`]; both
//! stay until the next verb. A verb that can fail returns 0 and leaves problems as JSON.
//!
//! Names that the linker must not change are attributes that the compiler counts as unsafe.
#![allow(unsafe_code)]
use core::cell::RefCell;

#[cfg(feature = "engine")]
use crate::bench::Bench;

#[derive(Default)]
pub(crate) struct Desk {
    pub input: Vec<u8>,
    pub output: String,
    pub numbers: Vec<f64>,
    #[cfg(feature = "engine")]
    pub bench: Option<Box<dyn Bench>>,
}

thread_local! {
    static DESK: RefCell<Desk> = RefCell::default();
}

pub(crate) fn with<T>(work: impl FnOnce(&mut Desk) -> T) -> T {
    DESK.with(|desk| work(&mut desk.borrow_mut()))
}

impl Desk {
    /// The input as text.
    pub fn text(&self) -> &str {
        core::str::from_utf8(&self.input).unwrap_or("")
    }

    /// Leaves what `work` says of the open scene; "null" without one.
    #[cfg(feature = "engine")]
    pub fn say(&mut self, work: impl FnOnce(&mut dyn Bench) -> String) {
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
