//! Space, through a camera: balls with light and shade, the farthest first, and their shadows on the floor.
use crate::camera::Camera;
use crate::cast::{Cast, corners};
use crate::colour::Colour;
use crate::drawing::Drawing;
use crate::figure::nice_below;
use crate::look::Look;
use crate::plane::{haloed, marker};
use crate::sheet::{At, Pen, Sheet, Side, Style};
use crate::snapshot::{Snapshot, norm};
use crate::trace::Trace;
use crate::view::{Layout, Region};
use carom_scene::{Outline, Point};

/// More bodies throw no shadows.
const MOST_SHADOWS: usize = 3000;
/// How pale the farthest bodies are.
const HAZE: f64 = 0.45;
/// Positions of a strobe.
const FLASHES: usize = 14;

/// Space's place on the sheet.
pub struct Space {
    camera: Camera,
    region: Region,
    /// The height of the floor (m).
    floor: f64,
}

/// The corners of a region.
fn ends(region: &Region) -> Vec<Point> {
    (0..8).map(|k| std::array::from_fn(|i| if k >> i & 1 == 1 { region.high[i] } else { region.low[i] })).collect()
}

impl Space {
    pub(crate) fn new(cast: &Cast, look: &Look, region: Region) -> (Layout, Self) {
        let camera = Camera::new(cast, &region);
        let seen = camera.frame(&ends(&region));
        let layout = Layout::new(look, seen[2] - seen[0], seen[3] - seen[1]);
        let camera = camera.on(&ends(&region), layout.stage);
        let (axis, positive) = camera.vertical;
        let floor = if positive { region.low[axis] } else { region.high[axis] };
        (layout, Self { camera, region, floor })
    }

    pub(crate) fn ground(&self, d: &Drawing, sheet: &mut Sheet) {
        let (u, theme) = (d.layout.unit, &d.theme);
        let (up, _) = self.camera.vertical;
        let (a, b) = ((up + 1) % 3, (up + 2) % 3);
        let point = |x: f64, y: f64| {
            let mut p = [0.0; 3];
            (p[a], p[b], p[up]) = (x, y, self.floor);
            self.camera.at(p)
        };
        let (low, high) = (self.region.low, self.region.high);
        sheet.area(
            &[point(low[a], low[b]), point(high[a], low[b]), point(high[a], high[b]), point(low[a], high[b])],
            theme.floor,
        );
        // A grid on the floor, and how wide its meshes are.
        let mesh = nice_below(0.26 * self.region.size(a).max(self.region.size(b)));
        let pen = Pen::new(theme.faint, 1.0 * u);
        for (k, other) in [(a, b), (b, a)] {
            let (first, last) = ((low[k] / mesh).ceil() as i64, (high[k] / mesh).floor() as i64);
            for n in first..=last.min(first + 200) {
                let x = n as f64 * mesh;
                let line = [low[other], high[other]].map(|y| if k == a { point(x, y) } else { point(y, x) });
                sheet.line(&line, pen);
            }
        }
        self.edges(d, sheet, false);
        // The boundary's own sides are the box.
        for side in d.cast.sides.iter().take(d.cast.walls) {
            if let Outline::Plane(p, n) = side.outline
                && side.velocity == [0.0; 3]
            {
                self.plane(d, sheet, p, n);
            }
        }
        d.hud.ground(sheet, &d.cast, &d.tints, &d.look, None);
        let y = f64::from(d.layout.size[1]) - 16.0 * u;
        if d.hud.arrows.is_empty() && !matches!(d.tints.tint, crate::look::Tint::Speed | crate::look::Tint::Energy) {
            let right = f64::from(d.layout.size[0]) - 30.0 * u;
            let text = format!("meshes of {} m", crate::figure::short(mesh, 2));
            sheet.text([right, y], &text, Style::new(d.layout.small(), theme.quiet).side(Side::End));
        }
    }

    /// The edges of the box: those behind everything, or those before it.
    fn edges(&self, d: &Drawing, sheet: &mut Sheet, front: bool) {
        if d.cast.extent.is_none() {
            return;
        }
        let ends = ends(&self.region);
        let nearest = (0..8).fold(0, |n, k| if self.camera.near(ends[k]) > self.camera.near(ends[n]) { k } else { n });
        for k in 0..8usize {
            for i in 0..3 {
                let other = k | 1 << i;
                if k & 1 << i != 0 {
                    continue;
                }
                let is_front = k == nearest || other == nearest;
                if is_front != front {
                    continue;
                }
                let mut pen = Pen::new(d.theme.quiet.opacity(if front { 0.35 } else { 0.7 }), 1.2 * d.layout.unit);
                if d.cast.periodic[i] {
                    pen = pen.dashed(5.0 * d.layout.unit, 5.0 * d.layout.unit);
                }
                sheet.line(&[self.camera.at(ends[k]), self.camera.at(ends[other])], pen);
            }
        }
    }

