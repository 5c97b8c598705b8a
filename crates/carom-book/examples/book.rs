//! The book without the command line: what fails, and how many there are. `tools/mutations` runs it, for it builds quickly.
//!
//! `cargo run --release -p carom-book --example book [NAME]`
use std::process::ExitCode;

fn main() -> ExitCode {
    let name = std::env::args().nth(1);
    let book = match carom_book::Book::open() {
        Ok(book) => book,
        Err(e) => {
            eprintln!("error: {e}");
            return ExitCode::from(2);
        }
    };
    let chosen = match book.choose(name.as_deref(), false) {
        Ok(chosen) => chosen,
        Err(e) => {
            eprintln!("error: {e}");
            return ExitCode::from(2);
        }
    };
    let rows: Vec<carom_book::Row> = chosen.iter().flat_map(carom_book::Chosen::run).collect();
    let failed: Vec<&carom_book::Row> = rows.iter().filter(|row| !row.pass).collect();
    for row in &failed {
        println!("FAILED {}: expected {}, got {}, tolerance {}", row.name, row.expected, row.got, row.tolerance);
    }
    println!("{} of {} numbers of {} cases failed", failed.len(), rows.len(), chosen.len());
    ExitCode::from(u8::from(!failed.is_empty()))
}
