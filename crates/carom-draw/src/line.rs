//! The line: a lane, and under it the diagram of space and time, time downwards.
use crate::cast::Cast;
use crate::drawing::Drawing;
use crate::figure::ticks;
use crate::look::Look;
use crate::plane::{haloed, marker};
use crate::sheet::{At, Pen, Sheet, Side, Style, Window};
use crate::snapshot::{Snapshot, Survey};
use crate::trace::Trace;
use crate::view::{Layout, Region};
use carom_scene::Outline;

/// Impacts marked in the diagram.
const MOST_MARKS: usize = 4000;

/// The line's place on the sheet.
pub struct Line {
    region: Region,
    lane: Window,
    diagram: Window,
    end: f64,
    /// Pixels per metre.
    scale: f64,
    /// Half the height of the thickest body.
    half: f64,
}

impl Line {
    pub(crate) fn new(cast: &Cast, look: &Look, survey: &Survey, region: Region) -> (Layout, Self) {
        let mut look = look.clone();
        look.size = look.size.or(Some([960, 620]));
        let mut layout = Layout::new(&look, 1.0, 0.6);
        let u = layout.unit;
        let [w, h] = layout.size.map(f64::from);
        // Left is room for times.
        let (left, right) = (78.0 * u, w - 30.0 * u);
        let scale = (right - left) / region.size(0);
        let thick = cast.actors.iter().map(|a| a.radius).fold(0.0, f64::max) * scale;
        let half = thick.min(46.0 * u).max(3.0 * u);
        let small = layout.small();
        let top = (60.0 * u).max(34.0 * u + 1.6 * small);
        let lane = [left, top, right, top + 2.0 * half + 2.0 * (17.0 * u).max(small + 6.0 * u)];
        let diagram = [left, lane[3] + 14.0 * u, right, h - 44.0 * u - 4.1 * small];
        layout.stage = [left, top, right, diagram[3]];
        (layout, Self { region, lane, diagram, end: survey.end, scale, half })
    }

    fn x(&self, x: f64) -> f64 {
        self.lane[0] + (x - self.region.low[0]) * self.scale
    }

    fn y(&self, time: f64) -> f64 {
        let part = if self.end > 0.0 { time / self.end } else { 0.0 };
        self.diagram[1] + part * (self.diagram[3] - self.diagram[1])
    }

    fn middle(&self) -> f64 {
        0.5 * (self.lane[1] + self.lane[3])
    }

    pub(crate) fn ground(&self, d: &Drawing, sheet: &mut Sheet) {
        let (u, theme, small) = (d.layout.unit, &d.theme, d.layout.small());
        sheet.rectangle(self.lane, theme.floor);
        sheet.rectangle(self.diagram, theme.floor);
        let y = self.middle();
        sheet.line(&[[self.lane[0], y], [self.lane[2], y]], Pen::new(theme.faint, 2.0 * u));
        for (x, label) in ticks(self.region.low[0], self.region.high[0], 8) {
            let x = self.x(x);
            sheet.line(&[[x, self.diagram[1]], [x, self.diagram[3]]], Pen::new(theme.faint, 1.0));
            sheet.line(&[[x, self.diagram[3]], [x, self.diagram[3] + 4.0 * u]], Pen::new(theme.quiet, 1.0 * u));
            let at = [x, self.diagram[3] + 6.0 * u + small];
            sheet.text(at, &label, Style::new(small, theme.quiet).side(Side::Middle));
        }
        sheet.text(
            [self.diagram[2], self.diagram[3] + 9.0 * u + 2.0 * small],
            "x (m)",
            Style::new(small, theme.quiet).side(Side::End),
        );
        for (t, label) in ticks(0.0, self.end, 6) {
            let y = self.y(t);
            sheet.line(&[[self.diagram[0], y], [self.diagram[2], y]], Pen::new(theme.faint, 1.0));
            let at = [self.diagram[0] - 14.0 * u, y + 0.36 * small];
            sheet.text(at, &label, Style::new(small, theme.quiet).side(Side::End));
        }
        let middle = [20.0 * u, 0.5 * (self.diagram[1] + self.diagram[3])];
        sheet.upright(middle, "t (s)", Style::new(small, theme.quiet));
        sheet.window = Some(self.diagram);
        self.worldlines(d, sheet, f64::INFINITY, 0.22);
        sheet.window = None;
        for side in d.cast.sides.iter() {
            self.wall(d, sheet, &side.outline, side.velocity[0]);
        }
        d.hud.ground(sheet, &d.cast, &d.tints, &d.look, None);
    }

