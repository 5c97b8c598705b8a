//! Every key of a scene as a page of Markdown, printed from the table of keys.
use std::fmt::Write;

use crate::keys::{Kind, Rule, SCENE, Shape};

const HEAD: &str = "# Scene reference

Every key of a scene file, version 1. This page is printed by the program, from the same table by which it reads scenes:
`carom schema --format markdown`; `carom schema` prints the JSON Schema for editors.

A scene is TOML, or the same as JSON. SI units: m, kg, s, rad (degrees only in `arc`). A vector is a list of `dim` numbers. Numbers are finite,
integers are numbers. An unknown key is an error that names the nearest known one. `carom check SCENE` tells whether a scene
is valid and what would run, `carom check SCENE --expand` prints it with every default filled in.
";

/// The keys of a scene, as a page of Markdown.
pub fn reference() -> String {
    let mut page = String::from(HEAD);
    table(&mut page, "The file", &SCENE);
    let mut waiting: Vec<(String, &'static Shape)> = below("", &SCENE);
    while !waiting.is_empty() {
        let (path, shape) = waiting.remove(0);
        table(&mut page, &format!("`{path}`"), shape);
        waiting.splice(0..0, below(path.trim_matches(['[', ']']), shape));
    }
    page
}

/// The tables in a table, by the names they have in a file.
fn below(path: &str, shape: &'static Shape) -> Vec<(String, &'static Shape)> {
    let inside = |name: &str| if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
    shape
        .keys
        .iter()
        .filter_map(|key| match key.kind {
            Kind::Table(shape) => Some((format!("[{}]", inside(key.name)), shape)),
            Kind::List(shape) => Some((format!("[[{}]]", inside(key.name)), shape)),
            Kind::Named(shape) => Some((format!("[{}.NAME]", inside(key.name)), shape)),
            _ => None,
        })
        .collect()
}

fn table(page: &mut String, title: &str, shape: &Shape) {
    let _ = write!(page, "\n## {title}\n\n{}\n\n| key | holds | |\n|---|---|---|\n", shape.about);
    for key in shape.keys {
        let name = if key.required { format!("**`{}`**", key.name) } else { format!("`{}`", key.name) };
        let _ = writeln!(page, "| {name} | {} | {} |", holds(&key.kind), key.about.replace('|', "\\|"));
    }
    if shape.keys.iter().any(|k| k.required) {
        page.push_str("\nIn bold: needed.\n");
    }
}

fn holds(kind: &Kind) -> String {
    match kind {
        Kind::Number(rule) => number(*rule),
        Kind::Coefficient(rule) => format!("{}; or `{{ curve = [[speed, value], ...] }}`", number(*rule)),
        Kind::Integer { least, most } => match (*least, *most) {
            (1, 1) => "1".into(),
            (least, most) if most < 1_000_000 => format!("an integer, {least} to {most}"),
            (least, _) => format!("an integer, {least} or more"),
        },
        Kind::Text => "text".into(),
        Kind::Flag => "true or false".into(),
        Kind::Choice(names) => names.iter().map(|n| format!("`\"{n}\"`")).collect::<Vec<_>>().join(", "),
        Kind::Vector => "a vector".into(),
        Kind::Spin => "0, 1 or 3 numbers".into(),
        Kind::Axes => "a list of axes".into(),
        Kind::TwoNames => "two names".into(),
        Kind::Table(_) => "a table: below".into(),
        Kind::List(_) => "a list of tables: below".into(),
        Kind::Named(_) => "tables with names: below".into(),
        Kind::Sweep => "paths with values".into(),
    }
}

fn number(rule: Rule) -> String {
    match rule {
        Rule::Finite => "a number".into(),
        Rule::Positive => "a number > 0".into(),
        Rule::NotNegative => "a number >= 0".into(),
        Rule::Within(low, high) => format!("a number, {low} to {high}"),
    }
}
