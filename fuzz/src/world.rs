//! A world and what its user does to it, read from bytes: whatever it is, and in whatever order, the books stay closed.
use carom::ledger::DRIFT_LIMIT;
use carom::{
    Ball, BodyId, Boundary, Law, Limits, Material, MaterialId, Rotates, Stop, Together, Vector, Wall, WallId, World,
};

use super::bytes::Bytes;
use super::go::go;

/// Deeds of one life, and bodies and walls of one world, at most.
const DEEDS: usize = 80;
const BODIES: usize = 24;
const WALLS: usize = 12;

/// The first byte says how many dimensions there are, and whether numbers may be anything.
pub fn world(bytes: &[u8]) {
    let Some((&first, rest)) = bytes.split_first() else { return };
    let bytes = Bytes::new(rest, first & 4 != 0);
    match first & 3 {
        1 => Life::<1>::new(bytes).live(),
        3 => Life::<3>::new(bytes).live(),
        _ => Life::<2>::new(bytes).live(),
    }
}

struct Life<'a, const D: usize>
where
    Vector<D>: Rotates,
{
    bytes: Bytes<'a>,
    world: World<D>,
    /// Handles, of removed bodies and walls as well: those are errors, and nothing else.
    bodies: Vec<BodyId>,
    walls: Vec<WallId>,
    materials: Vec<MaterialId>,
    /// The narrowest periodic axis.
    width: f64,
}

