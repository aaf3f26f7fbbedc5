//! The clock of the database compared with that of this process. After a step, as that of another server may be after a failover, leases
//! seem to have ended that workers had no time to renew.

use std::time::{Duration, Instant};

/// Difference of two clocks that is a step, ms. They are compared every second, so that other rates make no difference.
const STEP_MS: i64 = 1_000;
/// Time in which every worker renews its leases.
const UNSTEADY: Duration = Duration::from_secs(30);

/// A comparison.
#[derive(Debug)]
pub(super) struct Compared {
    at: Instant,
    /// Time of the database then, ms.
    then: i64,
    /// When the last step was.
    stepped: Option<Instant>,
}

impl Compared {
    /// The comparison at a time, after another one.
    pub(super) fn after(last: Option<&Self>, at: Instant, then: i64) -> Self {
        let mut stepped = last.and_then(|last| last.stepped);
        if let Some(last) = last {
            let elapsed_ms = i64::try_from(at.duration_since(last.at).as_millis());
            let step_ms = then - last.then - elapsed_ms.unwrap_or(i64::MAX);
            if step_ms.abs() > STEP_MS {
                tracing::warn!(
                    step_ms,
                    "the clock of the database was stepped; ended leases are ignored for a while"
                );
                stepped = Some(at);
            }
        }
        Self { at, then, stepped }
    }

    /// Returns `true` if leases that seem to have ended have ended.
    pub(super) fn is_steady(&self) -> bool {
        let since = self.stepped.map(|stepped| self.at.duration_since(stepped));
        since.is_none_or(|since| since >= UNSTEADY)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_found_and_forgotten_once_workers_had_time() {
        let start = Instant::now();
        let at = |s: u64| start + Duration::from_secs(s);
        let first = Compared::after(None, start, 5_000);
        assert!(first.is_steady());
        let second = Compared::after(Some(&first), at(1), 6_100);
        assert!(second.is_steady());
        for step in [-3_600_000, 3_600_000] {
            let stepped = Compared::after(Some(&second), at(2), 7_100 + step);
            assert!(!stepped.is_steady());
            let later = Compared::after(Some(&stepped), at(31), 36_100 + step);
            assert!(!later.is_steady());
            let steady = Compared::after(Some(&later), at(32), 37_100 + step);
            assert!(steady.is_steady());
        }
    }
}
