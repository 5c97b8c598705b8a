//! A progress bar on standard error, on a terminal, for runs that take their time.
use crate::figures::{count, digits};
use carom_scene::model::Until;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::{Duration, Instant};

/// Shorter runs have no bar.
const PATIENCE: Duration = Duration::from_secs(1);
/// The ends of the bar.
const WHOLE: u64 = 1000;

/// The bar, if it is time for one.
pub struct Progress {
    until: Until,
    started: Instant,
    bar: Option<ProgressBar>,
}

impl Progress {
    pub fn new(until: &Until) -> Self {
        Self { until: *until, started: Instant::now(), bar: None }
    }

    /// Shows how far the run has come.
    pub fn show(&mut self, time: f64, impacts: u64) {
        if self.bar.is_none() && self.started.elapsed() < PATIENCE {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::with_draw_target(Some(WHOLE), ProgressDrawTarget::stderr());
            if let Ok(style) = ProgressStyle::with_template("{bar:20} {percent:>3} %  {msg}") {
                bar.set_style(style);
            }
            bar
        });
        let by_time = self.until.time.map(|end| time / end);
        let by_impacts = self.until.impacts.map(|n| impacts as f64 / n as f64);
        let part = by_time.into_iter().chain(by_impacts).fold(0.0, f64::max);
        bar.set_position((part.clamp(0.0, 1.0) * WHOLE as f64) as u64);
        // By the whole run, not by what has passed since there is a bar.
        let left = self.started.elapsed().as_secs_f64() * (1.0 - part) / part;
        let left = if left.is_finite() { format!(", {left:.0} s left") } else { String::new() };
        bar.set_message(format!("t = {} s, {} impacts{left}", digits(time, 4), count(impacts)));
    }

    /// Does something on the terminal that the bar must not be mixed up with.
    pub fn aside<T>(&self, act: impl FnOnce() -> T) -> T {
        match &self.bar {
            Some(bar) => bar.suspend(act),
            None => act(),
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
