//! The operations of every storage engine.

mod jobs;
mod leases;
mod results;
mod service;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use api::job::Status;
use uuid::Uuid;

use crate::clock::Clock;
use crate::metrics::Metrics;
use crate::store::address::is_postgres;
use crate::store::postgres::PostgresStore;
use crate::store::process_state::ProcessState;
use crate::store::sqlite::SqliteStore;
use crate::store::{
    AllChanges, BatchDetail, BatchEnding, BatchPart, Changes, DataDisk, Filter, Lease, Limits,
    Order, SnapshotPart, StoreError, StoredBatch,
};

/// Jobs that are queued again in one transaction. Arbitrary: others wait for it.
const RETRIED_AT_ONCE: u32 = 100;

/// Transactions that cancel or delete jobs of a batch in one call: a request waits for the end of a batch of a thousand jobs.
const PORTIONS: usize = 10;

/// Jobs, batches, events and results, durable.
#[derive(Debug)]
pub struct Store(pub(in crate::store) Engine);

/// The engines.
#[derive(Debug)]
pub(in crate::store) enum Engine {
    /// A file.
    Sqlite(Box<SqliteStore>),
    /// A database of a server.
    Postgres(Box<PostgresStore>),
}

/// Delegates an operation of the store to its engine. Futures are boxed, so that a caller's future does not contain both.
macro_rules! operations {
    ($($(#[$doc:meta])* $visibility:vis async fn $name:ident(&self $(, $argument:ident: $type:ty)*) -> $result:ty;)*) => {
        impl $crate::store::Store {
            $($(#[$doc])*
            $visibility async fn $name(&self $(, $argument: $type)*) -> $result {
                match &self.0 {
                    $crate::store::operations::Engine::Sqlite(store) => Box::pin(store.$name($($argument),*)).await,
                    $crate::store::operations::Engine::Postgres(store) => {
                        $crate::store::postgres::answered(Box::pin(store.$name($($argument),*))).await
                    }
                }
            })*
        }
    };
}
use operations;

impl Store {
    /// Opens the database at `url` and migrates its schema: `sqlite://PATH`, which is created if it is missing, or
    /// `postgres://USER@HOST/NAME`, whose large results are in the folder `files`.results; those of a file are beside it.
    ///
    /// # Errors
    /// [`StoreError`], among others if another process serves the file.
    pub async fn open_with(url: &str, files: &Path, limits: Limits) -> Result<Self, StoreError> {
        Self::open_by(url, files, limits, Clock::System).await
    }

    /// Opens the database with a clock by which leases are measured.
    ///
    /// # Errors
    /// [`StoreError`], as [`Store::open_with`].
    pub async fn open_by(
        url: &str,
        files: &Path,
        limits: Limits,
        clock: Clock,
    ) -> Result<Self, StoreError> {
        let engine = if is_postgres(url) {
            let opened = Box::pin(PostgresStore::open(url, files, limits, clock));
            Engine::Postgres(Box::new(opened.await?))
        } else {
            let opened = Box::pin(SqliteStore::open(url, limits, clock));
            Engine::Sqlite(Box::new(opened.await?))
        };
        Ok(Self(engine))
    }

    /// Closes all connections.
    pub async fn close(&self) {
        match &self.0 {
            Engine::Sqlite(store) => store.close().await,
            Engine::Postgres(store) => store.close().await,
        }
    }

    /// Returns a batch with some of its jobs and so much of their results; `None` if there is no batch of that id.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails or a document in it cannot be read.
    pub async fn batch(
        &self,
        id: Uuid,
        part: BatchPart,
        detail: BatchDetail,
    ) -> Result<Option<StoredBatch>, StoreError> {
        let mut batch = self.batch_without_profiles(id, part, detail).await?;
        let jobs = batch.iter_mut().flat_map(|batch| &mut batch.jobs);
        for job in jobs.filter(|job| detail >= BatchDetail::Profiles && job.summary.is_some()) {
            job.profile = self.last_profile(job.id).await?;
        }
        Ok(batch)
    }

    /// Cancels or deletes jobs of a batch for which this was noted, a limited number: queued ones are cancelled at once, running ones are ended by
    /// their workers. Returns whether some may be left.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn end_jobs_of(&self, batch: Uuid, ending: BatchEnding) -> Result<bool, StoreError> {
        for _ in 0..PORTIONS {
            let is_left = match ending {
                BatchEnding::Cancel => self.cancel_some(batch).await?,
                BatchEnding::Delete => self.delete_some(batch).await?,
            };
            if !is_left {
                self.forget_ending(batch, ending).await?;
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Cancels or deletes jobs of each batch for which this was noted, a limited number. Returns whether some may be left.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn end_jobs_of_batches(&self) -> Result<bool, StoreError> {
        let mut is_left = false;
        for (batch, ending) in self.batch_endings().await? {
            is_left |= self.end_jobs_of(batch, ending).await?;
        }
        Ok(is_left)
    }

    /// Queues the failed and cancelled jobs again that pass a filter, each once. If it is interrupted, it can be repeated. Returns how many.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn retry_all(&self, filter: Filter) -> Result<u64, StoreError> {
        let mut page = Filter {
            order: Order::default(),
            after: None,
            limit: RETRIED_AT_ONCE,
            ..filter
        };
        if page.statuses.is_empty() {
            page.statuses = vec![Status::Failed, Status::Cancelled];
        }
        let mut retried = 0;
        loop {
            let (count, next) = self.retry_some(&page).await?;
            retried += count;
            page.after = next;
            if page.after.is_none() {
                return Ok(retried);
            }
        }
    }

    /// Returns the last profile of a job; `None` if it has none, or if its results are damaged, so that the other jobs can be
    /// compared.
    async fn last_profile(&self, id: Uuid) -> Result<Option<String>, StoreError> {
        match self.snapshot(id, SnapshotPart::Profile, None).await {
            Err(error @ StoreError::DamagedResults { .. }) => {
                tracing::error!(%error, "a job is left out of a comparison");
                Ok(None)
            }
            found => found,
        }
    }

    /// Subscribes to the changes of a job.
    pub fn changes(&self, id: Uuid) -> Changes {
        Changes::new(id, self.process().changes.subscribe())
    }

    /// Subscribes to the changes of all jobs.
    pub fn all_changes(&self) -> AllChanges {
        AllChanges::new(self.process().changes.subscribe())
    }

    /// Returns when a job may be waiting in the queue.
    pub async fn job_waiting(&self) {
        self.process().waiting.notified().await;
    }

    /// Returns the folder into which an attempt at a job writes its large results.
    pub fn attempt_folder(&self, lease: impl Into<Lease>) -> PathBuf {
        let lease = lease.into();
        self.process().folder.of_attempt(lease.job, lease.number)
    }

    /// Path of the machine's calibration cache.
    pub fn machine_file(&self) -> PathBuf {
        self.process().machine.clone()
    }

    /// The disk of large results.
    pub fn disk(&self) -> &Arc<DataDisk> {
        &self.process().disk
    }

    /// The clock by which leases are measured.
    pub fn clock(&self) -> &Clock {
        &self.process().clock
    }

    /// Counters and histograms for `/metrics`.
    pub fn metrics(&self) -> &Arc<Metrics> {
        &self.process().metrics
    }

    /// Returns `true` if several processes may serve the database.
    pub fn is_shared(&self) -> bool {
        matches!(self.0, Engine::Postgres(_))
    }

    pub(in crate::store) fn process(&self) -> &ProcessState {
        match &self.0 {
            Engine::Sqlite(store) => &store.process,
            Engine::Postgres(store) => &store.process,
        }
    }

    pub(in crate::store) fn process_mut(&mut self) -> &mut ProcessState {
        match &mut self.0 {
            Engine::Sqlite(store) => &mut store.process,
            Engine::Postgres(store) => &mut store.process,
        }
    }
}
