//! Whatever stands in a file, reading it ends, and with a problem rather than a panic.
use carom_scene::{Document, Format, builtins};
use proptest::prelude::*;

/// Reads, checks and places; how it ends does not matter here, but what is told must be printable.
fn try_all(name: &str, bytes: &[u8]) {
    let told = Document::read(name, bytes).and_then(|document| {
        document.notes();
        let scene = document.scene()?;
        // Large groups are another test's business.
        let bodies: usize = scene.groups.iter().map(|g| g.count.unwrap_or(0).max(g.rows * g.rows)).sum();
        if bodies < 2000 && scene.groups.iter().all(|g| g.count.is_some()) {
            document.plan(&scene)?;
        }
        Ok(())
    });
    if let Err(problems) = told {
        assert!(!problems.to_string().is_empty());
    }
}

/// Words of a scene, and what breaks them.
const WORDS: &[&str] = &[
    "[[body]]",
    "[[wall]]",
    "[[group]]",
    "[world]",
    "[run]",
    "[material.default]",
    "[sweep]",
    "\n",
    "\n",
    " = ",
    "{",
    "}",
    "[",
    "]",
    ",",
    ".",
    "\"",
    "'",
    "\"\"\"",
    "carom",
    "dim",
    "mass",
    "radius",
    "position",
    "velocity",
    "kind",
    "count",
    "rows",
    "1",
    "2",
    "3",
    "-1",
    "0.1",
    "1e308",
    "1e-308",
    "inf",
    "nan",
    "true",
    "\"box\"",
    "\"random\"",
    "\"rack\"",
    "\\",
    "#",
    "é",
    "\u{0}",
    "\r\n",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..400), json: bool) {
        try_all(if json { "a.json" } else { "a.toml" }, &bytes);
    }

    #[test]
    fn any_words(words in proptest::collection::vec(proptest::sample::select(WORDS), 0..120), json: bool) {
        try_all(if json { "a.json" } else { "a.toml" }, words.concat().as_bytes());
    }

    #[test]
    fn built_in_scenes_with_words_put_in_and_taken_out(
        which in 0..14usize,
        changes in proptest::collection::vec((any::<prop::sample::Index>(), 0..12usize, proptest::sample::select(WORDS)), 1..6),
        json: bool,
    ) {
        let builtin = builtins().nth(which % builtins().count()).unwrap();
        let mut text = builtin.text.to_owned();
        if json {
            let scene = Document::parse(builtin.name, builtin.text).unwrap().scene().unwrap();
            text = carom_scene::to_json(&scene, carom_scene::Detail::Full);
        }
        for (at, out, word) in changes {
            let letters: Vec<char> = text.chars().collect();
            let at = at.index(letters.len() + 1);
            text = letters[..at].iter().chain(word.chars().collect::<Vec<_>>().iter())
                .chain(letters.iter().skip(at + out)).collect();
        }
        try_all(if json { "a.json" } else { "a.toml" }, text.as_bytes());
    }

    #[test]
    fn any_path_and_value(path in "[a-z.\\[\\]0-9\" ]{0,30}", value in "\\PC{0,20}") {
        let mut document = Document::parse("gas", carom_scene::builtin("gas").unwrap()).unwrap();
        if let Err(problems) = document.set(&path, &value) {
            assert!(!problems.to_string().is_empty());
        }
        let _ = document.set_from(&format!("{path}={value}"));
        let _ = document.scene();
    }
}

#[test]
fn deep_long_and_wide_texts_end() {
    let many = 100_000;
    for text in [
        "[".repeat(many),
        "{\"a\":".repeat(many),
        format!("a{} = 1", ".b".repeat(many)),
        format!("[[a{}]]", ".b".repeat(many)),
        format!("x = {}1{}", "[".repeat(many), "]".repeat(many)),
        "\"".repeat(many),
        "'''".repeat(many),
        "a = 1\n".repeat(many),
        "[[body]]\n".repeat(many / 10),
        format!("carom = {}", "9".repeat(many)),
        format!("{{\"carom\": {}}}", "9".repeat(many)),
        (0..many / 10).map(|k| format!("k{k} = {k}\n")).collect(),
    ] {
        for format in [Format::Toml, Format::Json] {
            let told = Document::parse_as("a", &text, format).and_then(|d| d.scene().map(|_| ()));
            assert!(!told.unwrap_err().to_string().is_empty());
        }
    }
}

/// Seen while writing the checks: sizes at the ends of the range of numbers.
#[test]
fn numbers_at_the_ends_of_their_range_are_told_or_placed() {
    for (r, x) in
        [("1e308", "1e308"), ("5e-324", "0"), ("5e-324", "1e308"), ("1e-300", "1e300"), ("1.7e308", "-1.7e308")]
    {
        for kind in ["line", "square", "random", "rack", "hexagonal"] {
            for count in ["count = 3", ""] {
                try_all(
                    "a.toml",
                    format!(
                        "carom = 1\n[world]\ndim = 2\n[[group]]\nkind = \"{kind}\"\n{count}\norigin = [{x}, 0]\nmin = [-1e308, -1]\n\
                         max = [1e308, 1]\nbody = {{ mass = {r}, radius = {r} }}\n[[body]]\nmass = 1\nradius = {r}\n\
                         position = [0, {x}]\n"
                    )
                    .as_bytes(),
                );
            }
        }
    }
}
