//! `carom explain`: numbers from formulas and from exact rationals, formats, languages, and what is refused.
use assert_cmd::cargo::cargo_bin_cmd;
use serde_json::Value;
use std::process::Output;

fn carom(line: &str) -> Output {
    let mut command = cargo_bin_cmd!("carom");
    command.args(line.split_whitespace()).output().unwrap()
}

/// Standard output of a command that ends well and says nothing else.
fn said(line: &str) -> String {
    let output = carom(line);
    let (out, err) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(output.status.success() && err.is_empty(), "{line}: {err}");
    out
}

fn json(line: &str) -> Value {
    serde_json::from_str(&said(&format!("{line} --format json"))).unwrap()
}

/// Standard error of a command that is refused.
fn refused(line: &str) -> String {
    let output = carom(line);
    let err = String::from_utf8(output.stderr).unwrap();
    println!("{line}\n{err}");
    assert_eq!(output.status.code(), Some(2), "{line}");
    assert!(output.stdout.is_empty() && err.starts_with("error: "), "{line}: {err}");
    err
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(all) => all.iter().flat_map(numbers).collect(),
        other => vec![other.as_f64().unwrap()],
    }
}

/// Two units in the last place of the scale for each of the few operations that a value takes.
fn close(got: &[f64], want: &[f64], scale: f64) {
    assert_eq!(got.len(), want.len());
    for (g, w) in got.iter().zip(want) {
        assert!((g - w).abs() <= 8.0 * f64::EPSILON * scale, "{got:?} {want:?}");
    }
}

const LINE: &str = "explain --mass 2 1 --velocity 3 -1 --restitution 0.5";
const PLANE: &str = "explain --mass 2 3 --velocity 5,0 -1,2 --normal 3,4 --restitution 0.5";

#[test]
fn two_balls_on_a_line_exactly() {
    // m1 v1 + m2 v2 = 5, v2' - v1' = e (v1 - v2) = 2, so v1' = 1, v2' = 3, J = 4; K = 9.5, then 5.5. Small whole numbers
    // and halves: nothing rounds, so JSON holds them exactly.
    let x = json(LINE);
    assert_eq!(x["dim"], 1);
    assert_eq!(x["masses"], serde_json::json!([2.0, 1.0]));
    assert_eq!(x["normal"], serde_json::json!([1.0]));
    assert_eq!(
        x["before"],
        serde_json::json!({"velocity": [[3.0], [-1.0]], "spin": [[], []], "momentum": [5.0], "energy": 9.5})
    );
    assert_eq!(
        x["after"],
        serde_json::json!({"velocity": [[1.0], [3.0]], "spin": [[], []], "momentum": [5.0], "energy": 5.5})
    );
    for (key, want) in [
        ("approach", 4.0),
        ("departure", 2.0),
        ("impulse", 4.0),
        ("lost", 4.0),
        ("restitution", 0.5),
        ("friction", 0.0),
    ] {
        assert_eq!(x[key], want, "{key}");
    }
    close(&[x["reduced_mass"].as_f64().unwrap()], &[2.0 / 3.0], 1.0);
    assert_eq!(x["friction_impulse"], serde_json::json!([0.0]));
    assert!(x.get("rotated").is_none() && x.get("mean_force").is_none());
}

#[test]
fn every_key_of_the_contract_in_the_plane() {
    let x = json(&format!("{PLANE} --duration 0.5"));
    let keys: Vec<&str> = x.as_object().unwrap().keys().map(String::as_str).collect();
    let mut want = [
        "dim",
        "masses",
        "normal",
        "restitution",
        "friction",
        "before",
        "approach",
        "reduced_mass",
        "impulse",
        "friction_impulse",
        "after",
        "departure",
        "lost",
        "mean_force",
        "rotated",
    ];
    want.sort_unstable();
    assert_eq!(keys, want);
    // THEORY 1.4, A9; mean force = -+ J n / s = -+ (2.16, 2.88) / 0.5; theta = atan(4/3); v_p = v.n, v_n across.
    close(&numbers(&x["after"]["velocity"]), &[98.0 / 25.0, -36.0 / 25.0, -7.0 / 25.0, 74.0 / 25.0], 5.0);
    close(&numbers(&x["normal"]), &[0.6, 0.8], 1.0);
    close(&numbers(&x["mean_force"]), &[-4.32, -5.76, 4.32, 5.76], 6.0);
    close(&numbers(&x["rotated"]["theta"]), &[(4.0f64 / 3.0).atan()], 1.0);
    close(&numbers(&x["rotated"]["before"]), &[3.0, -4.0, 1.0, 2.0], 5.0);
    close(&numbers(&x["rotated"]["after"]), &[1.2, -4.0, 2.2, 2.0], 5.0);
    close(&numbers(&x["reduced_mass"]), &[1.2], 1.2);
    close(&[x["impulse"].as_f64().unwrap(), x["lost"].as_f64().unwrap()], &[3.6, 1.8], 4.0);
    close(&[x["approach"].as_f64().unwrap(), x["departure"].as_f64().unwrap()], &[2.0, 1.0], 2.0);
    assert_eq!(x["before"]["spin"], serde_json::json!([[0.0], [0.0]]));
}

