//! What changes: where everything is at one time, the impacts on the way, and what is known of a whole run.
use crate::cast::Cast;
use carom::{Impact, Party, Rotates, Vector, World};
use carom_scene::Point;

/// A body at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Where its centre is (m).
    pub position: Point,
    /// Velocity (m/s).
    pub velocity: Point,
}

impl Moment {
    /// Its speed (m/s).
    pub fn speed(&self) -> f64 {
        norm(self.velocity)
    }
}

/// The accounts of energy at a time (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Potential energy, zero at the origin.
    pub potential: f64,
    /// What impacts, friction and rest took.
    pub lost: f64,
    /// What driven walls and bodies put in.
    pub work: f64,
}

/// All bodies at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// s
    pub time: f64,
    /// In the order of the plan.
    pub moments: Vec<Moment>,
    /// The accounts.
    pub energy: Energy,
}

impl Snapshot {
    /// The world as it is now.
    pub fn of<const D: usize>(world: &World<D>) -> Self
    where
        Vector<D>: Rotates,
    {
        let nowhere = || Vector::from_fn(|_| f64::NAN);
        let moment = |id| Moment {
            position: padded(world.position(id).unwrap_or_else(|_| nowhere())),
            velocity: padded(world.velocity(id).unwrap_or_else(|_| nowhere())),
        };
        let energy = world.ledger().energy;
        Self {
            time: world.time(),
            moments: world.bodies().map(moment).collect(),
            energy: Energy {
                kinetic: energy.kinetic,
                potential: energy.potential,
                lost: energy.lost,
                work: energy.work,
            },
        }
    }

    /// The centre of mass of what moves (m).
    pub fn centre(&self, cast: &Cast) -> Option<Point> {
        let (mut mass, mut sum) = (0.0, [0.0; 3]);
        for (moment, actor) in self.moments.iter().zip(&cast.actors).filter(|(_, a)| !a.fixed) {
            let m = actor.mass?;
            mass += m;
            for k in 0..3 {
                sum[k] += m * moment.position[k];
            }
        }
        (mass > 0.0).then(|| sum.map(|x| x / mass))
    }
}

/// An impact, as a picture needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// s
    pub time: f64,
    /// Where (m).
    pub point: Point,
    /// Unit vector from the first to the second.
    pub normal: Point,
    /// The whole impulse on the second (N s); its opposite acts on the first.
    pub impulse: Point,
    /// The numbers of the bodies; `None` for a wall.
    pub bodies: [Option<usize>; 2],
}

impl Hit {
    /// An impact.
    pub fn of<const D: usize>(impact: &Impact<D>) -> Self
    where
        Vector<D>: Rotates,
    {
        Self {
            time: impact.time,
            point: padded(impact.point),
            normal: padded(impact.normal),
            impulse: padded(impact.normal * impact.impulse + impact.friction_impulse),
            bodies: impact.parties.map(|party| match party {
                Party::Body(id) => Some(id.index()),
                Party::Wall(_) => None,
            }),
        }
    }

    /// Where the centre of one of the two (0 or 1) is at this instant, and its number.
    pub(crate) fn centre(&self, which: usize, cast: &Cast) -> Option<(usize, Point)> {
        let k = self.bodies[which]?;
        let radius = cast.actors.get(k)?.radius * if which == 0 { -1.0 } else { 1.0 };
        Some((k, std::array::from_fn(|i| self.point[i] + radius * self.normal[i])))
    }
}

fn padded<const D: usize>(x: Vector<D>) -> Point {
    std::array::from_fn(|k| if k < D { x[k] } else { 0.0 })
}

/// The length of a padded vector.
pub(crate) fn norm(v: Point) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

/// What is known of a whole run before it is drawn.
#[derive(Clone, Debug)]
pub struct Survey {
    /// When it ends (s).
    pub end: f64,
    /// When the last impact was (s).
    pub last: Option<f64>,
    /// The least and the largest coordinates of bodies, their radii included (m).
    pub low: Point,
    /// The largest.
    pub high: Point,
    /// The largest speed (m/s).
    pub fastest: f64,
    /// The root mean square of the speeds, on the average of all times (m/s).
    pub brisk: f64,
    /// The largest momentum of a body (N s).
    pub momentum: f64,
    /// The largest kinetic energy of all together (J).
    pub kinetic: f64,
    /// The largest impulse (N s).
    pub hardest: f64,
    /// The lowest potential energy (J).
    pub lowest: f64,
    /// The largest sum of kinetic, potential and lost energy (J), potential energy from zero.
    pub energy: f64,
    /// How many impacts.
    pub hits: u64,
    /// How many snapshots.
    pub seen: u64,
}

impl Default for Survey {
    fn default() -> Self {
        Self {
            end: 0.0,
            last: None,
            low: [f64::INFINITY; 3],
            high: [f64::NEG_INFINITY; 3],
            fastest: 0.0,
            brisk: 0.0,
            momentum: 0.0,
            kinetic: 0.0,
            hardest: 0.0,
            lowest: f64::INFINITY,
            energy: f64::NEG_INFINITY,
            hits: 0,
            seen: 0,
        }
    }
}

impl Survey {
    /// Takes a look at a time.
    pub fn look(&mut self, snapshot: &Snapshot, cast: &Cast) {
        self.end = self.end.max(snapshot.time);
        self.seen += 1;
        let (mut squares, mut free) = (0.0, 0.0);
        for (moment, actor) in snapshot.moments.iter().zip(&cast.actors) {
            for k in 0..3 {
                let reach = if k < cast.dim { actor.radius } else { 0.0 };
                if moment.position[k].is_finite() {
                    self.low[k] = self.low[k].min(moment.position[k] - reach);
                    self.high[k] = self.high[k].max(moment.position[k] + reach);
                }
            }
            let speed = moment.speed();
            if !actor.fixed && speed.is_finite() {
                squares += speed * speed;
                free += 1.0;
                self.fastest = self.fastest.max(speed);
                self.momentum = self.momentum.max(speed * actor.mass.unwrap_or(0.0));
            }
        }
        if free > 0.0 {
            // The mean of what was seen so far.
            self.brisk += ((squares / free).sqrt() - self.brisk) / self.seen as f64;
        }
        let energy = snapshot.energy;
        self.kinetic = self.kinetic.max(energy.kinetic);
        self.lowest = self.lowest.min(energy.potential);
        self.energy = self.energy.max(energy.kinetic + energy.potential + energy.lost);
    }

    /// Takes note of an impact.
    pub fn hit(&mut self, hit: &Hit) {
        self.hits += 1;
        self.last = Some(self.last.unwrap_or(0.0).max(hit.time));
        let impulse = norm(hit.impulse);
        if impulse.is_finite() {
            self.hardest = self.hardest.max(impulse);
        }
    }

    /// The speed at the top of the scale of colours: twice the root mean square, or the fastest if that is less.
    pub fn top_speed(&self) -> f64 {
        let top = (2.0 * self.brisk).min(self.fastest);
        if top > 0.0 { top } else { 1.0 }
    }
}
