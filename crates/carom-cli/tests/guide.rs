//! The commands of the guide run, print what the guide says they print, and its scenes are valid.
//!
//! In a `console` block each line that starts with `$ carom` is run, in a folder that the page has for itself; the lines below it are
//! what it prints, where `...` stands for any lines or, within a line, for anything. A `toml` block whose first line is a comment with
//! a file's name is written under that name; every other `toml` block is read as a part of a scene. In a block without a language, or
//! of `text`, each line that starts with `carom` is run as well, must succeed, and must write the file behind `-o`; commands of other
//! programs are listed in [`NOT_RUN`].
use assert_cmd::cargo::cargo_bin_cmd;
use std::fs;
use std::path::{Path, PathBuf};

#[path = "../../carom-guide/src/markdown.rs"]
#[allow(dead_code)] // Links are looked at elsewhere.
mod markdown;

fn root() -> PathBuf {
    fs::canonicalize(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")).unwrap()
}

/// The arguments of a command line, with the quotes that a shell would take away.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut word, mut quote, mut any) = (Vec::new(), String::new(), None, false);
    for c in line.chars() {
        match (quote, c) {
            (Some(q), c) if c == q => quote = None,
            (None, '\'' | '"') => (quote, any) = (Some(c), true),
            (None, ' ') if word.is_empty() && !any => {}
            (None, ' ') => {
                words.push(std::mem::take(&mut word));
                any = false;
            }
            _ => word.push(c),
        }
    }
    if !word.is_empty() || any {
        words.push(word);
    }
    words
}

/// True if the line is as the pattern says, in which `...` stands for anything.
fn line_fits(pattern: &str, line: &str) -> bool {
    match pattern.trim_end().split_once("...") {
        None => pattern.trim_end() == line.trim_end(),
        Some((start, end)) => {
            let line = line.trim_end();
            line.len() >= start.len() + end.len() && line.starts_with(start) && line.ends_with(end)
        }
    }
}

/// True if the lines are as the patterns say, in which a line `...` stands for any lines.
fn fits(patterns: &[&str], lines: &[&str]) -> bool {
    match patterns.split_first() {
        None => lines.is_empty(),
        Some((&"...", rest)) => (0..=lines.len()).any(|skip| fits(rest, &lines[skip..])),
        Some((first, rest)) => {
            lines.split_first().is_some_and(|(line, left)| line_fits(first, line) && fits(rest, left))
        }
    }
}

/// A command of the guide, and what it is to print.
struct Command {
    line: usize,
    words: Vec<String>,
    shows: Vec<String>,
}

fn commands(block: &markdown::Block) -> Vec<Command> {
    let mut found: Vec<Command> = Vec::new();
    for (k, text) in block.text.lines().enumerate() {
        if let Some(command) = text.strip_prefix("$ ") {
            let words = words(command.split("  #").next().unwrap());
            found.push(Command { line: block.line + k + 1, words, shows: Vec::new() });
        } else if let Some(last) = found.last_mut() {
            last.shows.push(text.into());
        }
    }
    found
}

/// What stands in the guide and is not run here, by how it begins, and why.
const NOT_RUN: &[(&str, &str)] = &[
    ("./test", "this is it"),
    ("cargo run -p carom --example tour", "crates/carom-guide runs all twelve"),
    ("cargo run --release -p carom-cli", "it builds the program that runs here"),
    ("cargo run --release -p carom-bench", "it builds for speed, and takes its time: a measurement"),
    ("cargo bench", "it builds for speed, and takes its time: a measurement"),
    ("carom bench", "a measurement: in a build that checks itself it says nothing"),
    ("carom plot gas --what speed", "its hundred thousand impacts take too long in a build that checks itself"),
    ("cargo install", "it changes the machine"),
    ("cargo new", "a project of the reader's"),
    ("cargo add", "a project of the reader's"),
    ("lab/build", "it needs Node; lab/test runs it"),
    ("tools/", "each says in its first lines what it needs; ./test runs tools/instructions"),
    ("compare/", "it builds three other engines"),
];

/// The commands of a block that shows no output, with their lines: what starts with `carom`, or is known not to be run. The first
/// word of what else looks like a command is an error.
fn bare(block: &markdown::Block) -> Vec<Result<Command, String>> {
    let program = |line: &str| {
        let first = line.split(' ').next().unwrap_or("");
        let known = ["carom", "cargo", "./test"].contains(&first);
        known || ["lab/", "tools/", "compare/", "guide/"].iter().any(|f| first.starts_with(f) && !first.contains('.'))
    };
    let mut found = Vec::new();
    for (k, text) in block.text.lines().enumerate().filter(|(_, text)| program(text)) {
        let line = block.line + k + 1;
        if NOT_RUN.iter().any(|(start, _)| text.starts_with(start)) {
            continue;
        }
        let words = words(text.split("  #").next().unwrap());
        found.push(match words[0].as_str() {
            "carom" => Ok(Command { line, words, shows: Vec::new() }),
            _ => Err(format!("{line}: `{text}` is neither run nor said why not")),
        });
    }
    found
}

