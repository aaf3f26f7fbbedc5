//! Verification of a database file and of all results that it names.

use sqlx::sqlite::SqlitePoolOptions;

use crate::objects::Objects;
use crate::store::folder::Folder;
use crate::store::integrity::check::Verification;
use crate::store::migrations::newest_version;
use crate::store::sqlite::backup::{at, check_integrity, database_at};
use crate::store::sqlite::migrations::FILES;
use crate::store::sqlite::open::options;
use crate::store::{BackupError, CopySummary, StoreError};

/// Connections: jobs are read beside each other.
const CONNECTIONS: u32 = 4;

/// Verifies the file at `url`.
pub(in crate::store) async fn verify(
    url: &str,
    objects: Option<&Objects>,
) -> Result<CopySummary, BackupError> {
    let path = options(url)?.get_filename().to_owned();
    let (found, known) = (database_at(&path).await?, newest_version(&FILES));
    if found < known {
        return Err(BackupError::Older { path, found, known });
    }
    if found > known {
        return Err(StoreError::Newer { path, found, known }.into());
    }
    let pool = SqlitePoolOptions::new().max_connections(CONNECTIONS);
    let database = pool.connect_with(at(&path)).await?;
    check_integrity(&path, &mut *database.acquire().await?).await?;
    let folder = Folder::beside(&path);
    let verification = Verification::of(&database, &folder, objects).await?;
    let report = verification.run().await;
    database.close().await;
    report
}
