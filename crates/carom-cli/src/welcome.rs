//! `carom` alone: three commands worth trying.
use crate::trouble::{Trouble, print};

const WELCOME: &str = "\
carom: bodies meet, and they part with the right velocities.

Three commands worth trying:

  carom explain --mass 2 1 --velocity 3 -1 --restitution 0.5
      two balls on a line, from p = m v to the result, step by step

  carom run two-balls
      the same two balls run: they meet at t = 0.45 s, and the audit adds up

  carom run break -o break.gif
      a billiard break: fifteen balls that touch, all struck in one instant; and a film of it

`carom scenes` lists the scenes that come with it, `carom --help` all commands.
";

pub fn run() -> Result<(), Trouble> {
    print(WELCOME)
}
