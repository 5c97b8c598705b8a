//! What stands around the stage: title, clock, energy, scales.
use crate::cast::Cast;
use crate::colour::scale;
use crate::figure::{fixed, nice_below, short};
use crate::font::{self, Weight};
use crate::look::{Look, Tint};
use crate::sheet::{Pen, Sheet, Side, Style};
use crate::snapshot::{Snapshot, Survey};
use crate::theme::Theme;
use crate::tint::Tints;
use crate::view::Layout;

/// Kinds of energy.
const NAMES: [&str; 3] = ["kinetic", "potential", "lost"];

/// What surrounds a stage.
#[derive(Clone, Debug)]
pub struct Hud {
    layout: Layout,
    theme: Theme,
    decimals: usize,
    /// Names of kinds of energy that are there: kinetic, potential, lost.
    shares: [bool; 3],
    lowest: f64,
    energy: f64,
    left: f64,
    right: f64,
    /// How fast an arrow of a unit's length is, for each kind of arrow that is drawn: label, metres, pixels.
    pub arrows: Vec<(&'static str, &'static str, usize, f64)>,
}

impl Hud {
    /// The surroundings of a stage.
    pub fn new(cast: &Cast, look: &Look, survey: &Survey, layout: Layout, theme: Theme) -> Self {
        let decimals = (-libm::floor(libm::log10(look.step.max(1e-9)) + 1e-9)).clamp(0.0, 6.0) as usize;
        let falls = cast.gravity.iter().any(|g| *g != 0.0);
        let margin = 30.0 * layout.unit;
        let lowest = if falls && survey.lowest.is_finite() { survey.lowest } else { 0.0 };
        Self {
            layout,
            theme,
            decimals,
            shares: [true, falls, true],
            lowest,
            energy: if survey.energy.is_finite() { survey.energy - lowest } else { 0.0 },
            left: margin,
            right: f64::from(layout.size[0]) - margin,
            arrows: Vec::new(),
        }
    }

    fn baseline(&self) -> f64 {
        34.0 * self.layout.unit
    }

    /// What never changes: the title, the labels, the scales. `metre`: pixels per metre.
    pub fn ground(&self, sheet: &mut Sheet, cast: &Cast, tints: &Tints, look: &Look, metre: Option<f64>) {
        let (u, theme) = (self.layout.unit, &self.theme);
        let small = self.layout.small();
        let title_size = (17.0 * u).max(12.0);
        // A title that would run into the clock is cut.
        let room = self.right - self.left - 12.0 * small;
        let mut title = cast.title.clone();
        if font::width(&title, title_size, Weight::Semibold) > room {
            while !title.is_empty() && font::width(&format!("{title}…"), title_size, Weight::Semibold) > room {
                title.pop();
            }
            title = format!("{}…", title.trim_end());
        }
        sheet.text([self.left, self.baseline()], &title, Style::new(title_size, theme.ink).bold());
        let y = self.label_line();
        let mut right = self.right;
        // What would run into the energies is left out.
        let left = self.left + self.energies();
        if let Some(metre) = metre.filter(|_| right - left > 0.2 * (self.right - self.left) + 5.0 * small) {
            let length = nice_below(0.16 * (self.right - self.left) / metre);
            let from = right - length * metre;
            let pen = Pen::new(theme.quiet, 1.25 * u.max(0.8));
            let tick = 3.5 * u;
            let line = y - 0.36 * small;
            sheet.line(&[[from, line], [right, line]], pen);
            for x in [from, right] {
                sheet.line(&[[x, line - tick], [x, line + tick]], pen);
            }
            let style = Style::new(small, theme.quiet).side(Side::End);
            let width = sheet.text([from - 7.0 * u, y], &format!("{} m", short(length, 2)), style);
            right = from - 7.0 * u - width - 22.0 * u;
        }
        if matches!(tints.tint, Tint::Speed | Tint::Energy) && right - left > 84.0 * u + 8.0 * small {
            let unit = if tints.tint == Tint::Speed { "m/s" } else { "J" };
            let text = format!("{} {unit}", short(tints.top, 2));
            let width = sheet.text([right, y], &text, Style::new(small, theme.quiet).side(Side::End));
            let (end, long) = (right - width - 6.0 * u, 84.0 * u);
            let steps = 42;
            for k in 0..steps {
                let x = |k: i32| (end - long + long * f64::from(k) / f64::from(steps)).round();
                let colour = scale((f64::from(k) + 0.5) / f64::from(steps), theme.dark);
                sheet.rectangle([x(k), (y - 0.72 * small).round(), x(k + 1), y.round()], colour);
            }
            let width = sheet.text([end - long - 6.0 * u, y], "0", Style::new(small, theme.quiet).side(Side::End));
            right = end - long - 12.0 * u - width - 16.0 * u;
        }
        for (label, unit, colour, per_pixel) in &self.arrows {
            let length = nice_below(46.0 * u * per_pixel);
            let text = format!("{label}  {} {unit}", short(length, 2));
            if right - left < font::width(&text, small, Weight::Regular) + length / per_pixel + 25.0 * u {
                break;
            }
            let width = sheet.text([right, y], &text, Style::new(small, theme.quiet).side(Side::End));
            let end = right - width - 7.0 * u;
            let line = y - 0.36 * small;
            let pen = Pen::new(theme.arrows[*colour], 1.8 * u.max(0.8));
            sheet.arrow([end - length / per_pixel, line], [end, line], pen);
            right = end - length / per_pixel - 18.0 * u;
        }
        if look.film && (look.pace - 1.0).abs() > 1e-9 {
            let pace = look.pace;
            let text = if pace < 1.0 {
                format!("slowed {} times", short(1.0 / pace, 3))
            } else {
                format!("{} times as fast", short(pace, 3))
            };
            let x = self.right - self.clock_room() - 14.0 * u;
            sheet.text([x, self.baseline()], &text, Style::new(small, theme.quiet).side(Side::End));
        }
    }

