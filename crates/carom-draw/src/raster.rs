//! A sheet as pixels. Discs and balls are drawn here, by the distance of a pixel from the edge; outlines by tiny-skia.
use crate::ball::{self, SHADES};
use crate::colour::Colour;
use crate::sheet::{At, Form, Mark, Pen, Sheet, Step, Window};
use std::collections::BTreeMap;
use tiny_skia::{FillRule, LineCap, LineJoin, Mask, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform};

/// The side of a tile (pixels): what has changed is known tile by tile.
pub const TILE: usize = 32;

/// Pixels, opaque, and which tiles of them were drawn on.
pub struct Canvas {
    map: Pixmap,
    width: usize,
    height: usize,
    tiles: Vec<bool>,
    masks: Vec<(Window, Mask)>,
    balls: BTreeMap<Colour, [[u8; 3]; SHADES]>,
}

/// Pixels that are drawn on: columns and rows, the ends not included.
#[derive(Clone, Copy)]
struct Span {
    x: [usize; 2],
    y: [usize; 2],
}

impl Canvas {
    /// A canvas of this size and colour; `None` if it is too large or empty.
    pub fn new([width, height]: [u32; 2], paper: Colour) -> Option<Self> {
        let mut map = Pixmap::new(width, height)?;
        map.fill(tiny_skia::Color::from_rgba8(paper.r, paper.g, paper.b, 255));
        let (width, height) = (width as usize, height as usize);
        let tiles = vec![false; width.div_ceil(TILE) * height.div_ceil(TILE)];
        Some(Self { map, width, height, tiles, masks: Vec::new(), balls: BTreeMap::new() })
    }

    /// Width and height (pixels).
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Red, green, blue and 255, pixel by pixel.
    pub fn pixels(&self) -> &[u8] {
        self.map.data()
    }

    /// Which tiles were drawn on since they were last restored, row by row.
    pub fn tiles(&self) -> &[bool] {
        &self.tiles
    }

    /// The pixels of a tile, given its number: columns and rows.
    pub fn tile(&self, k: usize) -> ([usize; 2], [usize; 2]) {
        let across = self.width.div_ceil(TILE);
        let (x, y) = (k % across * TILE, k / across * TILE);
        ([x, (x + TILE).min(self.width)], [y, (y + TILE).min(self.height)])
    }

    /// Takes what is drawn as the ground on which frames are drawn.
    pub fn settle(&mut self) {
        self.tiles.fill(false);
    }

    /// Brings back the ground wherever it was drawn on.
    pub fn restore(&mut self, ground: &Canvas) {
        for k in 0..self.tiles.len() {
            if std::mem::take(&mut self.tiles[k]) {
                let ([left, right], [top, bottom]) = self.tile(k);
                for y in top..bottom {
                    let row = 4 * (y * self.width + left)..4 * (y * self.width + right);
                    self.map.data_mut()[row.clone()].copy_from_slice(&ground.map.data()[row]);
                }
            }
        }
    }

    /// A copy of the pixels, nothing marked as drawn on.
    pub fn copy(&self) -> Self {
        Self {
            map: self.map.clone(),
            width: self.width,
            height: self.height,
            tiles: vec![false; self.tiles.len()],
            masks: Vec::new(),
            balls: self.balls.clone(),
        }
    }

    /// Draws a sheet.
    pub fn draw(&mut self, sheet: &Sheet) {
        for mark in &sheet.marks {
            self.mark(mark);
        }
    }

    fn mark(&mut self, mark: &Mark) {
        match &mark.form {
            Form::Disc { centre, radius } => {
                if let Some(colour) = mark.fill {
                    self.disc(*centre, *radius, colour, mark.window);
                }
                if let Some(pen) = mark.pen {
                    self.ring(*centre, *radius, pen, mark.window);
                }
            }
            Form::Ball { centre, radius } => {
                if let Some(colour) = mark.fill {
                    self.ball(*centre, *radius, colour, mark.window);
                }
            }
            Form::Outline(steps) => self.outline(steps, mark),
        }
    }

    /// The pixels of the canvas in a rectangle and a window.
    fn span(&self, [left, top, right, bottom]: Window, window: Option<Window>) -> Option<Span> {
        let [l, t, r, b] = window.unwrap_or([0.0, 0.0, self.width as f64, self.height as f64]);
        let clamp = |x: f64, most: usize| x.clamp(0.0, most as f64) as usize;
        let x = [clamp(left.max(l).floor(), self.width), clamp(right.min(r).ceil(), self.width)];
        let y = [clamp(top.max(t).floor(), self.height), clamp(bottom.min(b).ceil(), self.height)];
        (x[0] < x[1] && y[0] < y[1]).then_some(Span { x, y })
    }

    fn touch(&mut self, span: Span) {
        let across = self.width.div_ceil(TILE);
        for row in span.y[0] / TILE..=(span.y[1] - 1) / TILE {
            for column in span.x[0] / TILE..=(span.x[1] - 1) / TILE {
                self.tiles[row * across + column] = true;
            }
        }
    }

