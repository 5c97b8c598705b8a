//! The book without the command line: what fails, and how many there are. `tools/mutations` runs it, for it builds quickly.
//!
//! `cargo run --release -p carom-book --example book [NAME]...`
use std::process::ExitCode;

fn main() -> ExitCode {
    let book = match carom_book::Book::open() {
        Ok(book) => book,
        Err(e) => {
            eprintln!("error: {e}");
            return ExitCode::from(2);
        }
    };
    let names: Vec<String> = std::env::args().skip(1).collect();
    let wanted = if names.is_empty() { vec![None] } else { names.iter().map(|n| Some(n.as_str())).collect() };
    let mut chosen = Vec::new();
    for name in wanted {
        match book.choose(name, false) {
            Ok(more) => chosen.extend(more),
            Err(e) => {
                eprintln!("error: {e}");
                return ExitCode::from(2);
            }
        }
    }
    let rows: Vec<carom_book::Row> = carom_book::run(&chosen).into_iter().flatten().collect();
    let failed: Vec<&carom_book::Row> = rows.iter().filter(|row| !row.pass).collect();
    for row in &failed {
        println!("FAILED {}: expected {}, got {}, tolerance {}", row.name, row.expected, row.got, row.tolerance);
    }
    println!("{} of {} numbers of {} cases failed", failed.len(), rows.len(), chosen.len());
    ExitCode::from(u8::from(!failed.is_empty()))
}
