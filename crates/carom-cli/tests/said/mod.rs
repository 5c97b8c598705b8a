//! Running the command, and reading what it says.
#![allow(dead_code)] // Every test file uses a part of it.
use assert_cmd::cargo::cargo_bin_cmd;
use serde_json::Value;
use std::process::Output;

/// The command with these arguments (split at blanks) and this standard input.
pub fn carom(line: &str, stdin: &str) -> Output {
    let mut command = cargo_bin_cmd!("carom");
    command.args(line.split_whitespace()).write_stdin(stdin).output().unwrap()
}

/// Its exit code, standard output and standard error.
pub fn ended(line: &str, stdin: &str) -> (i32, String, String) {
    let output = carom(line, stdin);
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// Standard output of a command that ends well.
pub fn said(line: &str, stdin: &str) -> String {
    let (code, out, err) = ended(line, stdin);
    assert_eq!(code, 0, "{line}: {err}");
    out
}

/// What `carom run ... --format json` says of a scene that ends well.
pub fn run(line: &str, stdin: &str) -> Value {
    let out = said(&format!("run {line} --format json"), stdin);
    serde_json::from_str(&out).unwrap()
}

/// The lines of `carom events ... --format json`.
pub fn events(line: &str, stdin: &str) -> Vec<Value> {
    let out = said(&format!("events {line} --format json"), stdin);
    out.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Standard error of a command that is refused.
pub fn refused(line: &str, stdin: &str) -> String {
    let (code, out, err) = ended(line, stdin);
    println!("{line}\n{err}");
    assert_eq!(code, 2, "{line}");
    assert!(out.is_empty() && !err.is_empty() && !err.contains("panicked"), "{line}: {out} {err}");
    err
}

/// All numbers of a value, in order.
pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(all) => all.iter().flat_map(numbers).collect(),
        other => vec![other.as_f64().unwrap_or(f64::NAN)],
    }
}

/// Equal but for some units in the last place of the scale.
pub fn close(got: &Value, want: &[f64], scale: f64) {
    let got = numbers(got);
    assert_eq!(got.len(), want.len(), "{got:?} {want:?}");
    for (g, w) in got.iter().zip(want) {
        assert!((g - w).abs() <= 8.0 * f64::EPSILON * scale, "{got:?} {want:?}");
    }
}

/// The places of these keys in a text, one behind the other.
pub fn in_order(text: &str, keys: &[&str]) {
    let mut at = 0;
    for key in keys {
        let found = text[at..].find(&format!("\"{key}\":"));
        at += found.unwrap_or_else(|| panic!("{key} is missing behind {}", &text[..at])) + 1;
    }
}

/// The keys of an object.
pub fn keys(value: &Value) -> Vec<&str> {
    let mut keys: Vec<&str> = value.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}
