//! A simulator of quadratic cost, written to be obviously right: plain lists, everything at the present time, the next event found
//! by looking at every pair, and the law of rough spheres as it stands in a book.
//!
//! It shares nothing with the engine: no vectors, no roots, no law.
use super::polynomial::falls;
use super::space::V;

/// What a surface says; `None` leaves the word to the other one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surface {
    pub restitution: Option<f64>,
    pub friction: Option<f64>,
    pub tangential: Option<f64>,
}

#[derive(Clone, Debug)]
pub struct Ball {
    pub x: V,
    pub v: V,
    pub spin: V,
    /// Infinite if nothing moves it.
    pub mass: f64,
    pub radius: f64,
    /// k in I = k m R^2.
    pub kappa: f64,
    pub surface: Surface,
    pub layers: u32,
    pub meets: u32,
}

#[derive(Clone, Debug)]
pub enum Form {
    /// Balls live on the side of the unit normal.
    Plane { point: V, normal: V },
    /// Thin, two-sided, in the plane.
    Segment { from: V, to: V },
}

#[derive(Clone, Debug)]
pub struct Wall {
    pub form: Form,
    pub velocity: V,
    pub surface: Surface,
}

/// Who a ball meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Other {
    Ball(usize),
    Wall(usize),
}

/// One impact.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    pub time: f64,
    pub ball: usize,
    pub other: Other,
    /// N s, along the normal; and the vector across it that the other one gets.
    pub impulse: f64,
    pub friction: V,
    pub approach: f64,
}

#[derive(Clone, Debug, Default)]
pub struct Simulator {
    pub time: f64,
    /// By the order in which they came; what was removed leaves its place empty.
    pub balls: Vec<Option<Ball>>,
    pub walls: Vec<Option<Wall>>,
    pub gravity: [f64; 3],
    pub ignored: Vec<(usize, usize)>,
    /// Events came closer together, or slower, than anybody can tell: see [`APART`] and [`SLOW`].
    pub lost: bool,
}

/// Events closer than this (s) might come in another order, or share an instant.
const APART: f64 = 1e-5;
/// Below this approach speed (m/s) the time of an impact depends too much on the last digits of a position.
const SLOW: f64 = 1e-2;
/// Impacts of one advance at most: where there are more, they pile up.
const MOST: usize = 60;

impl Simulator {
    pub fn ball(&self, i: usize) -> Option<&Ball> {
        self.balls[i].as_ref()
    }

    fn alive(&self) -> impl Iterator<Item = (usize, &Ball)> {
        self.balls.iter().enumerate().filter_map(|(i, b)| Some((i, b.as_ref()?)))
    }

    fn standing(&self) -> impl Iterator<Item = (usize, &Wall)> {
        self.walls.iter().enumerate().filter_map(|(w, wall)| Some((w, wall.as_ref()?)))
    }

    fn acceleration(&self, ball: &Ball) -> V {
        if ball.mass.is_finite() { V(self.gravity) } else { V::ZERO }
    }

    fn collide(&self, (i, a): (usize, &Ball), (j, b): (usize, &Ball)) -> bool {
        (a.mass.is_finite() || b.mass.is_finite())
            && a.layers & b.meets != 0
            && b.layers & a.meets != 0
            && !self.ignored.contains(&(i.min(j), i.max(j)))
    }

    /// When two balls meet within `end`: |d + v t + a t^2/2|^2 = (R_a + R_b)^2.
    fn pair_meets(&self, a: &Ball, b: &Ball, end: f64) -> Option<f64> {
        let (d, v, g) = (b.x - a.x, b.v - a.v, self.acceleration(b) - self.acceleration(a));
        let reach = a.radius + b.radius;
        let gap = [d.dot(d) - reach * reach, 2.0 * d.dot(v), v.dot(v) + d.dot(g), v.dot(g), 0.25 * g.dot(g)];
        falls(&gap, end).first().copied()
    }

