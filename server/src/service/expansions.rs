//! Queues the jobs of large sweeps ahead of the workers.

use std::num::NonZero;
use std::ops::Range;
use std::sync::Arc;
use std::thread::available_parallelism;
use std::time::Duration;

use tokio::task::JoinError;
use tokio_util::sync::CancellationToken;

use crate::batch;
use crate::batch::ExpandError;
use crate::estimate::machine::CalibrationCache;
use crate::http::check_limits;
use crate::store::{Expansion, Portion, Store, StoreError};

/// Pause after a round that has queued nothing.
const PAUSE: Duration = Duration::from_secs(1);
/// Jobs that a transaction queues; bounds how long other writes wait.
const PORTION: u64 = 128;

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

/// Runs until the service stops: keeps so many jobs of each sweep in the queue. Several services may do so on one database; of two that
/// have made the same jobs, one queues them, and the other one pauses.
pub(super) async fn queue_ahead(
    store: Arc<Store>,
    machine: CalibrationCache,
    ahead: u64,
    stopping: CancellationToken,
) {
    loop {
        let round = async {
            match round(&store, &machine, ahead).await {
                Ok(true) => {}
                Ok(false) => tokio::time::sleep(PAUSE).await,
                Err(error) => {
                    tracing::error!(%error, "the sweeps with jobs to be queued could not be read");
                    tokio::time::sleep(PAUSE).await;
                }
            }
        };
        tokio::select! {
            () = stopping.cancelled() => return,
            () = round => {}
        }
    }
}

/// Queues a portion of each sweep of which fewer jobs wait; returns whether there was one. One that fails holds up no others.
async fn round(store: &Store, machine: &CalibrationCache, ahead: u64) -> Result<bool, StoreError> {
    let mut has_queued = false;
    for sweep in store.expansions().await? {
        if sweep.waiting >= ahead {
            continue;
        }
        let end = sweep
            .jobs
            .min(sweep.next + PORTION.min(ahead - sweep.waiting));
        match queue_portion(store, machine, &sweep, end).await {
            Ok(is_queued) => has_queued |= is_queued,
            Err(error) => {
                tracing::error!(batch = %sweep.batch, %error, "the next jobs of a sweep could not be queued");
            }
        }
    }
    Ok(has_queued)
}

/// Queues the next jobs of a sweep; returns whether it did: not if another service has queued them, or the sweep was cancelled.
async fn queue_portion(
    store: &Store,
    machine: &CalibrationCache,
    sweep: &Expansion,
    end: u64,
) -> Result<bool, QueueError> {
    let Some(portion) = prepare(store, machine, sweep, end).await? else {
        return Ok(false);
    };
    Ok(store.extend_batch(&portion).await?)
}

/// Makes the next jobs of a sweep, on all processors; `None` if none are to be queued any more.
async fn prepare(
    store: &Store,
    machine: &CalibrationCache,
    sweep: &Expansion,
    end: u64,
) -> Result<Option<Portion>, QueueError> {
    let Some(request) = store.expansion_request(sweep.batch).await? else {
        return Ok(None);
    };
    let request: Arc<str> = request.into();
    let parts = parts(sweep.next..end).map(|positions| {
        let (request, machine, batch) = (Arc::clone(&request), machine.get().cloned(), sweep.batch);
        tokio::task::spawn_blocking(move || {
            batch::portion(batch, &request, positions, machine.as_ref(), &check_limits)
        })
    });
    let mut whole = Portion {
        batch: sweep.batch,
        positions: sweep.next..end,
        jobs: Vec::new(),
        refused: Vec::new(),
    };
    for part in parts.collect::<Vec<_>>() {
        let part = part.await??;
        whole.jobs.extend(part.jobs);
        whole.refused.extend(part.refused);
    }
    Ok(Some(whole))
}

/// Divides positions among the processors.
fn parts(positions: Range<u64>) -> impl Iterator<Item = Range<u64>> {
    let processors = available_parallelism().map_or(1, NonZero::get);
    let parts = u64::try_from(processors).unwrap_or(1);
    let length = (positions.end - positions.start).div_ceil(parts).max(1);
    let starts = (0..parts).map(move |part| positions.start + part * length);
    starts.map(move |start| start.min(positions.end)..(start + length).min(positions.end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_all_positions_once() {
        for (start, end) in [(0, 1), (5, 5), (7, 135), (0, 3)] {
            let all: Vec<u64> = parts(start..end).flatten().collect();
            assert_eq!(all, (start..end).collect::<Vec<_>>());
        }
    }
}
