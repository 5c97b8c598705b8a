//! The course of an impact: Coulomb's friction followed through impulse space (Routh, Keller).
//!
//! A rigid impact takes no time, but it has an inside: the normal impulse p grows from 0, and the relative velocity at the
//! contact goes with it. In the signs of [`super::contact`], with s the slip and t = s/|s|,
//!
//! ```text
//! d(P)/dp = n + mu t          d(u)/dp = -K (n + mu t)                                 while it slips
//! d(P)/dp = n + c             c = -K_tt^-1 K_tn, if |c| <= mu                         once the slip has stopped: it sticks,
//!                             else it slips again along the one direction that leaves
//! ```
//!
//! (friction acts on the second body along the slip of the first over it). What ends the impact is the law's:
//! [`super::stronge`] asks for a share of the energy, [`super::newton`] for a speed.
//!
//! A slip that keeps its line is a straight segment with roots in closed form: always in the plane, always for balls, always
//! after the first stop. In space the first slip turns as it goes. It is integrated over theta with dp = |s| dtheta, for which
//! d(s)/dtheta = -(|s| K_tn + mu K_tt s) has no singularity where the slip stops: |s| falls exponentially and a straight
//! segment ends it. The pair of Dormand and Prince (order 5 with an error of order 4) keeps each step below [`TOLERANCE`]; the
//! steps are bounded by [`STEPS`], beyond which the answer is that of [`super::chatterjee_ruina`] and says so.
//!
//! # Accuracy
//! Straight segments are exact to rounding. Where the first slip turns, each step's error stays below [`TOLERANCE`] of the impulse; the books
//! take the impulse as it comes out, so that momentum and energy close to rounding all the same. It is a model: a rigid body, one coefficient of
//! friction for slipping and sticking alike, and no tangential compliance.
//!
//! Sources: E. J. Routh, *Dynamics of a System of Rigid Bodies* (1905); J. B. Keller, *Impact with friction*, Journal of
//! Applied Mechanics 53 (1986); V. Bhatt, J. Koechling, *Three-dimensional frictional rigid-body impact*, the same 62 (1995).
use super::chatterjee_ruina;
use super::contact::Contact;
use super::effective::{Effective, dot, length, solve, times};
use crate::material::Coefficients;
use crate::vector::Exact;
use crate::{Rotates, Vector};

/// The error of a step of the integration, relative to the impulse that stops the approach.
pub const TOLERANCE: f64 = 1e-11;
/// The integration takes at most this many steps, refused ones included. A slip that turns takes about 100; thousands happen
/// only where the point of a body moves a thousand times more easily one way than another.
pub const STEPS: u32 = 2000;
/// Friction above this is treated as this: nothing slips for longer than a billionth of the impact.
pub const ROUGHEST: f64 = 1e9;

/// What the slip did in the course of an impact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Slip {
    /// It went on to the end, or there was no friction.
    #[default]
    Kept,
    /// It stopped, or there was none, and the contact stuck from there.
    Stuck,
    /// It stopped, or there was none, and the bodies slipped another way from there.
    Turned,
}

/// An impulse, and how it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course<const D: usize> {
    /// P (N s): -P on the first body, +P on the second.
    pub impulse: Vector<D>,
    /// What the slip did.
    pub slip: Slip,
    /// Steps of the integration; 0 where closed forms sufficed.
    pub steps: u32,
    /// True if the impulse is the default law's (with e_t = 0): because the limit of steps was reached, or because the contact
    /// jams, which only bodies on an axle can do: it sticks, and no further impulse moves anything.
    pub fell_back: bool,
}

/// What ends an impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// The bodies part at e times the speed of approach.
    Speed,
    /// Restitution has given back e^2 of the work of compression.
    Energy,
}

/// What comes next on the way to the end.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Goal {
    /// The approach speed is minus this.
    Parting(f64),
    /// The end of compression.
    Compressed,
    /// The energy still to be given back is 0.
    Restored,
    Done,
}

/// How far the impact has gone.
#[derive(Clone, Copy, Debug)]
struct State {
    approach: f64,
    slip: [f64; 2],
    /// p, and the impulse across the normal.
    normal: f64,
    across: [f64; 2],
    /// Taken so far during compression; still to be given during restitution (J).
    work: f64,
    goal: Goal,
}