    /// When a ball meets a wall within `end`.
    fn wall_meets(&self, b: &Ball, wall: &Wall, end: f64) -> Option<f64> {
        let (v, g) = (b.v - wall.velocity, self.acceleration(b));
        // (x - p).n = R, for a ball that comes along -n.
        let line = |p: V, n: V| falls(&[(b.x - p).dot(n) - b.radius, v.dot(n), 0.5 * g.dot(n)], end);
        match wall.form {
            Form::Plane { point, normal } => line(point, normal).first().copied(),
            Form::Segment { from, to } => {
                let along = to - from;
                let normal = V([-along.0[1], along.0[0], 0.0]) * (1.0 / along.length());
                let over = |t: f64| {
                    let foot = (b.x + v * t + g * (0.5 * t * t) - from).dot(along) / along.dot(along);
                    (0.0..=1.0).contains(&foot)
                };
                let mut times: Vec<f64> =
                    [normal, -normal].iter().filter_map(|n| line(from, *n).into_iter().find(|t| over(*t))).collect();
                for end_point in [from, to] {
                    let d = b.x - end_point;
                    let gap = [
                        d.dot(d) - b.radius * b.radius,
                        2.0 * d.dot(v),
                        v.dot(v) + d.dot(g),
                        v.dot(g),
                        0.25 * g.dot(g),
                    ];
                    times.extend(falls(&gap, end).first());
                }
                times.into_iter().min_by(f64::total_cmp)
            }
        }
    }

    /// The first event within `end`, of all pairs.
    fn next(&self, end: f64) -> Option<(f64, usize, Other)> {
        let mut first: Option<(f64, usize, Other)> = None;
        let mut offer = |t: Option<f64>, i: usize, other: Other| {
            if let Some(t) = t
                && first.is_none_or(|f| t < f.0)
            {
                first = Some((t, i, other));
            }
        };
        for (i, a) in self.alive() {
            for (j, b) in self.alive().filter(|(j, _)| *j > i) {
                if self.collide((i, a), (j, b)) {
                    offer(self.pair_meets(a, b, end), i, Other::Ball(j));
                }
            }
            for (w, wall) in self.standing().filter(|_| a.mass.is_finite()) {
                offer(self.wall_meets(a, wall, end), i, Other::Wall(w));
            }
        }
        first
    }

    fn drift(&mut self, dt: f64) {
        let gravity = V(self.gravity);
        for ball in self.balls.iter_mut().flatten() {
            let g = if ball.mass.is_finite() { gravity } else { V::ZERO };
            ball.x = ball.x + ball.v * dt + g * (0.5 * dt * dt);
            ball.v = ball.v + g * dt;
        }
        for wall in self.walls.iter_mut().flatten() {
            let step = wall.velocity * dt;
            match &mut wall.form {
                Form::Plane { point, .. } => *point = *point + step,
                Form::Segment { from, to } => (*from, *to) = (*from + step, *to + step),
            }
        }
        self.time += dt;
    }

    /// Lets time pass until `end`, and returns what happened.
    pub fn advance_to(&mut self, end: f64) -> Vec<Hit> {
        let mut hits: Vec<Hit> = Vec::new();
        while let Some((t, i, other)) = self.next(end - self.time) {
            self.drift(t);
            let hit = self.impact(i, other);
            let before = hits.last().map_or(f64::NEG_INFINITY, |h| h.time);
            self.lost |= !(hit.approach > SLOW) || hit.time - before < APART || end - hit.time < APART;
            if self.lost || hits.len() >= MOST {
                self.lost = true;
                return hits;
            }
            hits.push(hit);
        }
        self.drift(end - self.time);
        self.time = end;
        hits
    }

    /// The unit vector from a ball to what it touches.
    fn normal(&self, a: &Ball, other: Other) -> V {
        let d = match other {
            Other::Ball(j) => self.balls[j].as_ref().expect("it is there").x - a.x,
            Other::Wall(w) => match self.walls[w].as_ref().expect("it is there").form {
                Form::Plane { normal, .. } => -normal,
                Form::Segment { from, to } => {
                    let along = to - from;
                    let foot = ((a.x - from).dot(along) / along.dot(along)).clamp(0.0, 1.0);
                    from + along * foot - a.x
                }
            },
        };
        d * (1.0 / d.length())
    }

