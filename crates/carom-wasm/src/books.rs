//! The ledger as a table: momentum and energy of every body, of walls and Earth, and in all; before, change, after.
use carom::{Rotates, Vector};
use serde::Serialize;

use crate::bench::Opened;

/// Up to so many bodies have a row of their own in the ledger of an instant; beyond, only those that took part.
const MOST_ROWS: usize = 8;
/// A total closes if what is left is below this part of the sum of magnitudes.
const CLOSES: f64 = 1e-12;

/// A row of momentum (kg m/s).
#[derive(Serialize)]
pub(crate) struct Row {
    name: String,
    before: Vec<f64>,
    change: Vec<f64>,
    after: Vec<f64>,
}

/// Kinetic and potential energy (J).
#[derive(Serialize)]
pub(crate) struct Energy {
    before: f64,
    after: f64,
    kinetic: [f64; 2],
    potential: [f64; 2],
    lost: f64,
    work: f64,
    closes: bool,
}

/// The books of an instant, or of a run so far.
#[derive(Serialize)]
pub(crate) struct Books {
    time: f64,
    rows: Vec<Row>,
    /// Bodies that have no row of their own; `None` if all have.
    others: Option<Row>,
    /// Walls, fixed bodies and Earth: what they took.
    outside: Row,
    /// True if there is anything outside that could take or give.
    has_outside: bool,
    total: Row,
    closes: bool,
    energy: Energy,
}

/// Rounding noise as the nought it is, and no negative zeros.
fn clean(x: f64, scale: f64) -> f64 {
    if x.abs() <= 1e-15 * scale { 0.0 } else { x + 0.0 }
}

fn row(name: &str, before: Vec<f64>, after: Vec<f64>) -> Row {
    let change = before.iter().zip(&after).map(|(b, a)| clean(a - b, b.abs().max(a.abs()))).collect();
    Row { name: name.to_owned(), before, change, after }
}

fn sum<'a>(rows: impl Iterator<Item = &'a Vec<f64>>, dim: usize) -> Vec<f64> {
    rows.fold(vec![0.0; dim], |all, v| all.iter().zip(v).map(|(a, b)| a + b).collect())
}

/// True if before and after agree but for rounding, measured by the sum of magnitudes.
fn balanced(before: &[f64], after: &[f64], scale: f64) -> bool {
    before.iter().zip(after).all(|(b, a)| (a - b).abs() <= CLOSES * scale)
}

/// I w^2 / 2 + m v^2 / 2.
pub(crate) fn kinetic<const D: usize>(
    opened: &Opened<D>,
    k: usize,
    v: &Vector<D>,
    spin: &<Vector<D> as Rotates>::Spin,
) -> f64
where
    Vector<D>: Rotates,
{
    let body = &opened.plan.bodies[k];
    let Some(mass) = body.mass.filter(|_| !body.fixed) else { return 0.0 };
    let kappa = body.inertia.unwrap_or(if D == 2 { 0.5 } else { 0.4 });
    let turning = 0.5 * kappa * mass * body.radius * body.radius * Vector::<D>::spin_dot(*spin, *spin);
    carom::law::momentum::kinetic_energy(mass, *v) + turning
}

fn momentum<const D: usize>(mass: Option<f64>, v: Vector<D>) -> Vec<f64> {
    mass.map_or(vec![0.0; D], |m| carom::law::momentum::momentum(m, v).0.iter().map(|p| p + 0.0).collect())
}

/// A body's mass (kg), if it moves.
fn mass<const D: usize>(opened: &Opened<D>, k: usize) -> Option<f64>
where
    Vector<D>: Rotates,
{
    let body = &opened.plan.bodies[k];
    body.mass.filter(|_| !body.fixed)
}

fn has_outside<const D: usize>(opened: &Opened<D>) -> bool
where
    Vector<D>: Rotates,
{
    !opened.plan.sides.is_empty()
        || opened.scene.world.gravity.iter().any(|g| *g != 0.0)
        || opened.plan.bodies.iter().any(|b| b.fixed)
}