/// Runs a command that shows no output; whatever it is to write has to be there then.
fn writes(folder: &Path, command: &Command) -> Result<(), String> {
    let file = command.words.iter().position(|w| w == "-o").map(|k| folder.join(&command.words[k + 1]));
    if let Some(file) = &file {
        fs::create_dir_all(file.parent().unwrap()).unwrap();
    }
    let told = cargo_bin_cmd!("carom").current_dir(folder).args(&command.words[1..]).output().unwrap();
    if !told.status.success() {
        return Err(String::from_utf8_lossy(&told.stderr).into_owned());
    }
    match file {
        Some(file) if fs::metadata(&file).map_or(0, |m| m.len()) == 0 => Err(format!("{} is missing", file.display())),
        None if told.stdout.is_empty() => Err("it prints nothing".into()),
        _ => Ok(()),
    }
}

/// A scene around a part of one.
fn completed(part: &str) -> String {
    let mut scene = String::from("carom = 1\n");
    scene += part;
    if !part.contains("[world]") {
        scene += "\n[world]\ndim = 2\n";
    }
    if !part.contains("[run]") {
        scene += "\n[run]\nuntil = { time = 1.0 }\n";
    }
    scene
}

#[test]
fn what_the_guide_shows_happens() {
    let guide = root().join("guide");
    let mut pages = markdown::pages(&guide);
    pages.push(root().join("README.md"));
    let (mut run, mut scenes, mut wrong) = (0, 0, Vec::new());
    for path in pages {
        let name = path.strip_prefix(root()).unwrap().display().to_string();
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("guide-{}", name.replace(['/', '.'], "-")));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        for block in markdown::blocks(&fs::read_to_string(&path).unwrap()) {
            match block.language.as_str() {
                // Cases of the verification book have keys of their own, and are read by `carom verify`.
                "toml" if block.text.contains("[[case]]") => {}
                "toml" => {
                    let title = block.text.lines().next().unwrap_or("");
                    let file = title.strip_prefix("# ").filter(|f| f.ends_with(".toml") && !f.contains(' '));
                    let whole = block.text.contains("carom = 1");
                    let text = if whole { block.text.clone() } else { completed(&block.text) };
                    let at = folder.join(file.unwrap_or("a-block.toml"));
                    fs::write(&at, text).unwrap();
                    scenes += 1;
                    // What is written under a name is shown in a command, mistakes and all.
                    if file.is_none() {
                        let mut check = cargo_bin_cmd!("carom");
                        let told = check.current_dir(&folder).arg("check").arg(&at).output().unwrap();
                        if !told.status.success() {
                            wrong.push(format!("{name}:{}: {}", block.line, String::from_utf8_lossy(&told.stderr)));
                        }
                    }
                }
                "console" => {
                    for command in commands(&block) {
                        if command.words.first().map(String::as_str) != Some("carom") {
                            wrong.push(format!("{name}:{}: a console block runs carom and nothing else", command.line));
                            continue;
                        }
                        let told = cargo_bin_cmd!("carom")
                            .current_dir(&folder)
                            .env("COLUMNS", "80")
                            .args(&command.words[1..])
                            .output()
                            .unwrap();
                        let (out, err) =
                            (String::from_utf8(told.stdout).unwrap(), String::from_utf8(told.stderr).unwrap());
                        let shown = if told.status.success() { &out } else { &err };
                        let lines: Vec<&str> = shown.trim_end().lines().collect();
                        let patterns: Vec<&str> = command.shows.iter().map(String::as_str).collect();
                        let mistake = command.shows.iter().any(|line| line.contains(": error: "));
                        if told.status.success() == mistake || !fits(&patterns, &lines) {
                            wrong.push(format!("{name}:{}: {:?}\n{out}{err}", command.line, command.words));
                        }
                        run += 1;
                    }
                }
                "" | "text" => {
                    for command in bare(&block) {
                        let told = command.map_err(|e| (block.line, e)).and_then(|command| {
                            run += 1;
                            writes(&folder, &command).map_err(|e| (command.line, format!("{:?}\n{e}", command.words)))
                        });
                        if let Err((line, what)) = told {
                            wrong.push(format!("{name}:{line}: {what}"));
                        }
                    }
                }
                _ => {}
            }
        }
    }
    println!("{run} commands, {scenes} scenes");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(run >= 30 && scenes >= 3);
}

#[test]
fn patterns_can_fail() {
    let lines = ["a", "b 1 c", "d"];
    assert!(fits(&["a", "b ... c", "d"], &lines) && fits(&["...", "d"], &lines) && fits(&["..."], &[]));
    assert!(!fits(&["a", "b ... d", "d"], &lines) && !fits(&["...", "b"], &lines) && !fits(&["a"], &lines));
    let block = |text: &str| markdown::Block { line: 1, language: String::new(), text: text.into() };
    assert!(
        bare(&block("lab/run something")).pop().unwrap().is_err() && bare(&block("lab/build\nHow it is\n")).is_empty()
    );
    let command = |text: &str| bare(&block(text)).pop().unwrap().unwrap();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    assert!(writes(folder, &command("carom render no-such-scene -o x.svg")).is_err());
    assert!(writes(folder, &command("carom scenes")).is_ok());
    assert_eq!(words("carom run x --set 'a b=[1, 2]'"), ["carom", "run", "x", "--set", "a b=[1, 2]"]);
}
