//! `[sweep]`
use crate::fields::Fields;
use crate::model::{Sweep, Values};
use crate::node::{Node, Value};
use crate::path;
use crate::problem::Problem;

/// The most values of one path, and the most combinations of all: a table of that many rows is still a table.
pub(crate) const MOST_RUNS: u64 = 100_000_000;

/// The sweep, in the order of the file.
pub(super) fn read(fields: &Fields<'_>) -> Vec<Sweep> {
    let mut all = Vec::new();
    if let Some(node) = fields.get("sweep") {
        collect(fields, node, "", &mut all);
    }
    let runs = all.iter().fold(1u64, |n, s: &Sweep| n.saturating_mul(s.values.len() as u64));
    if runs > MOST_RUNS {
        fields.tell_key("sweep", format!("a sweep of {runs} runs is more than {MOST_RUNS}"), "fewer values");
    }
    all
}

/// Reads a table of paths. A path without quotes comes as tables inside tables, and is read as the path it was meant to be.
fn collect(fields: &Fields<'_>, node: &Node, before: &str, all: &mut Vec<Sweep>) {
    let tell = |span, key: &str, message: String, help: &str| {
        fields.reader.tell(span, Problem::new(format!("sweep.{}", path::quote(key)), message).help(help));
    };
    let Value::Table(entries) = &node.value else {
        tell(
            node.span,
            before,
            format!("a sweep must be a table of paths, got {}", node.kind()),
            "\"run.seed\" = [1, 2]",
        );
        return;
    };
    for entry in entries {
        let key = if before.is_empty() { entry.key.clone() } else { format!("{before}.{}", path::quote(&entry.key)) };
        // A table of values has a range or steps; any other is a path in pieces.
        let is_values = ["range", "steps"].iter().any(|k| entry.node.get(k).is_some());
        let inner = matches!(&entry.node.value, Value::Table(_)) && !is_values;
        let legal = path::parse(&key).map_err(|e| e.1).and_then(|steps| path::legal(&steps));
        if let Err(message) = legal {
            tell(entry.key_span, &key, message, "a sweep's key is the dotted path of a key, as in \"body.A.mass\"");
            continue;
        }
        if inner {
            collect(fields, &entry.node, &key, all);
        } else if all.iter().any(|s| s.path == key) {
            tell(entry.key_span, &key, format!("`{key}` comes twice"), "keep one of them");
        } else if let Some(values) = values(&entry.node, &|span, message, help| tell(span, &key, message, help)) {
            all.push(Sweep { path: key, values });
        }
    }
}

fn values(node: &Node, tell: &dyn Fn(crate::node::Span, String, &str)) -> Option<Values> {
    let help = "a list, as in [1.0, 0.9], or { range = [1, 8] } (integers), or { range = [0, 1], steps = 11 }";
    let wrong = |node: &Node, message: String| {
        tell(node.span, message, help);
        None
    };
    match &node.value {
        Value::List(items) if items.is_empty() => wrong(node, "a sweep needs at least one value".to_owned()),
        Value::List(items) => match items.iter().find(|i| matches!(i.value, Value::Null | Value::Date)) {
            Some(item) => wrong(item, format!("{} is no value of a sweep", item.kind())),
            None => Some(Values::List(items.iter().map(Node::data).collect())),
        },
        Value::Table(entries) => {
            if let Some(entry) = entries.iter().find(|e| e.key != "range" && e.key != "steps") {
                let message = format!(
                    "unknown key `{}`{}",
                    entry.key,
                    crate::nearest::suggestion(&entry.key, ["range", "steps"])
                );
                tell(entry.key_span, message, help);
                return None;
            }
            let Some(range) = node.get("range") else { return wrong(node, "`range` is missing".to_owned()) };
            let ends = match &range.value {
                Value::List(ends) if ends.len() == 2 => ends,
                _ => return wrong(range, "range expects 2 numbers: [first, last]".to_owned()),
            };
            if let Some(steps) = node.get("steps") {
                let (Some(from), Some(to)) = (ends[0].number(), ends[1].number()) else {
                    return wrong(range, "range expects 2 numbers: [first, last]".to_owned());
                };
                if !from.is_finite() || !to.is_finite() || !(to - from).is_finite() {
                    return wrong(range, "range must be finite".to_owned());
                }
                return match steps.integer().and_then(|n| u64::try_from(n).ok()) {
                    Some(n) if (2..=MOST_RUNS).contains(&n) => Some(Values::Steps(from, to, n as usize)),
                    _ => wrong(steps, format!("steps must be an integer in [2, {MOST_RUNS}]")),
                };
            }
            let whole = |n: &Node| n.integer().and_then(|k| i64::try_from(k).ok());
            let (Some(from), Some(to)) = (whole(&ends[0]), whole(&ends[1])) else {
                return wrong(range, "range without steps expects 2 integers: [first, last]".to_owned());
            };
            if from > to {
                return wrong(range, format!("range must rise, got [{from}, {to}]"));
            }
            if i128::from(to) - i128::from(from) >= i128::from(MOST_RUNS) {
                return wrong(range, format!("range holds more than {MOST_RUNS} integers"));
            }
            Some(Values::Range(from, to))
        }
        _ => wrong(node, format!("a sweep expects a list of values, got {}", node.kind())),
    }
}