    /// The part of a plane that lies in the region.
    fn plane(&self, d: &Drawing, sheet: &mut Sheet, p: Point, n: Point) {
        let ends = ends(&self.region);
        let height = |q: Point| (0..3).map(|k| (q[k] - p[k]) * n[k]).sum::<f64>();
        let mut cut: Vec<Point> = Vec::new();
        for k in 0..8usize {
            for i in (0..3).filter(|i| k & 1 << i == 0) {
                let (a, b) = (ends[k], ends[k | 1 << i]);
                let (ha, hb) = (height(a), height(b));
                let tiny = 1e-9 * norm(n) * norm([self.region.size(0), self.region.size(1), self.region.size(2)]);
                if ha.abs() <= tiny {
                    cut.push(a);
                } else if ha * hb < 0.0 {
                    cut.push(std::array::from_fn(|j| a[j] + ha / (ha - hb) * (b[j] - a[j])));
                } else if hb.abs() <= tiny {
                    cut.push(b);
                }
            }
        }
        let mut at: Vec<At> = cut.into_iter().map(|q| self.camera.at(q)).collect();
        if at.len() < 3 {
            return;
        }
        let count = at.len() as f64;
        let middle = [at.iter().map(|p| p[0]).sum::<f64>() / count, at.iter().map(|p| p[1]).sum::<f64>() / count];
        let angle = |p: &At| libm::atan2(p[1] - middle[1], p[0] - middle[0]);
        at.sort_by(|x, y| angle(x).total_cmp(&angle(y)));
        at.dedup();
        sheet.area(&at, d.theme.wall.opacity(0.10));
        at.push(at[0]);
        sheet.line(&at, Pen::new(d.theme.wall.opacity(0.6), 1.3 * d.layout.unit));
    }

    pub(crate) fn frame(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        let u = d.layout.unit;
        for side in d.cast.sides.iter().take(d.cast.walls) {
            if let Outline::Plane(p, n) = side.outline
                && side.velocity != [0.0; 3]
            {
                self.plane(d, sheet, std::array::from_fn(|k| p[k] + side.velocity[k] * snapshot.time), n);
            }
        }
        if d.free <= MOST_SHADOWS {
            for (moment, actor) in snapshot.moments.iter().zip(&d.cast.actors) {
                self.shadow(d, sheet, moment.position, actor.radius);
            }
        }
        if d.look.trails || d.look.strobe {
            self.trails(d, snapshot, trace, sheet);
        }
        self.things(d, snapshot, trace, sheet);
        self.edges(d, sheet, true);
        for (point, size, fade) in d.rings(snapshot.time, trace) {
            let pen = Pen::new(d.theme.flash.opacity(0.85 * fade), (2.6 * fade * u).max(0.9));
            sheet.ring(self.camera.at(point), size * 25.0 * u, pen);
        }
        if d.centred()
            && let Some(centre) = snapshot.centre(&d.cast)
        {
            marker(sheet, self.camera.at(centre), 5.5 * u, d.theme.paper, d.theme.ink);
        }
        self.arrows(d, snapshot, trace, sheet);
    }

    fn shadow(&self, d: &Drawing, sheet: &mut Sheet, place: Point, radius: f64) {
        let (up, positive) = self.camera.vertical;
        let height = (place[up] - self.floor) * if positive { 1.0 } else { -1.0 } - radius;
        let tall = self.region.size(up).max(1e-300);
        // A shadow is pale where its body is high; in steps, so that a film needs few colours.
        let part = (1.0 - height / tall).clamp(0.0, 1.0);
        let strong = (0.2 * part * part * part * 40.0).round() / 40.0;
        if !(strong > 0.0) {
            return;
        }
        let (a, b) = ((up + 1) % 3, (up + 2) % 3);
        let ring: Vec<At> = (0..20)
            .map(|k| {
                let angle = (18.0 * f64::from(k)).to_radians();
                let mut p = place;
                p[a] += radius * libm::cos(angle);
                p[b] += radius * libm::sin(angle);
                p[a] = p[a].clamp(self.region.low[a], self.region.high[a]);
                p[b] = p[b].clamp(self.region.low[b], self.region.high[b]);
                p[up] = self.floor;
                self.camera.at(p)
            })
            .collect();
        let ink = if d.theme.dark { Colour::hex(0x000000) } else { Colour::hex(0x1b2430) };
        sheet.area(&ring, ink.opacity(if d.theme.dark { 2.2 * strong } else { strong }));
    }

