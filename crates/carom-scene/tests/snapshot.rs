//! A world that is written to bytes and read back goes on as if nothing had been: the same impacts, the same books, the same
//! digest, wherever it is cut.
use carom::{Error, Impact, Limits, Rotates, Stop, Vector, World};
use carom_scene::{Document, Plan, Scene, build, builtin};

/// How far each scene is followed: impacts at most, and seconds at most.
const SCENES: [(&str, u64, f64); 17] = [
    ("bernoulli", 100, 10.0),
    ("bounce", 400, 20.0),
    ("break", 1500, 20.0),
    ("collapse", 3000, 2.0),
    ("cradle", 300, 10.0),
    ("drop", 3000, 1.2),
    ("galton", 1500, 5.0),
    ("gas", 6000, 10.0),
    ("grip", 400, 3.0),
    ("heap", 400, 0.5),
    ("marble", 400, 1.5),
    ("pi-31", 40, 1e3),
    ("piston", 3000, 10.0),
    ("slide-roll", 400, 1.5),
    ("spheres", 4000, 10.0),
    ("topspin", 400, 8.0),
    ("tower", 300, 5.0),
];
/// Into so many pieces a run is cut.
const CUTS: u32 = 12;

fn scene(name: &str) -> (Scene, Plan) {
    let document = Document::parse(name, builtin(name).expect(name)).unwrap();
    let scene = document.scene().unwrap();
    let plan = document.plan(&scene).unwrap();
    (scene, plan)
}

/// All that happens up to the end, and what is left then.
#[derive(Debug, PartialEq)]
struct Told<const D: usize>
where
    Vector<D>: Rotates,
{
    impacts: Vec<Impact<D>>,
    stop: Stop,
    digest: u64,
    ledger: carom::Ledger<D>,
    slices: u64,
}

fn to_the_end<const D: usize>(world: &mut World<D>, most: u64, time: f64) -> Told<D>
where
    Vector<D>: Rotates,
{
    let stop = world.run(&Limits { time: Some(time), impacts: Some(most), ..Limits::default() });
    Told {
        impacts: world.impacts().to_vec(),
        stop,
        digest: world.digest(),
        ledger: world.ledger(),
        slices: world.slice_count(),
    }
}

fn restored<const D: usize>(world: &World<D>) -> World<D>
where
    Vector<D>: Rotates,
{
    let bytes = world.snapshot();
    let again = World::<D>::restore(&bytes).expect("what was just written");
    assert_eq!(again.digest(), world.digest());
    assert_eq!(again.ledger(), world.ledger());
    assert_eq!(again.snapshot(), bytes, "a snapshot of what was restored is the same");
    again
}

fn follow<const D: usize>(name: &str, most: u64, time: f64)
where
    Vector<D>: Rotates,
{
    let (scene, plan) = scene(name);
    let start = || build::<D>(&scene, &plan).unwrap();
    let whole = to_the_end(&mut start(), most, time);
    let (count, end) = (whole.impacts.len(), whole.impacts.last().map_or(time, |i| i.time).min(time));
    // One world that is never whole for long; and each cut followed to the end, in small worlds.
    let mut world = start();
    let (mut cuts, mut bytes, mut seen) = (0, 0, Vec::new());
    for k in 0..=CUTS {
        let part = f64::from(k) / f64::from(CUTS);
        world = restored(&world);
        bytes = bytes.max(world.snapshot().len());
        if k > 0 && k % 4 == 0 {
            let told = to_the_end(&mut restored(&world), most, time);
            assert!(whole.impacts.ends_with(&told.impacts), "{name}: cut {k}");
            assert_eq!((told.digest, told.ledger), (whole.digest, whole.ledger), "{name}: cut {k}");
        }
        // By turns at a time, in the middle of flights and slices, and right behind an impact.
        let limits = match k % 2 {
            0 => Limits { time: Some(part * end), ..Limits::default() },
            _ => Limits { impacts: Some((part * count as f64) as u64), time: Some(end), ..Limits::default() },
        };
        world.run(&limits);
        seen.extend_from_slice(world.impacts());
        cuts += 1;
    }
    world = restored(&world);
    let rest = to_the_end(&mut world, most, time);
    seen.extend_from_slice(&rest.impacts);
    println!(
        "{name:10} {:5} bodies {count:5} impacts {:6} slices {cuts:3} cuts {bytes:8} bytes",
        plan.bodies.len(),
        whole.slices
    );
    assert_eq!(seen, whole.impacts, "{name}");
    assert_eq!((rest.stop, rest.digest, rest.ledger), (whole.stop, whole.digest, whole.ledger), "{name}");
    assert_eq!(rest.slices, whole.slices, "{name}");
}

