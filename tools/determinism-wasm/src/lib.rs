//! The worlds of `examples/digest.rs` behind raw exports: `run` one, then read what it came to in halves of 32 bits.
use core::sync::atomic::{AtomicU64, Ordering};

#[allow(dead_code)]
#[path = "../../../crates/carom/examples/digest.rs"]
mod digest;

use digest::{PLAIN, SCENES};

static LAST: [AtomicU64; 3] = [const { AtomicU64::new(0) }; 3];

/// How many worlds there are.
#[unsafe(no_mangle)]
pub extern "C" fn scenes() -> u32 {
    SCENES.len() as u32
}

/// The byte `k` of a world's name; 0 after the last.
#[unsafe(no_mangle)]
pub extern "C" fn name(scene: u32, k: u32) -> u32 {
    SCENES[scene as usize].0.as_bytes().get(k as usize).copied().unwrap_or(0).into()
}

/// Runs a world.
#[unsafe(no_mangle)]
pub extern "C" fn run(scene: u32) {
    let print = SCENES[scene as usize].1(PLAIN);
    for (last, now) in LAST.iter().zip([print.digest, print.impacts, print.count]) {
        last.store(now, Ordering::Relaxed);
    }
}

/// Half of a number of the last run: the digest (0), the hash of the impacts (1), their number (2); the low half (0) or the high
/// one (1).
#[unsafe(no_mangle)]
pub extern "C" fn half(which: u32, high: u32) -> u32 {
    (LAST[which as usize].load(Ordering::Relaxed) >> (32 * high)) as u32
}