struct Process<const D: usize> {
    k: Effective<D>,
    mu: f64,
    e: f64,
}

pub(super) fn follow<const D: usize>(contact: &Contact<D>, c: Coefficients, end: End) -> Course<D>
where
    Vector<D>: Rotates,
{
    let k = Effective::of(contact);
    let mut course = Course { impulse: Vector::ZERO, slip: Slip::Kept, steps: 0, fell_back: false };
    if !k.closes() || !(c.restitution >= 0.0) {
        return course;
    }
    // NaN is no friction.
    let mu = if c.friction > 0.0 { if c.friction < ROUGHEST { c.friction } else { ROUGHEST } } else { 0.0 };
    let goal = match end {
        End::Speed => Goal::Parting(c.restitution * k.approach),
        End::Energy => Goal::Compressed,
    };
    let mut state = State { approach: k.approach, slip: k.slip, normal: 0.0, across: [0.0; 2], work: 0.0, goal };
    let process = Process { k, mu, e: c.restitution };
    process.run(&mut state, &mut course);
    if state.goal != Goal::Done || !state.normal.is_finite() {
        let plain = Coefficients { tangential: 0.0, ..c };
        return Course { impulse: chatterjee_ruina::impulse(contact, plain), fell_back: true, ..course };
    }
    // The integration leaves the cone by no more than its tolerance; the impulse that is handed out does not.
    let (limit, size) = (mu * state.normal, length(state.across));
    if size > limit {
        state.across = state.across.map(|x| x * (limit / size));
    }
    course.impulse = process.k.vector(state.normal, state.across);
    course
}

