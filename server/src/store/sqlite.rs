//! The embedded store: SQLite in WAL mode through one writing connection and a pool of readers.
//!
//! A lock file beside the database, and a row in it, make sure that one process serves it; so at start-up every lease in it belongs to a
//! process that has ended.

pub(in crate::store) mod backup;
mod batch_portions;
mod blocks;
mod checkpoint_objects;
mod claims;
mod dialect;
mod expansions;
mod gauges;
mod identity;
mod insertion;
mod leases;
mod lock;
mod migrations;
mod moved_meanwhile;
mod new_files;
mod objects;
mod open;
mod owner;
mod queries;
mod reclaim;
mod results_to_move;
mod revisions;
mod space;
mod submissions;
mod transitions;
pub(in crate::store) mod verify;

#[path = "sql/statements.rs"]
mod sql;

use std::path::PathBuf;
use std::time::Instant;

use api::job::Status;
use sqlx::sqlite::SqlitePool;
use uuid::Uuid;

use crate::store::process_state::ProcessState;
use crate::store::sqlite::lock::DatabaseLock;
use crate::store::sqlite::submissions::{Submission, Submissions, write};
use crate::store::{NewJob, RequestKey, StoreError, Submitted};
pub use owner::OWNER_HEARTBEAT;

/// A store in a file.
#[derive(Debug)]
pub(in crate::store) struct SqliteStore {
    pub(in crate::store) process: ProcessState,
    writer: SqlitePool,
    readers: SqlitePool,
    path: PathBuf,
    /// Device and number of the file.
    file: (u64, u64),
    /// Id of this process as the owner of the database.
    owner: Uuid,
    wal: PathBuf,
    submissions: Submissions,
    /// When the database was last written by [`SqliteStore::ready`].
    last_probe: tokio::sync::Mutex<Option<Instant>>,
    /// Held as long as the store is open.
    _lock: DatabaseLock,
}

impl SqliteStore {
    pub(in crate::store) async fn submit(
        &self,
        job: &NewJob,
        key: Option<&RequestKey>,
    ) -> Result<Submitted, StoreError> {
        self.process.disk.check()?;
        let submission = Submission {
            job: job.clone(),
            key: key.cloned(),
            now: self.process.clock.now(),
        };
        let write = |group| write(self.writer.clone(), group);
        let submitted = self.submissions.ask(submission, write).await;
        let submitted = submitted.unwrap_or(Err(StoreError::Unwritten))?;
        if let Submitted::Job(id) = submitted {
            self.process.concluded(id, Some(Status::Queued));
        }
        Ok(submitted)
    }
}

#[cfg(test)]
pub(in crate::store) mod tests;
