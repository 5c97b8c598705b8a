//! The plane, seen as it is.
use crate::cast::{Cast, curve};
use crate::colour::Colour;
use crate::drawing::Drawing;
use crate::font::{self, Weight};
use crate::look::Look;
use crate::names::Names;
use crate::sheet::{At, Pen, Sheet, Side, Style, Window};
use crate::snapshot::{Snapshot, Survey, norm};
use crate::trace::Trace;
use crate::view::{Layout, Map, Region};
use carom_scene::{Outline, Point};

/// Smaller discs have no rim, and carry no letters (pixels).
const RIM: f64 = 4.0;
const LETTERS: f64 = 8.0;
/// The white middle of a ringed disc, by its radius.
const INNER: f64 = 0.7;
/// More bodies have no labels.
const MOST_LABELS: usize = 60;
/// Discs of a strobe.
const FLASHES: usize = 14;
/// The walls' hatching: depth and distance (units).
const HATCH: [f64; 2] = [10.0, 8.0];

/// The plane's place on the sheet.
pub struct Plane {
    map: Map,
    stage: Window,
    /// The stage and the hatching around it.
    around: Window,
    region: Region,
    /// How far a strobe moves to the right in a second (m): what only goes up and down would hide itself.
    drift: f64,
}

/// How far a strobe of this cast moves to the right in all (m): not at all, unless nothing moves to the side.
pub(crate) fn drift(cast: &Cast, look: &Look, survey: &Survey) -> f64 {
    let still = |k: usize| {
        let (low, high) = cast.free().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), i| {
            (low.min(cast.start[i][k] - cast.actors[i].radius), high.max(cast.start[i][k] + cast.actors[i].radius))
        });
        survey.low[k] >= low - 1e-6 * (high - low) && survey.high[k] <= high + 1e-6 * (high - low)
    };
    let wanted = look.strobe && !look.film && cast.extent.is_none() && still(0) && !still(1);
    if wanted { 1.35 * (survey.high[1] - survey.low[1]) } else { 0.0 }
}

impl Plane {
    pub(crate) fn new(region: Region, layout: &Layout, drift: f64) -> Self {
        let stage = layout.stage;
        let hatch = HATCH[0] * layout.unit + 1.0;
        let around = [stage[0] - hatch, stage[1] - hatch, stage[2] + hatch, stage[3] + hatch];
        Self { map: Map::new(region, stage), stage, around, region, drift }
    }

    pub(crate) fn ground(&self, d: &Drawing, sheet: &mut Sheet) {
        sheet.rectangle(self.stage, d.theme.floor);
        self.cell(d, sheet);
        for side in d.cast.sides.iter().filter(|s| s.velocity == [0.0; 3]) {
            self.wall(d, sheet, &side.outline, [0.0; 3]);
        }
        sheet.window = None;
        d.hud.ground(sheet, &d.cast, &d.tints, &d.look, Some(self.map.scale));
        if self.drift > 0.0 {
            let style = Style::new(d.layout.small(), d.theme.quiet).side(Side::End);
            let at = [self.stage[2] - 8.0 * d.layout.unit, self.stage[1] + 1.6 * d.layout.small()];
            sheet.text(at, "time to the right", style);
        }
    }

    /// The sides of a box through which one leaves and enters again.
    fn cell(&self, d: &Drawing, sheet: &mut Sheet) {
        let Some((min, max)) = d.cast.extent else { return };
        let [a, b] = [min, max].map(|p| self.map.at(p));
        let pen =
            Pen::new(d.theme.quiet.opacity(0.8), 1.2 * d.layout.unit).dashed(5.0 * d.layout.unit, 5.0 * d.layout.unit);
        if d.cast.periodic[0] {
            sheet.line(&[[a[0], a[1]], [a[0], b[1]]], pen);
            sheet.line(&[[b[0], a[1]], [b[0], b[1]]], pen);
        }
        if d.cast.periodic[1] {
            sheet.line(&[[a[0], a[1]], [b[0], a[1]]], pen);
            sheet.line(&[[a[0], b[1]], [b[0], b[1]]], pen);
        }
    }

