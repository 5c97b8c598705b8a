//! A recording that is read: what is whole of it.
use super::coder::{Decoder, Stage, read_whole};
use super::{BLOCK, CHUNK_HEAD, END, IMPACTS, KEYFRAME, MAGIC, SCENE, VERSION, checksum};
use carom::{Impact, Rotates, Vector};
use flate2::read::DeflateDecoder;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// Why a file is no recording.
#[derive(Debug)]
pub enum Unreadable {
    /// The system says so.
    Io(io::Error),
    /// What is wrong with it.
    Wrong(String),
}

impl From<io::Error> for Unreadable {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl std::fmt::Display for Unreadable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Io(error) => error.fmt(f),
            Self::Wrong(what) => f.write_str(what),
        }
    }
}

/// The world at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keyframe {
    /// The time (s).
    pub time: f64,
    /// How many impacts there had been.
    pub impacts: u64,
    /// Where it stands in the file, and where it ends.
    at: u64,
    end: u64,
}

impl Keyframe {
    /// Where it ends in the file: what goes on from here is written there.
    pub fn end(&self) -> u64 {
        self.end
    }
}

/// A recording: its scene, where everything is, and how it ended.
#[derive(Clone, Debug)]
pub struct Recording {
    path: PathBuf,
    /// 1, 2 or 3.
    pub dim: usize,
    /// The scene, as JSON.
    pub scene: String,
    /// The world now and then, in order; the first at time 0.
    pub keyframes: Vec<Keyframe>,
    /// Why the run stopped, and its digest; `None` if it was cut short.
    pub stopped: Option<(String, String)>,
    /// The impacts that are whole.
    pub impacts: u64,
    /// True if something torn follows what is whole.
    pub torn: bool,
    blocks: Vec<u64>,
}

impl Recording {
    /// True if a file of these first bytes is a recording.
    pub fn is_one(bytes: &[u8]) -> bool {
        bytes.starts_with(&MAGIC)
    }

    /// Looks through a file. What is torn at its end is left out.
    pub fn open(path: &Path) -> Result<Self, Unreadable> {
        let mut from = BufReader::new(File::open(path)?);
        let size = from.get_ref().metadata()?.len();
        let mut head = [0; 16];
        if from.read_exact(&mut head).is_err() || !Self::is_one(&head) {
            return Err(Unreadable::Wrong("this is no recording: it does not begin as one".into()));
        }
        let number = |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
        if number(8) != VERSION {
            let message = format!("this recording has version {}; this carom reads version {VERSION}", number(8));
            return Err(Unreadable::Wrong(message));
        }
        let dim = number(12) as usize;
        let mut found = Self {
            path: path.to_path_buf(),
            dim,
            scene: String::new(),
            keyframes: Vec::new(),
            stopped: None,
            impacts: 0,
            torn: false,
            blocks: Vec::new(),
        };
        let mut at = 16;
        while let Some((kind, body)) = chunk(&mut from, size - at)? {
            let end = at + (CHUNK_HEAD + body.len()) as u64;
            if found.add(kind, &body, at, end).is_none() {
                break;
            }
            at = end;
        }
        found.torn = at < size;
        if found.scene.is_empty() || found.keyframes.is_empty() || !(1..=3).contains(&dim) {
            return Err(Unreadable::Wrong("this recording was cut short before anything was recorded".into()));
        }
        Ok(found)
    }

    /// Takes a chunk; `None` if it makes no sense.
    fn add(&mut self, kind: u8, body: &[u8], at: u64, end: u64) -> Option<()> {
        match kind {
            SCENE => {
                self.scene = String::from_utf8(unpacked(body)?).ok()?;
            }
            IMPACTS => {
                let mut rest = body;
                let first = read_whole(&mut rest)?;
                let count = read_whole(&mut rest)?;
                if first != self.impacts || count == 0 || count > BLOCK as u64 {
                    return None;
                }
                self.impacts += count;
                self.blocks.push(at);
                self.stopped = None;
            }
            KEYFRAME => {
                let (time, mut rest) = body.split_first_chunk::<8>()?;
                let time = f64::from_bits(u64::from_le_bytes(*time));
                let impacts = read_whole(&mut rest)?;
                if impacts != self.impacts {
                    return None;
                }
                self.keyframes.push(Keyframe { time, impacts, at, end });
                self.stopped = None;
            }
            END => {
                let text = std::str::from_utf8(body).ok()?;
                let (stopped, digest) = text.split_once(' ')?;
                self.stopped = Some((stopped.into(), digest.into()));
            }
            // What a later version adds, and this one can do without.
            _ => {}
        }
        Some(())
    }

