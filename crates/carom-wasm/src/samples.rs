//! Rows for plots: momentum and energy over time, and both sides of every impact so that a jump is a jump.
//!
//! A row is: time, kinetic, potential, lost, work, momentum (three), and for each of the first [`MOST_BODIES`] bodies its momentum
//! (three) and its kinetic energy.
use carom::{Rotates, State, Vector, World};
use carom_scene::build;

use crate::bench::Opened;
use crate::books::kinetic;
use crate::survey::Kept;

/// So many bodies have columns of their own.
pub const MOST_BODIES: usize = 8;
/// The impacts whose two sides are rows; beyond, the even samples say enough.
const MOST_IMPACTS: usize = 400;

/// Fills `into` with rows at even times and at impacts; the first number is the length of a row.
pub(crate) fn of<const D: usize>(opened: &Opened<D>, count: u32, into: &mut Vec<f64>)
where
    Vector<D>: Rotates,
{
    into.clear();
    let bodies = opened.plan.bodies.len().min(MOST_BODIES);
    into.push((8 + 4 * bodies) as f64);
    let Ok(mut world) = build::<D>(&opened.scene, &opened.plan) else { return };
    let end = opened.survey.end();
    let kept = opened.survey.all();
    let kept = if kept.len() <= MOST_IMPACTS { kept } else { &[] };
    let mut next = 0;
    for k in 0..=count {
        let time = if k == count { end } else { end * f64::from(k) / f64::from(count.max(1)) };
        while let Some(first) = kept.get(next).filter(|kept| kept.impact.time <= time) {
            let instant = first.impact.time;
            let lines = kept[next..].iter().take_while(|kept| kept.impact.time == instant).count();
            world.advance_to(instant);
            row(opened, &world, &kept[next..next + lines], into);
            row(opened, &world, &[], into);
            next += lines;
        }
        world.advance_to(time);
        row(opened, &world, &[], into);
    }
}

/// One row: the world as it is, or, with the lines of this instant, as it was just before.
fn row<const D: usize>(opened: &Opened<D>, world: &World<D>, undo: &[Kept<D>], into: &mut Vec<f64>)
where
    Vector<D>: Rotates,
{
    let ledger = world.ledger();
    let mut energy = [ledger.energy.kinetic, ledger.energy.potential, ledger.energy.lost, ledger.energy.work];
    let mut momentum = ledger.momentum.end;
    let mut before: Vec<(usize, State<D>)> = Vec::new();
    for kept in undo {
        for (k, body) in kept.bodies().into_iter().enumerate() {
            if let Some(body) = body.filter(|b| before.iter().all(|known| known.0 != *b)) {
                before.push((body, kept.impact.before[k]));
            }
        }
    }
    let ids: Vec<_> = world.bodies().collect();
    let lost: f64 = undo.iter().map(|kept| kept.impact.lost).sum();
    let mut gained = 0.0;
    for (k, state) in &before {
        let Some(mass) = opened.plan.bodies[*k].mass.filter(|_| !opened.plan.bodies[*k].fixed) else { continue };
        let Some(&id) = ids.get(*k) else { continue };
        let (v, w) = (world.velocity(id).unwrap_or(Vector::ZERO), world.spin(id).unwrap_or_default());
        momentum += (state.velocity - v) * mass;
        gained += kinetic(opened, *k, &v, &w) - kinetic(opened, *k, &state.velocity, &state.spin);
    }
    energy[0] -= gained;
    energy[2] -= lost;
    energy[3] -= gained + lost;
    // Where nothing drives, nothing works: the difference is rounding.
    if energy[3].abs() < 1e-12 * (energy[0].abs() + energy[2].abs()) {
        energy[3] = 0.0;
    }
    into.push(world.time());
    into.extend(energy);
    into.extend((0..3).map(|c| momentum.0.get(c).copied().unwrap_or(0.0)));
    for (k, &id) in ids.iter().enumerate().take(MOST_BODIES) {
        let state = before.iter().find(|b| b.0 == k).map(|b| b.1);
        let state = state.unwrap_or_else(|| State {
            velocity: world.velocity(id).unwrap_or(Vector::ZERO),
            spin: world.spin(id).unwrap_or_default(),
        });
        let body = &opened.plan.bodies[k];
        let mass = body.mass.filter(|_| !body.fixed).unwrap_or(0.0);
        into.extend((0..3).map(|c| mass * state.velocity.0.get(c).copied().unwrap_or(0.0)));
        into.push(kinetic(opened, k, &state.velocity, &state.spin));
    }
}
