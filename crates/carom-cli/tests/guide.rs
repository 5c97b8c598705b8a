//! The commands of the guide run, print what the guide says they print, and its scenes are valid.
//!
//! In a `console` block each line that starts with `$ carom` is run, in a folder that the page has for itself; the lines below it are
//! what it prints, where `...` stands for any lines or, within a line, for anything. A `toml` block whose first line is a comment with
//! a file's name is written under that name; every other `toml` block is read as a part of a scene.
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
                _ => {}
            }
        }
    }
    println!("{run} commands, {scenes} scenes");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(run >= 20 && scenes >= 3);
}

#[test]
fn patterns_can_fail() {
    let lines = ["a", "b 1 c", "d"];
    assert!(fits(&["a", "b ... c", "d"], &lines) && fits(&["...", "d"], &lines) && fits(&["..."], &[]));
    assert!(!fits(&["a", "b ... d", "d"], &lines) && !fits(&["...", "b"], &lines) && !fits(&["a"], &lines));
    assert_eq!(words("carom run x --set 'a b=[1, 2]'"), ["carom", "run", "x", "--set", "a b=[1, 2]"]);
}
