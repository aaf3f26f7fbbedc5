//! Errors of SQLite as errors of the store.

use crate::store::{BackupError, StoreError};

/// SQLite's result codes for a database that another process writes, that cannot be written or read at present, or
/// whose disk is full: BUSY, LOCKED, IOERR, FULL (sqlite.org/rescode.html).
const TRANSIENT: [u32; 4] = [5, 6, 10, FULL];
const FULL: u32 = 13;
const NO_DATABASE: u32 = 26;

impl From<sqlx::Error> for StoreError {
    fn from(error: sqlx::Error) -> Self {
        let code = result_code(&error);
        Self::Database {
            is_transient: matches!(error, sqlx::Error::PoolTimedOut)
                || code.is_some_and(|code| TRANSIENT.contains(&code)),
            is_disk_full: code == Some(FULL),
            cause: error.into(),
        }
    }
}

/// Whether a file is no SQLite database.
pub(super) fn is_no_database(error: &sqlx::Error) -> bool {
    result_code(error) == Some(NO_DATABASE)
}

/// SQLite's primary result code; an extended code has it in its last byte.
fn result_code(error: &sqlx::Error) -> Option<u32> {
    let sqlx::Error::Database(error) = error else {
        return None;
    };
    let code: u32 = error.code()?.parse().ok()?;
    Some(code & 0xff)
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
