//! `carom bench`: what an impact costs on this machine.
use crate::figures::{count, digits};
use crate::table::Table;
use crate::trouble::{Trouble, colour, say};
use carom_bench::{Effort, NAMES, Row, Workload, measure};
use clap::{Args, ValueEnum};
use serde_json::json;
use std::io::stdout;

const AFTER: &str = "\
Gases in equilibrium at a fraction of the box: spheres-0.10, spheres-0.30, spheres-0.49,
discs-0.30, discs-0.70; with -poly radii 1 : 1.4 and masses 1 : 100, with -e09 a restitution of
0.9, with -gravity gravity and walls, with -rough perfectly rough surfaces. A yardstick is a plain prediction of 2 x 16 neighbours,
measured in turns with the engine: the ratio means the same on every machine. Times are CPU time
of one thread, the best of several slices; reports are not kept. Z is the measured
compressibility factor p V / (N kT), beside the equation of state's.

Examples:
  carom bench
  carom bench --name spheres-0.49 --n 100000
  carom bench --name spheres-0.49 --n 1000000 --threads 2
  carom bench --name discs-0.70 --format json";

/// Measure what an impact costs on this machine
#[derive(Args)]
#[command(after_help = AFTER)]
pub struct Bench {
    /// One workload; without it, all of the plain ones
    #[arg(long)]
    name: Option<String>,
    /// The number of balls; without it, 1,000 and 10,000
    #[arg(long, value_parser = clap::value_parser!(u64).range(8..=8_000_000))]
    n: Option<u64>,
    /// Threads that work on a world; with more than one, times are wall times
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: u16,
    /// How to print what was found
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// for people
    Text,
    /// for programs: an array
    Json,
}

impl Bench {
    pub fn run(self) -> Result<(), Trouble> {
        let workloads = match &self.name {
            Some(name) => vec![Workload::named(name).ok_or_else(|| unknown(name))?],
            None => NAMES.iter().filter_map(|n| Workload::named(n.0)).collect(),
        };
        let sizes = self.n.map_or_else(|| vec![1_000, 10_000], |n| vec![n as usize]);
        // All of them take half a minute; one takes what it needs to be sure.
        let effort = match (workloads.len(), sizes.len()) {
            (1, 1) => Effort { threads: self.threads.into(), ..Effort::default() },
            _ => Effort { seconds: 2.0, threads: self.threads.into(), ..Effort::default() },
        };
        let mut rows = Vec::new();
        for workload in &workloads {
            for &n in &sizes {
                rows.push(measure(workload, n, effort).map_err(Trouble::usage)?);
            }
        }
        let text = match self.format {
            Format::Text => table(&rows),
            Format::Json => {
                let rows: Vec<_> = rows.iter().map(object).collect();
                format!("{:#}\n", json!(rows))
            }
        };
        say(&mut stdout().lock(), &text)
    }
}

fn unknown(name: &str) -> Trouble {
    let all: Vec<String> = Workload::all().map(|w| w.name()).collect();
    Trouble::usage(format!("no workload is called `{name}`; there are {}", all.join(", ")))
}

fn object(row: &Row) -> serde_json::Value {
    json!({
        "name": row.name,
        "n": row.n,
        "ns_per_impact": row.ns_per_impact,
        "yardstick_ns": row.yardstick_ns,
        "yardsticks": row.yardsticks,
        "bytes_per_ball": row.bytes_per_ball,
        "energy_drift": row.energy_drift,
        "z": row.z,
    })
}

fn table(rows: &[Row]) -> String {
    let head = ["workload", "balls", "ns an impact", "yardsticks", "bytes a ball", "energy drift", "Z", "expected"];
    let mut table = Table::new("lrrrrrrr", head);
    for row in rows {
        let number = |z: Option<f64>| z.map_or_else(|| "-".to_string(), |z| digits(z, 4));
        table.row([
            row.name.clone(),
            count(row.n as u64),
            format!("{:.0}", row.ns_per_impact),
            format!("{:.2}", row.yardsticks),
            format!("{:.0}", row.bytes_per_ball),
            format!("{:.0e}", row.energy_drift),
            number(row.z),
            number(row.expected_z),
        ]);
    }
    table.text(colour())
}
