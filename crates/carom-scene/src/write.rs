//! A model as text again: TOML with every default filled in, or JSON. Numbers are written with as many digits as it takes to
//! read the same bits back.
use std::fmt::Write;

use crate::model::{Ball, Boundary, Distribution, Form, Mass, Scene, Values};
use crate::node::Data;
use carom::Coefficient;

/// How much to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Every default filled in.
    Full,
    /// What differs from the defaults: for a link.
    Short,
}

/// One key of a table on its way out.
struct Line {
    key: String,
    /// `None`: unsaid on purpose; the comment that stands instead.
    value: Result<Data, &'static str>,
}

/// One `[table]` or `[[table]]` on its way out; the first has no name.
struct Section {
    name: Vec<String>,
    list: bool,
    lines: Vec<Line>,
}

impl Section {
    fn new(name: &[&str], list: bool) -> Self {
        Self { name: name.iter().map(|&n| n.to_owned()).collect(), list, lines: Vec::new() }
    }

    fn put(&mut self, key: &str, value: impl Into<Data>) {
        self.lines.push(Line { key: key.to_owned(), value: Ok(value.into()) });
    }

    /// A key that may be left out where it has its default.
    fn put_unless(&mut self, is_default: bool, detail: Detail, key: &str, value: impl Into<Data>) {
        if detail == Detail::Full || !is_default {
            self.put(key, value);
        }
    }

    fn unsaid(&mut self, detail: Detail, key: &str, comment: &'static str) {
        if detail == Detail::Full {
            self.lines.push(Line { key: key.to_owned(), value: Err(comment) });
        }
    }
}

impl From<f64> for Data {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}
impl From<bool> for Data {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}
impl From<u64> for Data {
    fn from(k: u64) -> Self {
        Self::Integer(i128::from(k))
    }
}
impl From<usize> for Data {
    fn from(k: usize) -> Self {
        Self::Integer(k as i128)
    }
}
impl From<&String> for Data {
    fn from(text: &String) -> Self {
        Self::Text(text.clone())
    }
}
impl From<&Vec<f64>> for Data {
    fn from(numbers: &Vec<f64>) -> Self {
        numbers.as_slice().into()
    }
}
impl From<&Coefficient> for Data {
    fn from(coefficient: &Coefficient) -> Self {
        match coefficient {
            Coefficient::Constant(x) => Self::Number(*x),
            Coefficient::Curve(points) => {
                let points = points.iter().map(|&(s, v)| Self::from(&[s, v][..])).collect();
                table([("curve", Self::List(points))])
            }
        }
    }
}
fn table<const N: usize>(entries: [(&str, Data); N]) -> Data {
    Data::Table(entries.into_iter().map(|(k, v)| (k.to_owned(), v)).collect())
}

/// The scene as a TOML text. Read again it is the same scene, to the last bit.
pub fn to_toml(scene: &Scene, detail: Detail) -> String {
    let mut out = String::new();
    for section in sections(scene, detail) {
        if !section.name.is_empty() {
            let name = section.name.iter().map(|n| toml_key(n)).collect::<Vec<_>>().join(".");
            let (open, close) = if section.list { ("[[", "]]") } else { ("[", "]") };
            let _ = write!(out, "\n{open}{name}{close}\n");
        }
        for line in &section.lines {
            let key = toml_key(&line.key);
            let _ = match &line.value {
                Ok(data) => writeln!(out, "{key} = {}", Toml(data)),
                Err(comment) => writeln!(out, "# {key}: {comment}"),
            };
        }
    }
    out
}

/// The scene as a JSON text on one line. Read again it is the same scene, to the last bit.
pub fn to_json(scene: &Scene, detail: Detail) -> String {
    Json(&tree(scene, detail)).to_string()
}

/// The scene as one table.
fn tree(scene: &Scene, detail: Detail) -> Data {
    let mut root: Vec<(String, Data)> = Vec::new();
    for section in sections(scene, detail) {
        let lines: Vec<_> = section.lines.into_iter().filter_map(|l| Some((l.key, l.value.ok()?))).collect();
        match &section.name[..] {
            [] => root.extend(lines),
            [list] if section.list => match root.last_mut() {
                Some((last, Data::List(items))) if last == list => items.push(Data::Table(lines)),
                _ => root.push((list.clone(), Data::List(vec![Data::Table(lines)]))),
            },
            [name] => root.push((name.clone(), Data::Table(lines))),
            [outer, inner, ..] => match root.last_mut() {
                Some((last, Data::Table(tables))) if last == outer => tables.push((inner.clone(), Data::Table(lines))),
                _ => root.push((outer.clone(), Data::Table(vec![(inner.clone(), Data::Table(lines))]))),
            },
        }
    }
    Data::Table(root)
}

