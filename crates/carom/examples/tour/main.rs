//! Twelve small programs, one idea each: `cargo run -p carom --example tour -- NAME`; without a name it lists them, `all` runs them all.
//! Each checks what it claims, and each has a picture in the guide (`guide/examples.md`).
mod bounce;
mod break_shot;
mod cradle;
mod gas;
mod heap;
mod oblique;
mod pi;
mod piston;
mod roll;
mod snapshot;
mod superball;
mod two_balls;

/// A name, what it shows, and the program.
pub type Stop = (&'static str, &'static str, fn() -> Result<(), carom::Error>);

/// All of them, in the order of the guide.
pub const TOUR: &[Stop] = &[
    ("two-balls", "the lecture's two balls on a line", two_balls::run),
    ("oblique", "an oblique impact: along and across the line of centres", oblique::run),
    ("bounce", "a ball bounces to rest, at the closed-form times", bounce::run),
    ("cradle", "Newton's cradle by three operators", cradle::run),
    ("break", "a billiard break is its own mirror image", break_shot::run),
    ("pi", "two blocks and a wall count the digits of pi", pi::run),
    ("gas", "a gas of discs finds Maxwell's distribution", gas::run),
    ("piston", "a driven wall puts in energy, and the books say how much", piston::run),
    ("superball", "thrown under a table, a superball comes back", superball::run),
    ("roll", "a sphere slides, then rolls at 5/7 of its speed", roll::run),
    ("heap", "discs fall into a box and come to rest", heap::run),
    ("snapshot", "a world as bytes goes on to the same bits", snapshot::run),
];

#[allow(dead_code)] // The guide's tests run the tour without it.
fn main() -> Result<(), carom::Error> {
    let wanted = std::env::args().nth(1);
    for (name, about, run) in TOUR {
        match wanted.as_deref() {
            None => println!("{name:10} {about}"),
            Some(one) if one == *name || one == "all" => {
                println!("== {name}: {about}");
                run()?;
            }
            Some(_) => {}
        }
    }
    Ok(())
}
