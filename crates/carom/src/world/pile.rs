//! Meetings that come again and again: pile-ups, which end in contact, and meetings that come to nothing, which wait.
use super::instant::{Instant, TOUCHING, Touching};
use super::slices::{NO_ISLAND, SLICE, larger};
use super::{WALL, World};
use crate::codec::codec;
use crate::vector::Exact;
use crate::{Rotates, Vector};

/// An impact of a body within this time (s) of an earlier one counts towards a pile-up.
pub const PILE_UP_WINDOW: f64 = 1e-3;
/// So many impacts of one body within [`PILE_UP_WINDOW`] are a pile-up, which ends in contact. Galperin's 314,159 distinct
/// impacts (k = 5) come faster than this and must all be counted.
pub const PILE_UP: u32 = 1_000_000;
/// So many impacts of one body within [`PILE_UP_WINDOW`] are a pile-up where gravity presses and bodies may rest: a ball that
/// hops over a gap takes 2 ms from one impact at the rest speed to the next.
pub const PRESSED_PILE_UP: u32 = 64;
/// So many impacts of one body without the clock moving: its flights no longer advance the time.
pub const SAME_INSTANT: u32 = 64;

/// So many impacts of one body without the clock moving, and no law parts it from the others: the numbers leave it no room.
const STUCK: u32 = 1 << 14;

/// Before this time (s) sixteen steps of the clock are less than [`PILE_UP_WINDOW`].
const LONG_RUN: f64 = 1e11;

/// How often a body was hit of late.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pile {
    start: f64,
    last: f64,
    /// The partner's code of the last impact, and how often it came back without the clock moving.
    partner: u32,
    count: u32,
    same: u32,
}

codec!(Pile { start, last, partner, count, same });

impl Pile {
    /// Counts an impact; true if it is one too many. Where gravity presses, the same pair that meets again without the clock
    /// moving has come to the end of its bounces, and with `rest` on, so has one that meets [`PRESSED_PILE_UP`] times.
    pub fn hit(&mut self, time: f64, partner: u32, pressed: bool, rest: bool, too_low: bool) -> bool {
        if time - self.last > PILE_UP_WINDOW && time < LONG_RUN && !too_low {
            // Long ago, as nearly always in a gas: as below, and quicker.
            *self = Self { start: time, last: time, partner, count: 1, same: 0 };
            return false;
        }
        // Sixteen steps of the clock: a shorter flight is rounding more than flight.
        let at_once = time - self.last <= 16.0 * f64::EPSILON * time;
        // Whoever hops too low for its position to tell is at the end of its bounces, among how many partners it may hop.
        let again = pressed && (too_low || at_once && self.partner == partner) && self.count > 0;
        self.partner = partner;
        if !(time - self.start <= PILE_UP_WINDOW) || self.count == 0 {
            (self.start, self.count) = (time, 0);
        }
        self.count += 1;
        self.same = if self.last == time { self.same + 1 } else { 0 };
        self.last = time;
        again || self.count > PILE_UP || self.same > SAME_INSTANT || pressed && rest && self.count > PRESSED_PILE_UP
    }

    /// True if the instant goes on and on.
    pub fn stands_still(&self) -> bool {
        self.same > SAME_INSTANT
    }

    /// True if it goes on though nothing bounces any more.
    fn is_stuck(&self) -> bool {
        self.same > STUCK
    }
}

/// A meeting that came to nothing: bodies that touch, and that rounding makes meet again at once, are looked at again a little
/// later, and later each time; and those that do not touch yet, when they may have come half the way.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Null {
    partner: u32,
    until: f64,
    /// How often, or [`APART`].
    times: u32,
    /// How fast (m/s) the body may be, or the gap may close, for this to hold: who was hit, or given another velocity, is looked at again.
    speed: f64,
}

/// A pair is looked at later each time, up to so many times, and then as much later each time.
const MOST_TIMES: u32 = 24;
/// What stands for the number of times where the two do not touch.
const APART: u32 = MOST_TIMES + 1;

codec!(Null { partner, until, times, speed });

impl Null {
    /// True if there was none.
    #[inline(always)]
    pub fn is_none(&self) -> bool {
        self.times == 0
    }

    /// True for what [`Null::count`] can have left.
    pub fn is_sound(&self) -> bool {
        self.times <= APART && !self.until.is_nan() && !self.speed.is_nan()
    }

    /// Counts one: the next look is after `step` seconds, twice as long each time.
    fn count(&mut self, partner: u32, time: f64, step: f64, speed: f64) {
        self.speed = speed;
        let again = self.times > 0 && self.times != APART && self.partner == partner;
        self.times = if again { (self.times + 1).min(MOST_TIMES) } else { 1 };
        self.partner = partner;
        // The clock must move.
        let least = time * 4.0 * f64::EPSILON;
        self.until = time + larger(step * f64::from(1u32 << (self.times - 1)), least);
    }
}

