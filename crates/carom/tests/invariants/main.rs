//! The world against a simulator of quadratic cost that was written to be obviously right, event by event, and the invariants
//! that hold in every world.
//!
//! The simulator knows no cells, no queue and no records: it keeps every body at the present time, writes each meeting as a
//! polynomial in time, takes the earliest of all of them, and applies the lecture's law.
use carom::{Ball, BodyId, Boundary, Impact, Limits, Party, Rotates, Vector, Wall, WallId, World};
use proptest::prelude::*;

mod simulator;
use simulator::{APART, Body, Hit, Model, Plane, WALLS};

// ---------------------------------------------------------------------------------------------------------------------
// Random worlds

#[derive(Clone, Copy, Debug, PartialEq)]
enum Edge {
    Open,
    Walls,
    Periodic,
    /// Closed along axis 0, walls along the others.
    Mixed,
    /// Planes of the user's, one of them driven inwards and one tilted.
    Planes,
}

#[derive(Clone, Debug)]
struct Recipe {
    seed: u64,
    count: usize,
    edge: Edge,
    gravity: bool,
    elastic: bool,
}

fn recipe() -> impl Strategy<Value = Recipe> {
    let edge =
        prop_oneof![Just(Edge::Open), Just(Edge::Walls), Just(Edge::Periodic), Just(Edge::Mixed), Just(Edge::Planes)];
    (any::<u64>(), 2..13usize, edge, any::<bool>(), any::<bool>())
        .prop_map(|(seed, count, edge, gravity, elastic)| Recipe { seed, count, edge, gravity, elastic })
}

/// A small generator (xorshift64*), so that a recipe is one number.
struct Dice(u64);

impl Dice {
    fn new(seed: u64) -> Self {
        Self(seed ^ 0x9e37_79b9_7f4a_7c15 | 1)
    }

    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }

    fn vector<const D: usize>(&mut self, low: f64, high: f64) -> Vector<D> {
        Vector::from_fn(|_| self.between(low, high))
    }
}

/// The box has this width, its lower corner at the origin.
fn width<const D: usize>() -> f64 {
    if D == 1 { 12.0 } else { 3.0 }
}

fn random_body<const D: usize>(dice: &mut Dice, recipe: &Recipe, model: &Model<D>) -> Option<Body<D>> {
    let kind = dice.next();
    let fixed = kind < 0.15;
    // A driven body goes through walls and may crush: only where there are none.
    let driven = kind < 0.07 && recipe.edge == Edge::Open && !recipe.gravity;
    let r = dice.between(0.1, 0.3);
    let mass = 10f64.powf(dice.between(-1.0, 1.0));
    let e = if recipe.elastic || dice.next() < 0.3 { None } else { Some(dice.between(0.4, 1.0)) };
    let v = if driven {
        dice.vector(-0.5, 0.5)
    } else if fixed {
        Vector::ZERO
    } else {
        dice.vector(-1.0, 1.0)
    };
    for _ in 0..200 {
        let x = dice.vector(0.0, width::<D>());
        if model.room(x, r, None) > 1e-3 {
            return Some(Body {
                x,
                v,
                w: if fixed { 0.0 } else { 1.0 / mass },
                r,
                e,
                layers: (1, u32::MAX),
                alive: true,
            });
        }
    }
    None
}