#[test]
fn a_wall_has_no_mass_and_no_momentum() {
    let x = json("explain --mass inf 2 --velocity 0.5,1,0 -3,0,0 --normal 2,0,0");
    assert_eq!(x["masses"], serde_json::json!([null, 2.0]));
    assert_eq!((&x["before"]["momentum"], &x["after"]["momentum"]), (&Value::Null, &Value::Null));
    // Elastic against a wall at 0.5 m/s: v' = -(-3) + 2 (0.5) = 4; energies of the ball alone; mu is the ball's mass.
    assert_eq!(x["after"]["velocity"], serde_json::json!([[0.5, 1.0, 0.0], [4.0, 0.0, 0.0]]));
    assert_eq!((&x["before"]["energy"], &x["after"]["energy"]), (&9.0.into(), &16.0.into()));
    assert_eq!((&x["reduced_mass"], &x["lost"], &x["impulse"]), (&2.0.into(), &0.0.into(), &14.0.into()));
    assert_eq!(x["before"]["spin"], serde_json::json!([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]));
}

/// An exact rational such as -98/25.
fn rational(text: &Value) -> f64 {
    let text = text.as_str().unwrap();
    let (above, below) = text.split_once('/').unwrap_or((text, "1"));
    above.parse::<f64>().unwrap() / below.parse::<f64>().unwrap()
}

#[test]
fn the_reference_vectors() {
    let book: Value = serde_json::from_str(include_str!("data/vectors.json")).unwrap();
    let mut seen = 0;
    println!("{:<28} {:>9} {:>9}", "case", "J", "lost");
    for case in book["two_body"].as_array().unwrap() {
        let list = |key: &str| case[key].as_array().unwrap().iter().map(rational).collect::<Vec<f64>>();
        let comma = |v: &[f64]| v.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let (v1, v2, d) = (list("v1"), list("v2"), list("d"));
        if v1.len() > 3 {
            continue; // a scene has at most three dimensions
        }
        let mass = |key: &str| if case[key].is_null() { f64::INFINITY } else { rational(&case[key]) };
        let (m1, m2, e) = (mass("m1"), mass("m2"), rational(&case["e"]));
        let x = json(&format!(
            "explain --mass {m1} {m2} --velocity={} --velocity={} --normal={} --restitution {e}",
            comma(&v1),
            comma(&v2),
            comma(&d)
        ));
        let speed = v1.iter().chain(&v2).fold(1.0, |most: f64, v| most.max(v.abs()));
        close(&numbers(&x["after"]["velocity"][0]), &list("v1p"), 2.0 * speed);
        close(&numbers(&x["after"]["velocity"][1]), &list("v2p"), 2.0 * speed);
        let size = list("J_on_1").iter().map(|p| p * p).sum::<f64>().sqrt();
        close(&numbers(&x["impulse"]), &[size], size);
        close(&numbers(&x["lost"]), &[rational(&case["loss"])], rational(&case["loss"]).max(1.0));
        println!(
            "{:<28} {:>9.4} {:>9.4}",
            case["name"].as_str().unwrap(),
            x["impulse"].as_f64().unwrap(),
            x["lost"].as_f64().unwrap()
        );
        seen += 1;
    }
    assert_eq!(seen, 15);
}

