//! What every letter stands for.
use super::rub;
use super::teller::AXES;
use super::{Explanation, Values};

/// What every letter of an impact stands for. Components that are nothing but rounding noise of larger ones are shown as zero.
pub(super) fn letters(x: &Explanation) -> Values {
    let mut values = Values::default();
    let largest = |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, |most: f64, v| most.max(v.abs()));
    let quiet = |v: &[f64], scale: f64| -> Vec<f64> {
        v.iter().map(|c| if c.abs() < 8.0 * f64::EPSILON * scale { 0.0 } else { *c }).collect()
    };
    let speed = largest(&mut x.before.velocity.iter().chain(&x.after.velocity).flatten().copied());
    let states = [("", &x.before), ("'", &x.after)];
    for (prime, state) in states {
        for (k, body) in ["1", "2"].into_iter().enumerate() {
            // What was given is shown as given. After the impact a component may be the remainder of two that cancel.
            let parts = x.before.velocity[k].iter().zip(&state.velocity[k]);
            let v: Vec<f64> = parts.map(|(v0, v)| quiet(&[*v], v0.abs().max((v - v0).abs()))[0]).collect();
            let along = quiet(&[x.normal_part(&state.velocity[k])], speed)[0];
            values.set(format!("v{body}{prime}"), v.as_slice());
            for (axis, component) in AXES.iter().zip(&v) {
                values.set(format!("v{axis}{body}{prime}"), *component);
            }
            values.set(format!("vp{body}{prime}"), along);
            let across: Vec<f64> = state.velocity[k].iter().zip(&x.normal).map(|(v, n)| v - along * n).collect();
            values.set(format!("vt{body}{prime}"), quiet(&across, speed).as_slice());
            if let ([vx, vy], [nx, ny]) = (state.velocity[k].as_slice(), x.normal.as_slice()) {
                values.set(format!("vn{body}{prime}"), quiet(&[vy * nx - vx * ny], speed)[0]);
            }
            if x.masses[k].is_finite() {
                let p: Vec<f64> = v.iter().map(|v| x.masses[k] * v).collect();
                values.set(format!("p{body}{prime}"), p.as_slice());
            }
        }
        if let Some(total) = &state.momentum {
            let scale = largest(&mut (0..2).flat_map(|k| state.velocity[k].iter().map(move |v| x.masses[k] * v)));
            let total = quiet(total, scale);
            values.set(format!("P{prime}"), total.as_slice());
            for (axis, component) in AXES.iter().zip(&total) {
                values.set(format!("P{axis}{prime}"), *component);
                values.set(format!("C{axis}"), *component);
            }
        }
        values.set(format!("K{prime}"), state.energy);
    }
    let given = quiet(&x.exchanged, largest(&mut x.exchanged.iter().copied()));
    let back: Vec<f64> = given.iter().map(|p| 0.0 - p).collect();
    values.set("Fh", given.as_slice());
    values.set("Fh1", back.as_slice());
    values.set("Fh2", given.as_slice());
    if let (Some(force), Some(duration)) = (&x.mean_force, x.duration) {
        for (name, force) in ["F1", "F2"].into_iter().zip(force) {
            values.set(name, quiet(force, largest(&mut force.iter().copied())).as_slice());
        }
        values.set("Δt", duration);
    }
    for (name, value) in [
        ("m1", x.masses[0]),
        ("m2", x.masses[1]),
        ("e", x.restitution),
        ("J", x.impulse),
        ("u", quiet(&[x.approach], speed)[0]),
        ("u'", quiet(&[x.departure], speed)[0]),
        ("μ", x.reduced_mass),
        ("Q", x.lost),
        ("W", x.work),
        ("R", x.spin_energy),
    ] {
        values.set(name, value);
    }
    rub::letters(x, &mut values);
    let n = quiet(&x.normal, 1.0);
    values.set("n", n.as_slice());
    values.set("d", x.along.as_slice());
    for (axis, component) in AXES.iter().zip(&n) {
        values.set(format!("n{axis}"), *component);
    }
    let r: Vec<f64> = x.before.velocity[0].iter().zip(&x.before.velocity[1]).map(|(a, b)| a - b).collect();
    values.set("r", quiet(&r, speed).as_slice());
    if let (Some(rotated), [nx, ny]) = (&x.rotated, n.as_slice()) {
        values.set("θ", rotated.theta);
        values.set("cosθ", *nx);
        values.set("sinθ", *ny);
    }
    values
}
