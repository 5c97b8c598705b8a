//! `carom check`: is the scene valid, and what would run?
use crate::figures::{count, plural, short, vector};
use crate::source::{Ready, Source};
use crate::trouble::{Trouble, print};
use carom_scene::model::{Boundary, Until};
use carom_scene::{Detail, to_toml};
use clap::Args;
use std::fmt::Write;

const AFTER: &str = "\
Exit codes: 0 valid, 2 not valid (as for every command: with file, line, column and what would
be right).

Examples:
  carom check two-balls
  carom check gas --set run.seed=7 --expand > gas-7.toml";

/// Check a scene, and say what would run
#[derive(Args)]
#[command(after_help = AFTER)]
pub struct Check {
    #[command(flatten)]
    source: Source,
    /// Print the scene with every default filled in, as TOML; it runs to the same digest
    #[arg(long)]
    expand: bool,
}

impl Check {
    pub fn run(self) -> Result<(), Trouble> {
        let ready = self.source.ready()?;
        if self.expand {
            return print(&to_toml(&ready.scene, Detail::Full));
        }
        print(&summary(&ready))
    }
}

fn summary(ready: &Ready) -> String {
    let (scene, plan) = (&ready.scene, &ready.plan);
    let mut lines: Vec<(&str, String)> = Vec::new();
    if !scene.title.is_empty() {
        lines.push(("title", scene.title.clone()));
    }
    let place = ["on a line", "in the plane", "in space"][plan.dim - 1];
    let gravity = match scene.world.gravity.iter().all(|g| *g == 0.0) {
        true => "no gravity".to_string(),
        false => format!("gravity {} m/s2", vector(&scene.world.gravity)),
    };
    lines.push(("world", format!("{place} ({}D), {gravity}, {}", plan.dim, boundary(&scene.world.boundary))));
    lines.push(("bodies", bodies(ready)));
    for group in &scene.groups {
        let members = (0..plan.bodies.len()).skip(scene.bodies.len());
        let members = members.filter(|&k| plan.name(k).rsplit_once('-').is_some_and(|(g, _)| g == group.name)).count();
        lines.push(("", format!("{} {}: {}", count(members as u64), group.name, group.kind.name())));
    }
    if !scene.walls.is_empty() {
        let names: Vec<&str> = scene.walls.iter().take(6).map(|w| w.name.as_str()).collect();
        let more = if scene.walls.len() > 6 { ", ..." } else { "" };
        lines.push(("walls", format!("{}: {}{more}", count(scene.walls.len() as u64), names.join(", "))));
    }
    if let Some(fraction) = fraction(ready) {
        lines.push(("filled", format!("{} of the box", short(fraction))));
    }
    lines.push(("ends", ends(&scene.run.until)));
    lines.push((
        "rules",
        format!("several contacts at once: {}; one contact: {}", scene.run.together.name(), scene.run.law.name()),
    ));
    let rest = match scene.run.rest_speed {
        0.0 => "off".to_string(),
        speed => format!("below {} m/s, where gravity presses", short(speed)),
    };
    lines.push(("rest", rest));
    lines.push(("seed", scene.run.seed.to_string()));
    for output in &scene.outputs {
        lines.push(("writes", output.path.clone()));
    }
    let mut text = format!("{} is valid.\n\n", ready.name);
    for (key, value) in lines {
        let _ = writeln!(text, "  {key:<7} {value}");
    }
    for note in ready.document.notes() {
        let _ = write!(text, "\n{note}\n");
    }
    text
}

fn boundary(boundary: &Boundary) -> String {
    match boundary {
        Boundary::Open => "open".into(),
        Boundary::Box { min, max, periodic, .. } => {
            let round: Vec<&str> = periodic.iter().map(|&k| ["x", "y", "z"][k]).collect();
            let round =
                if round.is_empty() { String::new() } else { format!(", periodic along {}", round.join(" and ")) };
            format!("a box from {} to {}{round}", vector(min), vector(max))
        }
        Boundary::Periodic { min, max } => format!("periodic from {} to {}", vector(min), vector(max)),
    }
}

fn bodies(ready: &Ready) -> String {
    let all = &ready.plan.bodies;
    let mut text = plural(all.len() as u64, "body");
    let (moving, fixed): (Vec<&carom_scene::Placed>, Vec<&carom_scene::Placed>) = all.iter().partition(|b| !b.fixed);
    if !fixed.is_empty() {
        let driven = fixed.iter().filter(|b| b.velocity.iter().any(|v| *v != 0.0)).count();
        let _ = write!(text, ", {} fixed", count(fixed.len() as u64));
        if driven > 0 {
            let _ = write!(text, " ({} driven)", count(driven as u64));
        }
    }
    let masses: Vec<f64> = moving.iter().filter_map(|b| b.mass).collect();
    let range = |values: &mut dyn Iterator<Item = f64>| {
        values.fold((f64::INFINITY, 0.0f64), |(low, high), x| (low.min(x), high.max(x)))
    };
    let span = |(low, high): (f64, f64), unit: &str| match low == high {
        true => format!("{} {unit}", short(low)),
        false => format!("{} to {} {unit}", short(low), short(high)),
    };
    if !masses.is_empty() {
        let _ = write!(text, ", {} each", span(range(&mut masses.iter().copied()), "kg"));
    }
    if !all.is_empty() {
        let _ = write!(text, ", radius {}", span(range(&mut all.iter().map(|b| b.radius)), "m"));
    }
    text
}

/// The part of a box that the bodies fill.
fn fraction(ready: &Ready) -> Option<f64> {
    use std::f64::consts::PI;
    let (min, max) = ready.scene.world.extent()?;
    let box_size: f64 = min.iter().zip(max).map(|(low, high)| high - low).product();
    let size = |r: f64| match ready.plan.dim {
        1 => 2.0 * r,
        2 => PI * r * r,
        _ => 4.0 / 3.0 * PI * r * r * r,
    };
    let filled: f64 = ready.plan.bodies.iter().map(|b| size(b.radius)).sum();
    Some(filled / box_size)
}

fn ends(until: &Until) -> String {
    let mut all = Vec::new();
    if let Some(time) = until.time {
        all.push(format!("at t = {} s", short(time)));
    }
    if let Some(n) = until.impacts {
        all.push(format!("after {}", plural(n, "impact")));
    }
    if until.rest {
        all.push("when every body rests".into());
    }
    if all.is_empty() { "when nothing can meet again".into() } else { all.join(", or ") }
}
