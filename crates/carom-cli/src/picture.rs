//! A small picture of a run in characters: on a line a strip of space and time, in the plane and in space a view with trails.
//!
//! Where bodies are few the scene is run once more and stopped at equal steps, so that the picture can end soon after the
//! last impact instead of at the end of a long run.
use crate::canvas::{ACROSS, Canvas, DOWN};
use crate::drive::{Grid, News, PIECE, drive};
use crate::figures::digits;
use crate::run::start;
use crate::source::Ready;
use crate::trouble::Trouble;
use carom::{Rotates, Vector, World};
use carom_scene::model::Until;
use carom_scene::output::Report;
use carom_scene::{Outline, Plan};

/// The picture's size in characters.
const COLUMNS: usize = 70;
const ROWS_LINE: usize = 12;
const ROWS_PLANE: usize = 20;
/// Stops of the clock in the plane.
const SAMPLES: usize = 400;
/// More bodies leave no trails.
const MOST_TRAILS: usize = 100;
/// More bodies are no picture; in space, where they hide each other, fewer.
const MOST_BODIES: [usize; 4] = [0, 100, 2500, 250];
/// Longer runs are not run once more.
const MOST_EVENTS: u64 = 200_000;

/// Where all bodies are, at equal steps.
struct Film {
    /// How long it is (s).
    length: f64,
    frames: Vec<Vec<[f64; 3]>>,
}

/// The picture of a run that has ended, given when its last impact was; empty where there is nothing to see.
pub fn of<const D: usize>(ready: &Ready, report: &Report, last: Option<f64>) -> Result<String, Trouble>
where
    Vector<D>: Rotates,
{
    let bodies = report.bodies.len();
    if bodies == 0 || bodies > MOST_BODIES[D] {
        return Ok(String::new());
    }
    let moving = ready.plan.bodies.iter().filter(|b| !b.fixed).count();
    let trails = moving <= MOST_TRAILS && report.events <= MOST_EVENTS;
    if D == 1 && !trails {
        return Ok(String::new());
    }
    // Some time after the last impact, to see how they part.
    let cut = matches!(report.stopped, "crushed" | "interrupted");
    let end = if cut { report.time } else { ready.scene.run.until.time.unwrap_or(f64::INFINITY) };
    let shown = match last {
        Some(last) if last > 0.0 => 1.6 * last,
        _ if report.time > 0.0 => report.time,
        _ => 1.0,
    };
    let length = shown.min(end);
    let film =
        if trails { film::<D>(ready, length, if D == 1 { ROWS_LINE * DOWN } else { SAMPLES })? } else { still(report) };
    Ok(match fall(ready, &film) {
        _ if D == 1 => strip(ready, &film),
        Some(axis) if trails => heights(ready, &film, axis),
        _ => view(ready, &film, trails),
    })
}

/// Runs the scene once more.
fn film<const D: usize>(ready: &Ready, length: f64, stops: usize) -> Result<Film, Trouble>
where
    Vector<D>: Rotates,
{
    let places = |world: &World<D>| -> Vec<[f64; 3]> {
        let place =
            |id| world.position(id).map_or([f64::NAN; 3], |x| std::array::from_fn(|k| if k < D { x[k] } else { 0.0 }));
        world.bodies().map(place).collect()
    };
    let mut world = start::<D>(ready)?;
    let mut frames = vec![places(&world)];
    let until = Until { time: Some(length), ..Until::default() };
    let mut grids = [Grid::new(length / stops as f64, true)];
    drive(&mut world, &until, PIECE, &mut grids, |world, news| {
        if matches!(news, News::Mark(_)) {
            frames.push(places(world));
        }
        Ok(())
    })?;
    Ok(Film { length, frames })
}

/// The end of a run alone.
fn still(report: &Report) -> Film {
    let place = |x: &Vec<f64>| std::array::from_fn(|k| x.get(k).copied().unwrap_or(0.0));
    Film { length: report.time, frames: vec![report.bodies.iter().map(|b| place(&b.position)).collect()] }
}

/// The least and the largest coordinate along an axis, bodies and their radii included.
fn range(film: &Film, plan: &Plan, axis: usize) -> [f64; 2] {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for frame in &film.frames {
        for (x, body) in frame.iter().zip(&plan.bodies) {
            include(&mut range, x[axis] - body.radius);
            include(&mut range, x[axis] + body.radius);
        }
    }
    range
}

fn include(range: &mut [f64; 2], x: f64) {
    if x.is_finite() {
        *range = [range[0].min(x), range[1].max(x)];
    }
}

