//! Impacts, stored by what the laws of motion and of impact do not say of them.
//!
//! Between impacts a ball moves as its record says, and an impact follows from how its parties arrive. So both ends of the
//! file reckon each number from those before it, with the same operations in the same order (+, -, *, / and square roots:
//! the same bits on every machine), and only the difference is stored: of numbers that are reckoned exactly nothing, of the
//! others the units in the last place by which they differ. Nothing is lost, whatever the impact: a wrong guess only costs bytes.
//! Times, and who meets whom, are what remains.
use carom::law::smooth::{self, Moving};
use carom::{BodyId, Impact, Party, Rotates, State, Vector, WallId};

/// A body before the first impact.
#[derive(Clone, Copy, Debug)]
pub struct Start<const D: usize>
where
    Vector<D>: Rotates,
{
    /// Who.
    pub id: BodyId,
    /// Position (m) at time 0.
    pub position: Vector<D>,
    /// Velocity (m/s) at time 0.
    pub velocity: Vector<D>,
    /// Spin (rad/s) at time 0.
    pub spin: <Vector<D> as Rotates>::Spin,
    /// 1/m (1/kg); 0 for a fixed body, which gravity does not move.
    pub inverse_mass: f64,
    /// 1/I (1/(kg m^2)); 0 for a fixed body.
    pub inverse_inertia: f64,
    /// Radius (m).
    pub radius: f64,
}

/// What both ends of a recording know before the first impact.
#[derive(Clone, Debug)]
pub struct Stage<const D: usize>
where
    Vector<D>: Rotates,
{
    /// The bodies, in the order of their places.
    pub bodies: Vec<Start<D>>,
    /// The walls, in the order of their places.
    pub walls: Vec<WallId>,
    /// Gravity (m/s^2).
    pub gravity: Vector<D>,
    /// The lower corner (m) and the widths of the box along periodic axes; 0 wide along the others.
    pub corner: Vector<D>,
    /// See `corner`.
    pub width: Vector<D>,
}

/// One way through the numbers of an impact: writing them, or reading them. Returns `None` where the bytes end.
trait Port {
    fn number(&mut self, column: usize, guess: f64, x: &mut f64) -> Option<()>;
    fn whole(&mut self, column: usize, guess: u64, x: &mut u64) -> Option<()>;
}

/// A body as it was last seen.
#[derive(Clone, Copy, Debug)]
struct Seen<const D: usize>
where
    Vector<D>: Rotates,
{
    x: Vector<D>,
    v: Vector<D>,
    spin: <Vector<D> as Rotates>::Spin,
    time: f64,
    /// How it moved before the instant of `time`.
    before: State<D>,
}

/// What is remembered from one impact to the next.
#[derive(Clone, Debug)]
struct Memory<const D: usize>
where
    Vector<D>: Rotates,
{
    stage: Stage<D>,
    bodies: Vec<Seen<D>>,
    /// The normal towards each wall, and its velocity.
    walls: Vec<(Vector<D>, Vector<D>)>,
    time: f64,
    restitution: f64,
    together: u64,
}

