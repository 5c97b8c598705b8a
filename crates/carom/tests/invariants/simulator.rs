//! The simulator of quadratic cost: every body at the present time, each meeting a polynomial in time, the earliest of all taken, the
//! lecture's law.
use carom::Vector;

/// Events of the model closer than this (s) may come in another order, or share an instant: bodies that are nearer than 1e-9 of
/// a radius touch, and at `SLOW` they are a hundred times as far away this long before.
pub const APART: f64 = 1e-5;

/// A polynomial by rising powers, evaluated by Horner's rule.
fn value(p: &[f64], t: f64) -> f64 {
    p.iter().rev().fold(0.0, |sum, c| sum * t + c)
}

fn derivative(p: &[f64]) -> Vec<f64> {
    p.iter().enumerate().skip(1).map(|(k, c)| k as f64 * c).collect()
}

/// Where a function that changes its sign between `a` and `b` does so: halved until the two ends are neighbours.
fn bisect(p: &[f64], mut a: f64, mut b: f64) -> f64 {
    let rising = value(p, b) > 0.0;
    for _ in 0..100 {
        let middle = 0.5 * (a + b);
        if middle <= a || middle >= b {
            break;
        }
        if (value(p, middle) > 0.0) == rising { b = middle } else { a = middle }
    }
    b
}

/// The points of (0, end) at which a polynomial changes its sign: between any two of them lies one of its derivative.
fn sign_changes(p: &[f64], end: f64) -> Vec<f64> {
    if p.len() < 2 {
        return Vec::new();
    }
    let mut stops = vec![0.0];
    stops.extend(sign_changes(&derivative(p), end));
    stops.push(end);
    let mut roots = Vec::new();
    for w in stops.windows(2) {
        if (value(p, w[0]) > 0.0) != (value(p, w[1]) > 0.0) {
            roots.push(bisect(p, w[0], w[1]));
        }
    }
    roots
}

/// The first t in [0, end) at which the gap function f is not positive and falls: THEORY 5.1.
fn first_meeting(f: &[f64], end: f64) -> Option<f64> {
    let mut stops = vec![0.0];
    stops.extend(sign_changes(&derivative(f), end));
    stops.push(end);
    for w in stops.windows(2) {
        let (from, to) = (value(f, w[0]), value(f, w[1]));
        let falls = value(&derivative(f), 0.5 * (w[0] + w[1])) < 0.0;
        if falls && from <= 0.0 {
            return Some(w[0]);
        }
        if falls && to < 0.0 {
            return Some(bisect(f, w[0], w[1]));
        }
    }
    None
}

#[derive(Clone, Debug)]
pub struct Body<const D: usize> {
    pub x: Vector<D>,
    pub v: Vector<D>,
    /// 1/m; 0 for a fixed or a driven body.
    pub w: f64,
    pub r: f64,
    pub e: Option<f64>,
    pub layers: (u32, u32),
    pub alive: bool,
}

#[derive(Clone, Debug)]
pub struct Plane<const D: usize> {
    pub point: Vector<D>,
    pub normal: Vector<D>,
    pub velocity: Vector<D>,
    pub e: Option<f64>,
}

#[derive(Clone, Debug)]
pub struct Model<const D: usize> {
    pub time: f64,
    pub bodies: Vec<Body<D>>,
    pub planes: Vec<Plane<D>>,
    pub gravity: Vector<D>,
    /// The width of the box along periodic axes, 0 along the others; its lower corner is the origin.
    pub width: Vector<D>,
    pub ignored: Vec<(usize, usize)>,
    /// Two meetings came closer together than [`APART`]: bounces that pile up. From there on nobody knows.
    pub stuck: bool,
}

/// What the model says of an impact: the parties by their numbers, walls after 1000.
#[derive(Clone, Copy, Debug)]
pub struct Hit<const D: usize> {
    pub time: f64,
    pub a: usize,
    pub b: usize,
    pub impulse: f64,
    pub approach: f64,
}

pub const WALLS: usize = 1000;

impl<const D: usize> Model<D> {
    pub fn acceleration(&self, i: usize) -> Vector<D> {
        if self.bodies[i].w > 0.0 { self.gravity } else { Vector::ZERO }
    }

