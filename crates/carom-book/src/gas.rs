//! What is counted while a gas of balls runs: rates, pressures, distributions, correlations.
//!
//! The window skips some impacts, so that the gas forgets how it was laid out, and then counts, in units of the scene (see [`Window`]):
//!
//! * `balls`, `count` (impacts), `duration` (s), `rate` (impacts per ball and second: each impact is one of both its balls);
//! * `virial`: the sum of J |x_b - x_a| over impacts of two balls (J s), of which the pressure is made;
//! * `u2`: the mean square of the approach speed; `chi2_u`: chi-squared of the approach speeds against u exp(-u^2/4T)/2T;
//! * from looks at all velocities: `looked` (how many velocities), `mean_speed`, `kurtosis` (<v^4>/<v^2>^2), `chi2_v` (chi-squared of their components
//!   against a normal distribution of the temperature that the kinetic energy says), each over [`BINS`] equally likely bins: 19 degrees of freedom;
//! * with a lag: `vacf`, the correlation of velocities over it, `msd`, the mean square displacement (m^2).
//!
//! All masses are taken to be equal to the first body's.
use carom::{Limits, Party, Rotates, Vector, World};

use crate::case::{Names, Window};
use crate::formula::Misread;

/// Equally likely bins of a chi-squared.
pub const BINS: usize = 20;

/// What was counted.
#[derive(Clone, Debug, Default)]
pub struct Counted {
    balls: f64,
    count: f64,
    duration: f64,
    virial: f64,
    u2: f64,
    looked: f64,
    speed: f64,
    v2: f64,
    v4: f64,
    components: [f64; BINS],
    approaches: [f64; BINS],
    start: f64,
    correlated: [f64; 2],
    moved: f64,
    lags: f64,
}

impl Counted {
    /// What a word means.
    pub fn word(&self, name: &str) -> Option<f64> {
        Some(match name {
            "balls" => self.balls,
            "count" => self.count,
            "duration" => self.duration,
            "rate" => 2.0 * self.count / (self.balls * self.duration),
            "virial" => self.virial,
            "u2" => self.u2 / self.count,
            "looked" => self.looked,
            "mean_speed" => self.speed / self.looked,
            "kurtosis" => self.v4 * self.looked / (self.v2 * self.v2),
            "chi2_v" => chi_squared(&self.components),
            "chi2_u" => chi_squared(&self.approaches),
            "vacf" => self.correlated[1] / self.correlated[0],
            "msd" => self.moved / self.lags,
            _ => return None,
        })
    }
}

/// Sum of (observed - expected)^2 / expected over equally likely bins.
fn chi_squared(bins: &[f64; BINS]) -> f64 {
    let expected = bins.iter().sum::<f64>() / BINS as f64;
    bins.iter().map(|n| (n - expected) * (n - expected) / expected).sum()
}

/// The bin of a quantile in [0, 1].
fn bin(quantile: f64) -> usize {
    ((quantile * BINS as f64) as usize).min(BINS - 1)
}

/// Runs a world through its window.
pub fn watch<const D: usize>(world: &mut World<D>, window: &Window, names: &Names<'_>) -> Result<Counted, Misread>
where
    Vector<D>: Rotates,
{
    let (skip, take) = (names.count(&window.skip)?, names.count(&window.take)?);
    let look = window.look.as_ref().map_or(Ok(take), |n| names.count(n))?.max(1);
    let lag = window.lag.as_ref().map(|t| names.value(t)).transpose()?;
    let ids: Vec<carom::BodyId> = world.bodies().collect();
    let said = |e: carom::Error| Misread(e.to_string());
    let mass = world.mass(*ids.first().ok_or_else(|| Misread("a gas without balls".into()))?).map_err(said)?;
    let mut counted = Counted { balls: ids.len() as f64, ..Counted::default() };
    let limit = |impacts| Limits { impacts: Some(impacts), ..Limits::default() };
    world.keep_reports(false);
    world.run(&limit(skip));
    world.keep_reports(true);
    let first = world.impact_count();
    let last = first + take;
    counted.start = world.time();
    let mut next = first;
    let mut correlating: Option<(f64, Vec<(Vector<D>, Vector<D>)>)> = None;
    while world.impact_count() < last {
        let before = world.impact_count();
        next = (next + look).min(last);
        while world.impact_count() < next {
            let time = correlating.as_ref().map(|c| c.0);
            world.run(&Limits { time, impacts: Some(next), ..Limits::default() });
            count_impacts(world, &mut counted, mass)?;
            if let Some((time, then)) = &correlating
                && world.time() >= *time
            {
                for (id, (x, v)) in ids.iter().zip(then) {
                    counted.correlated[0] += v.norm_squared();
                    counted.correlated[1] += v.dot(world.velocity(*id).map_err(said)?);
                    let way = world.unwrapped_position(*id).map_err(said)? - *x;
                    counted.moved += way.norm_squared();
                    counted.lags += 1.0;
                }
                correlating = None;
            }
        }
        if world.impact_count() == before {
            return Err(Misread("nothing meets any more".into()));
        }
        // kT/m: the centre of mass takes D of the D N freedoms.
        let freedoms = D as f64 * (counted.balls - 1.0);
        let spread = libm::sqrt(2.0 * world.ledger().energy.kinetic / (freedoms * mass));
        let mut records = Vec::with_capacity(ids.len());
        for id in &ids {
            let v = world.velocity(*id).map_err(said)?;
            let square = v.norm_squared();
            counted.looked += 1.0;
            counted.speed += libm::sqrt(square);
            counted.v2 += square;
            counted.v4 += square * square;
            for x in v.0 {
                let quantile = 0.5 * libm::erfc(-x / (spread * std::f64::consts::SQRT_2));
                counted.components[bin(quantile)] += 1.0;
            }
            if lag.is_some() && correlating.is_none() {
                records.push((world.unwrapped_position(*id).map_err(said)?, v));
            }
        }
        if let Some(lag) = lag
            && correlating.is_none()
        {
            correlating = Some((world.time() + lag, records));
        }
    }
    counted.count = (world.impact_count() - first) as f64;
    counted.duration = world.time() - counted.start;
    Ok(counted)
}

fn count_impacts<const D: usize>(world: &World<D>, counted: &mut Counted, mass: f64) -> Result<(), Misread>
where
    Vector<D>: Rotates,
{
    let said = |e: carom::Error| Misread(e.to_string());
    let temperature = 2.0 * world.ledger().energy.kinetic / (D as f64 * (counted.balls - 1.0) * mass);
    for impact in world.impacts() {
        if let [Party::Body(a), Party::Body(b)] = impact.parties {
            counted.virial += impact.impulse * (world.radius(a).map_err(said)? + world.radius(b).map_err(said)?);
            let square = impact.approach * impact.approach;
            counted.u2 += square;
            counted.approaches[bin(-libm::expm1(-square / (4.0 * temperature)))] += 1.0;
        }
    }
    Ok(())
}
