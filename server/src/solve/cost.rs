//! The cost of a run, measured here because the engine reads no clock.

use std::collections::BTreeMap;
use std::time::Instant;

use api::job::Phase;
use api::results::Cost;
use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::time::TimeVal;

use crate::number::real;

/// Wall-clock time of a run by phase.
#[derive(Debug)]
pub(super) struct Stopwatch {
    earlier: Cost,
    started: Instant,
    cpu_at_start: f64,
    phases: BTreeMap<Phase, f64>,
    current: Option<(Phase, Instant)>,
}

impl Stopwatch {
    /// Starts with the cost of the earlier part of the run.
    pub(super) fn start(earlier: Cost) -> Self {
        Self {
            phases: earlier.phases_s.clone(),
            earlier,
            started: Instant::now(),
            cpu_at_start: cpu_s(),
            current: None,
        }
    }

    /// Starts the next phase.
    pub(super) fn enter(&mut self, phase: Phase) {
        let next = (phase, Instant::now());
        if let Some((phase, since)) = self.current.replace(next) {
            *self.phases.entry(phase).or_default() += since.elapsed().as_secs_f64();
        }
    }

    /// Returns the cost so far, without what the engine counts.
    pub(super) fn cost(&mut self) -> Cost {
        if let Some((phase, _)) = self.current {
            self.enter(phase);
        }
        let earlier = &self.earlier;
        Cost {
            wall_s: earlier.wall_s + self.started.elapsed().as_secs_f64(),
            cpu_s: earlier.cpu_s + cpu_s() - self.cpu_at_start,
            phases_s: self.phases.clone(),
            peak_memory_mb: peak_memory_mb().max(earlier.peak_memory_mb),
            ..Cost::default()
        }
    }
}

/// Returns the processor seconds of this process.
pub fn cpu_s() -> f64 {
    used_s(UsageWho::RUSAGE_SELF)
}

/// Returns the processor seconds of this thread.
pub fn thread_cpu_s() -> f64 {
    used_s(UsageWho::RUSAGE_THREAD)
}

/// Returns the processor seconds of all child processes that were waited for.
pub fn children_cpu_s() -> f64 {
    used_s(UsageWho::RUSAGE_CHILDREN)
}

fn used_s(who: UsageWho) -> f64 {
    let seconds = |time: TimeVal| real(time.tv_sec()) + 1e-6 * real(time.tv_usec());
    getrusage(who).map_or(0.0, |usage| {
        seconds(usage.user_time()) + seconds(usage.system_time())
    })
}

/// Returns the peak resident memory of this program. The kernel preserves `ru_maxrss` through `exec`, so it starts with
/// the memory of the parent process; `VmHWM` belongs to the address space and does not. Both are in KiB.
fn peak_memory_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").ok();
    let own = status.as_deref().and_then(high_water_kib);
    let maxrss = || getrusage(UsageWho::RUSAGE_SELF).map_or(0.0, |usage| real(usage.max_rss()));
    own.unwrap_or_else(maxrss) / 1024.0
}

fn high_water_kib(status: &str) -> Option<f64> {
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_high_water_mark_is_read_from_the_status_of_a_process() {
        let status = "Name:\tfretwear\nVmPeak:\t  104 kB\nVmHWM:\t   74332 kB\nVmRSS:\t 1 kB\n";
        assert_eq!(high_water_kib(status), Some(74_332.0));
        assert_eq!(high_water_kib("Name:\tfretwear\n"), None);
    }
}