impl<const D: usize> Process<D>
where
    Vector<D>: Rotates,
{
    /// At most: a slip that turns and stops, and then sticks or leaves; every part may hold the end of compression.
    fn run(&self, state: &mut State, course: &mut Course<D>) {
        if !(self.mu > 0.0) {
            return self.straight(state, [0.0; 2], f64::INFINITY);
        }
        let speed = length(state.slip);
        if speed > 0.0 {
            if !self.keeps_its_line(state, 0.0) {
                self.turning(state, speed, &mut course.steps);
            }
            if state.goal != Goal::Done && length(state.slip) > 0.0 && self.keeps_its_line(state, speed) {
                self.slip_on(state);
            }
            if state.goal == Goal::Done || length(state.slip) > 0.0 {
                return;
            }
        }
        let hold = solve(&self.k.tangential, self.k.coupling).map(|x| -x);
        let direction = if length(hold) <= self.mu {
            course.slip = Slip::Stuck;
            hold
        } else {
            course.slip = Slip::Turned;
            self.leaving().map(|x| x * self.mu)
        };
        self.straight(state, direction, f64::INFINITY);
    }

    /// d(s)/dp, with the sign turned: K_tn + K_tt f for the friction f per unit of normal impulse.
    fn braking(&self, friction: [f64; 2]) -> [f64; 2] {
        let push = times(&self.k.tangential, friction);
        [self.k.coupling[0] + push[0], self.k.coupling[1] + push[1]]
    }

    /// True if the slip does not turn, or if what is left of it is so little (of the `first` slip) that its turning no longer
    /// counts.
    fn keeps_its_line(&self, state: &State, first: f64) -> bool {
        /// Rounding of the products in `aside`.
        const STRAIGHT: f64 = 1e-14;
        let speed = length(state.slip);
        let t = state.slip.map(|x| x / speed);
        let brake = self.braking(t.map(|x| x * self.mu));
        let aside = (t[0] * brake[1] - t[1] * brake[0]).abs_();
        let along = dot(t, brake);
        let scale = length(self.k.coupling) + self.mu * (self.k.tangential[0][0] + self.k.tangential[1][1]);
        // The slip's line is off by aside/along, on a path of this length out of the first one's.
        aside <= STRAIGHT * scale || (along > 0.0 && aside * speed <= TOLERANCE * along * first)
    }

    /// Slips along a line until it stops, or to the end.
    fn slip_on(&self, state: &mut State) {
        let speed = length(state.slip);
        let friction = state.slip.map(|x| x / speed * self.mu);
        let along = dot(state.slip, self.braking(friction)) / speed;
        let stop = if along > 0.0 { speed / along } else { f64::INFINITY };
        self.straight(state, friction, stop);
        if state.goal != Goal::Done {
            state.slip = [0.0; 2];
        }
    }

    /// The one direction in which a slip can leave that friction cannot hold: the t with |t| = 1 and
    /// (mu K_tt + l) t = -K_tn for an l > 0, the rate at which it grows. |t| falls with l, from more than 1 at l = 0; 1/|t|
    /// is nearly linear in l, and Newton's method on it (Hebden's) comes from the left without overshooting.
    fn leaving(&self) -> [f64; 2] {
        let mut l = 0.0;
        let mut t = [0.0; 2];
        for _ in 0..60 {
            let m = [0, 1].map(|i| [0, 1].map(|j| self.mu * self.k.tangential[i][j] + if i == j { l } else { 0.0 }));
            t = solve(&m, self.k.coupling).map(|x| -x);
            let size = length(t);
            let slope = dot(t, solve(&m, t)) / size; // -d|t|/dl
            let step = (size - 1.0) * size / slope;
            if !(step > 1e-16 * l) {
                break;
            }
            l += step;
        }
        let size = length(t);
        t.map(|x| x / size)
    }

    /// Goes along a straight segment with constant friction (per unit of normal impulse), past the end of compression if it
    /// lies there, to the end of the impact or over `limit` units of normal impulse.
    fn straight(&self, state: &mut State, friction: [f64; 2], mut limit: f64) {
        let closing = self.k.normal + dot(self.k.coupling, friction); // -d(u_n)/dp
        let brake = self.braking(friction);
        // Compression, and restitution.
        for _ in 0..2 {
            let to_goal = match state.goal {
                Goal::Parting(speed) if closing > 0.0 => (state.approach + speed) / closing,
                Goal::Compressed if closing > 0.0 => state.approach / closing,
                Goal::Restored => restored(state.work, state.approach, closing),
                Goal::Parting(_) | Goal::Compressed => f64::INFINITY,
                Goal::Done => return,
            };
            let reached = to_goal <= limit;
            let p = if reached { to_goal } else { limit };
            if !p.is_finite() {
                return;
            }
            let before = state.approach;
            state.approach -= closing * p;
            state.work += 0.5 * (before + state.approach) * p;
            state.normal += p;
            for i in 0..2 {
                state.slip[i] -= brake[i] * p;
                state.across[i] += friction[i] * p;
            }
            if !reached {
                return;
            }
            self.arrive(state);
            limit -= p;
        }
    }

    fn arrive(&self, state: &mut State) {
        state.goal = match state.goal {
            Goal::Compressed => {
                state.approach = 0.0;
                state.work *= self.e * self.e;
                if state.work > 0.0 { Goal::Restored } else { Goal::Done }
            }
            _ => Goal::Done,
        };
    }

    /// Follows a slip that turns, until it keeps its line, or to the end of the impact.
    fn turning(&self, state: &mut State, first: f64, steps: &mut u32) {
        let scale = self.k.approach / self.k.normal;
        let rate = length(self.k.coupling) + self.mu * (self.k.tangential[0][0] + self.k.tangential[1][1]);
        let mut h = 0.1 / rate;
        while *steps < STEPS && state.goal != Goal::Done && !self.keeps_its_line(state, first) {
            *steps += 1;
            let (next, error) = self.step(state, h);
            // Errors of the impulses count against the impact, that of the slip against the slip: its direction decides.
            let size = error.impulse / (TOLERANCE * (scale + next.normal));
            let astray = error.slip / (1e3 * TOLERANCE * length(next.slip));
            let worst = if size > astray { size } else { astray };
            if !(worst <= 1.0) {
                h *= if worst > 1e5 || worst.is_nan() { 0.1 } else { 0.9 * fifth_root(1.0 / worst) };
                continue;
            }
            if distance(&next) <= 0.0 {
                *state = self.locate(state, h);
                self.arrive(state);
            } else {
                *state = next;
            }
            h *= if worst < 1e-4 { 4.0 } else { 0.9 * fifth_root(1.0 / worst) };
        }
    }

    /// The state within a step of `h` where the goal is reached: the root of a smooth function of the step's length, between
    /// 0 and h (regula falsi of Illinois: each iteration gains digits, and 60 are a bound, not a count).
    fn locate(&self, state: &State, h: f64) -> State {
        let (mut low, mut f_low) = (0.0, distance(state));
        let (mut high, mut at_high) = (h, self.step(state, h).0);
        let mut f_high = distance(&at_high);
        if f_high >= 0.0 {
            return at_high;
        }
        let enough = 1e-15 * f_low;
        let mut last = 0;
        for _ in 0..60 {
            // f_low and f_high are weights, halved where their end stays; what counts is the distance itself.
            let middle = (low * f_high - high * f_low) / (f_high - f_low);
            if !(middle > low && middle < high) {
                break;
            }
            let (there, _) = self.step(state, middle);
            let f = distance(&there);
            if f.abs_() <= enough {
                return there;
            }
            if f > 0.0 {
                (low, f_low) = (middle, f);
                f_high *= if last == 1 { 0.5 } else { 1.0 };
                last = 1;
            } else {
                (high, f_high, at_high) = (middle, f, there);
                f_low *= if last == -1 { 0.5 } else { 1.0 };
                last = -1;
            }
        }
        at_high
    }

    /// One step of Dormand and Prince over theta.
    fn step(&self, state: &State, h: f64) -> (State, Error) {
        let start = [state.slip[0], state.slip[1], state.normal, state.across[0], state.across[1], state.work];
        let mut k = [[0.0; SIZE]; 7];
        for stage in 0..7 {
            let mut y = start;
            for (row, weight) in k[..stage].iter().zip(A[stage]) {
                for (y, row) in y.iter_mut().zip(row) {
                    *y += h * weight * row;
                }
            }
            k[stage] = self.rate(&y);
            if stage == 6 {
                let error: [f64; SIZE] =
                    core::array::from_fn(|i| h * k.iter().zip(E).map(|(row, weight)| weight * row[i]).sum::<f64>());
                let next = State {
                    approach: self.approach(&y),
                    slip: [y[0], y[1]],
                    normal: y[2],
                    across: [y[3], y[4]],
                    work: y[5],
                    goal: state.goal,
                };
                let impulse = Vector([error[2], error[3], error[4], error[5] / self.k.approach]).norm();
                return (next, Error { slip: length([error[0], error[1]]), impulse });
            }
        }
        (*state, Error { slip: f64::INFINITY, impulse: f64::INFINITY })
    }

    fn approach(&self, y: &[f64; SIZE]) -> f64 {
        self.k.approach - self.k.normal * y[2] - dot(self.k.coupling, [y[3], y[4]])
    }

    /// d/dtheta of the slip, of p, of the impulse across and of the work.
    fn rate(&self, y: &[f64; SIZE]) -> [f64; SIZE] {
        let slip = [y[0], y[1]];
        let speed = length(slip);
        let friction = slip.map(|x| x * self.mu);
        let push = times(&self.k.tangential, friction);
        let slowing = [0, 1].map(|i| -(speed * self.k.coupling[i] + push[i]));
        [slowing[0], slowing[1], speed, friction[0], friction[1], speed * self.approach(y)]
    }
}

