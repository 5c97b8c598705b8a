//! The built-in scenes do what their comments say.
use carom::{Rotates, Stop, Vector, World};
use carom_scene::{Document, Plan, Scene, build, builtin, builtins, nearest_builtin};

fn load(name: &str) -> (Scene, Plan) {
    let document = Document::parse(name, builtin(name).unwrap()).unwrap_or_else(|e| panic!("{e}"));
    let scene = document.scene().unwrap_or_else(|e| panic!("{e}"));
    let plan = document.plan(&scene).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(document.notes(), [], "{name}");
    (scene, plan)
}

fn run<const D: usize>(name: &str) -> (World<D>, Plan, Stop)
where
    Vector<D>: Rotates,
{
    let (scene, plan) = load(name);
    let mut world = build::<D>(&scene, &plan).unwrap();
    let stop = world.run(&scene.run.until.limits());
    (world, plan, stop)
}

fn check<const D: usize>(name: &str)
where
    Vector<D>: Rotates,
{
    let start = std::time::Instant::now();
    let (mut world, plan, stop) = run::<D>(name);
    let overlap = world.deepest_overlap();
    let ledger = world.ledger();
    println!(
        "{name:10} {stop:?} t = {} impacts {} drift {:e} overlap {overlap:e} {:?}",
        world.time(),
        world.impact_count(),
        ledger.unexplained(),
        start.elapsed()
    );
    assert!(ledger.pass(), "{name}: {ledger:?}");
    assert!(matches!(stop, Stop::Time | Stop::Impacts | Stop::Rest | Stop::Quiet), "{name}: {stop:?}");
    assert_eq!(world.bodies().count(), plan.bodies.len());
    assert_eq!(world.walls().count(), plan.sides.len());
}

#[test]
fn all_are_sound_and_run() {
    assert!(builtins().count() >= 12);
    for b in builtins() {
        let (scene, _) = load(b.name);
        assert_eq!(b.title(), scene.title);
        assert!(b.text.starts_with("# "), "{} explains itself", b.name);
        match scene.world.dim {
            1 => check::<1>(b.name),
            2 => check::<2>(b.name),
            _ => check::<3>(b.name),
        }
    }
    assert_eq!(nearest_builtin("two-bals"), Some("two-balls"));
    assert_eq!(builtin("no such"), None);
}

#[test]
fn two_balls_meet_at_0_45() {
    let (world, plan, stop) = run::<1>("two-balls");
    let [impact] = world.impacts() else { panic!("{:?}", world.impacts()) };
    assert_eq!(stop, Stop::Quiet);
    assert!((impact.time - 0.45).abs() < 1e-15);
    assert_eq!(impact.parties.map(|p| plan.party(p)), ["A", "B"]);
    assert!((impact.impulse - 4.0).abs() < 1e-14 && (impact.lost - 4.0).abs() < 1e-14);
    assert!((impact.after[0].velocity[0] - 1.0).abs() < 1e-15 && (impact.after[1].velocity[0] - 3.0).abs() < 1e-15);
}

#[test]
fn oblique_is_the_lectures_impact() {
    let (world, ..) = run::<2>("oblique");
    let [impact] = world.impacts() else { panic!("{:?}", world.impacts()) };
    assert!((impact.time - 1.0).abs() < 1e-14);
    assert!((impact.normal - Vector([0.6, 0.8])).norm() < 1e-14);
    assert!((impact.approach - 2.0).abs() < 1e-14 && (impact.impulse - 3.6).abs() < 1e-14);
}

#[test]
fn blocks_count_the_digits_of_pi() {
    assert_eq!(run::<1>("pi-31").0.impact_count(), 31);
    assert_eq!(run::<1>("pi").0.impact_count(), 3141);
}

#[test]
fn a_cradle_sends_out_the_last_ball() {
    let (world, ..) = run::<1>("cradle");
    let v: Vec<f64> = world.bodies().map(|b| world.velocity(b).unwrap()[0]).collect();
    assert_eq!(v, [0.0, 0.0, 0.0, 0.0, 1.0]);
}

/// The velocities of all bodies when a scene ends.
fn velocities<const D: usize>(name: &str) -> Vec<[f64; D]>
where
    Vector<D>: Rotates,
{
    let (world, ..) = run::<D>(name);
    assert_eq!(world.ledger().capped, 0, "{name}");
    world.bodies().map(|b| world.velocity(b).unwrap().0).collect()
}

fn near<const D: usize>(name: &str, want: &[[f64; D]], tolerance: f64)
where
    Vector<D>: Rotates,
{
    let got = velocities::<D>(name);
    println!("{name:14} {got:?}");
    assert_eq!(got.len(), want.len(), "{name}");
    for (got, want) in got.iter().zip(want) {
        for k in 0..D {
            assert!((got[k] - want[k]).abs() < tolerance, "{name}: {got:?} {want:?}");
        }
    }
}

