//! Recordings go on after Ctrl-C and after a kill, to the very same digest; shards of a sweep are the whole table.
#![cfg(unix)]
mod said;
use assert_cmd::cargo::cargo_bin_cmd;
use said::{run, said};
use std::process::{Command, Stdio};
use std::time::Duration;

const LENGTH: &str = "--until impacts=400000";

/// Records a gas, and stops it with this signal when the file has at least one keyframe behind the first. Then goes on with it.
fn goes_on_after(signal: &str) {
    let file = format!("{}/resume{signal}.carom", env!("CARGO_TARGET_TMPDIR"));
    let _ = std::fs::remove_file(&file);
    let mut command = Command::new(cargo_bin_cmd!("carom").get_program());
    let line = format!("run gas {LENGTH} -o {file}");
    let mut child = command.args(line.split_whitespace()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    // The first keyframe is some 70 kB; an impact costs about ten bytes, and keyframes are 65,536 impacts apart. A machine so
    // fast that the run is over by then proves nothing, and fails nothing.
    let grown = |file: &str| std::fs::metadata(file).is_ok_and(|m| m.len() > 1_500_000);
    while !grown(&file) && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    let _ = Command::new("kill").args([signal, &child.id().to_string()]).status();
    child.wait().unwrap();
    let resumed = run(&format!("--resume {file}"), "");
    let whole = run(&format!("gas {LENGTH}"), "");
    println!("{signal}: {} {}", resumed["digest"], whole["digest"]);
    assert_eq!(resumed["digest"], whole["digest"]);
    assert_eq!(resumed["impacts"], whole["impacts"]);
    assert_eq!(resumed["audit"]["pass"], true);
}

#[test]
fn a_killed_recording_goes_on() {
    goes_on_after("-KILL");
}

#[test]
fn an_interrupted_recording_goes_on() {
    goes_on_after("-INT");
}

#[test]
fn shards_are_the_whole_table_whatever_the_number_of_threads() {
    let mut scene = said("scenes two-balls", "");
    scene += "\n[sweep]\n\"material.default.restitution\" = { range = [0, 1], steps = 5 }\n\"run.seed\" = { range = [1, 3] }\n";
    let sweep = |arguments: &str| said(&format!("sweep - {arguments}"), &scene);
    let whole = sweep("--jobs 1");
    assert_eq!(whole, sweep("--jobs 3"));
    assert_eq!(whole.lines().count(), 1 + 5 * 3);
    let mut joined = String::new();
    for shard in 1..=4 {
        let part = sweep(&format!("--shard {shard}/4"));
        let rows = part.split_once('\n').unwrap();
        if shard == 1 {
            joined += rows.0;
            joined += "\n";
        }
        joined += rows.1;
    }
    assert_eq!(joined, whole);
}