    /// The rough sphere (Walton): the approach comes back times -e, the slip at the contact times -e_t unless the cone of
    /// friction is too narrow for that.
    fn impact(&mut self, i: usize, other: Other) -> Hit {
        let still = Ball {
            x: V::ZERO,
            v: V::ZERO,
            spin: V::ZERO,
            mass: f64::INFINITY,
            radius: 0.0,
            kappa: 1.0,
            surface: Surface::default(),
            layers: 0,
            meets: 0,
        };
        let a = self.balls[i].clone().expect("it is there");
        let b = match other {
            Other::Ball(j) => self.balls[j].clone().expect("it is there"),
            Other::Wall(w) => {
                let wall = self.walls[w].as_ref().expect("it is there");
                Ball { v: wall.velocity, surface: wall.surface, ..still }
            }
        };
        let n = self.normal(&a, other);
        let (e, mu, e_t) = together(a.surface, b.surface);
        let approach = (a.v - b.v).dot(n);
        let impulse = (1.0 + e) * approach / (1.0 / a.mass + 1.0 / b.mass);
        // Velocities of the two points that touch.
        let (at_a, at_b) = (a.v + a.spin.cross(n * a.radius), b.v + b.spin.cross(n * -b.radius));
        let u = at_a - at_b;
        let slip = u - n * u.dot(n);
        let give = |ball: &Ball| (1.0 + 1.0 / ball.kappa) / ball.mass;
        let stop = (1.0 + e_t) * slip.length() / (give(&a) + give(&b));
        let size = stop.min(mu * impulse);
        let friction = if size > 0.0 { slip * (size / slip.length()) } else { V::ZERO };
        let p = n * impulse + friction;
        for (k, ball, p, arm) in [(Some(i), &a, -p, n * a.radius), (index(other), &b, p, n * -b.radius)] {
            let Some(k) = k.filter(|_| ball.mass.is_finite()) else { continue };
            let inertia = ball.kappa * ball.mass * ball.radius * ball.radius;
            let struck = self.balls[k].as_mut().expect("it is there");
            struck.v = ball.v + p * (1.0 / ball.mass);
            struck.spin = ball.spin + arm.cross(p) * (1.0 / inertia);
        }
        Hit { time: self.time, ball: i, other, impulse, friction, approach }
    }

    /// The smallest gap of a ball to all others, and to the walls.
    pub fn room(&self, x: V, radius: f64, but: Option<usize>) -> f64 {
        let others = self.alive().filter(|(i, _)| Some(*i) != but).map(|(_, b)| (b.x - x).length() - radius - b.radius);
        let walls = self.standing().map(|(_, wall)| gap(x, radius, &wall.form));
        others.chain(walls).fold(f64::INFINITY, f64::min)
    }

    /// True if two balls lie in each other, or nearly.
    pub fn overlap(&self, i: usize, j: usize) -> bool {
        let (Some(a), Some(b)) = (self.ball(i), self.ball(j)) else { return false };
        (b.x - a.x).length() < a.radius + b.radius + 1e-6
    }

    /// The smallest gap of a wall to all balls.
    pub fn room_for(&self, form: &Form) -> f64 {
        self.alive().map(|(_, b)| gap(b.x, b.radius, form)).fold(f64::INFINITY, f64::min)
    }
}

fn index(other: Other) -> Option<usize> {
    match other {
        Other::Ball(j) => Some(j),
        Other::Wall(_) => None,
    }
}

fn gap(x: V, radius: f64, form: &Form) -> f64 {
    match *form {
        Form::Plane { point, normal } => (x - point).dot(normal) - radius,
        Form::Segment { from, to } => {
            let along = to - from;
            let foot = ((x - from).dot(along) / along.dot(along)).clamp(0.0, 1.0);
            (from + along * foot - x).length() - radius
        }
    }
}

/// e, mu and e_t of two surfaces: if both say one, the geometric mean (of e_t the mean); if one does, that; else the smooth elastic ball.
fn together(a: Surface, b: Surface) -> (f64, f64, f64) {
    fn both(a: Option<f64>, b: Option<f64>, mean: fn(f64, f64) -> f64, unsaid: f64) -> f64 {
        match (a, b) {
            (Some(a), Some(b)) => mean(a, b),
            (said, None) | (None, said) => said.unwrap_or(unsaid),
        }
    }
    (
        both(a.restitution, b.restitution, |a, b| (a * b).sqrt(), 1.0),
        both(a.friction, b.friction, |a, b| (a * b).sqrt(), 0.0),
        both(a.tangential, b.tangential, |a, b| 0.5 * (a + b), 0.0),
    )
}
