//! Errors of SQLite as errors of the store.

use crate::store::{BackupError, StoreError};

/// SQLite's result codes for a database that another process writes, that cannot be written or read at present, or
/// whose disk is full: BUSY, LOCKED, IOERR, FULL (sqlite.org/rescode.html).
const TRANSIENT: [u32; 4] = [5, 6, 10, 13];

impl From<sqlx::Error> for StoreError {
    fn from(error: sqlx::Error) -> Self {
        let is_transient = match &error {
            sqlx::Error::PoolTimedOut => true,
            sqlx::Error::Database(error) => error
                .code()
                .and_then(|code| code.parse::<u32>().ok())
                // The last byte of an extended code is the primary one.
                .is_some_and(|code| TRANSIENT.contains(&(code & 0xff))),
            _ => false,
        };
        Self::Database {
            cause: error.into(),
            is_transient,
        }
    }
}

impl From<sqlx::migrate::MigrateError> for StoreError {
    fn from(error: sqlx::migrate::MigrateError) -> Self {
        Self::Migrate(error.into())
    }
}

impl From<sqlx::Error> for BackupError {
    fn from(error: sqlx::Error) -> Self {
        Self::Store(error.into())
    }
}
