//! The same scene, the same bits: twice in a row, with cells of any width or lists of neighbours, with one `advance` or a thousand. What
//! `tools/determinism` compares besides are levels of optimisation, and wasm.
#[allow(dead_code)]
#[path = "../examples/digest.rs"]
mod digest;

use digest::{How, PLAIN, SCENES};

fn equal(hows: &[How]) {
    let mut different = Vec::new();
    for (name, scene) in SCENES {
        let want = scene(PLAIN);
        println!("{name:8} {:016x} {:016x} {:6} impacts", want.digest, want.impacts, want.count);
        for how in hows {
            let got = scene(*how);
            if got != want {
                println!("{name:8} {:016x} {:016x} {:6} impacts with {how:?}", got.digest, got.impacts, got.count);
                different.push((name, *how));
            }
        }
    }
    assert!(different.is_empty(), "{different:?}");
}

#[test]
fn twice_in_a_row() {
    equal(&[PLAIN, PLAIN]);
}

#[test]
fn with_cells_of_any_width() {
    equal(&[0.5, 1.3, 2.0, 5.0, 1000.0].map(|cells| How { cells, ..PLAIN }));
}

/// Cells of a thousand widths have no lean way, lists of neighbours or cells that doubt no image have one: all the same bits.
#[test]
fn with_lists_of_neighbours_or_without() {
    equal(&[0.0, 0.05, 0.3, 1.0].map(|margin| How { lists: Some(margin), ..PLAIN }));
}

#[test]
fn with_any_number_of_frames() {
    equal(&[2, 60, 1000, 1001].map(|frames| How { frames, ..PLAIN }));
}

#[test]
fn something_happens() {
    let count = |name: &str| SCENES.iter().find(|s| s.0 == name).unwrap().1(PLAIN).count;
    // Galperin: floor(pi 10^2). Dropped from h = 1 with e = 0.9: THEORY 4.1 counts 58 bounces, and the one that lasts.
    assert_eq!((count("pi"), count("bounce")), (314, 59));
    assert!(["gas", "spheres", "rough", "gravity", "cradle", "heap"].iter().all(|name| count(name) > 10));
}

/// A dense clump with a few balls scattered so far around it that its cells follow the density: the same bits as with few cells, or with
/// cells alone.
fn clump<const D: usize>(seed: u64, periodic: bool) -> carom::World<D>
where
    carom::Vector<D>: carom::Rotates,
{
    use carom::{Ball, Boundary, Vector, World};
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut dice = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let far = 400.0;
    let (low, high) = (Vector::from_fn(|_| -far), Vector::from_fn(|_| far));
    let mut world =
        World::new().boundary(if periodic { Boundary::periodic(low, high) } else { Boundary::walls(low, high) });
    let side: usize = if D == 2 { 14 } else { 6 };
    for n in 0..side.pow(D as u32) {
        let at = Vector::<D>::from_fn(|k| 2.2 * ((n / side.pow(k as u32)) % side) as f64 - 5.0);
        world.ball(Ball::new(1.0, 1.0).at(at).moving(Vector::from_fn(|_| dice() - 0.5)));
    }
    for _ in 0..12 {
        let at = Vector::<D>::from_fn(|_| far * (1.9 * dice() - 0.95));
        // Most fly back to the clump, fast.
        let _ = world.add(Ball::new(1.0, 0.5).at(at).moving(-at * 0.2));
    }
    world
}

fn clumps_move_alike<const D: usize>()
where
    carom::Vector<D>: carom::Rotates,
{
    for (seed, periodic) in (0..4).map(|seed| (seed, seed % 2 == 1)) {
        let end = |change: fn(&mut carom::World<D>)| {
            let mut world = clump::<D>(seed, periodic);
            change(&mut world);
            world.advance(6.0);
            assert!(world.impact_count() > 300, "{}", world.impact_count());
            (world.digest(), world.impact_count())
        };
        let want = end(|_| {});
        assert_eq!(want, end(|world| world.set_cell_scale(1000.0)), "seed {seed}");
        assert_eq!(want, end(|world| world.set_cell_scale(0.5)), "seed {seed}");
        assert_eq!(want, end(|world| world.set_lists(Some(0.0))), "seed {seed}");
        assert_eq!(want, end(|world| world.set_lists(Some(0.4))), "seed {seed}");
    }
}

#[test]
fn where_densities_differ() {
    clumps_move_alike::<2>();
    clumps_move_alike::<3>();
}
