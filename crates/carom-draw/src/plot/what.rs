//! The five plots.
use super::chart::{Axis, Chart, Key, Sort};
use super::history::{History, MOST_PATHS};
use super::maxwell::maxwell;
use crate::colour::Colour;
use crate::figure::short;
use crate::theme::Theme;
use std::collections::BTreeMap;

/// What a plot shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// Kinetic, potential and lost energy, stacked.
    Energy,
    /// The momentum of all, by components.
    Momentum,
    /// A histogram of speeds, with Maxwell's curve.
    Speed,
    /// The smallest gaps.
    Gaps,
    /// Where the bodies are, by time.
    Spacetime,
}

/// The gap (m, by the largest radius) that counts as touching on a logarithmic axis.
const TOUCHING: f64 = 1e-7;

/// The plot of a run.
pub fn chart(history: &History, theme: &Theme) -> Chart {
    let end = history.samples.last().map_or(1.0, |s| s.time);
    let start = history.samples.first().map_or(0.0, |s| s.time);
    let mut chart = Chart {
        title: history.cast.title.clone(),
        subtitle: String::new(),
        x: Axis::between("time (s)", start, end),
        y: Axis::between("", 0.0, 1.0),
        layers: Vec::new(),
        keys: Vec::new(),
    };
    match history.what() {
        What::Energy => energy(history, theme, &mut chart),
        What::Momentum => momentum(history, theme, &mut chart),
        What::Speed => speed(history, theme, &mut chart),
        What::Gaps => gaps(history, theme, &mut chart),
        What::Spacetime => paths(history, theme, &mut chart),
    }
    chart
}

fn key(chart: &mut Chart, label: &str, colour: Colour, sort: Sort) -> usize {
    chart.keys.push(Key { label: label.to_owned(), colour, sort });
    chart.keys.len() - 1
}

const LINE: Sort = Sort::Line { dashed: false };
const DASHED: Sort = Sort::Line { dashed: true };

fn energy(history: &History, theme: &Theme, chart: &mut Chart) {
    chart.subtitle = "energy".into();
    let lowest = history.samples.iter().map(|s| s.energy.potential).fold(f64::INFINITY, f64::min);
    let falls = history.cast.gravity != [0.0; 3];
    let works = history.samples.iter().any(|s| s.energy.work != 0.0);
    let mut base = vec![0.0; history.samples.len()];
    for (k, name) in ["kinetic", "potential, from its lowest", "lost"].into_iter().enumerate() {
        if k == 1 && !falls {
            continue;
        }
        let number = key(chart, name, theme.energy[k], Sort::Area);
        let part = |s: &super::Sample| match k {
            0 => s.energy.kinetic,
            1 => s.energy.potential - lowest,
            _ => s.energy.lost,
        };
        let top: Vec<[f64; 2]> =
            history.samples.iter().zip(&base).map(|(s, base)| [s.time, base + part(s).max(0.0)]).collect();
        let next = top.iter().map(|p| p[1]).collect();
        chart.area(top, std::mem::replace(&mut base, next), theme.energy[k], number);
    }
    let label = if works { "their sum: what there was and what driven walls put in" } else { "their sum" };
    let number = key(chart, label, theme.ink, LINE);
    let sum: Vec<[f64; 2]> = history.samples.iter().zip(&base).map(|(s, sum)| [s.time, *sum]).collect();
    chart.line(sum, theme.ink, 1.6, false, number);
    let top = base.iter().copied().fold(0.0, f64::max);
    chart.y = Axis::between("energy (J)", 0.0, 1.08 * if top > 0.0 { top } else { 1.0 });
}

fn momentum(history: &History, theme: &Theme, chart: &mut Chart) {
    chart.subtitle = "momentum of all bodies".into();
    let mut all = vec![0.0];
    let alone = history.cast.is_isolated();
    for k in 0..history.cast.dim {
        let name = ["x", "y", "z"][k];
        let colour = theme.palette[[0, 1, 2][k]];
        let number = key(chart, &format!("p {name}"), colour, LINE);
        let line: Vec<[f64; 2]> = history.samples.iter().map(|s| [s.time, s.momentum[k]]).collect();
        all.extend(line.iter().map(|p| p[1]));
        chart.line(line, colour, 2.2, false, number);
        if !alone {
            let label = format!("p {name} less what walls and gravity gave");
            let number = key(chart, &label, colour, DASHED);
            let line: Vec<[f64; 2]> = history.samples.iter().map(|s| [s.time, s.momentum[k] - s.given[k]]).collect();
            all.extend(line.iter().map(|p| p[1]));
            chart.line(line, colour, 1.5, true, number);
        }
    }
    chart.y = Axis::holding("momentum (N s)", all);
}

