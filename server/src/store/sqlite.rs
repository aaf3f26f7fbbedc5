//! The embedded store: SQLite in WAL mode through one writing connection and a pool of readers.
//!
//! A lock file beside the database, and a row in it, make sure that one process serves it; so at start-up every lease in it belongs to a
//! process that has ended.

pub(in crate::store) mod backup;
mod batches;
mod blocks;
mod checkpoints;
mod claims;
mod document;
mod errors;
mod events;
mod files;
mod folder;
mod gauges;
mod identity;
mod job_list;
mod job_rows;
mod jobs;
mod leases;
mod maintenance;
mod migrations;
mod moved_meanwhile;
mod objects;
mod open;
mod overview;
mod owner;
mod packed;
mod queries;
mod reclaim;
mod results;
mod results_to_move;
mod revisions;
mod submissions;
mod transitions;
pub(in crate::store) mod verify;
mod worker_tokens;

use std::fs::File;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use api::job::Status;
use sqlx::sqlite::SqlitePool;
use tokio::sync::{Notify, broadcast};
use uuid::Uuid;

use crate::clock::{Clock, Now};
use crate::metrics::Metrics;
use crate::objects::Objects;
use crate::store::{
    AllChanges, Cancelled, Changes, DataDisk, LeaseState, NewJob, RequestKey, StoreError, Submitted,
};
pub use owner::OWNER_HEARTBEAT;

/// Jobs, batches, events and results, durable.
#[derive(Debug)]
pub struct Store {
    writer: SqlitePool,
    readers: SqlitePool,
    changes: broadcast::Sender<Uuid>,
    waiting: Notify,
    folder: folder::Folder,
    /// Where results of succeeded jobs are moved to.
    objects: Option<Objects>,
    path: PathBuf,
    /// Id of this process as the owner of the database.
    owner: Uuid,
    wal: PathBuf,
    machine: PathBuf,
    attempt_limit: u32,
    metrics: Arc<Metrics>,
    submissions: submissions::Submissions,
    disk: Arc<DataDisk>,
    clock: Clock,
    /// When the database was last written by [`Store::ready`].
    last_probe: tokio::sync::Mutex<Option<Instant>>,
    /// Held as long as the store is open.
    _lock: File,
}

impl Store {
    /// Queues a job, unless a request with the same key has done so already. `now` in milliseconds since 1970.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn submit(
        &self,
        job: &NewJob,
        key: Option<&RequestKey>,
        now: impl Into<Now>,
    ) -> Result<Submitted, StoreError> {
        self.disk.check()?;
        let submitted = self.submissions.submit(&self.writer, job, key, now).await?;
        if let Submitted::Job(id) = submitted {
            self.changed(id);
            self.waiting.notify_one();
        }
        Ok(submitted)
    }

    /// Subscribes to the changes of a job.
    pub fn changes(&self, id: Uuid) -> Changes {
        Changes::new(id, self.changes.subscribe())
    }

    /// Subscribes to the changes of all jobs.
    pub fn all_changes(&self) -> AllChanges {
        AllChanges::new(self.changes.subscribe())
    }

    /// Returns when a job may be waiting in the queue.
    pub async fn job_waiting(&self) {
        self.waiting.notified().await;
    }

    /// Path of the machine's calibration cache, beside the database.
    pub fn machine_file(&self) -> PathBuf {
        self.machine.clone()
    }

    /// The disk of the database.
    pub fn disk(&self) -> &Arc<DataDisk> {
        &self.disk
    }

    /// The clock by which leases are measured.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Counters and histograms for `/metrics`.
    pub fn metrics(&self) -> &Arc<Metrics> {
        &self.metrics
    }

    /// Counts a write whose lease was lost.
    fn stale_write(&self) -> LeaseState {
        self.metrics.stale_writes.inc();
        LeaseState::Lost
    }

    /// Notifies the subscribers of a job.
    fn changed(&self, id: Uuid) {
        // Without a subscriber this is not an error.
        let _ = self.changes.send(id);
    }

    /// Notifies subscribers of a committed cancel request, which ends a queued job.
    fn cancelled(&self, id: Uuid, effect: Option<Cancelled>) {
        match effect {
            Some(Cancelled::AtOnce) => self.concluded(id, Some(Status::Cancelled)),
            Some(Cancelled::Requested) => self.changed(id),
            Some(Cancelled::Already) | None => {}
        }
    }

    /// Notifies subscribers and workers of a committed transition, and counts ended jobs.
    fn concluded(&self, id: Uuid, status: Option<Status>) {
        self.changed(id);
        match status {
            Some(Status::Queued) => self.waiting.notify_one(),
            Some(status) if status.is_terminal() => self.metrics.ended(status),
            _ => {}
        }
    }
}

#[cfg(test)]
pub(in crate::store) mod tests;
