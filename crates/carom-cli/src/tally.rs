//! What is kept of the impacts of a run: all of them where they are few, else how many, between whom, and the hardest.
use crate::figures::{NOISE, count, digits, plural, short};
use crate::table::Table;
use carom::{Impact, Party, Rotates, Vector};
use carom_scene::Plan;
use carom_scene::output::ImpactLine;
use std::collections::BTreeMap;

/// Up to this many impacts are shown one by one.
const FEW: u64 = 20;
/// Up to this many kinds of pairs are shown.
const MOST_KINDS: usize = 8;

/// The impacts of a run so far.
pub struct Tally {
    few: Vec<ImpactLine>,
    hardest: Option<ImpactLine>,
    seen: u64,
    last: f64,
    kinds: Vec<String>,
    body_kind: Vec<usize>,
    wall_kind: Vec<usize>,
    pairs: BTreeMap<(usize, usize), u64>,
    most_together: u32,
}

impl Tally {
    /// For the bodies and walls of a plan; the first `named` bodies have names of their own, the others those of groups.
    pub fn new(plan: &Plan, named: usize) -> Self {
        let mut kinds: Vec<String> = Vec::new();
        let mut body_kind = Vec::with_capacity(plan.bodies.len());
        for k in 0..plan.bodies.len() {
            let name = plan.name(k);
            let kind = match name.rsplit_once('-') {
                Some((group, _)) if k >= named => group.to_string(),
                _ => name,
            };
            if k < named || kinds.last() != Some(&kind) {
                kinds.push(kind);
            }
            body_kind.push(kinds.len() - 1);
        }
        let first_wall = kinds.len();
        kinds.extend(plan.sides.iter().map(|s| s.label.clone()));
        let wall_kind = (first_wall..kinds.len()).collect();
        Self {
            few: Vec::new(),
            hardest: None,
            seen: 0,
            last: 0.0,
            kinds,
            body_kind,
            wall_kind,
            pairs: BTreeMap::new(),
            most_together: 0,
        }
    }

    /// Counts the `n`-th impact.
    pub fn add<const D: usize>(&mut self, n: u64, impact: &Impact<D>, plan: &Plan)
    where
        Vector<D>: Rotates,
    {
        self.seen = n;
        self.last = impact.time;
        self.most_together = self.most_together.max(impact.together);
        if n <= FEW {
            self.few.push(ImpactLine::new(n, impact, plan));
        }
        if self.hardest.as_ref().is_none_or(|h| impact.impulse > h.impulse) {
            self.hardest = Some(ImpactLine::new(n, impact, plan));
        }
        let [a, b] = impact.parties.map(|party| match party {
            Party::Body(id) => self.body_kind.get(id.index()).copied().unwrap_or(0),
            Party::Wall(id) => self.wall_kind.get(id.index()).copied().unwrap_or(0),
        });
        *self.pairs.entry((a.min(b), a.max(b))).or_default() += 1;
    }

    /// When the last impact was (s); `None` if there was none.
    pub fn last(&self) -> Option<f64> {
        (self.seen > 0).then_some(self.last)
    }

    /// The impacts for people, given how long the run was (s).
    pub fn text(&self, time: f64, colour: bool) -> String {
        if self.seen == 0 {
            return "No impacts.\n".into();
        }
        if self.seen <= FEW {
            return format!("{}:\n{}", plural(self.seen, "impact"), self.each(colour));
        }
        let rate = self.seen as f64 / time;
        let rate = match rate {
            // An impact a second or more, and no infinity.
            1.0..1e15 => format!(" in {} s ({} per second)", short(time), count(rate.round() as u64)),
            _ => String::new(),
        };
        let mut text = format!("{}{rate}:\n", plural(self.seen, "impact"));
        if let Some(h) = &self.hardest {
            let [a, b] = &h.bodies;
            text += &format!(
                "  hardest   {a} - {b}: {} N s at t = {} s (number {})\n",
                short(h.impulse),
                short(h.time),
                count(h.n)
            );
        }
        if self.most_together > 1 {
            text += &format!("  together  up to {} contacts in one instant\n", self.most_together);
        }
        let mut pairs: Vec<_> = self.pairs.iter().collect();
        pairs.sort_by_key(|(pair, n)| (std::cmp::Reverse(**n), **pair));
        let shown = if pairs.len() <= MOST_KINDS { pairs.len() } else { MOST_KINDS - 1 };
        let width = pairs.first().map_or(0, |(_, n)| count(**n).len());
        for (k, ((a, b), n)) in pairs.iter().take(shown).enumerate() {
            let head = if k == 0 { "between" } else { "" };
            text += &format!("  {head:<8}  {:>width$}  {} - {}\n", count(**n), self.kinds[*a], self.kinds[*b]);
        }
        if shown < pairs.len() {
            let rest: u64 = pairs[shown..].iter().map(|(_, n)| **n).sum();
            text += &format!("  {:8}  {:>width$}  {} other pairs\n", "", count(rest), pairs.len() - shown);
        }
        text
    }

    fn each(&self, colour: bool) -> String {
        let together = self.most_together > 1;
        let mut head = vec!["n", "time s", "who", "approach", "e", "departure", "impulse N s", "lost J"];
        if together {
            head.push("together");
        }
        let mut table = Table::new("rrlrrrrrr", head);
        for x in &self.few {
            let mut row = vec![x.n.to_string(), short(x.time), x.bodies.join(" - ")];
            row.extend(numbers(x));
            if together {
                row.push(x.together.to_string());
            }
            table.row(row);
        }
        table.text(colour)
    }
}

/// Approach, e, departure, impulse and lost energy in five digits; what is nothing but rounding as 0.
pub fn numbers(x: &ImpactLine) -> [String; 5] {
    let speeds = x.before.iter().chain(&x.after).flat_map(|m| &m.velocity);
    let speed = speeds.fold(0.0, |fastest: f64, v| fastest.max(v.abs()));
    let rounded = |x: f64, scale: f64| digits(if x.abs() <= NOISE * scale { 0.0 } else { x }, 5);
    [
        rounded(x.approach, speed),
        digits(x.restitution, 5),
        rounded(x.departure, speed),
        digits(x.impulse, 5),
        rounded(x.lost, speed * x.impulse),
    ]
}
