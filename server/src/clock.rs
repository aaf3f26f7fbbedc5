//! Clocks of the service.
//!
//! Times that users see are those of the system's clock. Times that are compared with each other, of leases, deadlines and
//! places in the queue, are those of a monotonic clock, so that a step of the system's clock ends or delays nothing.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicI64, Ordering};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use nix::time::{ClockId, clock_gettime};

/// Smallest difference of the clocks that is a step, ms: what is smaller comes from reading them one after the other, and from
/// slow corrections.
pub const STEP_MS: i64 = 500;

/// A time by both clocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Now {
    /// By the system's clock, ms since 1970.
    pub system_ms: i64,
    /// By the monotonic clock, which started with the process at the time of the system's, ms since 1970.
    pub monotonic_ms: i64,
}

impl Now {
    /// Reads both clocks.
    pub fn read() -> Self {
        Self {
            system_ms: now_ms(),
            monotonic_ms: monotonic_ms(),
        }
    }

    /// When something of this length ends that begins now, ms of the monotonic clock.
    pub fn end_of(self, length: Duration) -> i64 {
        let length_ms = i64::try_from(length.as_millis()).unwrap_or(i64::MAX);
        self.monotonic_ms.saturating_add(length_ms)
    }

    /// How far the system's clock was stepped since the process started, ms.
    pub fn stepped_ms(self) -> i64 {
        let difference = self.system_ms.saturating_sub(self.monotonic_ms);
        if difference.abs() < STEP_MS {
            0
        } else {
            difference
        }
    }
}

/// A time at which the clocks agree.
impl From<i64> for Now {
    fn from(ms: i64) -> Self {
        Self {
            system_ms: ms,
            monotonic_ms: ms,
        }
    }
}

/// The clock of a store, by which it measures leases.
#[derive(Debug, Default)]
pub enum Clock {
    /// The clock of this process.
    #[default]
    System,
    /// The clock of the database, which this process does not know.
    Database,
    /// A time that a test sets, ms.
    Manual(AtomicI64),
}

impl Clock {
    /// The present time.
    pub fn now(&self) -> Now {
        match self {
            Self::System | Self::Database => Now::read(),
            Self::Manual(ms) => ms.load(Ordering::Relaxed).into(),
        }
    }

    /// When something of this length ends that begins now, ms of the monotonic clock.
    pub fn end_of(&self, length: Duration) -> i64 {
        self.now().end_of(length)
    }

    /// How far the system's clock was stepped since the process started, ms; 0 where times are of another clock.
    pub fn stepped_ms(&self) -> i64 {
        match self {
            Self::System => Now::read().stepped_ms(),
            Self::Database | Self::Manual(_) => 0,
        }
    }
}

/// Returns the milliseconds since 1970-01-01 UTC by the system's clock.
pub fn now_ms() -> i64 {
    let since = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .unwrap_or_default();
    i64::try_from(since.as_millis()).unwrap_or(i64::MAX)
}

/// Returns the milliseconds of the monotonic clock.
pub fn monotonic_ms() -> i64 {
    static START: OnceLock<(i64, Instant)> = OnceLock::new();
    let (start, since) = START.get_or_init(|| (now_ms(), Instant::now()));
    start.saturating_add(i64::try_from(since.elapsed().as_millis()).unwrap_or(i64::MAX))
}

/// Origin of the monotonic clock of this process.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Origin {
    /// The start of the system, by its id.
    pub boot: String,
    /// [`monotonic_ms`] at that start, ms.
    pub offset_ms: i64,
}

impl Origin {
    /// Origin of the clock of this process; `None` where the system does not state it (only Linux does).
    pub fn of_this_process() -> Option<Self> {
        let boot = boot()?;
        let since_boot = clock_gettime(ClockId::CLOCK_MONOTONIC).ok()?;
        let since_boot_ms = i64::try_from(Duration::from(since_boot).as_millis()).ok()?;
        Some(Self {
            boot,
            offset_ms: monotonic_ms().saturating_sub(since_boot_ms),
        })
    }
}

/// The id of this start of the system (random(4)).
pub fn boot() -> Option<String> {
    let id = std::fs::read_to_string("/proc/sys/kernel/random/boot_id").ok()?;
    Some(id.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_differences_are_no_steps() {
        let now = |system_ms| Now {
            system_ms,
            monotonic_ms: 1_000,
        };
        assert_eq!(now(1_499).stepped_ms(), 0);
        assert_eq!(now(3_601_000).stepped_ms(), 3_600_000);
        assert_eq!(now(-3_599_000).stepped_ms(), -3_600_000);
        assert_eq!(Now::read().stepped_ms(), 0);
        assert_eq!(Now::from(7).stepped_ms(), 0);
    }

    #[test]
    fn the_origin_stays() {
        let first = Origin::of_this_process().expect("Linux tells");
        std::thread::sleep(Duration::from_millis(20));
        let second = Origin::of_this_process().expect("Linux tells");
        assert_eq!(first.boot, second.boot);
        // Each clock is rounded down.
        assert!(first.offset_ms.abs_diff(second.offset_ms) <= 1);
    }
}
