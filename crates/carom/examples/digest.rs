//! Prints the digests of a handful of worlds: equal on every machine, in debug and release, and in wasm.
//! `tools/determinism` compares them; `tests/determinism.rs` runs the same worlds with other cells and frames.
//!
//! Nothing here may call a function that differs between machines: + - * / and square roots only.
use carom::{Ball, Boundary, Material, Rotates, Vector, Wall, World};

/// A small generator (xorshift64*).
pub struct Dice(u64);

impl Dice {
    /// A number in [0, 1).
    pub fn roll(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// How a world is run: nothing of it may change a bit of what happens.
#[derive(Clone, Copy, Debug)]
pub struct How {
    /// The width of the cells, times this.
    pub cells: f64,
    /// The number of calls of `advance_to`.
    pub frames: u32,
    /// Lists of neighbours: where they pay, or never (0), or always with this margin in radii.
    pub lists: Option<f64>,
}

/// What a run came to: the digest of the world, and a hash of every impact there was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Print {
    /// [`World::digest`] at the end.
    pub digest: u64,
    /// Times, impulses and restitution of all impacts, in order.
    pub impacts: u64,
    /// How many there were.
    pub count: u64,
}

fn run<const D: usize>(mut world: World<D>, end: f64, how: How) -> Print
where
    Vector<D>: Rotates,
{
    world.set_cell_scale(how.cells);
    world.set_lists(how.lists);
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    let mut add = |bits: u64| hash = (hash ^ bits).wrapping_mul(0x0000_0100_0000_01b3);
    for k in 1..=how.frames {
        let time = if k == how.frames { end } else { end * (f64::from(k) / f64::from(how.frames)) };
        for i in world.advance_to(time) {
            for x in [i.time, i.impulse, i.restitution, i.approach, i.departure] {
                add(x.to_bits());
            }
            i.point.0.iter().for_each(|x| add(x.to_bits()));
        }
    }
    Print { digest: world.digest(), impacts: hash, count: world.impact_count() }
}

/// 400 elastic discs in a box.
fn gas(how: How) -> Print {
    let mut dice = Dice(1);
    let mut world = World::<2>::new().boundary(Boundary::walls([0.0, 0.0], [20.0, 20.0]));
    for i in 0..400 {
        let v = [dice.roll() - 0.5, dice.roll() - 0.5];
        world.ball(Ball::new(1.0, 0.3).at([(i % 20) as f64 + 0.5, (i / 20) as f64 + 0.5]).moving(v));
    }
    run(world, 20.0, how)
}

/// 216 spheres of two kinds in a periodic cube, e < 1.
fn spheres(how: How) -> Print {
    let mut dice = Dice(2);
    let mut world = World::<3>::new().boundary(Boundary::periodic([0.0; 3], [6.0; 3]));
    for i in 0..216 {
        let x = [i % 6, i / 6 % 6, i / 36].map(|c| c as f64 + 0.5);
        let v = [dice.roll() - 0.5, dice.roll() - 0.5, dice.roll() - 0.5];
        let ball =
            if i % 3 == 0 { Ball::new(2.0, 0.4).restitution(0.9) } else { Ball::new(1.0, 0.3).restitution(0.98) };
        world.ball(ball.at(x).moving(v));
    }
    run(world, 20.0, how)
}

/// 216 rough spheres in a periodic cube, that turn each other.
fn rough(how: How) -> Print {
    let mut dice = Dice(5);
    let mut world = World::<3>::new().boundary(Boundary::periodic([0.0; 3], [6.0; 3]));
    let material = Material::new().restitution(0.99).friction(0.3).tangential(0.5);
    world.set_default_material(material).expect("a material");
    for i in 0..216 {
        let x = [i % 6, i / 6 % 6, i / 36].map(|c| c as f64 + 0.5);
        let v = [dice.roll() - 0.5, dice.roll() - 0.5, dice.roll() - 0.5];
        world.ball(Ball::new(1.0 + dice.roll(), 0.3 + 0.1 * dice.roll()).at(x).moving(v));
    }
    run(world, 20.0, how)
}

/// Galperin's blocks, mass ratio 10,000: 314 impacts.
fn pi(how: How) -> Print {
    let mut world = World::<1>::new();
    world.wall(Wall::plane([0.0], [1.0]));
    world.ball(Ball::new(1.0, 0.1).at([1.0]));
    world.ball(Ball::new(1e4, 0.1).at([2.0]).moving([-1.0]));
    run(world, 100.0, how)
}

/// Gravity, walls of every kind of the plane, fixed and driven things, every ball its own e.
fn gravity(how: How) -> Print {
    let mut dice = Dice(3);
    let mut world =
        World::<2>::new().gravity([0.0, -9.81]).boundary(Boundary::walls([0.0, 0.0], [10.0, 40.0]).closed_along(0));
    world.wall(Wall::plane([0.0, -1.0], [0.0, 1.0]).moving([0.0, 0.5]));
    for i in 0..5 {
        world.ball(Ball::fixed(0.2).at([2.0 * i as f64 + 0.7, 3.0 + 0.3 * i as f64]));
    }
    for i in 0..40 {
        let x = [(i % 8) as f64 * 1.25 + 0.6, (i / 8) as f64 * 1.3 + 5.0];
        let v = [2.0 * dice.roll() - 1.0, 2.0 * dice.roll() - 1.0];
        world.ball(Ball::new(0.5 + dice.roll(), 0.1 + 0.2 * dice.roll()).at(x).moving(v).restitution(dice.roll()));
    }
    run(world, 1.2, how)
}

/// Five balls in contact, two struck at once from both sides.
fn cradle(how: How) -> Print {
    let mut world = World::<1>::new();
    for k in 0..7 {
        let (x, v) = match k {
            0 => (-0.5, 1.0),
            6 => (1.7, -2.0),
            _ => (0.2 * k as f64, 0.0),
        };
        world.ball(Ball::new(1.0 + 0.1 * k as f64, 0.1).at([x]).moving([v]).restitution(0.95));
    }
    run(world, 3.0, how)
}

/// A ball that bounces to rest.
fn bounce(how: How) -> Print {
    let mut world = World::<2>::new().gravity([0.0, -9.81]);
    world.wall(Wall::segment([-5.0, 0.0], [5.0, 0.0]));
    world.ball(Ball::new(1.0, 0.1).at([0.3, 1.1]).restitution(0.9));
    run(world, 10.0, how)
}

/// 30 discs poured into a box: islands and slices, to rest.
fn heap(how: How) -> Print {
    let mut dice = Dice(4);
    let r = 0.05;
    let mut world = World::<2>::new().gravity([0.0, -9.81]).boundary(Boundary::walls([0.0, 0.0], [0.7, 5.0]));
    for k in 0..30 {
        let x = [(k % 5) as f64 * 0.13 + 0.07 + 0.01 * dice.roll(), (k / 5) as f64 * 0.13 + 0.07];
        world.ball(Ball::new(1.0, r).at(x).restitution(0.5));
    }
    run(world, 2.5, how)
}

/// A name and what it runs.
pub type Scene = (&'static str, fn(How) -> Print);

/// The worlds, by name.
pub const SCENES: [Scene; 8] = [
    ("gas", gas),
    ("spheres", spheres),
    ("rough", rough),
    ("pi", pi),
    ("gravity", gravity),
    ("cradle", cradle),
    ("bounce", bounce),
    ("heap", heap),
];

/// As they are run unless somebody wants to know.
pub const PLAIN: How = How { cells: 1.0, frames: 1, lists: None };

#[allow(dead_code)]
fn main() {
    for (name, scene) in SCENES {
        let print = scene(PLAIN);
        println!("{name} {:016x} {:016x} {}", print.digest, print.impacts, print.count);
    }
}
