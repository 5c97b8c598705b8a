//! A picture of a scene: a ground that stays, and a frame for each time.
use crate::cast::Cast;
use crate::hud::Hud;
use crate::line::Line;
use crate::look::Look;
use crate::plane::{Plane, drift};
use crate::raster::Canvas;
use crate::sheet::Sheet;
use crate::snapshot::{Hit, Snapshot, Survey, norm};
use crate::space::Space;
use crate::svg::svg;
use crate::theme::Theme;
use crate::tint::Tints;
use crate::trace::Trace;
use crate::view::{Layout, region};
use carom_scene::Point;

/// Everything that does not change from frame to frame.
pub struct Drawing {
    /// Who is in it.
    pub cast: Cast,
    /// What is shown.
    pub look: Look,
    /// What is known of the run.
    pub survey: Survey,
    /// The paths of the whole run: on the line always, else where a still shows them.
    pub whole: Trace,
    pub(crate) theme: Theme,
    pub(crate) layout: Layout,
    pub(crate) tints: Tints,
    pub(crate) hud: Hud,
    /// How many bodies something moves.
    pub(crate) free: usize,
    view: View,
}

enum View {
    Line(Line),
    Plane(Plane),
    Space(Space),
}

/// The impacts of more bodies are not shown.
const MOST_RINGED: usize = 300;
/// How long the longest arrow is (units).
const ARROW: f64 = 92.0;

impl Drawing {
    /// A drawing of a run that is known.
    pub fn new(cast: Cast, look: Look, survey: Survey, whole: Trace) -> Self {
        let theme = look.paper.theme();
        let mut region = region(&cast, &survey);
        let drift = if cast.dim == 2 { drift(&cast, &look, &survey) } else { 0.0 };
        region.high[0] += drift;
        let (layout, view) = match cast.dim {
            1 => {
                let (layout, line) = Line::new(&cast, &look, &survey, region);
                (layout, View::Line(line))
            }
            2 => {
                let layout = Layout::new(&look, region.size(0), region.size(1));
                (
                    layout,
                    View::Plane(Plane::new(region, &layout, if survey.end > 0.0 { drift / survey.end } else { 0.0 })),
                )
            }
            _ => {
                let (layout, space) = Space::new(&cast, &look, region);
                (layout, View::Space(space))
            }
        };
        let tints = Tints::new(&cast, &look, &survey);
        let mut hud = Hud::new(&cast, &look, &survey, layout, theme);
        let longest = ARROW * layout.unit;
        let wanted = [
            (look.arrows.velocity, "v", "m/s", survey.fastest),
            (look.arrows.momentum, "p", "kg m/s", survey.momentum),
            (look.arrows.impulse, "J", "N s", survey.hardest),
        ];
        for (k, (wanted, label, unit, most)) in wanted.into_iter().enumerate() {
            if wanted && most > 0.0 {
                hud.arrows.push((label, unit, k, most / longest));
            }
        }
        let free = cast.free().count();
        Self { cast, look, survey, whole, theme, layout, tints, hud, free, view }
    }

    /// Width and height (pixels).
    pub fn size(&self) -> [u32; 2] {
        self.layout.size
    }

    /// What stays.
    pub fn ground(&self) -> Sheet {
        let mut sheet = Sheet::new();
        match &self.view {
            View::Line(line) => line.ground(self, &mut sheet),
            View::Plane(plane) => plane.ground(self, &mut sheet),
            View::Space(space) => space.ground(self, &mut sheet),
        }
        sheet.window = None;
        sheet
    }

    /// What is drawn on it at a time.
    pub fn frame(&self, snapshot: &Snapshot, trace: &Trace) -> Sheet {
        let mut sheet = Sheet::new();
        match &self.view {
            View::Line(line) => line.frame(self, snapshot, trace, &mut sheet),
            View::Plane(plane) => plane.frame(self, snapshot, trace, &mut sheet),
            View::Space(space) => space.frame(self, snapshot, trace, &mut sheet),
        }
        sheet.window = None;
        self.hud.now(&mut sheet, snapshot);
        sheet
    }

    /// A still as SVG.
    pub fn svg(&self, snapshot: &Snapshot, trace: &Trace) -> String {
        let sheets = [&self.ground(), &self.frame(snapshot, trace)];
        svg(self.layout.size, self.theme.paper, &self.cast.title, &sheets)
    }

    /// The ground as pixels; `None` if there would be too many of them.
    pub fn canvas(&self) -> Option<Canvas> {
        let mut canvas = Canvas::new(self.layout.size, self.theme.paper)?;
        canvas.draw(&self.ground());
        canvas.settle();
        Some(canvas)
    }

    /// True if the centre of mass is marked.
    pub(crate) fn centred(&self) -> bool {
        self.look.centre.unwrap_or(self.cast.is_isolated() && self.free <= 12)
    }

    /// The rings of impacts that are seen now: for each its place, its radius as a part of the largest and how strong it is
    /// (0 to 1, in eighths, so that a film needs few colours). None where there are too many to tell apart.
    pub(crate) fn rings(&self, time: f64, trace: &Trace) -> Vec<(Point, f64, f64)> {
        if self.free > MOST_RINGED || !(self.survey.hardest > 0.0) {
            return Vec::new();
        }
        let young = |hit: &&Hit| (0.0..1.0).contains(&((time - hit.time) / self.look.flash()));
        let crowd = (24.0 / trace.hits.iter().filter(young).count().max(24) as f64).sqrt();
        let ring = |hit: &Hit| {
            let age = (time - hit.time) / self.look.flash();
            let strength = (norm(hit.impulse) / self.survey.hardest).min(1.0).sqrt();
            let fade = ((1.0 - age) * crowd * 8.0).ceil() / 8.0;
            (hit.point, (0.25 + 0.75 * strength) * (0.3 + 0.7 * age), fade, strength)
        };
        let seen = trace.hits.iter().filter(young).map(ring).filter(|ring| ring.3 > 0.05);
        seen.map(|(point, size, fade, _)| (point, size, fade)).collect()
    }

    /// Metres per second, kilogram metres per second or newton seconds in a pixel of this kind of arrow (0, 1, 2).
    pub(crate) fn per_pixel(&self, kind: usize) -> Option<f64> {
        self.hud.arrows.iter().find(|a| a.2 == kind).map(|a| a.3)
    }
}