fn sections(scene: &Scene, detail: Detail) -> Vec<Section> {
    let mut all = Vec::new();
    let mut root = Section::new(&[], false);
    root.put("carom", 1u64);
    root.put_unless(scene.title.is_empty(), detail, "title", &scene.title);
    all.push(root);
    all.push(world(scene, detail));
    for (k, surface) in scene.materials.iter().enumerate() {
        let mut section = Section::new(&["material", &surface.name], false);
        coefficients(&mut section, detail, surface.restitution.as_ref(), surface.friction.as_ref(), surface.tangential);
        for (key, value) in [("rolling", surface.rolling), ("spinning", surface.spinning)] {
            match value {
                Some(value) => section.put(key, value),
                None => section.unsaid(detail, key, "unsaid"),
            }
        }
        if k > 0 || !section.lines.is_empty() {
            all.push(section);
        }
    }
    for pair in &scene.pairs {
        let mut section = Section::new(&["pair"], true);
        section.put("materials", Data::List(pair.materials.iter().map(Data::from).collect()));
        coefficients(&mut section, detail, pair.restitution.as_ref(), pair.friction.as_ref(), pair.tangential);
        match pair.law {
            Some(law) => section.put("law", law.name()),
            None => section.unsaid(detail, "law", "unsaid: the run's law"),
        }
        all.push(section);
    }
    for (k, body) in scene.bodies.iter().enumerate() {
        let mut section = Section::new(&["body"], true);
        section.put_unless(body.name == format!("body-{}", k + 1), detail, "name", &body.name);
        ball(&mut section, &body.ball, Some(&body.position), detail, scene.world.dim);
        all.push(section);
    }
    for (k, wall) in scene.walls.iter().enumerate() {
        let mut section = Section::new(&["wall"], true);
        section.put_unless(wall.name == format!("wall-{}", k + 1), detail, "name", &wall.name);
        let (key, form) = match &wall.form {
            Form::Plane { point, normal } => ("plane", table([("point", point.into()), ("normal", normal.into())])),
            Form::Segment { from, to } => ("segment", table([("from", from.into()), ("to", to.into())])),
            Form::Arc { centre, radius, from, to } => (
                "arc",
                table([
                    ("centre", centre.into()),
                    ("radius", (*radius).into()),
                    ("from", (*from).into()),
                    ("to", (*to).into()),
                ]),
            ),
            Form::Triangle([a, b, c]) => ("triangle", table([("a", a.into()), ("b", b.into()), ("c", c.into())])),
        };
        section.put(key, form);
        section.put_unless(is_zero(&wall.velocity), detail, "velocity", &wall.velocity);
        section.put_unless(wall.material == "default", detail, "material", &wall.material);
        all.push(section);
    }
    for k in 0..scene.groups.len() {
        all.push(group(scene, k, detail));
    }
    all.push(run(scene, detail));
    for output in &scene.outputs {
        let mut section = Section::new(&["output"], true);
        section.put("path", &output.path);
        match output.every {
            Some(time) => section.put("every", table([("time", time.into())])),
            None => section.unsaid(detail, "every", "stills at the end, movies 25 frames/s, trajectories 60 samples"),
        }
        all.push(section);
    }
    if !scene.sweep.is_empty() {
        let mut section = Section::new(&["sweep"], false);
        for sweep in &scene.sweep {
            let values = match &sweep.values {
                Values::List(values) => Data::List(values.clone()),
                Values::Range(from, to) => {
                    table([("range", Data::List([from, to].map(|&k| Data::Integer(i128::from(k))).to_vec()))])
                }
                Values::Steps(from, to, steps) => {
                    table([("range", [*from, *to][..].into()), ("steps", (*steps).into())])
                }
            };
            section.put(&sweep.path, values);
        }
        all.push(section);
    }
    all
}

fn is_zero(numbers: &[f64]) -> bool {
    numbers.iter().all(|x| x.to_bits() == 0)
}

