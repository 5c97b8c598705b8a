//! How an impact's time and a ball's memory grow with the number of balls: measures, and draws what it measured.
//!
//! ```text
//! cargo run --release -p carom-bench --example growth -- guide/growth.csv guide/growth.svg 1000 10000 100000 1000000 \
//!   spheres-0.49=4000000 discs-0.70=4000000
//! cargo run --release -p carom-bench --example growth -- guide/growth.csv guide/growth.svg       (only draws)
//! ```
use carom_bench::{Effort, NAMES, Workload, measure};
use std::fmt::Write;

/// A line of the table.
struct Point {
    name: String,
    n: f64,
    ns: f64,
    yardsticks: f64,
    bytes: f64,
}

/// A title, what is drawn, and the least range of its axis.
type Panel = (&'static str, fn(&Point) -> f64, [f64; 2]);

const COLOURS: [&str; 5] = ["#0072b2", "#56b4e9", "#009e73", "#e69f00", "#d55e00"];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [table, picture, sizes @ ..] = &words[..] else {
        eprintln!("usage: growth TABLE.csv PICTURE.svg [N | NAME=N]...");
        std::process::exit(2);
    };
    if !sizes.is_empty() {
        let mut text = String::from(
            "workload,balls,ns_per_impact,yardstick_ns,yardsticks,bytes_per_ball,set_up_s,energy_drift,z\n",
        );
        for word in sizes {
            // One gas, or all of them.
            let (only, n) = word.split_once('=').map_or((None, word.as_str()), |(name, n)| (Some(name), n));
            let n = n.parse().unwrap_or_else(|_| panic!("`{n}` is not a whole number"));
            for workload in NAMES.iter().filter(|n| only.is_none_or(|o| o == n.0)).filter_map(|n| Workload::named(n.0))
            {
                let row = measure(&workload, n, Effort { seconds: 3.0, slices: 12, threads: 1 })
                    .unwrap_or_else(|why| panic!("{why}"));
                let z = row.z.unwrap_or(f64::NAN);
                let line = format!(
                    "{},{},{:.1},{:.1},{:.4},{:.1},{:.3},{:.2e},{z:.4}",
                    row.name,
                    row.n,
                    row.ns_per_impact,
                    row.yardstick_ns,
                    row.yardsticks,
                    row.bytes_per_ball,
                    row.set_up,
                    row.energy_drift
                );
                println!("{line}");
                let _ = writeln!(text, "{line}");
            }
        }
        std::fs::write(table, text).unwrap_or_else(|why| panic!("{table}: {why}"));
    }
    let text = std::fs::read_to_string(table).unwrap_or_else(|why| panic!("{table}: {why}"));
    let points: Vec<Point> = text.lines().skip(1).filter_map(read).collect();
    std::fs::write(picture, draw(&points)).unwrap_or_else(|why| panic!("{picture}: {why}"));
}

fn read(line: &str) -> Option<Point> {
    let words: Vec<&str> = line.split(',').collect();
    let number = |k: usize| words.get(k)?.parse::<f64>().ok();
    Some(Point { name: words[0].to_string(), n: number(1)?, ns: number(2)?, yardsticks: number(4)?, bytes: number(5)? })
}

/// Three panels over the number of balls: ns an impact, yardsticks an impact, bytes a ball.
fn draw(points: &[Point]) -> String {
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 900 340\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"900\" height=\"340\" fill=\"white\"/>\n",
    );
    let panels: [Panel; 3] = [
        ("ns an impact", |p| p.ns, [500.0, 10_000.0]),
        ("yardsticks an impact", |p| p.yardsticks, [0.5, 5.0]),
        ("bytes a ball", |p| p.bytes, [200.0, 1_000.0]),
    ];
    let most = points.iter().map(|p| p.n).fold(1e6, f64::max) * 1.3;
    for (k, (title, of, [low, high])) in panels.into_iter().enumerate() {
        let (left, right, top, bottom) = (k as f64 * 300.0 + 50.0, k as f64 * 300.0 + 290.0, 40.0, 260.0);
        let (low, high) = points.iter().map(of).fold((low, high), |(l, h), y| (l.min(y * 0.9), h.max(y * 1.1)));
        let along = |n: f64| left + (right - left) * (n / 800.0).ln() / (most / 800.0).ln();
        let up = |y: f64| bottom - (bottom - top) * (y / low).ln() / (high / low).ln();
        let _ = writeln!(svg, "<text x=\"{left}\" y=\"24\" font-weight=\"bold\">{title}</text>");
        for n in [1e3, 1e4, 1e5, 1e6] {
            let (x, label) = (along(n), n.log10());
            let _ = writeln!(svg, "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"#e4e4e4\"/>");
            let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"276\" text-anchor=\"middle\">1e{label}</text>");
        }
        let mut decade = 10f64.powi(low.log10().floor() as i32);
        while decade < high {
            for y in [1.0, 2.0, 5.0].map(|m| m * decade).into_iter().filter(|&y| y >= low && y <= high) {
                let at = up(y);
                let _ = writeln!(svg, "<path d=\"M{left} {at:.1}H{right}\" stroke=\"#e4e4e4\"/>");
                let (x, line) = (left - 5.0, at + 4.0);
                let _ = writeln!(svg, "<text x=\"{x}\" y=\"{line:.1}\" text-anchor=\"end\">{y}</text>");
            }
            decade *= 10.0;
        }
        for ((name, ..), colour) in NAMES.iter().zip(COLOURS) {
            let mut path = String::new();
            for p in points.iter().filter(|p| p.name == *name) {
                let (x, y) = (along(p.n), up(of(p)));
                let _ = write!(path, "{}{x:.1} {y:.1}", if path.is_empty() { "M" } else { "L" });
                let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>");
            }
            let _ = writeln!(svg, "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.5\"/>");
        }
    }
    for (k, ((name, ..), colour)) in NAMES.iter().zip(COLOURS).enumerate() {
        let x = 60.0 + 165.0 * k as f64;
        let _ = writeln!(svg, "<rect x=\"{x}\" y=\"306\" width=\"14\" height=\"4\" fill=\"{colour}\"/>");
        let at = x + 20.0;
        let _ = writeln!(svg, "<text x=\"{at}\" y=\"312\">{name}</text>");
    }
    svg.push_str(
        "<text x=\"450\" y=\"332\" text-anchor=\"middle\">over the number of balls; logarithmic axes</text>\n</svg>\n",
    );
    svg
}
