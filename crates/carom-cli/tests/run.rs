//! `carom run`: numbers from formulas, what ends a run, and the object that programs read.
mod said;
use said::{close, ended, events, in_order, keys, refused, run, said};
use serde_json::{Value, json};

/// Two balls of 1 kg and radius 1/4 whose surfaces are 1 m apart and close at 2 m/s: they meet after half a second, and all
/// numbers are sums of powers of two.
const HALF: &str = r#"
carom = 1
title = "half a second"
[world]
dim = 1
[[body]]
name = "A"
mass = 1.0
radius = 0.25
position = [-0.75]
velocity = [1.0]
[[body]]
name = "B"
mass = 1.0
radius = 0.25
position = [0.75]
velocity = [-1.0]
"#;

#[test]
fn the_two_balls_of_the_lecture() {
    // m1 v1 + m2 v2 = 5 and v2' - v1' = e (v1 - v2) = 2: v1' = 1, v2' = 3. The gap of 1.8 m closes at 4 m/s.
    let report = run("two-balls", "");
    println!("{report:#}");
    assert_eq!(report["title"], "Two balls on a line");
    assert_eq!((&report["dim"], &report["seed"]), (&json!(1), &json!(1)));
    assert_eq!((&report["impacts"], &report["time"], &report["stopped"]), (&json!(1), &json!(1.0), &json!("quiet")));
    let bodies = report["bodies"].as_array().unwrap();
    assert_eq!(bodies.len(), 2);
    close(&bodies[0]["velocity"], &[1.0], 1.0);
    close(&bodies[1]["velocity"], &[3.0], 1.0);
    // At 0.45 s A is at 0.35 and B at 0.55, for another 0.55 s.
    close(&bodies[0]["position"], &[0.35 + 0.55], 1.0);
    close(&bodies[1]["position"], &[0.55 + 3.0 * 0.55], 2.0);
    let audit = &report["audit"];
    close(&audit["momentum"]["start"], &[5.0], 1.0);
    close(&audit["momentum"]["end"], &[5.0], 1.0);
    close(&audit["momentum"]["given"], &[0.0], 1.0);
    for (key, joules) in
        [("start", 9.5), ("end", 5.5), ("kinetic", 5.5), ("potential", 0.0), ("lost", 4.0), ("work", 0.0)]
    {
        close(&audit["energy"][key], &[joules], 10.0);
    }
    assert_eq!((&audit["pass"], &audit["capped"]), (&json!(true), &json!(0)));

    let lines = events("two-balls", "");
    assert_eq!(lines.len(), 1);
    let x = &lines[0];
    assert_eq!((&x["n"], &x["bodies"], &x["together"]), (&json!(1), &json!(["A", "B"]), &json!(1)));
    for (key, want) in
        [("time", 0.45), ("approach", 4.0), ("departure", 2.0), ("restitution", 0.5), ("impulse", 4.0), ("lost", 4.0)]
    {
        close(&x[key], &[want], 4.0);
    }
    close(&x["point"], &[0.45], 1.0);
    close(&x["normal"], &[1.0], 1.0);
    close(&x["before"][0]["velocity"], &[3.0], 1.0);
    close(&x["before"][1]["velocity"], &[-1.0], 1.0);
    close(&x["after"][0]["velocity"], &[1.0], 1.0);
    close(&x["after"][1]["velocity"], &[3.0], 1.0);
}

#[test]
fn one_object_with_the_keys_of_the_format_in_their_order() {
    let out = said("run wall --format json", "");
    let report: Value = serde_json::from_str(&out).unwrap();
    assert!(out.starts_with('{') && out.ends_with("}\n"));
    let top = ["carom", "title", "dim", "seed", "stopped", "time", "impacts", "events", "bodies", "audit", "digest"];
    in_order(&out, &top);
    assert_eq!(report.as_object().unwrap().len(), top.len());
    let body = ["name", "mass", "radius", "position", "velocity", "spin", "state"];
    in_order(&out, &body);
    assert_eq!(report["bodies"][0].as_object().unwrap().len(), body.len());
    let audit = ["momentum", "angular_momentum", "energy", "overlap", "capped", "pass"];
    in_order(&out, &audit);
    assert_eq!(report["audit"].as_object().unwrap().len(), audit.len());
    for account in ["momentum", "angular_momentum"] {
        assert_eq!(keys(&report["audit"][account]), ["drift", "end", "given", "start"]);
    }
    assert_eq!(keys(&report["audit"]["energy"]), ["drift", "end", "kinetic", "lost", "potential", "start", "work"]);
    in_order(&out, &["energy", "start", "end", "kinetic", "potential", "lost", "work", "drift", "overlap"]);
    let digest = report["digest"].as_str().unwrap();
    assert!(digest.len() == 16 && digest.bytes().all(|b| b.is_ascii_hexdigit()));
    assert_eq!(report["carom"], env!("CARGO_PKG_VERSION"));
}