fn random_model<const D: usize>(recipe: &Recipe) -> Model<D> {
    let dice = &mut Dice::new(recipe.seed);
    let mut model = Model {
        time: 0.0,
        bodies: Vec::new(),
        planes: Vec::new(),
        gravity: Vector::ZERO,
        width: Vector::ZERO,
        ignored: Vec::new(),
        stuck: false,
    };
    let size = width::<D>();
    for k in 0..D {
        let closed = recipe.edge == Edge::Periodic || recipe.edge == Edge::Mixed && k == 0;
        if closed {
            model.width[k] = size;
        } else if recipe.edge != Edge::Open {
            for (at, sign) in [(0.0, 1.0), (size, -1.0)] {
                let mut point = Vector::ZERO;
                point[k] = at;
                model.planes.push(Plane { point, normal: Vector::axis(k) * sign, velocity: Vector::ZERO, e: None });
            }
        }
    }
    // A world that closes on itself along gravity would fall for ever.
    if recipe.gravity && model.width[D - 1] == 0.0 {
        model.gravity[D - 1] = -1.0;
    }
    if recipe.edge == Edge::Planes {
        let e = Some(dice.between(0.5, 1.0));
        // It starts a whole width outside and comes in slowly; nothing is crushed while the test looks.
        model.planes[0].velocity = Vector::axis(0) * 0.05;
        model.planes[1].e = e;
        if D > 1 {
            let tilt = Vector::axis(0) * dice.between(-0.3, 0.3) + Vector::axis(1);
            model.planes.push(Plane { point: Vector::ZERO, normal: tilt / tilt.norm(), velocity: Vector::ZERO, e });
        }
    }
    for _ in 0..recipe.count {
        if let Some(body) = random_body(dice, recipe, &model) {
            model.bodies.push(body);
        }
    }
    model
}

fn ball_of<const D: usize>(b: &Body<D>) -> Ball<D>
where
    Vector<D>: Rotates,
{
    let ball = if b.w > 0.0 { Ball::new(1.0 / b.w, b.r) } else { Ball::fixed(b.r) };
    let ball = ball.at(b.x).moving(b.v).layers(b.layers.0, b.layers.1);
    match b.e {
        Some(e) => ball.restitution(e),
        None => ball,
    }
}

fn world_of<const D: usize>(recipe: &Recipe, model: &Model<D>) -> (World<D>, Vec<BodyId>, Vec<WallId>)
where
    Vector<D>: Rotates,
{
    let mut world = World::new().gravity(model.gravity).rest_speed(0.0);
    let size = Vector::from_fn(|_| width::<D>());
    match recipe.edge {
        Edge::Open | Edge::Planes => {}
        Edge::Walls => world.set_boundary(Boundary::walls(Vector::ZERO, size)).unwrap(),
        Edge::Periodic => world.set_boundary(Boundary::periodic(Vector::ZERO, size)).unwrap(),
        Edge::Mixed => world.set_boundary(Boundary::walls(Vector::ZERO, size).closed_along(0)).unwrap(),
    }
    if recipe.edge == Edge::Planes {
        for p in &model.planes {
            let wall = Wall::plane(p.point, p.normal).moving(p.velocity);
            world.wall(match p.e {
                Some(e) => wall.restitution(e),
                None => wall,
            });
        }
    }
    let ids = model.bodies.iter().map(|b| world.ball(ball_of(b))).collect();
    let walls: Vec<WallId> = world.walls().collect();
    assert_eq!(walls.len(), model.planes.len());
    (world, ids, walls)
}

/// The parties of the world's impact by the model's numbers.
fn parties<const D: usize>(impact: &Impact<D>, ids: &[BodyId], walls: &[WallId]) -> (usize, usize)
where
    Vector<D>: Rotates,
{
    let number = |p: Party| match p {
        Party::Body(id) => ids.iter().position(|b| *b == id).unwrap(),
        Party::Wall(id) => WALLS + walls.iter().position(|w| *w == id).unwrap(),
    };
    let (a, b) = (number(impact.parties[0]), number(impact.parties[1]));
    (a.min(b), a.max(b))
}

/// Trajectories diverge exponentially, in the model as in the world. How far the model can be trusted is measured: a second
/// one starts from positions moved by this much, a thousand times the rounding of a double, and as long as the two agree to
/// [`TRUSTED`], rounding has not grown to more than a thousandth of that.
const NUDGE: f64 = 1e-12;
const TRUSTED: f64 = 1e-9;
/// Where bounces die away under gravity, a rounding d of a position is one of d g/v of a speed v: the nudge at the start does not
/// see those. Above this approach speed (m/s) they stay below 1e-13.
const SLOW: f64 = 1e-2;

