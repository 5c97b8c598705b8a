//! `carom` alone: three commands worth trying.
use crate::trouble::{Trouble, print};

const WELCOME: &str = "\
carom: bodies meet, and they part with the right velocities.

Three commands worth trying:

  carom explain --mass 2 1 --velocity 3 -1 --restitution 0.5
      two balls on a line, from p = m v to the result, step by step

  carom explain --mass 1 1 --velocity 5,0 0,0 --normal 3,4
      an oblique hit in the plane: why billiard balls part at a right angle

  carom explain --mass 0.4 inf --velocity 20 0 --restitution 0.8 --duration 0.008
      a kicked ball against a wall, and how hard each pushes the other

`carom --help` lists all commands.
";

pub fn run() -> Result<(), Trouble> {
    print(WELCOME)
}
