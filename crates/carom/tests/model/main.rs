//! The world and a simulator of quadratic cost live the same life: bodies and walls come, go and are changed, gravity turns, pieces
//! of time pass; and after each piece they must agree on every impact, position, velocity and spin.
//!
//! The simulator ([`simulator`]) is obviously right and shares nothing with the engine. Beside it lives a second one, whose every
//! input is moved by [`NUDGE`]: how far the two have come apart says how much the life so far makes of a small difference.
//! A thousandth of that is what rounding makes of it, and the world must be nearer than the whole.
mod deeds;
mod polynomial;
mod simulator;
mod space;

use std::cell::Cell;

use carom::{Ball, BodyId, Boundary, Material, MaterialId, Party, Rotates, Vector, Wall, WallId, World};
use deeds::{Deed, Said, Unit};
use proptest::test_runner::{Config, TestRunner};
use simulator::{Form, Hit, Other, Simulator, Surface};
use space::V;

/// What each input of the second simulator is moved by: about a thousand times the rounding of a number of the size of this world.
const NUDGE: f64 = 1e-12;
/// Where nothing has grown yet, what both simulators share remains: they add up pieces of time, a hundred of them, each rounded.
const ROUNDING: f64 = 1e-12;
/// A life in which a nudge has grown to this is over: it has forgotten its beginning.
const FORGOTTEN: f64 = 1e-7;
/// Room around what is put into the world (m).
const ROOM: f64 = 1e-3;

const MATERIALS: [Surface; 4] = [
    Surface { restitution: None, friction: None, tangential: None },
    Surface { restitution: Some(0.8), friction: Some(0.2), tangential: None },
    Surface { restitution: None, friction: Some(0.7), tangential: Some(0.6) },
    Surface { restitution: Some(0.95), friction: Some(0.05), tangential: Some(-0.4) },
];

/// What all lives together have seen, so that a test that sees nothing fails.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    lives: u64,
    pieces: u64,
    impacts: u64,
    slipped: u64,
    walls: u64,
    changes: u64,
    ended: u64,
}

struct Trial<const D: usize>
where
    Vector<D>: Rotates,
{
    plain: Simulator,
    nudged: Simulator,
    world: World<D>,
    materials: Vec<MaterialId>,
    bodies: Vec<BodyId>,
    walls: Vec<WallId>,
    /// What has become of a nudge.
    reach: f64,
    nudges: u32,
    seen: Seen,
}

fn vector<const D: usize>(v: V) -> Vector<D> {
    Vector::from_fn(|k| v.0[k])
}

fn space<const D: usize>(v: Vector<D>) -> V {
    V(std::array::from_fn(|k| if k < D { v[k] } else { 0.0 }))
}

