//! Errors of the store.

use std::error::Error;
use std::path::PathBuf;

use uuid::Uuid;

use crate::export::files;
use crate::objects::ObjectsError;
use crate::store::IntegrityError;

/// Why an operation of the store failed.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The database address is invalid.
    #[error(
        "`{url}` is not the address of a database such as sqlite://fretwear.db or postgres://USER@HOST/NAME"
    )]
    Address {
        /// The address.
        url: String,
    },
    /// A file or folder of the store cannot be created or written.
    #[error("cannot prepare {}: {cause}", .path.display())]
    Prepare {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        cause: std::io::Error,
    },
    /// The folder of the database does not exist.
    #[error("the folder {} does not exist", .path.display())]
    NoFolder {
        /// The folder.
        path: PathBuf,
    },
    /// The file of the database has several names.
    #[error("{} has {names} names (hard links), each of which would have a log of its own", .path.display())]
    Linked {
        /// The file.
        path: PathBuf,
        /// Number of its names.
        names: u64,
    },
    /// The file belongs to another program.
    #[error("{} is not a database of fretwear: {found}", .path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// The evidence, such as its application id.
        found: String,
    },
    /// The database was written by a later version.
    #[error(
        "{} was written by a later version of fretwear: its schema is {found}, this version knows {known}", .path.display()
    )]
    Newer {
        /// The database.
        path: PathBuf,
        /// Version of its schema.
        found: i64,
        /// Newest version that this program knows.
        known: i64,
    },
    /// Another process serves this database past its lock file.
    #[error(
        "another process serves {} (it writes heartbeats into it; {process})", .path.display()
    )]
    Served {
        /// The database.
        path: PathBuf,
        /// The process: start of its system, namespace, number and start.
        process: String,
    },
    /// Another process holds the lock file of this database.
    #[error("another process serves this database (it holds {})", .path.display())]
    Locked {
        /// The lock file.
        path: PathBuf,
    },
    /// The linked SQLite is too old.
    #[error(
        "the linked SQLite is {found}, at least {oldest} is needed: older ones can corrupt the log when it is reset"
    )]
    OldSqlite {
        /// Version.
        found: String,
        /// The oldest accepted version.
        oldest: &'static str,
    },
    /// The address of a PostgreSQL server is invalid. It is not shown: it may have a password.
    #[error("the address of the PostgreSQL database is invalid: {cause}")]
    Server {
        /// Fault of the address.
        cause: String,
    },
    /// A PostgreSQL server beyond this machine whose name would not be verified.
    #[error(
        "{host} is not this machine: add ?sslmode=verify-full (and sslrootcert=FILE) to the address of the database"
    )]
    Unverified {
        /// Name of the server.
        host: String,
    },
    /// The PostgreSQL server is too old.
    #[error("the PostgreSQL server has version {found}, at least {oldest} is needed")]
    OldServer {
        /// Version.
        found: i64,
        /// The oldest accepted version.
        oldest: i64,
    },
    /// The operation is for SQLite databases only.
    #[error("this is for SQLite databases; of a PostgreSQL database, use pg_dump and pg_restore")]
    OnlySqlite,
    /// A schema migration failed.
    #[error("migrating the database: {0}")]
    Migrate(#[source] Box<dyn Error + Send + Sync>),
    /// A statement or a connection failed.
    #[error("database: {cause}")]
    Database {
        /// The engine's error.
        #[source]
        cause: Box<dyn Error + Send + Sync>,
        /// True if a retry may succeed.
        is_transient: bool,
        /// True if the disk of the database is full.
        is_disk_full: bool,
    },
    /// The file of the database is not at its path any more: whatever is written is lost with the process.
    #[error(
        "the file of the database was removed or replaced; nothing is accepted until the service is started again"
    )]
    Removed,
    /// The disk was full and still is: the space that was reserved on it is for writes that free some.
    #[error("no space left on the data disk")]
    DiskFull,
    /// A stored document cannot be read.
    #[error("job {id}: stored {what} cannot be read: {cause}")]
    Corrupt {
        /// The job.
        id: Uuid,
        /// Name of the document.
        what: &'static str,
        /// The parser's error.
        cause: String,
    },
    /// Results of a job are damaged.
    #[error("results of job {id} are damaged: {cause}")]
    DamagedResults {
        /// The job.
        id: Uuid,
        /// The damage.
        cause: String,
    },
    /// The store of objects failed.
    #[error(transparent)]
    Objects(#[from] ObjectsError),
    /// Results are in a store of objects, and none was given.
    #[error("results of this database are in a store of objects, and none was given (--objects)")]
    NoObjects,
    /// Results are in another store of objects.
    #[error("results of this database are in {stored}, not in {given}")]
    OtherObjects {
        /// Address of the one that they are in.
        stored: String,
        /// Address of the one that was given.
        given: String,
    },
    /// A file that an update names is not where it was sent to.
    #[error("the file {0} is no longer there; it has to be sent again")]
    LostFile(String),
    /// A file that an update names is not in the folder of its attempt.
    #[error("the file {name} of the attempt: {cause}")]
    NoFile {
        /// The file.
        name: String,
        /// Cause of the refusal.
        cause: IntegrityError,
    },
    /// The database has not answered in time.
    #[error("the database has not answered within {0:?}")]
    NoAnswer(std::time::Duration),
    /// A request was interrupted before it was written.
    #[error("the request was interrupted before it was written")]
    Unwritten,
    /// A document cannot be serialized.
    #[error("writing a document: {0}")]
    Write(#[from] serde_json::Error),
}

impl StoreError {
    /// Returns `true` if a retry may succeed: the database is busy, or its disk is full.
    pub fn is_transient(&self) -> bool {
        match self {
            Self::Unwritten | Self::NoAnswer(_) => true,
            Self::Database { is_transient, .. } => *is_transient,
            _ => self.is_disk_full(),
        }
    }

    /// Returns `true` if the disk of the database is full.
    pub fn is_disk_full(&self) -> bool {
        match self {
            Self::Database { is_disk_full, .. } => *is_disk_full,
            Self::Prepare { cause, .. } => files::is_full(cause),
            Self::DiskFull => true,
            _ => false,
        }
    }
}
