//! Result of a backup or a restore.

use std::path::PathBuf;

use crate::store::StoreError;

/// Why there is no backup, or nothing was restored.
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
    /// The database is damaged.
    #[error("{} is damaged: {found}", .path.display())]
    Damaged {
        /// The database.
        path: PathBuf,
        /// Result of its integrity check.
        found: String,
    },
    /// A file named by a manifest does not exist.
    #[error("the database names {0}, which is not there")]
    Missing(String),
    /// The checksum of a file differs from its manifest.
    #[error("{} has the checksum {found}, the database names {named}", .path.display())]
    Checksum {
        /// The file.
        path: PathBuf,
        /// Its checksum.
        found: String,
        /// The checksum in the manifest.
        named: String,
    },
    /// A manifest names a path outside of the folder of results.
    #[error("the database names `{0}`, which is no place for a file")]
    Place(String),
}

/// What was copied and verified.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CopySummary {
    /// Number of jobs in the database.
    pub jobs: i64,
    /// Number of result files.
    pub files: usize,
    /// Size of the result files, bytes.
    pub file_bytes: u64,
}
