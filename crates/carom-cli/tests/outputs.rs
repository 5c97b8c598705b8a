//! Files that a run writes.
mod said;
use assert_cmd::cargo::cargo_bin_cmd;
use said::{events, run, said};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

/// A folder of its own for a test, empty.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn carom_in(folder: &Path, line: &str, stdin: &str) -> Output {
    let mut command = cargo_bin_cmd!("carom");
    command.current_dir(folder).args(line.split_whitespace()).write_stdin(stdin).output().unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let mut all: Vec<String> =
        fs::read_dir(folder).unwrap().map(|f| f.unwrap().file_name().into_string().unwrap()).collect();
    all.sort();
    all
}

/// The cells of a table whose names hold no commas.
fn table(text: &str) -> Vec<Vec<&str>> {
    text.lines().map(|line| line.split(',').collect()).collect()
}

#[test]
fn the_impacts_as_a_table_and_as_lines_and_the_run_as_an_object() {
    let folder = folder("outputs");
    let output = carom_in(&folder, "run wall -o a.csv -o b.jsonl -o c.JSON", "");
    assert!(output.status.success(), "{output:?}");
    assert_eq!(names(&folder), ["a.csv", "b.jsonl", "c.JSON"]);
    let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();

    let report: Value = serde_json::from_str(&read("c.JSON")).unwrap();
    assert_eq!(report, run("wall", ""));
    let lines: Vec<Value> = read("b.jsonl").lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    assert_eq!(lines, events("wall", ""));
    assert_eq!(read("a.csv"), said("events wall --format csv", ""));

    let text = read("a.csv");
    let rows = table(&text);
    assert_eq!(rows.len(), 1 + lines.len());
    let cell = |name: &str| rows[1][rows[0].iter().position(|head| *head == name).expect(name)];
    assert_eq!((cell("first"), cell("second")), ("ball", "wall:floor"));
    for (head, value) in [
        ("n", &lines[0]["n"]),
        ("time", &lines[0]["time"]),
        ("point_y", &lines[0]["point"][1]),
        ("normal_y", &lines[0]["normal"][1]),
        ("impulse", &lines[0]["impulse"]),
        ("first_before_velocity_x", &lines[0]["before"][0]["velocity"][0]),
        ("first_after_velocity_y", &lines[0]["after"][0]["velocity"][1]),
        ("second_after_spin", &lines[0]["after"][1]["spin"][0]),
        ("lost", &lines[0]["lost"]),
        ("together", &lines[0]["together"]),
    ] {
        // The very same numbers.
        assert_eq!(cell(head).parse::<f64>().unwrap(), value.as_f64().unwrap(), "{head}");
    }
}

#[test]
fn all_rows_have_all_cells_in_every_dimension() {
    for scene in ["two-balls", "break", "spheres --until impacts=50"] {
        let text = said(&format!("events {scene} --format csv"), "");
        let rows = table(&text);
        assert!(rows.len() > 1 && rows.iter().all(|row| row.len() == rows[0].len()), "{scene}");
        assert_eq!(rows.len() - 1, events(scene, "").len());
    }
}

#[test]
fn bodies_on_the_way_at_equal_steps() {
    let folder = folder("every");
    let scene = said("scenes wall", "")
        + "[[output]]\npath = \"path.csv\"\nevery = { time = 0.3 }\n[[output]]\npath = \"path.jsonl\"\nevery = { time = 0.75 }\n";
    let output = carom_in(&folder, "run - --format json", &scene);
    assert!(output.status.success(), "{output:?}");
    // Stopping the clock changes nothing.
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report, run("wall", ""));
    let text = fs::read_to_string(folder.join("path.csv")).unwrap();
    let rows = table(&text);
    assert_eq!(rows[0], ["time", "name", "position_x", "position_y", "velocity_x", "velocity_y", "spin"]);
    assert_eq!(rows.len(), 1 + 11, "0, 0.3, ... 3");
    for (k, row) in rows[1..].iter().enumerate() {
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        let t = 0.3 * k as f64;
        assert!((number(0) - t).abs() < 1e-12);
        // x = -1 + t; y falls by 1 m/s for a second, then rises by e = 1/2.
        assert!((number(2) - (t - 1.0)).abs() < 1e-12);
        let y = if t < 1.0 { 1.1 - t } else { 0.1 + 0.5 * (t - 1.0) };
        assert!((number(3) - y).abs() < 1e-12, "{row:?}");
    }
    let text = fs::read_to_string(folder.join("path.jsonl")).unwrap();
    let times: Vec<f64> =
        text.lines().map(|l| serde_json::from_str::<Value>(l).unwrap()["time"].as_f64().unwrap()).collect();
    assert_eq!(times, [0.0, 0.75, 1.5, 2.25, 3.0]);
}

#[test]
fn looking_on_the_way_does_not_move_the_end_of_a_run_without_a_time() {
    let folder = folder("no-time");
    let scene = said("scenes two-balls", "").replace("until = { time = 1.0 }", "")
        + "[[output]]\npath = \"path.csv\"\nevery = { time = 0.1 }\n";
    let output = carom_in(&folder, "run - --format json", &scene);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!((report["time"].as_f64().unwrap() - 0.45).abs() < 1e-15, "the last impact");
    assert_eq!((&report["stopped"], &report["impacts"]), (&"quiet".into(), &1.into()));
    assert_eq!(fs::read_to_string(folder.join("path.csv")).unwrap().lines().count(), 1 + 2 * 5);
}

#[test]
fn what_cannot_be_written_is_told_and_nothing_half_written_is_left() {
    let folder = folder("unwritten");
    fs::create_dir(folder.join("taken.csv")).unwrap();
    for (line, says) in [
        ("-o no/such/folder/x.csv", "no/such/folder/x.csv"),
        ("-o taken.csv", "folder"),
        ("-o a.csv -o a.csv", "twice"),
        ("-o fine.csv -o no/such/folder/x.json", "x.json"),
    ] {
        let output = carom_in(&folder, &format!("run two-balls {line}"), "");
        let err = String::from_utf8(output.stderr).unwrap();
        println!("{err}");
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(err.contains(says), "{line}");
        assert_eq!(names(&folder), ["taken.csv"], "{line}");
    }
    let scene = said("scenes wall", "") + "[[output]]\npath = \"run.json\"\nevery = { time = 0.3 }\n";
    let output = carom_in(&folder, "run -", &scene);
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(err.contains("<stdin>:") && err.contains("every"), "{err}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let folder = folder("full");
    std::os::unix::fs::symlink("/dev/full", folder.join("full.jsonl")).unwrap();
    let output = carom_in(&folder, "run gas --until impacts=2000 -o full.jsonl", "");
    assert_eq!(output.status.code(), Some(2));
    let err = String::from_utf8(output.stderr).unwrap();
    assert!(err.contains("cannot write full.jsonl"), "{err}");
    assert_eq!(names(&folder), ["full.jsonl"]);
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let mut command = std::process::Command::new(cargo_bin_cmd!("carom").get_program());
    let output = command.args(["run", "two-balls"]).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("cannot write to standard output"));
}

#[test]
fn a_file_that_is_there_is_replaced() {
    let folder = folder("replaced");
    fs::write(folder.join("a.json"), "what was there").unwrap();
    assert!(carom_in(&folder, "run two-balls -o a.json", "").status.success());
    let report: Value = serde_json::from_str(&fs::read_to_string(folder.join("a.json")).unwrap()).unwrap();
    assert_eq!(report["impacts"], 1);
}