    /// Balls and triangles, the farthest first.
    fn things(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        enum Thing<'a> {
            Ball(usize, Point, f64),
            Wall(&'a carom_scene::Side),
        }
        let mut all: Vec<(f64, Thing<'_>)> = Vec::new();
        for (k, moment) in snapshot.moments.iter().enumerate() {
            all.push((self.camera.near(moment.position), Thing::Ball(k, moment.position, 1.0)));
        }
        if d.look.strobe {
            for flash in 0..FLASHES {
                let part = flash as f64 / FLASHES as f64;
                for k in d.cast.free() {
                    if let Some(place) = trace.at(k, snapshot.time * part) {
                        all.push((self.camera.near(place), Thing::Ball(k, place, 0.15 + 0.45 * part)));
                    }
                }
            }
        }
        for side in d.cast.sides.iter().filter(|s| matches!(s.outline, Outline::Triangle(..))) {
            let c = corners(&side.outline);
            let middle =
                std::array::from_fn(|k| c.iter().map(|p| p[k]).sum::<f64>() / 3.0 + side.velocity[k] * snapshot.time);
            all.push((self.camera.near(middle), Thing::Wall(side)));
        }
        all.sort_by(|x, y| x.0.total_cmp(&y.0));
        let depth = self.camera.depth().max(1e-300);
        let few = d.free <= 40;
        for (near, thing) in all {
            match thing {
                Thing::Ball(k, place, strong) => {
                    let radius = d.cast.actors[k].radius * self.camera.scale(place);
                    let at = self.camera.at(place);
                    let (colour, _) = d.tints.of(k, snapshot, &d.theme);
                    // In eighths, so that a film needs few colours.
                    let haze = HAZE * ((0.5 - 0.5 * near / depth).clamp(0.0, 1.0) * 8.0).round() / 8.0;
                    let colour = colour.mix(d.theme.paper, haze).opacity(strong);
                    if strong < 1.0 {
                        sheet.disc(at, radius, colour);
                        continue;
                    }
                    sheet.ball(at, radius, colour);
                    let label = &d.cast.actors[k].label;
                    if few && radius >= 11.0 && !d.cast.actors[k].fixed {
                        let wide = crate::font::width(label, 1.0, crate::font::Weight::Semibold).max(0.5);
                        let size = (1.2 * radius / wide).min(0.8 * radius).min(20.0 * d.layout.unit);
                        if size >= 8.0 {
                            let style = Style::new(size, d.theme.letters_on(colour)).bold().side(Side::Middle);
                            sheet.text([at[0], at[1] + 0.36 * size], label, style);
                        }
                    }
                }
                Thing::Wall(side) => {
                    let by = side.velocity.map(|v| v * snapshot.time);
                    let mut at: Vec<At> = corners(&side.outline)
                        .into_iter()
                        .map(|p| self.camera.at(std::array::from_fn(|k| p[k] + by[k])))
                        .collect();
                    sheet.area(&at, d.theme.wall.opacity(0.22));
                    at.push(at[0]);
                    sheet.line(&at, Pen::new(d.theme.wall, 1.5 * d.layout.unit));
                }
            }
        }
    }

    fn trails(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        let far = 0.5 * (0..3).map(|k| self.region.size(k)).fold(f64::INFINITY, f64::min);
        for (k, path) in trace.paths.iter().enumerate().filter(|p| p.1.len() > 1) {
            let colour = d.tints.path(k, snapshot, &d.theme);
            let start = snapshot.time - d.look.memory();
            let points: Vec<(f64, Point)> = path.iter().copied().filter(|p| p.0 >= start).collect();
            for piece in points.chunk_by(|a, b| (0..3).all(|i| !d.cast.periodic[i] || (a.1[i] - b.1[i]).abs() < far)) {
                let on: Vec<At> = piece.iter().map(|p| self.camera.at(p.1)).collect();
                sheet.line(&on, Pen::new(colour.opacity(0.5), 1.6 * d.layout.unit));
            }
        }
    }

    fn arrows(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        let u = d.layout.unit;
        // An arrow's length in space, so that perspective shortens it as it should.
        let pixels = |p: Point| self.camera.scale(p);
        for kind in [0, 1] {
            let Some(per_pixel) = d.per_pixel(kind) else { continue };
            for k in d.cast.free() {
                let Some(moment) = snapshot.moments.get(k) else { continue };
                let factor = if kind == 0 { 1.0 } else { d.cast.actors[k].mass.unwrap_or(0.0) };
                let p = moment.position;
                let metres = factor / per_pixel / pixels(p);
                // From the surface of what carries letters.
                let (radius, speed) = (d.cast.actors[k].radius, moment.speed());
                let out = if radius * pixels(p) >= 11.0 && speed > 0.0 { radius / speed } else { 0.0 };
                let p: Point = std::array::from_fn(|i| p[i] + moment.velocity[i] * out);
                let tip = std::array::from_fn(|i| p[i] + moment.velocity[i] * metres);
                haloed(sheet, self.camera.at(p), self.camera.at(tip), d.theme.arrows[kind], d.theme.paper, u);
            }
        }
        if let Some(per_pixel) = d.per_pixel(2) {
            for hit in trace.hits.iter().filter(|hit| hit.time <= snapshot.time) {
                let p = hit.point;
                for (which, sign) in [(0, -1.0), (1, 1.0)] {
                    if hit.bodies[which].is_some() {
                        let metres = sign / per_pixel / pixels(p);
                        let tip = std::array::from_fn(|i| p[i] + hit.impulse[i] * metres);
                        haloed(sheet, self.camera.at(p), self.camera.at(tip), d.theme.arrows[2], d.theme.paper, u);
                    }
                }
            }
        }
    }
}