    /// A wall's worldline, hatched.
    fn wall(&self, d: &Drawing, sheet: &mut Sheet, outline: &Outline, velocity: f64) {
        let Outline::Plane(p, n) = *outline else { return };
        let u = d.layout.unit;
        let (from, to) = ([self.x(p[0]), self.diagram[1]], [self.x(p[0] + velocity * self.end), self.diagram[3]]);
        let out = -n[0].signum() * 8.0 * u;
        sheet.window = Some([self.diagram[0] - 9.0 * u, self.diagram[1], self.diagram[2] + 9.0 * u, self.diagram[3]]);
        let steps = ((to[1] - from[1]) / (7.0 * u)).clamp(1.0, 400.0) as i32;
        for k in 0..steps {
            let part = (f64::from(k) + 0.5) / f64::from(steps);
            let at = [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])];
            sheet.line(&[at, [at[0] + out, at[1] - out.abs()]], Pen::new(d.theme.wall.opacity(0.5), 1.1 * u));
        }
        sheet.line(&[from, to], Pen::new(d.theme.wall, 2.0 * u));
        if velocity == 0.0 {
            self.post(d, sheet, from[0], out);
        }
        sheet.window = None;
    }

    /// A wall in the lane.
    fn post(&self, d: &Drawing, sheet: &mut Sheet, x: f64, out: f64) {
        let u = d.layout.unit;
        sheet.window = None;
        let (top, bottom) = (self.lane[1], self.lane[3]);
        let steps = ((bottom - top) / (7.0 * u)).clamp(1.0, 100.0) as i32;
        for k in 1..=steps {
            let y = top + f64::from(k) * (bottom - top) / f64::from(steps);
            sheet.line(&[[x, y], [x + out, y - out.abs()]], Pen::new(d.theme.wall.opacity(0.5), 1.1 * u));
        }
        sheet.line(&[[x, top], [x, bottom]], Pen::new(d.theme.wall, 2.0 * u));
    }

    /// Bands as wide as the bodies, up to a time.
    fn worldlines(&self, d: &Drawing, sheet: &mut Sheet, until: f64, strong: f64) {
        for (k, path) in d.whole.paths.iter().enumerate() {
            let Some(first) = path.front() else { continue };
            let number = crate::snapshot::Snapshot { time: 0.0, moments: Vec::new(), energy: Default::default() };
            let colour = d.tints.path(k, &number, &d.theme);
            let r = d.cast.actors[k].radius * self.scale;
            let mut left: Vec<At> = Vec::new();
            let mut last = *first;
            for &(time, place) in path {
                let (t, x) = if time <= until {
                    (time, place[0])
                } else if last.0 < until {
                    (until, last.1[0] + (until - last.0) / (time - last.0) * (place[0] - last.1[0]))
                } else {
                    break;
                };
                let at = [self.x(x), self.y(t)];
                // Points that are one on the sheet are one.
                let same = left.last().is_some_and(|p| (p[0] - at[0]).abs() < 0.05 && (p[1] - at[1]).abs() < 0.05);
                if !same {
                    left.push(at);
                }
                last = (time, place);
            }
            if left.len() < 2 {
                continue;
            }
            let edge = |sign: f64| left.iter().map(move |p| [p[0] + sign * r, p[1]]);
            let band: Vec<At> = edge(-1.0).chain(edge(1.0).rev()).collect();
            sheet.area(&band, colour.opacity(strong));
            sheet.line(&left, Pen::new(colour.opacity((2.2 * strong).min(1.0)), 1.6 * d.layout.unit));
        }
        if strong > 0.4 {
            let marks = d.whole.marks.iter().filter(|m| m.0 <= until);
            let mut last: Option<At> = None;
            for (time, place) in marks.take(MOST_MARKS) {
                let at = [self.x(place[0]), self.y(*time)];
                let near = last.is_some_and(|l: At| (l[0] - at[0]).abs() + (l[1] - at[1]).abs() < 0.5);
                if !near {
                    sheet.disc(at, 2.6 * d.layout.unit, d.theme.flash);
                    last = Some(at);
                }
            }
        }
    }

    pub(crate) fn frame(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        let (u, theme) = (d.layout.unit, &d.theme);
        sheet.window = Some(self.diagram);
        self.worldlines(d, sheet, if d.look.film { snapshot.time } else { f64::INFINITY }, 0.5);
        sheet.window = None;
        let y = self.y(snapshot.time);
        sheet.line(&[[self.diagram[0], y], [self.diagram[2], y]], Pen::new(theme.ink.opacity(0.7), 1.2 * u));
        for side in d.cast.sides.iter().filter(|s| s.velocity[0] != 0.0) {
            if let Outline::Plane(p, n) = side.outline {
                let x = self.x(p[0] + side.velocity[0] * snapshot.time);
                self.post(d, sheet, x, -n[0].signum() * 8.0 * u);
            }
        }
        sheet.window = Some(self.lane);
        let middle = self.middle();
        let named = d.cast.actors.len() <= 40;
        for (k, (moment, actor)) in snapshot.moments.iter().zip(&d.cast.actors).enumerate() {
            let (x, r) = (self.x(moment.position[0]), actor.radius * self.scale);
            let tall = r.min(self.half);
            let (colour, _) = d.tints.of(k, snapshot, theme);
            let rim = colour.mix(crate::colour::Colour::hex(0x0b1320), if theme.dark { 0.38 } else { 0.26 });
            if r <= self.half {
                sheet.disc([x, middle], r, colour);
                if r > 4.0 {
                    sheet.ring([x, middle], r - 0.8 * u, Pen::new(rim, 1.6 * u));
                }
            } else {
                sheet.rounded([x - r, middle - tall, x + r, middle + tall], 0.35 * tall, rim);
                let b = 1.6 * u;
                sheet.rounded([x - r + b, middle - tall + b, x + r - b, middle + tall - b], 0.3 * tall, colour);
            }
            let wide = crate::font::width(&actor.label, 1.0, crate::font::Weight::Semibold).max(0.5);
            let size = (1.5 * r / wide).min(0.8 * tall).min(20.0 * u);
            if named && size >= 8.0 {
                let style = Style::new(size, theme.letters_on(colour)).bold().side(Side::Middle);
                sheet.text([x, middle + 0.36 * size], &actor.label, style);
            } else if named && k < d.cast.named {
                let style = Style::new(d.layout.small(), theme.quiet).side(Side::Middle);
                sheet.text([x, middle - tall - 5.0 * u], &actor.label, style);
            }
        }
        for (point, size, fade) in d.rings(snapshot.time, trace) {
            let pen = Pen::new(theme.flash.opacity(0.85 * fade), (2.6 * fade * u).max(0.9));
            sheet.ring([self.x(point[0]), middle], size * 28.0 * u, pen);
        }
        if d.centred()
            && let Some(centre) = snapshot.centre(&d.cast)
        {
            let at = [self.x(centre[0]), self.lane[3] - 9.0 * u];
            marker(sheet, at, 5.0 * u, theme.paper, theme.ink);
        }
        self.arrows(d, snapshot, trace, sheet);
        sheet.window = None;
    }

    fn arrows(&self, d: &Drawing, snapshot: &Snapshot, trace: &Trace, sheet: &mut Sheet) {
        let (u, middle) = (d.layout.unit, self.middle());
        let both = d.look.arrows.velocity && d.look.arrows.momentum;
        for kind in [0, 1] {
            let Some(per_pixel) = d.per_pixel(kind) else { continue };
            for k in d.cast.free() {
                let Some(moment) = snapshot.moments.get(k) else { continue };
                let factor = if kind == 0 { 1.0 } else { d.cast.actors[k].mass.unwrap_or(0.0) };
                let x = self.x(moment.position[0]);
                let row = middle
                    + if !both {
                        0.0
                    } else if kind == 0 {
                        -5.0 * u
                    } else {
                        5.0 * u
                    };
                let long = moment.velocity[0] * factor / per_pixel;
                // From the edge of what carries letters.
                let r = d.cast.actors[k].radius * self.scale;
                let x = if r > 8.0 * u && long != 0.0 { x + r * long.signum() } else { x };
                let to = [x + long, row];
                haloed(sheet, [x, row], to, d.theme.arrows[kind], d.theme.paper, u);
            }
        }
        if let Some(per_pixel) = d.per_pixel(2) {
            for hit in trace.hits.iter().filter(|hit| hit.time <= snapshot.time) {
                let from = [self.x(hit.point[0]), self.lane[1] + 8.0 * u];
                for (which, sign) in [(0, -1.0), (1, 1.0)] {
                    if hit.bodies[which].is_some() {
                        let to = [from[0] + sign * hit.impulse[0] / per_pixel, from[1]];
                        haloed(sheet, from, to, d.theme.arrows[2], d.theme.paper, u);
                    }
                }
            }
        }
    }
}
