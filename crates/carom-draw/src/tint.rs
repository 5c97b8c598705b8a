//! The colours of bodies.
use crate::cast::Cast;
use crate::colour::{Colour, scale, spoken};
use crate::look::{Look, Tint};
use crate::snapshot::{Snapshot, Survey};
use crate::theme::Theme;

/// More bodies have no colours of their own.
const MOST_NAMES: usize = 16;

/// How bodies are coloured.
#[derive(Clone, Debug)]
pub struct Tints {
    /// What colours say.
    pub tint: Tint,
    /// For each body its number among those of its kind; `None` of what stands fast.
    number: Vec<Option<usize>>,
    /// The colours that a body's name says, or its group's, on light paper and on dark.
    said: Vec<Option<[Colour; 2]>>,
    /// The top of the scale.
    pub top: f64,
    masses: Vec<f64>,
}

impl Tints {
    /// As the look wants it, or as suits the cast.
    pub fn new(cast: &Cast, look: &Look, survey: &Survey) -> Self {
        let free = cast.free().count();
        let mut groups: Vec<usize> = cast.free().map(|k| cast.actors[k].group).collect();
        groups.dedup();
        let tint = look.tint.unwrap_or(match free {
            0..=MOST_NAMES => Tint::Name,
            _ if (2..=8).contains(&groups.len()) => Tint::Group,
            _ => Tint::Speed,
        });
        let mut next = 0;
        let number = cast.actors.iter().map(|actor| {
            let k = (!actor.fixed).then(|| match tint {
                Tint::Group => groups.iter().position(|g| *g == actor.group).unwrap_or(0),
                _ => next,
            });
            next += usize::from(!actor.fixed);
            k
        });
        let number = number.collect();
        let said = cast.actors.iter().enumerate().map(|(k, actor)| {
            let group = cast.groups.get(actor.group).filter(|_| k >= cast.named);
            let name = group.unwrap_or(&actor.label);
            Some([spoken(name, false)?, spoken(name, true)?])
        });
        let said = said.collect();
        let top = match tint {
            Tint::Energy => (4.0 * survey.kinetic / free.max(1) as f64).max(f64::MIN_POSITIVE),
            _ => survey.top_speed(),
        };
        let masses = cast.actors.iter().map(|a| a.mass.unwrap_or(0.0)).collect();
        Self { tint, number, said, top, masses }
    }

    /// The colour of a body's path: its own, unless that is hardly to be told from the floor.
    pub fn path(&self, k: usize, snapshot: &Snapshot, theme: &Theme) -> Colour {
        let (own, _) = self.of(k, snapshot, theme);
        let apart = (own.lightness() - theme.floor.lightness()).abs();
        if apart < 0.1 { own.mix(theme.quiet, 0.7) } else { own }
    }

    /// The colour of a body, and whether it is ringed, as the ninth to the sixteenth are.
    pub fn of(&self, k: usize, snapshot: &Snapshot, theme: &Theme) -> (Colour, bool) {
        let Some(number) = self.number.get(k).copied().flatten() else { return (theme.fixed, false) };
        let part = match self.tint {
            Tint::Name | Tint::Group => {
                return match self.said[k] {
                    Some([light, dark]) => (if theme.dark { dark } else { light }, false),
                    None => (theme.palette[number % 8], number / 8 % 2 == 1),
                };
            }
            Tint::Speed => snapshot.moments.get(k).map_or(0.0, |m| m.speed()) / self.top,
            Tint::Energy => {
                let speed = snapshot.moments.get(k).map_or(0.0, |m| m.speed());
                0.5 * self.masses[k] * speed * speed / self.top
            }
        };
        (scale(part, theme.dark), false)
    }
}
