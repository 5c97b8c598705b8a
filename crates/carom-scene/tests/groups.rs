//! Where the bodies of a group lie, and how they move: against the formulas.
use carom_scene::{Document, Placed, Plan};

fn plan(text: &str) -> Plan {
    let document = Document::parse("a.toml", &format!("carom = 1\n{text}")).unwrap_or_else(|e| panic!("{e}"));
    let scene = document.scene().unwrap_or_else(|e| panic!("{e}"));
    document.plan(&scene).unwrap_or_else(|e| panic!("{e}"))
}

fn distance(a: &Placed, b: &Placed) -> f64 {
    (0..3).map(|k| (a.position[k] - b.position[k]).powi(2)).sum::<f64>().sqrt()
}

/// The gap of every pair, in radii of 0.1, least first.
fn gaps(plan: &Plan) -> Vec<f64> {
    let mut all = Vec::new();
    for (k, a) in plan.bodies.iter().enumerate() {
        all.extend(plan.bodies[..k].iter().map(|b| (distance(a, b) - a.radius - b.radius) / a.radius));
    }
    all.sort_by(f64::total_cmp);
    all
}

#[test]
fn a_rack_touches_within_rounding() {
    for direction in ["[1.0, 0.0]", "[0.0, -3.0]", "[1.0, 2.0]"] {
        for rows in 1..=6 {
            let plan = plan(&format!(
                "[world]\ndim = 2\n[[group]]\nkind = \"rack\"\nrows = {rows}\norigin = [3.0, -2.0]\ndirection = {direction}\n\
                 body = {{ mass = 1, radius = 0.1 }}"
            ));
            assert_eq!(plan.bodies.len(), rows * (rows + 1) / 2);
            assert_eq!(plan.bodies[0].position, [3.0, -2.0, 0.0]);
            let gaps = gaps(&plan);
            // Each row touches within itself (i pairs in row i) and each body the two behind it.
            let touching = 3 * rows * (rows - 1) / 2;
            println!("{direction} {rows}: {} touch, gaps {:?}", touching, gaps.first());
            // Coordinates near 4 are rounded by 4e-16, which is 4e-15 r; a difference has two of them and their products.
            assert!(gaps[..touching].iter().all(|g| g.abs() < 1e-13), "{gaps:?}");
            assert!(gaps[touching..].iter().all(|g| *g > 0.7), "{gaps:?}");
        }
    }
}

#[test]
fn lattices_fill_along_x_then_y_then_z() {
    let square = plan(
        "[world]\ndim = 2\n[[group]]\nname = \"s\"\nkind = \"square\"\ncount = 7\nmin = [0, 0]\nmax = [1, 1]\nspacing = 0.1\n\
         body = { mass = 1, radius = 0.1 }",
    );
    let at: Vec<_> = square.bodies.iter().map(|b| [b.position[0], b.position[1]]).collect();
    let p = |i: f64, j: f64| [0.1 + i * (0.2 + 0.1), 0.1 + j * (0.2 + 0.1)];
    let want = [(0., 0.), (1., 0.), (2., 0.), (0., 1.), (1., 1.), (2., 1.), (0., 2.)];
    for (got, (i, j)) in at.iter().zip(want) {
        assert!((got[0] - p(i, j)[0]).abs() < 1e-15 && (got[1] - p(i, j)[1]).abs() < 1e-15, "{at:?}");
    }
    assert_eq!((square.name(0), square.name(6), square.name(7)), ("s-1".into(), "s-7".into(), String::new()));

    // Ten exactly fit into a length of ten pitches: no rounding loses the last.
    let full = plan(
        "[world]\ndim = 2\n[[group]]\nkind = \"square\"\nmin = [0, 0]\nmax = [1, 1]\nbody = { mass = 1, radius = 0.05 }",
    );
    assert_eq!(full.bodies.len(), 100);
    let line = plan(
        "[world]\ndim = 1\n[[group]]\nkind = \"square\"\nmin = [0]\nmax = [1]\nbody = { mass = 1, radius = 0.05 }",
    );
    assert_eq!(line.bodies.len(), 10);
    let cube = plan(
        "[world]\ndim = 3\n[[group]]\nkind = \"square\"\nmin = [0, 0, 0]\nmax = [1, 1, 1]\nbody = { mass = 1, radius = 0.1 }",
    );
    assert_eq!(cube.bodies.len(), 125);
}

#[test]
fn hexagonal_rows_are_shifted_and_touch() {
    let plan = plan(
        "[world]\ndim = 2\n[[group]]\nkind = \"hexagonal\"\nmin = [0, 0]\nmax = [1, 1]\nbody = { mass = 1, radius = 0.1 }",
    );
    // Rows of 5 and 4, sqrt(3)/10 apart: (1 - 0.2) / 0.1732 = 4.6, so five rows.
    assert_eq!(plan.bodies.len(), 5 + 4 + 5 + 4 + 5);
    let step = 0.2 * 3.0f64.sqrt() / 2.0;
    assert!(
        (plan.bodies[5].position[0] - 0.2).abs() < 1e-15 && (plan.bodies[5].position[1] - 0.1 - step).abs() < 1e-15
    );
    let gaps = gaps(&plan);
    // Touching pairs: within rows 4+3+4+3+4, between rows 4 times 8.
    assert!(gaps[..18 + 32].iter().all(|g| g.abs() < 1e-13) && gaps[50] > 0.7, "{gaps:?}");
}

