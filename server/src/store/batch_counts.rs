//! Cache of the numbers of jobs by status, for large batches that take long to count.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use uuid::Uuid;

/// Batches with no more jobs are counted again each time, also where a busy machine takes long for it.
const SMALL: u64 = 10_000;
/// A count that takes no longer is made again each time.
const QUICK: Duration = Duration::from_millis(20);
/// Ratio of the time that a count is cached to the time that it took: counting takes a twentieth of a processor at most.
const KEPT_TIMES: u32 = 20;

/// Number of jobs by status.
type Counts = BTreeMap<String, u64>;

/// Cached counts of batches, each with the end of its validity.
#[derive(Debug, Default)]
pub(in crate::store) struct BatchCounts {
    kept: Mutex<HashMap<Uuid, (Instant, Counts)>>,
}

impl BatchCounts {
    /// Returns the cached count of a batch, if it is still valid.
    pub(in crate::store) fn kept(&self, batch: Uuid) -> Option<Counts> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.retain(|_, (until, _)| Instant::now() < *until);
        kept.get(&batch).map(|(_, counts)| counts.clone())
    }

    /// Caches a count that began at a time, if it took long.
    pub(in crate::store) fn keep(&self, batch: Uuid, counts: &Counts, began: Instant) {
        let took = began.elapsed();
        if took > QUICK && counts.values().sum::<u64>() > SMALL {
            let until = Instant::now() + KEPT_TIMES * took;
            let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
            kept.insert(batch, (until, counts.clone()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_slow_counts_of_large_batches_are_kept() {
        let slow = Instant::now()
            .checked_sub(Duration::from_secs(1))
            .expect("the machine has run for a second");
        let of = |jobs| Counts::from([("queued".to_owned(), jobs)]);
        for (jobs, began, is_kept) in [
            (SMALL, slow, false),
            (SMALL + 1, slow, true),
            (SMALL + 1, Instant::now() + QUICK, false),
        ] {
            let (counts, batch) = (BatchCounts::default(), Uuid::now_v7());
            counts.keep(batch, &of(jobs), began);
            assert_eq!(counts.kept(batch).is_some(), is_kept, "{jobs}");
            assert_eq!(counts.kept(Uuid::now_v7()), None);
        }
    }
}
