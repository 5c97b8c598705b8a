//! A scene that is written and read again is the same scene, to the last bit.
use carom_scene::model::*;
use carom_scene::{Data, Detail, Document, Format, Scene, builtins, to_json, to_toml};
use proptest::prelude::*;

fn read(name: &str, text: &str) -> Scene {
    Document::parse(name, text).and_then(|d| d.scene()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn assert_survives(scene: &Scene) {
    for detail in [Detail::Full, Detail::Short] {
        let toml = to_toml(scene, detail);
        assert_eq!(&read("a.toml", &toml), scene, "{detail:?}\n{toml}");
        let json = to_json(scene, detail);
        assert_eq!(&read("a.json", &json), scene, "{detail:?}\n{json}");
        serde_json::from_str::<serde_json::Value>(&json).unwrap();
        // Written twice, the text is the same: an expanded scene is expanded already.
        assert_eq!(to_toml(&read("a.toml", &toml), detail), toml);
    }
}

#[test]
fn built_in_scenes_survive() {
    for builtin in builtins() {
        assert_survives(&read(builtin.name, builtin.text));
    }
}

#[test]
fn unsaid_coefficients_stay_unsaid() {
    let scene = read("a.toml", "carom = 1\n[world]\ndim = 1\n[material.m]\nfriction = 0.0\n");
    let full = to_toml(&scene, Detail::Full);
    println!("{full}");
    assert!(full.contains("\n# restitution: unsaid") && full.contains("friction = 0.0"), "{full}");
    assert_survives(&scene);
    assert_eq!(
        to_toml(&scene, Detail::Short),
        "carom = 1\n\n[world]\ndim = 1\n\n[material.m]\nfriction = 0.0\n\n[run]\n"
    );
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -100.0..100.0f64,
        any::<i8>().prop_map(f64::from),
        any::<f64>().prop_filter("finite", |x| x.is_finite()),
        Just(-0.0),
        Just(5e-324),
        Just(f64::MAX),
    ]
}

fn positive() -> impl Strategy<Value = f64> {
    prop_oneof![1e-3..10.0f64, Just(1.0), Just(1e-9), Just(0.1 + 0.2)]
}

fn word() -> impl Strategy<Value = String> {
    prop_oneof!["[a-z]{1,6}", "[ -~]{1,8}", "\\PC{1,5}"].prop_filter("a name", |s: &String| {
        !s.trim().is_empty() && !s.contains(':') && !s.chars().any(char::is_control)
    })
}

fn vector(dim: usize) -> impl Strategy<Value = Vec<f64>> {
    proptest::collection::vec(number(), dim)
}

fn coefficient() -> impl Strategy<Value = Option<carom::Coefficient>> {
    proptest::option::of(prop_oneof![
        (0.0..=1.0f64).prop_map(carom::Coefficient::Constant),
        proptest::collection::vec(0.0..=1.0f64, 1..4).prop_map(|v| carom::Coefficient::Curve(
            v.into_iter().enumerate().map(|(k, x)| (k as f64 / 3.0, x)).collect()
        )),
    ])
}

fn ball(dim: usize) -> impl Strategy<Value = Ball> {
    let spin = [0, 1, 3][dim - 1];
    (0..3usize, positive(), positive(), vector(dim), vector(spin), proptest::option::of(positive())).prop_map(
        |(kind, mass, radius, velocity, spin, inertia)| Ball {
            mass: [Mass::Mass(mass), Mass::Density(mass), Mass::Unsaid][kind],
            fixed: kind == 2,
            radius,
            velocity,
            spin,
            material: "default".to_owned(),
            inertia,
        },
    )
}

fn form(dim: usize) -> BoxedStrategy<Form> {
    let plane = (vector(dim), vector(dim))
        .prop_filter("a normal", |(_, n)| n.iter().any(|x| *x != 0.0))
        .prop_map(|(point, normal)| Form::Plane { point, normal });
    if dim != 2 {
        return plane.boxed();
    }
    prop_oneof![
        plane,
        (vector(2), vector(2))
            .prop_filter("a length", |(a, b)| a != b)
            .prop_map(|(from, to)| Form::Segment { from, to }),
        (vector(2), positive(), -360.0..0.0f64, 1.0..300.0f64).prop_map(|(centre, radius, from, more)| Form::Arc {
            centre,
            radius,
            from,
            to: from + more
        }),
    ]
    .boxed()
}

fn scene() -> impl Strategy<Value = Scene> {
    (1..=3usize).prop_flat_map(|dim| {
        let materials =
            proptest::collection::vec((word(), coefficient(), coefficient(), proptest::option::of(-1.0..1.0f64)), 0..3);
        let bodies = proptest::collection::vec((word(), vector(dim), ball(dim)), 0..4);
        let walls = proptest::collection::vec((form(dim), vector(dim)), 0..3);
        let run = (positive(), proptest::option::of(any::<u32>()), any::<u64>(), 0..3usize, 0..3usize, any::<bool>());
        let sweep = proptest::collection::vec(number(), 1..4);
        (Just(dim), word(), vector(dim), materials, bodies, walls, run, ball(dim), sweep).prop_map(build)
    })
}

#[allow(clippy::type_complexity)]
fn build(
    (dim, title, gravity, materials, bodies, walls, run, member, sweep): (
        usize,
        String,
        Vec<f64>,
        Vec<(String, Option<carom::Coefficient>, Option<carom::Coefficient>, Option<f64>)>,
        Vec<(String, Vec<f64>, Ball)>,
        Vec<(Form, Vec<f64>)>,
        (f64, Option<u32>, u64, usize, usize, bool),
        Ball,
        Vec<f64>,
    ),
) -> Scene {
    let mut all = vec![Surface { name: "default".to_owned(), ..Surface::default() }];
    for (k, (name, restitution, friction, tangential)) in materials.into_iter().enumerate() {
        all.push(Surface { name: format!("{name}{k}"), restitution, friction, tangential, ..Surface::default() });
    }
    let last = all.last().map(|m| m.name.clone()).unwrap_or_default();
    let pairs = vec![Pair {
        materials: ["default".to_owned(), last.clone()],
        restitution: all.last().and_then(|m| m.restitution.clone()),
        friction: None,
        tangential: Some(-0.5),
        law: Some(Law::Stronge),
    }];
    let (time, impacts, seed, together, law, rest) = run;
    let maxwell = Distribution::Maxwell { temperature: time, zero_momentum: rest };
    let velocity = [Some(maxwell), Some(Distribution::Fixed(gravity.clone())), None][together].clone();
    let member = Ball { velocity: if velocity.is_some() { vec![0.0; dim] } else { member.velocity }, ..member };
    Scene {
        title,
        world: Surroundings { dim, gravity: gravity.clone(), boundary: Boundary::Open },
        pairs,
        bodies: bodies
            .into_iter()
            .enumerate()
            .map(|(k, (name, position, ball))| Body {
                name: format!("{name}{k}"),
                position,
                ball: Ball { material: last.clone(), ..ball },
            })
            .collect(),
        walls: walls
            .into_iter()
            .enumerate()
            .map(|(k, (form, velocity))| Wall { name: format!("w{k}"), form, velocity, material: last.clone() })
            .collect(),
        groups: vec![Group {
            name: "group".to_owned(),
            kind: Arrangement::Line,
            count: Some(3),
            min: None,
            max: None,
            spacing: time,
            origin: Some(gravity.clone()),
            direction: (0..dim).map(|k| if k + 1 == dim { -2.0 } else { 0.0 }).collect(),
            rows: 5,
            body: member,
            velocity,
        }],
        run: Run {
            until: Until { time: Some(time), impacts: impacts.map(u64::from), rest },
            seed,
            together: [Together::Reflect, Together::Sequential, Together::Lcp][together],
            law: [Law::ChatterjeeRuina, Law::Stronge, Law::Newton][law],
            rest_speed: time / 7.0,
        },
        outputs: vec![Output { path: "a \"b\".csv".to_owned(), every: (!rest).then_some(time) }],
        sweep: vec![
            Sweep { path: "run.seed".to_owned(), values: Values::Range(-3, 5) },
            Sweep {
                path: "material.default.restitution".to_owned(),
                values: Values::List(sweep.iter().map(|&x| Data::Number(x)).collect()),
            },
            Sweep { path: "run.until.time".to_owned(), values: Values::Steps(0.1, time, 7) },
        ],
        materials: all,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_scenes_survive(scene in scene()) {
        assert_survives(&scene);
    }
}

#[test]
fn the_format_is_told_by_the_name_or_the_first_character() {
    for (name, text, format) in [
        ("a.json", "", Format::Json),
        ("a.toml", "{", Format::Toml),
        ("-", " \n {", Format::Json),
        ("-", "carom = 1", Format::Toml),
        ("A.JSON", "carom", Format::Json),
        ("pi", "carom = 1", Format::Toml),
    ] {
        assert_eq!(Format::of(name, text), format, "{name} {text}");
    }
}