    /// Where a place at a time is shown.
    fn spread(&self, place: Point, time: f64) -> Point {
        [place[0] + self.drift * time, place[1], place[2]]
    }

    fn wall(&self, d: &Drawing, sheet: &mut Sheet, outline: &Outline, by: Point) {
        let (u, colour) = (d.layout.unit, d.theme.wall);
        let at = |p: Point| self.map.at([p[0] + by[0], p[1] + by[1], 0.0]);
        let thick = Pen::new(colour, 2.6 * u);
        match *outline {
            Outline::Plane(p, n) => {
                let length = norm(n);
                let n = [n[0] / length, n[1] / length];
                sheet.window = Some(self.around);
                let [x, y] = at(p);
                // On the sheet y points downwards.
                let (out, along) = ([-n[0], n[1]], [n[1], n[0]]);
                let reach = 2.0 * (self.around[2] - self.around[0]).max(self.around[3] - self.around[1]);
                // From where the window's middle falls on the line.
                let middle = [0.5 * (self.stage[0] + self.stage[2]) - x, 0.5 * (self.stage[1] + self.stage[3]) - y];
                let shift = middle[0] * along[0] + middle[1] * along[1];
                let foot = [x + along[0] * shift, y + along[1] * shift];
                let [deep, apart] = HATCH.map(|h| h * u);
                let point = |t: f64, o: f64| [foot[0] + along[0] * t + out[0] * o, foot[1] + along[1] * t + out[1] * o];
                let straight = n[0] == 0.0 || n[1] == 0.0;
                // Hatching never leaves the stage's side of a corner.
                let half = match straight {
                    true if n[0] == 0.0 => 0.5 * (self.stage[2] - self.stage[0]),
                    true => 0.5 * (self.stage[3] - self.stage[1]),
                    false => reach,
                };
                let count = (2.0 * half / apart).floor().clamp(0.0, 2000.0) as i32;
                let pen = Pen::new(colour.opacity(0.55), 1.1 * u);
                for k in 0..=count {
                    let t = -half + (f64::from(k) + 0.5) * apart;
                    if t < half {
                        sheet.line(&[point(t, 1.0), point(t - deep, deep)], pen);
                    }
                }
                let pen = Pen::new(colour, 2.0 * u);
                sheet.line(&[point(-half - 1.0 * u, 1.0 * u), point(half + 1.0 * u, 1.0 * u)], pen);
            }
            Outline::Segment(a, b) => {
                sheet.window = Some(self.around);
                sheet.line(&[at(a), at(b)], thick);
            }
            Outline::Arc { radius, from, to, .. } => {
                sheet.window = Some(self.around);
                let pixels = radius * self.map.scale * (to - from).abs();
                let steps = (pixels / 3.0).clamp(12.0, 720.0) as usize;
                let points: Vec<At> = curve(outline, steps).into_iter().map(at).collect();
                sheet.line(&points, thick);
            }
            Outline::Triangle(..) => {}
        }
        sheet.window = None;
    }

    pub(crate) fn frame(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        for side in d.cast.sides.iter().filter(|s| s.velocity != [0.0; 3]) {
            self.wall(d, sheet, &side.outline, side.velocity.map(|v| v * snapshot.time));
        }
        sheet.window = Some(self.stage);
        if d.look.trails || d.look.strobe {
            self.trails(d, snapshot, trace, sheet);
        }
        if d.look.strobe {
            self.strobe(d, snapshot, trace, sheet);
        }
        for pass in [true, false] {
            for k in (0..d.cast.actors.len()).filter(|&k| d.cast.actors[k].fixed == pass) {
                if let Some(moment) = snapshot.moments.get(k) {
                    let (colour, ringed) = d.tints.of(k, snapshot, &d.theme);
                    self.body(d, sheet, k, self.spread(moment.position, snapshot.time), colour, ringed);
                }
            }
        }
        self.flashes(d, snapshot, trace, sheet);
        if d.centred() {
            self.centre(d, snapshot, trace, sheet);
        }
        self.arrows(d, snapshot, trace, sheet);
        self.names(d, snapshot, sheet);
        sheet.window = None;
    }