    /// Goes through the pixels around a point; `cover` gives, for a squared distance, how much of the pixel is covered.
    fn round(
        &mut self,
        centre: At,
        reach: f64,
        window: Option<Window>,
        colour: Colour,
        cover: impl Fn(f64) -> f64,
        solid: f64,
    ) {
        let [x, y] = centre;
        let Some(span) = self.span([x - reach, y - reach, x + reach, y + reach], window) else { return };
        self.touch(span);
        let (width, rgb) = (self.width, [colour.r, colour.g, colour.b]);
        let alpha = u32::from(colour.a);
        let solid2 = if solid > 0.0 { solid * solid } else { -1.0 };
        let data = self.map.data_mut();
        for row in span.y[0]..span.y[1] {
            let dy = row as f64 + 0.5 - y;
            let left2 = reach * reach - dy * dy;
            if !(left2 > 0.0) {
                continue;
            }
            let half = left2.sqrt();
            let first = ((x - half).floor().max(span.x[0] as f64)) as usize;
            let last = ((x + half).ceil().min(span.x[1] as f64)).max(0.0) as usize;
            for column in first..last {
                let dx = column as f64 + 0.5 - x;
                let d2 = dx * dx + dy * dy;
                let part = if d2 <= solid2 { 256 } else { (cover(d2) * 256.0 + 0.5) as u32 };
                if part > 0 {
                    let at = 4 * (row * width + column);
                    blend(&mut data[at..at + 3], rgb, part.min(256) * alpha);
                }
            }
        }
    }

    fn disc(&mut self, centre: At, radius: f64, colour: Colour, window: Option<Window>) {
        // A disc smaller than a pixel is as pale as the part of the pixel that it fills.
        let (radius, pale) = if radius < 0.6 { (0.6, (radius / 0.6) * (radius / 0.6)) } else { (radius, 1.0) };
        let cover = move |d2: f64| pale * (radius + 0.5 - d2.sqrt()).clamp(0.0, 1.0);
        let solid = if pale < 1.0 { -1.0 } else { radius - 0.5 };
        self.round(centre, radius + 1.0, window, colour, cover, solid);
    }

    fn ring(&mut self, centre: At, radius: f64, pen: Pen, window: Option<Window>) {
        let half = 0.5 * pen.width;
        let cover = move |d2: f64| {
            let d = d2.sqrt();
            ((radius + half + 0.5 - d).clamp(0.0, 1.0) - (radius - half + 0.5 - d).clamp(0.0, 1.0)).max(0.0)
        };
        self.round(centre, radius + half + 1.0, window, pen.colour, cover, -1.0);
    }

    fn ball(&mut self, centre: At, radius: f64, colour: Colour, window: Option<Window>) {
        if radius < 2.5 {
            return self.disc(centre, radius, ball::lit(colour, 0.7), window);
        }
        let shades = *self.balls.entry(colour).or_insert_with(|| {
            std::array::from_fn(|k| {
                let lit = ball::lit(colour, (k as f64 + 0.5) / SHADES as f64);
                [lit.r, lit.g, lit.b]
            })
        });
        let [x, y] = centre;
        let reach = radius + 1.0;
        let Some(span) = self.span([x - reach, y - reach, x + reach, y + reach], window) else { return };
        self.touch(span);
        let (width, alpha) = (self.width, u32::from(colour.a));
        let data = self.map.data_mut();
        for row in span.y[0]..span.y[1] {
            let dy = row as f64 + 0.5 - y;
            for column in span.x[0]..span.x[1] {
                let dx = column as f64 + 0.5 - x;
                let d = (dx * dx + dy * dy).sqrt();
                let part = ((radius + 0.5 - d).clamp(0.0, 1.0) * 256.0 + 0.5) as u32;
                if part > 0 {
                    let shade = (ball::light(dx / radius, dy / radius) * SHADES as f64) as usize;
                    let at = 4 * (row * width + column);
                    blend(&mut data[at..at + 3], shades[shade.min(SHADES - 1)], part * alpha);
                }
            }
        }
    }

    fn outline(&mut self, steps: &[Step], mark: &Mark) {
        let Some(path) = path(steps) else { return };
        let bounds = path.bounds();
        let wide = mark.pen.map_or(0.0, |pen| pen.width) + 1.0;
        let bounds = [bounds.left(), bounds.top(), bounds.right(), bounds.bottom()].map(f64::from);
        let reach = [bounds[0] - wide, bounds[1] - wide, bounds[2] + wide, bounds[3] + wide];
        let Some(span) = self.span(reach, mark.window) else { return };
        self.touch(span);
        if let Some(window) = mark.window
            && !self.masks.iter().any(|m| m.0 == window)
            && let Some(mask) = mask([self.width as u32, self.height as u32], window)
        {
            self.masks.push((window, mask));
        }
        // A mask costs time; what lies within its window needs none.
        let inside = mark.window.is_none_or(|[l, t, r, b]| {
            reach[0] >= l.ceil() && reach[1] >= t.ceil() && reach[2] <= r.floor() && reach[3] <= b.floor()
        });
        let mask = match mark.window {
            Some(window) if !inside => self.masks.iter().find(|m| m.0 == window).map(|m| &m.1),
            _ => None,
        };
        let mut paint = Paint { anti_alias: true, ..Paint::default() };
        if let Some(colour) = mark.fill {
            paint.set_color_rgba8(colour.r, colour.g, colour.b, colour.a);
            self.map.fill_path(&path, &paint, FillRule::Winding, Transform::identity(), mask);
        }
        if let Some(Pen { colour, width, dash }) = mark.pen {
            paint.set_color_rgba8(colour.r, colour.g, colour.b, colour.a);
            let dash = dash.and_then(|[dash, gap]| StrokeDash::new(vec![dash as f32, gap as f32], 0.0));
            let (line_cap, line_join) = (LineCap::Round, LineJoin::Round);
            let stroke = Stroke { width: width as f32, dash, line_cap, line_join, ..Stroke::default() };
            self.map.stroke_path(&path, &paint, &stroke, Transform::identity(), mask);
        }
    }
}

