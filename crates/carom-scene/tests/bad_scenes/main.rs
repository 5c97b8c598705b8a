//! Every rule of a scene file, broken: what is said of it, and where.
mod plane;
mod whole;

use carom_scene::{Document, Problem, Problems};
use plane::PLANE;
use whole::WHOLE;

/// Reads, checks and places.
fn judge(name: &str, text: &str) -> Result<(), Problems> {
    let document = Document::parse(name, text)?;
    let scene = document.scene()?;
    document.plan(&scene).map(|_| ())
}

/// A scene in the plane around what is under test.
fn in_the_plane(rest: &str) -> String {
    let mut text = rest.to_owned();
    for (table, whole) in [("[world]", "\n[world]\ndim = 2\n"), ("[run]", "\n[run]\nuntil = { time = 1.0 }\n")] {
        if !rest.contains(table) {
            text.push_str(whole);
        }
    }
    text
}

/// One broken rule: the text, line and column, what the message says.
type Case = (&'static str, usize, usize, &'static str);

/// The problem at this place that says this.
fn find<'p>(problems: &'p Problems, line: usize, column: usize, says: &str) -> Option<&'p Problem> {
    problems.iter().find(|p| (p.line(), p.column()) == (Some(line), Some(column)) && p.message.contains(says))
}

#[test]
fn every_broken_rule_is_told_with_its_place() {
    let whole = WHOLE.iter().map(|c| (c.0.to_owned(), c.1, c.2, c.3));
    let plane = PLANE.iter().map(|c| {
        // The version comes in front, and every line moves down by one.
        (format!("carom = 1\n{}", in_the_plane(c.0)), c.1 + 1, c.2, c.3)
    });
    let all: Vec<_> = whole.chain(plane).collect();
    println!("{} scenes", all.len());
    assert!(all.len() >= 80);
    let mut wrong = 0;
    for (text, line, column, says) in all {
        match judge("scene.toml", &text) {
            Ok(()) => {
                wrong += 1;
                println!("--- accepted, but \"{says}\":\n{text}");
            }
            Err(problems) if find(&problems, line, column, says).is_none() => {
                wrong += 1;
                println!("--- no \"{says}\" at {line}:{column}:\n{text}\n--- but\n{problems}");
            }
            Err(problems) => {
                for problem in problems.iter() {
                    let shown = problem.to_string();
                    assert!(shown.starts_with("scene.toml:"), "{shown}");
                    assert!(shown.contains('^'), "{shown}");
                    if !shown.contains("not valid TOML") {
                        assert!(shown.contains("help: "), "{shown}");
                    }
                }
            }
        }
    }
    assert_eq!(wrong, 0);
}

/// The same rules, the same words, and places in JSON.
#[test]
fn json_has_the_same_rules() {
    for (text, line, column, says) in [
        (
            "{\"carom\": 1, \"world\": {\"dim\": 2}, \"body\": [\n {\"mass\": -1, \"radius\": 1, \"position\": [0, 0]}]}",
            2,
            11,
            "mass must be positive",
        ),
        ("{\"carom\": 1, \"world\": {\"dim\": 2},\n \"bdy\": []}", 2, 2, "did you mean `body`?"),
        (
            "{\"carom\": 1, \"world\": {\"dim\": 2}, \"body\": [\n {\"mass\": 1, \"radius\": 1, \"position\": [0]}]}",
            2,
            39,
            "expects dim = 2 numbers, got 1",
        ),
        (
            "{\"carom\": 1, \"world\": {\"dim\": 2}, \"body\": [\n {\"mass\": 1e999, \"radius\": 1, \"position\": [0, 0]}]}",
            2,
            11,
            "must be finite",
        ),
        (
            "{\"carom\": 1, \"world\": {\"dim\": 2}, \"body\": [\n {\"mass\": null, \"radius\": 1, \"position\": [0, 0]}]}",
            2,
            11,
            "mass must be a number, got null",
        ),
        ("{\"carom\": 1,\n \"world\": {\"dim\": 1}\n \"body\": []}", 3, 2, "expected `,` or `}`"),
        (
            "{\"carom\": 1, \"world\": {\"dim\": 1}, \"material\": {\"default\":\n {\"restitution\": 2}}}",
            2,
            18,
            "restitution must lie in [0, 1]",
        ),
    ] {
        for name in ["scene.json", "-"] {
            let problems = judge(name, text).unwrap_err();
            assert!(find(&problems, line, column, says).is_some(), "{text}\n{problems}");
        }
    }
}

#[test]
fn all_problems_are_told_together_up_to_twenty() {
    let text =
        "carom = 1\ntitel = 1\n[world]\ndim = 2\n[[body]]\nmass = -1\nradius = 0\nposition = [0]\nmaterial = \"x\"\n";
    let problems = judge("a.toml", text).unwrap_err();
    println!("{problems}");
    assert_eq!(problems.iter().count(), 5);
    let lines: Vec<_> = problems.iter().map(|p| p.line().unwrap()).collect();
    assert!(lines.is_sorted(), "{lines:?}");
    let many =
        format!("carom = 1\n[world]\ndim = 1\n{}", "[[body]]\nmass = -1\nradius = 1\nposition = [0]\n".repeat(50));
    let problems = judge("a.toml", &many).unwrap_err();
    assert_eq!(problems.iter().count(), 20);
    assert!(problems.to_string().ends_with("and at least 30 more"));
}

