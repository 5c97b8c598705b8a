//! A world runs on for a while that is bounded: in time, in impacts, and in rounds of a periodic box.
use carom::{Limits, Rotates, Stop, Vector, World};

/// Impacts of one run at most.
const IMPACTS: u64 = 300;
/// In a periodic box time passes in so many pieces at most, in each of which the fastest body makes so many rounds at most: each
/// round costs an event or more, and the engine does whatever it is asked for.
const PIECES: u64 = 32;
const ROUNDS: f64 = 10.0;
/// More events than this in one run are a storm: crossings, slices or meetings that come to nothing, without an end.
const STORM: u64 = 1_000_000;

/// Runs for at most `dt` (s); `width` is the narrowest periodic axis, infinite where there is none.
pub fn go<const D: usize>(world: &mut World<D>, dt: f64, width: f64) -> Stop
where
    Vector<D>: Rotates,
{
    let end = world.time() + dt;
    let before = world.event_count().saturating_add(world.slice_count());
    let most = world.impact_count().saturating_add(IMPACTS);
    let mut stop = Stop::Time;
    let mut pieces = if width.is_infinite() { 1 } else { PIECES };
    while pieces > 0 {
        let time = Some(world.time() + patience(world, end - world.time(), dt, width));
        // Each impact, and each driven wall in it, may make somebody faster.
        let next = if width.is_infinite() { most } else { most.min(world.impact_count().saturating_add(1)) };
        stop = world.run(&Limits { time, impacts: Some(next), ..Limits::default() });
        if stop == Stop::Impacts && world.impact_count() < most {
            continue;
        }
        pieces -= 1;
        if stop != Stop::Time || !(world.time() < end) {
            break;
        }
    }
    let events = world.event_count().saturating_add(world.slice_count()).saturating_sub(before);
    assert!(events < STORM, "{events} events in {dt} s");
    stop
}

/// The next piece of what is left.
fn patience<const D: usize>(world: &World<D>, left: f64, dt: f64, width: f64) -> f64
where
    Vector<D>: Rotates,
{
    if width.is_infinite() {
        return left;
    }
    let fastest = world.bodies().filter_map(|id| world.velocity(id).ok()).map(|v| v.norm()).fold(0.0, f64::max);
    [dt / 8.0, ROUNDS * width / fastest].into_iter().fold(left, f64::min)
}