    /// A body and, in a periodic box, its images.
    fn body(&self, d: &Drawing, sheet: &mut Sheet, k: usize, place: Point, colour: Colour, ringed: bool) {
        let actor = &d.cast.actors[k];
        let radius = actor.radius * self.map.scale;
        for image in images(d, place, actor.radius) {
            let at = self.map.at(image);
            let seen = at[0] + radius >= self.stage[0]
                && at[0] - radius <= self.stage[2]
                && at[1] + radius >= self.stage[1]
                && at[1] - radius <= self.stage[3];
            if !seen {
                continue;
            }
            sheet.disc(at, radius, colour);
            if radius >= RIM {
                let width = (0.09 * radius).clamp(0.8, 2.2);
                let rim = colour.mix(Colour::hex(0x0b1320), if d.theme.dark { 0.38 } else { 0.26 });
                sheet.ring(at, radius - 0.5 * width, Pen::new(rim.opacity(f64::from(colour.a) / 255.0), width));
            }
            if ringed && radius >= RIM {
                let inner = if self.fits(d, k, radius) { INNER } else { 0.5 };
                sheet.disc(at, inner * radius, Colour::hex(0xffffff).opacity(f64::from(colour.a) / 255.0));
            }
            let ground = if ringed { Colour::hex(0xffffff).opacity(f64::from(colour.a) / 255.0) } else { colour };
            self.letter(d, sheet, k, at, radius, ground);
        }
    }

    /// A short label on a disc that has room for it.
    fn letter(&self, d: &Drawing, sheet: &mut Sheet, k: usize, at: At, radius: f64, colour: Colour) {
        let actor = &d.cast.actors[k];
        if colour.a < 255 || actor.fixed || !self.fits(d, k, radius) {
            return;
        }
        let size = letter_size(&actor.label, radius);
        let style = Style::new(size, d.theme.letters_on(colour)).bold().side(Side::Middle);
        sheet.text([at[0], at[1] + 0.36 * size], &actor.label, style);
    }

    /// True if the label of a body is written on it.
    fn fits(&self, d: &Drawing, k: usize, radius: f64) -> bool {
        let label = &d.cast.actors[k].label;
        let few = d.free <= MOST_LABELS;
        few && radius >= LETTERS && letter_size(label, radius) >= 8.0
    }

    /// Names beside bodies that have names of their own and no room for them.
    fn names(&self, d: &Drawing, snapshot: &Snapshot, sheet: &mut Sheet) {
        if d.cast.named > 12 {
            return;
        }
        let disc = |k: usize| self.map.at(self.spread(snapshot.moments[k].position, snapshot.time));
        let count = snapshot.moments.len();
        let discs = (0..count).map(|k| (disc(k), d.cast.actors[k].radius * self.map.scale)).collect();
        let mut names = Names::new(discs, self.stage, d.layout.small(), d.layout.unit);
        for k in 0..d.cast.named.min(count) {
            let actor = &d.cast.actors[k];
            let radius = actor.radius * self.map.scale;
            if self.fits(d, k, radius) && !actor.fixed {
                continue;
            }
            names.beside(sheet, &actor.label, disc(k), radius, &d.theme);
        }
    }

