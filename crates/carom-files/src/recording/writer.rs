//! A recording that grows.
use super::coder::{Encoder, write_whole};
use super::{BLOCK, CHUNK_HEAD, END, IMPACTS, KEYFRAME, MAGIC, SCENE, VERSION, checksum};
use carom::{Impact, Rotates, Vector};
use flate2::Compression;
use flate2::write::DeflateEncoder;
use std::io::{self, Write};

/// A recording under way.
pub struct Writer<const D: usize, W: Write>
where
    Vector<D>: Rotates,
{
    to: W,
    encoder: Encoder<D>,
    /// Impacts written, and the bytes of whole chunks.
    impacts: u64,
    whole: u64,
}

impl<const D: usize, W: Write> Writer<D, W>
where
    Vector<D>: Rotates,
{
    /// Starts a recording of this scene (JSON).
    pub fn new(mut to: W, encoder: Encoder<D>, scene: &str) -> io::Result<Self> {
        to.write_all(&MAGIC)?;
        to.write_all(&VERSION.to_le_bytes())?;
        to.write_all(&(D as u32).to_le_bytes())?;
        let mut writer = Self { to, encoder, impacts: 0, whole: (MAGIC.len() + 8) as u64 };
        writer.scene(scene)?;
        Ok(writer)
    }

    /// Goes on with one that holds so many impacts in so many bytes; what is written to stands behind them.
    pub fn resume(to: W, encoder: Encoder<D>, impacts: u64, whole: u64) -> Self {
        Self { to, encoder, impacts, whole }
    }

    /// What it is written to.
    pub fn get_ref(&self) -> &W {
        &self.to
    }

    /// The same, to be written to by nobody else.
    pub fn get_mut(&mut self) -> &mut W {
        &mut self.to
    }

    /// The bytes of all whole chunks: where a file that could not be written any further is to be cut.
    pub fn whole(&self) -> u64 {
        self.whole
    }

    /// A scene (JSON) that replaces the one before it.
    pub fn scene(&mut self, scene: &str) -> io::Result<()> {
        let packed = packed(scene.as_bytes(), Compression::default())?;
        self.chunk(SCENE, &packed)
    }

    /// Adds impacts.
    pub fn impacts(&mut self, impacts: &[Impact<D>]) -> io::Result<()> {
        for impact in impacts {
            if self.encoder.add(impact) == BLOCK {
                self.flush_impacts()?;
            }
        }
        Ok(())
    }

    fn flush_impacts(&mut self) -> io::Result<()> {
        let count = self.encoder.count();
        if count == 0 {
            return Ok(());
        }
        let mut body = Vec::new();
        write_whole(self.impacts, &mut body);
        write_whole(count as u64, &mut body);
        body.extend(packed(&self.encoder.block(), Compression::fast())?);
        self.impacts += count as u64;
        self.chunk(IMPACTS, &body)
    }

    /// Adds the world as it is now ([`carom::World::snapshot`]), at this time (s), behind all impacts so far; and hands all of it to the
    /// system, so that a process which ends here leaves it.
    pub fn keyframe(&mut self, time: f64, snapshot: &[u8]) -> io::Result<()> {
        self.flush_impacts()?;
        let mut body = time.to_bits().to_le_bytes().to_vec();
        write_whole(self.impacts, &mut body);
        body.extend(packed(snapshot, Compression::fast())?);
        self.chunk(KEYFRAME, &body)?;
        self.to.flush()
    }

    /// The run has stopped: why, and with which digest.
    pub fn end(&mut self, stopped: &str, digest: &str) -> io::Result<()> {
        self.chunk(END, format!("{stopped} {digest}").as_bytes())?;
        self.to.flush()
    }

    fn chunk(&mut self, kind: u8, body: &[u8]) -> io::Result<()> {
        let mut head = Vec::with_capacity(CHUNK_HEAD);
        head.push(kind);
        head.extend((body.len() as u64).to_le_bytes());
        head.extend(checksum(kind, body).to_le_bytes());
        self.to.write_all(&head)?;
        self.to.write_all(body)?;
        self.whole += (CHUNK_HEAD + body.len()) as u64;
        Ok(())
    }
}

fn packed(bytes: &[u8], how: Compression) -> io::Result<Vec<u8>> {
    let mut packer = DeflateEncoder::new(Vec::new(), how);
    packer.write_all(bytes)?;
    packer.finish()
}