    /// How wide the labels of the energies are.
    fn energies(&self) -> f64 {
        let (u, small) = (self.layout.unit, self.layout.small());
        let wide = |text: &str| font::width(text, small, Weight::Regular);
        let value = wide(&format!("{} J", fixed(self.energy, self.energy)));
        let label = |k: usize| 0.6 * small + 5.0 * u + wide(&format!("{} ", NAMES[k])) + value + 18.0 * u;
        (0..3).filter(|&k| self.shares[k]).map(label).sum()
    }

    fn label_line(&self) -> f64 {
        f64::from(self.layout.size[1]) - 16.0 * self.layout.unit
    }

    fn clock_room(&self) -> f64 {
        let size = (15.0 * self.layout.unit).max(11.0);
        font::width(&format!("t = 000.{:0>1$} s", "", self.decimals), size, Weight::Regular)
    }

    /// What changes: the clock and the energy.
    pub fn now(&self, sheet: &mut Sheet, snapshot: &Snapshot) {
        let (u, theme) = (self.layout.unit, &self.theme);
        let small = self.layout.small();
        let time = format!("t = {:.1$} s", snapshot.time, self.decimals);
        let clock = Style::new((15.0 * u).max(11.0), theme.ink).side(Side::End);
        sheet.text([self.right, self.baseline()], &time, clock);
        let energy = snapshot.energy;
        let parts =
            [energy.kinetic, energy.potential - self.lowest, energy.lost].map(|e| if e > 0.0 { e } else { 0.0 });
        let parts: [f64; 3] = std::array::from_fn(|k| if self.shares[k] { parts[k] } else { 0.0 });
        let total: f64 = parts.iter().sum::<f64>().max(self.energy);
        let y = self.label_line();
        let (top, bottom) = (y - small - 12.0 * u, y - small - 5.0 * u);
        if !(total > 0.0) || !total.is_finite() {
            return;
        }
        sheet.rectangle([self.left, top, self.right, bottom], theme.faint);
        let mut x = self.left;
        for (part, colour) in parts.iter().zip(theme.energy) {
            // To a quarter of a pixel: what hardly changes does not change in a film.
            let wide = ((self.right - self.left) * part / total * 4.0).round() / 4.0;
            if wide > 0.0 {
                sheet.rectangle([x, top, (x + wide).min(self.right), bottom], colour);
                x += wide;
            }
        }
        let mut x = self.left;
        for k in (0..3).filter(|&k| self.shares[k]) {
            let r = 0.3 * small;
            sheet.disc([x + r, y - 0.36 * small], r, theme.energy[k]);
            x += 2.0 * r + 5.0 * u;
            let name = format!("{} ", NAMES[k]);
            x += sheet.text([x, y], &name, Style::new(small, theme.quiet));
            let value = format!("{} J", fixed(parts[k], total));
            sheet.text([x, y], &value, Style::new(small, theme.ink));
            // As wide as the widest value, so that what follows stays where it is.
            x += font::width(&format!("{} J", fixed(total, total)), small, Weight::Regular) + 18.0 * u;
        }
    }
}
