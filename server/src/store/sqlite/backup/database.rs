//! A database that is copied, or is a copy.

use std::path::Path;

use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};

use crate::store::BackupError;

/// Checks whether a database can mark damaged files: those of earlier versions cannot.
pub(super) async fn has_marks(connection: &mut SqliteConnection) -> Result<bool, BackupError> {
    let columns: i64 = sqlx::query_scalar(
        "SELECT count(*) FROM pragma_table_info('result_files') WHERE name = 'damaged'",
    )
    .fetch_one(connection)
    .await?;
    Ok(columns > 0)
}

/// Checks that a database is not damaged.
pub(in crate::store::sqlite) async fn check_integrity(
    path: &Path,
    connection: &mut SqliteConnection,
) -> Result<(), BackupError> {
    let found: String = sqlx::query_scalar("PRAGMA integrity_check(1)")
        .fetch_one(connection)
        .await?;
    if found != "ok" {
        let path = path.to_owned();
        return Err(BackupError::Damaged { path, found });
    }
    Ok(())
}

/// Options to connect to a database file.
pub(in crate::store::sqlite) fn at(path: &Path) -> SqliteConnectOptions {
    SqliteConnectOptions::new().filename(path)
}
