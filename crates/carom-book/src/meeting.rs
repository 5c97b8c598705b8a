//! Cases of a ball that moves towards something: when do they meet?
//!
//! Words: `meets` (1 or 0), `time` (s).
use carom::Vector;
use carom::meet::{self, Path};

use crate::case::{Meeting, Names};
use crate::formula::{Misread, Words};

/// When they meet (s); infinite for never.
pub struct Time(f64);

/// Asks.
pub fn ask(meeting: &Meeting, names: &Names<'_>) -> Result<Time, Misread> {
    match meeting.position.len() {
        1 => of::<1>(meeting, names),
        2 => of::<2>(meeting, names),
        3 => of::<3>(meeting, names),
        n => Err(Misread(format!("a position has 1 to 3 components, not {n}"))),
    }
}

fn of<const D: usize>(meeting: &Meeting, names: &Names<'_>) -> Result<Time, Misread> {
    let vector = |numbers: &[crate::case::Number]| -> Result<Vector<D>, Misread> {
        let numbers = names.list(numbers)?;
        let array: [f64; D] =
            numbers.as_slice().try_into().map_err(|_| Misread(format!("{numbers:?} has not {D} components")))?;
        Ok(Vector(array))
    };
    let (position, velocity) = (vector(&meeting.position)?, vector(&meeting.velocity)?);
    let still = meeting.acceleration.is_empty();
    let acceleration = if still { Vector::ZERO } else { vector(&meeting.acceleration)? };
    let reach = names.value(&meeting.reach)?;
    let path = Path { position, velocity, acceleration };
    let points = meeting.obstacle.iter().map(|p| vector(p)).collect::<Result<Vec<_>, _>>()?;
    Ok(Time(match points.as_slice() {
        [] if meeting.plane => meet::plane(position[D - 1], velocity[D - 1], acceleration[D - 1], reach),
        [] if still => meet::ball_ball(position, velocity, reach),
        [] => meet::ball_ball_accelerated(&path, reach),
        [from, to] => meet::segment(&path, *from, *to, reach),
        [a, b, c] => meet::triangle(&path, [*a, *b, *c], reach),
        more => return Err(Misread(format!("an obstacle of {} points is not known", more.len()))),
    }))
}

impl Words for Time {
    fn name(&self, name: &str) -> Result<f64, Misread> {
        match name {
            "meets" => Ok(f64::from(u8::from(self.0.is_finite()))),
            "time" if self.0.is_finite() => Ok(self.0),
            "time" => Err(Misread("they never meet".into())),
            _ => Err(Misread(format!("a meeting has no `{name}`"))),
        }
    }

    fn of(&self, word: &str, what: &str) -> Result<f64, Misread> {
        Err(Misread(format!("a meeting has no `{word}[{what}]`")))
    }
}