impl<const D: usize> Memory<D>
where
    Vector<D>: Rotates,
{
    fn new(stage: Stage<D>) -> Self {
        let seen = |s: &Start<D>| Seen {
            x: s.position,
            v: s.velocity,
            spin: s.spin,
            time: 0.0,
            before: State { velocity: s.velocity, spin: s.spin },
        };
        Self {
            bodies: stage.bodies.iter().map(seen).collect(),
            walls: vec![(Vector::ZERO, Vector::ZERO); stage.walls.len()],
            stage,
            time: 0.0,
            restitution: 1.0,
            together: 1,
        }
    }

    /// Where a body is at a time, and how fast, if nothing has happened to it: as the engine reckons it.
    fn at(&self, i: usize, time: f64) -> (Vector<D>, Vector<D>) {
        let s = &self.bodies[i];
        let dt = time - s.time;
        let a = if self.stage.bodies[i].inverse_mass == 0.0 { Vector::ZERO } else { self.stage.gravity };
        if dt == 0.0 || a == Vector::ZERO {
            return (s.x + s.v * dt, s.v);
        }
        (s.x + (s.v + a * (0.5 * dt)) * dt, s.v + a * dt)
    }

    fn wrapped(&self, x: Vector<D>) -> Vector<D> {
        let Stage { corner, width, .. } = &self.stage;
        Vector::from_fn(
            |k| if width[k] > 0.0 { x[k] - ((x[k] - corner[k]) / width[k]).floor() * width[k] } else { x[k] },
        )
    }

    fn nearest(&self, d: Vector<D>) -> Vector<D> {
        let width = &self.stage.width;
        Vector::from_fn(|k| if width[k] > 0.0 { d[k] - (d[k] / width[k]).round_ties_even() * width[k] } else { d[k] })
    }

    /// Passes an impact through the port, and remembers it.
    fn pass(&mut self, port: &mut impl Port, impact: &mut Impact<D>) -> Option<()> {
        let mut columns = 0..;
        let mut next = || columns.next().unwrap_or(0);
        port.number(next(), self.time, &mut impact.time)?;
        let mut together = u64::from(impact.together);
        port.whole(next(), self.together, &mut together)?;
        impact.together = u32::try_from(together).ok()?;
        let mut codes = impact.parties.map(code);
        port.whole(next(), 0, &mut codes[0])?;
        port.whole(next(), 0, &mut codes[1])?;
        let time = impact.time;
        for side in 0..2 {
            impact.parties[side] = self.party(codes[side])?;
        }
        let place = |side: usize| (codes[side] >> 1) as usize;
        let is_body = |side: usize| codes[side] & 1 == 0;
        // How each party arrives.
        let mut arrives = [(Vector::ZERO, State::<D>::default()); 2];
        let mut again = [false; 2];
        for side in 0..2 {
            let i = place(side);
            if is_body(side) {
                let (x, v) = self.at(i, time);
                // The other contacts of an instant see the same two ends.
                again[side] = together > 1 && self.bodies[i].time == time;
                let state =
                    if again[side] { self.bodies[i].before } else { State { velocity: v, spin: self.bodies[i].spin } };
                arrives[side] = (x, state);
            } else {
                arrives[side].1.velocity = self.walls[i].1;
            }
        }
        let radius = |side: usize| if is_body(side) { self.stage.bodies[place(side)].radius } else { 0.0 };
        let both = is_body(0) && is_body(1);
        let mut towards = if both { self.nearest(arrives[1].0 - arrives[0].0) } else { self.walls[place(1)].0 };
        let distance = towards.norm();
        if both && !(distance > 0.0) {
            towards = Vector::axis(0);
        }
        let guess = towards / towards.norm();
        for k in 0..D {
            port.number(next(), guess[k], &mut impact.normal[k])?;
        }
        let normal = impact.normal;
        let gap = if both { distance - (radius(0) + radius(1)) } else { 0.0 };
        let guess = self.wrapped(arrives[0].0) + normal * (radius(0) + 0.5 * gap);
        for k in 0..D {
            port.number(next(), guess[k], &mut impact.point[k])?;
        }
        for side in 0..2 {
            for k in 0..D {
                port.number(next(), arrives[side].1.velocity[k], &mut impact.before[side].velocity[k])?;
            }
            spin::<D>(port, &mut next, arrives[side].1.spin, &mut impact.before[side].spin)?;
        }
        // What they exchange.
        let [va, vb] = [impact.before[0].velocity, impact.before[1].velocity];
        port.number(next(), (va - vb).dot(normal), &mut impact.approach)?;
        port.number(next(), self.restitution, &mut impact.restitution)?;
        let inverse = |side: usize| if is_body(side) { self.stage.bodies[place(side)].inverse_mass } else { 0.0 };
        let moving = |side: usize, velocity| Moving { inverse_mass: inverse(side), velocity };
        let along = if !both || normal.largest() == 1.0 { normal } else { towards };
        let (mut a, mut b) = (moving(0, va), moving(1, vb));
        let mut push = smooth::impulse(&a, &b, along, impact.restitution);
        port.number(next(), push.dot(normal), &mut impact.impulse)?;
        for k in 0..D {
            port.number(next(), 0.0, &mut impact.friction_impulse[k])?;
        }
        if push.dot(normal) != impact.impulse || impact.friction_impulse != Vector::ZERO {
            push = normal * impact.impulse + impact.friction_impulse;
        }
        smooth::exchange(&mut a, &mut b, push);
        for (side, velocity) in [(0, a.velocity), (1, b.velocity)] {
            let i = place(side);
            let mut leaves = State { velocity, spin: impact.before[side].spin };
            if is_body(side) && again[side] {
                leaves = State { velocity: self.bodies[i].v, spin: self.bodies[i].spin };
            } else if is_body(side) && impact.friction_impulse != Vector::ZERO {
                let sign = if side == 0 { -1.0 } else { 1.0 };
                let arm = if side == 0 { normal * radius(0) } else { -(normal * radius(1)) };
                let moment = Vector::<D>::moment(arm, impact.friction_impulse * sign);
                leaves.spin += moment * self.stage.bodies[i].inverse_inertia;
            }
            for k in 0..D {
                port.number(next(), leaves.velocity[k], &mut impact.after[side].velocity[k])?;
            }
            spin::<D>(port, &mut next, leaves.spin, &mut impact.after[side].spin)?;
        }
        let [ua, ub] = [impact.after[0].velocity, impact.after[1].velocity];
        port.number(next(), -(ua - ub).dot(normal), &mut impact.departure)?;
        let guess = 0.5 * impact.impulse * (impact.approach - impact.departure);
        port.number(next(), guess, &mut impact.lost)?;
        // What is remembered.
        (self.time, self.restitution, self.together) = (time, impact.restitution, together);
        for side in 0..2 {
            let (i, State { velocity: v, spin }) = (place(side), impact.after[side]);
            if is_body(side) {
                let x = self.wrapped(arrives[side].0);
                self.bodies[i] = Seen { x, v, spin, time, before: impact.before[side] };
            } else {
                self.walls[i] = (if side == 1 { normal } else { -normal }, v);
            }
        }
        Some(())
    }

    fn party(&self, code: u64) -> Option<Party> {
        let i = usize::try_from(code >> 1).ok()?;
        match code & 1 {
            0 => self.stage.bodies.get(i).map(|b| Party::Body(b.id)),
            _ => self.stage.walls.get(i).map(|&id| Party::Wall(id)),
        }
    }
}

