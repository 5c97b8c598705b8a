//! The tree of a TOML text, with the place of every value. The grammar is the `toml` crate's.
use ::toml::Spanned;
use ::toml::de::{DeTable, DeValue};

use crate::json::DEEPEST;
use crate::keys::{Kind, SCENE, Shape};
use crate::node::{Entry, Node, Source, Span, Value};
use crate::problem::Problem;

/// How many parts a dotted key may have: the longest of a scene has four.
const LONGEST_KEY: usize = 16;

/// The tree of a TOML document.
pub(crate) fn parse(sources: &[Source], source: usize) -> Result<Node, Problem> {
    let text = sources[source].text.as_str();
    let tell = |start, end, problem| Span { source, start, end }.tell(sources, problem);
    if let Some((at, message)) = too_deep(text) {
        return Err(tell(at, at + 1, Problem::new("", message).help("a scene needs no more than six")));
    }
    match DeTable::parse(text) {
        Ok(table) => {
            let entries = entries(table.into_inner(), source);
            Ok(Node { value: Value::Table(entries), span: Span { source, start: 0, end: 0 } })
        }
        Err(error) => Err(syntax(&error, text, 0, source, sources)),
    }
}

/// The value that stands in `text` from `start` to its end, as in `--set path=value`.
pub(crate) fn parse_value(sources: &[Source], source: usize, start: usize) -> Result<Node, Problem> {
    let text = &sources[source].text[start..];
    if let Some((at, message)) = too_deep(text) {
        let span = Span { source, start: start + at, end: start + at + 1 };
        return Err(span.tell(sources, Problem::new("", message)));
    }
    match DeValue::parse(text) {
        Ok(value) => {
            let mut node = node(value, source);
            shift(&mut node, start);
            Ok(node)
        }
        Err(error) => Err(syntax(&error, text, start, source, sources)),
    }
}

fn shift(node: &mut Node, by: usize) {
    let moved = |span: &mut Span| {
        span.start += by;
        span.end += by;
    };
    moved(&mut node.span);
    match &mut node.value {
        Value::List(nodes) => nodes.iter_mut().for_each(|n| shift(n, by)),
        Value::Table(entries) => entries.iter_mut().for_each(|e| {
            moved(&mut e.key_span);
            shift(&mut e.node, by);
        }),
        _ => {}
    }
}

fn syntax(error: &::toml::de::Error, text: &str, start: usize, source: usize, sources: &[Source]) -> Problem {
    let at = error.span().unwrap_or(text.len()..text.len());
    // An end that is missing is told at the last line that says something, not on the blank one after it.
    let said = text.trim_end().len();
    let at = if at.start >= said { said..said } else { at };
    let mut message = format!("not valid TOML: {}", error.message().trim_end().replace('\n', "; "));
    if error.message().contains("duplicate key") {
        let key = text.get(at.clone()).unwrap_or_default();
        message = format!("not valid TOML: the key `{key}` comes twice in one table");
    }
    // The crate takes what is not there for text without quotes.
    if error.message().contains("must be quoted") && text.get(at.clone()).is_none_or(|t| t.trim().is_empty()) {
        message = "not valid TOML: a value is missing".to_owned();
    }
    let mut problem = Problem::new("", message);
    if error.message().contains("duplicate key")
        && let Some(list) = list_in_single_brackets(text, &at)
    {
        problem = problem.help(format!("each {list} is a table of a list: write [[{list}]] above each of them"));
    }
    let span = Span { source, start: start + at.start, end: start + at.end };
    span.tell(sources, problem)
}

/// The list of a scene that a place in `[..]` names, where `[[..]]` was meant.
fn list_in_single_brackets<'t>(text: &'t str, at: &std::ops::Range<usize>) -> Option<&'t str> {
    let before = text.get(..at.start)?.rsplit('\n').next()?;
    let key = text.get(at.clone())?.trim();
    let scene: &Shape = &SCENE;
    let is_list = scene.key(key).is_some_and(|k| matches!(k.kind, Kind::List(_)));
    (before.trim() == "[" && is_list).then_some(key)
}

fn entries(table: DeTable<'_>, source: usize) -> Vec<Entry> {
    let mut entries: Vec<Entry> = table
        .into_iter()
        .map(|(key, value)| {
            let at = key.span();
            Entry {
                key_span: Span { source, start: at.start, end: at.end },
                key: key.into_inner().into_owned(),
                node: node(value, source),
            }
        })
        .collect();
    // The crate keeps tables in the order of the alphabet; problems and sweeps go in the order of the file.
    entries.sort_by_key(|e| e.key_span.start);
    entries
}

