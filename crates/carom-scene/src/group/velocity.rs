//! How a group moves.
use crate::geometry::{Point, dot, point};
use crate::model::{Distribution, Scene};
use crate::problem::Problem;
use crate::random::{Purpose, Random};

/// The velocities (m/s) of the `count` bodies of the `k`-th group, from 0; one for all if they are equal.
pub(crate) fn velocities(scene: &Scene, k: usize, count: usize, seed: u64) -> Result<Vec<Point>, Problem> {
    let (group, dim) = (&scene.groups[k], scene.world.dim);
    let path = |key: &str| format!("group[{}].velocity.{key}", k + 1);
    let mut random = Random::new(seed, k, Purpose::Velocities);
    match &group.velocity {
        None => Ok(vec![point(&group.body.velocity)]),
        Some(Distribution::Fixed(value)) => Ok(vec![point(value)]),
        Some(Distribution::Uniform(speed)) => {
            Ok((0..count).map(|_| direction(&mut random, dim).map(|x| x * speed)).collect())
        }
        &Some(Distribution::Maxwell { temperature, zero_momentum }) => {
            let Some(mass) = group.body.mass.of(dim, group.body.radius) else {
                return Err(Problem::new(
                    path("distribution"),
                    "\"maxwell\" needs a mass: a temperature is <m v^2> / dim",
                )
                .help("give body.mass or body.density, or another distribution"));
            };
            if zero_momentum && count == 1 && temperature > 0.0 {
                return Err(Problem::new(path("zero_momentum"), "one body with momentum 0 has temperature 0")
                    .help("zero_momentum = false, or more bodies"));
            }
            let velocities = maxwell(&mut random, count, dim, temperature / mass, zero_momentum);
            if velocities.iter().flatten().all(|x| x.is_finite()) {
                return Ok(velocities);
            }
            Err(Problem::new(path("temperature"), "velocities must be finite")
                .help("a lower temperature, or more mass"))
        }
    }
}

/// Normally spread velocities with <v^2> / dim = `variance`, exactly but for rounding.
fn maxwell(random: &mut Random, count: usize, dim: usize, variance: f64, zero_momentum: bool) -> Vec<Point> {
    let mut all: Vec<Point> = (0..count)
        .map(|_| {
            let mut v = [0.0; 3];
            v[..dim].fill_with(|| random.normal());
            v
        })
        .collect();
    if zero_momentum {
        // Twice: the first mean leaves a remainder of its rounding.
        for _ in 0..2 {
            for axis in 0..dim {
                let mean = all.iter().map(|v| v[axis]).sum::<f64>() / count as f64;
                all.iter_mut().for_each(|v| v[axis] -= mean);
            }
        }
    }
    let now = all.iter().map(|v| dot(*v, *v)).sum::<f64>() / (count * dim) as f64;
    let scale = if variance == 0.0 { 0.0 } else { (variance / now).sqrt() };
    all.iter_mut().flatten().for_each(|x| *x *= scale);
    all
}

/// A direction, all of them equally likely: a sign in 1D, else a normally spread vector made one long.
fn direction(random: &mut Random, dim: usize) -> Point {
    if dim == 1 {
        return [if random.unit() < 0.5 { -1.0 } else { 1.0 }, 0.0, 0.0];
    }
    loop {
        let mut v = [0.0; 3];
        v[..dim].fill_with(|| random.normal());
        let length = dot(v, v).sqrt();
        // Almost always at the first try; a shorter vector would have few digits.
        if length > 1e-3 {
            return v.map(|x| x / length);
        }
    }
}