/// The books of the instant of the n-th impact.
pub(crate) fn instant<const D: usize>(opened: &Opened<D>, n: u64) -> Option<Books>
where
    Vector<D>: Rotates,
{
    let asked = opened.survey.kept(n)?;
    let time = asked.impact.time;
    // All lines of the instant stand together.
    let lines: Vec<_> = opened.survey.all().iter().filter(|k| k.impact.time == time).collect();
    let mut states: Vec<(usize, [carom::State<D>; 2])> = Vec::new();
    for kept in &lines {
        for (k, body) in kept.bodies().into_iter().enumerate() {
            if let Some(body) = body.filter(|b| mass(opened, *b).is_some()) {
                match states.iter_mut().find(|s| s.0 == body) {
                    // Before is before the first of its lines, after is after the last.
                    Some(state) => state.1[1] = kept.impact.after[k],
                    None => states.push((body, [kept.impact.before[k], kept.impact.after[k]])),
                }
            }
        }
    }
    states.sort_by_key(|s| s.0);
    let mut rows = Vec::new();
    let (mut kinetic_sum, mut scale) = ([0.0; 2], 0.0);
    for (k, [before, after]) in &states {
        let m = mass(opened, *k);
        let (b, a) = (momentum(m, before.velocity), momentum(m, after.velocity));
        scale += b.iter().chain(&a).map(|p| p.abs()).sum::<f64>();
        rows.push(row(&opened.plan.name(*k), b, a));
        kinetic_sum[0] += kinetic(opened, *k, &before.velocity, &before.spin);
        kinetic_sum[1] += kinetic(opened, *k, &after.velocity, &after.spin);
    }
    let (b, a) = (sum(rows.iter().map(|r| &r.before), D), sum(rows.iter().map(|r| &r.after), D));
    // What the lines say that walls and fixed bodies took.
    let mut taken = vec![0.0; D];
    for kept in &lines {
        for (k, sign) in [(0, -1.0), (1, 1.0)] {
            if kept.bodies()[k].is_none_or(|body| mass(opened, body).is_none()) {
                let given = kept.impact.normal * kept.impact.impulse + kept.impact.friction_impulse;
                for (t, g) in taken.iter_mut().zip(given.0) {
                    *t = clean(*t + sign * g, scale);
                }
            }
        }
    }
    let lost: f64 = lines.iter().map(|kept| kept.impact.lost).sum();
    let outside = row("", vec![0.0; D], taken);
    let after: Vec<f64> = a.iter().zip(&outside.after).map(|(a, t)| a + t).collect();
    let closes = balanced(&b, &after, scale);
    let work = work(&lines);
    let energy_closes = (kinetic_sum[1] + lost - work - kinetic_sum[0]).abs()
        <= CLOSES * (kinetic_sum[0] + kinetic_sum[1] + work.abs());
    let mut total = row("", b, after);
    for c in &mut total.change {
        *c = clean(*c, scale * 100.0);
    }
    let shown = if states.len() <= MOST_ROWS { states.len() } else { MOST_ROWS };
    let others = (rows.len() > shown).then(|| {
        let rest = rows.split_off(shown);
        row("", sum(rest.iter().map(|r| &r.before), D), sum(rest.iter().map(|r| &r.after), D))
    });
    Some(Books {
        time,
        rows,
        others,
        outside,
        has_outside: has_outside(opened),
        total,
        closes,
        energy: Energy {
            before: kinetic_sum[0],
            after: kinetic_sum[1],
            kinetic: kinetic_sum,
            potential: [0.0; 2],
            lost: clean(lost, kinetic_sum[0]),
            work: clean(work, kinetic_sum[0]),
            closes: energy_closes,
        },
    })
}

/// What driven walls and bodies put in at this instant: their velocity times the impulse that they gave.
fn work<const D: usize>(lines: &[&crate::survey::Kept<D>]) -> f64
where
    Vector<D>: Rotates,
{
    let one = |kept: &&crate::survey::Kept<D>| {
        let i = &kept.impact;
        let on_second = i.normal * i.impulse + i.friction_impulse;
        // Whoever keeps its velocity through the impact is a wall or a driven body.
        let kept_velocity = |k: usize| i.before[k].velocity == i.after[k].velocity;
        match (kept_velocity(0), kept_velocity(1)) {
            (true, false) => on_second.dot(i.before[0].velocity),
            (false, true) => -on_second.dot(i.before[1].velocity),
            _ => 0.0,
        }
    };
    lines.iter().map(one).sum()
}

/// The books from the start to where the page looks.
pub(crate) fn whole<const D: usize>(opened: &Opened<D>) -> Books
where
    Vector<D>: Rotates,
{
    let ledger = opened.world.ledger();
    let mut rows = Vec::new();
    let mut rest = [vec![0.0; D], vec![0.0; D]];
    for (k, id) in opened.world.bodies().enumerate() {
        let Some(m) = mass(opened, k) else { continue };
        let start = Vector::<D>::from_fn(|c| opened.plan.bodies[k].velocity[c]);
        let now = opened.world.velocity(id).unwrap_or(Vector::ZERO);
        let (b, a) = (momentum(Some(m), start), momentum(Some(m), now));
        if rows.len() < MOST_ROWS {
            rows.push(row(&opened.plan.name(k), b, a));
        } else {
            rest = [sum([&rest[0], &b].into_iter(), D), sum([&rest[1], &a].into_iter(), D)];
        }
    }
    let many = opened.plan.bodies.len() > MOST_ROWS;
    let [b, a] = rest;
    let momentum = ledger.momentum;
    let outside = row("", vec![0.0; D], momentum.given.0.iter().map(|g| 0.0 - g).collect());
    let after: Vec<f64> = momentum.end.0.iter().zip(&outside.after).map(|(e, t)| e + t).collect();
    let mut total = row("", momentum.start.0.to_vec(), after);
    let closes = momentum.drift <= CLOSES;
    if closes {
        total.change = vec![0.0; D];
    }
    let energy = ledger.energy;
    let totals = energy.start;
    Books {
        time: opened.world.time(),
        rows,
        others: many.then(|| row("", b, a)),
        outside,
        has_outside: has_outside(opened),
        total,
        closes,
        energy: Energy {
            before: totals,
            after: energy.end,
            kinetic: [f64::NAN, energy.kinetic],
            potential: [f64::NAN, energy.potential],
            lost: energy.lost,
            work: energy.work,
            closes: energy.drift <= CLOSES,
        },
    }
}
