//! Verification of the database at an address, whatever its engine.

use std::path::Path;

use crate::objects::Objects;
use crate::store::address::is_postgres;
use crate::store::{BackupError, CopySummary, postgres, sqlite};

/// Reads the database at `url`, which may be in use, and all results, and compares every checksum. Marks in the manifests which files are damaged,
/// and which no longer are. Large results of a PostgreSQL database that are no objects are in the folder `files`.results. `objects` is the store that
/// results were moved to.
///
/// # Errors
/// [`BackupError`] if the database cannot be read, if a SQLite file is damaged, or if results are in a store of objects that is not given.
pub async fn verify(
    url: &str,
    files: &Path,
    objects: Option<&Objects>,
) -> Result<CopySummary, BackupError> {
    if is_postgres(url) {
        Box::pin(postgres::verify::verify(url, files, objects)).await
    } else {
        Box::pin(sqlite::verify::verify(url, objects)).await
    }
}
