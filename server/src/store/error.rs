//! What can go wrong in the store.

use std::path::PathBuf;

use uuid::Uuid;

use crate::export::files;

/// Why the store could not do what was asked.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The address of the database cannot be read.
    #[error("`{url}` is not the address of a database such as sqlite://fretwear.db")]
    Address {
        /// The address.
        url: String,
    },
    /// The database's folder or lock file cannot be made.
    #[error("cannot prepare {}: {cause}", .path.display())]
    Prepare {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// Another process serves this database.
    #[error("another process serves this database (it holds {})", .path.display())]
    Locked {
        /// The lock file.
        path: PathBuf,
    },
    /// The linked SQLite is too old.
    #[error(
        "the linked SQLite is {found}, at least {wanted} is needed: older ones can corrupt the log when it is reset"
    )]
    OldSqlite {
        /// Its version.
        found: String,
        /// The oldest that is accepted.
        wanted: &'static str,
    },
    /// The schema cannot be brought up to date.
    #[error("migrating the database: {0}")]
    Migrate(#[from] sqlx::migrate::MigrateError),
    /// The database refused a statement.
    #[error("database: {0}")]
    Sql(#[from] sqlx::Error),
    /// A stored document cannot be read.
    #[error("job {id}: stored {what} cannot be read: {cause}")]
    Corrupt {
        /// The job.
        id: Uuid,
        /// Which part.
        what: &'static str,
        /// Why.
        cause: String,
    },
    /// A submission was broken off before it was written.
    #[error("the submission was broken off before it was written")]
    Unwritten,
    /// A document cannot be written.
    #[error("writing a document: {0}")]
    Write(#[from] serde_json::Error),
}

/// SQLite's result codes for a database that another process writes or that cannot be written or read at present: BUSY,
/// LOCKED, IOERR (sqlite.org/rescode.html).
const PASSING: [u32; 3] = [5, 6, 10];
/// SQLite's result code for a full disk: FULL.
const DISK_FULL: u32 = 13;

impl StoreError {
    /// Whether the same may succeed a little later: the database is busy, or its disk is full.
    pub fn is_passing(&self) -> bool {
        matches!(self, Self::Sql(sqlx::Error::PoolTimedOut) | Self::Unwritten)
            || self
                .sqlite_code()
                .is_some_and(|code| PASSING.contains(&code))
            || self.is_disk_full()
    }

    /// Whether the disk of the database is full.
    pub fn is_disk_full(&self) -> bool {
        match self {
            Self::Prepare { cause, .. } => files::is_full(cause),
            _ => self.sqlite_code() == Some(DISK_FULL),
        }
    }

    /// SQLite's primary result code; an extended code has it in its last byte.
    fn sqlite_code(&self) -> Option<u32> {
        let Self::Sql(sqlx::Error::Database(error)) = self else {
            return None;
        };
        let code: u32 = error.code()?.parse().ok()?;
        Some(code & 0xff)
    }
}
