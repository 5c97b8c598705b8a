//! The frame of the command line: `carom` alone, completions, help, and readers that stop reading.
use assert_cmd::cargo::cargo_bin_cmd;
use std::io::Read;
use std::process::Stdio;

#[test]
fn three_commands_worth_trying_and_all_of_them_work() {
    let output = cargo_bin_cmd!("carom").output().unwrap();
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    let commands: Vec<&str> = text.lines().filter_map(|l| l.strip_prefix("  carom ")).collect();
    assert_eq!(commands.len(), 3);
    for command in commands {
        // Some write a picture where they stand.
        let place = env!("CARGO_TARGET_TMPDIR");
        let output = cargo_bin_cmd!("carom").args(command.split(' ')).current_dir(place).output().unwrap();
        assert!(output.status.success() && !output.stdout.is_empty(), "{command}");
    }
}

#[test]
fn the_examples_of_the_help_work() {
    let output = cargo_bin_cmd!("carom").args(["explain", "--help"]).output().unwrap();
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    let examples: Vec<&str> = text.lines().filter_map(|l| l.strip_prefix("  carom ")).collect();
    assert_eq!(examples.len(), 6);
    for example in examples {
        // What it shows stands behind it, after a gap.
        let command = example.split("   ").next().unwrap();
        // Some write a picture where they stand.
        let place = env!("CARGO_TARGET_TMPDIR");
        let output = cargo_bin_cmd!("carom").args(command.split(' ')).current_dir(place).output().unwrap();
        assert!(output.status.success(), "{command}");
    }
}

#[test]
fn completions_for_every_shell() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = cargo_bin_cmd!("carom").args(["completions", shell]).output().unwrap();
        assert!(output.status.success());
        assert!(String::from_utf8(output.stdout).unwrap().contains("explain"), "{shell}");
    }
}

#[test]
fn an_unknown_verb_is_a_usage_error() {
    let output = cargo_bin_cmd!("carom").arg("explian").output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("explain"), "it names the nearest verb");
}

#[test]
fn a_reader_that_stops_is_no_trouble() {
    // The reading end is closed before anything is written: the first write meets a broken pipe.
    let explain = "explain --mass 2 1 --velocity 3 -1";
    // The last two would not end for hours.
    let runs = ["run two-balls --no-picture --format json", "run spheres --until impacts=1000000000000"];
    let events = ["events two-balls", "events gas --until impacts=1000000000000 --format json"];
    for line in
        [explain, "completions bash", "", runs[0], runs[1], events[0], events[1], "check gas", "scenes", "schema"]
    {
        let mut command = std::process::Command::new(cargo_bin_cmd!("carom").get_program());
        command.args(line.split_whitespace()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        drop(child.stdout.take());
        let mut err = String::new();
        child.stderr.take().unwrap().read_to_string(&mut err).unwrap();
        assert!(child.wait().unwrap().success(), "{line}");
        assert_eq!(err, "", "{line}");
    }
}