#[test]
fn lines_of_events_have_the_keys_of_the_format_in_their_order() {
    let names = [
        "n",
        "time",
        "bodies",
        "point",
        "normal",
        "approach",
        "departure",
        "restitution",
        "impulse",
        "friction_impulse",
        "before",
        "after",
        "lost",
        "together",
    ];
    for (scene, dim, spins) in [("two-balls", 1, 0), ("wall", 2, 1), ("spheres --until impacts=1", 3, 3)] {
        let out = said(&format!("events {scene} --format json"), "");
        let line = out.lines().next().unwrap();
        in_order(line, &names);
        let x: Value = serde_json::from_str(line).unwrap();
        assert_eq!(x.as_object().unwrap().len(), names.len());
        for key in ["point", "normal", "friction_impulse"] {
            assert_eq!(x[key].as_array().unwrap().len(), dim, "{key}");
        }
        for (when, side) in [("before", 0), ("before", 1), ("after", 0), ("after", 1)] {
            assert_eq!(keys(&x[when][side]), ["spin", "velocity"]);
            assert_eq!(x[when][side]["velocity"].as_array().unwrap().len(), dim);
            assert_eq!(x[when][side]["spin"].as_array().unwrap().len(), spins, "of a wall, too");
        }
    }
}

#[test]
fn spins_and_angular_momentum_are_empty_on_a_line_and_null_in_a_periodic_world() {
    let line = run("two-balls", "");
    assert_eq!(line["bodies"][0]["spin"], json!([]));
    let angular = &line["audit"]["angular_momentum"];
    assert_eq!((&angular["start"], &angular["end"], &angular["given"]), (&json!([]), &json!([]), &json!([])));
    let periodic = run("spheres --until impacts=10", "");
    assert_eq!(periodic["audit"]["angular_momentum"], Value::Null);
    let partly = r#"carom = 1
        [world]
        dim = 2
        boundary = { kind = "box", min = [0.0, 0.0], max = [1.0, 1.0], periodic = ["x"] }
        [[body]]
        mass = 1.0
        radius = 0.1
        position = [0.5, 0.5]
        velocity = [1.0, 1.0]
        [run]
        until = { time = 1.0 }"#;
    assert_eq!(run("-", partly)["audit"]["angular_momentum"], Value::Null);
    // Up 0.4, then down 0.6 and up again by nothing: 0.5 + 0.4 - 0.6.
    close(&run("-", partly)["bodies"][0]["position"], &[0.5, 0.3], 1.0);
}

#[test]
fn an_impact_exactly_at_the_end_still_happens() {
    let report = run("- --until time=0.5", HALF);
    assert_eq!((&report["impacts"], &report["time"]), (&json!(1), &json!(0.5)));
    assert_eq!(report["bodies"][0]["velocity"], json!([-1.0]));
    assert_eq!(report["stopped"], "quiet", "now nothing can meet any more");
    let report = run("- --until time=0.4999999999", HALF);
    assert_eq!((&report["impacts"], &report["stopped"]), (&json!(0), &json!("time")));
}

#[test]
fn quiet_is_noticed_with_and_without_a_time() {
    // Without: the time is that of the last impact.
    let report = run("-", HALF);
    assert_eq!((&report["time"], &report["stopped"], &report["impacts"]), (&json!(0.5), &json!("quiet"), &json!(1)));
    // With: the bodies coast to it.
    let report = run("- --until time=2.0", HALF);
    assert_eq!((&report["time"], &report["stopped"]), (&json!(2.0), &json!("quiet")));
    assert_eq!(report["bodies"][0]["position"], json!([-0.25 - 1.5]));
    // More impacts than there can be.
    let report = run("- --until impacts=7", HALF);
    assert_eq!((&report["time"], &report["stopped"], &report["impacts"]), (&json!(0.5), &json!("quiet"), &json!(1)));
    // From the start on.
    let report = run("- --set body.A.velocity=[-1] --set body.B.velocity=[1]", HALF);
    assert_eq!((&report["time"], &report["stopped"], &report["impacts"]), (&json!(0.0), &json!("quiet"), &json!(0)));
}

