//! `--set`, sweeps, the extensions of outputs, and the schema.
use carom_scene::model::{Law, Together};
use carom_scene::{Data, Document, Scene, builtin, builtins, output, schema};

fn document(name: &str) -> Document {
    Document::parse(name, builtin(name).unwrap()).unwrap()
}

fn with(name: &str, arguments: &[&str]) -> Scene {
    let mut document = document(name);
    for argument in arguments {
        document.set_from(argument).unwrap_or_else(|e| panic!("{e}"));
    }
    document.scene().unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn keys_are_set_by_their_paths() {
    let scene = with(
        "two-balls",
        &[
            "body.A.mass=5",
            "body[2].velocity=[-2.5]",
            "body.B.position[1]=2",
            "run.seed=7",
            "run.together=lcp",
            "run.law = \"newton\"",
            "title=Two balls, again",
            "material.default.restitution=0.25",
            "material.steel.friction=0.1",
            "body.A.material=steel",
            "run.until.impacts=10",
            "world.boundary={ kind = \"box\", min = [-9], max = [9] }",
        ],
    );
    assert_eq!(scene.bodies[0].ball.mass, carom_scene::model::Mass::Mass(5.0));
    assert_eq!((scene.bodies[1].ball.velocity[0], scene.bodies[1].position[0]), (-2.5, 2.0));
    assert_eq!((scene.run.seed, scene.run.together, scene.run.law), (7, Together::Lcp, Law::Newton));
    assert_eq!((scene.title.as_str(), scene.run.until.impacts), ("Two balls, again", Some(10)));
    assert_eq!(scene.materials[1].name, "steel");
    assert_eq!(scene.bodies[0].ball.material, "steel");
    assert_eq!(with("bounce", &["wall.floor.plane.normal=[0,2]", "title=2024"]).title, "2024");
    assert_eq!(with("drop", &["material.rubber.restitution=0.5"]).materials.len(), 4);
    let curve = with("two-balls", &["material.default.restitution.curve=[[0, 1], [1, 0.5]]"]);
    assert!(matches!(curve.materials[0].restitution, Some(carom::Coefficient::Curve(_))));
    assert_eq!(with("gas", &["group.gas.count=100", "group.gas.velocity.temperature=2"]).groups[0].count, Some(100));
}

#[test]
fn what_cannot_be_set_is_told_with_its_place() {
    for (argument, column, says) in [
        ("body.C.mass=5", 1, "no body is called `C`"),
        ("body.A.mas=5", 1, "unknown key `mas`; did you mean `mass`?"),
        ("body[3].mass=5", 1, "there is no body[3]"),
        ("wall.floor.velocity=[1]", 1, "the scene has no [[wall]]"),
        ("run.seed.x=1", 1, "`seed` has no key `x`"),
        ("run..seed=1", 5, "a part of the path is empty"),
        ("run.seed", 1, "expects path=value"),
        ("run.seed=[1", 1, "not valid TOML"),
        ("sweep.x=1", 1, "cannot be set by a path"),
        ("=1", 1, "a part of the path is empty"),
    ] {
        let problems = document("two-balls").set_from(argument).unwrap_err();
        let problem = problems.iter().next().unwrap();
        assert!(problem.message.contains(says), "{problems}");
        if argument.contains('=') && !says.contains("TOML") {
            assert_eq!((problem.line(), problem.column()), (Some(1), Some(column)), "{problems}");
        }
    }
    // What breaks a rule only where it stands: the place is that in the argument.
    let mut document = document("two-balls");
    document.set_from("body.A.mass=-5").unwrap();
    let problems = document.scene().unwrap_err();
    println!("{problems}");
    assert!(problems.to_string().starts_with("--set:1:13: error: body[1].mass: mass must be positive, got -5"));
}

#[test]
fn a_sweep_counts_through_its_combinations() {
    let text = "carom = 1\n[world]\ndim = 1\n[[body]]\nname = \"A\"\nmass = 1\nradius = 1\nposition = [0]\n[sweep]\n\
                \"body.A.mass\" = [1, 2.5]\nrun.seed = { range = [1, 3] }\n\"body.A.velocity\" = [[1.0], [2.0]]\n\
                \"material.default.restitution\" = { range = [0, 1], steps = 11 }\n\"run.together\" = [\"lcp\"]\n";
    let document = Document::parse("a.toml", text).unwrap();
    let scene = document.scene().unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene.combinations(), 2 * 3 * 2 * 11);
    let paths: Vec<_> = scene.sweep.iter().map(|s| s.path.as_str()).collect();
    assert_eq!(paths, ["body.A.mass", "run.seed", "body.A.velocity", "material.default.restitution", "run.together"]);
    let mut seen = std::collections::BTreeSet::new();
    for index in 0..scene.combinations() {
        let combination = scene.combination(index);
        seen.insert(format!("{combination:?}"));
        let run = document.combination(&scene, index).unwrap().scene().unwrap();
        assert!(run.sweep.is_empty());
        assert_eq!(run.run.together, Together::Lcp);
        let Data::Integer(seed) = combination[1].1 else { panic!() };
        assert_eq!(run.run.seed as i128, seed);
    }
    assert_eq!(seen.len(), scene.combinations());
    // The last line changes fastest; tenths are tenths.
    let e = |index| scene.combination(index)[3].1.clone();
    assert_eq!((e(0), e(3), e(7), e(10)), (Data::Number(0.0), Data::Number(0.3), Data::Number(0.7), Data::Number(1.0)));
    assert_eq!(scene.combination(11)[2].1, Data::List(vec![Data::Number(2.0)]));
}

