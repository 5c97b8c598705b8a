//! A text: it is refused with words, or it is a scene, which written and read is the same scene, and which runs.
use carom::ledger::DRIFT_LIMIT;
use carom::{Rotates, Vector, World};
use carom_scene::model::{Mass, Scene};
use carom_scene::{Detail, Document, Plan, build, to_json, to_toml};

use super::go::go;

/// Larger scenes are checked, and not run.
const BODIES: usize = 300;
/// How long a scene runs (s).
const SECONDS: f64 = 2.0;

/// Reads bytes as a scene file (JSON if the first that is not blank is `{`), as the command line does.
pub fn scene(bytes: &[u8]) {
    let told = Document::read("fuzzed", bytes).and_then(|document| {
        for note in document.notes() {
            assert!(!note.to_string().is_empty());
        }
        let scene = document.scene()?;
        survives(&scene);
        let asked: usize = scene.groups.iter().map(|g| g.count.unwrap_or(0).max(g.rows.saturating_mul(g.rows))).sum();
        if asked <= BODIES && scene.groups.iter().all(|g| g.count.is_some()) {
            let plan = document.plan(&scene)?;
            match scene.world.dim {
                1 => open::<1>(&scene, &plan),
                2 => open::<2>(&scene, &plan),
                _ => open::<3>(&scene, &plan),
            }
        }
        Ok(())
    });
    if let Err(problems) = told {
        assert!(!problems.to_string().is_empty(), "what is refused is refused with words");
    }
}

/// Written and read again, it is the same scene.
fn survives(scene: &Scene) {
    for detail in [Detail::Full, Detail::Short] {
        for (name, text) in [("a.toml", to_toml(scene, detail)), ("a.json", to_json(scene, detail))] {
            match Document::parse(name, &text).and_then(|d| d.scene()) {
                Ok(again) => assert_eq!(&again, scene, "{text}"),
                Err(problems) => panic!("{problems}\n{text}"),
            }
        }
    }
}

fn open<const D: usize>(scene: &Scene, plan: &Plan)
where
    Vector<D>: Rotates,
{
    let mut world: World<D> = build(scene, plan).expect("a plan is what a world can be made of");
    let width = scene.world.extent().map_or(f64::INFINITY, |(min, max)| {
        (0..D).filter(|&k| scene.world.is_periodic(k)).map(|k| max[k] - min[k]).fold(f64::INFINITY, f64::min)
    });
    go(&mut world, scene.run.until.time.unwrap_or(SECONDS).min(SECONDS), width);
    let drift = world.ledger().unexplained();
    assert!(!is_tame(scene, plan) || drift < DRIFT_LIMIT, "{drift:e} of an account is not explained");
}

/// True if all numbers are of a size that a scene might have: the limits of the others are known, and told in the README.
fn is_tame(scene: &Scene, plan: &Plan) -> bool {
    let fits = |x: f64| x == 0.0 || (1e-3..=1e3).contains(&x.abs());
    let heavy = |mass: &Mass| match *mass {
        Mass::Mass(m) | Mass::Density(m) => fits(m),
        _ => true,
    };
    plan.bodies.iter().all(|b| {
        let numbers = [b.position, b.velocity, b.spin];
        numbers.iter().flatten().all(|&x| fits(x))
            && fits(b.radius)
            && b.mass.is_none_or(fits)
            && b.inertia.is_none_or(fits)
    }) && scene.bodies.iter().all(|b| heavy(&b.ball.mass))
        && scene.walls.iter().all(|w| w.velocity.iter().all(|&x| fits(x)))
        && scene.world.gravity.iter().all(|&x| fits(x))
        && fits(scene.run.rest_speed)
}