#[test]
fn touching_at_the_start_is_an_impact_only_where_it_closes() {
    let touching = "- --until time=1 --set body.A.position=[-0.25] --set body.B.position=[0.25]";
    let lines = events(touching, HALF);
    assert_eq!(lines.len(), 1);
    assert_eq!(lines[0]["time"], json!(0.0));
    let apart = format!("{touching} --set body.A.velocity=[-1] --set body.B.velocity=[1]");
    assert_eq!(run(&apart, HALF)["impacts"], 0);
    let still = format!("{touching} --set body.A.velocity=[0] --set body.B.velocity=[0]");
    assert_eq!(run(&still, HALF)["impacts"], 0);
    let along = format!("{touching} --set body.A.velocity=[1] --set body.B.velocity=[1]");
    assert_eq!(run(&along, HALF)["impacts"], 0);
    // At t = 0 of a run of no length, too.
    assert_eq!(run(&touching.replace("time=1", "time=0"), HALF)["impacts"], 1);
}

#[test]
fn a_number_of_impacts_never_splits_an_instant() {
    // Two pairs, far apart, at the same half of a second.
    let far = HALF.to_string()
        + &HALF[HALF.find("[[body]]").unwrap()..]
            .replace("\"A\"", "\"C\"")
            .replace("\"B\"", "\"D\"")
            .replace("-0.75", "99.25")
            .replace("[0.75]", "[100.75]");
    let report = run("- --until impacts=1", &far);
    assert_eq!((&report["impacts"], &report["time"], &report["stopped"]), (&json!(2), &json!(0.5), &json!("impacts")));
    let times: Vec<Value> = events("- --until impacts=1", &far).iter().map(|x| x["time"].clone()).collect();
    assert_eq!(times, [json!(0.5), json!(0.5)]);
    // The cradle's four contacts are one instant.
    assert_eq!(run("cradle --until impacts=1", "")["impacts"], events("cradle", "").len());
    assert_eq!(run("cradle --until impacts=1", "")["stopped"], "impacts");
}

#[test]
fn rest_ends_a_run_at_its_instant() {
    let report = run("drop", "");
    assert_eq!(report["stopped"], "rest");
    assert!(report["bodies"].as_array().unwrap().iter().all(|b| b["state"] == "resting"));
    let last = events("drop", "").last().unwrap()["time"].clone();
    assert_eq!(report["time"], last, "the impact that ended in rest");
    // Without `rest` the bodies lie there until the time is up, and a world with a resting body is never quiet.
    let report = run("drop --until time=20", "");
    assert_eq!((&report["stopped"], &report["time"]), (&json!("time"), &json!(20.0)));
    // A floor that takes all: at rest with the first impact, sqrt(2 h / g) after the start.
    let clay = "bounce --set run.rest_speed=0.01 --set material.default.restitution=0 --until time=9 --until rest=true";
    let report = run(clay, "");
    assert_eq!((&report["stopped"], &report["impacts"]), (&json!("rest"), &json!(1)));
    close(&report["time"], &[(2.0 / 9.81f64).sqrt()], 1.0);
}

#[test]
fn a_ball_bounces_at_the_times_of_the_closed_form() {
    // From h = 1 m: t1 = sqrt(2 h / g), then flights of 2 e^k v / g. The contract of the issue: to 1e-11 s.
    let (g, e) = (9.81f64, 0.9f64);
    let first = (2.0 / g).sqrt();
    let v = (2.0 * g).sqrt();
    let mut time = first;
    for (k, line) in events("bounce", "").iter().enumerate() {
        assert!((line["time"].as_f64().unwrap() - time).abs() < 1e-11, "{k}: {} {time}", line["time"]);
        close(&line["approach"], &[v * e.powi(k as i32)], 100.0);
        assert_eq!(line["bodies"], json!(["ball", "wall:floor"]));
        time += 2.0 * v * e.powi(k as i32 + 1) / g;
    }
    assert!(time > 8.0, "the next one comes after the end");
}

