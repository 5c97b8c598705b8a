//! The same experiments on Carom and on engines made for games, the same numbers side by side.
//!
//! `carom-compare [FOLDER [EXPERIMENT]...]` writes `results.md` and `results.json` into the folder (the present one).
mod box2d;
mod box3d;
mod carom_world;
mod clock;
mod engine;
mod experiment;
mod machine;
mod rapier;
mod scene;
mod table;

use std::process::ExitCode;

use engine::ENGINES;
use experiment::{Cell, Column, Make, bullet, cradle, drop, gas, pair, rack};
use table::{Row, Table};

type Experiment = (&'static str, &'static str, &'static str, &'static [Column], fn(usize, Make<'_>) -> Vec<Cell>);

const EXPERIMENTS: &[Experiment] = &[
    ("drop", drop::TITLE, drop::WHAT, drop::COLUMNS, drop::row),
    ("pair", pair::TITLE, pair::WHAT, pair::COLUMNS, pair::row),
    ("cradle", cradle::TITLE, cradle::WHAT, cradle::COLUMNS, cradle::row),
    ("bullet", bullet::TITLE, bullet::WHAT, bullet::COLUMNS, bullet::row),
    ("rack", rack::TITLE, rack::WHAT, rack::COLUMNS, rack::row),
    ("gas", gas::TITLE, gas::WHAT, gas::COLUMNS, gas::row),
];

const HEAD: &str = "# Results

Written by `compare/run`; do not edit. What is compared and what it means: [the chapter of the guide](../guide/comparison.md).

Carom answers one question, with what velocities bodies part, and knows balls and walls only. The other engines are made for games: bodies of
any shape, joints and stacks within a fixed time a frame, where an answer that looks right is right. The tables are about Carom's question.
";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let folder = std::path::PathBuf::from(arguments.next().unwrap_or_else(|| ".".into()));
    let wanted: Vec<String> = arguments.collect();
    if let Some(unknown) = wanted.iter().find(|name| !EXPERIMENTS.iter().any(|e| e.0 == name.as_str())) {
        let names: Vec<&str> = EXPERIMENTS.iter().map(|e| e.0).collect();
        eprintln!("error: there is no experiment `{unknown}`; there are {}", names.join(", "));
        return ExitCode::from(2);
    }
    let mut tables = Vec::new();
    for &(name, title, what, columns, row) in EXPERIMENTS {
        if !wanted.is_empty() && !wanted.iter().any(|w| w == name) {
            continue;
        }
        let mut rows = Vec::new();
        for dim in [2, 3] {
            for kind in ENGINES.iter().filter(|k| k.dims.contains(&dim)) {
                for &(settings, called) in kind.settings {
                    eprintln!("{name}, {} ({called}) in {dim}D", kind.name);
                    let cells = row(dim, &|scene| (kind.make)(scene, settings));
                    rows.push(Row { dim, engine: kind.name, settings: called, cells });
                }
            }
        }
        tables.push(Table { name, title, what, columns, rows });
    }
    let mut text = String::from(HEAD);
    text += &machine::markdown();
    for table in &tables {
        text += "\n";
        text += &table.markdown();
    }
    let json = serde_json::json!({ "machine": machine::json(), "experiments": tables.iter().map(Table::json).collect::<Vec<_>>() });
    print!("{text}");
    let written = std::fs::write(folder.join("results.md"), &text)
        .and_then(|()| std::fs::write(folder.join("results.json"), format!("{json:#}\n")));
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}: {error}", folder.display());
            ExitCode::FAILURE
        }
    }
}
