//! Errors of backups, restores and verifications.

use std::path::PathBuf;

use crate::store::{IntegrityError, StoreError};

/// Why there is no backup, or nothing was restored or verified.
#[derive(Debug, thiserror::Error)]
pub enum BackupError {
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A file cannot be read or written.
    #[error("{}: {cause}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The system's error.
        cause: std::io::Error,
    },
    /// The target exists.
    #[error("{} exists; nothing is overwritten", .0.display())]
    Exists(PathBuf),
    /// There is no database.
    #[error("there is no database {}", .0.display())]
    NoDatabase(PathBuf),
    /// The database was written by an earlier version.
    #[error(
        "{} was written by an earlier version: its schema is {found}; a service of this version brings it to {known}", .path.display()
    )]
    Older {
        /// The database.
        path: PathBuf,
        /// Version of its schema.
        found: i64,
        /// Version that this program needs.
        known: i64,
    },
    /// The folder for a backup has files.
    #[error("{} is not empty; a backup needs a folder of its own", .0.display())]
    NotEmpty(PathBuf),
    /// The database is damaged.
    #[error("{} is damaged: {found}", .path.display())]
    Damaged {
        /// The database.
        path: PathBuf,
        /// Result of its integrity check.
        found: String,
    },
    /// A file of a backup differs from its entry, and did not when the backup was made.
    #[error("{place} is damaged: {cause}")]
    Content {
        /// The file, in the folder of results.
        place: String,
        /// The difference.
        cause: IntegrityError,
    },
    /// A manifest names a path outside of the folder of results.
    #[error("the database names `{0}`, which is no place for a file")]
    Place(String),
}