#[test]
fn contacts_of_one_instant_end_as_the_scenes_say() {
    // Balls at rest in the middle; who comes in on one side leaves on the other. The order is that of the file.
    near::<1>("cradle-both", &[[-1.0], [0.0], [1.0], [0.0], [0.0], [1.0]], 1e-14);
    // THEORY 3.7, chain 1, 3, 1.
    near::<1>("cradle-masses", &[[-0.5], [0.25], [0.75]], 1e-14);
    // THEORY 3.4, GR-e at e = 0.9, four digits; the momentum is exact.
    near::<1>("cradle-soft", &[[0.0435], [0.0454], [0.0473], [0.0493], [0.8145]], 5e-5);
    let sum: f64 = velocities::<1>("cradle-soft").iter().map(|v| v[0]).sum();
    assert!((sum - 1.0).abs() < 1e-14);
    // Four centres of a regular tetrahedron: each line of centres has the cosine c = sqrt(2/3) with the axis. Reflection asks
    // lambda (1 + 3 c^2) = 2 v c, so lambda = 2 c / 3; the striker keeps 1 - 3 c lambda = -1/3, the others get lambda along their
    // lines: 2 c^2 / 3 = 4/9 along the axis, and 2 c s / 3 = 2 sqrt 2 / 9 across it. The ball's positions have 16 digits.
    let (along, across) = (4.0 / 9.0, 2.0 * 2f64.sqrt() / 9.0);
    let half = across * 0.75f64.sqrt();
    let want =
        [[-1.0 / 3.0, 0.0, 0.0], [along, across, 0.0], [along, -across / 2.0, half], [along, -across / 2.0, -half]];
    near::<3>("three-on-one", &want, 1e-12);
    // Straight back, in both wedges.
    near::<2>("corner", &[[1.0, 2.0]], 1e-12);
    near::<2>("wedge", &[[0.766044443118978, 0.6427876096865393]], 1e-12);
    near::<2>("pinned", &[[0.3, 0.0]], 1e-14);
}

#[test]
fn a_locked_row_yields_across_only() {
    let (world, ..) = run::<2>("locked");
    let first = world.impacts().first().expect("the striker").time;
    let together: Vec<_> = world.impacts().iter().filter(|i| i.time == first).collect();
    // The middle ball can move along x only: lambda (1 + 0.96^2) = 2 * 0.96 for a line of centres (0.96, 0.28).
    let lambda = 2.0 * 0.96 / (1.0 + 0.96 * 0.96);
    let struck = together.iter().find(|i| i.approach > 0.5).expect("the blow");
    let (striker, middle) = if struck.before[0].velocity[0] > 0.5 { (0, 1) } else { (1, 0) };
    println!("{} contacts, {struck:?}", together.len());
    for (got, want) in [
        (struck.after[striker].velocity, [1.0 - 0.96 * lambda, -0.28 * lambda]),
        (struck.after[middle].velocity, [0.96 * lambda, 0.0]),
    ] {
        assert!((got - Vector(want)).norm() < 1e-9, "{got:?} {want:?}");
    }
}

#[test]
fn a_piston_does_work() {
    let (world, ..) = run::<2>("piston");
    let energy = world.ledger().energy;
    println!("{energy:?}");
    // 200 discs of temperature 1; doubled if the piston were slow, more at this speed.
    assert!((energy.start - 200.0).abs() < 1e-9);
    assert!(energy.end > 400.0 && energy.end < 600.0 && (energy.work - (energy.end - energy.start)).abs() < 1e-9);
}

#[test]
fn bounces_follow_their_formulas() {
    let (world, ..) = run::<2>("bounce");
    let impacts = world.impacts();
    let v = (2.0f64 * 9.81).sqrt();
    for (k, impact) in impacts.iter().enumerate() {
        let want = v * 0.9f64.powi(k as i32);
        assert!((impact.approach - want).abs() < 1e-12, "{k}: {} {want}", impact.approach);
    }
    assert_eq!(run::<2>("drop").2, Stop::Rest);
}

/// The same scene, the same bits: twice, and after it was written with every default and read again.
#[test]
fn an_expanded_scene_has_the_same_digest() {
    fn digest<const D: usize>(scene: &Scene, document: &Document) -> u64
    where
        Vector<D>: Rotates,
    {
        let mut world = build::<D>(scene, &document.plan(scene).unwrap()).unwrap();
        world.run(&scene.run.until.limits());
        world.digest()
    }
    for b in builtins() {
        let document = Document::parse(b.name, b.text).unwrap();
        let scene = document.scene().unwrap();
        let expanded = Document::parse("a.toml", &carom_scene::to_toml(&scene, carom_scene::Detail::Full)).unwrap();
        let again = expanded.scene().unwrap();
        let both = match scene.world.dim {
            1 => [digest::<1>(&scene, &document), digest::<1>(&again, &expanded)],
            2 => [digest::<2>(&scene, &document), digest::<2>(&again, &expanded)],
            _ => [digest::<3>(&scene, &document), digest::<3>(&again, &expanded)],
        };
        println!("{:10} {:016x}", b.name, both[0]);
        assert_eq!(both[0], both[1], "{}", b.name);
    }
}
