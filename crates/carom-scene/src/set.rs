//! Changing one key of a document by its dotted path: `--set body.A.mass=2`, and every step of a sweep.
use crate::document::Document;
use crate::keys::{Kind, Shape};
use crate::nearest::meant;
use crate::node::{Data, Entry, Node, Source, Span, Value};
use crate::path::{self, Step, Target};
use crate::problem::{Problem, Problems};
use crate::toml;

impl Document {
    /// Sets one key from an argument such as `body.A.mass=2`. The value is read as TOML; a bare word is text. Tables that are
    /// missing are made; bodies, walls and groups go by name or by number from 1 (`body[1].mass`).
    pub fn set_from(&mut self, argument: &str) -> Result<(), Problems> {
        match argument.split_once('=') {
            Some((path, _)) => {
                let source = self.add("--set", argument);
                self.set_text(path, source, path.len() + 1)
            }
            None => Err(Problem::new(argument, "`--set` expects path=value").help("as in --set run.seed=7").into()),
        }
    }

    /// Sets the key of this path to a value that is written as TOML; a bare word is text.
    pub fn set(&mut self, path: &str, value: &str) -> Result<(), Problems> {
        let source = self.add("--set", &format!("{path}={value}"));
        self.set_text(path, source, path.len() + 1)
    }

    /// Sets the key of this path.
    pub fn set_data(&mut self, path: &str, value: &Data) -> Result<(), Problems> {
        let shown = crate::write::value_to_toml(value);
        let source = self.add("--set", &format!("{path}={shown}"));
        let steps = self.steps(path, source)?;
        let span = Span { source, start: path.len() + 1, end: path.len() + 1 + shown.len() };
        self.put(path, &steps.0, value.node(span))
    }

    fn add(&mut self, name: &str, text: &str) -> usize {
        self.sources.push(Source { name: name.to_owned(), text: text.to_owned() });
        self.sources.len() - 1
    }

    /// The steps of a path that stands at the start of a source, and what it leads to.
    fn steps(&self, path: &str, source: usize) -> Result<(Vec<Step>, Target), Problems> {
        let tell = |start: usize, message: String| {
            let span = Span { source, start, end: path.len().max(start + 1) };
            let help = "the dotted path of a key, as in run.seed, material.default.restitution, body.A.mass";
            Problems::from(span.tell(&self.sources, Problem::new(path, message).help(help)))
        };
        let steps = path::parse(path).map_err(|(at, message)| tell(at, message))?;
        let target = path::legal(&steps).map_err(|message| tell(0, message))?;
        Ok((steps, target))
    }

    fn set_text(&mut self, path: &str, source: usize, start: usize) -> Result<(), Problems> {
        let (steps, target) = self.steps(path, source)?;
        let path = path.trim();
        let blank = self.sources[source].text[start..]
            .chars()
            .take_while(|c| c.is_whitespace())
            .map(char::len_utf8)
            .sum::<usize>();
        let start = start + blank;
        let written = self.sources[source].text[start..].to_owned();
        let span = Span { source, start, end: start + written.len() };
        let text = |written: &str| Node { value: Value::Text(written.trim().to_owned()), span };
        let wants_text = matches!(target, Target::Key(key) if matches!(key.kind, Kind::Text | Kind::Choice(_)));
        let node = match toml::parse_value(&self.sources, source, start) {
            // title=2024 is text, too.
            Ok(node) if wants_text && !matches!(node.value, Value::Text(_)) => text(&written),
            Ok(node) => node,
            Err(_) if is_word(&written) => text(&written),
            Err(mut problem) => {
                problem.key = path.to_owned();
                let help = "a value as TOML writes it: 2.5, true, [1.0, 2.0], { time = 1.0 }, \"text\" or a bare word";
                return Err(problem.help(help).into());
            }
        };
        self.put(path, &steps, node)
    }

    fn put(&mut self, path: &str, steps: &[Step], new: Node) -> Result<(), Problems> {
        let span = new.span;
        walk(&mut self.root, steps, new).map_err(|(message, help)| {
            let whole = Span { start: 0, ..span };
            Problems::from(whole.tell(&self.sources, Problem::new(path, message).help(help)))
        })
    }
}

/// True for what someone who forgot the quotes would write as text.
fn is_word(written: &str) -> bool {
    let word = written.trim();
    word.starts_with(|c: char| c.is_alphabetic() || c == '_' || c == '.' || c == '/')
        && !word.contains(['"', '\'', '\n', '='])
}

/// Walks to the end of a legal path and puts the value there; an error is a message and a help.
fn walk(root: &mut Node, steps: &[Step], new: Node) -> Result<(), (String, String)> {
    let span = new.span;
    let mut node = root;
    let mut list = "";
    for step in steps {
        let number = match (step, &node.value) {
            (Step::Key(name), Value::List(items)) => match path::element(items, name, list) {
                Some(k) => k,
                None => return Err(nameless(items, name, list)),
            },
            (Step::Index(k), Value::List(items)) if *k <= items.len() => k - 1,
            (Step::Index(k), Value::List(items)) => {
                return Err((format!("there is no {list}[{k}]"), format!("there are {}, counted from 1", items.len())));
            }
            (Step::Index(k), _) => return Err((format!("there is no {list}[{k}]"), "it is not a list".to_owned())),
            (Step::Key(key), Value::Table(entries)) => {
                list = key;
                entries.iter().position(|e| e.key == *key).unwrap_or(usize::MAX)
            }
            // A number in the way of a table: restitution = 0.5, and now restitution.curve.
            (Step::Key(key), _) => {
                list = key;
                node.value = Value::Table(Vec::new());
                usize::MAX
            }
        };
        node = match &mut node.value {
            Value::List(items) => &mut items[number],
            Value::Table(entries) => {
                let number = if number == usize::MAX {
                    let Step::Key(key) = step else {
                        return Err(("a path that leads nowhere".to_owned(), String::new()));
                    };
                    if list_of_tables(steps, key) && steps.len() > 1 {
                        return Err((format!("the scene has no [[{key}]]"), format!("add a [[{key}]] to the file")));
                    }
                    let made = Node { value: Value::Table(Vec::new()), span };
                    entries.push(Entry { key: key.clone(), key_span: span, node: made });
                    entries.len() - 1
                } else {
                    number
                };
                &mut entries[number].node
            }
            _ => return Err(("a path that leads nowhere".to_owned(), String::new())),
        };
    }
    *node = new;
    Ok(())
}

/// True if the first step of the path is a list of tables, which cannot be made out of nothing.
fn list_of_tables(steps: &[Step], key: &str) -> bool {
    let first = matches!(steps.first(), Some(Step::Key(first)) if first == key);
    let scene: &Shape = &crate::keys::SCENE;
    first && scene.key(key).is_some_and(|k| matches!(k.kind, Kind::List(_)))
}

/// What to say of a name that no element has.
fn nameless(items: &[Node], name: &str, list: &str) -> (String, String) {
    let own = |(k, item): (usize, &Node)| match item.get("name").and_then(Node::text) {
        Some(name) => name.to_owned(),
        None => format!("{list}-{}", k + 1),
    };
    let names: Vec<String> = items.iter().take(1000).enumerate().map(own).collect();
    let message = format!("no {list} is called `{name}`{}", meant(name, names.iter().map(String::as_str)));
    let mut shown = names.iter().take(8).map(String::as_str).collect::<Vec<_>>().join(", ");
    if names.len() > 8 {
        shown.push_str(", ...");
    }
    (message, format!("there are: {shown}; or count from 1, as in {list}[1]"))
}
