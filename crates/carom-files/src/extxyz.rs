//! Extended XYZ: a line of counts, a line of keys, a line per body; frame after frame. Read by ASE, OVITO and many others.
//!
//! Every body is of the species "X", which the readers know as a particle that is no chemical element. Keys and columns by
//! the names that ASE and OVITO understand: `pos`, `velo`, `radius`, `mass`, `id`; `omega` is the spin (rad/s) and `kind` the
//! number of the group. Without an edge there is no `Lattice`.
use crate::cast::{Cast, Frame};
use std::io::{self, Write};

/// Adds a frame to the file.
pub fn write(to: &mut impl Write, cast: &Cast, frame: &Frame<'_>) -> io::Result<()> {
    writeln!(to, "{}", frame.bodies.len())?;
    let (low, high) = cast.cell(frame);
    let edge = |k: usize| cast.bounds.min[k].is_finite() && cast.bounds.max[k].is_finite();
    if (0..cast.dim).any(edge) {
        let size = |k: usize| high[k] - low[k];
        let (x, y, z) = (size(0), size(1), size(2));
        write!(to, "Lattice=\"{x:?} 0.0 0.0 0.0 {y:?} 0.0 0.0 0.0 {z:?}\" ")?;
        write!(to, "Origin=\"{:?} {:?} {:?}\" ", low[0], low[1], low[2])?;
    }
    let letter = |k: usize| if cast.bounds.periodic[k] { 'T' } else { 'F' };
    write!(to, "Properties=species:S:1:pos:R:3:velo:R:3:omega:R:3:radius:R:1:mass:R:1:id:I:1:kind:I:1 ")?;
    writeln!(to, "Time={:?} frame={} pbc=\"{} {} {}\"", frame.time, frame.number, letter(0), letter(1), letter(2))?;
    for (k, (actor, at)) in cast.bodies.iter().zip(frame.bodies).enumerate() {
        let ([x, y, z], [u, v, w], [p, q, r]) = (at.position, at.velocity, at.spin);
        write!(to, "X {x:?} {y:?} {z:?} {u:?} {v:?} {w:?} {p:?} {q:?} {r:?} ")?;
        writeln!(to, "{:?} {:?} {} {}", actor.radius, actor.mass_or_zero(), k + 1, actor.kind)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cast::tests::two;

    #[test]
    fn every_number_comes_back() {
        let (cast, moments) = two();
        let mut text = Vec::new();
        for number in 0..2 {
            write(&mut text, &cast, &Frame { number, time: 0.1 * number as f64, bodies: &moments }).unwrap();
        }
        let text = String::from_utf8(text).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 2 * 4);
        assert_eq!((lines[0], lines[4]), ("2", "2"));
        assert!(lines[1].starts_with("Lattice=\"4.0 0.0 0.0 0.0 3.0 0.0 0.0 0.0 1.0\" Origin=\"-1.0 -1.0 -0.5\" "));
        assert!(lines[5].ends_with("Time=0.1 frame=1 pbc=\"T F F\""), "{}", lines[5]);
        for (k, moment) in moments.iter().enumerate() {
            let cells: Vec<&str> = lines[2 + k].split(' ').collect();
            assert_eq!((cells[0], cells.len()), ("X", 14));
            let numbers: Vec<f64> = cells[1..12].iter().map(|c| c.parse().unwrap()).collect();
            assert_eq!(numbers[..3], moment.position);
            assert_eq!(numbers[3..6], moment.velocity);
            assert_eq!(numbers[6..9], moment.spin);
            assert_eq!(numbers[9..], [cast.bodies[k].radius, cast.bodies[k].mass_or_zero()]);
            assert_eq!(cells[12..], [(k + 1).to_string(), cast.bodies[k].kind.to_string()]);
        }
    }
}