#[test]
fn numbers_and_lists_in_every_spelling() {
    let want = json(LINE);
    for line in [
        "explain --mass=2 1 --velocity=3 -1 --restitution=0.5",
        "explain --mass=2 --mass=1 --velocity=3 --velocity=-1 --restitution=.5",
        "explain --mass 2,1 --velocity 3 --restitution 0.5 --velocity -1",
        "explain --velocity 3 −1 --normal 7 --mass 2 1 --restitution 5e-1 --friction 0 --tangential -1",
    ] {
        assert_eq!(json(line), want, "{line}");
    }
    let want = json("explain --mass 1 2 --velocity -1,2 -3,0 --normal -3,4");
    for line in [
        "explain --mass 1 2 --velocity=-1,2 -3,0 --normal=-3,4",
        "explain --mass 1 2 --velocity=-1,2 --velocity=-3,0 --normal -3 4",
        "explain --normal -3,4 --velocity -1,2 -3,0 --mass 1 2 --spin -0 0",
    ] {
        assert_eq!(json(line), want, "{line}");
    }
}

#[test]
fn spins_stay_and_count_with_a_radius() {
    let x = json(&format!("{PLANE} --spin 4 -2 --radius 0.5 1"));
    assert_eq!(x["after"]["spin"], serde_json::json!([[4.0], [-2.0]]));
    // Discs: I = m R^2 / 2 = 0.25 and 1.5; I w^2 / 2 = 2 and 3, besides 25 + 7.5.
    assert_eq!(x["before"]["energy"], 37.5);
    // Hoops: twice as much.
    assert_eq!(json(&format!("{PLANE} --spin 4 -2 --radius 0.5 1 --inertia 1 1"))["before"]["energy"], 42.5);
    let x = json("explain --mass 1 1 --velocity 1,0,0 0,0,0 --normal 1,0,0 --spin 1,2,3 -4,-5,-6");
    assert_eq!(x["after"]["spin"], serde_json::json!([[1.0, 2.0, 3.0], [-4.0, -5.0, -6.0]]));
}

#[test]
fn the_text_tells_the_lecture() {
    let text = said(&format!("{LINE} --duration 0.001"));
    for line in [
        "p₁ = m₁ v₁   = 2 · 3    = 6 kg m/s",
        "P = p₁ + p₂ = 6 + (−1) = 5 kg m/s",
        "F = dp/dt",
        "F₁ = F̂₁/Δt = −4/0.001 = −4000 N",
        "F̂ = ∫ F dt = Δp = m (v′ − v)",
        "m₁ v₁ + m₂ v₂ = m₁ v₁′ + m₂ v₂′",
        "2 · 3 + 1 · (−1) = 2 · 1 + 1 · 3",
        "▸ 0 < e < 1",
        "0 = m₁ (vy₁′ − vy₁)",
        "2 v₁′ + 1 v₂′ = 2 · 3 + 1 · (−1) = 5",
        "slip of sign",
        "e (v₁ − v₂) = −(v₁′ − v₂′)",
        "v₁′ = (m₁ − e m₂)/(m₁ + m₂) v₁ + (1 + e) m₂/(m₁ + m₂) v₂",
        "F̂ = (1 + e) (r·d)/((d·d) (1/m₁ + 1/m₂)) d",
        "✓ momentum",
        "✓ restitution",
        "✓ energy",
    ] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
    let text = said(PLANE);
    for line in [
        "θ = atan2(ny, nx)",
        "53.1301°",
        "vp₁ = vx₁ cos θ + vy₁ sin θ",
        "⎡cos θ  −sin θ⎤",
        "(3.92, −1.44)",
        "(−0.28, 2.96)",
        "Cx = 2 · 5 + 3 · (−1) = 2 · 3.92 + 3 · (−0.28) = 7 kg m/s  ✓",
    ] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
}

#[test]
fn special_cases_are_named() {
    for (line, phrase) in [
        ("explain --mass 1 1 --velocity 5,0 0,0 --normal 3,4", "right angle"),
        ("explain --mass 1 1 --velocity 1 0", "exchange their velocities"),
        ("explain --mass 1 2 --velocity 1 0 --restitution 0", "one velocity, 0.333333 m/s"),
        ("explain --mass 1 inf --velocity 1 0", "A wall at rest"),
        ("explain --mass 1 inf --velocity 1 -2", "A moving wall"),
        ("explain --mass 1 2 --velocity -1 1", "no impact"),
        ("explain --mass 1 3 --velocity 4 0", "The centre of mass keeps its velocity, 1 m/s"),
    ] {
        let text = said(line).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(phrase), "{phrase} is not in\n{text}");
    }
}

