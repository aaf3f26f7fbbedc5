//! Opening the store: lock file, connections, version check, migrations.

use std::os::unix::fs::MetadataExt;
use std::str::FromStr;
use std::time::Duration;

use sqlx::sqlite::{
    SqliteAutoVacuum, SqliteConnectOptions, SqliteJournalMode, SqlitePoolOptions, SqliteSynchronous,
};
use sqlx::{ConnectOptions, Connection};

use crate::clock::Clock;
use crate::store::address::{is_postgres, shown_address};
use crate::store::folder::beside;
use crate::store::migrations::migrator_of;
use crate::store::process_state::ProcessState;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::lock::lock;
use crate::store::sqlite::migrations::FILES;
use crate::store::sqlite::submissions::Submissions;
use crate::store::sqlite::{identity, owner};
use crate::store::{Limits, StoreError};

/// Oldest accepted version: older ones can corrupt the write-ahead log when it is reset.
const OLDEST_SQLITE: (u32, u32, u32) = (3, 51, 3);
const OLDEST_SQLITE_TEXT: &str = "3.51.3";
/// Longest wait for a lock. In WAL mode readers wait for nothing, the writer for a checkpoint at most. Much shorter
/// than a lease, so that a worker can retry a write while it still holds its job.
pub(super) const BUSY_TIMEOUT: Duration = Duration::from_secs(2);
/// Longest wait for a reading connection; shorter than a lease, because workers read too.
const READER_TIMEOUT: Duration = Duration::from_secs(2);
/// Longest wait for the writing connection, which others have before. Arbitrary: some hundred transactions.
const WRITER_TIMEOUT: Duration = Duration::from_secs(5);
/// Number of reading connections.
const READERS: u32 = 4;
/// Page cache of the writing connection, KiB with the sign that SQLite wants: the rows and indexes of the jobs that workers have.
const WRITER_CACHE: &str = "-16384";
/// Size to which the write-ahead log is truncated when it starts again, and above which it is reported while a reader keeps it from that,
/// bytes. Arbitrary: sixteen times what is written between two checkpoints.
pub(super) const LARGEST_WAL: u64 = 64 << 20;

impl SqliteStore {
    /// Opens the database at `url` (`sqlite://PATH`), creates it if it is missing, and migrates its schema.
    pub(in crate::store) async fn open(
        url: &str,
        limits: Limits,
        clock: Clock,
    ) -> Result<Self, StoreError> {
        let options = options(url)?
            .create_if_missing(true)
            .journal_mode(SqliteJournalMode::Wal)
            .synchronous(SqliteSynchronous::Full)
            .foreign_keys(true)
            .busy_timeout(BUSY_TIMEOUT);
        let path = options.get_filename().to_owned();
        let lock = lock(&path)?;
        let process = ProcessState::prepare(&path, None, limits, clock);
        let is_new = identity::schema_version(&path).await?.is_none();
        if is_new {
            // A database has it from its beginning; an older one gets it when it is restored from a backup.
            let created = options.clone().auto_vacuum(SqliteAutoVacuum::Incremental);
            created.connect().await?.close().await?;
        }
        let writer = SqlitePoolOptions::new()
            .max_connections(1)
            .acquire_timeout(WRITER_TIMEOUT)
            // SQLite ends a transaction by itself when the disk is full or fails, and then cannot roll it back; sqlx
            // takes it for an open one and refuses to begin another on that connection. The pool replaces it.
            .before_acquire(|writer, _| Box::pin(async { Ok(!writer.is_in_transaction()) }))
            .connect_with(
                options
                    .clone()
                    .pragma("cache_size", WRITER_CACHE)
                    .pragma("journal_size_limit", LARGEST_WAL.to_string()),
            )
            .await?;
        let version: String = sqlx::query_scalar("SELECT sqlite_version()")
            .fetch_one(&writer)
            .await?;
        check_version(&version)?;
        let last = owner::await_end_of_last(&writer, &path).await?;
        if is_new {
            // A start that is interrupted between two migrations leaves a database of this program.
            identity::mark(&writer).await?;
        }
        migrator_of(&FILES).run(&writer).await?;
        identity::mark(&writer).await?;
        let owner = owner::become_owner(&writer, &path, last.as_ref()).await?;
        // There are no readers yet that it would have to wait for.
        sqlx::query("PRAGMA wal_checkpoint(TRUNCATE)")
            .execute(&writer)
            .await?;
        let readers = SqlitePoolOptions::new()
            .max_connections(READERS)
            .acquire_timeout(READER_TIMEOUT)
            .connect_with(options.read_only(true))
            .await?;
        let file = std::fs::metadata(&path).map_err(|cause| StoreError::Prepare {
            path: path.clone(),
            cause,
        })?;
        let store = Self {
            process,
            file: (file.dev(), file.ino()),
            writer,
            readers,
            owner,
            wal: beside(&path, "-wal"),
            submissions: Submissions::default(),
            path,
            last_probe: tokio::sync::Mutex::default(),
            _lock: lock,
        };
        store.remove_unnamed_files(None).await?;
        Ok(store)
    }

    /// Closes all connections.
    pub(in crate::store) async fn close(&self) {
        self.disown().await;
        self.readers.close().await;
        self.writer.close().await;
    }
}

/// Returns the options to connect to the file at `url`.
pub(super) fn options(url: &str) -> Result<SqliteConnectOptions, StoreError> {
    if is_postgres(url) {
        return Err(StoreError::OnlySqlite);
    }
    // A database in memory would lose every job, and has no folder for a lock file.
    let is_file = |options: &SqliteConnectOptions| {
        let path = options.get_filename().to_string_lossy();
        !path.is_empty() && !path.starts_with("file:sqlx-in-memory")
    };
    // Parameters could select a database in memory or a read-only one.
    let is_plain = url.starts_with("sqlite:") && !url.contains('?');
    let options = SqliteConnectOptions::from_str(url).ok();
    options
        .filter(|options| is_plain && is_file(options))
        .ok_or_else(|| StoreError::Address {
            url: shown_address(url),
        })
}

fn check_version(found: &str) -> Result<(), StoreError> {
    let mut parts = found.split('.').map(|part| part.parse().unwrap_or(0));
    let mut next = || parts.next().unwrap_or(0);
    if (next(), next(), next()) < OLDEST_SQLITE {
        return Err(StoreError::OldSqlite {
            found: found.to_owned(),
            oldest: OLDEST_SQLITE_TEXT,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn old_versions_are_rejected() {
        assert!(check_version("3.51.2").is_err());
        assert!(check_version("3.9.99").is_err());
        assert!(check_version("3.51.3").is_ok());
        assert!(check_version("3.60.0").is_ok());
    }
}