    /// The last keyframe: where the run goes on.
    pub fn last(&self) -> Keyframe {
        self.keyframes[self.keyframes.len() - 1]
    }

    /// The last keyframe at or before a time (s); the first if there is none.
    pub fn before(&self, time: f64) -> Keyframe {
        let after = self.keyframes.partition_point(|k| k.time <= time);
        self.keyframes[after.saturating_sub(1)]
    }

    /// The snapshot of a keyframe.
    pub fn snapshot(&self, keyframe: &Keyframe) -> Result<Vec<u8>, Unreadable> {
        let body = self.body(keyframe.at)?;
        let mut rest = body.get(8..).unwrap_or_default();
        let snapshot = read_whole(&mut rest).and_then(|_| unpacked(rest));
        snapshot.ok_or_else(|| Unreadable::Wrong("a keyframe of this recording is damaged".into()))
    }

    /// Reads the first `count` impacts, piece by piece, with the number (from 1) of each piece's first. `tell` says whether to
    /// go on.
    pub fn read<const D: usize, E>(
        &self,
        stage: Stage<D>,
        count: u64,
        mut tell: impl FnMut(u64, &[Impact<D>]) -> Result<bool, E>,
    ) -> Result<Result<Decoder<D>, E>, Unreadable>
    where
        Vector<D>: Rotates,
    {
        let mut decoder = Decoder::new(stage);
        let mut first = 1;
        for &at in &self.blocks {
            if first > count {
                break;
            }
            let body = self.body(at)?;
            let mut rest = &body[..];
            let read = read_whole(&mut rest).and_then(|_| read_whole(&mut rest)).and_then(|_| unpacked(rest));
            let impacts = read.and_then(|block| decoder.block(&block));
            let Some(impacts) = impacts else {
                return Err(Unreadable::Wrong(format!(
                    "the impacts of this recording are damaged behind number {}",
                    first - 1
                )));
            };
            let wanted = impacts.len().min(usize::try_from(count - (first - 1)).unwrap_or(usize::MAX));
            match tell(first, &impacts[..wanted]) {
                Ok(true) => first += impacts.len() as u64,
                Ok(false) => break,
                Err(error) => return Ok(Err(error)),
            }
        }
        Ok(Ok(decoder))
    }

    fn body(&self, at: u64) -> Result<Vec<u8>, Unreadable> {
        let mut file = File::open(&self.path)?;
        let size = file.metadata()?.len();
        file.seek(SeekFrom::Start(at))?;
        match chunk(&mut file, size.saturating_sub(at))? {
            Some((_, body)) => Ok(body),
            None => Err(Unreadable::Wrong("this recording has changed while it was read".into())),
        }
    }
}

/// The next chunk, if it is whole.
fn chunk(from: &mut impl Read, left: u64) -> io::Result<Option<(u8, Vec<u8>)>> {
    if left < CHUNK_HEAD as u64 {
        return Ok(None);
    }
    let mut head = [0; CHUNK_HEAD];
    from.read_exact(&mut head)?;
    let length = head[1..9].iter().rev().fold(0u64, |x, &b| x << 8 | u64::from(b));
    let sum = u32::from_le_bytes([head[9], head[10], head[11], head[12]]);
    if length > left - CHUNK_HEAD as u64 {
        return Ok(None);
    }
    let Ok(length) = usize::try_from(length) else { return Ok(None) };
    let mut body = vec![0; length];
    from.read_exact(&mut body)?;
    Ok((checksum(head[0], &body) == sum).then_some((head[0], body)))
}

/// The most that a chunk may hold, packed ever so well: the largest world there is, many times over.
const LARGEST: u64 = 1 << 36;

fn unpacked(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut all = Vec::new();
    // A byte of deflate holds 1032 at most.
    let most = (bytes.len() as u64).saturating_mul(1032).min(LARGEST);
    DeflateDecoder::new(bytes).take(most + 1).read_to_end(&mut all).ok()?;
    (all.len() as u64 <= most).then_some(all)
}