impl<'a, const D: usize> Life<'a, D>
where
    Vector<D>: Rotates,
{
    fn new(mut bytes: Bytes<'a>) -> Self {
        let rest_speed = [0.01, 0.0, 0.1, bytes.any().unwrap_or(0.01)][bytes.below(4)];
        let mut world = World::<D>::new()
            .together(Together::ALL[bytes.below(3)])
            .law(Law::ALL[bytes.below(3)])
            .rest_speed(rest_speed);
        let material = material(&mut bytes);
        let _ = world.set_default_material(material);
        let mut width = f64::INFINITY;
        match bytes.below(4) {
            0 => {}
            kind => {
                let mut boundary = Boundary::walls([-4.0; D], [4.0; D]);
                if let Some(x) = bytes.any() {
                    boundary.min = Vector::from_fn(|_| x);
                }
                for k in 0..D {
                    if kind == 2 || kind == 3 && bytes.coin() {
                        boundary = boundary.closed_along(k);
                    }
                }
                if world.set_boundary(boundary).is_ok() && boundary.periodic.contains(&true) {
                    width = boundary.max[0] - boundary.min[0];
                }
            }
        }
        if bytes.coin() {
            let gravity = Vector::<D>::axis(D - 1) * -9.81;
            let _ = world.set_gravity(gravity);
        }
        let walls = world.walls().collect();
        Self { bytes, world, bodies: Vec::new(), walls, materials: vec![MaterialId::default()], width }
    }

    fn live(mut self) {
        for _ in 0..DEEDS {
            if self.bytes.is_empty() {
                break;
            }
            self.deed();
        }
        self.advance();
    }

    fn body(&mut self) -> Option<BodyId> {
        let k = self.bytes.below(self.bodies.len().max(1));
        self.bodies.get(k).copied()
    }

    fn a_wall(&mut self) -> Option<WallId> {
        let k = self.bytes.below(self.walls.len().max(1));
        self.walls.get(k).copied()
    }

    /// One thing that a user does. Errors are answers; what follows them has to be sound all the same.
    fn deed(&mut self) -> Option<()> {
        match self.bytes.byte() % 32 {
            0..8 => self.add(),
            8 => {
                let id = self.body()?;
                self.world.remove(id).ok()?;
            }
            9 => {
                let velocity = self.bytes.vector();
                let id = self.body()?;
                self.world.set_velocity(id, velocity).ok()?;
            }
            10 => {
                let position = self.bytes.vector();
                let id = self.body()?;
                self.world.set_position(id, position).ok()?;
            }
            11 => {
                let numbers = [0.0; 3].map(|_: f64| self.bytes.number());
                let spin = <Vector<D> as Rotates>::spin_from(&numbers[..<Vector<D> as Rotates>::SPINS])?;
                let id = self.body()?;
                self.world.set_spin(id, spin).ok()?;
            }
            12 => {
                let (layers, meets) = (u32::from(self.bytes.byte()), u32::from(self.bytes.byte()));
                let id = self.body()?;
                self.world.set_layers(id, layers, meets).ok()?;
            }
            13 => {
                let (a, b, ignored) = (self.body()?, self.body()?, self.bytes.coin());
                self.world.ignore(a, b, ignored).ok()?;
            }
            14 => {
                let gravity = self.bytes.vector();
                self.world.set_gravity(gravity).ok()?;
            }
            15 | 16 => self.add_wall(),
            17 => {
                let id = self.a_wall()?;
                self.world.remove_wall(id).ok()?;
            }
            18 => {
                let velocity = self.bytes.vector::<D>() * 0.25;
                let id = self.a_wall()?;
                self.world.set_wall_velocity(id, velocity).ok()?;
            }
            19 => {
                let said = material(&mut self.bytes);
                self.materials.extend(self.world.material(said));
            }
            20 => self.world.set_default_material(material(&mut self.bytes)).ok()?,
            21 => {
                let which = |bytes: &mut Bytes<'_>, all: &[MaterialId]| all[bytes.below(all.len())];
                let (a, b) = (which(&mut self.bytes, &self.materials), which(&mut self.bytes, &self.materials));
                self.world.pair(a, b, material(&mut self.bytes)).ok()?;
            }
            22 => self.restore(),
            23 => self.look(),
            24 => {
                let dt = self.piece();
                if self.width.is_infinite() {
                    self.world.advance_to_next(self.world.time() + dt);
                }
            }
            _ => self.advance(),
        }
        Some(())
    }

    fn add(&mut self) {
        if self.world.bodies().count() >= BODIES {
            return;
        }
        let (mass, radius) = (self.bytes.mass(), self.bytes.radius());
        let mut ball = Ball::new(mass, radius).at(self.bytes.vector());
        let kind = self.bytes.byte();
        if kind & 1 != 0 {
            ball = ball.moving(self.bytes.vector());
        }
        if kind & 2 != 0 {
            ball = ball.restitution(self.bytes.share());
        }
        if kind & 4 != 0 {
            ball = ball.material(self.materials[self.bytes.below(self.materials.len())]);
        }
        if kind & 0x18 == 0x18 {
            ball.fixed = true;
        }
        if kind & 0x60 == 0x60 {
            ball = ball.sensor();
        }
        if kind & 0x90 == 0x90 {
            ball = ball.inertia(self.bytes.share());
        }
        self.bodies.extend(self.world.add(ball));
    }

    fn add_wall(&mut self) {
        if self.world.walls().count() >= WALLS {
            return;
        }
        let (kind, at, to) = (self.bytes.byte(), self.bytes.vector(), self.bytes.vector());
        let mut wall = match kind & 3 {
            0 | 1 => Wall::plane(at, to),
            _ if D == 3 => Wall::triangle(at, to, self.bytes.vector::<D>()),
            2 => Wall::segment(at, to),
            _ => Wall::arc(at, self.bytes.radius(), to[0], to[0] + self.bytes.number()),
        };
        if kind & 4 != 0 {
            wall = wall.moving(self.bytes.vector::<D>() * 0.25);
        }
        if kind & 8 != 0 {
            wall = wall.restitution(self.bytes.share());
        }
        self.walls.extend(self.world.add_wall(wall));
    }

    /// A second at most: some worlds slide for ever.
    fn piece(&mut self) -> f64 {
        let dt = self.bytes.piece();
        if dt > 1.0 { 1.0 } else { dt }
    }

    fn advance(&mut self) {
        let dt = self.piece();
        let stop = go(&mut self.world, dt, self.width);
        if !self.bytes.wild {
            assert_ne!(stop, Stop::NotFinite);
            self.closed();
        }
    }

    fn closed(&self) {
        let ledger = self.world.ledger();
        let drift = ledger.unexplained();
        // Driven walls may put in, and impacts take out, 10^8 times the energy that there is: what went through is known to rounding.
        let e = &ledger.energy;
        let there = e.start.abs().max(e.end.abs());
        let through = if there > 0.0 { 16.0 * f64::EPSILON * (e.lost.abs() + e.work.abs()) / there } else { 0.0 };
        assert!(drift < DRIFT_LIMIT + through, "{drift:e} of an account is not explained: {ledger:?}");
    }

    /// The world is another one from its bytes, and both go on to the same bits.
    fn restore(&mut self) {
        let bytes = self.world.snapshot();
        let mut copy = World::<D>::restore(&bytes).expect("its own snapshot");
        assert_eq!(copy.digest(), self.world.digest());
        let (_, _) = (go(&mut copy, 0.05, self.width), go(&mut self.world, 0.05, self.width));
        assert_eq!(copy.digest(), self.world.digest(), "a restored world went elsewhere");
        self.world = copy;
    }

    /// Whatever can be asked.
    fn look(&mut self) {
        let (origin, direction) = (self.bytes.vector::<D>(), self.bytes.vector::<D>());
        self.world.ray(origin, direction, self.bytes.number());
        let radius = self.bytes.radius();
        self.world.overlapping(origin, radius);
        self.world.deepest_overlap();
        self.world.is_quiet();
        for id in self.bodies.iter().copied() {
            let _ = (self.world.position(id), self.world.unwrapped_position(id), self.world.spin(id));
            let _ = (self.world.rests(id), self.world.mass(id), self.world.radius(id), self.world.is_fixed(id));
        }
        let _ = self.world.run(&Limits { time: Some(self.world.time()), ..Limits::default() });
    }
}

fn material(bytes: &mut Bytes<'_>) -> Material {
    let mut material = Material::new();
    let says = bytes.byte();
    if says & 1 != 0 {
        material = material.restitution(bytes.share());
    }
    if says & 2 != 0 {
        material = material.friction(bytes.share());
    }
    if says & 4 != 0 {
        material = material.tangential(2.0 * bytes.share() - 1.0);
    }
    if says & 8 != 0 {
        material = material.rolling(0.25 * bytes.share());
    }
    if says & 16 != 0 {
        material = material.spinning(0.25 * bytes.share());
    }
    material
}