/// Space to the right, time downwards.
fn strip(ready: &Ready, film: &Film) -> String {
    let plan = &ready.plan;
    let mut space = range(film, plan, 0);
    let walls: Vec<(f64, f64, f64)> = plan
        .sides
        .iter()
        .filter_map(|side| match side.outline {
            Outline::Plane(point, normal) => Some((point[0], side.velocity[0], normal[0].signum())),
            _ => None,
        })
        .collect();
    for (x, v, _) in &walls {
        include(&mut space, *x);
        include(&mut space, x + v * film.length);
    }
    if !(space[0] < space[1]) {
        return String::new();
    }
    let mut canvas = Canvas::new(COLUMNS, ROWS_LINE);
    let [width, height] = canvas.size().map(|n| n as f64);
    let column = |x: f64| (x - space[0]) / (space[1] - space[0]) * (width - 1.0) + 0.5;
    for (k, frame) in film.frames.iter().take(height as usize).enumerate() {
        let y = k as f64 + 0.5;
        for (x, body) in frame.iter().zip(&plan.bodies) {
            // Bodies that touch have a seam between them.
            let (from, to) = (column(x[0] - body.radius), column(x[0] + body.radius));
            canvas.line([from, y], [if to - from > 4.0 { to - 2.0 } else { to }, y]);
        }
        let time = film.length * k as f64 / height;
        for (x, v, _) in &walls {
            canvas.dot(column(x + v * time), y);
        }
    }
    let named = plan.bodies.len() <= 12;
    let lines = canvas.lines();
    let mut text = String::from("\n");
    let names = |frame: Option<&Vec<[f64; 3]>>| {
        let mut line = Canvas::new(COLUMNS, 1);
        for (k, x) in frame.into_iter().flatten().enumerate() {
            line.write(column(x[0]), 0.0, &plan.name(k));
        }
        format!("{:10}{}\n", "", line.lines().concat())
    };
    if named {
        text += &names(film.frames.first());
    }
    for (row, line) in lines.iter().enumerate() {
        let time = film.length * row as f64 / ROWS_LINE as f64;
        let label = if row % 3 == 0 { format!("{:>6} s", digits(time, 3)) } else { String::new() };
        text += &format!("{label:>8}  {line}\n");
    }
    if named {
        text += &names(film.frames.last());
    }
    text += &format!("{:10}x from {} to {} m, time downwards\n", "", digits(space[0], 3), digits(space[1], 3));
    text
}

/// The axis along which all that moves moves, if gravity pulls that way and nothing moves across it.
fn fall(ready: &Ready, film: &Film) -> Option<usize> {
    let axis = ready.scene.world.gravity.iter().position(|g| *g != 0.0)?;
    let first = film.frames.first()?;
    let strays = |frame: &Vec<[f64; 3]>| {
        let pairs = frame.iter().zip(first).zip(&ready.plan.bodies);
        pairs
            .into_iter()
            .any(|((x, start), body)| (0..3).any(|k| k != axis && !((x[k] - start[k]).abs() <= 1e-3 * body.radius)))
    };
    (!film.frames.iter().any(strays)).then_some(axis)
}

/// Time to the right, height upwards.
fn heights(ready: &Ready, film: &Film, axis: usize) -> String {
    let plan = &ready.plan;
    let mut height = range(film, plan, axis);
    let floors: Vec<f64> = plan
        .sides
        .iter()
        .filter_map(|side| match side.outline {
            Outline::Plane(point, normal) if normal[axis] != 0.0 && side.velocity == [0.0; 3] => Some(point[axis]),
            _ => None,
        })
        .collect();
    floors.iter().for_each(|x| include(&mut height, *x));
    if !(height[0] < height[1]) {
        return String::new();
    }
    let mut canvas = Canvas::new(COLUMNS, ROWS_LINE);
    let [right, bottom] = canvas.size().map(|n| n as f64 - 1.0);
    let row = |x: f64| bottom - (x - height[0]) / (height[1] - height[0]) * bottom + 0.5;
    for floor in &floors {
        canvas.line([0.0, row(*floor)], [right, row(*floor)]);
    }
    let column = |frame: usize| frame as f64 / (film.frames.len() - 1).max(1) as f64 * right;
    for (frame, pair) in film.frames.windows(2).enumerate() {
        for (a, b) in pair[0].iter().zip(&pair[1]) {
            canvas.line([column(frame), row(a[axis])], [column(frame + 1), row(b[axis])]);
        }
    }
    let letter = ["x", "y", "z"][axis];
    let mut text = String::from("\n");
    for line in canvas.lines().iter().skip_while(|line| line.is_empty()) {
        text += &format!("    {line}\n");
    }
    let seen = [height[0], height[1]].map(|x| digits(tidy(x, height[1] - height[0]), 3));
    let names: Vec<String> = (0..plan.bodies.len().min(4)).map(|k| plan.name(k)).collect();
    let more = if plan.bodies.len() > 4 { ", ..." } else { "" };
    text +=
        &format!("    {letter} from {} to {} m, time to the right, to {} s", seen[0], seen[1], digits(film.length, 3));
    text + &format!("  ({}{more})\n", names.join(", "))
}

