//! The end of an attempt: the last update, the manifest, the transition; under a lease that is renewed until then.

use std::convert::Infallible;

use api::job::{Progress, Status};
use tokio::time::MissedTickBehavior;

use crate::clock::now_ms;
use crate::queue::Transition;
use crate::store::{Claim, End, JobUpdate, LeaseState, Store, StoreError};
use crate::worker::manifest::build_manifest;
use crate::worker::rules::{RETRY_PAUSE, Rules};

/// Heartbeats within a lease.
const HEARTBEATS: u32 = 3;

/// Renews the lease, independently of the solver. A lost lease is detected by the next write.
pub(super) async fn heartbeat(store: &Store, claim: &Claim, rules: &Rules) -> Infallible {
    let mut timer = tokio::time::interval(rules.lease / HEARTBEATS);
    timer.set_missed_tick_behavior(MissedTickBehavior::Delay);
    loop {
        timer.tick().await;
        if let Err(error) = store.renew(claim, rules.lease_end()).await {
            tracing::warn!(%error, "the lease could not be renewed");
        }
    }
}

/// Writes the last update and ends the attempt.
pub(super) async fn finalize(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    update: &JobUpdate,
    end: &End,
) -> Result<(), StoreError> {
    // The events of the update precede the end, so they are written first, under the same lease.
    match retry(|| store.record(claim, update, rules.lease_end())).await? {
        LeaseState::Held { cancel_requested } => {
            end_attempt(store, claim, &update.progress, end, cancel_requested).await
        }
        LeaseState::Lost => Ok(()),
    }
}

/// Ends the job, with documents of all results, or returns it to the queue.
async fn end_attempt(
    store: &Store,
    claim: &Claim,
    progress: &Progress,
    end: &End,
    cancel_requested: bool,
) -> Result<(), StoreError> {
    let files = if store.is_final(claim, end.transition, cancel_requested) {
        retry(|| build_manifest(store, claim, end.summary.as_ref())).await?
    } else {
        Vec::new()
    };
    // The end and the manifest are one transaction.
    let last = JobUpdate {
        progress: progress.clone(),
        files,
        ..JobUpdate::default()
    };
    let status = retry(|| store.end(claim, &last, end, now_ms())).await?;
    store.remove_unnamed_files(Some(claim)).await?;
    tracing::info!(
        status = status.map(Status::as_str),
        reason = end.reason,
        "attempt ended"
    );
    Ok(())
}

/// Ends a job whose last worker was lost, under a lease of its own, with documents of the lost attempt's results.
///
/// # Errors
/// [`StoreError`] if the store fails permanently; the job is reclaimed again when the lease ends.
pub async fn finalize_lost_job(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    reason: &str,
) -> Result<(), StoreError> {
    let end = End::without_result(Transition::WorkerLost, reason);
    let finalized = async {
        let job = retry(|| store.job(claim.id)).await?;
        let progress = job.map(|job| job.document.progress).unwrap_or_default();
        // Cancelled or without another attempt, the job ends in either case.
        end_attempt(store, claim, &progress, &end, true).await
    };
    tokio::select! {
        finalized = finalized => finalized,
        never = heartbeat(store, claim, rules) => match never {},
    }
}

/// Retries an operation until the store accepts it: a stalled store or a full disk must not cost a finished solve. The
/// fence discards writes that come too late.
pub(super) async fn retry<T, F: Future<Output = Result<T, StoreError>>>(
    operation: impl Fn() -> F,
) -> Result<T, StoreError> {
    loop {
        match operation().await {
            Err(error @ (StoreError::Database { .. } | StoreError::Prepare { .. })) => {
                tracing::warn!(%error, "the store failed; retrying");
                tokio::time::sleep(RETRY_PAUSE).await;
            }
            answer => return answer,
        }
    }
}
