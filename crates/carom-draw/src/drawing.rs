//! A picture of a scene: a ground that stays, and a frame for each time.
use crate::cast::Cast;
use crate::hud::Hud;
use crate::line::Line;
use crate::look::Look;
use crate::plane::Plane;
use crate::raster::Canvas;
use crate::sheet::Sheet;
use crate::snapshot::{Snapshot, Survey};
use crate::space::Space;
use crate::svg::svg;
use crate::theme::Theme;
use crate::tint::Tints;
use crate::trace::Trace;
use crate::view::{Layout, region};

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
    view: View,
}

enum View {
    Line(Line),
    Plane(Plane),
    Space(Space),
}

/// How long the longest arrow is (units).
const ARROW: f64 = 92.0;

impl Drawing {
    /// A drawing of a run that is known.
    pub fn new(cast: Cast, look: Look, survey: Survey, whole: Trace) -> Self {
        let theme = look.paper.theme();
        let region = region(&cast, &survey);
        let (layout, view) = match cast.dim {
            1 => {
                let (layout, line) = Line::new(&cast, &look, &survey, region);
                (layout, View::Line(line))
            }
            2 => {
                let layout = Layout::new(&look, region.size(0), region.size(1));
                (layout, View::Plane(Plane::new(region, &layout)))
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
        Self { cast, look, survey, whole, theme, layout, tints, hud, view }
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

    /// Metres per second, kilogram metres per second or newton seconds in a pixel of this kind of arrow (0, 1, 2).
    pub(crate) fn per_pixel(&self, kind: usize) -> Option<f64> {
        self.hud.arrows.iter().find(|a| a.2 == kind).map(|a| a.3)
    }
}