/// The errors of a step: of the slip (m/s), and of the impulses and the work over the first approach speed (N s).
struct Error {
    slip: f64,
    impulse: f64,
}

/// What is left to the goal; positive before it.
fn distance(state: &State) -> f64 {
    match state.goal {
        Goal::Parting(speed) => state.approach + speed,
        Goal::Compressed => state.approach,
        Goal::Restored => state.work,
        Goal::Done => 0.0,
    }
}

/// The normal impulse after which `work` has been given back: p with closing p^2 / 2 - approach p = work.
fn restored(work: f64, approach: f64, closing: f64) -> f64 {
    let square = approach * approach + 2.0 * closing * work;
    if !(square >= 0.0) {
        return f64::INFINITY; // the bodies close again before
    }
    let root = square.sqrt_();
    if approach > 0.0 {
        if closing > 0.0 { (approach + root) / closing } else { f64::INFINITY }
    } else {
        2.0 * work / (root - approach)
    }
}

/// x^(1/5).
fn fifth_root(x: f64) -> f64 {
    libm::pow(x, 0.2)
}

/// Slip (2), p, impulse across (2), work.
const SIZE: usize = 6;

/// The pair of J. R. Dormand and P. J. Prince, *A family of embedded Runge-Kutta formulae* (1980). The last row is the
/// formula of order 5.
const A: [[f64; 7]; 7] = [
    [0.0; 7],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0],
];

/// Order 5 minus order 4.
const E: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];
