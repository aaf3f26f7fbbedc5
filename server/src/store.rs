//! The store: the only place with SQL.
//!
//! One writing connection and a pool of readers on an embedded database in WAL mode. A lock file beside the database
//! makes sure that one process serves it; so at start-up every lease in it belongs to a process that is gone.

mod backup;
mod checkpoints;
mod claims;
mod conclusion;
mod document;
mod error;
mod events;
mod files;
mod folder;
mod jobs;
mod leases;
mod levels;
mod open;
mod queries;
mod rescues;
mod results;
mod studies;
mod submissions;
mod sweep_ends;
mod sweeps;
mod upkeep;

use std::fs::File;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use sqlx::sqlite::SqlitePool;
use tokio::sync::{Notify, broadcast};
use uuid::Uuid;

use crate::metrics::Metrics;

pub use backup::{BackupError, Copied, backup, restore};
pub use checkpoints::NewCheckpoint;
pub use conclusion::End;
pub use error::StoreError;
pub use events::StoredEvent;
pub use files::{Content, NewFile};
pub use jobs::{Cancelled, Deleted, Filter, NewJob, RequestKey, StoredJob, Submitted, Wishes};
pub use leases::{Batch, Claim, Held};
pub use rescues::Rescued;
pub use results::SnapshotPart;
pub use studies::{StoredStudy, StudyPlan};
pub use sweeps::{NewSweep, SweepOutcome};

/// How many job ids may wait in a listener's channel before it has to look for itself.
const CHANGES_KEPT: usize = 1024;

/// Jobs, events and results, durable.
#[derive(Debug)]
pub struct Store {
    writer: SqlitePool,
    readers: SqlitePool,
    changes: broadcast::Sender<Uuid>,
    waiting: Notify,
    folder: folder::Folder,
    /// The write-ahead log.
    wal: PathBuf,
    /// Figures of the machine.
    machine: PathBuf,
    /// How often a job is tried.
    attempt_limit: u32,
    /// What is counted for `/metrics`.
    metrics: Arc<Metrics>,
    submissions: submissions::Submissions,
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
