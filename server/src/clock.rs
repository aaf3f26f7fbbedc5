//! Clocks of the service.

use std::sync::OnceLock;
use std::time::{Instant, SystemTime, UNIX_EPOCH};

/// Returns the milliseconds since 1970-01-01 UTC.
pub fn now_ms() -> i64 {
    let since = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .unwrap_or_default();
    i64::try_from(since.as_millis()).unwrap_or(i64::MAX)
}

/// Returns the milliseconds of a monotonic clock, which starts with the process at [`now_ms`]. Leases, which never
/// outlive a process, are measured by it, so that a correction of the system time expires none.
pub fn monotonic_ms() -> i64 {
    static START: OnceLock<(i64, Instant)> = OnceLock::new();
    let (start, since) = START.get_or_init(|| (now_ms(), Instant::now()));
    start.saturating_add(i64::try_from(since.elapsed().as_millis()).unwrap_or(i64::MAX))
}