fn world(scene: &Scene, detail: Detail) -> Section {
    let world = &scene.world;
    let mut section = Section::new(&["world"], false);
    section.put("dim", world.dim);
    section.put_unless(is_zero(&world.gravity), detail, "gravity", &world.gravity);
    let boundary = match &world.boundary {
        Boundary::Open => table([("kind", "open".into())]),
        Boundary::Periodic { min, max } => {
            table([("kind", "periodic".into()), ("min", min.into()), ("max", max.into())])
        }
        Boundary::Box { min, max, material, periodic } => {
            let axes = periodic.iter().map(|&k| Data::from(crate::fields::AXES[k])).collect();
            table([
                ("kind", "box".into()),
                ("min", min.into()),
                ("max", max.into()),
                ("material", material.into()),
                ("periodic", Data::List(axes)),
            ])
        }
    };
    section.put_unless(world.boundary == Boundary::Open, detail, "boundary", boundary);
    section
}

fn coefficients(
    section: &mut Section,
    detail: Detail,
    restitution: Option<&Coefficient>,
    friction: Option<&Coefficient>,
    tangential: Option<f64>,
) {
    match restitution {
        Some(e) => section.put("restitution", e),
        None => section.unsaid(detail, "restitution", "unsaid (the other surface decides; where neither says, 1)"),
    }
    match friction {
        Some(mu) => section.put("friction", mu),
        None => section.unsaid(detail, "friction", "unsaid (the other surface decides; where neither says, 0)"),
    }
    match tangential {
        Some(t) => section.put("tangential", t),
        None => section.unsaid(detail, "tangential", "unsaid (the other surface decides; where neither says, 0)"),
    }
}

fn ball(section: &mut Section, ball: &Ball, position: Option<&Vec<f64>>, detail: Detail, dim: usize) {
    match ball.mass {
        Mass::Mass(mass) => section.put("mass", mass),
        Mass::Density(density) => section.put("density", density),
        Mass::Unsaid => section.unsaid(detail, "mass", "unsaid (the body is fixed)"),
    }
    section.put_unless(!ball.fixed, detail, "fixed", ball.fixed);
    section.put("radius", ball.radius);
    if let Some(position) = position {
        section.put("position", position);
    }
    section.put_unless(is_zero(&ball.velocity), detail, "velocity", &ball.velocity);
    section.put_unless(is_zero(&ball.spin), detail, "spin", &ball.spin);
    section.put_unless(ball.material == "default", detail, "material", &ball.material);
    match (ball.inertia, dim) {
        (Some(inertia), _) => section.put("inertia", inertia),
        (None, 1) => section.unsaid(detail, "inertia", "there is none in 1D"),
        (None, 2) => section.unsaid(detail, "inertia", "unsaid: a disc's, 1/2"),
        (None, _) => section.unsaid(detail, "inertia", "unsaid: a sphere's, 2/5"),
    }
}

fn group(scene: &Scene, k: usize, detail: Detail) -> Section {
    let (group, dim) = (&scene.groups[k], scene.world.dim);
    let mut section = Section::new(&["group"], true);
    section.put_unless(group.name == format!("group-{}", k + 1), detail, "name", &group.name);
    section.put("kind", group.kind.name());
    match group.count {
        Some(count) => section.put("count", count),
        None => section.unsaid(detail, "count", "as many as there is room for"),
    }
    let extent = scene.world.extent();
    for (key, corner, default) in [("min", &group.min, extent.map(|e| e.0)), ("max", &group.max, extent.map(|e| e.1))] {
        match corner {
            Some(corner) => section.put_unless(default == Some(corner), detail, key, corner),
            None => section.unsaid(detail, key, "an open world has no boundary to take it from"),
        }
    }
    section.put_unless(group.spacing.to_bits() == 0, detail, "spacing", group.spacing);
    if let Some(origin) = &group.origin {
        let corner: Option<Vec<f64>> = group.min.as_ref().map(|m| m.iter().map(|x| x + group.body.radius).collect());
        section.put_unless(corner.as_ref() == Some(origin), detail, "origin", origin);
    }
    let x: Vec<f64> = (0..dim).map(|k| if k == 0 { 1.0 } else { 0.0 }).collect();
    section.put_unless(group.direction == x, detail, "direction", &group.direction);
    section.put_unless(group.rows == 5, detail, "rows", group.rows);
    let mut body = Section::new(&[], false);
    ball(&mut body, &group.body, None, detail, dim);
    if group.velocity.is_some() {
        body.lines.retain(|l| l.key != "velocity");
    }
    let said = body.lines.into_iter().filter_map(|l| Some((l.key, l.value.ok()?))).collect();
    section.put("body", Data::Table(said));
    if let Some(velocity) = &group.velocity {
        let velocity = match velocity {
            Distribution::Maxwell { temperature, zero_momentum } => table([
                ("distribution", "maxwell".into()),
                ("temperature", (*temperature).into()),
                ("zero_momentum", (*zero_momentum).into()),
            ]),
            Distribution::Fixed(value) => table([("distribution", "fixed".into()), ("value", value.into())]),
            Distribution::Uniform(speed) => table([("distribution", "uniform".into()), ("speed", (*speed).into())]),
        };
        section.put("velocity", velocity);
    }
    section
}

