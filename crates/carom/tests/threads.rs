//! Results never depend on the number of threads: impacts, accounts, counts and the final state are the same to the last bit.
use carom::{Ball, Boundary, Impact, Material, Rotates, Vector, World};

/// A dense gas on a lattice with gaps, whose velocities are thrown by a multiplicative generator (Park and Miller 1988).
fn gas<const D: usize>(side: usize, fraction: f64, restitution: f64) -> World<D>
where
    Vector<D>: Rotates,
{
    let radius = 0.5;
    let volume = if D == 2 { std::f64::consts::PI / 4.0 } else { std::f64::consts::PI / 6.0 };
    let pitch = (volume / fraction).powf(1.0 / D as f64);
    let width = side as f64 * pitch;
    let mut world = World::<D>::new().boundary(Boundary::periodic(Vector::ZERO, Vector::from_fn(|_| width)));
    world.set_default_material(Material::new().restitution(restitution)).expect("a material");
    let mut seed = 1u64;
    let mut dice = || {
        seed = seed * 48_271 % 2_147_483_647;
        seed as f64 / 2_147_483_647.0 - 0.5
    };
    for code in 0..side.pow(D as u32) {
        let at = Vector::from_fn(|k| (code / side.pow(k as u32) % side) as f64 * pitch + 0.5 * pitch);
        let v = Vector::from_fn(|_| dice());
        world.ball(Ball::new(1.0 + 0.5 * dice(), radius).at(at).moving(v));
    }
    world
}

/// The impacts of some frames, and what the world is then.
fn run<const D: usize>(mut world: World<D>, threads: usize, frames: usize, dt: f64) -> (Vec<Impact<D>>, String)
where
    Vector<D>: Rotates,
{
    world.set_threads(threads);
    let mut impacts = Vec::new();
    for _ in 0..frames {
        impacts.extend_from_slice(world.advance(dt));
    }
    (impacts, format!("{:016x} {} {:?}", world.digest(), world.event_count(), world.ledger()))
}

fn same<const D: usize>(side: usize, fraction: f64, restitution: f64, frames: usize, dt: f64)
where
    Vector<D>: Rotates,
{
    assert!(side.pow(D as u32) >= 4096, "smaller worlds share nothing out");
    let (one, left) = run(gas::<D>(side, fraction, restitution), 1, frames, dt);
    assert!(one.len() > 3 * side, "{} impacts", one.len());
    for threads in [2, 3] {
        let (many, right) = run(gas::<D>(side, fraction, restitution), threads, frames, dt);
        assert_eq!(left, right);
        assert!(one == many, "the impacts differ");
    }
}

#[test]
fn discs_in_lists() {
    same::<2>(64, 0.6, 1.0, 2, 0.1);
}

#[test]
fn discs_in_cells() {
    same::<2>(64, 0.3, 1.0, 2, 1.0);
}

#[test]
fn spheres_that_cool() {
    same::<3>(16, 0.45, 0.9, 2, 0.1);
}
