//! A chart in characters.
use crate::canvas::{Canvas, DOWN};
use carom_draw::plot::{Axis, Chart, Layer, Sort};

/// The chart's size in characters, and the room for the numbers beside it.
const COLUMNS: usize = 66;
const ROWS: usize = 18;
const GUTTER: usize = 11;

/// The chart, its axes and its key.
pub fn text(chart: &Chart, colour: bool) -> String {
    let mut canvas = Canvas::new(COLUMNS, ROWS);
    let [width, height] = canvas.size().map(|n| n as f64);
    let on =
        |p: [f64; 2]| [chart.x.part(p[0]) * (width - 1.0) + 0.5, (1.0 - chart.y.part(p[1])) * (height - 1.0) + 0.5];
    let areas: Vec<usize> = keys_of(chart, |layer| layer.sort == Sort::Area);
    for layer in &chart.layers {
        match layer.sort {
            // Bands of a diagram of space and time are their middle lines.
            Sort::Area if chart.layers.iter().any(|l| l.sort != Sort::Area && l.key == layer.key) => {}
            Sort::Area => {
                let pattern = areas.iter().position(|k| *k == layer.key).unwrap_or(0);
                fill(&mut canvas, layer, chart, pattern, areas.len());
            }
            Sort::Line { dashed } => {
                for (k, pair) in layer.points.windows(2).enumerate() {
                    if !dashed || k / 12 % 2 == 0 {
                        canvas.line(on(pair[0]), on(pair[1]));
                    }
                }
            }
        }
    }
    let title = if colour { format!("\x1b[1m{}\x1b[0m", chart.title) } else { chart.title.clone() };
    let mut out = format!("{title}  {}\n\n", chart.subtitle);
    out += &format!("{:>GUTTER$}\n", chart.y.label);
    let labels = labels(&chart.y);
    for (row, line) in canvas.lines().iter().enumerate() {
        let label = labels.iter().find(|l| l.0 == row).map_or("", |l| &l.1);
        let tick = if label.is_empty() { '│' } else { '┤' };
        out += &format!("{label:>0$} {tick}{line}\n", GUTTER - 2);
    }
    out += &format!("{:>1$}└{2}\n", "", GUTTER - 1, "─".repeat(COLUMNS));
    // The labels under their ticks, as far as they do not run into each other.
    let mut below = vec![' '; GUTTER + COLUMNS + 12];
    let mut free = 0;
    for (x, label) in chart.x.ticks(6) {
        let at = GUTTER + (chart.x.part(x) * (COLUMNS as f64 - 1.0)).round().max(0.0) as usize;
        let from = at.saturating_sub(label.chars().count() / 2);
        if from >= free && from + label.chars().count() < below.len() {
            label.chars().enumerate().for_each(|(k, c)| below[from + k] = c);
            free = from + label.chars().count() + 2;
        }
    }
    out += &format!("{}  {}\n", below.into_iter().collect::<String>().trim_end(), chart.x.label);
    for (k, key) in chart.keys.iter().enumerate() {
        let sign = match (key.sort, areas.iter().position(|a| *a == k)) {
            (Sort::Area, Some(0)) if areas.len() > 1 => "⣿⣿",
            (Sort::Area, Some(n)) if n + 1 == areas.len() && n > 1 => "⠁⠁",
            (Sort::Area, _) => "⢕⢕",
            (Sort::Line { dashed: true }, _) => "╌╌",
            _ => "──",
        };
        out += &format!("{:>1$}{sign} {2}\n", "", GUTTER, key.label);
    }
    out
}

/// The keys of layers of a kind, in their order.
fn keys_of(chart: &Chart, wanted: impl Fn(&Layer) -> bool) -> Vec<usize> {
    let mut keys: Vec<usize> = chart.layers.iter().filter(|l| wanted(l)).map(|l| l.key).collect();
    keys.dedup();
    keys
}

/// The rows and labels of an axis.
fn labels(axis: &Axis) -> Vec<(usize, String)> {
    let row = |y: f64| ((1.0 - axis.part(y)) * (ROWS as f64 - 1.0)).round().max(0.0) as usize;
    axis.ticks(5).into_iter().map(|(y, label)| (row(y), label)).collect()
}

/// Fills an area: solid, half or thin.
fn fill(canvas: &mut Canvas, layer: &Layer, chart: &Chart, pattern: usize, patterns: usize) {
    let [width, height] = canvas.size();
    for x in 0..width {
        // The edges over this column of dots.
        let at = chart.x.low + (x as f64 + 0.5) / width as f64 * (chart.x.high - chart.x.low);
        let after = layer.points.partition_point(|p| p[0] < at);
        let (Some(b), Some(a)) = (layer.points.get(after), after.checked_sub(1).and_then(|k| layer.points.get(k)))
        else {
            continue;
        };
        let part = if b[0] > a[0] { (at - a[0]) / (b[0] - a[0]) } else { 1.0 };
        let base = layer.base[after - 1] + part * (layer.base[after] - layer.base[after - 1]);
        let dot = |y: f64| ((1.0 - chart.y.part(y)) * height as f64).round().clamp(0.0, height as f64) as usize;
        for y in dot(a[1] + part * (b[1] - a[1]))..dot(base) {
            let set = match pattern {
                0 if patterns > 1 => true,
                n if n > 1 && n + 1 == patterns => y % DOWN == 0 && x % 2 == 0,
                _ => (x + y) % 2 == 0,
            };
            if set {
                canvas.dot(x as f64 + 0.5, y as f64 + 0.5);
            }
        }
    }
}
