//! Jobs and batches: submission, lists, ends by users.

use api::job::{Job, JobOverview};
use api::service::LabelInUse;
use uuid::Uuid;

use crate::store::operations::operations;
use crate::store::{
    BatchDetail, BatchFilter, BatchOverview, Cancelled, Deleted, Filter, NewBatch, NewJob,
    RequestKey, Retried, StoreError, StoredBatch, StoredJob, Submitted,
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

    /// Returns the jobs that pass a filter, newest first.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn list(&self, filter: &Filter) -> Result<Vec<Job>, StoreError>;

    /// Returns the same in short.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn list_short(&self, filter: &Filter) -> Result<Vec<JobOverview>, StoreError>;

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

    /// Deletes a job that has ended, with its events, results and files.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn delete(&self, id: Uuid) -> Result<Deleted, StoreError>;

    /// Returns a batch with its jobs, without their profiles.
    pub(in crate::store) async fn batch_without_profiles(&self, id: Uuid, detail: BatchDetail) -> Result<Option<StoredBatch>, StoreError>;

    /// Returns batches, newest first.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn batches(&self, filter: BatchFilter) -> Result<Vec<BatchOverview>, StoreError>;

    /// Checks whether a batch exists; with `with_plan`, whether it has an evaluation plan too.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn has_batch(&self, id: Uuid, with_plan: bool) -> Result<bool, StoreError>;

    /// Cancels all jobs of a batch: waiting ones end at once, running ones are ended by their workers.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn cancel_batch(&self, id: Uuid) -> Result<(), StoreError>;

    /// Deletes a batch whose jobs have all ended, with the jobs, their events, results and files.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn delete_batch(&self, id: Uuid) -> Result<Deleted, StoreError>;
}