    fn trails(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        let far = 0.5 * self.region.size(0).min(self.region.size(1));
        let whole = d.look.memory().is_infinite();
        for (k, path) in trace.paths.iter().enumerate() {
            if path.len() < 2 {
                continue;
            }
            let colour = d.tints.path(k, snapshot, &d.theme);
            let radius = d.cast.actors[k].radius * self.map.scale;
            let width = (0.28 * radius).clamp(1.1 * d.layout.unit, 3.2 * d.layout.unit);
            // Pieces of a path, where it does not go round the box.
            let points: Vec<(f64, Point)> = path.iter().copied().collect();
            for piece in points.chunk_by(|a, b| (0..2).all(|i| !d.cast.periodic[i] || (a.1[i] - b.1[i]).abs() < far)) {
                if whole {
                    let on: Vec<At> = piece.iter().map(|p| self.map.at(self.spread(p.1, p.0))).collect();
                    sheet.line(&on, Pen::new(colour.opacity(0.5), 0.8 * width));
                    continue;
                }
                // The tail fades.
                let parts = 5;
                let start = snapshot.time - d.look.memory();
                for part in 0..parts {
                    let age = |n: i32| start + d.look.memory() * f64::from(n) / f64::from(parts);
                    let on = cut(piece, age(part), age(part + 1), &self.map);
                    let strong = f64::from(part + 1) / f64::from(parts);
                    sheet.line(&on, Pen::new(colour.opacity(0.55 * strong), width * (0.4 + 0.6 * strong)));
                }
            }
        }
    }

    /// Where everything was at equal steps of time.
    fn strobe(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        for flash in 0..FLASHES {
            let time = snapshot.time * flash as f64 / FLASHES as f64;
            let strong = 0.14 + 0.5 * flash as f64 / FLASHES as f64;
            for k in d.cast.free() {
                if let Some(place) = trace.at(k, time) {
                    let (colour, ringed) = d.tints.of(k, snapshot, &d.theme);
                    self.body(d, sheet, k, self.spread(place, time), colour.opacity(strong), ringed);
                }
            }
        }
    }

    fn flashes(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        let u = d.layout.unit;
        // Small bodies, small rings.
        let radius = d.cast.actors.iter().filter(|a| !a.fixed).map(|a| a.radius).fold(0.0, f64::max) * self.map.scale;
        let largest = (24.0 * u).min(6.0 * u + 2.4 * radius);
        for (point, size, fade) in d.rings(snapshot.time, trace) {
            let pen = Pen::new(d.theme.flash.opacity(0.85 * fade), (2.4 * fade * u).max(0.9));
            sheet.ring(self.map.at(self.spread(point, snapshot.time)), size * largest, pen);
        }
    }

    fn centre(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        let Some(centre) = snapshot.centre(&d.cast) else { return };
        let (u, ink) = (d.layout.unit, d.theme.ink);
        let path: Vec<At> = trace.centre.iter().map(|p| self.map.at(p.1)).collect();
        if path.len() > 1 {
            sheet.line(&[path[0], path[path.len() - 1]], Pen::new(ink.opacity(0.6), 1.1 * u).dashed(4.0 * u, 4.0 * u));
        }
        let at = self.map.at(self.spread(centre, snapshot.time));
        marker(sheet, at, 5.5 * u, d.theme.paper, ink);
    }