/// Lays a colour over a pixel; the opacity in 256 times 255 parts.
#[inline(always)]
fn blend(pixel: &mut [u8], rgb: [u8; 3], opacity: u32) {
    const WHOLE: u32 = 256 * 255;
    for (under, over) in pixel.iter_mut().zip(rgb) {
        *under = ((u32::from(over) * opacity + u32::from(*under) * (WHOLE - opacity) + WHOLE / 2) / WHOLE) as u8;
    }
}

fn mask([width, height]: [u32; 2], [left, top, right, bottom]: Window) -> Option<Mask> {
    let mut mask = Mask::new(width, height)?;
    let rect = tiny_skia::Rect::from_ltrb(left as f32, top as f32, right as f32, bottom as f32)?;
    mask.fill_path(&PathBuilder::from_rect(rect), FillRule::Winding, true, Transform::identity());
    Some(mask)
}

fn path(steps: &[Step]) -> Option<Path> {
    let mut path = PathBuilder::new();
    for step in steps {
        match *step {
            Step::Move([x, y]) => path.move_to(x as f32, y as f32),
            Step::Line([x, y]) => path.line_to(x as f32, y as f32),
            Step::Quad([a, b], [x, y]) => path.quad_to(a as f32, b as f32, x as f32, y as f32),
            Step::Cubic([a, b], [c, d], [x, y]) => {
                path.cubic_to(a as f32, b as f32, c as f32, d as f32, x as f32, y as f32);
            }
            Step::Close => path.close(),
        }
    }
    path.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    const WHITE: Colour = Colour::hex(0xffffff);
    const BLACK: Colour = Colour::hex(0);

    /// How much ink there is, in pixels.
    fn ink(canvas: &Canvas) -> f64 {
        canvas.pixels().chunks(4).map(|p| (255.0 - f64::from(p[0])) / 255.0).sum()
    }

    #[test]
    fn a_disc_has_the_area_of_a_disc_wherever_it_lies() {
        for radius in [0.2, 0.5, 1.0, 3.3, 20.0] {
            for at in [[30.0, 30.0], [30.5, 30.25], [29.9, 30.7]] {
                let mut canvas = Canvas::new([60, 60], WHITE).unwrap();
                let mut sheet = Sheet::new();
                sheet.disc(at, radius, BLACK);
                canvas.draw(&sheet);
                let (got, want) = (ink(&canvas), std::f64::consts::PI * radius * radius);
                println!("{radius} {got} {want}");
                // The edge is a ramp of one pixel instead of a step: its area is right to about a sixth of a pixel squared.
                assert!((got - want).abs() < 0.45 + 0.01 * want, "{radius} {at:?}: {got} {want}");
            }
        }
    }

    #[test]
    fn what_is_restored_is_the_ground() {
        let mut ground = Canvas::new([100, 70], WHITE).unwrap();
        let mut sheet = Sheet::new();
        sheet.line(&[[0.0, 0.0], [100.0, 70.0]], Pen::new(BLACK, 3.0));
        ground.draw(&sheet);
        ground.settle();
        let mut canvas = ground.copy();
        let mut sheet = Sheet::new();
        sheet.window = Some([20.0, 10.0, 60.0, 50.0]);
        sheet.disc([60.0, 40.0], 25.0, Colour::hex(0xff0000));
        sheet.ball([20.0, 20.0], 9.0, Colour::hex(0x00ff00));
        sheet.area(&[[0.0, 60.0], [90.0, 30.0], [50.0, 0.0]], Colour::hex(0x0000ff));
        canvas.draw(&sheet);
        assert!(canvas.pixels() != ground.pixels());
        for (k, pixel) in canvas.pixels().chunks(4).enumerate() {
            let (x, y) = (k % 100, k / 100);
            let outside = !(20..60).contains(&x) || !(10..50).contains(&y);
            assert!(!outside || pixel == &ground.pixels()[4 * k..4 * k + 4], "{x} {y}");
        }
        canvas.restore(&ground);
        assert_eq!(canvas.pixels(), ground.pixels());
    }
}