#[test]
fn an_output_has_a_format_by_its_extension() {
    assert!(["a.CSV", "a.gsd", "b.mp4", "c.carom"].iter().all(|path| output(path).is_none()));
    assert!(output("dir.d/a").unwrap().message.contains("unknown extension"));
}

/// A schema that accepts what a value is, as far as the parts that this schema uses go.
fn accepts(schema: &serde_json::Value, value: &serde_json::Value) -> bool {
    use serde_json::Value::*;
    let number = |key: &str| schema.get(key).and_then(|k| k.as_f64());
    let typed = match (schema.get("type").and_then(|t| t.as_str()), value) {
        (None, _) | (Some("object"), Object(_)) | (Some("array"), Array(_)) | (Some("string"), String(_)) => true,
        (Some("boolean"), Bool(_)) | (Some("number"), Number(_)) => true,
        (Some("integer"), Number(n)) => n.is_u64() || n.is_i64() || n.as_f64().is_some_and(|x| x == x.trunc()),
        _ => false,
    };
    let bounded = value.as_f64().is_none_or(|x| {
        number("minimum").is_none_or(|m| x >= m)
            && number("maximum").is_none_or(|m| x <= m)
            && number("exclusiveMinimum").is_none_or(|m| x > m)
    });
    let listed = schema.get("enum").and_then(|e| e.as_array()).is_none_or(|e| e.contains(value));
    let some =
        |key: &str| schema.get(key).and_then(|a| a.as_array()).is_none_or(|a| a.iter().any(|s| accepts(s, value)));
    let inside = match value {
        Array(items) => {
            let n = items.len() as f64;
            number("minItems").is_none_or(|m| n >= m)
                && number("maxItems").is_none_or(|m| n <= m)
                && items.iter().all(|i| schema.get("items").is_none_or(|s| accepts(s, i)))
        }
        Object(entries) => {
            let required = schema.get("required").and_then(|r| r.as_array());
            required.is_none_or(|r| r.iter().all(|k| entries.contains_key(k.as_str().unwrap())))
                && entries.iter().all(|(key, value)| match schema.get("properties").and_then(|p| p.get(key)) {
                    Some(schema) => accepts(schema, value),
                    None => match schema.get("additionalProperties") {
                        Some(Bool(false)) => false,
                        Some(schema) => accepts(schema, value),
                        None => true,
                    },
                })
        }
        _ => true,
    };
    typed && bounded && listed && some("oneOf") && some("anyOf") && inside
}

#[test]
fn the_schema_accepts_what_the_reader_accepts() {
    let schema = schema();
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    for b in builtins() {
        let scene = document(b.name).scene().unwrap();
        for detail in [carom_scene::Detail::Full, carom_scene::Detail::Short] {
            let mut value = serde_json::from_str(&carom_scene::to_json(&scene, detail)).unwrap();
            assert!(accepts(&schema, &value), "{}: {value}", b.name);
            value["world"]["dmi"] = 3.into();
            assert!(!accepts(&schema, &value), "{}", b.name);
        }
    }
    // Every key is described, and no table takes keys of its own.
    fn described(schema: &serde_json::Value, path: &str) {
        if let Some(properties) = schema.get("properties").and_then(|p| p.as_object()) {
            assert_eq!(schema["additionalProperties"], false, "{path}");
            for (key, schema) in properties {
                let path = format!("{path}.{key}");
                assert!(
                    path.contains(".curve") || schema["description"].as_str().is_some_and(|d| d.len() > 4),
                    "{path}"
                );
                described(schema, &path);
                if let Some(items) = schema.get("items") {
                    described(items, &path);
                }
            }
        }
    }
    described(&schema, "");
    assert_eq!(schema["properties"]["body"]["items"]["required"], serde_json::json!(["radius", "position"]));
}
