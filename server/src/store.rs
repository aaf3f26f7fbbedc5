//! The store: the only place with SQL.
//!
//! One writing connection and a pool of readers on an embedded database in WAL mode. A lock file beside the database
//! makes sure that one process serves it; so at start-up every lease in it belongs to a process that is gone.

mod batches;
mod error;
mod sqlite;

use std::fs::File;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use sqlx::sqlite::SqlitePool;
use tokio::sync::{Notify, broadcast};
use uuid::Uuid;

use crate::metrics::Metrics;

pub use batches::{BatchDetail, BatchFilter, BatchJob, BatchOverview, NewBatch, StoredBatch};
pub use error::StoreError;
pub use sqlite::backup::{BackupError, Copied, backup, restore};
pub use sqlite::checkpoints::NewCheckpoint;
pub use sqlite::conclusion::End;
pub use sqlite::events::StoredEvent;
pub use sqlite::files::{Content, NewFile};
pub use sqlite::jobs::{
    Cancelled, Deleted, Filter, NewJob, RequestKey, StoredJob, SubmitOptions, Submitted,
};
pub use sqlite::leases::{Batch, Claim, Held};
pub use sqlite::rescues::Reclaimed;
pub use sqlite::results::SnapshotPart;

/// How many job ids may wait in a listener's channel before it has to look for itself.
const CHANGES_KEPT: usize = 1024;

/// Jobs, events and results, durable.
#[derive(Debug)]
pub struct Store {
    writer: SqlitePool,
    readers: SqlitePool,
    changes: broadcast::Sender<Uuid>,
    waiting: Notify,
    folder: sqlite::folder::Folder,
    /// The write-ahead log.
    wal: PathBuf,
    /// Figures of the machine.
    machine: PathBuf,
    /// How often a job is tried.
    attempt_limit: u32,
    /// What is counted for `/metrics`.
    metrics: Arc<Metrics>,
    submissions: sqlite::submissions::Submissions,
    /// When a write for the sake of it succeeded.
    proved_ready: tokio::sync::Mutex<Option<Instant>>,
    /// Held as long as the store is open.
    _lock: File,
}

/// The changes of a job.
#[derive(Debug)]
pub struct Changes {
    id: Uuid,
    changed: broadcast::Receiver<Uuid>,
}

impl Changes {
    /// Returns when the job changed, or may have: too many changes of others at once hide one of its own.
    pub async fn next(&mut self) {
        while self.changed.recv().await.is_ok_and(|id| id != self.id) {}
    }
}

impl Store {
    /// The changes of a job from now on.
    pub fn changes(&self, id: Uuid) -> Changes {
        Changes {
            id,
            changed: self.changes.subscribe(),
        }
    }

    /// Returns when a job may be waiting in the queue.
    pub async fn job_waiting(&self) {
        self.waiting.notified().await;
    }

    /// The file beside the database that holds the machine's figures.
    pub fn machine_file(&self) -> PathBuf {
        self.machine.clone()
    }

    /// What is counted for `/metrics`.
    pub fn metrics(&self) -> &Arc<Metrics> {
        &self.metrics
    }

    /// Counts a write that came after its lease.
    fn refused(&self) -> Held {
        self.metrics.stale_writes.inc();
        Held::No
    }

    fn changed(&self, id: Uuid) {
        // Nobody listening is not an error.
        let _ = self.changes.send(id);
    }
}

#[cfg(test)]
pub(crate) mod tests;