#[test]
fn fcc_has_twelve_neighbours() {
    let plan = plan(
        "[world]\ndim = 3\n[[group]]\nkind = \"fcc\"\nmin = [0, 0, 0]\nmax = [1.2, 1.2, 1.2]\nbody = { mass = 1, radius = 0.1 }",
    );
    let inner = plan.bodies.iter().filter(|a| a.position.iter().all(|x| *x > 0.35 && *x < 0.85));
    let mut seen = 0;
    for a in inner {
        let touching = plan.bodies.iter().filter(|b| (distance(a, b) - 0.2).abs() < 1e-14).count();
        assert_eq!(touching, 12);
        seen += 1;
    }
    assert!(seen > 4, "{seen} of {}", plan.bodies.len());
    assert!(gaps(&plan)[0] > -1e-13);
}

/// Where the region goes round, a crystal closes on itself: the perfect one of N bodies fits a cell made for it.
#[test]
fn crystals_close_through_a_periodic_boundary() {
    let (n, m) = (8, 6);
    let pitch = 0.2;
    let (lx, ly) = (n as f64 * pitch, m as f64 * pitch * 3.0f64.sqrt() / 2.0);
    let hexagonal = plan(&format!(
        "[world]\ndim = 2\nboundary = {{ kind = \"periodic\", min = [0, 0], max = [{lx:?}, {ly:?}] }}\n[run]\nuntil = {{ time = 1 }}\n\
         [[group]]\nkind = \"hexagonal\"\nbody = {{ mass = 1, radius = 0.1 }}"
    ));
    assert_eq!(hexagonal.bodies.len(), n * m);
    let a = 0.2 * 2.0f64.sqrt() * 3.0;
    let fcc = plan(&format!(
        "[world]\ndim = 3\nboundary = {{ kind = \"periodic\", min = [0, 0, 0], max = [{a:?}, {a:?}, {a:?}] }}\n[run]\n\
         until = {{ time = 1 }}\n[[group]]\nkind = \"fcc\"\nbody = {{ mass = 1, radius = 0.1 }}"
    ));
    assert_eq!(fcc.bodies.len(), 4 * 27);
    for body in hexagonal.bodies.iter().chain(&fcc.bodies) {
        assert!(body.position.iter().all(|x| *x >= 0.0 && *x < lx.max(a)));
    }
}

#[test]
fn a_line_goes_its_way() {
    let plan = plan(
        "[world]\ndim = 3\n[[group]]\nkind = \"line\"\ncount = 4\norigin = [1, 2, 3]\ndirection = [0, 3, 4]\nspacing = 0.3\n\
         body = { mass = 1, radius = 0.1 }",
    );
    for (k, body) in plan.bodies.iter().enumerate() {
        let s = 0.5 * k as f64;
        let want = [1.0, 2.0 + 0.6 * s, 3.0 + 0.8 * s];
        assert!((0..3).all(|i| (body.position[i] - want[i]).abs() < 1e-15), "{:?}", body.position);
    }
}

#[test]
fn random_places_overlap_nothing_and_repeat() {
    let text = |seed: u64, spacing: f64| {
        format!(
            "[world]\ndim = 2\nboundary = {{ kind = \"box\", min = [0, 0], max = [1, 1] }}\n[[wall]]\n\
             segment = {{ from = [0.2, 0.5], to = [0.8, 0.5] }}\n[[body]]\nfixed = true\nradius = 0.1\nposition = [0.5, 0.75]\n\
             [[group]]\nkind = \"random\"\ncount = 60\nspacing = {spacing:?}\nbody = {{ mass = 1, radius = 0.02 }}\n\
             [run]\nuntil = {{ time = 1 }}\nseed = {seed}"
        )
    };
    let (first, again, other) = (plan(&text(1, 0.0)), plan(&text(1, 0.0)), plan(&text(2, 0.0)));
    assert_eq!(first.bodies, again.bodies);
    assert_ne!(first.bodies, other.bodies);
    assert!(gaps(&first)[0] > -1e-9);
    for body in &first.bodies[1..] {
        assert!(first.sides.iter().all(|s| s.outline.distance(body.position) >= 0.02 * (1.0 - 1e-9)));
    }
    let apart = plan(&text(1, 0.03));
    for (k, a) in apart.bodies.iter().enumerate().skip(2) {
        assert!(apart.bodies[1..k].iter().all(|b| distance(a, b) >= 0.07 - 1e-9));
    }
}