fn node(value: Spanned<DeValue<'_>>, source: usize) -> Node {
    let at = value.span();
    let span = Span { source, start: at.start, end: at.end };
    let value = match value.into_inner() {
        DeValue::String(text) => Value::Text(text.into_owned()),
        DeValue::Integer(written) => match i128::from_str_radix(written.as_str(), written.radix()) {
            // -0 is a number with a sign, as in JSON.
            Ok(0) if written.as_str().starts_with('-') => Value::Number(-0.0),
            Ok(k) => Value::Integer(k),
            // More than 38 digits: only a number can hold it.
            Err(_) => Value::Number(written.as_str().parse().unwrap_or(f64::INFINITY)),
        },
        // "inf" and "nan" parse here and are refused by the rules of their key.
        DeValue::Float(written) => Value::Number(written.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(flag) => Value::Flag(flag),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(values) => Value::List(values.into_iter().map(|v| node(v, source)).collect()),
        DeValue::Table(table) => Value::Table(entries(table, source)),
    };
    Node { value, span }
}

/// Where brackets nest deeper than [`DEEPEST`] or a dotted key has more than [`LONGEST_KEY`] parts, if they do. The crate
/// bounds the brackets but not the keys, and a tree of tables is dropped recursively: a key of a million dots would overflow
/// the stack. Strings end here where they end for the crate's lexer, at a line's end if they are not closed.
fn too_deep(text: &str) -> Option<(usize, String)> {
    let bytes = text.as_bytes();
    let find = |from: usize, what: &str| text.get(from..).and_then(|rest| rest.find(what)).map(|k| from + k);
    let (mut at, mut depth, mut parts) = (0, 0usize, 1usize);
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'#' => {
                while !matches!(bytes.get(at), None | Some(b'\n' | b'\r')) {
                    at += 1;
                }
                continue;
            }
            b'\'' if bytes[at..].starts_with(b"'''") => {
                at = find(at + 3, "'''").map_or(bytes.len(), |k| k + 3);
                while bytes.get(at) == Some(&b'\'') {
                    at += 1;
                }
                continue;
            }
            b'"' if bytes[at..].starts_with(b"\"\"\"") => {
                at += 3;
                while at < bytes.len() && !bytes[at..].starts_with(b"\"\"\"") {
                    at += if bytes[at] == b'\\' { 2 } else { 1 };
                }
                at = (at + 3).min(bytes.len());
                while bytes.get(at) == Some(&b'"') {
                    at += 1;
                }
                continue;
            }
            b'\'' | b'"' => {
                at += 1;
                while !matches!(bytes.get(at), None | Some(b'\n')) && bytes[at] != byte {
                    at += if byte == b'"' && bytes[at] == b'\\' && bytes.get(at + 1) != Some(&b'\n') { 2 } else { 1 };
                }
                if bytes.get(at) == Some(&byte) {
                    at += 1;
                }
                continue;
            }
            b'[' | b'{' => {
                (depth, parts) = (depth + 1, 1);
                if depth > DEEPEST {
                    return Some((at, format!("nested more than {DEEPEST} deep")));
                }
            }
            b']' | b'}' => (depth, parts) = (depth.saturating_sub(1), 1),
            b'=' | b',' | b'\n' => parts = 1,
            b'.' => {
                parts += 1;
                if parts > LONGEST_KEY {
                    return Some((at, format!("a key of more than {LONGEST_KEY} parts")));
                }
            }
            _ => {}
        }
        at += 1;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Node, Problem> {
        parse(&[Source { name: "t.toml".to_owned(), text: text.to_owned() }], 0)
    }

    #[test]
    fn values_and_their_places() {
        let text = "a = 1\n[b]\nc = [0x10, 1e3, inf, -nan]\nd = 'x'\n[[e]]\nf = 1979-05-27\n[[e]]\n";
        let node = read(text).unwrap();
        let c = node.get("b").unwrap().get("c").unwrap();
        assert_eq!(&text[c.span.start..c.span.end], "[0x10, 1e3, inf, -nan]");
        let Value::List(c) = &c.value else { panic!() };
        assert_eq!((c[0].integer(), c[1].integer(), c[2].number()), (Some(16), Some(1000), Some(f64::INFINITY)));
        assert!(c[3].number().unwrap().is_nan());
        let Value::List(e) = &node.get("e").unwrap().value else { panic!() };
        assert_eq!((&text[e[0].span.start..e[0].span.end], e.len()), ("[[e]]", 2));
        assert_eq!(e[0].get("f").unwrap().kind(), "a date");
        assert_eq!(read("x = 1e400").unwrap().get("x").unwrap().number(), Some(f64::INFINITY));
        assert_eq!(read("x = 18446744073709551615").unwrap().get("x").unwrap().integer(), Some(u64::MAX as i128));
    }

    #[test]
    fn what_is_no_toml_says_where() {
        for (text, line, column, says) in [
            ("a = ", 1, 4, "TOML"),
            ("a = 1\nb = = 2", 2, 5, "TOML"),
            ("a = 1\na = 2", 2, 1, "`a` comes twice"),
            ("[body]\nmass = 1\n\n[body]\nmass = 2", 4, 2, "write [[body]] above each of them"),
            ("[[body]]\nmass = 1\n\n[body]\nmass = 2", 4, 2, "write [[body]] above each of them"),
            ("[a]\n[a]\n", 2, 2, "comes twice"),
            ("a = \"x\n", 1, 7, "TOML"),
            ("[a\nb = 1", 1, 3, "TOML"),
            ("é = 1", 1, 1, "TOML"),
        ] {
            let problem = read(text).unwrap_err();
            let shown = problem.to_string();
            println!("{shown}");
            assert!(shown.contains(says), "{shown}");
            assert_eq!((problem.line(), problem.column()), (Some(line), Some(column)), "{shown}");
        }
    }

    #[test]
    fn depth_is_bounded_and_strings_do_not_count() {
        let many = 200_000;
        for text in [
            format!("a = {}", "[".repeat(many)),
            format!("a = {}", "{b = ".repeat(many)),
            format!("a{} = 1", ".a".repeat(many)),
            format!("[a{}]", ".a".repeat(many)),
            format!("[[a{}]]", " . \"a\"".repeat(many)),
            format!("x = 'a\n{}", "'[' . ".repeat(many)),
        ] {
            let problem = read(&text).unwrap_err();
            println!("{problem}");
        }
        let dots = ".".repeat(100);
        let fine =
            format!("a = '{dots}'\nb = \"\\\"{dots}\" # {dots}\nc = '''\n{dots}'''\nd = \"\"\"{dots}\\\"\"\"\"\n");
        read(&fine).unwrap();
        let numbers = format!("a = [{}]", "0.5, ".repeat(10_000));
        read(&numbers).unwrap();
    }
}
