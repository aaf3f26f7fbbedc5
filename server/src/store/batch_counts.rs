//! Numbers of jobs of batches that took long to be counted, kept for a while.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use uuid::Uuid;

/// A count that takes no longer is made anew each time.
const QUICK: Duration = Duration::from_millis(20);
/// How many times as long as it took a count is kept: counting takes a twentieth of a processor at most.
const KEPT_TIMES: u32 = 20;

/// Number of jobs by status.
type Counts = BTreeMap<String, u64>;

/// The counts.
#[derive(Debug, Default)]
pub(in crate::store) struct BatchCounts {
    kept: Mutex<HashMap<Uuid, (Instant, Counts)>>,
}

impl BatchCounts {
    /// What was counted a short while ago.
    pub(in crate::store) fn kept(&self, batch: Uuid) -> Option<Counts> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.retain(|_, (until, _)| Instant::now() < *until);
        kept.get(&batch).map(|(_, counts)| counts.clone())
    }

    /// Keeps what was counted since a time, if that took long.
    pub(in crate::store) fn keep(&self, batch: Uuid, counts: &Counts, began: Instant) {
        let took = began.elapsed();
        if took > QUICK {
            let until = Instant::now() + KEPT_TIMES * took;
            let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
            kept.insert(batch, (until, counts.clone()));
        }
    }
}