#[test]
fn two_languages() {
    let text = said(&format!("{PLANE} --lang pt-BR"));
    for word in
        ["quantidade de movimento", "Impulso", "coeficiente de restituição", "inelástico", "(3,92; −1,44)", "0,5"]
    {
        assert!(text.contains(word), "{word}");
    }
    for word in ["the ", "velocity", "3.92", "0.5"] {
        assert!(!text.contains(word), "{word}");
    }
    let latex = said(&format!("{PLANE} --lang=pt-BR --format=latex"));
    assert!(latex.contains("3{,}92") && !latex.contains("3.92") && !latex.contains('−'));
    assert!(said(&format!("{PLANE} --lang pt-br --format markdown")).contains("| v₁ | (5; 0) | (3,92; −1,44) |"));
    // JSON is for programs: the same in every language.
    assert_eq!(said(&format!("{PLANE} --lang pt-BR --format json")), said(&format!("{PLANE} --format json")));
}

#[test]
fn latex_is_balanced() {
    for line in [LINE, PLANE, "explain --mass 1 inf --velocity 1,2,3 0,0,0 --normal 1,1,1 --duration 1e-9"] {
        let latex = said(&format!("{line} --format latex"));
        for (open, close) in [("\\begin{align*}", "\\end{align*}"), ("\\begin{itemize}", "\\end{itemize}"), ("{", "}")]
        {
            assert_eq!(latex.matches(open).count(), latex.matches(close).count(), "{open}");
        }
        assert!(latex.contains("\\begin{align*}") && latex.is_ascii());
        assert_eq!(latex.matches('$').count() % 2, 0);
    }
}

#[test]
fn no_colour_where_there_is_no_terminal() {
    for no_color in ["", "1"] {
        let output = cargo_bin_cmd!("carom").args(LINE.split(' ')).env("NO_COLOR", no_color).output().unwrap();
        assert!(!output.stdout.contains(&0x1b));
    }
}

#[test]
fn wrong_questions_are_refused_in_plain_words() {
    for (line, words) in [
        ("explain", "--mass 2 1 --velocity 3 -1"),
        ("explain --mass 2 1", "--velocity is missing"),
        ("explain --velocity 3 -1", "--mass is missing"),
        ("explain --mass 2 --velocity 3 -1", "--mass expects 2 numbers"),
        ("explain --mass 2 1 3 --velocity 3 -1", "--mass expects 2 numbers"),
        ("explain --mass 0 1 --velocity 3 -1", "mass must be positive"),
        ("explain --mass -2 1 --velocity 3 -1", "mass must be positive"),
        ("explain --mass nan 1 --velocity 3 -1", "mass must be positive"),
        ("explain --mass inf inf --velocity 3 -1", "both bodies are immovable"),
        ("explain --mass 2 1 --velocity=3,-1", "--velocity 3 -1"),
        ("explain --mass 2 1 --velocity 3", "expects 2 velocities"),
        ("explain --mass 2 1 --velocity 5 0 -1 2 --normal 3,4", "--velocity 5,0 -1,2"),
        ("explain --mass 2 1 --velocity 3 -1,2", "expects dim = 1 number"),
        ("explain --mass 2 1 --velocity 1,2,3,4 1,2,3,4", "three (in space)"),
        ("explain --mass 2 1 --velocity inf -1", "must be finite"),
        ("explain --mass 2 1 --velocity 3 x", "'x' is not a number"),
        ("explain --mass 2 1 --velocity 3, -1", "a number is missing"),
        ("explain --mass 2 1 --velocity 3 -1 --restitution 1.5", "restitution must lie in [0, 1]"),
        ("explain --mass 2 1 --velocity 3 -1 --restitution -0.5", "restitution must lie in [0, 1]"),
        ("explain --mass 2 1 --velocity 3,0 -1,0 --normal 1,0 --friction 0.2", "--radius 0.1 0.1"),
        ("explain --mass 2 1 --velocity 3,0 -1,0 --normal 1,0 --friction 0.2 --radius 1", "expects 2 numbers"),
        ("explain --mass 2 1 --velocity 3 -1 --law poisson", "chatterjee-ruina, stronge, newton"),
        ("explain --mass 2 1 --velocity 3 -1 --friction -1", "not negative"),
        ("explain --mass 2 1 --velocity 3 -1 --tangential 2", "must lie in [-1, 1]"),
        ("explain --mass 2 1 --velocity 3 -1 --duration 0", "duration must be positive"),
        ("explain --mass 2 1 --velocity 3 -1 --duration -1", "duration must be positive"),
        ("explain --mass 2 1 --velocity 3 -1 --spin 1 2", "nothing turns on a line"),
        ("explain --mass 2 1 --velocity 3 -1 --radius 0 1", "radius must be positive"),
        ("explain --mass 2 1 --velocity 3 -1 --inertia 1 -1", "must be positive"),
        ("explain --mass 2 1 --velocity 3 -1 --normal 0", "normal must not be zero"),
        ("explain --mass 2 1 --velocity 3,0 -1,0", "--normal"),
        ("explain --mass 2 1 --velocity 3,0 -1,0 --normal 1", "expects dim = 2 numbers"),
        ("explain --mass 2 1 --velocity 3,0 -1,0 --normal 0,0", "normal must not be zero"),
        ("explain --mass 2 1 --velocity 3,0 -1,0 --normal 1,nan", "must be finite"),
        ("explain --mass 2 1 --velocity 3,0 -1,0 --normal 1,0 --spin 1", "expects 2 values"),
        ("explain --mass 2 1 --velocity 3,0 -1,0 --normal 1,0 --spin 1,2,3 1", "1 number"),
        ("explain --mass 1e300 1e300 --velocity 1e300 -1", "too large"),
        ("explain --mass 2 1 --velocity 3 -1 --lang de", "en or pt-BR"),
        ("explain --mass 2 1 --velocity 3 -1 --format pdf", "markdown"),
        ("explain --mass 2 1 --velocity 3 -1 --bounce 1", "unexpected argument"),
    ] {
        let err = refused(line);
        assert!(err.contains(words), "{line}: {words:?} is not in {err:?}");
    }
}