    fn arrows(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        let u = d.layout.unit;
        for kind in [0, 1] {
            let Some(per_pixel) = d.per_pixel(kind) else { continue };
            for k in d.cast.free() {
                let Some(moment) = snapshot.moments.get(k) else { continue };
                let factor = if kind == 0 { 1.0 } else { d.cast.actors[k].mass.unwrap_or(0.0) };
                let [x, y] = self.map.at(self.spread(moment.position, snapshot.time));
                let v = [moment.velocity[0], -moment.velocity[1]].map(|v| v * factor / per_pixel);
                // Beside each other if both are drawn.
                let aside = if d.look.arrows.velocity && d.look.arrows.momentum { 3.6 * u } else { 0.0 };
                let long = (v[0] * v[0] + v[1] * v[1]).sqrt();
                if !(long > 1.0) {
                    continue;
                }
                let sign = if kind == 0 { 1.0 } else { -1.0 };
                let shift = [-v[1] / long * aside * sign, v[0] / long * aside * sign];
                // From the edge of what carries letters.
                let radius = d.cast.actors[k].radius * self.map.scale;
                let edge = if self.fits(d, k, radius) { radius / long } else { 0.0 };
                let from = [x + shift[0] + edge * v[0], y + shift[1] + edge * v[1]];
                haloed(sheet, from, [from[0] + v[0], from[1] + v[1]], d.theme.arrows[kind], d.theme.paper, u);
            }
        }
        if let Some(per_pixel) = d.per_pixel(2) {
            for hit in trace.hits.iter().filter(|hit| hit.time <= snapshot.time) {
                let from = self.map.at(self.spread(hit.point, snapshot.time));
                for (which, sign) in [(0, -1.0), (1, 1.0)] {
                    if hit.bodies[which].is_some() {
                        let to =
                            [from[0] + sign * hit.impulse[0] / per_pixel, from[1] - sign * hit.impulse[1] / per_pixel];
                        haloed(sheet, from, to, d.theme.arrows[2], d.theme.paper, u);
                    }
                }
            }
        }
    }
}

/// An arrow that is seen on any ground.
pub(crate) fn haloed(sheet: &mut Sheet, from: At, to: At, colour: Colour, paper: Colour, u: f64) {
    sheet.arrow(from, to, Pen::new(paper.opacity(0.75), 4.0 * u.max(0.8)));
    sheet.arrow(from, to, Pen::new(colour, 2.0 * u.max(0.8)));
}

/// The sign of a centre of mass: a circle, two quarters of it filled.
pub(crate) fn marker(sheet: &mut Sheet, at: At, r: f64, paper: Colour, ink: Colour) {
    sheet.disc(at, r, paper);
    let quarter = |from: f64| -> Vec<At> {
        let arc = (0..=6).map(|k| {
            let angle = (from + 15.0 * f64::from(k)).to_radians();
            [at[0] + r * libm::cos(angle), at[1] + r * libm::sin(angle)]
        });
        std::iter::once(at).chain(arc).collect()
    };
    sheet.area(&quarter(0.0), ink);
    sheet.area(&quarter(180.0), ink);
    sheet.ring(at, r, Pen::new(ink, 0.22 * r));
}

fn letter_size(label: &str, radius: f64) -> f64 {
    let wide = font::width(label, 1.0, Weight::Semibold).max(0.5);
    (1.5 * radius / wide).min(1.05 * radius).min(22.0)
}

/// The part of a path between two times.
fn cut(path: &[(f64, Point)], from: f64, to: f64, map: &Map) -> Vec<At> {
    let mut on = Vec::new();
    for pair in path.windows(2) {
        let [(t0, a), (t1, b)] = [pair[0], pair[1]];
        if t1 <= from || t0 >= to || !(t1 > t0) {
            continue;
        }
        let at = |t: f64| {
            let part = ((t - t0) / (t1 - t0)).clamp(0.0, 1.0);
            map.at(std::array::from_fn(|i| a[i] + part * (b[i] - a[i])))
        };
        if on.is_empty() {
            on.push(at(from.max(t0)));
        }
        on.push(at(to.min(t1)));
    }
    on
}

/// A place and, in a periodic box, its images that reach into the box.
fn images(d: &Drawing, place: Point, radius: f64) -> Vec<Point> {
    let mut all = vec![place];
    let Some((min, max)) = d.cast.extent else { return all };
    for k in 0..2 {
        if !d.cast.periodic[k] {
            continue;
        }
        for n in 0..all.len() {
            for (near, shift) in
                [(place[k] - radius < min[k], max[k] - min[k]), (place[k] + radius > max[k], min[k] - max[k])]
            {
                if near {
                    let mut image = all[n];
                    image[k] += shift;
                    all.push(image);
                }
            }
        }
    }
    all
}
