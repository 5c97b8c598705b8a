//! Rounds of a soak: small worlds with everything in them and changes all the time, whose books are read after every frame.
//!
//! A round is its seed. It makes a world, lets it run while bodies come, go and are pushed and the floor is driven, and looks after
//! each frame: are the accounts closed, is anything not finite, does anything overlap, does a restored copy go on to the same bits?
use carom::ledger::{DRIFT_LIMIT, OVERLAP_LIMIT};
use carom::{Ball, BodyId, Boundary, Limits, Material, Rotates, Stop, Together, Vector, WallId, World};

use crate::dice::Dice;

/// Frames of a round, and impacts that a frame may have before the round is given up and counted.
const FRAMES: u32 = 120;
const MOST_IMPACTS: u64 = 200_000;
/// Bodies of a round at most.
const MOST_BODIES: u32 = 60;

/// What a soak has seen.
#[derive(Default)]
pub struct Tally {
    /// Worlds that were made.
    pub rounds: u64,
    /// Frames that they ran.
    pub frames: u64,
    /// Impacts of all of them.
    pub impacts: u64,
    /// Slices of lasting contact.
    pub slices: u64,
    /// Changes from outside.
    pub changes: u64,
    /// Copies that were restored and went on beside the original.
    pub restored: u64,
    /// Rounds that had too many impacts in a frame.
    pub given_up: u64,
    /// Instants that were ended by a cap.
    pub capped: u64,
    /// What was wrong.
    pub wrong: Vec<String>,
    /// The largest part of an account that was not explained.
    pub drift: f64,
    /// The deepest overlap, in radii.
    pub overlap: f64,
}

impl Tally {
    fn wrong(&mut self, what: &str) {
        self.wrong.push(what.to_string());
    }
}

/// A box with a floor that can be driven, gravity or none, friction or none, one operator or another.
fn world<const D: usize>(dice: &mut Dice) -> (World<D>, WallId)
where
    Vector<D>: Rotates,
{
    let mut gravity = Vector::<D>::ZERO;
    if dice.below(3) > 0 {
        gravity[D - 1] = -dice.pick(&[9.81, 1.0]);
    }
    let together = Together::ALL[dice.below(3) as usize];
    let mut world = World::<D>::new().gravity(gravity).together(together).rest_speed(dice.pick(&[0.01, 0.01, 0.0]));
    let mut said = Material::new().restitution(dice.pick(&[1.0, 0.9, 0.5, 0.0]));
    if dice.below(2) == 0 {
        said = said.friction(dice.pick(&[0.1, 0.5, 1.0])).tangential(dice.pick(&[0.0, 0.0, 0.5])).rolling(0.01);
    }
    world.set_default_material(said).expect("in range");
    world.set_boundary(Boundary::walls([0.0; D], [1.0; D])).expect("there is room");
    let floor = world.side(D - 1, false).expect("a box has a floor");
    (world, floor)
}

/// A ball where there is room for one, or none.
fn throw<const D: usize>(world: &mut World<D>, dice: &mut Dice) -> Option<BodyId>
where
    Vector<D>: Rotates,
{
    let radius = 0.02 + 0.04 * dice.unit();
    let at = Vector::<D>::from_fn(|_| 0.05 + radius + (0.9 - 2.0 * radius) * dice.unit());
    if !world.overlapping(at, radius).is_empty() {
        return None;
    }
    let velocity = Vector::<D>::from_fn(|_| 4.0 * (dice.unit() - 0.5));
    let mass = dice.pick(&[1.0, 1.0, 0.1, 10.0]);
    world.add(Ball::new(mass, radius).at(at).moving(velocity)).ok()
}

/// The floor shakes: it is driven up or down for two frames, and never goes further than a fiftieth.
fn shake<const D: usize>(world: &mut World<D>, floor: WallId, dice: &mut Dice)
where
    Vector<D>: Rotates,
{
    let height = world.shape(floor).expect("it is there").over(Vector::ZERO, 0.0).point[D - 1];
    let speed = if height.abs() > 0.02 { -0.2 * height.signum() } else { dice.pick(&[0.0, 0.0, 0.2, -0.2]) };
    world.set_wall_velocity(floor, Vector::<D>::axis(D - 1) * speed).expect("it is there");
}

