//! Ctrl-C: the run stops, and everything is written.
#![cfg(unix)]
use assert_cmd::cargo::cargo_bin_cmd;
use serde_json::Value;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Stdio};

/// Starts a run that would take hours.
fn start(line: &str) -> Child {
    let mut command = Command::new(cargo_bin_cmd!("carom").get_program());
    command.args(line.split_whitespace()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

fn interrupt(child: &Child) {
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
}

#[test]
fn the_whole_report_is_written() {
    let file = format!("{}/interrupted.json", env!("CARGO_TARGET_TMPDIR"));
    let _ = std::fs::remove_file(&file);
    let mut child = start(&format!("run spheres --until impacts=1000000000000 -o {file}"));
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    // The line of t = 0: the run is under way.
    let started = |line: &String| line.split_whitespace().take(2).eq(["0", "0"]);
    assert!(lines.any(|line| started(&line.unwrap())));
    interrupt(&child);
    let rest: Vec<String> = lines.map(Result::unwrap).collect();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let rest = rest.join("\n");
    assert!(rest.contains("interrupted") && rest.contains("PASSED") && rest.contains("Digest"), "{rest}");
    let report: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    assert_eq!(report["stopped"], "interrupted");
    assert_eq!(report["audit"]["pass"], true);
    assert_eq!(report["bodies"].as_array().unwrap().len(), 1000);
}

#[test]
fn no_line_of_events_is_cut() {
    let mut child = start("events spheres --until impacts=1000000000000 --format json");
    let mut out = BufReader::new(child.stdout.take().unwrap());
    let mut all = String::new();
    out.read_line(&mut all).unwrap();
    interrupt(&child);
    out.read_to_string(&mut all).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    for (k, line) in all.lines().enumerate() {
        let line: Value = serde_json::from_str(line).unwrap();
        assert_eq!(line["n"], k + 1);
    }
    assert!(all.ends_with('\n'));
}
