use super::coder::{Encoder, Start};
use super::*;
use carom::{Ball, Impact, Rotates, Together, Vector, Wall, World};
use std::fs;
use std::path::PathBuf;

fn stage<const D: usize>(world: &World<D>, gravity: Vector<D>) -> Stage<D>
where
    Vector<D>: Rotates,
{
    let start = |id| {
        let inverse_mass = if world.is_fixed(id).unwrap() { 0.0 } else { 1.0 / world.mass(id).unwrap() };
        Start {
            id,
            position: world.position(id).unwrap(),
            velocity: world.velocity(id).unwrap(),
            spin: world.spin(id).unwrap(),
            inverse_mass,
            inverse_inertia: 0.0,
            radius: world.radius(id).unwrap(),
        }
    };
    let bodies = world.bodies().map(start).collect();
    Stage { bodies, walls: world.walls().collect(), gravity, corner: Vector::ZERO, width: Vector::ZERO }
}

/// Discs of unequal sizes and masses that bounce in a box under gravity.
fn box_of_discs() -> World<2> {
    let mut world = World::<2>::new().gravity([0.0, -9.81]).together(Together::Reflect);
    for (point, normal) in
        [([0.0, 0.0], [0.0, 1.0]), ([0.0, 2.0], [0.0, -1.0]), ([0.0, 0.0], [1.0, 0.0]), ([2.0, 0.0], [-1.0, 0.0])]
    {
        world.wall(Wall::plane(point, normal));
    }
    world.wall(Wall::segment([0.5, 1.0], [1.5, 1.1]).restitution(0.9));
    for k in 0..36 {
        let (i, j) = (f64::from(k % 6), f64::from(k / 6));
        let velocity = [(i * 1.7 + j).sin() * 3.0, (j * 2.3 - i).cos() * 3.0];
        let ball = Ball::new(1.0 + 0.1 * i, 0.05 + 0.004 * j).at([0.2 + 0.3 * i, 0.15 + 0.12 * j]);
        world.ball(ball.moving(velocity).restitution(0.99));
    }
    world
}

fn file(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("carom-files-{}-{name}.carom", std::process::id()))
}

#[test]
fn impacts_come_back_to_the_last_bit_and_cost_little() {
    let mut world = box_of_discs();
    let stage = stage(&world, [0.0, -9.81].into());
    let path = file("whole");
    let mut writer = Writer::new(fs::File::create(&path).unwrap(), Encoder::new(stage.clone()), "{}").unwrap();
    writer.keyframe(0.0, &world.snapshot()).unwrap();
    let mut all: Vec<Impact<2>> = Vec::new();
    for _ in 0..60 {
        world.advance(0.1);
        writer.impacts(world.impacts()).unwrap();
        all.extend_from_slice(world.impacts());
    }
    writer.keyframe(world.time(), &world.snapshot()).unwrap();
    writer.end("time", "0123456789abcdef").unwrap();
    let recording = Recording::open(&path).unwrap();
    assert_eq!((recording.impacts, recording.keyframes.len(), recording.torn), (all.len() as u64, 2, false));
    assert_eq!(recording.stopped, Some(("time".into(), "0123456789abcdef".into())));
    let mut read: Vec<Impact<2>> = Vec::new();
    let tell = |first: u64, impacts: &[Impact<2>]| {
        assert_eq!(first as usize, read.len() + 1);
        read.extend_from_slice(impacts);
        Ok::<bool, ()>(true)
    };
    let stage_again = stage.clone();
    recording.read(stage, u64::MAX, tell).unwrap().unwrap();
    assert_eq!(read.len(), all.len());
    for (a, b) in read.iter().zip(&all) {
        // Bits, not values: also the sign of zero.
        assert_eq!(format!("{a:?}"), format!("{b:?}"));
    }
    // The impacts alone: a keyframe of nothing hands over the last of them.
    let mut alone = Writer::new(Vec::new(), Encoder::new(stage_again), "{}").unwrap();
    let head = alone.whole();
    alone.impacts(&all).unwrap();
    alone.keyframe(0.0, &[]).unwrap();
    let bytes = (alone.whole() - head) as f64 / all.len() as f64;
    println!("{} impacts, {bytes:.1} bytes each", all.len());
    // Eight bytes a number would be 26 * 8.
    assert!(all.len() > 2000 && bytes < 40.0);
    // A keyframe goes on where it was taken.
    let again = World::<2>::restore(&recording.snapshot(&recording.last()).unwrap()).unwrap();
    assert_eq!((again.time(), again.digest()), (world.time(), world.digest()));
    let _ = fs::remove_file(path);
}

#[test]
fn what_is_torn_is_left_out_and_what_is_damaged_is_not_believed() {
    let mut world = box_of_discs();
    let stage = stage(&world, [0.0, -9.81].into());
    let path = file("torn");
    let mut writer = Writer::new(Vec::new(), Encoder::new(stage.clone()), "{\"title\":1}").unwrap();
    writer.keyframe(0.0, &world.snapshot()).unwrap();
    let first = writer.whole() as usize;
    for _ in 0..3 {
        world.advance(0.05);
        writer.impacts(world.impacts()).unwrap();
        writer.keyframe(world.time(), &world.snapshot()).unwrap();
    }
    let bytes = writer.get_ref().clone();
    let mut kept = 0;
    for cut in (0..bytes.len()).step_by(7) {
        fs::write(&path, &bytes[..cut]).unwrap();
        match Recording::open(&path) {
            Ok(recording) => {
                assert!(cut >= first);
                assert!(recording.last().end() as usize <= cut && recording.stopped.is_none());
                let read = recording.read(stage.clone(), u64::MAX, |_, _| Ok::<bool, ()>(true));
                assert!(read.is_ok());
                assert!(recording.keyframes.len() >= kept);
                kept = recording.keyframes.len();
            }
            Err(error) => assert!(cut < first, "{cut}: {error}"),
        }
    }
    fs::write(&path, &bytes).unwrap();
    assert_eq!((kept, Recording::open(&path).unwrap().keyframes.len()), (3, 4));
    for k in (0..bytes.len()).step_by(5) {
        let mut damaged = bytes.clone();
        damaged[k] ^= 0x10;
        fs::write(&path, &damaged).unwrap();
        // From the damaged chunk on nothing is read.
        if let Ok(recording) = Recording::open(&path) {
            assert!(recording.torn && recording.last().end() as usize <= k, "byte {k}");
        }
    }
    let _ = fs::remove_file(path);
}
