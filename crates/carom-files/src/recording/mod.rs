//! Recordings: a scene, every impact, and the world itself now and then, in one file that grows while the run goes on.
//!
//! A file is a head and chunks; each chunk has a kind, a length and a checksum. Whatever is cut short (a process killed, a full
//! disk) leaves whole chunks behind which the rest is torn, and the reader takes what is whole. Impacts are stored by what
//! [the laws](coder) do not say of them already.
pub mod coder;
mod reader;
mod writer;

pub use coder::{Stage, Start};
pub use reader::{Keyframe, Recording, Unreadable};
pub use writer::Writer;

/// The first bytes: not text, and damaged by what takes them for text.
pub const MAGIC: [u8; 8] = *b"\x89carom\r\n";
/// The version of the format, behind them.
const VERSION: u32 = 1;
/// Kind (1), length (8), checksum (4).
const CHUNK_HEAD: usize = 13;
/// Impacts in a chunk, at most.
const BLOCK: usize = 4096;

/// What a chunk holds.
const SCENE: u8 = b'S';
const IMPACTS: u8 = b'I';
const KEYFRAME: u8 = b'K';
const END: u8 = b'E';

/// CRC-32 of a chunk: its kind, its length and what it holds.
fn checksum(kind: u8, body: &[u8]) -> u32 {
    let mut crc = flate2::Crc::new();
    crc.update(&[kind]);
    crc.update(&(body.len() as u64).to_le_bytes());
    crc.update(body);
    crc.sum()
}

#[cfg(test)]
mod tests;