/// THEORY 2.2: a solid sphere of unit mass and radius on a floor; exact rationals.
#[test]
fn friction_and_spin() {
    let floor = "explain --mass 1 inf --normal 0,0,-1 --radius 1";
    let slips = json(&format!("{floor} --velocity 3,0,-2 0,0,0 --restitution 0.5 --friction 0.1"));
    close(&numbers(&slips["after"]["velocity"][0]), &[2.7, 0.0, 1.0], 3.0);
    close(&numbers(&slips["after"]["spin"][0]), &[0.0, 0.75, 0.0], 1.0);
    close(&numbers(&slips["friction_impulse"]), &[0.3, 0.0, 0.0], 1.0);
    close(&numbers(&slips["lost"]), &[897.0 / 400.0], 4.0);
    assert_eq!((&slips["slip"]["sticks"], &slips["law"]), (&false.into(), &"chatterjee-ruina".into()));
    assert_eq!((&slips["impulse"], &slips["friction"]), (&3.0.into(), &0.1.into()));
    let superball = "--velocity 3,0,-2 0,0,0 --friction 10 --tangential 1";
    let back = json(&format!("{floor} {superball}"));
    close(&numbers(&back["after"]["velocity"][0]), &[9.0 / 7.0, 0.0, 2.0], 3.0);
    close(&numbers(&back["after"]["spin"][0]), &[0.0, 30.0 / 7.0, 0.0], 5.0);
    // Coulomb's law alone knows no e_t: it stops the slip.
    let stuck = json(&format!("{floor} {superball} --law stronge"));
    close(&numbers(&stuck["after"]["velocity"][0]), &[15.0 / 7.0, 0.0, 2.0], 3.0);
    // Backspin on a wall at the left, told by both and in both languages.
    let spin = json(&format!("{floor} --velocity 0,0,-2 0,0,0 --spin 0,5,0 --restitution 0.8 --friction 10"));
    close(&numbers(&spin["after"]["velocity"][0]), &[10.0 / 7.0, 0.0, 1.6], 2.0);
    for (lang, words) in
        [("en", ["they stick", "μ J = 10 · 4", "A superball"]), ("pt-BR", ["aderem", "2,14286", "superbola"])]
    {
        let text = said(&format!("{floor} {superball} --lang {lang}"));
        let rolls = said(&format!("{floor} {superball} --law newton --lang {lang}"));
        for word in words {
            assert!(text.contains(word) || rolls.contains(word), "{word}: {text}");
        }
    }
    // The lecture's frame turns with friction: v_n' = v_n - J_t/m, with A9's impulse across the normal.
    let plane = json(&format!("{PLANE} --friction 0.3 --radius 0.1 0.2 --spin 10 0"));
    close(&numbers(&plane["rotated"]["after"]), &[1.2, -4.0 + 0.54, 2.2, 2.0 - 0.36], 5.0);
    close(&numbers(&plane["after"]["spin"]), &[20.8, 3.6], 40.0);
}