/// A coordinate without its rounding.
fn tidy(x: f64, size: f64) -> f64 {
    if x.abs() < 1e-9 * size { 0.0 } else { x }
}

/// A view along the third axis; with gravity, from the side.
fn view(ready: &Ready, film: &Film, trails: bool) -> String {
    let plan = &ready.plan;
    let gravity = &ready.scene.world.gravity;
    let down =
        (0..plan.dim).filter(|&k| gravity[k] != 0.0).max_by(|&a, &b| gravity[a].abs().total_cmp(&gravity[b].abs()));
    let axes = match (plan.dim, down) {
        (3, Some(2)) => [0, 2],
        (3, Some(0)) => [1, 0],
        _ => [0, 1],
    };
    let mut ranges = axes.map(|axis| range(film, plan, axis));
    if let Some(frame) = frame(plan, axes) {
        // What has left the stage is not worth a picture of nothing else.
        let size = frame.map(|r| r[1] - r[0]).into_iter().fold(0.0, f64::max);
        let first = Film { length: 0.0, frames: film.frames.iter().take(1).cloned().collect() };
        for (k, range_now) in ranges.iter_mut().enumerate() {
            let mut stage = range(&first, plan, axes[k]);
            include(&mut stage, frame[k][0]);
            include(&mut stage, frame[k][1]);
            *range_now = [range_now[0].max(stage[0] - 0.25 * size), range_now[1].min(stage[1] + 0.25 * size)];
        }
    }
    if let Some((min, max)) = ready.scene.world.extent() {
        for (range, axis) in ranges.iter_mut().zip(axes) {
            include(range, min[axis]);
            include(range, max[axis]);
        }
    }
    for side in &plan.sides {
        for point in corners(&side.outline) {
            ranges.iter_mut().zip(axes).for_each(|(range, axis)| include(range, point[axis]));
        }
    }
    let [width, height] = ranges.map(|r| r[1] - r[0]);
    if !(width.is_finite() && height.is_finite() && width + height > 0.0) {
        return String::new();
    }
    // One scale for both: a circle stays a circle.
    let across = (COLUMNS * ACROSS - 2) as f64;
    let down = (ROWS_PLANE * DOWN - 2) as f64;
    let scale = (across / width).min(down / height);
    let columns = ((width * scale + 2.0) / ACROSS as f64).ceil().clamp(1.0, COLUMNS as f64) as usize;
    let rows = ((height * scale + 2.0) / DOWN as f64).ceil().clamp(1.0, ROWS_PLANE as f64) as usize;
    let mut canvas = Canvas::new(columns, rows);
    let bottom = (rows * DOWN) as f64 - 1.0;
    let on = |x: [f64; 3]| [1.0 + (x[axes[0]] - ranges[0][0]) * scale, bottom - (x[axes[1]] - ranges[1][0]) * scale];
    for side in &plan.sides {
        let moved = |x: [f64; 3]| on(std::array::from_fn(|k| x[k] + side.velocity[k] * film.length));
        draw_side(&mut canvas, &side.outline, &moved, scale, axes, plan.dim);
    }
    if trails {
        for frames in film.frames.windows(2) {
            for ((a, b), body) in frames[0].iter().zip(&frames[1]).zip(&plan.bodies) {
                let (a, b) = (on(*a), on(*b));
                // Round a periodic box there is no line across it.
                let far = (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
                if !body.fixed && far < 0.5 * across.min(down) {
                    canvas.line(a, b);
                }
            }
        }
    }
    // Where they start: every other dot of their outlines.
    if trails && plan.bodies.len() <= 4 {
        for (x, body) in film.frames[0].iter().zip(&plan.bodies).filter(|(_, b)| !b.fixed && b.radius * scale > 3.0) {
            let steps = (body.radius * scale * 3.0).ceil();
            for k in 0..steps as usize {
                let angle = std::f64::consts::TAU * k as f64 / steps;
                canvas
                    .dot(on(*x)[0] + body.radius * scale * angle.cos(), on(*x)[1] + body.radius * scale * angle.sin());
            }
        }
    }
    let end = film.frames.last().map_or(&[][..], |f| f.as_slice());
    for (x, body) in end.iter().zip(&plan.bodies) {
        let radius = body.radius * scale;
        if radius < 1.0 { canvas.dot(on(*x)[0], on(*x)[1]) } else { canvas.circle(on(*x), radius) }
    }
    let named = ready.scene.bodies.len();
    if plan.bodies.len() <= 40 {
        for (k, x) in end.iter().enumerate().take(if named <= 12 { named } else { 0 }) {
            let at = on(*x);
            canvas.write(at[0], at[1], &plan.name(k));
        }
    }
    let mut text = String::from("\n");
    for line in canvas.lines().iter().skip_while(|line| line.is_empty()) {
        text += &format!("    {line}\n");
    }
    let letter = |k: usize| ["x", "y", "z"][axes[k]];
    let ends = |k: usize| {
        let seen = ranges[k].map(|x| digits(tidy(x, ranges[k][1] - ranges[k][0]), 3));
        format!("{} from {} to {} m", letter(k), seen[0], seen[1])
    };
    let what = if trails { "paths up to" } else { "at" };
    text + &format!("    {}, {}; {what} t = {} s\n", ends(0), ends(1), digits(film.length, 3))
}

/// Points of a wall that a picture should show.
fn corners(outline: &Outline) -> Vec<[f64; 3]> {
    match outline {
        Outline::Segment(a, b) => vec![*a, *b],
        Outline::Triangle(a, b, c) => vec![*a, *b, *c],
        Outline::Arc { centre, radius, from, to } => (0..=8)
            .map(|k| {
                let angle = (from + arc_length(*from, *to) * f64::from(k) / 8.0).to_radians();
                [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin(), 0.0]
            })
            .collect(),
        Outline::Plane(..) => Vec::new(),
    }
}

/// The room that walls and fixed bodies take, if there are any of finite size.
fn frame(plan: &Plan, axes: [usize; 2]) -> Option<[[f64; 2]; 2]> {
    let mut ranges = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let fixed = plan.bodies.iter().filter(|b| b.fixed).map(|b| b.position);
    for point in plan.sides.iter().flat_map(|s| corners(&s.outline)).chain(fixed) {
        ranges.iter_mut().zip(axes).for_each(|(range, axis)| include(range, point[axis]));
    }
    ranges.iter().all(|r| r[0] <= r[1]).then_some(ranges)
}

/// The degrees from one angle to another, counter-clockwise.
fn arc_length(from: f64, to: f64) -> f64 {
    let length = (to - from).rem_euclid(360.0);
    if length == 0.0 { 360.0 } else { length }
}

fn draw_side(
    canvas: &mut Canvas,
    outline: &Outline,
    on: &impl Fn([f64; 3]) -> [f64; 2],
    scale: f64,
    axes: [usize; 2],
    dim: usize,
) {
    match outline {
        Outline::Segment(a, b) => canvas.line(on(*a), on(*b)),
        Outline::Triangle(a, b, c) => {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                canvas.line(on(*p), on(*q));
            }
        }
        Outline::Arc { centre, radius, from, to } => {
            // Upwards on the page is downwards on the sheet.
            let (from, length) = (from.to_radians(), arc_length(*from, *to).to_radians());
            canvas.arc(on(*centre), radius * scale, -from, -(from + length));
        }
        Outline::Plane(point, normal) => {
            // A plane is seen from its edge, or not at all.
            let n = [normal[axes[0]], normal[axes[1]]];
            let length = n[0].hypot(n[1]);
            let across = (0..dim).any(|k| !axes.contains(&k) && normal[k] != 0.0);
            if length > 0.0 && !across {
                let along = [-n[1] / length, n[0] / length];
                let p = on(*point);
                let far = 4.0 * (COLUMNS * ACROSS) as f64;
                // The foot of the sheet's middle, so that the line crosses it wherever the point lies.
                let [width, height] = canvas.size().map(|n| n as f64);
                let along = [along[0], -along[1]];
                let s = (width / 2.0 - p[0]) * along[0] + (height / 2.0 - p[1]) * along[1];
                let foot = [p[0] + s * along[0], p[1] + s * along[1]];
                canvas.line(
                    [foot[0] - far * along[0], foot[1] - far * along[1]],
                    [foot[0] + far * along[0], foot[1] + far * along[1]],
                );
            }
        }
    }
}