#[test]
fn velocities_have_the_moments_that_were_asked_for() {
    for dim in 1..=3usize {
        let vector = |x: &str| vec![x; dim].join(", ");
        let text = |velocity: &str| {
            format!(
                "[world]\ndim = {dim}\n[[group]]\nkind = \"square\"\ncount = 500\nmin = [{}]\nmax = [{}]\n\
                 body = {{ mass = 2.5, radius = 0.1 }}\nvelocity = {{ {velocity} }}",
                vector("0.0"),
                vector("200.0")
            )
        };
        let maxwell = plan(&text("distribution = \"maxwell\", temperature = 3.0"));
        let n = maxwell.bodies.len() as f64;
        let temperature: f64 =
            maxwell.bodies.iter().map(|b| 2.5 * b.velocity.iter().map(|v| v * v).sum::<f64>()).sum::<f64>()
                / n
                / dim as f64;
        let momentum = |k: usize| maxwell.bodies.iter().map(|b| 2.5 * b.velocity[k]).sum::<f64>();
        println!("{dim}: temperature {temperature}, momentum {:?}", [momentum(0), momentum(1), momentum(2)]);
        // Sums of 500 terms of size 1: their rounding is some 1e-15 each, and grows as their root.
        assert!((temperature - 3.0).abs() < 1e-13);
        assert!((0..3).all(|k| momentum(k).abs() < 1e-11));
        // Speeds along different axes are not the same numbers.
        assert!(dim == 1 || maxwell.bodies[0].velocity[0] != maxwell.bodies[0].velocity[1]);

        let loose = plan(&text("distribution = \"maxwell\", temperature = 3.0, zero_momentum = false"));
        assert!(loose.bodies.iter().map(|b| b.velocity[0]).sum::<f64>().abs() > 1e-6);

        let uniform = plan(&text("distribution = \"uniform\", speed = 1.5"));
        for body in &uniform.bodies {
            let speed = body.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
            assert!((speed - 1.5).abs() < 1e-15);
        }
        let mean = uniform.bodies.iter().map(|b| b.velocity[0]).sum::<f64>() / n;
        // Five standard errors of a component of variance 1.5^2 / dim.
        assert!(mean.abs() < 5.0 * 1.5 / (n * dim as f64).sqrt(), "{mean}");

        let fixed = plan(&text(&format!("distribution = \"fixed\", value = [{}]", vector("0.25"))));
        assert!(fixed.bodies.iter().all(|b| b.velocity[..dim].iter().all(|v| *v == 0.25)));
    }
}

#[test]
fn densities_become_masses_by_length_area_and_volume() {
    use std::f64::consts::PI;
    for (dim, want) in [(1, 2.0 * 2.0 * 0.5), (2, 2.0 * PI * 0.25), (3, 2.0 * 4.0 / 3.0 * PI * 0.125)] {
        let position = vec!["0"; dim].join(", ");
        let plan = plan(&format!("[world]\ndim = {dim}\n[[body]]\ndensity = 2\nradius = 0.5\nposition = [{position}]"));
        let mass = plan.bodies[0].mass.unwrap();
        assert!((mass - want).abs() < 1e-15 * want * 4.0, "{mass} {want}");
    }
}

#[test]
fn bodies_walls_and_boundary_come_in_the_order_of_the_contract() {
    let plan = plan(
        "[[group]]\nname = \"g\"\nkind = \"line\"\ncount = 2\norigin = [5, 5]\nbody = { mass = 1, radius = 0.1 }\n\
         [[body]]\nname = \"A\"\nmass = 1\nradius = 0.1\nposition = [1, 1]\n[world]\ndim = 2\n\
         boundary = { kind = \"box\", min = [0, 0], max = [9, 9], material = \"m\" }\n[[wall]]\n\
         plane = { point = [0, 0], normal = [1, 1] }\n[[body]]\nmass = 1\nradius = 0.1\nposition = [2, 2]\n[material.m]\n\
         [run]\nuntil = { time = 1 }",
    );
    let names: Vec<_> = (0..plan.bodies.len()).map(|k| plan.name(k)).collect();
    assert_eq!(names, ["A", "body-2", "g-1", "g-2"]);
    let sides: Vec<_> = plan.sides.iter().map(|s| (s.label.as_str(), s.material)).collect();
    assert_eq!(
        sides,
        [("wall:wall-1", 0), ("boundary:x-", 1), ("boundary:x+", 1), ("boundary:y-", 1), ("boundary:y+", 1)]
    );
}

/// A hundred thousand bodies are placed and checked in the time of a breath, of whatever sizes.
#[test]
fn large_scenes_are_checked_in_linear_time() {
    let start = std::time::Instant::now();
    let plan = plan(
        "[world]\ndim = 2\n[[body]]\nmass = 1\nradius = 50\nposition = [0, -60]\n[[group]]\nkind = \"square\"\ncount = 100_000\n\
         min = [0, 0]\nmax = [10, 10]\nbody = { mass = 1, radius = 0.01 }",
    );
    println!("{} bodies in {:?}", plan.bodies.len(), start.elapsed());
    assert_eq!(plan.bodies.len(), 100_001);
}
