//! Dotted paths: `material.default.restitution`, `body.A.mass`, `body[2].position[1]`. Numbers count from 1, as the default
//! names do.
use std::borrow::Cow;

use crate::keys::{Key, Kind, SCENE, Shape};
use crate::nearest::suggestion;
use crate::node::{Node, Span, Value};

/// One step of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    Key(String),
    /// From 1.
    Index(usize),
}

/// A key as it stands in a path: in quotes where a dot, a bracket or a quote would be misread.
pub(crate) fn quote(key: &str) -> Cow<'_, str> {
    if !key.is_empty() && !key.contains(['.', '[', ']', '"', '=', '\n']) && key.trim() == key {
        Cow::Borrowed(key)
    } else {
        Cow::Owned(format!("\"{}\"", key.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n")))
    }
}

/// The steps of a path; an error is a message and the byte it is about.
pub(crate) fn parse(path: &str) -> Result<Vec<Step>, (usize, String)> {
    /// A scene's keys lie no deeper than six.
    const LONGEST: usize = 16;
    let mut steps = Vec::new();
    let mut rest = path;
    let at = |rest: &str| path.len() - rest.len();
    loop {
        if steps.len() > LONGEST {
            return Err((at(rest), "a path of too many parts".to_owned()));
        }
        if let Some(quoted) = rest.strip_prefix('"') {
            let mut key = String::new();
            let mut letters = quoted.char_indices();
            loop {
                match letters.next() {
                    Some((k, '"')) => {
                        rest = &quoted[k + 1..];
                        break;
                    }
                    Some((_, '\\')) => match letters.next() {
                        Some((_, 'n')) => key.push('\n'),
                        Some((_, c)) => key.push(c),
                        None => return Err((at(rest), "a quote that is not closed".to_owned())),
                    },
                    Some((_, c)) => key.push(c),
                    None => return Err((at(rest), "a quote that is not closed".to_owned())),
                }
            }
            steps.push(Step::Key(key));
        } else {
            let end = rest.find(['.', '[']).unwrap_or(rest.len());
            let key = rest[..end].trim();
            if key.is_empty() {
                return Err((at(rest), "a part of the path is empty".to_owned()));
            }
            steps.push(Step::Key(key.to_owned()));
            rest = &rest[end..];
        }
        while let Some(inside) = rest.strip_prefix('[') {
            let Some(end) = inside.find(']') else { return Err((at(rest), "a bracket that is not closed".to_owned())) };
            match inside[..end].trim().parse::<usize>() {
                Ok(k) if k >= 1 => steps.push(Step::Index(k)),
                _ => return Err((at(inside), format!("`{}` is no number from 1 on", &inside[..end]))),
            }
            rest = &inside[end + 1..];
        }
        match rest.strip_prefix('.') {
            Some(after) => rest = after,
            None if rest.is_empty() => return Ok(steps),
            None => return Err((at(rest), format!("expected a dot, found `{rest}`"))),
        }
    }
}

/// The value a path leads to, or as far as the text has it; what is missing is found at the table it is missing from.
pub(crate) fn locate(root: &Node, path: &str) -> Span {
    let mut node = root;
    let Ok(steps) = parse(path) else { return node.span };
    let mut list = String::new();
    for step in steps {
        let next = match (&step, &node.value) {
            (Step::Key(key), Value::Table(_)) => {
                list.clone_from(key);
                node.get(key)
            }
            (Step::Key(key), Value::List(items)) => element(items, key, &list).and_then(|k| items.get(k)),
            (Step::Index(k), Value::List(items)) => items.get(k - 1),
            _ => None,
        };
        match next {
            Some(next) => node = next,
            None => break,
        }
    }
    node.span
}

/// The number, from 0, of the element of this name: its `name`, or the default name that its place gives it.
pub(crate) fn element(items: &[Node], name: &str, list: &str) -> Option<usize> {
    items.iter().enumerate().position(|(k, item)| match item.get("name").and_then(Node::text) {
        Some(own) => own == name,
        None => name.strip_prefix(list).and_then(|n| n.strip_prefix('-')).is_some_and(|n| n == (k + 1).to_string()),
    })
}

/// Where a legal path leads.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Target {
    Key(&'static Key),
    /// One table of a list, or one of named tables.
    Table(&'static Shape),
    /// One number of a vector, or what lies inside a coefficient's curve.
    Inside,
}

/// What a path leads to by the table of keys, whether or not a scene has it; an error is a message.
pub(crate) fn legal(steps: &[Step]) -> Result<Target, String> {
    let mut target = Target::Table(&SCENE);
    for step in steps {
        target = match (target, step) {
            (Target::Table(shape), Step::Key(name)) => match shape.key(name) {
                Some(key) => Target::Key(key),
                None => return Err(format!("unknown key `{name}`{}", suggestion(name, shape.names()))),
            },
            (Target::Key(key), step) => match (key.kind, step) {
                (Kind::Table(shape), Step::Key(name)) => match shape.key(name) {
                    Some(key) => Target::Key(key),
                    None => return Err(format!("unknown key `{name}`{}", suggestion(name, shape.names()))),
                },
                (Kind::List(shape), _) => Target::Table(shape),
                (Kind::Named(shape), Step::Key(_)) => Target::Table(shape),
                (Kind::Coefficient(_), Step::Key(name)) if name == "curve" => Target::Inside,
                (Kind::Vector | Kind::Spin | Kind::Axes | Kind::TwoNames, Step::Index(_)) => Target::Inside,
                (Kind::Sweep, _) => return Err("a sweep cannot be set by a path".to_owned()),
                (_, Step::Key(name)) => return Err(format!("`{}` has no key `{name}`", key.name)),
                (_, Step::Index(k)) => return Err(format!("`{}` has no element [{k}]", key.name)),
            },
            (Target::Table(shape), Step::Index(k)) => return Err(format!("{} has no element [{k}]", shape.name)),
            (Target::Inside, Step::Index(_)) => Target::Inside,
            (Target::Inside, Step::Key(name)) => return Err(format!("there is no key `{name}` here")),
        };
    }
    Ok(target)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_read_and_written() {
        let key = |k: &str| Step::Key(k.to_owned());
        assert_eq!(parse("body.A.mass").unwrap(), [key("body"), key("A"), key("mass")]);
        assert_eq!(
            parse("body[2].position[1]").unwrap(),
            [key("body"), Step::Index(2), key("position"), Step::Index(1)]
        );
        for name in ["A", "my ball", "a.b", "a\"b", "a\\b\"", "", " x ", "a[1]", "a\nb"] {
            assert_eq!(parse(&format!("body.{}.mass", quote(name))).unwrap()[1], key(name), "{name:?}");
        }
        for wrong in ["", ".", "a.", "a..b", "a[0]", "a[x]", "a[1", "\"a", "a[1]b", "\"a\"b", &"a.".repeat(100)] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn legal_paths_are_those_of_the_keys() {
        let ask = |path: &str| legal(&parse(path).unwrap());
        for path in [
            "run.seed",
            "material.steel.restitution",
            "material.steel.restitution.curve",
            "body.A.mass",
            "body[1].position[2]",
            "world.boundary.max",
            "group.gas.body.radius",
            "wall.floor.plane.normal",
            "run.until.time",
            "pair[1].friction",
            "output[1].every.time",
        ] {
            assert!(ask(path).is_ok(), "{path}");
        }
        for (path, says) in [
            ("run.sed", "did you mean `seed`?"),
            ("bdy.A.mass", "did you mean `body`?"),
            ("body.A.weight", "nearest known"),
            ("run.seed.x", "has no key"),
            ("run.seed[1]", "has no element"),
            ("sweep.x", "cannot be set"),
        ] {
            let message = ask(path).unwrap_err();
            assert!(message.contains(says), "{path}: {message}");
        }
    }
}