fn speed(history: &History, theme: &Theme, chart: &mut Chart) {
    let speeds = &history.speeds;
    let (count, dim) = (speeds.len().max(1) as f64, history.cast.dim);
    let temperature = speeds.iter().map(|(v, m)| m * v * v).sum::<f64>() / (count * dim as f64);
    chart.subtitle = format!("speeds in the later half of the run; temperature {} J", short(temperature, 3));
    let fastest = speeds.iter().map(|s| s.0).fold(0.0, f64::max);
    let top = if fastest > 0.0 { 1.02 * fastest } else { 1.0 };
    // About as many bars as the cube root of the number asks for (Rice's rule), and no more than can be seen.
    let bars = (2.0 * libm::cbrt(count)).clamp(8.0, 60.0) as usize;
    let wide = top / bars as f64;
    let mut counts = vec![0u64; bars];
    for (v, _) in speeds.iter().filter(|s| s.0.is_finite()) {
        counts[((v / wide) as usize).min(bars - 1)] += 1;
    }
    let number = key(chart, "how often", theme.palette[5], Sort::Area);
    let mut tallest = 0.0f64;
    for (k, n) in counts.iter().enumerate() {
        let tall = *n as f64 / (count * wide);
        tallest = tallest.max(tall);
        let (a, b) = (k as f64 * wide, (k as f64 + 0.94) * wide);
        chart.area(vec![[a, tall], [b, tall]], vec![0.0; 2], theme.palette[5].mix(theme.floor, 0.25), number);
    }
    // Bodies of several masses: the curve of their mixture.
    let mut masses: BTreeMap<u64, u64> = BTreeMap::new();
    speeds.iter().for_each(|(_, m)| *masses.entry(m.to_bits()).or_default() += 1);
    if masses.len() <= 64 && temperature > 0.0 {
        let number = key(chart, "Maxwell, at this temperature", theme.flash, LINE);
        let curve = (0..=200).map(|k| {
            let v = top * f64::from(k) / 200.0;
            let sum: f64 =
                masses.iter().map(|(m, n)| *n as f64 * maxwell(dim, f64::from_bits(*m), temperature, v)).sum();
            [v, sum / count]
        });
        let curve: Vec<[f64; 2]> = curve.collect();
        tallest = curve.iter().map(|p| p[1]).fold(tallest, f64::max);
        chart.line(curve, theme.flash, 2.4, false, number);
    }
    chart.x = Axis::between("speed (m/s)", 0.0, top);
    chart.y = Axis::between("density (s/m)", 0.0, 1.08 * if tallest > 0.0 { tallest } else { 1.0 });
}

fn gaps(history: &History, theme: &Theme, chart: &mut Chart) {
    chart.subtitle = "the smallest gaps between surfaces".into();
    let radius = history.cast.actors.iter().map(|a| a.radius).fold(0.0, f64::max);
    let least = TOUCHING * if radius > 0.0 { radius } else { 1.0 };
    let mut most = 10.0 * least;
    for (name, colour, which) in [("of two bodies", theme.palette[0], 0), ("of a body and a wall", theme.palette[1], 1)]
    {
        let gap = |k: usize| if which == 0 { history.gaps[k].bodies } else { history.gaps[k].walls };
        if !(0..history.gaps.len()).any(|k| gap(k).is_finite()) {
            continue;
        }
        let number = key(chart, name, colour, LINE);
        let points = history.samples.iter().enumerate().take(history.gaps.len());
        let line: Vec<[f64; 2]> = points.map(|(k, s)| [s.time, gap(k).max(least)]).collect();
        most = line.iter().map(|p| p[1]).filter(|y| y.is_finite()).fold(most, f64::max);
        chart.line(line, colour, 1.8, false, number);
    }
    let power = |x: f64| 10f64.powi(libm::ceil(libm::log10(x) - 1e-9) as i32);
    chart.y = Axis { label: "gap (m)".into(), low: power(least) / 10.0, high: power(most), log: true };
}

fn paths(history: &History, theme: &Theme, chart: &mut Chart) {
    let cast = &history.cast;
    let bodies: Vec<usize> = cast.free().filter(|k| history.trace.paths.get(*k).is_some_and(|p| p.len() > 1)).collect();
    let shown = &bodies[..bodies.len().min(MOST_PATHS)];
    chart.subtitle = match bodies.len() {
        n if n > MOST_PATHS => format!("x of the first {MOST_PATHS} of {n} bodies"),
        _ => "x by time".into(),
    };
    let width = cast.extent.filter(|_| cast.periodic[0]).map(|(min, max)| max[0] - min[0]);
    let mut all = Vec::new();
    for (n, &k) in shown.iter().enumerate() {
        let colour = theme.palette[n % 8];
        let few = shown.len() <= 8;
        let number = if few { key(chart, &name(cast, k), colour, LINE) } else { n };
        let mut line: Vec<[f64; 2]> = Vec::new();
        for (time, place) in &history.trace.paths[k] {
            // Round a periodic box there is no line across it.
            if let (Some(last), Some(width)) = (line.last(), width)
                && (last[1] - place[0]).abs() > 0.5 * width
            {
                line.push([f64::NAN, f64::NAN]);
            }
            line.push([*time, place[0]]);
        }
        let r = cast.actors[k].radius;
        all.extend(line.iter().flat_map(|p| [p[1] - r, p[1] + r]));
        if cast.dim == 1 {
            let upper = line.iter().map(|p| [p[0], p[1] + r]).collect();
            let lower = line.iter().map(|p| p[1] - r).collect();
            chart.area(upper, lower, colour.opacity(0.35), number);
        }
        let width = if shown.len() > 20 { 1.1 } else { 1.8 };
        chart.line(line, colour.opacity(if few { 1.0 } else { 0.8 }), width, false, number);
    }
    let ends = cast.extent.map(|(min, max)| [min[0], max[0]]);
    all.extend(ends.into_iter().flatten().filter(|x| x.is_finite()));
    let tight = Axis::holding("x (m)", all.iter().copied());
    // Not from 0 where everything is elsewhere: places have no natural zero.
    let least = all.iter().copied().filter(|x| x.is_finite()).fold(f64::INFINITY, f64::min);
    chart.y = if least > 0.0 { Axis { low: least - 0.05 * (tight.high - least), ..tight } } else { tight };
}

fn name(cast: &crate::cast::Cast, k: usize) -> String {
    let actor = &cast.actors[k];
    match cast.groups.get(actor.group) {
        Some(group) if k >= cast.named => format!("{group}-{}", actor.label),
        _ => actor.label.clone(),
    }
}
