//! `carom scenes`, `check`, `schema`: the built-in scenes run, and their expanded forms are the same scenes.
mod said;
use said::{refused, run, said};
use serde_json::Value;

fn names() -> Vec<String> {
    let names: Vec<String> =
        said("scenes", "").lines().map(|l| l.split_whitespace().next().unwrap().to_string()).collect();
    assert!(names.len() >= 10);
    names
}

#[test]
fn every_built_in_scene_runs_passes_its_audit_and_expands_to_itself() {
    for name in names() {
        let report = run(&name, "");
        let audit = &report["audit"];
        println!("{name}: {} impacts, {} {}", report["impacts"], report["stopped"], report["digest"]);
        assert_eq!(audit["pass"], true, "{name}");
        assert!(report["impacts"].as_u64().unwrap() > 0 && report["events"].as_u64() >= report["impacts"].as_u64());
        // The numbers of the issue, which are stricter than the audit's limits.
        for account in ["momentum", "energy"] {
            assert!(audit[account]["drift"].as_f64().unwrap() < 1e-12, "{name}: {account}");
        }
        // CONTRACT 3: below 1e-9 in a world without lasting contacts, below 1e-6 with them.
        let deepest = if ["heap", "repose"].contains(&name.as_str()) { 1e-6 } else { 1e-9 };
        assert!(audit["overlap"].as_f64().unwrap() < deepest, "{name}");
        let expanded = said(&format!("check {name} --expand"), "");
        let again = run("-", &expanded);
        assert_eq!(again, report, "{name}");
    }
}

#[test]
fn every_built_in_scene_is_printed_and_is_its_own_file() {
    for name in names() {
        let text = said(&format!("scenes {name}"), "");
        assert!(text.contains("carom = 1") && text.starts_with('#'), "{name}");
        assert!(said("scenes", "").contains(&name));
        assert!(said(&format!("check {name}"), "").starts_with(&format!("{name} is valid.")));
    }
    assert!(refused("scenes cradel", "").contains("`cradle`"));
}

#[test]
fn what_a_scene_says_to_try_can_be_tried() {
    // The lines "Try: carom ..." of the scenes, but for verbs that are not there yet.
    let mut tried = 0;
    for name in names() {
        let text = said(&format!("scenes {name}"), "");
        let comments = text.lines().filter_map(|line| line.strip_prefix('#'));
        for line in comments.filter_map(|line| line.trim().trim_start_matches("Try:").trim().strip_prefix("carom ")) {
            let command = line.split("   ").next().unwrap();
            let verb = command.split(' ').next().unwrap();
            if ["run", "events", "explain", "check"].contains(&verb) && !command.contains("impacts=1000000") {
                println!("carom {command}");
                said(command, "");
                tried += 1;
            }
        }
    }
    assert!(tried >= 5);
}

#[test]
fn check_says_what_would_run() {
    let text = said("check gas", "");
    println!("{text}");
    // 10,000 discs of radius 0.0025 in a unit square: 10^4 pi 0.0025^2 = 0.19635 of it.
    for part in ["10,000", "in the plane", "no gravity", "0.19635", "100,000 impacts", "reflect", "1 kg"] {
        assert!(text.contains(part), "{part}");
    }
    let text = said("check break --until impacts=5 --until time=2 --set run.together=lcp", "");
    assert!(text.contains("at t = 2 s, or after 5 impacts") && text.contains("lcp"));
    // A key without effect is told.
    let scene = said("scenes two-balls", "")
        + "rest_speed = 0.5\n[[group]]\nkind = \"line\"\ncount = 1\nrows = 3\norigin = [5]\nbody = { mass = 1, radius = 0.1 }\n";
    assert!(said("check -", &scene).contains("rows"));
}

#[test]
fn the_operator_of_the_scene_is_the_one_that_runs() {
    // One ball hits four that touch. GR-e sends the last one on; Newton's coefficient at all contacts at once does not.
    let last = |together: &str| {
        let report = run(&format!("cradle --set run.together={together}"), "");
        report["bodies"][4]["velocity"][0].as_f64().unwrap()
    };
    assert!((last("reflect") - 1.0).abs() < 1e-14);
    assert!(last("lcp") < 0.9);
}

#[test]
fn the_schema_is_json() {
    let schema: Value = serde_json::from_str(&said("schema", "")).unwrap();
    assert!(schema["$schema"].as_str().unwrap().contains("json-schema.org"));
    assert!(schema["properties"]["world"].is_object());
}