/// One change by the user.
fn change<const D: usize>(world: &mut World<D>, bodies: &mut Vec<BodyId>, dice: &mut Dice)
where
    Vector<D>: Rotates,
{
    let which =
        |dice: &mut Dice, bodies: &[BodyId]| bodies.get(dice.below(bodies.len().max(1) as u32) as usize).copied();
    match dice.below(7) {
        0..=2 if (bodies.len() as u32) < MOST_BODIES => bodies.extend(throw(world, dice)),
        3 | 4 if bodies.len() > 2 => {
            let k = dice.below(bodies.len() as u32) as usize;
            world.remove(bodies.swap_remove(k)).expect("it is there");
        }
        5 => {
            if let Some(id) = which(dice, bodies) {
                let velocity = Vector::<D>::from_fn(|_| 6.0 * (dice.unit() - 0.5));
                world.set_velocity(id, velocity).expect("it is there");
            }
        }
        _ => {
            if let (Some(a), Some(b)) = (which(dice, bodies), which(dice, bodies))
                && a != b
            {
                world.ignore(a, b, true).expect("both are there");
            }
        }
    }
}

/// What holds after every frame.
fn look<const D: usize>(world: &World<D>, seed: u64, frame: u32, tally: &mut Tally) -> bool
where
    Vector<D>: Rotates,
{
    let ledger = world.ledger();
    let drift = ledger.unexplained();
    tally.drift = tally.drift.max(drift);
    tally.overlap = tally.overlap.max(ledger.overlap);
    if !(drift < DRIFT_LIMIT) {
        tally.wrong(&format!("D = {D}, seed {seed}, frame {frame}: {drift:e} of an account is not explained"));
        return false;
    }
    if !(ledger.overlap < OVERLAP_LIMIT) {
        tally.wrong(&format!("D = {D}, seed {seed}, frame {frame}: an overlap of {:e} of a radius", ledger.overlap));
        return false;
    }
    true
}

/// The round of this seed: one, two and three dimensions in turn.
pub fn round(seed: u64, tally: &mut Tally) {
    match seed % 3 {
        0 => round_in::<1>(seed, tally),
        1 => round_in::<2>(seed, tally),
        _ => round_in::<3>(seed, tally),
    }
}

fn round_in<const D: usize>(seed: u64, tally: &mut Tally)
where
    Vector<D>: Rotates,
{
    let dice = &mut Dice::warmed(seed);
    let (mut world, floor) = world::<D>(dice);
    world.keep_reports(false);
    let mut bodies: Vec<BodyId> = (0..5 + dice.below(30)).filter_map(|_| throw(&mut world, dice)).collect();
    let driven = dice.below(3) == 0;
    tally.rounds += 1;
    for frame in 1..=FRAMES {
        let end = f64::from(frame) / 60.0;
        let copy = (frame % 40 == 0).then(|| World::<D>::restore(&world.snapshot()).expect("its own snapshot"));
        let limits =
            Limits { time: Some(end), impacts: Some(world.impact_count() + MOST_IMPACTS), ..Limits::default() };
        let stop = world.run(&limits);
        tally.frames += 1;
        if let Some(mut copy) = copy {
            copy.run(&limits);
            tally.restored += 1;
            if copy.digest() != world.digest() {
                tally.wrong(&format!("D = {D}, seed {seed}, frame {frame}: a restored world went elsewhere"));
                break;
            }
        }
        match stop {
            Stop::Time | Stop::Quiet | Stop::Rest => {}
            Stop::Crushed => break, // the floor came up under a pile that had no room: that is what it says
            Stop::Impacts => {
                tally.given_up += 1;
                break;
            }
            other => {
                tally.wrong(&format!("D = {D}, seed {seed}, frame {frame}: {other:?}"));
                break;
            }
        }
        if !look(&world, seed, frame, tally) {
            break;
        }
        if frame % 2 == 0 {
            change(&mut world, &mut bodies, dice);
            if driven {
                shake(&mut world, floor, dice);
            }
            tally.changes += 1;
        }
    }
    tally.impacts += world.impact_count();
    tally.slices += world.slice_count();
    tally.capped += world.ledger().capped;
}

/// The world that lives through the soak: a gas whose bodies are replaced one after the other.
pub struct Old {
    /// It, for reading.
    pub world: World<2>,
    bodies: Vec<BodyId>,
    dice: Dice,
}

impl Default for Old {
    fn default() -> Self {
        let mut world = World::<2>::new().boundary(Boundary::walls([0.0; 2], [1.0; 2]));
        let mut dice = Dice::warmed(1);
        let mut bodies = Vec::new();
        while bodies.len() < 60 {
            bodies.extend(throw(&mut world, &mut dice));
        }
        Self { world, bodies, dice }
    }
}

impl Old {
    /// A second of its life.
    pub fn live(&mut self, tally: &mut Tally) {
        for _ in 0..60 {
            let before = self.world.impact_count();
            self.world.advance(1.0 / 60.0);
            tally.impacts += self.world.impact_count() - before;
            let k = self.dice.below(self.bodies.len() as u32) as usize;
            if let Some(new) = throw(&mut self.world, &mut self.dice) {
                self.world.remove(self.bodies[k]).expect("it is there");
                self.bodies[k] = new;
                tally.changes += 1;
            }
        }
        look(&self.world, 0, 0, tally);
    }
}
