//! Jobs and batches: submission, lists, ends by users.

use api::job::{Job, JobOverview};
use api::service::LabelInUse;
use uuid::Uuid;

use crate::store::operations::operations;
use crate::store::{
    BatchDetail, BatchEnding, BatchFilter, BatchJob, BatchOverview, BatchPart, Cancelled, Deleted,
    Expansion, Filter, ListPlace, Listed, NewBatch, NewJob, Portion, RequestKey, Retried,
    StoreError, StoredBatch, StoredJob, Submitted,
};

operations! {
    /// Queues a job, unless a request with the same key has done so already.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn submit(&self, job: &NewJob, key: Option<&RequestKey>) -> Result<Submitted, StoreError>;

    /// Queues all jobs of a batch or none; returns the earlier batch if a request with the same key and body has queued
    /// one.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn submit_batch(&self, batch: &NewBatch, key: Option<&RequestKey>) -> Result<Submitted, StoreError>;

    /// Returns the batch that an earlier request with the same key queued, if there was one.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn submitted_batch(&self, key: &RequestKey) -> Result<Option<Submitted>, StoreError>;

    /// Returns a job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn job(&self, id: Uuid) -> Result<Option<StoredJob>, StoreError>;

    /// Returns the specification of a job as it was sent, JSON; `None` if there is no such job, or an earlier version has queued it.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn sent_spec(&self, id: Uuid) -> Result<Option<String>, StoreError>;

    /// Returns the jobs that pass a filter, in its order.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn list(&self, filter: &Filter) -> Result<Vec<Listed<Job>>, StoreError>;

    /// Returns the same in short.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn list_short(&self, filter: &Filter) -> Result<Vec<Listed<JobOverview>>, StoreError>;

    /// The present time, by which jobs are dated, ms since 1970.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn present_ms(&self) -> Result<i64, StoreError>;

    /// Counts the jobs that pass a filter, whatever its page.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn count(&self, filter: &Filter) -> Result<u64, StoreError>;

    /// Labels and how many jobs have each: by key, the most frequent values first, at most so many.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn labels(&self, most: u32) -> Result<Vec<LabelInUse>, StoreError>;

    /// Requests the end of a job: a queued one ends at once, a running one is ended by its worker. `None` if there is
    /// no such job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn cancel(&self, id: Uuid) -> Result<Option<Cancelled>, StoreError>;

    /// Queues a failed or cancelled job again: it continues from its last checkpoint, with all its attempts, and with a
    /// deadline as far away as it was at its submission. `None` if there is no such job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn retry(&self, id: Uuid) -> Result<Option<Retried>, StoreError>;

    /// Queues the failed and cancelled jobs again among those of a filter's page. Returns how many, and where the next page begins, if there is
    /// one.
    pub(in crate::store) async fn retry_some(&self, filter: &Filter) -> Result<(u64, Option<ListPlace>), StoreError>;

    /// Deletes a job that has ended, with its events, results and files.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn delete(&self, id: Uuid) -> Result<Deleted, StoreError>;

    /// Returns a batch with some of its jobs, without their profiles.
    pub(in crate::store) async fn batch_without_profiles(&self, id: Uuid, part: BatchPart, detail: BatchDetail) -> Result<Option<StoredBatch>, StoreError>;

    /// Returns some jobs of a batch, without their profiles.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn batch_jobs(&self, id: Uuid, part: BatchPart, detail: BatchDetail) -> Result<Vec<BatchJob>, StoreError>;

    /// Returns batches, newest first.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn batches(&self, filter: BatchFilter) -> Result<Vec<BatchOverview>, StoreError>;

    /// Returns the base specification of a batch as it was sent, JSON; `None` if there is no such batch, or an earlier version has queued it.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn sent_base(&self, batch: Uuid) -> Result<Option<String>, StoreError>;

    /// Checks whether a batch exists; with `with_plan`, whether it has an evaluation plan too.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn has_batch(&self, id: Uuid, with_plan: bool) -> Result<bool, StoreError>;

    /// Returns the batches with jobs that are to be queued, oldest first.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn expansions(&self) -> Result<Vec<Expansion>, StoreError>;

    /// Returns the request that the jobs of a batch are generated from; `None` if none are to be queued.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn expansion_request(&self, batch: Uuid) -> Result<Option<String>, StoreError>;

    /// Queues the next jobs of a batch. Returns whether it did: not if these positions are not the next ones any more, or the batch was
    /// cancelled or deleted.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn extend_batch(&self, portion: &Portion) -> Result<bool, StoreError>;

    /// Lets no more jobs of a batch be queued, and notes that the others are to be cancelled.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn note_cancellation(&self, batch: Uuid) -> Result<(), StoreError>;

    /// Notes that a batch whose jobs have all ended is to be deleted: it is not shown any more.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn note_deletion(&self, batch: Uuid) -> Result<Deleted, StoreError>;

    /// Returns the batches whose jobs are to be cancelled or deleted, oldest first.
    pub(in crate::store) async fn batch_endings(&self) -> Result<Vec<(Uuid, BatchEnding)>, StoreError>;

    /// Notes that all jobs of a batch were cancelled, or that it cannot be deleted.
    pub(in crate::store) async fn forget_ending(&self, batch: Uuid, ending: BatchEnding) -> Result<(), StoreError>;

    /// Cancels jobs of a batch, a limited number; returns whether some may be left.
    pub(in crate::store) async fn cancel_some(&self, batch: Uuid) -> Result<bool, StoreError>;

    /// Deletes jobs of a batch, a limited number, and with the last of them the batch, unless a job was queued again; returns whether some may
    /// be left.
    pub(in crate::store) async fn delete_some(&self, batch: Uuid) -> Result<bool, StoreError>;
}
