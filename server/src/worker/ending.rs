//! How a worker parts with a job: the last batch, the documents, the end; under a lease that is renewed until then.

use std::convert::Infallible;

use api::job::{Progress, Status};
use tokio::time::MissedTickBehavior;

use crate::clock::now_ms;
use crate::queue::Transition;
use crate::store::{Batch, Claim, End, Held, Store, StoreError};
use crate::worker::gather::gather;
use crate::worker::verdict::end;
use crate::worker::{Rules, STORE_PAUSE};

/// Renewals within a lease.
const RENEWALS: u32 = 3;

/// Renews the lease, whatever the solver does. That it is lost is noticed by the next write.
pub(super) async fn beat(store: &Store, claim: &Claim, rules: &Rules) -> Infallible {
    let mut timer = tokio::time::interval(rules.lease / RENEWALS);
    timer.set_missed_tick_behavior(MissedTickBehavior::Delay);
    loop {
        timer.tick().await;
        if let Err(error) = store.renew(claim, rules.lease_end()).await {
            tracing::warn!(%error, "the lease could not be renewed");
        }
    }
}

/// Writes the last batch and parts with the job.
pub(super) async fn conclude(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    batch: &Batch,
    end: &End,
) -> Result<(), StoreError> {
    // A batch's events precede the end, so they are written first, under the same lease.
    match patiently(|| store.record(claim, batch, rules.lease_end())).await? {
        Held::Yes { cancel_requested } => {
            finish(store, claim, &batch.progress, end, cancel_requested).await
        }
        Held::No => Ok(()),
    }
}

/// Ends the job or puts it back into the queue; where it ends, with documents of all that was computed.
async fn finish(
    store: &Store,
    claim: &Claim,
    progress: &Progress,
    end: &End,
    cancel_requested: bool,
) -> Result<(), StoreError> {
    let files = if store.ends(claim, end.step, cancel_requested) {
        patiently(|| gather(store, claim, end.summary.as_ref())).await?
    } else {
        Vec::new()
    };
    // The end and the manifest are one transaction.
    let rest = Batch {
        progress: progress.clone(),
        files,
        ..Batch::default()
    };
    let status = patiently(|| store.end(claim, &rest, end, now_ms())).await?;
    store.sweep_files(Some(claim)).await?;
    tracing::info!(
        status = status.map(Status::as_str),
        reason = end.reason,
        "job concluded"
    );
    Ok(())
}

/// Ends a job whose last worker was lost, under a lease of its own, with documents of what the worker left.
///
/// # Errors
/// [`StoreError`] if the store has a fault that does not pass; the job is taken back again when the lease ends.
pub async fn bury(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    reason: &str,
) -> Result<(), StoreError> {
    let end = end(Transition::Lose, reason);
    let buried = async {
        let job = patiently(|| store.job(claim.id)).await?;
        let progress = job.map(|job| job.document.progress).unwrap_or_default();
        // Whether it is unwanted or has no attempt left, it ends.
        finish(store, claim, &progress, &end, true).await
    };
    tokio::select! {
        buried = buried => buried,
        never = beat(store, claim, rules) => match never {},
    }
}

/// Writes again until the store takes it: a store that stalls or a full disk must not cost a finished solve. The fence
/// keeps a write that comes too late from counting.
pub(super) async fn patiently<T, F: Future<Output = Result<T, StoreError>>>(
    write: impl Fn() -> F,
) -> Result<T, StoreError> {
    loop {
        match write().await {
            Err(error @ (StoreError::Sql(_) | StoreError::Prepare { .. })) => {
                tracing::warn!(%error, "the store did not take a write; trying again");
                tokio::time::sleep(STORE_PAUSE).await;
            }
            answer => return answer,
        }
    }
}
