//! The yardstick: what it costs, on this machine and now, to predict the meetings of both partners of one impact with 16 neighbours
//! each, done plainly: scalar, one record of 400 bytes a ball, random pairs. Its work never changes, so that the ratio of a
//! benchmark to it can be compared between machines. Always in space, also for discs.
use crate::clock::cpu_seconds;
use crate::dice::Dice;

const NEIGHBOURS: usize = 16;
/// Pairs that are drawn in advance.
const PAIRS: usize = 312_500;

#[repr(C)]
#[derive(Clone)]
struct Ball {
    r: [f64; 3],
    v: [f64; 3],
    t: f64,
    radius: f64,
    near: [u32; NEIGHBOURS],
    rest: [u8; 272],
}

const _: () = assert!(size_of::<Ball>() == 400);

/// The balls and pairs of the yardstick, ready to be measured.
pub struct Yardstick {
    balls: Vec<Ball>,
    pairs: Vec<(u32, u32)>,
    /// The next pair, so that slices go on where the last one ended.
    at: usize,
    sink: f64,
}

/// Time until two balls touch, from `now`; infinite if they never do or not before `best`.
#[inline(always)]
fn meet(a: &Ball, b: &Ball, now: f64, best: f64) -> f64 {
    let (ta, tb) = (now - a.t, now - b.t);
    let (mut rv, mut vv, mut rr) = (0.0, 0.0, 0.0);
    for k in 0..3 {
        let dv = b.v[k] - a.v[k];
        let dr = (b.r[k] + b.v[k] * tb) - (a.r[k] + a.v[k] * ta);
        rv += dr * dv;
        vv += dv * dv;
        rr += dr * dr;
    }
    if rv >= 0.0 {
        return f64::INFINITY;
    }
    let s = a.radius + b.radius;
    let c = rr - s * s;
    if 2.0 * -rv * best < c {
        return f64::INFINITY;
    }
    let d = rv * rv - vv * c;
    if d < 0.0 {
        return f64::INFINITY;
    }
    let t = c / (-rv + d.sqrt());
    if t < best { t } else { f64::INFINITY }
}

impl Yardstick {
    /// The yardstick for `n` balls (at least 27).
    pub fn new(n: usize) -> Self {
        let n = n.max(27);
        let mut dice = Dice::new(0);
        // The number density of a dense fluid of unit diameter.
        let side = (n as f64 / 0.94).cbrt();
        let per = (n as f64).cbrt().ceil() as usize;
        let pitch = side / per as f64;
        let place = |i: usize| [i % per, i / per % per, i / per / per];
        let mut balls: Vec<Ball> = (0..n)
            .map(|i| Ball {
                r: std::array::from_fn(|k| place(i)[k] as f64 * pitch + 0.05 * dice.unit()),
                v: std::array::from_fn(|_| dice.unit() + dice.unit() + dice.unit() - 1.5),
                t: 0.0,
                radius: 0.5,
                near: [0; NEIGHBOURS],
                rest: [0; 272],
            })
            .collect();
        let back = per - 1;
        let around: [[usize; 3]; NEIGHBOURS] = [
            [1, 0, 0],
            [0, 1, 0],
            [0, 0, 1],
            [1, 1, 0],
            [1, 0, 1],
            [0, 1, 1],
            [1, 1, 1],
            [2, 0, 0],
            [back, 0, 0],
            [0, back, 0],
            [0, 0, back],
            [back, 1, 0],
            [back, 0, 1],
            [0, back, 1],
            [1, back, 0],
            [0, 2, 0],
        ];
        for (i, ball) in balls.iter_mut().enumerate() {
            let c = place(i);
            for (k, o) in around.iter().enumerate() {
                let j = ((c[0] + o[0]) % per) + per * ((c[1] + o[1]) % per) + per * per * ((c[2] + o[2]) % per);
                ball.near[k] = (j % n) as u32;
            }
        }
        let pairs = (0..PAIRS)
            .map(|_| {
                let a = dice.bits() as usize % n;
                (a as u32, balls[a].near[dice.bits() as usize % NEIGHBOURS])
            })
            .collect();
        Self { balls, pairs, at: 0, sink: 0.0 }
    }

    /// One slice of so many pairs: nanoseconds of CPU time a pair.
    pub fn slice(&mut self, pairs: usize) -> f64 {
        let start = cpu_seconds();
        for _ in 0..pairs {
            let (a, b) = self.pairs[self.at];
            self.at = (self.at + 1) % PAIRS;
            for i in [a as usize, b as usize] {
                let ball = &self.balls[i];
                let mut best = 1.0e3;
                for k in 0..NEIGHBOURS {
                    let t = meet(ball, &self.balls[ball.near[k] as usize], 0.001, best);
                    if t < best {
                        best = t;
                    }
                }
                self.sink += best;
            }
        }
        let taken = cpu_seconds() - start;
        // What is never looked at would not be computed.
        assert!(self.sink.is_finite() && self.balls[0].rest[0] == 0);
        taken * 1e9 / pairs as f64
    }
}
