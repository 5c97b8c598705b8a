//! GSD 2.0 with the schema `hoomd` 1.4: what HOOMD-blue, freud, OVITO and the `gsd` package read.
//!
//! A binary file of named chunks, each an array of one frame, and an index of them behind the last one. The schema has
//! single precision; the time (s, double precision) is `log/time`, spins (rad/s) are `log/particles/angular_velocity`. Its boxes lie around the origin: along a
//! periodic axis positions are taken relative to the middle of the box, which stands in `log/origin`; elsewhere positions are
//! the world's, and the box is as large as it has to be to hold them.
//!
//! Layout: <https://gsd.readthedocs.io/en/stable/file-layer.html>, schema: <https://gsd.readthedocs.io/en/stable/schema-hoomd.html>.
use crate::cast::{Cast, Frame};
use std::io::{self, Seek, SeekFrom, Write};

const MAGIC: u64 = 0x65DF_65DF_65DF_65DF;
const HEADER: u64 = 256;
/// A name list is allocated in pieces of this size.
const NAME: usize = 64;

/// Codes of types in the file layer.
const UINT8: u8 = 1;
const UINT32: u8 = 3;
const UINT64: u8 = 4;
const INT8: u8 = 5;
const FLOAT: u8 = 9;
const DOUBLE: u8 = 10;

/// A file under way.
pub struct Writer<W> {
    to: W,
    /// Where the next chunk goes.
    at: u64,
    index: Vec<u8>,
    entries: u64,
    names: Vec<&'static str>,
    frame: u64,
}

impl<W: Write + Seek> Writer<W> {
    /// Starts a file.
    pub fn new(mut to: W) -> io::Result<Self> {
        to.write_all(&[0; HEADER as usize])?;
        Ok(Self { to, at: HEADER, index: Vec::new(), entries: 0, names: Vec::new(), frame: 0 })
    }

    /// Adds a frame.
    pub fn frame(&mut self, cast: &Cast, frame: &Frame<'_>) -> io::Result<()> {
        let n = frame.bodies.len();
        let (low, high) = cast.cell(frame);
        let (mut size, mut origin) = ([0.0; 3], [0.0; 3]);
        for k in 0..3 {
            if cast.bounds.periodic[k] {
                origin[k] = 0.5 * (low[k] + high[k]);
                size[k] = high[k] - low[k];
            } else {
                size[k] = 2.0 * f64::max(-low[k], high[k]);
            }
        }
        if cast.dim < 3 {
            size[2] = 1.0;
        }
        self.chunk("configuration/step", UINT64, 1, frame.number.to_le_bytes())?;
        let dim = cast.dim.max(2) as u8;
        self.chunk("configuration/dimensions", UINT8, 1, [dim])?;
        self.chunk("configuration/box", FLOAT, 1, floats(size.into_iter().chain([0.0; 3])))?;
        self.chunk("particles/N", UINT32, 1, (n as u32).to_le_bytes())?;
        let longest = cast.kinds.iter().map(|k| k.len() + 1).max().unwrap_or(1);
        let types = cast
            .kinds
            .iter()
            .flat_map(|kind| kind.bytes().chain(std::iter::repeat(0)).take(longest))
            .collect::<Vec<u8>>();
        self.chunk("particles/types", INT8, longest, types)?;
        let kinds = cast.bodies.iter().flat_map(|b| b.kind.saturating_sub(1).to_le_bytes());
        self.chunk("particles/typeid", UINT32, 1, kinds.collect::<Vec<u8>>())?;
        self.chunk("particles/mass", FLOAT, 1, floats(cast.bodies.iter().map(|b| b.mass_or_zero())))?;
        self.chunk("particles/diameter", FLOAT, 1, floats(cast.bodies.iter().map(|b| 2.0 * b.radius)))?;
        let places = frame.bodies.iter().flat_map(|b| (0..3).map(|k| b.position[k] - origin[k]));
        self.chunk("particles/position", FLOAT, 3, floats(places))?;
        self.chunk("particles/velocity", FLOAT, 3, floats(frame.bodies.iter().flat_map(|b| b.velocity)))?;
        self.chunk("log/time", DOUBLE, 1, frame.time.to_le_bytes())?;
        self.chunk("log/origin", DOUBLE, 1, origin.into_iter().flat_map(f64::to_le_bytes).collect::<Vec<u8>>())?;
        self.chunk("log/particles/angular_velocity", FLOAT, 3, floats(frame.bodies.iter().flat_map(|b| b.spin)))?;
        self.frame += 1;
        Ok(())
    }