/// The place of a party, and whether it is a wall.
fn code(party: Party) -> u64 {
    match party {
        Party::Body(id) => (id.index() as u64) << 1,
        Party::Wall(id) => (id.index() as u64) << 1 | 1,
    }
}

fn spin<const D: usize>(
    port: &mut impl Port,
    next: &mut impl FnMut() -> usize,
    guess: <Vector<D> as Rotates>::Spin,
    x: &mut <Vector<D> as Rotates>::Spin,
) -> Option<()>
where
    Vector<D>: Rotates,
{
    let mut numbers = [0.0; 3];
    let count = Vector::<D>::SPINS;
    numbers[..count].copy_from_slice(Vector::<D>::spin_slice(x));
    for k in 0..count {
        port.number(next(), Vector::<D>::spin_slice(&guess)[k], &mut numbers[k])?;
    }
    *x = Vector::<D>::spin_from(&numbers[..count])?;
    Some(())
}

/// Numbers in the order of their values, so that neighbours differ by one.
fn ordered(x: f64) -> i64 {
    let bits = x.to_bits() as i64;
    bits ^ (((bits >> 63) as u64) >> 1) as i64
}

fn from_ordered(k: i64) -> f64 {
    f64::from_bits((k ^ (((k >> 63) as u64) >> 1) as i64) as u64)
}

/// Small differences of either sign are small: 0, -1, 1, -2, ...
fn folded(k: i64) -> u64 {
    ((k << 1) ^ (k >> 63)) as u64
}

fn unfolded(x: u64) -> i64 {
    (x >> 1) as i64 ^ -((x & 1) as i64)
}

/// Seven bits a byte, the lowest first.
pub(super) fn write_whole(mut x: u64, to: &mut Vec<u8>) {
    while x >= 0x80 {
        to.push(x as u8 | 0x80);
        x >>= 7;
    }
    to.push(x as u8);
}

pub(super) fn read_whole(from: &mut &[u8]) -> Option<u64> {
    let mut x = 0u64;
    for shift in (0..64).step_by(7) {
        let (&byte, rest) = from.split_first()?;
        *from = rest;
        x |= u64::from(byte & 0x7f) << shift;
        if byte & 0x80 == 0 {
            return Some(x);
        }
    }
    None
}

/// The columns of a block on their way out: differences, and whether any is not zero.
#[derive(Clone, Debug, Default)]
struct Out {
    columns: Vec<(bool, Vec<u8>)>,
}

impl Out {
    fn add(&mut self, column: usize, difference: u64) {
        if self.columns.len() <= column {
            self.columns.resize(column + 1, (false, Vec::new()));
        }
        let (any, bytes) = &mut self.columns[column];
        *any |= difference != 0;
        write_whole(difference, bytes);
    }
}

impl Port for Out {
    fn number(&mut self, column: usize, guess: f64, x: &mut f64) -> Option<()> {
        self.add(column, folded(ordered(*x).wrapping_sub(ordered(guess))));
        Some(())
    }