fn nudged<const D: usize>(model: &Model<D>) -> Model<D> {
    let mut other = model.clone();
    let dice = &mut Dice::new(7);
    for b in &mut other.bodies {
        b.x += dice.vector(-NUDGE, NUDGE);
    }
    other
}

/// How many of the hits of the model can be trusted.
fn trusted<const D: usize>(hits: &[Hit<D>], others: &[Hit<D>]) -> usize {
    let agree = |k: usize| {
        let (a, b) = (&hits[k], &others[k]);
        (a.a, a.b) == (b.a, b.b)
            && (a.time - b.time).abs() < TRUSTED
            && a.approach > SLOW
            && (a.impulse - b.impulse).abs() < 1e-6 * a.impulse
            && hits.get(k + 1).is_none_or(|next| next.time - a.time > APART)
    };
    (0..hits.len().min(others.len())).take_while(|&k| agree(k)).count()
}

fn event_by_event<const D: usize>(recipe: &Recipe)
where
    Vector<D>: Rotates,
{
    const EVENTS: usize = 40;
    let mut model = random_model::<D>(recipe);
    let (mut world, ids, walls) = world_of(recipe, &model);
    let mut other = nudged(&model);
    let end = 20.0;
    let hits = model.run(end, EVENTS);
    let others = other.run(end, EVENTS);
    let good = trusted(&hits, &others);
    // One more than the model knows of: there must be none.
    let most = hits.len() as u64 + u64::from(hits.len() < EVENTS);
    world.run(&Limits { time: Some(end), impacts: Some(most), ..Limits::default() });
    let impacts = world.impacts().to_vec();
    for k in 0..good {
        let h = &hits[k];
        let Some(i) = impacts.get(k) else {
            panic!("impact {k} is missing: {h:?}; {recipe:?}");
        };
        assert_eq!(parties(i, &ids, &walls), (h.a, h.b), "impact {k} at {} of {recipe:?}", h.time);
        assert!((i.time - h.time).abs() < TRUSTED, "impact {k}: {} and {}; {recipe:?}", i.time, h.time);
        assert!((i.impulse - h.impulse).abs() < 1e-6 * h.impulse, "impact {k}: {i:?} {h:?}; {recipe:?}");
        assert_eq!(i.together, 1);
    }
    if good == hits.len() && hits.len() < EVENTS && !model.stuck && !other.stuck {
        assert_eq!(impacts.len(), hits.len(), "the world knows of more; {recipe:?}");
    }
    COMPARED.fetch_add(good, std::sync::atomic::Ordering::Relaxed);
}

static COMPARED: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, max_shrink_iters: 0, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn event_by_event_on_the_line(recipe in recipe()) { event_by_event::<1>(&recipe); }

    #[test]
    fn event_by_event_in_the_plane(recipe in recipe()) { event_by_event::<2>(&recipe); }

    #[test]
    fn event_by_event_in_space(recipe in recipe()) { event_by_event::<3>(&recipe); }
}

// ---------------------------------------------------------------------------------------------------------------------
// Changes between advances