#[test]
fn a_piston_does_work() {
    // 1 kg at 2 m/s against a wall coming at 3 m/s: u = 5, J = 2 m u = 10, v = -8. K from 2 to 32 J: 30 J of work.
    let scene = r#"carom = 1
        [world]
        dim = 1
        [[wall]]
        name = "piston"
        plane = { point = [2.0], normal = [-1.0] }
        velocity = [-3.0]
        [[body]]
        mass = 1.0
        radius = 0.5
        position = [0.0]
        velocity = [2.0]
        [run]
        until = { time = 1.0 }"#;
    let report = run("-", scene);
    close(&report["bodies"][0]["velocity"], &[-8.0], 8.0);
    let audit = &report["audit"];
    close(&audit["momentum"]["given"], &[-10.0], 10.0);
    for (key, joules) in [("start", 2.0), ("end", 32.0), ("work", 30.0), ("lost", 0.0)] {
        close(&audit["energy"][key], &[joules], 32.0);
    }
    let line = &events("-", scene)[0];
    assert_eq!(line["bodies"], json!(["body-1", "wall:piston"]));
    close(&line["after"][1]["velocity"], &[-3.0], 1.0);
    close(&line["impulse"], &[10.0], 10.0);
    close(&line["time"], &[1.5 / 5.0], 1.0);
}

#[test]
fn galperins_blocks_count_the_digits_of_pi() {
    for (mass, digits) in [("1", 3), ("100", 31), ("1e4", 314), ("1e6", 3141)] {
        let report = run(&format!("pi --set body.heavy.mass={mass}"), "");
        assert_eq!((&report["impacts"], &report["stopped"]), (&json!(digits), &json!("quiet")));
        assert_eq!(report["time"], 1000.0);
    }
    let last = events("pi", "").last().unwrap()["n"].clone();
    assert_eq!(last, 3141);
}

#[test]
fn fixed_bodies_have_no_mass_unless_they_are_given_one() {
    let scene = HALF.replace("name = \"B\"\nmass = 1.0", "name = \"B\"\nfixed = true");
    let report = run("- --until time=1.0 --set body.B.velocity=[0]", &scene);
    assert_eq!((&report["bodies"][1]["mass"], &report["bodies"][1]["state"]), (&Value::Null, &json!("fixed")));
    assert_eq!(report["bodies"][0]["velocity"], json!([-1.0]));
    let report = run("- --until time=1.0 --set body.B.velocity=[0] --set body.B.mass=7", &scene);
    assert_eq!((&report["bodies"][1]["mass"], &report["bodies"][1]["state"]), (&json!(7.0), &json!("fixed")));
}

#[test]
fn set_and_until_change_the_scene() {
    let elastic = run("two-balls --set material.default.restitution=1", "");
    // v1' = v1 - 2 (m2 / M) (v1 - v2) = 3 - 8/3, v2' = -1 + 16/3.
    close(&elastic["bodies"][0]["velocity"], &[3.0 - 8.0 / 3.0], 4.0);
    close(&elastic["bodies"][1]["velocity"], &[16.0 / 3.0 - 1.0], 4.0);
    assert_eq!(run("two-balls --set run.seed=9 --set title=mine", "")["title"], "mine");
    let first = run("piston --until impacts=100 --until time=50", "");
    assert_eq!(first["stopped"], "impacts", "the first that holds");
    assert_eq!(run("piston --until time=0.001", "")["stopped"], "time");
    assert_eq!(run("piston --until time=0.1 --threads 4", "")["digest"], run("piston --until time=0.1", "")["digest"]);
    for (line, rule) in [
        ("two-balls --set", "--set"),
        ("two-balls --set body.A", "path=value"),
        ("two-balls --set body.C.mass=1", "C"),
        ("two-balls --set body.A.mass=-1", "must be positive"),
        ("two-balls --until time=never", "finite"),
        ("two-balls --until impacts=1.5", "whole number"),
        ("two-balls --until sometime=1", "time=SECONDS"),
        ("bounce --until rest=true", "time or impacts"),
        ("two-balls --threads 0", "threads"),
    ] {
        assert!(refused(&format!("run {line}"), "").contains(rule), "{line}: {rule}");
    }
}

