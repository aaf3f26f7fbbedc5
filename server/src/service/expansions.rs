//! Queues the jobs of large sweeps ahead of the workers.

use std::num::NonZero;
use std::ops::Range;
use std::sync::Arc;
use std::thread::available_parallelism;
use std::time::Duration;

use tokio::task::JoinError;
use tokio_util::sync::CancellationToken;
use uuid::Uuid;

use crate::batch;
use crate::batch::ExpandError;
use crate::estimate::machine::CalibrationCache;
use crate::http::check_limits;
use crate::store::{Expansion, Portion, Store, StoreError};

/// Pause after a round.
const PAUSE: Duration = Duration::from_secs(1);
/// Jobs that a transaction queues; bounds how long other writes wait.
const PORTION: u64 = 128;

/// Why no jobs could be queued.
#[derive(Debug, thiserror::Error)]
enum QueueError {
    #[error(transparent)]
    Store(#[from] StoreError),
    #[error("the request of batch {batch} cannot be read: {cause}")]
    Request { batch: Uuid, cause: ExpandError },
    #[error("making its jobs: {0}")]
    Task(#[from] JoinError),
}

/// Runs until the service stops: keeps so many jobs of each sweep in the queue. Several services may do so on one database; of two that
/// have made the same jobs, one queues them.
pub(super) async fn queue_ahead(
    store: Arc<Store>,
    machine: CalibrationCache,
    ahead: u64,
    stopping: CancellationToken,
) {
    loop {
        let round = async {
            if let Err(error) = fill(&store, &machine, ahead).await {
                tracing::error!(%error, "the next jobs of a sweep could not be queued");
            }
            tokio::time::sleep(PAUSE).await;
        };
        tokio::select! {
            () = stopping.cancelled() => return,
            () = round => {}
        }
    }
}

/// Queues jobs until so many of each sweep wait, a portion of each in turn.
async fn fill(store: &Store, machine: &CalibrationCache, ahead: u64) -> Result<(), QueueError> {
    let mut open = store.expansions().await?;
    loop {
        open.retain(|sweep| sweep.next < sweep.jobs && sweep.waiting < ahead);
        if open.is_empty() {
            return Ok(());
        }
        for sweep in &mut open {
            let most = PORTION.min(ahead - sweep.waiting);
            let end = sweep.jobs.min(sweep.next + most);
            let Some(portion) = prepare(store, machine, sweep, end).await? else {
                sweep.next = sweep.jobs;
                continue;
            };
            sweep.waiting += u64::try_from(portion.jobs.len()).unwrap_or(u64::MAX);
            // Otherwise another service queues its jobs, or it was cancelled: the next round will tell.
            let is_queued = store.extend_batch(&portion).await?;
            sweep.next = if is_queued { end } else { sweep.jobs };
        }
    }
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
        let part = part.await?.map_err(|cause| QueueError::Request {
            batch: sweep.batch,
            cause,
        })?;
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
