//! The cost of a run, measured here because the engine reads no clock.

use std::collections::BTreeMap;
use std::time::Instant;

use api::job::Phase;
use api::results::Cost;
use nix::sys::resource::{Usage, UsageWho, getrusage};
use nix::sys::time::TimeVal;

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
        let cpu_at_start = cpu_s();
        Self {
            phases: earlier.phases_s.clone(),
            earlier,
            started: Instant::now(),
            cpu_at_start,
            current: None,
        }
    }

    /// Starts the next phase.
    pub(super) fn enter(&mut self, phase: Phase) {
        self.close();
        self.current = Some((phase, Instant::now()));
    }

    /// Returns the cost so far, without the degrees of freedom, which the engine reports.
    pub(super) fn cost(&mut self) -> Cost {
        if let Some((phase, _)) = self.current {
            self.enter(phase);
        }
        let usage = usage();
        let earlier = &self.earlier;
        let cpu_s = usage
            .as_ref()
            .map_or(0.0, |usage| cpu_seconds(usage) - self.cpu_at_start);
        Cost {
            wall_s: earlier.wall_s + self.started.elapsed().as_secs_f64(),
            cpu_s: earlier.cpu_s + cpu_s,
            phases_s: self.phases.clone(),
            peak_memory_mb: usage
                .as_ref()
                .map_or(0.0, peak_memory_mb)
                .max(earlier.peak_memory_mb),
            dofs: 0,
        }
    }

    fn close(&mut self) {
        if let Some((phase, since)) = self.current.take() {
            *self.phases.entry(phase).or_default() += since.elapsed().as_secs_f64();
        }
    }
}

/// Returns the processor seconds of this process.
pub fn cpu_s() -> f64 {
    usage().map_or(0.0, |usage| cpu_seconds(&usage))
}

/// Returns the processor seconds of this thread.
pub fn thread_cpu_s() -> f64 {
    getrusage(UsageWho::RUSAGE_THREAD).map_or(0.0, |usage| cpu_seconds(&usage))
}

/// Returns the processor seconds of all child processes that were waited for.
pub fn children_cpu_s() -> f64 {
    getrusage(UsageWho::RUSAGE_CHILDREN).map_or(0.0, |usage| cpu_seconds(&usage))
}

fn usage() -> Option<Usage> {
    getrusage(UsageWho::RUSAGE_SELF).ok()
}

fn cpu_seconds(usage: &Usage) -> f64 {
    seconds(usage.user_time()) + seconds(usage.system_time())
}

#[expect(
    clippy::cast_precision_loss,
    reason = "seconds of a process stay far below 2^53"
)]
fn seconds(time: TimeVal) -> f64 {
    time.tv_sec() as f64 + 1e-6 * time.tv_usec() as f64
}

/// Returns the peak resident memory of this program. The kernel preserves `ru_maxrss` through `exec`, so it starts with
/// the memory of the parent process; `VmHWM` belongs to the address space and does not.
fn peak_memory_mb(usage: &Usage) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").ok();
    let own = status.as_deref().and_then(high_water_kib);
    own.unwrap_or_else(|| maxrss_kib(usage)) / 1024.0
}

fn high_water_kib(status: &str) -> Option<f64> {
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok()
}

/// Returns `ru_maxrss`, which the kernel counts in KiB.
#[expect(
    clippy::cast_precision_loss,
    reason = "KiB of a process stay far below 2^53"
)]
fn maxrss_kib(usage: &Usage) -> f64 {
    usage.max_rss() as f64
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