fn run(scene: &Scene, detail: Detail) -> Section {
    let run = &scene.run;
    let mut section = Section::new(&["run"], false);
    let mut until = Vec::new();
    if let Some(time) = run.until.time {
        until.push(("time".to_owned(), Data::Number(time)));
    }
    if let Some(impacts) = run.until.impacts {
        until.push(("impacts".to_owned(), impacts.into()));
    }
    if run.until.rest || detail == Detail::Full {
        until.push(("rest".to_owned(), run.until.rest.into()));
    }
    section.put_unless(until.is_empty(), detail, "until", Data::Table(until));
    section.put_unless(run.seed == 1, detail, "seed", run.seed);
    section.put_unless(run.together == Default::default(), detail, "together", run.together.name());
    section.put_unless(run.law == Default::default(), detail, "law", run.law.name());
    section.put_unless(run.rest_speed == 0.01, detail, "rest_speed", run.rest_speed);
    section
}

/// A key, in quotes unless it is bare.
fn toml_key(key: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if !key.is_empty() && key.chars().all(bare) { key.to_owned() } else { Json(&Data::from(key)).to_string() }
}

/// Data as a TOML value.
struct Toml<'d>(&'d Data);

impl std::fmt::Display for Toml<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Data::List(items) => {
                f.write_char('[')?;
                for (k, item) in items.iter().enumerate() {
                    write!(f, "{}{}", if k == 0 { "" } else { ", " }, Toml(item))?;
                }
                f.write_char(']')
            }
            Data::Table(entries) if entries.is_empty() => f.write_str("{}"),
            Data::Table(entries) => {
                f.write_str("{ ")?;
                for (k, (key, item)) in entries.iter().enumerate() {
                    write!(f, "{}{} = {}", if k == 0 { "" } else { ", " }, toml_key(key), Toml(item))?;
                }
                f.write_str(" }")
            }
            // Numbers, flags and text are written as JSON writes them.
            other => Json(other).fmt(f),
        }
    }
}

/// Data as a JSON value.
struct Json<'d>(&'d Data);

impl std::fmt::Display for Json<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Data::Flag(flag) => write!(f, "{flag}"),
            Data::Integer(k) => write!(f, "{k}"),
            // The shortest digits that are read back to the same bits.
            Data::Number(x) => write!(f, "{x:?}"),
            Data::Text(text) => {
                f.write_char('"')?;
                for c in text.chars() {
                    match c {
                        '"' => f.write_str("\\\"")?,
                        '\\' => f.write_str("\\\\")?,
                        '\n' => f.write_str("\\n")?,
                        '\t' => f.write_str("\\t")?,
                        c if c.is_control() => write!(f, "\\u{:04x}", c as u32)?,
                        c => f.write_char(c)?,
                    }
                }
                f.write_char('"')
            }
            Data::List(items) => {
                f.write_char('[')?;
                for (k, item) in items.iter().enumerate() {
                    write!(f, "{}{}", if k == 0 { "" } else { "," }, Json(item))?;
                }
                f.write_char(']')
            }
            Data::Table(entries) => {
                f.write_char('{')?;
                for (k, (key, item)) in entries.iter().enumerate() {
                    let key = Data::from(key);
                    write!(f, "{}{}:{}", if k == 0 { "" } else { "," }, Json(&key), Json(item))?;
                }
                f.write_char('}')
            }
        }
    }
}

/// One value as TOML writes it.
pub(crate) fn value_to_toml(value: &Data) -> String {
    Toml(value).to_string()
}
