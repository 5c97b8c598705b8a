//! What is remembered while a run is drawn: paths of bodies, and recent impacts.
use crate::cast::Cast;
use crate::snapshot::{Hit, Snapshot, norm};
use carom_scene::Point;
use std::collections::VecDeque;

/// Points kept of all paths together.
const MOST_POINTS: usize = 2_000_000;
/// Impacts shown at a time: of more, the latest.
const MOST_HITS: usize = 400;

/// Paths and recent impacts.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    /// For each body, times (s) and places (m); empty where paths are not kept.
    pub paths: Vec<VecDeque<(f64, Point)>>,
    /// The path of the centre of mass.
    pub centre: VecDeque<(f64, Point)>,
    /// Impacts of the last `flash` seconds.
    pub hits: VecDeque<Hit>,
    /// Every impact's time and place, where paths are kept for good.
    pub marks: Vec<(f64, Point)>,
    /// How long paths are remembered (s); nothing: not at all.
    memory: f64,
    flash: f64,
    points: usize,
}

impl Trace {
    /// Remembers paths for `memory` seconds (0: not at all) and impacts for `flash` seconds.
    pub fn new(memory: f64, flash: f64) -> Self {
        Self { memory, flash, ..Self::default() }
    }

    /// Takes note of an impact: a corner of the paths of both.
    pub fn hit(&mut self, hit: &Hit, cast: &Cast) {
        if self.memory > 0.0 {
            for which in 0..2 {
                if let Some((k, centre)) = hit.centre(which, cast) {
                    self.add(k, hit.time, centre, cast);
                }
            }
            if self.memory.is_infinite() && self.marks.len() < MOST_POINTS {
                self.marks.push((hit.time, hit.point));
            }
        }
        if self.flash > 0.0 && norm(hit.impulse) > 0.0 {
            self.hits.push_back(*hit);
            if self.hits.len() > MOST_HITS {
                self.hits.pop_front();
            }
        }
    }

    /// Takes note of where everything is.
    pub fn look(&mut self, snapshot: &Snapshot, cast: &Cast) {
        let time = snapshot.time;
        while self.hits.front().is_some_and(|hit| hit.time < time - self.flash) {
            self.hits.pop_front();
        }
        if !(self.memory > 0.0) {
            return;
        }
        for k in cast.free() {
            if let Some(moment) = snapshot.moments.get(k) {
                self.add(k, time, moment.position, cast);
            }
        }
        if let Some(centre) = snapshot.centre(cast) {
            self.centre.push_back((time, centre));
        }
        let start = time - self.memory;
        if start > 0.0 {
            for path in self.paths.iter_mut().chain([&mut self.centre]) {
                // The point before the start stays: the path is cut between the two.
                while path.get(1).is_some_and(|p| p.0 <= start) {
                    path.pop_front();
                    self.points = self.points.saturating_sub(1);
                }
            }
        }
    }

    fn add(&mut self, k: usize, time: f64, place: Point, cast: &Cast) {
        if self.paths.is_empty() {
            self.paths = vec![VecDeque::new(); cast.actors.len()];
        }
        if self.points < MOST_POINTS
            && let Some(path) = self.paths.get_mut(k)
            && path.back() != Some(&(time, place))
        {
            path.push_back((time, place));
            self.points += 1;
        }
    }

    /// Where a body was at a time, from its path.
    pub fn at(&self, k: usize, time: f64) -> Option<Point> {
        let path = self.paths.get(k)?;
        let after = path.partition_point(|p| p.0 < time);
        let (b, a) = (path.get(after), after.checked_sub(1).and_then(|a| path.get(a)));
        match (a, b) {
            (Some(a), Some(b)) => {
                let part = if b.0 > a.0 { (time - a.0) / (b.0 - a.0) } else { 1.0 };
                Some(std::array::from_fn(|i| a.1[i] + part * (b.1[i] - a.1[i])))
            }
            (None, Some(b)) => Some(b.1),
            (Some(a), None) => Some(a.1),
            (None, None) => None,
        }
    }
}
