//! Problems, and anything else, as JSON.
use carom_scene::Problem;
use serde::Serialize;

#[derive(Serialize)]
struct Told<'a> {
    key: &'a str,
    message: &'a str,
    help: Option<&'a str>,
    line: Option<usize>,
    column: Option<usize>,
}

/// Problems as JSON.
pub(crate) fn tell(problems: &[Problem]) -> String {
    let told: Vec<Told<'_>> = problems
        .iter()
        .map(|p| Told { key: &p.key, message: &p.message, help: p.help.as_deref(), line: p.line(), column: p.column() })
        .collect();
    json(&told)
}

pub(crate) fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_else(|_| "null".into())
}