    fn whole(&mut self, column: usize, guess: u64, x: &mut u64) -> Option<()> {
        self.add(column, folded(x.wrapping_sub(guess) as i64));
        Some(())
    }
}

/// The columns of a block on their way in: `None` for one that is zero throughout.
struct In<'a> {
    columns: Vec<Option<&'a [u8]>>,
}

impl In<'_> {
    fn take(&mut self, column: usize) -> Option<i64> {
        match self.columns.get_mut(column)? {
            Some(bytes) => read_whole(bytes).map(unfolded),
            None => Some(0),
        }
    }
}

impl Port for In<'_> {
    fn number(&mut self, column: usize, guess: f64, x: &mut f64) -> Option<()> {
        *x = from_ordered(ordered(guess).wrapping_add(self.take(column)?));
        Some(())
    }

    fn whole(&mut self, column: usize, guess: u64, x: &mut u64) -> Option<()> {
        *x = guess.wrapping_add(self.take(column)? as u64);
        Some(())
    }
}

/// Makes blocks of impacts.
#[derive(Clone, Debug)]
pub struct Encoder<const D: usize>
where
    Vector<D>: Rotates,
{
    memory: Memory<D>,
    out: Out,
    count: usize,
}

impl<const D: usize> Encoder<D>
where
    Vector<D>: Rotates,
{
    /// For a recording that has no impacts yet.
    pub fn new(stage: Stage<D>) -> Self {
        Self { memory: Memory::new(stage), out: Out::default(), count: 0 }
    }

    /// Adds an impact to the block under way; how many that makes.
    pub fn add(&mut self, impact: &Impact<D>) -> usize {
        let mut impact = *impact;
        // Writing never ends.
        let _ = self.memory.pass(&mut self.out, &mut impact);
        self.count += 1;
        self.count
    }

    /// The impacts of the block under way.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The block under way as bytes, for [`Decoder::block`]; the next one is empty.
    pub fn block(&mut self) -> Vec<u8> {
        let mut bytes = Vec::new();
        write_whole(self.count as u64, &mut bytes);
        write_whole(self.out.columns.len() as u64, &mut bytes);
        for (any, column) in &self.out.columns {
            write_whole(if *any { column.len() as u64 } else { 0 }, &mut bytes);
        }
        for (any, column) in &mut self.out.columns {
            if *any {
                bytes.extend_from_slice(column);
            }
            column.clear();
            *any = false;
        }
        self.count = 0;
        bytes
    }
}

/// Reads blocks of impacts, one after the other from the first.
#[derive(Clone, Debug)]
pub struct Decoder<const D: usize>
where
    Vector<D>: Rotates,
{
    memory: Memory<D>,
}

impl<const D: usize> Decoder<D>
where
    Vector<D>: Rotates,
{
    /// Before the first block.
    pub fn new(stage: Stage<D>) -> Self {
        Self { memory: Memory::new(stage) }
    }

    /// The impacts of the next block; `None` if its bytes make no sense.
    pub fn block(&mut self, mut bytes: &[u8]) -> Option<Vec<Impact<D>>> {
        let count = usize::try_from(read_whole(&mut bytes)?).ok().filter(|&n| n <= super::BLOCK)?;
        let columns = usize::try_from(read_whole(&mut bytes)?).ok().filter(|&n| n <= 256)?;
        let mut lengths = Vec::with_capacity(columns);
        for _ in 0..columns {
            lengths.push(usize::try_from(read_whole(&mut bytes)?).ok()?);
        }
        let mut port = In { columns: Vec::with_capacity(columns) };
        for length in lengths {
            let (column, rest) = bytes.split_at_checked(length)?;
            port.columns.push((length > 0).then_some(column));
            bytes = rest;
        }
        let nobody = self.memory.party(0)?;
        let empty = Impact {
            time: 0.0,
            parties: [nobody; 2],
            point: Vector::ZERO,
            normal: Vector::ZERO,
            approach: 0.0,
            departure: 0.0,
            restitution: 0.0,
            impulse: 0.0,
            friction_impulse: Vector::ZERO,
            before: [State::default(); 2],
            after: [State::default(); 2],
            lost: 0.0,
            together: 0,
        };
        let mut impacts = Vec::with_capacity(count);
        for _ in 0..count {
            let mut impact = empty;
            self.memory.pass(&mut port, &mut impact)?;
            impacts.push(impact);
        }
        Some(impacts)
    }

    /// An encoder that goes on where this decoder is.
    pub fn encoder(&self) -> Encoder<D> {
        Encoder { memory: self.memory.clone(), out: Out::default(), count: 0 }
    }
}