#[test]
fn a_restored_world_goes_on_to_the_last_bit() {
    for (name, most, time) in SCENES {
        match scene(name).1.dim {
            1 => follow::<1>(name, most, time),
            2 => follow::<2>(name, most, time),
            _ => follow::<3>(name, most, time),
        }
    }
}

#[test]
fn a_change_by_the_user_that_waits_is_kept() {
    let (scene, plan) = scene("heap");
    let mut world = build::<2>(&scene, &plan).unwrap();
    world.advance(0.3);
    let first = world.bodies().next().unwrap();
    world.set_velocity(first, [0.5, 1.0]).unwrap();
    let eighth = world.bodies().nth(7).unwrap();
    world.remove(eighth).unwrap();
    let mut again = restored(&world);
    assert_eq!(world.advance(0.1), again.advance(0.1));
    assert_eq!(world.digest(), again.digest());
    // The place that was left is used again, by both.
    let ball = carom::Ball::new(1.0, 0.01).at([0.0, 9.0]);
    assert_eq!(world.add(ball.clone()), again.add(ball));
    // Not the snapshots, which count crossings of cells: a restored world lays its cells anew, round the heap as it is by then.
    assert_eq!(world.advance(0.2), again.advance(0.2));
    assert_eq!((world.digest(), world.ledger()), (again.digest(), again.ledger()));
}

#[test]
fn damaged_bytes_are_refused() {
    let (scene, plan) = scene("drop");
    let mut world = build::<2>(&scene, &plan).unwrap();
    world.advance(0.6);
    let bytes = world.snapshot();
    assert!(matches!(World::<3>::restore(&bytes), Err(Error::Snapshot(m)) if m.contains("dimension")));
    for cut in 0..bytes.len().min(400) {
        assert!(World::<2>::restore(&bytes[..cut]).is_err(), "cut to {cut}");
        assert!(World::<2>::restore(&bytes[..bytes.len() - 1 - cut]).is_err());
    }
    for k in 0..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[k] ^= 1 << (k % 8);
        assert!(World::<2>::restore(&damaged).is_err(), "byte {k}");
    }
}

/// Bytes that were tampered with and sealed again: refused or not, nothing panics and nothing fills the memory.
#[test]
fn nothing_that_is_sealed_makes_it_panic() {
    let (scene, plan) = scene("heap");
    let mut world = build::<2>(&scene, &plan).unwrap();
    world.advance(0.35);
    let bytes = world.snapshot();
    let (mut accepted, mut refused) = (0, 0);
    for k in (17..bytes.len() - 8).step_by(11) {
        for change in [0x01u8, 0x80, 0xff] {
            let mut damaged = bytes.clone();
            damaged[k] ^= change;
            let end = damaged.len() - 8;
            let seal = fnv(&damaged[..end]);
            damaged[end..].copy_from_slice(&seal.to_le_bytes());
            match World::<2>::restore(&damaged) {
                Ok(world) => {
                    let _ = (world.digest(), world.ledger(), world.snapshot());
                    accepted += 1;
                }
                Err(error) => {
                    assert!(matches!(error, Error::Snapshot(_)));
                    refused += 1;
                }
            }
        }
    }
    println!("{} bytes: {accepted} accepted, {refused} refused", bytes.len());
    assert!(refused > 0 && accepted > 0, "both happen: a changed position is a position");
}

/// 64-bit FNV-1a.
fn fnv(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &b| (hash ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3))
}
