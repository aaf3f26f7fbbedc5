//! The store of this process as a job source.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use api::job::Status;
use api::results::Summary;
use api::service::Demand;

use super::{JobSource, JobSourceError};
use crate::metrics::Busy;
use crate::queue::Transition;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::{
    Claim, ClaimRequest, End, IntegrityError, JobUpdate, Lease, LeaseState, Store, StoreError,
};
use crate::worker::computed::Computed;
use crate::worker::manifest::{Documents, make_documents};

impl JobSource for Store {
    const WAITS_FOR_DISK: bool = true;

    async fn claim(&self, request: &ClaimRequest) -> Result<Vec<Claim>, JobSourceError> {
        if self.disk().shortage().is_some() {
            return Ok(Vec::new());
        }
        let claims = Store::claim(self, request).await.inspect_err(|error| {
            // Jobs that wait say so, and the next write has to be a small one.
            self.disk().release_after(error);
        })?;
        for claim in &claims {
            self.metrics().claimed(claim.is_first(), claim.waited_ms);
        }
        Ok(claims)
    }

    async fn job_waiting(&self) {
        Store::job_waiting(self).await;
    }

    async fn renew(&self, lease: Lease, length: Duration) -> Result<LeaseState, JobSourceError> {
        Ok(Store::renew(self, lease, length).await?)
    }

    async fn lease_state(&self, lease: Lease) -> Result<LeaseState, JobSourceError> {
        Ok(Store::lease_state(self, lease).await?)
    }

    async fn checkpoint(&self, lease: Lease) -> Result<Option<EncodedCheckpoint>, JobSourceError> {
        Ok(Store::checkpoint(self, lease).await?)
    }

    async fn record(
        &self,
        lease: Lease,
        update: &JobUpdate,
        length: Duration,
    ) -> Result<LeaseState, JobSourceError> {
        let recorded = Store::record(self, lease, update, length).await;
        Ok(recorded.inspect_err(|error| {
            self.disk().release_after(error);
        })?)
    }

    async fn restart(&self, lease: Lease, number: i64) -> Result<LeaseState, JobSourceError> {
        Ok(Store::restart(self, lease, number).await?)
    }

    async fn finish(
        &self,
        lease: Lease,
        update: &JobUpdate,
        end: &End,
    ) -> Result<Option<Status>, JobSourceError> {
        Ok(finish(self, lease, update, end).await?)
    }

    /// An attempt renews its own lease. Its files stay where they have names there.
    fn abandon(&self, lease: Lease) {
        if self.has_files_as_objects() {
            // There is none if the solve has written no files.
            let _ = fs_err::remove_dir_all(self.attempt_folder(lease));
        }
    }

    fn folder(&self, lease: Lease) -> PathBuf {
        self.attempt_folder(lease)
    }

    fn busy(&self) -> Option<Busy> {
        Some(self.metrics().busy_worker())
    }

    async fn demand(&self) -> Result<Demand, JobSourceError> {
        Ok(Store::demand(self).await?)
    }
}

/// Makes the documents of everything that is stored of a job.
async fn stored_documents(
    store: &Store,
    lease: Lease,
    summary: Option<&Summary>,
) -> Result<Documents, StoreError> {
    let job = store.job(lease.job).await?;
    let spec = job.map(|job| job.document.spec).unwrap_or_default();
    let rows = store.history(lease.job).await?;
    let snapshots = store.snapshots(lease.job).await?;
    let folder = store.attempt_folder(lease);
    let computed = Arc::new(Computed::stored(rows, snapshots));
    make_documents(folder, lease.job, spec, summary, computed).await
}

/// Marks the files of a job that has ended without success and that do not exist.
async fn mark_missing(store: &Store, lease: Lease) -> Result<(), StoreError> {
    let how = IntegrityError::Missing.to_string();
    for name in store.missing_files(lease).await? {
        store.mark_damaged(lease.job, &name, Some(&how)).await?;
    }
    Ok(())
}

/// Ends a job, with documents of all results in the same transaction, or returns it to the queue.
///
/// # Errors
/// [`StoreError`] if the store fails.
async fn finish(
    store: &Store,
    lease: Lease,
    update: &JobUpdate,
    end: &End,
) -> Result<Option<Status>, StoreError> {
    let mut last = JobUpdate {
        number: update.number,
        progress: update.progress.clone(),
        files: update.files.clone(),
        block: update.block.clone(),
        ..JobUpdate::default()
    };
    if end.transition == Transition::Succeed {
        let missing = store.missing_files(lease).await?;
        // For a lost lease or a repeated end, the end below returns its effect.
        if !missing.is_empty() && store.lease_state(lease).await? != LeaseState::Lost {
            return store.solve_again(lease, &last, &missing).await;
        }
    }
    if last.block.is_none() {
        let LeaseState::Held { cancel_requested } = store.lease_state(lease).await? else {
            // The lease was lost, or this end is a repeated one.
            return store.end(lease, update, end).await;
        };
        // A cancelled job must end although nothing more can be stored, so that it can be deleted and its space be freed. Its rows
        // and snapshots are there, the documents of them are not.
        let is_stored = end.transition != Transition::Cancel || !store.disk().is_full();
        if is_stored
            && store
                .is_final(lease, end.transition, cancel_requested)
                .await?
        {
            (last.files, last.block) = stored_documents(store, lease, end.summary.as_ref()).await?;
        }
    }
    let status = store.end(lease, &last, end).await?;
    // The job has ended: an error here would make its worker end it again.
    if status.is_some_and(Status::is_terminal)
        && end.transition != Transition::Succeed
        && let Err(error) = mark_missing(store, lease).await
    {
        tracing::warn!(%error, job = %lease.job, "missing files were not marked");
    }
    if let Err(error) = store.remove_unnamed_files(Some(lease)).await {
        tracing::warn!(%error, job = %lease.job, "files that no manifest names were not removed");
    }
    tracing::info!(
        job = %lease.job,
        lease = lease.number,
        status = status.map(Status::as_str),
        reason = end.reason,
        "attempt ended"
    );
    Ok(status)
}
