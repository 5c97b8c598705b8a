//! Locked contacts: bodies pinned from opposite sides.
//!
//! A ball between two parallel walls that both touch it cannot both reflect and open: by Gordan's theorem the cone
//! { N^T v >= 0 } has no interior exactly if some impulses lambda >= 0, not all zero, push on nothing, N lambda = 0. The
//! contacts with lambda_i > 0 in such a set are locked: every velocity that closes none of them leaves them all at u = 0.
//! Elastic reflections would go on for ever there. Instead the velocities at entry are first projected onto u = 0 at the
//! locked contacts (as if e = 0: the motion along their normals is lost), and they stay shut while the rest is resolved. That
//! treatment is this project's own.
//!
//! To find them all at once: project q = sum c_i (unit columns) onto { c_i.w >= 0 } over the contacts that may still be
//! locked. The answer w = sum lambda_i c_i has all lambda_i >= 1, and w.w = sum of c_i.w over those that open. So either w
//! vanishes, and all of them are locked, or one opens, and those that do are not locked. Repeat with the others.
use super::{Solver, System};

/// Locked contacts are looked for after so many iterations; at once if two contacts of one body are exactly opposite.
pub const LOOK_AFTER: u32 = 64;
/// Contacts are locked if what is left of sum c_i is no longer than this: walls parallel to about this many radians.
pub const LOCKED: f64 = 1e-6;

/// A contact counts as shut if it opens no faster than this, relative to the scale of the velocities.
const SHUT: f64 = LOCKED;

impl Solver {
    /// True if two contacts push on the same body in exactly opposite directions, with nothing else that moves behind them.
    pub(super) fn opposed(&mut self, system: &System) -> bool {
        // By their first degree of freedom that can move; those of one body come together.
        self.rows.clear();
        self.rows.extend_from_slice(&self.all);
        let first = |i: u32| system.column(i as usize).iter().find(|e| system.movable(e.0) > 0.0).map_or(0, |e| e.0);
        self.rows.sort_unstable_by_key(|&i| (first(i), i));
        let opposite = |i: u32, j: u32| {
            let movable = |i: u32| {
                system.column(i as usize).iter().filter(|e| system.movable(e.0) > 0.0 && e.1 != 0.0).map(|e| (e.0, e.1))
            };
            movable(i).eq(movable(j).map(|e| (e.0, -e.1)))
        };
        for a in 0..self.rows.len() {
            for b in a + 1..self.rows.len() {
                if first(self.rows[a]) != first(self.rows[b]) {
                    break;
                }
                if opposite(self.rows[a], self.rows[b]) {
                    return true;
                }
            }
        }
        false
    }

    /// Finds the locked contacts. If there are any, starts over from the velocities at entry and shuts them. False if that
    /// was the end of it, because there is no room at all.
    pub(super) fn lock(&mut self, system: &mut System) -> bool {
        self.locked.clear();
        // At the nearest velocities that close nothing, what opens is not locked (walls may part), and whether the rest is,
        // their normals tell.
        self.projector.solve(system, &self.all, |_| 0.0, None, self.scale);
        if self.projector.infeasible && self.driven {
            self.start_over(system);
            self.plastic(system);
            return false;
        }
        self.rows.clear();
        for (r, &i) in self.all.iter().enumerate() {
            if !(self.projector.opening_after(system, r, i as usize) > self.scale * SHUT) {
                self.rows.push(i);
            }
        }
        // Each round drops a contact.
        while !self.rows.is_empty() {
            self.projector.solve_sum(system, &self.rows);
            let length = self.projector.length();
            if !(length > LOCKED) {
                break;
            }
            // Their mean is length^2 / rows, so at least one is above half of that.
            let opens = 0.5 * length * length / self.rows.len() as f64;
            let held = self.rows.len();
            let mut r = 0;
            let projector = &self.projector;
            self.rows.retain(|_| {
                r += 1;
                !(projector.slack(r - 1) > opens)
            });
            if self.rows.len() == held {
                return true; // not solved well enough to tell
            }
        }
        if !self.rows.is_empty() {
            self.start_over(system);
            self.locked.extend_from_slice(&self.rows);
            self.outcome.locked = self.locked.len() as u32;
            self.shut(system);
        }
        true
    }

    /// Shuts locked contacts that rounding opened the wrong way (between walls that are nearly parallel, impulses are large);
    /// false if none closes.
    pub(super) fn shut_locked(&mut self, system: &mut System) -> bool {
        let closes = self.locked.iter().any(|&i| self.closes(system, i));
        if closes {
            self.rows.clear();
            self.rows.extend_from_slice(&self.locked);
            self.shut(system);
        }
        closes
    }
}
