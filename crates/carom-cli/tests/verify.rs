//! `carom verify`: the book from the command line.
mod said;
use said::{refused, said};
use serde_json::Value;
use std::collections::BTreeSet;

#[test]
fn json_is_an_array_with_the_keys_of_the_contract() {
    let rows: Vec<Value> = serde_json::from_str(&said("verify galperin --format json", "")).unwrap();
    assert!(rows.len() >= 6);
    let keys = ["error", "expected", "got", "name", "pass", "reference", "tolerance"];
    for row in &rows {
        let own: BTreeSet<&str> = row.as_object().unwrap().keys().map(String::as_str).collect();
        assert_eq!(own, BTreeSet::from(keys));
        let number = |key: &str| row[key].as_f64().unwrap();
        assert_eq!(number("error"), (number("got") - number("expected")).abs());
        assert_eq!(row["pass"], number("error") <= number("tolerance"));
    }
    // Galperin (2003): floor(pi 10^3).
    let k3 = rows.iter().find(|row| row["name"] == "galperin/k-3").unwrap();
    assert_eq!((k3["got"].as_f64(), k3["pass"].as_bool()), (Some(3141.0), Some(true)));
}

#[test]
fn text_and_markdown_say_it_for_people() {
    let text = said("verify two-bodies-1d", "");
    for part in ["Two bodies on a line", "expected", "tolerance", "unequal-half", "-5.375", "PASSED: ", "✓"] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let one = said("verify oblique/3-4-5", "");
    for part in ["reference", "THEORY 1.4, A8", "tolerance", "rounding", "vx[a]"] {
        assert!(one.contains(part), "{part}\n{one}");
    }
    let markdown = said("verify galperin --format markdown", "");
    assert!(markdown.contains("| k-3 | `impacts` | 3141 | 3141 | 0 | 0 | ✓ |"), "{markdown}");
    assert!(said("verify pool --list", "").contains("pool/thirty-degrees-half-full"));
}

#[test]
fn a_name_that_nobody_has_is_refused_with_the_nearest() {
    let error = refused("verify galprin", "");
    assert!(error.contains("`galprin`") && error.contains("galperin"), "{error}");
}

#[test]
fn a_case_that_fails_ends_with_1_and_names_itself() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("own-book");
    std::fs::create_dir_all(&folder).unwrap();
    let text = "title = \"Mine\"\nabout = \"A case that expects what does not happen.\"\n[[case]]\nname = \"wrong\"\nreference = \"nowhere\"\n\
                scene = \"two-balls\"\ntolerance = 1e-12\nbecause = \"rounding\"\ncheck = [[\"vx[A]\", 1], [\"vx[B]\", 2.5]]\n";
    std::fs::write(folder.join("mine.toml"), text).unwrap();
    for format in ["text", "markdown", "json"] {
        let mut command = assert_cmd::Command::cargo_bin("carom").unwrap();
        let out = command.args(["verify", "--format", format, "--book"]).arg(&folder).output().unwrap();
        assert_eq!(out.status.code(), Some(1));
        let said = String::from_utf8(out.stdout).unwrap() + &String::from_utf8(out.stderr).unwrap();
        assert!(said.contains("mine/wrong: vx[B]") && said.contains("2.5"), "{said}");
    }
}
