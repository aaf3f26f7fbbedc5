//! Errors of databases as errors of the store.

use sqlx::postgres::PgDatabaseError;

use crate::store::{BackupError, StoreError};

/// SQLite's result codes for a database that another process writes, that cannot be written or read at present, or
/// whose disk is full: BUSY, LOCKED, IOERR, FULL (sqlite.org/rescode.html).
const TRANSIENT: [u32; 4] = [5, 6, 10, FULL];
const FULL: u32 = 13;
/// BUSY and LOCKED.
const LOCKS: [u32; 2] = [5, 6];
const NO_DATABASE: u32 = 26;

/// PostgreSQL's classes and codes for what may succeed later (postgresql.org/docs/current/errcodes-appendix.html): the connection
/// failed, a transaction was rolled back in favour of another one, resources are missing, the server is being stopped, it is a standby, a
/// lock was not available, a statement took too long.
const TRANSIENT_STATES: [&str; 7] = ["08", "40", "53", "57", "25006", "55P03", "25P03"];
const DISK_FULL_STATE: &str = "53100";

impl From<sqlx::Error> for StoreError {
    fn from(error: sqlx::Error) -> Self {
        let (is_transient, is_disk_full) = match &error {
            // The connection was lost, or none was to be had in time; a proxy without a server accepts one and ends it in the middle of the
            // protocol.
            sqlx::Error::PoolTimedOut | sqlx::Error::Io(_) | sqlx::Error::Protocol(_) => {
                (true, false)
            }
            _ => match (state(&error), result_code(&error)) {
                (Some(state), _) => (
                    TRANSIENT_STATES
                        .iter()
                        .any(|class| state.starts_with(class)),
                    state == DISK_FULL_STATE,
                ),
                (None, Some(code)) => (TRANSIENT.contains(&code), code == FULL),
                (None, None) => (false, false),
            },
        };
        Self::Database {
            is_transient,
            is_disk_full,
            cause: error.into(),
        }
    }
}

impl StoreError {
    /// Checks whether another program holds a lock of the database.
    pub fn is_locked(&self) -> bool {
        let Self::Database { cause, .. } = self else {
            return false;
        };
        let code = cause.downcast_ref().and_then(result_code);
        code.is_some_and(|code| LOCKS.contains(&code))
    }
}

/// Returns `true` if a file is no SQLite database.
pub(in crate::store) fn is_no_database(error: &sqlx::Error) -> bool {
    state(error).is_none() && result_code(error) == Some(NO_DATABASE)
}

/// PostgreSQL's SQLSTATE.
fn state(error: &sqlx::Error) -> Option<&str> {
    let sqlx::Error::Database(error) = error else {
        return None;
    };
    let error = error.try_downcast_ref::<PgDatabaseError>()?;
    Some(error.code())
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
