//! An attempt at a job: its lease, which is renewed until the end, and its end: the last update, the manifest, the
//! transition.

use api::job::{Progress, Status};
use tokio::time::MissedTickBehavior;

use crate::clock::now_ms;
use crate::queue::Transition;
use crate::store::{Claim, End, JobUpdate, LeaseState, Store, StoreError};
use crate::worker::config::{RETRY_PAUSE, WorkerConfig};
use crate::worker::manifest::build_manifest;

/// Heartbeats within a lease.
const HEARTBEATS: u32 = 3;

/// An attempt at a job under a lease.
#[derive(Debug, Clone, Copy)]
pub(super) struct Attempt<'a> {
    pub(super) store: &'a Store,
    pub(super) claim: &'a Claim,
    pub(super) config: &'a WorkerConfig,
}

impl Attempt<'_> {
    /// Awaits a task while the lease is renewed, independently of the solver. A lost lease is detected by the next
    /// write.
    pub(super) async fn with_heartbeat<T>(&self, task: impl Future<Output = T>) -> T {
        let mut timer = tokio::time::interval(self.config.lease / HEARTBEATS);
        timer.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let heartbeat = async {
            loop {
                timer.tick().await;
                let renewed = self.store.renew(self.claim, self.config.lease_end()).await;
                if let Err(error) = renewed {
                    tracing::warn!(%error, "the lease could not be renewed");
                }
            }
        };
        tokio::select! {
            done = task => done,
            never = heartbeat => never,
        }
    }

    /// Writes the last update and ends the attempt.
    pub(super) async fn finalize(&self, update: &JobUpdate, end: &End) -> Result<(), StoreError> {
        let Self { store, claim, .. } = *self;
        if end.transition == Transition::Cancel && store.disk().is_full() {
            return self.end_without_documents(&update.progress, end).await;
        }
        // The events of the update precede the end, so they are written first, under the same lease.
        let recorded = retry(|| store.record(claim, update, self.config.lease_end())).await?;
        let LeaseState::Held { cancel_requested } = recorded else {
            return Ok(());
        };
        self.end(&update.progress, end, cancel_requested).await
    }

    /// Ends a cancelled job while nothing more can be stored, so that it can be deleted and its space be freed. Its rows and
    /// snapshots are there, the documents of them are not.
    async fn end_without_documents(
        &self,
        progress: &Progress,
        end: &End,
    ) -> Result<(), StoreError> {
        let Self { store, claim, .. } = *self;
        let last = JobUpdate {
            progress: progress.clone(),
            ..JobUpdate::default()
        };
        retry(|| store.end(claim, &last, end, now_ms())).await?;
        store.remove_unnamed_files(Some(claim)).await?;
        tracing::info!(reason = end.reason, "cancelled on a full disk");
        Ok(())
    }

    /// Ends the job, with documents of all results, or returns it to the queue.
    async fn end(
        &self,
        progress: &Progress,
        end: &End,
        cancel_requested: bool,
    ) -> Result<(), StoreError> {
        let Self { store, claim, .. } = *self;
        let is_final = retry(|| store.is_final(claim, end.transition, cancel_requested)).await?;
        let (files, block) = if is_final {
            retry(|| build_manifest(store, claim, end.summary.as_ref())).await?
        } else {
            (Vec::new(), None)
        };
        // The end and the manifest are one transaction.
        let last = JobUpdate {
            progress: progress.clone(),
            files,
            block,
            ..JobUpdate::default()
        };
        let status = retry(|| store.end(claim, &last, end, now_ms())).await?;
        store.remove_unnamed_files(Some(claim)).await?;
        let status = status.map(Status::as_str);
        tracing::info!(status, reason = end.reason, "attempt ended");
        Ok(())
    }
}

/// Ends a job whose last worker was lost, under a lease of its own, with documents of the lost attempt's results.
///
/// # Errors
/// [`StoreError`] if the store fails permanently; the job is reclaimed again when the lease ends.
pub async fn finalize_lost_job(
    store: &Store,
    claim: &Claim,
    config: &WorkerConfig,
    reason: &str,
) -> Result<(), StoreError> {
    let attempt = Attempt {
        store,
        claim,
        config,
    };
    let end = End::without_result(Transition::WorkerLost, reason);
    let finalized = async {
        let job = retry(|| store.job(claim.id)).await?;
        let progress = job.map(|job| job.document.progress).unwrap_or_default();
        // Cancelled or without another attempt, the job ends in either case.
        attempt.end(&progress, &end, true).await
    };
    attempt.with_heartbeat(finalized).await
}

/// Retries an operation until the store accepts it: a stalled store or a full disk must not cost a finished solve. The
/// fence discards writes that come too late.
pub(super) async fn retry<T, F: Future<Output = Result<T, StoreError>>>(
    operation: impl Fn() -> F,
) -> Result<T, StoreError> {
    loop {
        match operation().await {
            Err(
                error @ (StoreError::Database { .. }
                | StoreError::Prepare { .. }
                | StoreError::DiskFull),
            ) => {
                tracing::warn!(%error, "the store failed; retrying");
                tokio::time::sleep(RETRY_PAUSE).await;
            }
            answer => return answer,
        }
    }
}