impl<const D: usize> Trial<D>
where
    Vector<D>: Rotates,
{
    /// The box: its lower corner at the origin.
    const WIDE: f64 = if D == 1 { 14.0 } else { 4.0 };

    fn new() -> Self {
        let mut world = World::<D>::new().rest_speed(0.0);
        let mut plain = Simulator::default();
        let corner = Vector::from_fn(|_| Self::WIDE);
        world.set_boundary(Boundary::walls(Vector::ZERO, corner)).unwrap();
        for k in 0..D {
            for (at, sign) in [(0.0, 1.0), (Self::WIDE, -1.0)] {
                let axis = |s: f64| V(std::array::from_fn(|j| if j == k { s } else { 0.0 }));
                let form = Form::Plane { point: axis(at), normal: axis(sign) };
                plain.walls.push(Some(simulator::Wall { form, velocity: V::ZERO, surface: MATERIALS[0] }));
            }
        }
        let materials = MATERIALS
            .iter()
            .map(|m| {
                let coefficient = |c: Option<f64>| c.map(Into::into);
                let (restitution, friction) = (coefficient(m.restitution), coefficient(m.friction));
                let said = Material { restitution, friction, tangential: m.tangential, ..Material::new() };
                world.material(said).unwrap()
            })
            .collect();
        let walls = world.walls().collect();
        let nudged = plain.clone();
        let seen = Seen { lives: 1, ..Seen::default() };
        Self { plain, nudged, world, materials, bodies: Vec::new(), walls, reach: 0.0, nudges: 0, seen }
    }

    /// Numbers of [0, 1) as a vector of this dimension between `low` and `high`.
    fn stretched(unit: &Unit, low: f64, high: f64) -> V {
        V(std::array::from_fn(|k| if k < D { low + (high - low) * unit[k] } else { 0.0 }))
    }

    /// Spins: none on the line, about the third axis in the plane.
    fn spun(unit: &Unit) -> V {
        V(std::array::from_fn(|k| match D {
            3 => 8.0 * unit[k] - 4.0,
            2 if k == 2 => 8.0 * unit[0] - 4.0,
            _ => 0.0,
        }))
    }

    fn spin(v: V) -> <Vector<D> as Rotates>::Spin {
        let numbers: &[f64] = match D {
            1 => &[],
            2 => &v.0[2..],
            _ => &v.0,
        };
        Vector::<D>::spin_from(numbers).unwrap()
    }

    fn nudge(&mut self, v: V) -> V {
        self.nudges += 1;
        let signs = self.nudges.wrapping_mul(0x9e37_79b9) >> 16;
        v + V(std::array::from_fn(|k| match k < D {
            true if signs >> k & 1 == 1 => NUDGE,
            true => -NUDGE,
            false => 0.0,
        }))
    }

    fn said(&self, says: Said) -> (Surface, MaterialId) {
        let k = says.material % MATERIALS.len();
        let own = MATERIALS[k];
        (Surface { restitution: says.restitution.or(own.restitution), ..own }, self.materials[k])
    }

    /// One of the bodies that are there.
    fn body(&self, k: usize) -> Option<usize> {
        let there: Vec<usize> = (0..self.bodies.len()).filter(|&i| self.plain.ball(i).is_some()).collect();
        there.get(k % there.len().max(1)).copied()
    }

    fn a_wall(&self, k: usize) -> Option<usize> {
        let there: Vec<usize> = (0..self.walls.len()).filter(|&w| self.plain.walls[w].is_some()).collect();
        there.get(k % there.len().max(1)).copied()
    }

    /// Changes a ball of both simulators; `to` is nudged for the second.
    fn set(&mut self, i: usize, to: V, put: fn(&mut simulator::Ball, V)) {
        let nudged = self.nudge(to);
        put(self.plain.balls[i].as_mut().unwrap(), to);
        put(self.nudged.balls[i].as_mut().unwrap(), nudged);
    }

    /// Both simulators and the world do it, or none of them if there is no room. False ends the life.
    fn does(&mut self, deed: &Deed) -> Option<bool> {
        self.seen.changes += 1;
        match *deed {
            Deed::Add { ref at, ref velocity, ref spin, mass, radius, kappa, fixed, says } => {
                let (x, radius) = (Self::stretched(at, 0.0, Self::WIDE), 0.1 + 0.2 * radius);
                if self.plain.room(x, radius, None) < ROOM {
                    return None;
                }
                let (surface, material) = self.said(says);
                let mut ball = simulator::Ball {
                    x,
                    v: if fixed { V::ZERO } else { Self::stretched(velocity, -2.0, 2.0) },
                    spin: if fixed { V::ZERO } else { Self::spun(spin) },
                    mass: if fixed { f64::INFINITY } else { 0.1 * 100f64.powf(mass) },
                    radius,
                    kappa: 0.3 + 0.7 * kappa,
                    surface,
                    layers: 1,
                    meets: u32::MAX,
                };
                let body = if fixed { Ball::fixed(radius) } else { Ball::new(ball.mass, radius) };
                let mut body = body.at(vector(ball.x)).moving(vector(ball.v)).inertia(ball.kappa).material(material);
                body.spin = Self::spin(ball.spin);
                body.restitution = says.restitution.map(Into::into);
                self.bodies.push(self.world.add(body).unwrap());
                self.plain.balls.push(Some(ball.clone()));
                (ball.x, ball.v) = (self.nudge(ball.x), if fixed { V::ZERO } else { self.nudge(ball.v) });
                self.nudged.balls.push(Some(ball));
            }
            Deed::Remove(k) => {
                let i = self.body(k)?;
                self.world.remove(self.bodies[i]).unwrap();
                assert!(self.world.position(self.bodies[i]).is_err());
                for model in [&mut self.plain, &mut self.nudged] {
                    model.balls[i] = None;
                }
            }
            Deed::SetVelocity(k, ref v) => {
                let (i, v) = (self.body(k)?, Self::stretched(v, -2.0, 2.0));
                // A fixed body is driven slowly.
                let v = if self.plain.ball(i)?.mass.is_finite() { v } else { v * 0.1 };
                self.world.set_velocity(self.bodies[i], vector::<D>(v)).unwrap();
                self.set(i, v, |ball, v| ball.v = v);
            }
            Deed::SetPosition(k, ref x) => {
                let (i, x) = (self.body(k)?, Self::stretched(x, 0.0, Self::WIDE));
                if self.plain.room(x, self.plain.ball(i)?.radius, Some(i)) < ROOM {
                    return None;
                }
                self.world.set_position(self.bodies[i], vector::<D>(x)).unwrap();
                self.set(i, x, |ball, x| ball.x = x);
            }
            Deed::SetSpin(k, ref w) => {
                let (i, w) = (self.body(k)?, Self::spun(w));
                self.world.set_spin(self.bodies[i], Self::spin(w)).unwrap();
                for model in [&mut self.plain, &mut self.nudged] {
                    model.balls[i].as_mut()?.spin = w;
                }
            }
            Deed::SetGravity(ref g) => {
                let g = if g[0] < 0.3 { V::ZERO } else { Self::stretched(g, -2.0, 2.0) };
                self.world.set_gravity(vector::<D>(g)).unwrap();
                (self.plain.gravity, self.nudged.gravity) = (g.0, g.0);
            }
            Deed::AddWall { ref at, ref to, ref velocity, thin, says } => {
                let at = Self::stretched(at, 0.0, Self::WIDE);
                let velocity = Self::stretched(velocity, -0.3, 0.3);
                let (surface, material) = self.said(says);
                let (form, wall) = if thin && D == 2 {
                    let to = Self::stretched(to, 0.0, Self::WIDE);
                    (Form::Segment { from: at, to }, Wall::segment(vector(at), vector(to)))
                } else {
                    let normal = Self::stretched(to, -1.0, 1.0);
                    // Far out, where there is room on its side.
                    let normal = normal * (1.0 / normal.length());
                    let point = at + normal * -(0.5 * Self::WIDE);
                    (Form::Plane { point, normal }, Wall::plane(vector(point), vector(normal)))
                };
                if self.plain.room_for(&form) < ROOM {
                    return None;
                }
                let mut wall = wall.moving(vector(velocity)).material(material);
                wall.restitution = says.restitution.map(Into::into);
                self.walls.push(self.world.add_wall(wall).unwrap());
                for model in [&mut self.plain, &mut self.nudged] {
                    model.walls.push(Some(simulator::Wall { form: form.clone(), velocity, surface }));
                }
                self.seen.walls += 1;
            }
            Deed::RemoveWall(k) => {
                let w = self.a_wall(k)?;
                self.world.remove_wall(self.walls[w]).unwrap();
                assert!(self.world.shape(self.walls[w]).is_err());
                for model in [&mut self.plain, &mut self.nudged] {
                    model.walls[w] = None;
                }
            }
            Deed::SetWallVelocity(k, ref v) => {
                let (w, v) = (self.a_wall(k)?, Self::stretched(v, -0.3, 0.3));
                self.world.set_wall_velocity(self.walls[w], vector::<D>(v)).unwrap();
                for model in [&mut self.plain, &mut self.nudged] {
                    model.walls[w].as_mut()?.velocity = v;
                }
            }
            Deed::Ignore(a, b, ignored) => {
                let (a, b) = (self.body(a)?, self.body(b)?);
                let overlap = self.plain.overlap(a, b);
                // Who lies in each other goes on passing through each other.
                if a == b || !ignored && overlap {
                    return None;
                }
                self.world.ignore(self.bodies[a], self.bodies[b], ignored).unwrap();
                let pair = (a.min(b), a.max(b));
                for model in [&mut self.plain, &mut self.nudged] {
                    model.ignored.retain(|p| *p != pair);
                    if ignored {
                        model.ignored.push(pair);
                    }
                }
            }
            Deed::SetLayers(k, layers, meets) => {
                let i = self.body(k)?;
                if (0..self.bodies.len()).any(|j| j != i && self.plain.ball(j).is_some() && self.plain.overlap(i, j)) {
                    return None;
                }
                self.world.set_layers(self.bodies[i], layers, meets).unwrap();
                for model in [&mut self.plain, &mut self.nudged] {
                    let ball = model.balls[i].as_mut()?;
                    (ball.layers, ball.meets) = (layers, meets);
                }
            }
            Deed::Restore => self.world = World::restore(&self.world.snapshot()).unwrap(),
            Deed::Advance(dt) => return Some(self.advance(dt)),
        }
        Some(true)
    }

    /// A piece of time; false if from here on nobody knows.
    fn advance(&mut self, dt: f64) -> bool {
        let end = self.plain.time + dt;
        let (hits, others) = (self.plain.advance_to(end), self.nudged.advance_to(end));
        if self.plain.lost || self.nudged.lost || hits.len() != others.len() {
            return false;
        }
        for (a, b) in hits.iter().zip(&others) {
            if (a.ball, a.other) != (b.ball, b.other) {
                return false;
            }
            self.grows(
                (a.time - b.time).abs().max((a.impulse - b.impulse).abs()).max((a.friction - b.friction).length()),
            );
        }
        for i in 0..self.bodies.len() {
            if let (Some(a), Some(b)) = (self.plain.ball(i), self.nudged.ball(i)) {
                let apart = [a.x - b.x, a.v - b.v, a.spin - b.spin].map(V::length);
                self.grows(apart.into_iter().fold(0.0, f64::max));
            }
        }
        if !(self.reach < FORGOTTEN) {
            return false;
        }
        self.world.advance_to(end);
        self.agrees(&hits);
        self.seen.pieces += 1;
        self.seen.impacts += hits.len() as u64;
        true
    }

    fn grows(&mut self, difference: f64) {
        self.reach = self.reach.max(difference);
    }

    fn agrees(&mut self, hits: &[Hit]) {
        let tolerance = ROUNDING + self.reach;
        let near = |got: f64, want: f64, what: &str| {
            assert!(
                (got - want).abs() <= tolerance,
                "{what}: the world says {got}, the model {want}; tolerance {tolerance:e}"
            );
        };
        let impacts = self.world.impacts();
        assert_eq!(impacts.len(), hits.len(), "impacts: the world says\n{impacts:#?}\nthe model\n{hits:#?}");
        for (impact, hit) in impacts.iter().zip(hits) {
            let number = |p: Party| match p {
                Party::Body(id) => Other::Ball(self.bodies.iter().position(|b| *b == id).unwrap()),
                Party::Wall(id) => Other::Wall(self.walls.iter().position(|w| *w == id).unwrap()),
            };
            let (a, b) = (number(impact.parties[0]), number(impact.parties[1]));
            // Whoever took a free place comes first in the world, and later in the model.
            let swapped = (a, b) == (hit.other, Other::Ball(hit.ball));
            assert!(swapped || (a, b) == (Other::Ball(hit.ball), hit.other), "{impact:?}\n{hit:?}");
            near(impact.time, hit.time, "time");
            near(impact.impulse, hit.impulse, "impulse");
            near(impact.approach, hit.approach, "approach");
            let sign = if swapped { -1.0 } else { 1.0 };
            let apart = space(impact.friction_impulse) - hit.friction * sign;
            near(apart.length(), 0.0, "friction impulse");
            assert_eq!(impact.together, 1);
            self.seen.slipped += u64::from(hit.friction.length() > 1e-9);
        }
        for (i, id) in self.bodies.iter().enumerate() {
            let Some(ball) = self.plain.ball(i) else { continue };
            let (x, v) = (space(self.world.position(*id).unwrap()), space(self.world.velocity(*id).unwrap()));
            near((x - ball.x).length(), 0.0, &format!("position of body {i}"));
            near((v - ball.v).length(), 0.0, &format!("velocity of body {i}"));
            let spin = self.world.spin(*id).unwrap();
            for (got, want) in
                Vector::<D>::spin_slice(&spin).iter().zip(Vector::<D>::spin_slice(&Self::spin(ball.spin)))
            {
                near(*got, *want, &format!("spin of body {i}"));
            }
        }
        let drift = self.world.ledger().unexplained();
        assert!(drift < 1e-11, "{drift:e} of an account is not explained");
    }
}