    pub fn collide(&self, i: usize, j: usize) -> bool {
        let (a, b) = (&self.bodies[i], &self.bodies[j]);
        a.alive
            && b.alive
            && (a.w > 0.0 || b.w > 0.0)
            && a.layers.0 & b.layers.1 != 0
            && b.layers.0 & a.layers.1 != 0
            && !self.ignored.contains(&(i.min(j), i.max(j)))
    }

    /// Every image of the vector from i to j that may matter within a step in which nobody moves half the box.
    pub fn images(&self, d: Vector<D>) -> Vec<Vector<D>> {
        let mut images = vec![d];
        for k in 0..D {
            if self.width[k] > 0.0 {
                let now = images.clone();
                for turns in [-2.0, -1.0, 1.0, 2.0] {
                    images.extend(now.iter().map(|d| *d + Vector::axis(k) * (turns * self.width[k])));
                }
            }
        }
        images
    }

    /// |x + v t + a t^2/2|^2 - R^2
    pub fn pair_gap(&self, i: usize, j: usize, d: Vector<D>) -> Vec<f64> {
        let (a, b) = (&self.bodies[i], &self.bodies[j]);
        let (v, g) = (b.v - a.v, self.acceleration(j) - self.acceleration(i));
        let reach = a.r + b.r;
        let gap = (d.norm() - reach) * (d.norm() + reach);
        let mut f = vec![gap, 2.0 * d.dot(v), v.dot(v) + d.dot(g), v.dot(g), 0.25 * g.dot(g)];
        while f.len() > 1 && f[f.len() - 1] == 0.0 {
            f.pop();
        }
        f
    }

    /// s + v_n t + a_n t^2/2 - r
    pub fn wall_gap(&self, i: usize, w: usize) -> Vec<f64> {
        let (b, p) = (&self.bodies[i], &self.planes[w]);
        let mut f = vec![
            (b.x - p.point).dot(p.normal) - b.r,
            (b.v - p.velocity).dot(p.normal),
            0.5 * self.gravity.dot(p.normal),
        ];
        while f.len() > 1 && f[f.len() - 1] == 0.0 {
            f.pop();
        }
        f
    }

    pub fn drift(&mut self, dt: f64) {
        for i in 0..self.bodies.len() {
            let a = self.acceleration(i);
            let b = &mut self.bodies[i];
            b.x = b.x + b.v * dt + a * (0.5 * dt * dt);
            b.v += a * dt;
            for k in 0..D {
                if self.width[k] > 0.0 {
                    b.x[k] -= (b.x[k] / self.width[k]).floor() * self.width[k];
                }
            }
        }
        for p in &mut self.planes {
            p.point += p.velocity * dt;
        }
        self.time += dt;
    }

    /// A step in which nobody can move half of a periodic box.
    pub fn step(&self) -> f64 {
        let narrowest = (0..D).map(|k| self.width[k]).filter(|w| *w > 0.0).fold(f64::INFINITY, f64::min);
        let fastest = self.bodies.iter().map(|b| b.v.norm()).fold(0.0, f64::max);
        if narrowest.is_infinite() { f64::INFINITY } else { 0.25 * narrowest / (fastest + self.gravity.norm() + 1e-3) }
    }

    /// The impacts up to `end`, at most `most`.
    pub fn run(&mut self, end: f64, most: usize) -> Vec<Hit<D>> {
        let mut hits: Vec<Hit<D>> = Vec::new();
        while self.time < end && hits.len() < most && !self.stuck {
            let horizon = (end - self.time).min(self.step().min(1.0));
            let mut first: Option<(f64, usize, usize, Vector<D>)> = None;
            let mut offer = |t: Option<f64>, i: usize, j: usize, n: Vector<D>| {
                if let Some(t) = t
                    && first.is_none_or(|f| t < f.0)
                {
                    first = Some((t, i, j, n));
                }
            };
            for i in 0..self.bodies.len() {
                for j in i + 1..self.bodies.len() {
                    if self.collide(i, j) {
                        for d in self.images(self.bodies[j].x - self.bodies[i].x) {
                            offer(first_meeting(&self.pair_gap(i, j, d), horizon), i, j, d);
                        }
                    }
                }
                if self.bodies[i].alive && self.bodies[i].w > 0.0 {
                    for w in 0..self.planes.len() {
                        let n = -self.planes[w].normal;
                        offer(first_meeting(&self.wall_gap(i, w), horizon), i, WALLS + w, n);
                    }
                }
            }
            let Some((t, i, j, d)) = first else {
                self.drift(horizon);
                continue;
            };
            // The line of centres at the meeting.
            let d = if j >= WALLS {
                d
            } else {
                let (v, a) = (self.bodies[j].v - self.bodies[i].v, self.acceleration(j) - self.acceleration(i));
                d + v * t + a * (0.5 * t * t)
            };
            self.drift(t);
            let (impulse, approach) = self.impact(i, j, d);
            self.stuck = hits.last().is_some_and(|h| self.time - h.time < APART) || impulse == 0.0;
            if impulse > 0.0 {
                hits.push(Hit { time: self.time, a: i, b: j, impulse, approach });
            }
        }
        hits
    }