#[test]
fn fine_scenes_near_the_edges_of_the_rules() {
    for (why, text) in [
        (
            "touching balls",
            "[[body]]\nmass=1\nradius=0.1\nposition=[0,0]\n[[body]]\nmass=1\nradius=0.2\nposition=[0.3,0]",
        ),
        (
            "touching a wall",
            "[[body]]\nmass=1\nradius=0.1\nposition=[0,0.1]\n[[wall]]\nplane={point=[0,0],normal=[0,1]}",
        ),
        ("a fixed body without mass", "[[body]]\nfixed=true\nradius=0.1\nposition=[0,0]"),
        ("a driven body", "[[body]]\nfixed=true\nradius=0.1\nposition=[0,0]\nvelocity=[1,0]"),
        (
            "integers as numbers, numbers as integers",
            "[[group]]\nkind=\"line\"\ncount=1e1\norigin=[0,0]\nbody={mass=1,radius=1}",
        ),
        ("an arc through 0 degrees", "[[wall]]\narc={centre=[0,0],radius=1,from=350,to=10}"),
        (
            "a whole circle around a ball",
            "[[wall]]\narc={centre=[0,0],radius=1,from=0,to=360}\n[[body]]\nmass=1\nradius=1\nposition=[0,0]",
        ),
        (
            "a lattice that fills its region",
            "[[group]]\nkind=\"hexagonal\"\nmin=[0,0]\nmax=[1,1]\nbody={mass=1,radius=0.05}",
        ),
        (
            "names that look alike",
            "[[group]]\nname=\"g\"\nkind=\"line\"\ncount=5\norigin=[0,0]\nbody={mass=1,radius=0.1}\n[[body]]\nname=\"g-6\"\nmass=1\nradius=1\nposition=[9,9]",
        ),
        (
            "a body and a wall of one name",
            "[[body]]\nname=\"a\"\nmass=1\nradius=0.1\nposition=[0,1]\n[[wall]]\nname=\"a\"\nplane={point=[0,0],normal=[0,1]}",
        ),
        (
            "a key of another kind of group",
            "[[group]]\nkind=\"line\"\nrows=3\ncount=5\norigin=[0,0]\nbody={mass=1,radius=0.1}",
        ),
    ] {
        let text = format!("carom = 1\n{}", in_the_plane(text));
        judge("a.toml", &text).unwrap_or_else(|e| panic!("{why}: {e}"));
    }
    // Nothing that could keep a run from ending: it may leave out what ends it.
    judge("a.toml", "carom = 1\n[world]\ndim = 3\n").unwrap();
    // A floor along the periodic axis, and one from seam to seam.
    judge(
        "a.toml",
        "carom = 1\n[world]\ndim = 2\ngravity = [0, -1]\n\
         boundary = { kind = \"box\", min = [0, 0], max = [1, 1], periodic = [\"x\"] }\n\
         [[wall]]\nsegment = { from = [0, 0.5], to = [1, 0.5] }\n[[wall]]\nplane = { point = [0, 0.2], normal = [0, 1] }\n\
         [run]\nuntil = { time = 1 }\n",
    )
    .unwrap();
}

#[test]
fn keys_without_effect_are_noted() {
    let text = "carom = 1\n[world]\ndim = 2\n[[group]]\nkind = \"line\"\nrows = 3\ncount = 5\norigin = [0, 0]\n\
                body = { mass = 1, radius = 0.1 }\n";
    let notes = Document::parse("a.toml", text).unwrap().notes();
    assert_eq!((notes.len(), notes[0].line()), (1, Some(6)));
    assert!(notes[0].to_string().contains("note: group[1].rows: `rows` says nothing"), "{}", notes[0]);
}

#[test]
fn bytes_that_are_no_text_are_told() {
    let problems = Document::read("a.toml", b"carom = 1\n\xff").unwrap_err();
    assert!(find(&problems, 2, 1, "not UTF-8").is_some(), "{problems}");
    assert!(Document::read("a.toml", b"\xef\xbb\xbfcarom = 1\n").is_ok());
}

/// The keys of the contract's page, all of them that fit into one dimension.
#[test]
fn the_contracts_example_is_a_scene() {
    judge(
        "a.toml",
        r#"
carom = 1
title = "Two balls on a line"
[world]
dim = 1
gravity = [0.0]
boundary = { kind = "open" }
[material.default]
restitution = 1.0
friction = 0.0
tangential = 0.0
rolling = 0.0
spinning = 0.0
[material.ball]
restitution = { curve = [[0.1, 0.98], [1.0, 0.9], [5.0, 0.8]] }
[material.cushion]
[[pair]]
materials = ["ball", "cushion"]
restitution = 0.85
[[body]]
name = "A"
mass = 2.0
fixed = false
radius = 0.10
position = [-1.0]
velocity = [3.0]
spin = []
material = "default"
inertia = 0.4
[[wall]]
name = "floor"
plane = { point = [-2.0], normal = [1.0] }
velocity = [0.0]
material = "default"
[[group]]
name = "gas"
kind = "random"
count = 10
min = [0.0]
max = [1.0]
spacing = 0.0
origin = [0.0]
direction = [1.0]
rows = 5
body = { mass = 1.0, radius = 0.0025, material = "default" }
velocity = { distribution = "maxwell", temperature = 1.0, zero_momentum = true }
[run]
until = { time = 1.0 }
seed = 1
together = "reflect"
law = "chatterjee-ruina"
rest_speed = 0.01
[[output]]
path = "break.gif"
every = { time = 0.02 }
[sweep]
"material.default.restitution" = [1.0, 0.99, 0.95, 0.9]
"run.seed" = { range = [1, 8] }
"#,
    )
    .unwrap_or_else(|e| panic!("{e}"));
}