#[test]
fn json_and_toml_on_standard_input() {
    let toml = said("scenes two-balls", "");
    let as_json = r#" { "carom": 1, "title": "Two balls on a line", "world": { "dim": 1 },
        "material": { "default": { "restitution": 0.5 } },
        "body": [ { "name": "A", "mass": 2, "radius": 0.1, "position": [-1], "velocity": [3] },
                  { "name": "B", "mass": 1, "radius": 0.1, "position": [1], "velocity": [-1] } ],
        "run": { "until": { "time": 1 } } }"#;
    let want = run("two-balls", "");
    assert_eq!(run("-", &toml), want);
    assert_eq!(run("-", as_json), want);
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    for (scene, place, rule) in [
        ("carom = 1\n[world]\ndim = 4\n", "<stdin>:3:7", "1, 2 or 3"),
        ("carom = 1\n[world]\ndim = 1\n[run]\nuntill = { time = 1 }\n", "<stdin>:5:1", "until"),
        ("carom = 1\n[world\n", "<stdin>:2:", "]"),
        ("{ \"carom\": 1, \"world\": { \"dim\": 1, } }", "<stdin>:1:", ""),
        ("", "<stdin>:1:1", "carom"),
    ] {
        for verb in ["run", "events", "check"] {
            let err = refused(&format!("{verb} -"), scene);
            assert!(err.contains(place) && err.contains(rule), "{place} {rule}");
        }
    }
    for verb in ["run", "events", "check"] {
        assert!(refused(&format!("{verb} two-bals"), "").contains("`two-balls`"));
        assert!(refused(&format!("{verb} no/such/file.toml"), "").contains("no/such/file.toml"));
        assert!(refused(&format!("{verb} game.carom"), "").contains(".carom"));
        refused(verb, "");
    }
    assert!(refused("run two-balls -o film.xyz", "").contains("unknown extension"));
}

#[test]
fn text_has_a_picture_a_log_the_impacts_and_the_audit() {
    let (code, out, err) = ended("run two-balls", "");
    println!("{out}");
    assert_eq!(code, 0);
    for part in ["Two balls on a line", "time downwards", "A - B", "PASSED", "Ended at t = 1 s", "Digest"] {
        assert!(out.contains(part), "{part}");
    }
    assert!(!out.contains('\x1b') && !err.contains('\x1b'), "no colours where there is no terminal");
    assert!(out.lines().all(|line| line.chars().count() <= 80));
    assert!(!said("run two-balls --no-picture", "").contains("time downwards"));
    // The time it took is no part of what was found out.
    assert_eq!(out, said("run two-balls", ""));
    let many = said("run pi", "");
    assert!(many.contains("3,141 impacts") && many.contains("hardest"));
    assert!(many.lines().count() < 50, "a summary");
}

#[test]
fn a_run_stops_itself_where_a_body_has_no_room_left() {
    // A driven wall closes in on a ball before a wall. Half of the speed of each bounce is lost: the ball follows the wall.
    let scene = r#"carom = 1
        [world]
        dim = 1
        [material.default]
        restitution = 0.5
        [[wall]]
        plane = { point = [0.0], normal = [1.0] }
        [[wall]]
        plane = { point = [2.0], normal = [-1.0] }
        velocity = [-1.0]
        [[body]]
        mass = 1.0
        radius = 0.1
        position = [0.5]
        [run]
        until = { time = 5.0 }"#;
    let (code, out, err) = ended("run - --format json", scene);
    assert_eq!(code, 3, "{err}");
    assert!(err.contains("no room"));
    let report: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(report["stopped"], "crushed");
    // The walls are a diameter apart when 2 - t = 0.2.
    assert!((report["time"].as_f64().unwrap() - 1.8).abs() < 1e-6);
    assert_eq!(ended("run -", scene).0, 3);
    assert_eq!(ended("events -", scene).0, 3);
}

#[test]
fn a_run_stops_itself_where_numbers_end() {
    let (code, out, err) = ended("run - --until time=1e300 --set body.B.velocity=[1e10] --format json", HALF);
    assert_eq!(code, 3, "{err}");
    assert!(err.contains("finite"));
    let report: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(report["stopped"], "not-finite");
    assert_eq!(report["bodies"][1]["position"], json!([Value::Null]));
}

#[test]
fn a_failed_audit_is_an_exit_code() {
    // A speed of which the square is no number any more: positions and velocities are finite, the energy is not.
    let scene = r#"{ "carom": 1, "world": { "dim": 1 }, "run": { "until": { "time": 1 } },
        "body": [ { "mass": 1, "radius": 0.1, "position": [0], "velocity": [1e200] } ] }"#;
    for verb in ["run - --format json", "run -", "events -"] {
        let (code, out, err) = ended(verb, scene);
        assert_eq!(code, 1, "{verb}: {err}");
        assert!(!out.is_empty() && err.contains("the audit failed: the energy is not a finite number"), "{err}");
    }
    let report: Value = serde_json::from_str(&ended("run - --format json", scene).1).unwrap();
    assert_eq!(report["audit"]["pass"], false);
}