    /// The lecture's step 11, written out.
    pub fn impact(&mut self, i: usize, j: usize, d: Vector<D>) -> (f64, f64) {
        let n = d / d.norm();
        let (wi, vi, ei) = (self.bodies[i].w, self.bodies[i].v, self.bodies[i].e);
        let (wj, vj, ej) = if j >= WALLS {
            (0.0, self.planes[j - WALLS].velocity, self.planes[j - WALLS].e)
        } else {
            (self.bodies[j].w, self.bodies[j].v, self.bodies[j].e)
        };
        let e = match (ei, ej) {
            (Some(a), Some(b)) => (a * b).sqrt(),
            (Some(e), None) | (None, Some(e)) => e,
            (None, None) => 1.0,
        };
        let approach = (vi - vj).dot(n);
        let impulse = (1.0 + e) * approach / (wi + wj);
        if !(impulse > 0.0) {
            return (0.0, approach);
        }
        self.bodies[i].v -= n * (impulse * wi);
        if j < WALLS {
            self.bodies[j].v += n * (impulse * wj);
        }
        (impulse, approach)
    }

    /// The smallest gap of a ball at x to all others and to the planes; negative if they overlap.
    pub fn room(&self, x: Vector<D>, r: f64, but: Option<usize>) -> f64 {
        let mut room = f64::INFINITY;
        for (i, b) in self.bodies.iter().enumerate() {
            if Some(i) != but && b.alive {
                for d in self.images(b.x - x) {
                    room = room.min(d.norm() - r - b.r);
                }
            }
        }
        for p in &self.planes {
            room = room.min((x - p.point).dot(p.normal) - r);
        }
        room
    }
}

#[test]
fn the_simulator_knows_the_exact_cases() {
    // THEORY 5.2 and 5.3: the polynomial, its turning points and its bisection.
    let near = |got: Option<f64>, want: f64| {
        println!("{got:?} {want}");
        assert!((got.unwrap() - want).abs() < 1e-14);
    };
    // (-5, 0, 0) at v = (1, 0, 0), R = 1: 4. As a polynomial: (t - 5)^2 - 1.
    near(first_meeting(&[24.0, -10.0, 1.0], 100.0), 4.0);
    // Grazing: (t - 10)^2 >= 0 never falls through.
    assert_eq!(first_meeting(&[100.0, -20.0, 1.0], 100.0), None);
    // g = 9.81, a plane 9 below: 1.3545709229571927.
    near(first_meeting(&[9.0, 0.0, -0.5 * 9.81], 100.0), 1.3545709229571927);
    // Inside by 0.1, moving out at 0.5 under g: the turning point, 0.5/9.81 = 0.0509683995922528.
    near(first_meeting(&[-0.1, 0.5, -0.5 * 9.81], 100.0), 0.0509683995922528);
    // (3, 0, -4), v = (-2, 0, 8), g: none (THEORY 5.3). |x|^2 - 1 with x = (3 - 2 t, -4 + 8 t - 4.905 t^2).
    let f = [24.0, -12.0 - 64.0, 4.0 + 64.0 + 8.0 * 4.905, -16.0 * 4.905, 4.905 * 4.905];
    assert_eq!(first_meeting(&f, 100.0), None);
}
