//! Growing pauses between tries of something that fails for reasons outside of it.

use std::time::Duration;

/// Pauses that double up to a longest one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Backoff {
    /// Pause after the first failure.
    pub(crate) first: Duration,
    /// Longest pause.
    pub(crate) longest: Duration,
}

impl Backoff {
    /// Pause after so many failures in a row.
    pub(crate) fn pause_after(&self, failures: usize) -> Duration {
        let doublings = u32::try_from(failures.saturating_sub(1)).unwrap_or(u32::MAX);
        let pause = self.first.saturating_mul(2_u32.saturating_pow(doublings));
        pause.min(self.longest)
    }

    /// The same, at random between its half and the whole: processes that fail together do not all try again together.
    pub(crate) fn jittered_pause_after(&self, failures: usize) -> Duration {
        self.pause_after(failures)
            .mul_f64(0.5 + 0.5 * fastrand::f64())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BACKOFF: Backoff = Backoff {
        first: Duration::from_secs(1),
        longest: Duration::from_secs(30),
    };

    #[test]
    fn pauses_double_up_to_a_bound() {
        let pauses = [0, 1, 2, 3, 100].map(|failures| BACKOFF.pause_after(failures).as_secs());
        assert_eq!(pauses, [1, 1, 2, 4, 30]);
    }

    #[test]
    fn jittered_pauses_differ_and_lie_in_the_upper_half() {
        let pauses: Vec<_> = (0..100).map(|_| BACKOFF.jittered_pause_after(2)).collect();
        let (half, whole) = (Duration::from_secs(1), Duration::from_secs(2));
        assert!(pauses.iter().all(|pause| (half..=whole).contains(pause)));
        assert!(pauses.iter().any(|pause| *pause != pauses[0]));
    }
}