    /// Adds a chunk of rows of `columns` numbers of this type.
    fn chunk(&mut self, name: &'static str, kind: u8, columns: usize, bytes: impl AsRef<[u8]>) -> io::Result<()> {
        let bytes = bytes.as_ref();
        let id = self.names.iter().position(|n| *n == name).unwrap_or_else(|| {
            self.names.push(name);
            self.names.len() - 1
        });
        let width = match kind {
            UINT8 | INT8 => 1,
            UINT64 | DOUBLE => 8,
            _ => 4,
        };
        let rows = (bytes.len() / (width * columns.max(1))) as u64;
        if rows == 0 {
            return Ok(());
        }
        self.to.write_all(bytes)?;
        self.index.extend(self.frame.to_le_bytes());
        self.index.extend(rows.to_le_bytes());
        self.index.extend(self.at.to_le_bytes());
        self.index.extend((columns as u32).to_le_bytes());
        self.index.extend((id as u16).to_le_bytes());
        self.index.extend([kind, 0]);
        self.entries += 1;
        self.at += bytes.len() as u64;
        Ok(())
    }

    /// Completes the file: names, index, and the header that says where they are. What it was written to comes back.
    pub fn finish(mut self) -> io::Result<W> {
        let mut names: Vec<u8> = self.names.iter().flat_map(|n| n.bytes().chain([0])).collect();
        let pieces = names.len() / NAME + 1;
        names.resize(pieces * NAME, 0);
        let (names_at, index_at) = (self.at, self.at + names.len() as u64);
        self.to.write_all(&names)?;
        // An entry of zeros ends the index.
        self.index.extend([0; 32]);
        self.to.write_all(&self.index)?;
        let mut header = Vec::with_capacity(HEADER as usize);
        header.extend(MAGIC.to_le_bytes());
        header.extend(index_at.to_le_bytes());
        header.extend((self.entries + 1).to_le_bytes());
        header.extend(names_at.to_le_bytes());
        header.extend((pieces as u64).to_le_bytes());
        header.extend((1u32 << 16 | 4).to_le_bytes());
        header.extend((2u32 << 16).to_le_bytes());
        for text in [concat!("carom ", env!("CARGO_PKG_VERSION")), "hoomd"] {
            let mut field = text.as_bytes().to_vec();
            field.resize(64, 0);
            header.extend(field);
        }
        header.resize(HEADER as usize, 0);
        self.to.seek(SeekFrom::Start(0))?;
        self.to.write_all(&header)?;
        self.to.seek(SeekFrom::End(0))?;
        Ok(self.to)
    }
}

/// Single precision, as the schema has it.
fn floats(numbers: impl Iterator<Item = f64>) -> Vec<u8> {
    numbers.flat_map(|x| (x as f32).to_le_bytes()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cast::tests::two;
    use std::io::Cursor;

    fn number(bytes: &[u8], at: usize, width: usize) -> u64 {
        bytes[at..at + width].iter().rev().fold(0, |x, &b| x << 8 | u64::from(b))
    }

    /// The bytes of a chunk, found as the layout says.
    fn chunk<'a>(file: &'a [u8], frame: u64, name: &str) -> &'a [u8] {
        assert_eq!(number(file, 0, 8), MAGIC);
        let (index, entries) = (number(file, 8, 8) as usize, number(file, 16, 8) as usize);
        let (names, pieces) = (number(file, 24, 8) as usize, number(file, 32, 8) as usize);
        let names: Vec<&[u8]> = file[names..names + pieces * NAME].split(|b| *b == 0).collect();
        let id = names.iter().position(|n| *n == name.as_bytes()).unwrap() as u64;
        let entry = |k: usize| index + 32 * k;
        let found = (0..entries).find(|&k| number(file, entry(k), 8) == frame && number(file, entry(k) + 28, 2) == id);
        let at = entry(found.unwrap());
        let (rows, location, columns) = (number(file, at + 8, 8), number(file, at + 16, 8), number(file, at + 24, 4));
        let width = match file[at + 30] {
            UINT8 | INT8 => 1,
            UINT64 | DOUBLE => 8,
            _ => 4,
        };
        &file[location as usize..(location + rows * columns * width) as usize]
    }

    #[test]
    fn chunks_are_where_the_index_says() {
        let (cast, moments) = two();
        let mut writer = Writer::new(Cursor::new(Vec::new())).unwrap();
        for number in 0..3 {
            writer.frame(&cast, &Frame { number, time: 0.1 * number as f64, bodies: &moments }).unwrap();
        }
        let file = writer.finish().unwrap().into_inner();
        let singles = |frame, name| -> Vec<f32> {
            chunk(&file, frame, name).chunks(4).map(|c| f32::from_le_bytes(c.try_into().unwrap())).collect()
        };
        assert_eq!(number(chunk(&file, 2, "configuration/step"), 0, 8), 2);
        assert_eq!(chunk(&file, 2, "log/time"), (0.1f64 * 2.0).to_le_bytes());
        // Periodic along x, from -1 to 3: its middle is 1.
        let want: Vec<f32> = moments
            .iter()
            .flat_map(|m| [m.position[0] - 1.0, m.position[1], m.position[2]])
            .map(|x| x as f32)
            .collect();
        assert_eq!(singles(1, "particles/position"), want);
        assert_eq!(singles(1, "configuration/box")[..3], [4.0, 4.0, 1.0]);
        assert_eq!(singles(0, "particles/diameter"), [1.0, 0.5]);
        assert_eq!(chunk(&file, 0, "particles/types"), b"A\0\0\0\0disc\0");
    }
}
