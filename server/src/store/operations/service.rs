//! Changes of all jobs, gauges, tokens, maintenance.

use std::time::Duration;

use api::service::Demand;
use api::worker::{RemoteWorker, WorkerToken};
use uuid::Uuid;

use crate::metrics::Gauges;
use crate::store::operations::operations;
use crate::store::{Changed, StoreError, WorkerContact};

operations! {
    /// Revision of the last change of any job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn last_revision(&self) -> Result<i64, StoreError>;

    /// Checks whether all changes after a revision are known.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn knows_revision(&self, revision: i64) -> Result<bool, StoreError>;

    /// Jobs that have changed or were deleted after a revision, each once, in the order of their last changes.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn changed_after(&self, revision: i64) -> Result<Vec<(i64, Changed)>, StoreError>;

    /// Returns the demand for workers: waiting and running jobs.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn demand(&self) -> Result<Demand, StoreError>;

    /// Returns the gauges of the store: jobs by status, ages, sizes.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn gauges(&self) -> Result<Gauges, StoreError>;

    /// Checks that the database can be written, by a write; at most once a second, so that frequent requests do not
    /// block the workers' writes.
    ///
    /// # Errors
    /// [`StoreError`] if the database cannot be written.
    pub async fn ready(&self) -> Result<(), StoreError>;

    /// Adds a token by its SHA-256.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn add_worker_token(&self, name: &str, sha256: &[u8; 32]) -> Result<WorkerToken, StoreError>;

    /// Returns all tokens, oldest first.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn worker_tokens(&self) -> Result<Vec<WorkerToken>, StoreError>;

    /// Revokes a token; `false` if there is none of this id. A token stays revoked.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn revoke_worker_token(&self, id: Uuid) -> Result<bool, StoreError>;

    /// The valid token of this SHA-256.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn valid_worker_token(&self, sha256: &[u8; 32]) -> Result<Option<Uuid>, StoreError>;

    /// Notes contacts with remote workers, and forgets those that were in contact with no service for a day.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn note_workers(&self, contacts: &[WorkerContact]) -> Result<(), StoreError>;

    /// Remote workers that were in contact with a service within the last minute, longest known first.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn workers(&self) -> Result<Vec<RemoteWorker>, StoreError>;

    /// Remote workers that take no more jobs.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn draining_workers(&self) -> Result<Vec<Uuid>, StoreError>;

    /// Lets a remote worker take no more jobs; `false` if none of this id was in contact within the last minute.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn drain_worker(&self, id: Uuid) -> Result<bool, StoreError>;

    /// Adds the time since the last call, by which the age of jobs is measured, to the time that services have seen pass: five minutes at most, so
    /// that neither a clock that is wrong nor the time without a service counts.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn count_time(&self) -> Result<(), StoreError>;

    /// Deletes jobs that ended longer ago than this, by the time that services have seen pass, the oldest first and a limited number, and
    /// batches without remaining jobs. Returns the number of jobs.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn delete_older(&self, age: Duration) -> Result<usize, StoreError>;

    /// Counts the free pages of the database as free space, and returns some of them to the file system if the database can.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn give_pages_back(&self) -> Result<(), StoreError>;

    /// Moves the write-ahead log into the database and truncates it, as far as readers allow and without waiting for them.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn checkpoint_wal(&self) -> Result<(), StoreError>;

    /// Writes a heartbeat of this process.
    ///
    /// # Errors
    /// [`StoreError::Served`] if another process has become the owner.
    pub async fn beat(&self) -> Result<(), StoreError>;
}
