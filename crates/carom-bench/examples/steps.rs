//! So many impacts of a gas, for a profiler: `steps NAME N IMPACTS` builds the gas, warms it up and runs. Only
//! `carom_bench::gas::Gas::steps` is what a profile should count (`tools/instructions` does). With more than 0 SLICES behind it prints
//! the best slice in ns of CPU time an impact (of wall time with THREADS above 1), and the yardstick in turns with it.
use carom::{Rotates, Vector};
use carom_bench::{Gas, Workload, Yardstick, seconds};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [name, n, impacts, slices @ ..] = &words[..] else {
        eprintln!("usage: steps NAME N IMPACTS [SLICES]");
        std::process::exit(2);
    };
    let number = |word: &String| word.parse::<usize>().unwrap_or_else(|_| panic!("`{word}` is not a whole number"));
    let workload = Workload::named(name).unwrap_or_else(|| panic!("no workload is called `{name}`"));
    let (n, impacts, slices) = (number(n), number(impacts), slices.first().map_or(0, number));
    match workload.dim {
        2 => run::<2>(&workload, n, impacts as u64, slices),
        _ => run::<3>(&workload, n, impacts as u64, slices),
    }
}

fn run<const D: usize>(workload: &Workload, n: usize, impacts: u64, slices: usize)
where
    Vector<D>: Rotates,
{
    let threads = std::env::var("THREADS").ok().and_then(|threads| threads.parse().ok()).unwrap_or(1);
    let mut gas = Gas::<D>::with_threads(workload, n, threads).unwrap_or_else(|why| panic!("{why}"));
    if let Ok(margin) = std::env::var("LISTS") {
        gas.world.set_lists(margin.parse().ok());
    }
    if let Some(scale) = std::env::var("CELLS").ok().and_then(|scale| scale.parse().ok()) {
        gas.world.set_cell_scale(scale);
    }
    if slices == 0 {
        println!("{} {}", gas.steps(impacts), gas.world.digest());
        return;
    }
    let mut yardstick = Yardstick::new(gas.count);
    let (mut best, mut stick) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..slices {
        let start = seconds(threads);
        let done = gas.steps(impacts);
        best = best.min((seconds(threads) - start) * 1e9 / done as f64);
        stick = stick.min(yardstick.slice(30_000));
    }
    println!(
        "{:<22} {:>8} {best:7.0} ns  yardstick {stick:6.0} ns  {:.3} yardsticks  {:4.0} B/ball  set-up {:.2} s  {:016x}",
        workload.name(),
        gas.count,
        best / stick,
        gas.world.bytes() as f64 / gas.count as f64,
        gas.set_up,
        gas.world.digest(),
    );
}
