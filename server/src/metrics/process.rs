//! Figures of this process, under the names that Prometheus gives them
//! (prometheus.io/docs/instrumenting/writing_clientlibs, *Process metrics*).

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{SystemTime, UNIX_EPOCH};

use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::time::TimeVal;
use nix::unistd::{SysconfVar, sysconf};
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::registry::Registry;

/// Figures of the process, read on request.
#[derive(Debug)]
pub(super) struct ProcessMetrics {
    cpu_s: Counter<f64, AtomicU64>,
    memory: Gauge,
    open_files: Gauge,
}

impl ProcessMetrics {
    /// Registers the figures.
    pub(super) fn register(registry: &mut Registry) -> Self {
        let own = Self {
            cpu_s: Counter::default(),
            memory: Gauge::default(),
            open_files: Gauge::default(),
        };
        let started: Gauge<f64, AtomicU64> = Gauge::default();
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        started.set(now.unwrap_or_default().as_secs_f64());
        let cpu = "Processor time of this process, without its solving processes";
        registry.register("process_cpu_seconds", cpu, own.cpu_s.clone());
        let memory = "Resident memory of this process";
        registry.register("process_resident_memory_bytes", memory, own.memory.clone());
        registry.register(
            "process_open_fds",
            "Open files and connections",
            own.open_files.clone(),
        );
        let start = "When this process started, seconds since 1970";
        registry.register("process_start_time_seconds", start, started);
        own
    }

    /// Reads the figures; those that the system does not tell stay as they are.
    pub(super) fn read(&self) {
        if let Ok(usage) = getrusage(UsageWho::RUSAGE_SELF) {
            let cpu_s = seconds(usage.user_time()) + seconds(usage.system_time());
            self.cpu_s.inner().store(cpu_s.to_bits(), Ordering::Relaxed);
        }
        if let Some(bytes) = resident_bytes() {
            self.memory.set(bytes);
        }
        if let Ok(files) = std::fs::read_dir("/proc/self/fd") {
            self.open_files
                .set(i64::try_from(files.count()).unwrap_or(i64::MAX));
        }
    }
}

fn seconds(time: TimeVal) -> f64 {
    #[expect(
        clippy::cast_precision_loss,
        reason = "far below the range where it matters"
    )]
    let of = |part: i64| part as f64;
    of(time.tv_sec()) + 1e-6 * of(time.tv_usec())
}

/// Resident memory: the second number of `/proc/self/statm`, in pages (proc(5)).
fn resident_bytes() -> Option<i64> {
    let statm = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: i64 = statm.split(' ').nth(1)?.parse().ok()?;
    let page = sysconf(SysconfVar::PAGE_SIZE).ok()??;
    pages.checked_mul(page)
}
