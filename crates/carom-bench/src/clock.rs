//! CPU time: what other programs take of the machine does not count. Of many threads only the wall tells how long they took.
use std::sync::OnceLock;
use std::time::Instant;

/// The CPU time that this thread has taken so far (s); wall time where the system does not say.
#[cfg(unix)]
pub fn cpu_seconds() -> f64 {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
}

/// The CPU time that this thread has taken so far (s); wall time where the system does not say.
#[cfg(not(unix))]
pub fn cpu_seconds() -> f64 {
    wall_seconds()
}

fn wall_seconds() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

/// The time that so many threads have taken so far (s): CPU time of one, wall time of many.
pub fn seconds(threads: usize) -> f64 {
    if threads > 1 { wall_seconds() } else { cpu_seconds() }
}