#[test]
fn an_impact_of_a_scene() {
    // The lecture's two balls: the same object as with the numbers on the command line, but for rounding.
    let (scene, line) = (json("explain two-balls --event 1"), json(LINE));
    for key in ["dim", "masses", "normal", "restitution", "friction", "friction_impulse"] {
        assert_eq!(scene[key], line[key], "{key}");
    }
    for key in ["approach", "reduced_mass", "impulse", "departure", "lost"] {
        close(&numbers(&scene[key]), &numbers(&line[key]), 4.0);
    }
    let text = said("explain two-balls --event 1");
    assert!(text.contains("Impact 1 of two-balls, t = 0.45 s: A (1) meets B (2)"));
    assert!(said("explain two-balls --event 1 --lang pt-BR").contains("t = 0,45 s: A (1) e B (2)"));
    // The oblique pair is THEORY's A9, as PLANE is.
    let (scene, plane) = (json("explain oblique --event 1"), json(PLANE));
    for key in ["velocity", "momentum", "energy"] {
        close(&numbers(&scene["after"][key]), &numbers(&plane["after"][key]), 40.0);
    }
    // A wall has no mass, and is the second.
    let wall = json("explain wall --event 1");
    assert_eq!(wall["masses"], serde_json::json!([1.0, null]));
    // What the run did is what is explained.
    let mean = json("explain two-balls --event 1 --duration 0.01");
    close(&numbers(&mean["mean_force"]), &[-400.0, 400.0], 400.0);
    let changed = json("explain two-balls --event 1 --set material.default.restitution=1");
    close(&numbers(&changed["impulse"]), &[16.0 / 3.0], 8.0);
}

#[test]
fn an_instant_with_several_contacts() {
    let x = json("explain cradle --event 3");
    assert_eq!((&x["together"], &x["operator"]), (&serde_json::json!(4), &serde_json::json!("reflect")));
    let contacts = x["contacts"].as_array().unwrap();
    assert_eq!(contacts.len(), 4);
    let lost: f64 = contacts.iter().map(|c| c["lost"].as_f64().unwrap()).sum();
    assert!(lost.abs() < 1e-15, "elastic: the lines sum to the instant's");
    let text = said("explain cradle --event 3");
    println!("{text}");
    for part in ["4 contacts at one instant", "GR-e", "> 3", "ball-5", "momentum"] {
        assert!(text.contains(part), "{part}");
    }
    assert!(said("explain cradle --event 3 --lang pt-BR").contains("t = 0,4 s"));
    let markdown = said("explain cradle --event 3 --format markdown");
    println!("{markdown}");
    for part in
        ["# 4 contacts at one instant", "| contact |", "\\perp", "ball-4 - ball-5", "| momentum, kg m/s | 1 | 0 | 1 |"]
    {
        assert!(markdown.contains(part), "{part}");
    }
    let latex = said("explain cradle --event 3 --format latex --lang pt-BR");
    println!("{latex}");
    for part in
        ["\\section*{4 contatos", "\\begin{tabular}{rlrrrrr}", "\\end{tabular}", "$>$ 3 & ball-3 - ball-4", "\\lambda"]
    {
        assert!(latex.contains(part), "{part}");
    }
    assert_eq!(latex.matches("\\begin{").count(), latex.matches("\\end{").count());
}

#[test]
fn a_scene_and_numbers_exclude_each_other() {
    for (line, says) in [
        ("explain two-balls --event 2", "1 impact"),
        ("explain two-balls --event 0", "event"),
        ("explain two-balls", "--event"),
        ("explain --event 1", "SCENE"),
        ("explain two-balls --event 1 --restitution 0.5", "restitution"),
        ("explain --mass 2 1 --velocity 3 -1 --set run.seed=1", "--set"),
        ("explain two-bals --event 1", "`two-balls`"),
    ] {
        assert!(refused(line).contains(says), "{line}");
    }
}
