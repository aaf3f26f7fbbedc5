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

/// SQLite's result codes for a database that another process writes, that cannot be written or read at present, or
/// whose disk is full: BUSY, LOCKED, IOERR, FULL (sqlite.org/rescode.html).
const PASSING: [u32; 4] = [5, 6, 10, 13];

impl StoreError {
    /// Whether the same may succeed a little later: the database is busy, or its disk is full.
    pub fn is_passing(&self) -> bool {
        match self {
            Self::Sql(sqlx::Error::PoolTimedOut) | Self::Unwritten => true,
            Self::Sql(sqlx::Error::Database(error)) => error
                .code()
                .and_then(|code| code.parse::<u32>().ok())
                // An extended code has the primary one in its last byte.
                .is_some_and(|code| PASSING.contains(&(code & 0xff))),
            Self::Prepare { cause, .. } => files::is_full(cause),
            _ => false,
        }
    }
}
