//! A film as GIF: one palette, and of every frame only what differs from the one before. One thread draws, another packs.
use crate::palette::{Census, Palette, SAME};
use crate::raster::Canvas;
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use std::borrow::Cow;
use std::io::{self, Write};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};

/// Frames that may wait to be packed.
const WAITING: usize = 4;
/// Times of a GIF are hundredths of a second.
const PER_SECOND: f64 = 100.0;

/// A film under way.
pub struct Gif<W: Write + Send + 'static> {
    palette: Palette,
    size: [usize; 2],
    /// What is seen, in numbers of the palette; empty before the first frame.
    seen: Vec<u8>,
    /// The tiles of the last frame that differ from the ground.
    was: Vec<bool>,
    frames: Option<SyncSender<Packet>>,
    packing: Option<JoinHandle<io::Result<W>>>,
    /// The frame that is not sent yet, as nobody knows how long it is shown.
    held: Option<Packet>,
    /// When it is shown (hundredths of a second).
    shown: u64,
}

/// The part of a frame that differs.
struct Packet {
    left: usize,
    top: usize,
    width: usize,
    pixels: Vec<u8>,
    delay: u16,
}

impl<W: Write + Send + 'static> Gif<W> {
    /// A film whose colours were counted, written to `out`.
    pub fn new(size: [usize; 2], census: &Census, out: W) -> Self {
        let palette = census.palette();
        let bytes = palette.bytes();
        let (frames, packets) = sync_channel(WAITING);
        let packing = thread::spawn(move || pack(size, &bytes, out, &packets));
        Self {
            palette,
            size,
            seen: Vec::new(),
            was: Vec::new(),
            frames: Some(frames),
            packing: Some(packing),
            held: None,
            shown: 0,
        }
    }

    /// The next frame, shown from this time of the film on (s).
    ///
    /// # Errors
    /// What the writer says.
    pub fn frame(&mut self, canvas: &Canvas, time: f64) -> io::Result<()> {
        let now = (time * PER_SECOND).round().max(0.0) as u64;
        self.release(now)?;
        let [width, height] = self.size;
        let mut packet = Packet { left: 0, top: 0, width, pixels: Vec::new(), delay: 0 };
        if self.seen.is_empty() {
            self.seen = canvas.pixels().chunks_exact(4).map(|p| self.palette.number([p[0], p[1], p[2]])).collect();
            packet.pixels = self.seen.clone();
        } else {
            packet = self.difference(canvas);
        }
        debug_assert!(packet.width * (packet.pixels.len() / packet.width.max(1)) <= width * height);
        self.was = canvas.tiles().to_vec();
        self.held = Some(packet);
        self.shown = now;
        Ok(())
    }

    /// What differs from what is seen, in the tiles that were drawn on, now or before.
    fn difference(&mut self, canvas: &Canvas) -> Packet {
        let [width, _] = self.size;
        let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
        let mut changed: Vec<(usize, u8)> = Vec::new();
        let pixels = canvas.pixels();
        for k in 0..canvas.tiles().len() {
            if !canvas.tiles()[k] && !self.was.get(k).copied().unwrap_or(true) {
                continue;
            }
            let (columns, rows) = canvas.tile(k);
            for y in rows[0]..rows[1] {
                for x in columns[0]..columns[1] {
                    let at = y * width + x;
                    let number = self.palette.number([pixels[4 * at], pixels[4 * at + 1], pixels[4 * at + 2]]);
                    if number != self.seen[at] {
                        self.seen[at] = number;
                        changed.push((at, number));
                        low = [low[0].min(x), low[1].min(y)];
                        high = [high[0].max(x + 1), high[1].max(y + 1)];
                    }
                }
            }
        }
        if changed.is_empty() {
            // A GIF has no empty frame.
            return Packet { left: 0, top: 0, width: 1, pixels: vec![SAME], delay: 0 };
        }
        let wide = high[0] - low[0];
        let mut part = vec![SAME; wide * (high[1] - low[1])];
        for (at, number) in changed {
            part[(at / width - low[1]) * wide + at % width - low[0]] = number;
        }
        Packet { left: low[0], top: low[1], width: wide, pixels: part, delay: 0 }
    }

    /// Sends the frame that is held, now that it is known until when it is shown.
    fn release(&mut self, until: u64) -> io::Result<()> {
        let Some(mut packet) = self.held.take() else { return Ok(()) };
        packet.delay = u16::try_from(until.saturating_sub(self.shown)).unwrap_or(u16::MAX);
        let sent = self.frames.as_ref().is_some_and(|frames| frames.send(packet).is_ok());
        // If nobody packs any more, whoever did says why.
        if sent { Ok(()) } else { self.packed().map(|_| ()) }
    }

    fn packed(&mut self) -> io::Result<W> {
        self.frames = None;
        match self.packing.take().map(JoinHandle::join) {
            Some(Ok(result)) => result,
            _ => Err(io::Error::other("the GIF could not be packed")),
        }
    }

    /// The end; the last frame is shown until this time (s). Gives back what it was written to.
    ///
    /// # Errors
    /// What the writer says.
    pub fn finish(mut self, time: f64) -> io::Result<W> {
        self.release((time * PER_SECOND).round().max(0.0) as u64)?;
        self.packed()
    }
}

fn pack<W: Write>([width, height]: [usize; 2], palette: &[u8], out: W, packets: &Receiver<Packet>) -> io::Result<W> {
    let told = |e: gif::EncodingError| match e {
        gif::EncodingError::Io(e) => e,
        other => io::Error::other(other.to_string()),
    };
    let size = |n: usize| u16::try_from(n).map_err(|_| io::Error::other("a GIF is at most 65535 pixels wide and high"));
    let mut encoder = Encoder::new(out, size(width)?, size(height)?, palette).map_err(told)?;
    encoder.set_repeat(Repeat::Infinite).map_err(told)?;
    for packet in packets {
        let frame = Frame {
            delay: packet.delay,
            dispose: DisposalMethod::Keep,
            transparent: Some(SAME),
            left: size(packet.left)?,
            top: size(packet.top)?,
            width: size(packet.width)?,
            height: size(packet.pixels.len() / packet.width)?,
            buffer: Cow::Owned(packet.pixels),
            ..Frame::default()
        };
        encoder.write_frame(&frame).map_err(told)?;
    }
    let mut out = encoder.into_inner().map_err(told)?;
    out.flush()?;
    Ok(out)
}
