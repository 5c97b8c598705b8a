//! Bytes that say they are a snapshot: an error, or a world that can go on.
use std::sync::OnceLock;

use carom::{Ball, Boundary, Material, Rotates, Vector, Wall, World};

use super::go::go;

/// The first byte says what the rest is: a snapshot as it stands; the body of one, that gets its head and its seal here; or changes to
/// the snapshot of a sound world.
pub fn snapshot(bytes: &[u8]) {
    let Some((&first, rest)) = bytes.split_first() else { return };
    match first & 3 {
        1 => try_all::<1>(first >> 2, rest),
        3 => try_all::<3>(first >> 2, rest),
        _ => try_all::<2>(first >> 2, rest),
    }
}

fn try_all<const D: usize>(kind: u8, rest: &[u8])
where
    Vector<D>: Rotates,
{
    match kind {
        0 => follow::<D>(rest),
        1 => follow::<D>(&sealed(&[&head::<D>(), rest].concat())),
        // 16 bytes of the head stay, or nothing behind them would be read.
        k => follow::<D>(&sealed(&changed(&sound::<D>(usize::from(k) % WORLDS), rest))),
    }
}

/// Changes to a body: where (two bytes), how (one byte), and to what (one byte).
fn changed(body: &[u8], changes: &[u8]) -> Vec<u8> {
    let mut body = body.to_vec();
    for change in changes.chunks_exact(4).take(16) {
        let (at, how, what) = (usize::from(u16::from_le_bytes([change[0], change[1]])), change[2], change[3]);
        let at = HEAD + at % (body.len() - HEAD);
        match how % 8 {
            0..=2 => body[at] = what,
            3 => body[at] ^= what,
            4 => body[at] = body[at].wrapping_add(what),
            5 => body.insert(at, what),
            6 => drop(body.remove(at)),
            _ => body.truncate(at.max(HEAD + 1)),
        }
        if body.len() <= HEAD {
            break;
        }
    }
    body
}

/// Restores, and if that is a world, asks it everything and lets it go on.
fn follow<const D: usize>(bytes: &[u8])
where
    Vector<D>: Rotates,
{
    let Ok(mut world) = World::<D>::restore(bytes) else { return };
    let again = world.snapshot();
    let twin = World::<D>::restore(&again).expect("what a restored world writes is a snapshot");
    assert_eq!(twin.digest(), world.digest());
    let _ = (world.ledger(), world.bytes(), world.is_quiet());
    // The width of a periodic box is not told: the smallest ball fits into it twice.
    let smallest = world.bodies().filter_map(|id| world.radius(id).ok()).fold(f64::INFINITY, f64::min);
    go(&mut world, SECONDS, 4.0 * smallest);
    let _ = (world.ledger(), world.deepest_overlap());
    let first = world.bodies().next();
    if let Some(id) = first {
        let _ = world.set_velocity(id, Vector::from_fn(|k| 1.0 - k as f64));
        go(&mut world, SECONDS, 4.0 * smallest);
        let _ = world.remove(id);
        go(&mut world, SECONDS, 4.0 * smallest);
    }
}

/// Magic, dimension and layout.
const HEAD: usize = 17;

fn head<const D: usize>() -> Vec<u8>
where
    Vector<D>: Rotates,
{
    World::<D>::new().snapshot()[..HEAD].to_vec()
}

/// With the seal behind it (64-bit FNV-1a).
fn sealed(body: &[u8]) -> Vec<u8> {
    let seal = body
        .iter()
        .fold(0xcbf2_9ce4_8422_2325u64, |hash, &b| (hash ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3));
    [body, &seal.to_le_bytes()].concat()
}

/// How long it goes on each time (s).
const SECONDS: f64 = 0.015;

/// Sound worlds to begin with.
const WORLDS: usize = 6;

/// The body of the snapshot of the k-th, made once.
fn sound<const D: usize>(k: usize) -> Vec<u8>
where
    Vector<D>: Rotates,
{
    static MADE: [OnceLock<Vec<Vec<u8>>>; 3] = [const { OnceLock::new() }; 3];
    let made = MADE[D - 1].get_or_init(|| (0..WORLDS).map(make::<D>).collect());
    made[k % made.len()].clone()
}

fn make<const D: usize>(k: usize) -> Vec<u8>
where
    Vector<D>: Rotates,
{
    let up = Vector::<D>::axis(D - 1);
    let mut world = World::<D>::new();
    let rough = Material::new().restitution(0.5).friction(0.3).rolling(0.01);
    if k >= 1 {
        world.set_default_material(rough).expect("in range");
    }
    match k {
        // A gas in a box that goes round.
        0 => world.set_boundary(Boundary::periodic([0.0; D], [2.0; D])).expect("there is room"),
        // Balls that fall, slide, roll and pile up; with walls; and a floor that is driven.
        _ => {
            world.set_gravity(up * -9.81).expect("finite");
            world.set_boundary(Boundary::walls([0.0; D], [2.0; D])).expect("there is room");
        }
    }
    let rows = if D == 1 { 1 } else { 3 };
    for i in 0..2 + 2 * D {
        let at = Vector::<D>::from_fn(|a| match a {
            a if a == D - 1 => 0.11 + 0.25 * (i / rows) as f64,
            0 => 0.4 + 0.205 * (i % rows) as f64,
            _ => 1.0,
        });
        let push = Vector::<D>::axis(0) * (0.3 * (i % 3) as f64);
        let ball = Ball::new(1.0 + (i % 2) as f64, 0.1).at(at).moving(push).user(i as u64);
        world.add(if i == 5 { ball.sensor() } else { ball }).expect("sound");
    }
    if k == 4 && D == 2 {
        world.add_wall(Wall::segment(Vector::from_fn(|_| 0.1), Vector::from_fn(|a| 1.9 - a as f64))).expect("sound");
    }
    let bodies: Vec<_> = world.bodies().collect();
    world.ignore(bodies[0], bodies[2], k == 5).expect("both are there");
    world.advance([0.3, 0.2, 0.7, 1.5, 0.4, 0.9][k]);
    if k == 3 {
        world.remove(bodies[1]).expect("it is there");
        let floor = world.side(D - 1, false).expect("a box has a floor");
        world.set_wall_velocity(floor, up * 0.1).expect("it is there");
        world.advance(0.01);
    }
    let bytes = world.snapshot();
    bytes[..bytes.len() - 8].to_vec()
}
