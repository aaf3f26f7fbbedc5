//! Gauges, computed from rows of the tables.

use std::time::Duration;

use api::job::Status;
use jiff::Timestamp;

/// Shortest time between two write probes.
pub(in crate::store) const PROBE_INTERVAL: Duration = Duration::from_secs(1);
/// Processor time that is expected of a job without an estimate, ms. Arbitrary.
pub(in crate::store) const UNKNOWN_CPU_MS: i64 = 60_000;

/// Status, number of jobs and creation of the oldest one, ms since 1970.
pub(in crate::store) type StatusRow = (String, i64, Option<i64>);

/// Number of jobs and age of the oldest one, s, by status.
pub(in crate::store) fn by_status(rows: &[StatusRow], now: i64) -> Vec<(Status, i64, i64)> {
    let gauge = |status: Status| {
        let row = rows.iter().find(|(name, ..)| name == status.as_str());
        let (count, oldest) = row.map_or((0, None), |(_, count, oldest)| (*count, *oldest));
        let age = oldest.map_or(0, |oldest| seconds(now, oldest));
        (status, count, age)
    };
    Status::ALL.into_iter().map(gauge).collect()
}

/// Age of a progress, s; 0 without one.
pub(in crate::store) fn progress_age_s(updated_at: Option<String>, now: i64) -> i64 {
    let updated_at = updated_at.and_then(|time| time.parse::<Timestamp>().ok());
    updated_at.map_or(0, |at| seconds(now, at.as_millisecond()))
}

/// Time since another one, s.
pub(in crate::store) fn seconds(now: i64, since: i64) -> i64 {
    now.saturating_sub(since).max(0) / 1_000
}
