//! VTK PolyData (`.vtp`), a file per frame, and the collection (`.pvd`) that gives each its time: ParaView, VTK, PyVista.
//!
//! Points with velocity, spin (`omega`), radius, mass, id and kind. The numbers stand raw behind the XML (little-endian,
//! `appended`), so that the last bit is there and a million points are no text.
use crate::cast::{Cast, Frame};
use std::io::{self, Write};

/// Writes the file of one frame.
pub fn write(to: &mut impl Write, cast: &Cast, frame: &Frame<'_>) -> io::Result<()> {
    let n = frame.bodies.len();
    let mut arrays = Arrays::default();
    let vectors = |of: fn(&crate::cast::Moment) -> [f64; 3]| frame.bodies.iter().flat_map(of);
    let actors = || cast.bodies.iter().take(n);
    let time = arrays.floats("TimeValue", 1, [frame.time]);
    let velocity = arrays.floats("velocity", 3, vectors(|b| b.velocity));
    let omega = arrays.floats("omega", 3, vectors(|b| b.spin));
    let radius = arrays.floats("radius", 1, actors().map(|a| a.radius));
    let mass = arrays.floats("mass", 1, actors().map(|a| a.mass_or_zero()));
    let id = arrays.wholes("id", 1..=n as i64);
    let kind = arrays.wholes("kind", actors().map(|a| i64::from(a.kind)));
    let points = arrays.floats("Points", 3, vectors(|b| b.position));
    let connectivity = arrays.wholes("connectivity", 0..n as i64);
    let offsets = arrays.wholes("offsets", 1..=n as i64);
    writeln!(to, r#"<?xml version="1.0"?>"#)?;
    writeln!(to, r#"<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#)?;
    let time = time.replace("/>", r#" NumberOfTuples="1"/>"#);
    writeln!(to, "<PolyData>\n<FieldData>\n{time}\n</FieldData>")?;
    let none = r#"NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0""#;
    writeln!(to, r#"<Piece NumberOfPoints="{n}" NumberOfVerts="{n}" {none}>"#)?;
    writeln!(
        to,
        "<PointData Vectors=\"velocity\" Scalars=\"radius\">\n{velocity}\n{omega}\n{radius}\n{mass}\n{id}\n{kind}"
    )?;
    writeln!(to, "</PointData>\n<Points>\n{points}\n</Points>\n<Verts>\n{connectivity}\n{offsets}\n</Verts>")?;
    writeln!(to, "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">")?;
    to.write_all(b"_")?;
    to.write_all(&arrays.raw)?;
    writeln!(to, "\n</AppendedData>\n</VTKFile>")
}

/// Writes the collection: times (s) and file names, relative to its own folder.
pub fn collection<'a>(to: &mut impl Write, frames: impl IntoIterator<Item = (f64, &'a str)>) -> io::Result<()> {
    writeln!(to, r#"<?xml version="1.0"?>"#)?;
    writeln!(to, r#"<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">"#)?;
    writeln!(to, "<Collection>")?;
    for (time, name) in frames {
        let name = name.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;");
        writeln!(to, r#"<DataSet timestep="{time:?}" part="0" file="{name}"/>"#)?;
    }
    writeln!(to, "</Collection>\n</VTKFile>")
}

/// The raw numbers, each array behind its length in bytes.
#[derive(Default)]
struct Arrays {
    raw: Vec<u8>,
}

impl Arrays {
    fn floats(&mut self, name: &str, components: usize, numbers: impl IntoIterator<Item = f64>) -> String {
        self.add("Float64", name, components, numbers.into_iter().map(f64::to_le_bytes))
    }

    fn wholes(&mut self, name: &str, numbers: impl IntoIterator<Item = i64>) -> String {
        self.add("Int64", name, 1, numbers.into_iter().map(i64::to_le_bytes))
    }

    /// Adds an array; the XML that says where it is.
    fn add(&mut self, kind: &str, name: &str, components: usize, numbers: impl Iterator<Item = [u8; 8]>) -> String {
        let offset = self.raw.len();
        self.raw.extend([0; 8]);
        numbers.for_each(|bytes| self.raw.extend(bytes));
        let length = (self.raw.len() - offset - 8) as u64;
        self.raw[offset..offset + 8].copy_from_slice(&length.to_le_bytes());
        let components = if components == 1 { String::new() } else { format!(r#" NumberOfComponents="{components}""#) };
        format!(r#"<DataArray type="{kind}" Name="{name}"{components} format="appended" offset="{offset}"/>"#)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cast::tests::two;

    /// Reads an array of eight-byte numbers back.
    fn array(file: &[u8], name: &str) -> Vec<[u8; 8]> {
        let start = file.windows(11).position(|w| w == b"ng=\"raw\">\n_").unwrap() + 11;
        let text = String::from_utf8_lossy(&file[..start]).into_owned();
        let entry = text.lines().find(|l| l.contains(&format!("Name=\"{name}\""))).unwrap();
        let offset = entry.split("offset=\"").nth(1).unwrap().split('"').next().unwrap();
        let at = start + offset.parse::<usize>().unwrap();
        let length = u64::from_le_bytes(file[at..at + 8].try_into().unwrap()) as usize;
        file[at + 8..at + 8 + length].chunks(8).map(|c| c.try_into().unwrap()).collect()
    }

    #[test]
    fn every_number_comes_back() {
        let (cast, moments) = two();
        let mut file = Vec::new();
        write(&mut file, &cast, &Frame { number: 3, time: 0.1, bodies: &moments }).unwrap();
        let floats = |name: &str| -> Vec<f64> { array(&file, name).into_iter().map(f64::from_le_bytes).collect() };
        assert_eq!(floats("TimeValue"), [0.1]);
        assert_eq!(floats("Points"), moments.iter().flat_map(|m| m.position).collect::<Vec<_>>());
        assert_eq!(floats("velocity"), moments.iter().flat_map(|m| m.velocity).collect::<Vec<_>>());
        assert_eq!(floats("omega"), moments.iter().flat_map(|m| m.spin).collect::<Vec<_>>());
        assert_eq!(floats("radius"), cast.bodies.iter().map(|b| b.radius).collect::<Vec<_>>());
        let wholes = |name: &str| -> Vec<i64> { array(&file, name).into_iter().map(i64::from_le_bytes).collect() };
        assert_eq!((wholes("id"), wholes("connectivity"), wholes("offsets")), (vec![1, 2], vec![0, 1], vec![1, 2]));
        assert_eq!(wholes("kind"), [1, 2]);
    }

    #[test]
    fn names_of_files_may_hold_anything() {
        let mut file = Vec::new();
        collection(&mut file, [(0.5, "a & b/\"c\".vtp")]).unwrap();
        let text = String::from_utf8(file).unwrap();
        assert!(text.contains(r#"timestep="0.5" part="0" file="a &amp; b/&quot;c&quot;.vtp""#), "{text}");
    }
}
