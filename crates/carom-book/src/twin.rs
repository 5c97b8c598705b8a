//! The same scene run another way: equal digests, equal bits.
//!
//! `differs[how]` is 1 if the digest at the end of the scene is not that of the plain run, else 0. How: `again`, `frames N` (in N calls),
//! `pieces N` (N impacts a call), `snapshot` (written and restored half-way, in time or in impacts), `cells F` (the cells that find meetings F times as wide),
//! `lists M` (lists of neighbours with a margin of M mean radii; 0: none), `quietly` (without keeping impacts).
use carom::{Limits, Rotates, Vector, World};

use crate::formula::Misread;
use crate::scene::Stage;

/// Whether the run `how` ends in other bits than the plain one.
pub fn differs<const D: usize>(stage: &Stage, how: &str) -> Result<f64, Misread>
where
    Vector<D>: Rotates,
{
    let mut plain = stage.world::<D>()?;
    plain.run(&stage.scene.run.until.limits());
    let other = another::<D>(stage, how)?;
    let same = (plain.digest(), plain.impact_count()) == (other.digest(), other.impact_count());
    Ok(if same { 0.0 } else { 1.0 })
}

fn another<const D: usize>(stage: &Stage, how: &str) -> Result<World<D>, Misread>
where
    Vector<D>: Rotates,
{
    let limits = stage.scene.run.until.limits();
    let mut world = stage.world::<D>()?;
    let (how, number) = how.split_once(' ').unwrap_or((how, ""));
    let number = || number.trim().parse::<f64>().map_err(|_| Misread(format!("`differs[{how} ...]` wants a number")));
    let time = || limits.time.ok_or_else(|| Misread("this scene ends at no time".into()));
    match how {
        "again" => {}
        "quietly" => world.keep_reports(false),
        "cells" => world.set_cell_scale(number()?),
        "lists" => world.set_lists(Some(number()?)),
        "frames" => {
            let (frames, end) = (number()?, time()?);
            for k in 1..frames as u64 {
                world.run(&Limits { time: Some(end * (k as f64 / frames)), ..limits });
            }
        }
        "pieces" => {
            let (piece, most) = (number()? as u64, limits.impacts.unwrap_or(u64::MAX));
            loop {
                let before = world.impact_count();
                world.run(&Limits { impacts: Some(most.min(before + piece)), ..limits });
                if world.impact_count() < before + piece || world.impact_count() >= most {
                    break;
                }
            }
        }
        "snapshot" => {
            let half = Limits { time: limits.time.map(|t| 0.5 * t), impacts: limits.impacts.map(|n| n / 2), ..limits };
            world.run(&half);
            world = World::restore(&world.snapshot()).map_err(|e| Misread(e.to_string()))?;
        }
        _ => return Err(Misread(format!("nobody knows how to run a scene `{how}`"))),
    }
    world.run(&limits);
    Ok(world)
}