fn with_changes<const D: usize>(recipe: &Recipe)
where
    Vector<D>: Rotates,
{
    let mut model = random_model::<D>(recipe);
    let (mut world, mut ids, walls) = world_of(recipe, &model);
    let mut other = nudged(&model);
    let dice = &mut Dice::new(recipe.seed ^ 0x1234_5678);
    for frame in 1..=12 {
        let end = 0.5 * frame as f64;
        let (hits, others) = (model.run(end, 60), other.run(end, 60));
        let good = trusted(&hits, &others);
        let most = world.impact_count() + hits.len() as u64 + 1;
        world.run(&Limits { time: Some(end), impacts: Some(most), ..Limits::default() });
        let impacts = world.impacts().to_vec();
        for k in 0..good {
            let (h, i) =
                (&hits[k], impacts.get(k).unwrap_or_else(|| panic!("impact {k} of frame {frame}; {recipe:?}")));
            assert_eq!(parties(i, &ids, &walls), (h.a, h.b), "impact {k} of frame {frame}; {recipe:?}");
            assert!((i.time - h.time).abs() < TRUSTED && (i.impulse - h.impulse).abs() < 1e-6 * h.impulse);
        }
        COMPARED.fetch_add(good, std::sync::atomic::Ordering::Relaxed);
        if good < hits.len().max(others.len()) || hits.len() == 60 || model.stuck || other.stuck {
            return; // from here on nobody knows
        }
        assert_eq!(impacts.len(), hits.len(), "frame {frame}; {recipe:?}");
        for (i, b) in model.bodies.iter().enumerate().filter(|(_, b)| b.alive) {
            let (x, v) = (world.position(ids[i]).unwrap(), world.velocity(ids[i]).unwrap());
            let d = model.images(x - b.x).into_iter().map(|d| d.norm()).fold(f64::INFINITY, f64::min);
            assert!(d < 1e-7 && (v - b.v).norm() < 1e-6, "body {i} in frame {frame}: {x:?} {b:?}; {recipe:?}");
        }
        let living: Vec<usize> = (0..model.bodies.len()).filter(|&i| model.bodies[i].alive).collect();
        let movable: Vec<usize> = living.iter().copied().filter(|&i| model.bodies[i].w > 0.0).collect();
        let pick = |dice: &mut Dice, list: &[usize]| (!list.is_empty()).then(|| list[dice.below(list.len())]);
        let what = dice.below(7);
        match what {
            0 => {
                if let Some(body) = random_body(dice, recipe, &model) {
                    ids.push(world.add(ball_of(&body)).unwrap());
                    other.bodies.push(body.clone());
                    model.bodies.push(body);
                }
            }
            1 => {
                if let Some(i) = pick(dice, &living) {
                    world.remove(ids[i]).unwrap();
                    assert!(world.position(ids[i]).is_err());
                    (model.bodies[i].alive, other.bodies[i].alive) = (false, false);
                }
            }
            2 => {
                if let Some(i) = pick(dice, &movable) {
                    let v = dice.vector(-1.0, 1.0);
                    world.set_velocity(ids[i], v).unwrap();
                    (model.bodies[i].v, other.bodies[i].v) = (v, v);
                }
            }
            3 => {
                if let Some(i) = pick(dice, &living) {
                    let x = dice.vector(0.0, width::<D>());
                    if model.room(x, model.bodies[i].r, Some(i)) > 1e-3 {
                        world.set_position(ids[i], x).unwrap();
                        (model.bodies[i].x, other.bodies[i].x) = (x, x);
                    }
                }
            }
            4 => {
                if let Some(i) = pick(dice, &living) {
                    // Into a layer of its own, meeting nobody or all; back only where there is room.
                    let layers = [(1, u32::MAX), (2, 2), (1, 2), (3, 1)][dice.below(4)];
                    if model.room(model.bodies[i].x, model.bodies[i].r, Some(i)) > 1e-3 {
                        world.set_layers(ids[i], layers.0, layers.1).unwrap();
                        (model.bodies[i].layers, other.bodies[i].layers) = (layers, layers);
                    }
                }
            }
            _ => {
                if let (Some(i), Some(j)) = (pick(dice, &living), pick(dice, &living))
                    && i != j
                {
                    let pair = (i.min(j), i.max(j));
                    let ignored = model.ignored.contains(&pair);
                    let apart = model.room(model.bodies[i].x, model.bodies[i].r, Some(i)) > 1e-3;
                    if !ignored {
                        world.ignore(ids[j], ids[i], true).unwrap();
                        model.ignored.push(pair);
                    } else if apart {
                        world.ignore(ids[i], ids[j], false).unwrap();
                        model.ignored.retain(|p| *p != pair);
                    }
                    other.ignored = model.ignored.clone();
                }
            }
        }
    }
    // The user's changes are in the books.
    let ledger = world.ledger();
    assert!(ledger.unexplained() < 1e-11, "{ledger:?}; {recipe:?}");
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn changes_between_advances_on_the_line(recipe in recipe()) { with_changes::<1>(&recipe); }

    #[test]
    fn changes_between_advances_in_the_plane(recipe in recipe()) { with_changes::<2>(&recipe); }

    #[test]
    fn changes_between_advances_in_space(recipe in recipe()) { with_changes::<3>(&recipe); }
}

