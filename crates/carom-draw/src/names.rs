//! Names beside discs that have no room for them: where they cover no disc and no other name, if there is such a place nearby.
use crate::font::{self, Weight};
use crate::sheet::{At, Pen, Sheet, Side, Style, Window};
use crate::theme::Theme;

/// How far a name may move away from its disc, in lines of text. Further away than one, a line leads to it.
const RINGS: [f64; 5] = [0.0, 0.7, 1.4, 2.2, 3.0];

/// The names of a picture, and what they must not cover.
pub(crate) struct Names {
    /// Centres and radii.
    discs: Vec<(At, f64)>,
    /// Where names stand already.
    taken: Vec<Window>,
    stage: Window,
    small: f64,
    unit: f64,
}

/// A place for a name: its point, on which side of it the text is, and the box that it fills.
#[derive(Clone, Copy)]
struct Place {
    at: At,
    side: Side,
    fills: Window,
    /// How far out, in lines.
    ring: f64,
}

impl Names {
    pub(crate) fn new(discs: Vec<(At, f64)>, stage: Window, small: f64, unit: f64) -> Self {
        Self { discs, taken: Vec::new(), stage, small, unit }
    }

    /// Writes a name beside its disc.
    pub(crate) fn beside(&mut self, sheet: &mut Sheet, name: &str, centre: At, radius: f64, theme: &Theme) {
        let width = font::width(name, self.small, Weight::Regular);
        let reach = radius + width + 5.0 * self.small;
        if !(centre[0].is_finite() && centre[1].is_finite()) {
            return;
        }
        let near: Vec<(At, f64)> = self.discs.iter().copied().filter(|(p, r)| apart(*p, centre) < reach + r).collect();
        let free = |place: &Place| {
            let [left, top, right, bottom] = place.fills;
            let inside =
                left >= self.stage[0] && right <= self.stage[2] && top >= self.stage[1] && bottom <= self.stage[3];
            inside
                && near.iter().all(|(p, r)| beyond(*p, place.fills) >= *r)
                && self.taken.iter().all(|w| left > w[2] || right < w[0] || top > w[3] || bottom < w[1])
        };
        let places = self.places(centre, radius, width);
        // Where all is full, above and to the right, inside the picture.
        let place = places.iter().find(|p| free(p)).copied().unwrap_or_else(|| {
            let right = if places[0].fills[2] <= self.stage[2] { places[0] } else { places[1] };
            Place { at: [right.at[0], right.at[1].max(self.stage[1] + self.small)], ..right }
        });
        if place.ring > 1.0 {
            let to = nearest(centre, place.fills);
            let way = apart(to, centre);
            let part = if way > 0.0 { radius / way } else { 0.0 };
            let from = [centre[0] + (to[0] - centre[0]) * part, centre[1] + (to[1] - centre[1]) * part];
            sheet.line(&[from, to], Pen::new(theme.quiet.opacity(0.7), 0.9 * self.unit));
        }
        sheet.text(place.at, name, Style::new(self.small, theme.quiet).side(place.side));
        self.taken.push(place.fills);
    }

    /// Where a name may stand, the best place first.
    fn places(&self, [x, y]: At, radius: f64, width: f64) -> Vec<Place> {
        let (small, gap) = (self.small, 3.0 * self.unit);
        // The letters reach so far above the line that they stand on, and below it.
        let (rise, fall) = (0.75 * small, 0.22 * small);
        let mut all = Vec::new();
        for ring in RINGS {
            let aslant = 0.75 * radius + gap + 0.7 * ring * small;
            let straight = radius + gap + ring * small;
            let below = aslant + rise - fall;
            for (at, side) in [
                ([x + aslant, y - aslant], Side::Start),
                ([x - aslant, y - aslant], Side::End),
                ([x + aslant, y + below], Side::Start),
                ([x - aslant, y + below], Side::End),
                ([x, y - straight - fall], Side::Middle),
                ([x, y + straight + rise], Side::Middle),
                ([x + straight, y + 0.36 * small], Side::Start),
                ([x - straight, y + 0.36 * small], Side::End),
            ] {
                let left = match side {
                    Side::Start => at[0],
                    Side::Middle => at[0] - 0.5 * width,
                    Side::End => at[0] - width,
                };
                let fills = [left, at[1] - rise, left + width, at[1] + fall];
                all.push(Place { at, side, fills, ring });
            }
        }
        all
    }
}

/// The point of a box that is nearest to a point.
fn nearest(p: At, [left, top, right, bottom]: Window) -> At {
    [p[0].clamp(left, right.max(left)), p[1].clamp(top, bottom.max(top))]
}

fn apart(a: At, b: At) -> f64 {
    let (x, y) = (a[0] - b[0], a[1] - b[1]);
    (x * x + y * y).sqrt()
}

/// How far a point lies from a box.
fn beyond(p: At, fills: Window) -> f64 {
    apart(p, nearest(p, fills))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::theme::Paper;

    /// A rack of discs that touch, three of them with names, the middle one shut in.
    #[test]
    fn names_cover_no_disc_and_no_other_name() {
        let radius = 10.0;
        let discs: Vec<(At, f64)> =
            (0..25).map(|k| ([200.0 + f64::from(k % 5) * 20.0, 150.0 + f64::from(k / 5) * 20.0], radius)).collect();
        let theme = Paper::Light.theme();
        let mut sheet = Sheet::new();
        let mut names = Names::new(discs.clone(), [0.0, 0.0, 500.0, 400.0], 12.0, 1.0);
        for k in [0, 1, 7, 24] {
            names.beside(&mut sheet, "a name", discs[k].0, radius, &theme);
        }
        assert_eq!(names.taken.len(), 4);
        for (k, a) in names.taken.iter().enumerate() {
            println!("{a:?}");
            assert!(discs.iter().all(|(p, r)| beyond(*p, *a) >= *r), "{a:?} covers a disc");
            assert!(names.taken[..k].iter().all(|b| a[0] > b[2] || a[2] < b[0] || a[1] > b[3] || a[3] < b[1]));
        }
        // The outer ones need no line; whoever is shut in is pointed at.
        assert_eq!(sheet.marks.iter().filter(|m| m.pen.is_some() && m.says.is_none()).count(), 1);
    }

    #[test]
    fn a_name_stays_in_the_picture() {
        let theme = Paper::Light.theme();
        let mut sheet = Sheet::new();
        let mut names = Names::new(vec![([95.0, 5.0], 4.0)], [0.0, 0.0, 100.0, 100.0], 12.0, 1.0);
        names.beside(&mut sheet, "corner", [95.0, 5.0], 4.0, &theme);
        let w = names.taken[0];
        assert!(w[0] >= 0.0 && w[1] >= 0.0 && w[2] <= 100.0 && w[3] <= 100.0, "{w:?}");
    }
}
