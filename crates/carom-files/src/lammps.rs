//! LAMMPS text dump (`.lammpstrj`): what LAMMPS itself, OVITO, ASE, VMD and MDAnalysis read.
//!
//! The time step is the number of the frame; the time (s) stands in its own item, as `dump_modify time yes` writes it. Units
//! are SI. Where the world has an edge, the box is the edge: periodic (`pp`) or fixed (`ff`); elsewhere it is around the
//! bodies (`ss`).
use crate::cast::{Cast, Frame};
use std::io::{self, Write};

/// Adds a frame to the file.
pub fn write(to: &mut impl Write, cast: &Cast, frame: &Frame<'_>) -> io::Result<()> {
    if frame.number == 0 {
        writeln!(to, "ITEM: UNITS\nsi")?;
    }
    writeln!(to, "ITEM: TIME\n{:?}", frame.time)?;
    writeln!(to, "ITEM: TIMESTEP\n{}", frame.number)?;
    writeln!(to, "ITEM: NUMBER OF ATOMS\n{}", frame.bodies.len())?;
    let (low, high) = cast.cell(frame);
    let kind =
        |k: usize| match (cast.bounds.periodic[k], cast.bounds.min[k].is_finite(), cast.bounds.max[k].is_finite()) {
            _ if k >= cast.dim => "pp",
            (true, ..) => "pp",
            (_, true, true) => "ff",
            _ => "ss",
        };
    writeln!(to, "ITEM: BOX BOUNDS {} {} {}", kind(0), kind(1), kind(2))?;
    for k in 0..3 {
        writeln!(to, "{:?} {:?}", low[k], high[k])?;
    }
    writeln!(to, "ITEM: ATOMS id type x y z vx vy vz omegax omegay omegaz radius mass")?;
    for (k, (actor, at)) in cast.bodies.iter().zip(frame.bodies).enumerate() {
        let ([x, y, z], [u, v, w], [p, q, r]) = (at.position, at.velocity, at.spin);
        write!(to, "{} {} {x:?} {y:?} {z:?} {u:?} {v:?} {w:?} {p:?} {q:?} {r:?} ", k + 1, actor.kind)?;
        writeln!(to, "{:?} {:?}", actor.radius, actor.mass_or_zero())?;
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
        let frames: Vec<Vec<&str>> =
            text.split("ITEM: TIMESTEP\n").skip(1).map(|frame| frame.lines().collect()).collect();
        assert!(text.starts_with("ITEM: UNITS\nsi\nITEM: TIME\n0.0\n"));
        assert!(text.contains("ITEM: TIME\n0.1\nITEM: TIMESTEP\n1\n"));
        assert_eq!((frames.len(), frames[0][0], frames[1][0], frames[0][2]), (2, "0", "1", "2"));
        assert_eq!(frames[1][3..7], ["ITEM: BOX BOUNDS pp ff pp", "-1.0 3.0", "-1.0 2.0", "-0.5 0.5"]);
        let columns: Vec<&str> = frames[1][7].split(' ').skip(2).collect();
        for (k, moment) in moments.iter().enumerate() {
            let cells: Vec<f64> = frames[1][8 + k].split(' ').map(|c| c.parse().unwrap()).collect();
            assert_eq!(cells.len(), columns.len());
            let cell = |name: &str| cells[columns.iter().position(|c| *c == name).unwrap()];
            assert_eq!((cell("id"), cell("type")), ((k + 1) as f64, f64::from(cast.bodies[k].kind)));
            assert_eq!([cell("x"), cell("y"), cell("z")], moment.position);
            assert_eq!([cell("vx"), cell("vy"), cell("vz")], moment.velocity);
            assert_eq!([cell("omegax"), cell("omegay"), cell("omegaz")], moment.spin);
            assert_eq!((cell("radius"), cell("mass")), (cast.bodies[k].radius, cast.bodies[k].mass_or_zero()));
        }
    }
}
