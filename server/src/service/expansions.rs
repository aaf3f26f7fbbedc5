//! Queues the jobs of large sweeps ahead of the workers.

use std::num::NonZero;
use std::ops::Range;
use std::sync::Arc;
use std::thread::available_parallelism;
use std::time::Duration;

use futures_util::{StreamExt, stream};
use tokio::task::JoinError;
use tokio_util::sync::CancellationToken;

use crate::batch::{ExpandError, Expandable};
use crate::estimate::machine::CalibrationCache;
use crate::http::check_limits;
use crate::store::{Expansion, Store, StoreError};

/// Pause after a round that has queued nothing.
const PAUSE: Duration = Duration::from_secs(1);
/// Pause after another service has queued the jobs that this one had made, too: it takes over if that one ends. Arbitrary.
const PAUSE_BEHIND: Duration = Duration::from_secs(5);
/// Jobs that a transaction queues; bounds how long other writes wait.
const PORTION: u64 = 128;
/// Jobs of a sweep in a round: its request, which may have a megabyte, is read once for them. Arbitrary.
const ROUND: u64 = 16 * PORTION;

/// Why no jobs could be queued.
#[derive(Debug, thiserror::Error)]
enum QueueError {
    #[error(transparent)]
    Store(#[from] StoreError),
    #[error("its request cannot be read: {0}")]
    Request(#[from] ExpandError),
    #[error("making its jobs: {0}")]
    Task(#[from] JoinError),
}

/// Outcome of a round.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Done {
    /// No sweep needed jobs.
    Nothing,
    /// Another service queues them, or the sweep was just cancelled.
    Behind,
    /// The round has queued jobs.
    Queued,
}

/// Runs until the service stops: keeps so many jobs of each sweep in the queue. Several services may do so on one database; of two that
/// have made the same jobs, one queues them, and the other one pauses.
pub(super) async fn queue_ahead(
    store: Arc<Store>,
    machine: CalibrationCache,
    ahead: u64,
    stopping: CancellationToken,
) {
    let round = async || {
        let pause = match round(&store, &machine, ahead).await {
            Ok(Done::Queued) => return,
            Ok(Done::Behind) => PAUSE_BEHIND,
            Ok(Done::Nothing) => PAUSE,
            Err(error) => {
                tracing::error!(%error, "the sweeps with jobs to be queued could not be read");
                PAUSE
            }
        };
        tokio::time::sleep(pause).await;
    };
    while stopping.run_until_cancelled(round()).await.is_some() {}
}

/// Queues jobs of each sweep of which fewer wait. One that fails holds up no others.
async fn round(store: &Store, machine: &CalibrationCache, ahead: u64) -> Result<Done, StoreError> {
    let mut done = Done::Nothing;
    for sweep in store.expansions().await? {
        if sweep.waiting >= ahead {
            continue;
        }
        let jobs = ROUND.min(ahead - sweep.waiting);
        let end = sweep.jobs.min(sweep.next + jobs);
        match queue(store, machine, &sweep, end).await {
            Ok(queued) => done = done.max(queued),
            Err(error) => {
                tracing::error!(batch = %sweep.batch, %error, "the next jobs of a sweep could not be queued");
            }
        }
    }
    Ok(done)
}

/// Queues the next jobs of a sweep, which are made on all processors meanwhile.
async fn queue(
    store: &Store,
    machine: &CalibrationCache,
    sweep: &Expansion,
    end: u64,
) -> Result<Done, QueueError> {
    let Some(request) = store.expansion_request(sweep.batch).await? else {
        return Ok(Done::Nothing);
    };
    let batch = sweep.batch;
    let expandable = tokio::task::spawn_blocking(move || Expandable::read(batch, &request));
    let expandable = Arc::new(expandable.await??);
    let portions = portions(sweep.next..end).map(|positions| {
        let (expandable, machine) = (Arc::clone(&expandable), machine.get().cloned());
        tokio::task::spawn_blocking(move || {
            expandable.portion(positions, machine.as_ref(), &check_limits)
        })
    });
    let processors = available_parallelism().map_or(1, NonZero::get);
    let mut portions = stream::iter(portions).buffered(processors);
    let mut done = Done::Behind;
    while let Some(portion) = portions.next().await {
        if !store.extend_batch(&portion?).await? {
            break;
        }
        done = Done::Queued;
    }
    Ok(done)
}

/// Divides positions into those of one transaction each.
fn portions(positions: Range<u64>) -> impl Iterator<Item = Range<u64>> {
    let (start, end) = (positions.start, positions.end);
    let count = (end - start).div_ceil(PORTION);
    (0..count).map(move |n| start + n * PORTION..end.min(start + (n + 1) * PORTION))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn portions_are_all_positions_once() {
        for (start, end) in [(0, 1), (5, 5), (7, 135), (7, 136), (0, 3)] {
            let all: Vec<u64> = portions(start..end).flatten().collect();
            assert_eq!(all, (start..end).collect::<Vec<_>>());
        }
        assert!(portions(7..1_000).all(|one| one.end - one.start <= PORTION));
    }
}
