//! What an impact costs, as `carom bench` says it: every plain gas and every variant at 1,000 balls, and the sizes of one of each kind.
//!
//! ```text
//! cargo bench -p carom
//! cargo bench -p carom -- spheres-0.49 100000
//! ```
use carom_bench::{Effort, Workload, measure};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    // `cargo test --benches` builds this and runs it without the flag: that it builds is all that is asked then.
    if !words.iter().any(|word| word == "--bench") {
        return;
    }
    let words: Vec<&String> = words.iter().filter(|word| !word.starts_with("--")).collect();
    let rows: Vec<(Workload, usize)> = match words[..] {
        [] => Workload::all().map(|w| (w, 1_000)).chain(sizes("spheres-0.49")).chain(sizes("discs-0.30")).collect(),
        [name, ref n @ ..] => {
            let workload = Workload::named(name).unwrap_or_else(|| panic!("no workload is called `{name}`"));
            let n = n.first().map_or(1_000, |n| n.parse().unwrap_or_else(|_| panic!("`{n}` is not a whole number")));
            vec![(workload, n)]
        }
    };
    println!(
        "{:<22} {:>9} {:>8} {:>10} {:>10} {:>8} {:>9} {:>8}",
        "workload", "balls", "ns", "yardstick", "yardsticks", "B/ball", "drift", "Z"
    );
    for (workload, n) in rows {
        match measure(&workload, n, Effort { seconds: 2.0, ..Effort::default() }) {
            Ok(row) => println!(
                "{:<22} {:>9} {:>8.0} {:>10.0} {:>10.3} {:>8.0} {:>9.0e} {:>8}",
                row.name,
                row.n,
                row.ns_per_impact,
                row.yardstick_ns,
                row.yardsticks,
                row.bytes_per_ball,
                row.energy_drift,
                row.z.map_or_else(|| "-".to_string(), |z| format!("{z:.3}")),
            ),
            Err(why) => println!("{:<22} {n:>9} {why}", workload.name()),
        }
    }
}

fn sizes(name: &str) -> impl Iterator<Item = (Workload, usize)> {
    Workload::named(name).into_iter().flat_map(|w| [10_000, 100_000].map(|n| (w, n)))
}