// ---------------------------------------------------------------------------------------------------------------------
// What holds in every world

/// Speeds (m/s) that are nothing: below it doubles lose their digits.
const FLOOR: f64 = 1e-290;

/// Steps of a run with everything on: rest, any e, gravity, mixed masses.
fn invariants_hold<const D: usize>(seed: u64, gravity: bool, edge: Edge)
where
    Vector<D>: Rotates,
{
    let recipe = Recipe { seed, count: 24, edge, gravity, elastic: false };
    let mut model = random_model::<D>(&recipe);
    let dice = &mut Dice::new(seed ^ 0xabcd);
    let lowest = if model.gravity == Vector::ZERO { 0.5 } else { 0.0 };
    for b in &mut model.bodies {
        // Every e from the lowest to 1, the ends included.
        let between = dice.between(lowest, 1.0);
        b.e = Some([lowest, 1.0, between, between][dice.below(4)]);
    }
    // Nothing is driven: the energy then never rises, and nobody is crushed.
    for b in model.bodies.iter_mut().filter(|b| b.w == 0.0) {
        b.v = Vector::ZERO;
    }
    let (mut world, ids, _) = world_of(&recipe, &model);
    world = world.rest_speed(carom::world::REST_SPEED);
    let energy = |world: &World<D>| world.ledger().energy.end;
    let scale = |world: &World<D>| {
        let l = world.ledger().energy;
        l.kinetic.abs() + l.potential.abs() + l.start.abs()
    };
    let mut last_energy = energy(&world);
    let mut last_time = 0.0;
    for frame in 1..=40 {
        let impacts = world.advance_to(0.1 * frame as f64).to_vec();
        let mut k = 0;
        while k < impacts.len() {
            let first = &impacts[k];
            // Ordered in time, within the frame, from now on.
            assert!(first.time >= last_time && first.time <= world.time(), "{recipe:?}");
            last_time = first.time;
            // The contacts of one instant stand together; separate sets may share a time.
            let count = (first.together as usize).max(1);
            let set = &impacts[k..(k + count).min(impacts.len())];
            assert!(set.len() == count && set.iter().all(|i| i.time == first.time), "{recipe:?}");
            k += count;
            let mut lost = 0.0;
            let mut size = 0.0;
            // The operators for several contacts work to 1e-13 of the fastest of the instant, which need not be among those that
            // exchange an impulse: of the speeds of this world, then, which begin at about 1 m/s.
            let fastest = set
                .iter()
                .flat_map(|i| i.before.iter().chain(&i.after))
                .map(|s| s.velocity.norm())
                .fold(if count == 1 { FLOOR } else { 1.0 }, f64::max);
            for i in set {
                assert!(i.impulse >= 0.0 && i.lost.is_finite() && (i.normal.norm() - 1.0).abs() < 1e-15, "{i:?}");
                lost += i.lost;
                size += i.impulse * (i.approach.abs() + i.departure.abs());
                let [before, after] = [i.before, i.after].map(|s| (s[0].velocity - s[1].velocity).dot(i.normal));
                let speeds = FLOOR
                    + i.before[0].velocity.norm()
                    + i.before[1].velocity.norm()
                    + i.after[0].velocity.norm()
                    + i.after[1].velocity.norm();
                // approach and departure are those of the states, each good to a few roundings of the speeds.
                let digits = if count == 1 { 1e-14 * speeds } else { 1e-12 * fastest };
                assert!((before - i.approach).abs() <= digits, "{i:?} {recipe:?}");
                assert!((after + i.departure).abs() <= digits, "{i:?} {recipe:?}");
                if count == 1 {
                    // What was lost is told by the rounded velocities: a rounding of the speeds times the impulse.
                    assert!(i.lost >= -1e-15 * i.impulse * speeds && i.approach > 0.0, "{i:?} {recipe:?}");
                    // Where gravity presses, what closes slower than a part in 1e13 of what it gives in a slice is left alone.
                    let parts = 1e-13 * speeds + if gravity { 1e-15 } else { 0.0 };
                    assert!((i.departure - i.restitution * i.approach).abs() <= parts, "{i:?} {recipe:?}");
                }
            }
            assert!(lost >= -1e-12 * size, "an instant gained {lost}; {set:?} {recipe:?}");
            // Each body's change of momentum is the sum of its contacts' impulses.
            for (b, id) in ids.iter().enumerate() {
                let mut push = Vector::<D>::ZERO;
                let mut change = None;
                let mut sum = 0.0;
                for i in set {
                    for (side, sign) in [(0, -1.0), (1, 1.0)] {
                        if i.parties[side] == Party::Body(*id) {
                            push += i.normal * (sign * i.impulse);
                            sum += i.impulse;
                            let both = (i.before[side].velocity, i.after[side].velocity);
                            assert!(change.is_none_or(|c| c == both), "one body, two states; {recipe:?}");
                            change = Some(both);
                        }
                    }
                }
                if let Some((before, after)) = change {
                    let w = model.bodies[b].w;
                    if w == 0.0 {
                        assert_eq!(before, after, "{recipe:?}");
                    } else {
                        let off = (after - before - push * w).norm();
                        let speeds = fastest + sum * w;
                        assert!(off <= 1e-13 * speeds, "momentum off by {off:e}: {set:?} {recipe:?}");
                    }
                }
            }
        }
        let ledger = world.ledger();
        // Slices add up thousands of small impulses with moments about a far origin.
        let explained = if world.slice_count() == 0 { 1e-11 } else { carom::ledger::DRIFT_LIMIT };
        assert!(ledger.unexplained() < explained, "frame {frame}: {ledger:?} {recipe:?}");
        let now = energy(&world);
        // Kinetic and potential energy are sums of up to 24 terms of a few roundings each.
        assert!(now <= last_energy + 1e-13 * scale(&world), "frame {frame}: {last_energy} -> {now} {recipe:?}");
        last_energy = now;
        let limit = if world.slice_count() == 0 { 1e-9 } else { carom::ledger::OVERLAP_LIMIT };
        let deepest = world.deepest_overlap();
        assert!(deepest < limit, "frame {frame}: overlap {deepest:e} {recipe:?}");
    }
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn what_holds_in_the_plane_without_gravity(seed in any::<u64>(), edge in 0..4usize) {
        invariants_hold::<2>(seed, false, EDGES[edge]);
    }

    #[test]
    fn what_holds_in_space_without_gravity(seed in any::<u64>(), edge in 0..4usize) {
        invariants_hold::<3>(seed, false, EDGES[edge]);
    }

    #[test]
    fn what_holds_in_the_plane_under_gravity(seed in any::<u64>(), edge in 0..4usize) {
        invariants_hold::<2>(seed, true, EDGES[edge]);
    }

    #[test]
    fn what_holds_in_space_under_gravity(seed in any::<u64>(), edge in 0..4usize) {
        invariants_hold::<3>(seed, true, EDGES[edge]);
    }
}

const EDGES: [Edge; 4] = [Edge::Open, Edge::Walls, Edge::Periodic, Edge::Mixed];