fn lives<const D: usize>(cases: u32)
where
    Vector<D>: Rotates,
{
    let seen = Cell::new(Seen::default());
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 20_000, ..Config::default() };
    let told = TestRunner::new(config).run(&deeds::life(), |deeds| {
        let mut trial = Trial::<D>::new();
        for deed in &deeds {
            if trial.does(deed) == Some(false) {
                trial.seen.ended += 1;
                break;
            }
        }
        let (a, b) = (seen.get(), trial.seen);
        seen.set(Seen {
            lives: a.lives + b.lives,
            pieces: a.pieces + b.pieces,
            impacts: a.impacts + b.impacts,
            slipped: a.slipped + b.slipped,
            walls: a.walls + b.walls,
            changes: a.changes + b.changes,
            ended: a.ended + b.ended,
        });
        Ok(())
    });
    let seen = seen.get();
    println!("D = {D}: {seen:?}");
    if let Err(error) = told {
        panic!("{error}");
    }
    // Rather less than what these lives are known to see.
    let each = |n: u64| n / u64::from(cases);
    assert!(each(seen.pieces) >= 2 && each(seen.impacts) >= 3, "lives in which too little happens");
    assert!(D == 1 || each(seen.slipped) >= 1);
}

#[test]
fn on_the_line() {
    lives::<1>(400);
}

#[test]
fn in_the_plane() {
    lives::<2>(400);
}

#[test]
fn in_space() {
    lives::<3>(400);
}