impl<const D: usize> World<D>
where
    Vector<D>: Rotates,
{
    /// True if a flight that begins or ends in this contact at `speed` is so low that positions cannot tell it from rest, or that it does not even
    /// leave what the two overlap by: such hops would go on for ever, and sink.
    pub(super) fn too_low(&self, c: &Touching<D>, x: Vector<D>, speed: f64) -> bool {
        let g = (self.party_acceleration(c.a) - self.party_acceleration(c.b)).dot(c.normal);
        let radius =
            |code: u32| if code & WALL == 0 { self.store.bodies.record[code as usize].radius } else { f64::INFINITY };
        let overlap = larger(-c.gap * radius(c.a).min(radius(c.b)), 0.0);
        // Rounding moves a body by a few steps of its position at each hop.
        let resolution = 64.0 * f64::EPSILON * (x.norm() + c.arms[0].norm()) + overlap;
        g > 0.0 && speed > 0.0 && speed * speed < 2.0 * g * resolution
    }

    /// How fast the gap between a body and its partner may close (m/s) until their slices end or others hit them. While two balls move
    /// uniformly, the gap of their tangent planes is no wider than theirs; of a wall, nothing but its velocity is asked.
    pub(super) fn closing(&self, time: f64, i: usize, partner: u32) -> f64 {
        let s = &self.store;
        // How much a slice may change a velocity, whether it is solved for its whole length or for less.
        let thrown = |b: usize| match self.island_of[b] {
            NO_ISLAND => 0.0,
            k => s.bodies.acceleration[b].norm() * self.islands[k as usize].length,
        };
        let (x, v) = s.at(i, time);
        let falls = s.gravity.norm() * SLICE;
        if partner & WALL != 0 {
            let wall = &s.walls[(partner & !WALL) as usize];
            return (v - wall.velocity).norm() + thrown(i) + falls;
        }
        let (y, w) = s.at(partner as usize, time);
        let away = s.nearest_image(y - x);
        larger((v - w).dot(away) / larger(away.norm(), f64::MIN_POSITIVE), 0.0)
            + thrown(i)
            + thrown(partner as usize)
            + falls
    }

    /// The time from which a meeting of body `i` with this partner counts, `time` at the earliest: later if one came to nothing.
    #[inline]
    pub(super) fn counts_from(&self, i: usize, partner: u32, time: f64) -> f64 {
        let null = &self.nulls[i];
        if null.is_none() || null.partner != partner || !(null.until > time) {
            return time;
        }
        let speed = match null.times {
            APART => self.closing(time, i, partner),
            _ => self.store.bodies.record[i].v.norm() + self.wall_speed(partner),
        };
        if speed <= null.speed { null.until } else { time }
    }

    /// Does not look at a pair again before it may have come half the way that is left. `closing` is what [`World::closing`] said before
    /// their slices were cut: the next ones may throw them on as much.
    pub(super) fn wait(&mut self, time: f64, i: usize, partner: u32, closing: f64) {
        let set = &self.instant;
        let Some(c) = set.contacts.iter().find(|c| (c.a, c.b) == set.seed) else { return };
        let radius = |code: u32| {
            if code & WALL == 0 { self.store.bodies.record[code as usize].radius } else { f64::INFINITY }
        };
        let gap = c.gap * radius(c.a).min(radius(c.b));
        let speed = 2.0 * larger(closing, self.closing(time, i, partner));
        let until = time + larger(0.5 * gap / larger(speed, f64::MIN_POSITIVE), 4.0 * f64::EPSILON * time);
        self.any_null = true;
        self.nulls[i] = Null { partner, until, times: APART, speed };
        if partner & WALL == 0 {
            self.nulls[partner as usize] = Null { partner: i as u32, until, times: APART, speed };
        }
    }

    /// Remembers a predicted meeting that exchanged nothing, and forgets it when one did.
    pub(super) fn note_null(&mut self, time: f64, set: &Instant<D>) {
        let Some(c) = set.contacts.iter().find(|c| (c.a, c.b) == set.seed) else { return };
        let radius = self.store.bodies.record[c.a as usize].radius;
        let speed = set.members.iter().map(|m| m.after.norm()).fold(0.0, larger) + self.wall_speed(c.b);
        let fall = (2.0 * TOUCHING * radius * self.store.gravity.norm()).sqrt_();
        // So long that nobody moves further than what counts as touching.
        let step = TOUCHING * radius / larger(speed + fall, f64::MIN_POSITIVE);
        for (code, partner) in [(c.a, c.b), (c.b, c.a)] {
            if code & WALL == 0 {
                let null = &mut self.nulls[code as usize];
                // An instant that goes on and on is as good as nothing, too.
                if c.impulse > 0.0 && self.due[code as usize].pile.same <= SAME_INSTANT {
                    *null = Null::default();
                } else {
                    self.any_null = true;
                    null.count(partner, time, if step < 1.0 { step } else { 1.0 }, 2.0 * (speed + fall));
                }
            }
        }
    }

    /// Counts the instant towards each member's pile-up.
    pub(super) fn pile_up(&mut self, set: &Instant<D>, time: f64) -> bool {
        let mut piled = false;
        let pressed = !self.store.weightless;
        for m in &set.members {
            let partner = match set.seed {
                (a, b) if a == m.body => b,
                (a, b) if b == m.body => a,
                _ => continue,
            };
            let lost_in_rounding =
                pressed && set.contacts.iter().any(|c| (c.a, c.b) == set.seed && self.too_low(c, m.x, c.approach));
            piled |=
                self.due[m.body as usize].pile.hit(time, partner, pressed, self.rest_speed > 0.0, lost_in_rounding);
            self.crushed |= self.due[m.body as usize].pile.is_stuck();
        }
        piled
    }
}
