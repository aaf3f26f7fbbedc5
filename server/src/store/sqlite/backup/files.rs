//! Files that a copied database names.

use std::path::Path;

use api::results::ResultFile;
use sqlx::{ConnectOptions, Connection, Row};

use super::database::{at, check_integrity, has_marks};
use super::disk::{file, sync};
use crate::export::files::{create_folder, parent};
use crate::store::folder::Folder;
use crate::store::rows::entry;
use crate::store::{BackupError, CopySummary, IntegrityError, checksum};

/// A file that differs from its entry.
#[derive(Debug)]
pub(super) struct Damage {
    pub(super) place: String,
    pub(super) cause: IntegrityError,
    /// The entry says so.
    pub(super) is_known: bool,
}

/// Checks a database and copies the files that it names. Also returns the damaged ones.
pub(super) async fn copy_files(
    database: &Path,
    from: &Folder,
    to: &Folder,
) -> Result<(CopySummary, Vec<Damage>), BackupError> {
    let mut connection = at(database).read_only(true).connect().await?;
    check_integrity(database, &mut connection).await?;
    let jobs = sqlx::query_scalar("SELECT count(*) FROM jobs")
        .fetch_one(&mut connection)
        .await?;
    let has_marks = has_marks(&mut connection).await?;
    let query = if has_marks {
        "SELECT name, cycle, media_type, bytes, sha256, damaged, place FROM result_files \
         WHERE place IS NOT NULL ORDER BY place"
    } else {
        "SELECT name, cycle, media_type, bytes, sha256, NULL AS damaged, place FROM result_files \
         WHERE place IS NOT NULL ORDER BY place"
    };
    let rows = sqlx::query(query).fetch_all(&mut connection).await?;
    connection.close().await?;
    let mut copied = CopySummary {
        jobs,
        ..CopySummary::default()
    };
    let mut damages = Vec::new();
    for row in rows {
        let (entry, place) = (entry(&row)?, row.try_get::<String, _>("place")?);
        let (Some(source), Some(target)) = (from.path(&place), to.path(&place)) else {
            return Err(BackupError::Place(place));
        };
        match copy_file(&source, &target, &entry)? {
            Ok(()) => {
                copied.files += 1;
                copied.file_bytes += entry.bytes;
            }
            Err(cause) => damages.push(Damage {
                place,
                cause,
                // A backup of an earlier version cannot say so.
                is_known: entry.damaged.is_some() || !has_marks,
            }),
        }
    }
    Ok((copied, damages))
}

/// Copies a file, if it exists, and checks it.
fn copy_file(
    source: &Path,
    target: &Path,
    entry: &ResultFile,
) -> Result<Result<(), IntegrityError>, BackupError> {
    let checked = checksum::check_file(entry, source);
    if let Err(IntegrityError::Missing) = checked {
        return Ok(checked);
    }
    let folder = parent(target);
    create_folder(folder).map_err(|cause| file(folder, cause))?;
    std::fs::copy(source, target).map_err(|cause| file(source, cause))?;
    sync(target)?;
    sync(folder)?;
    // The copy is checked, not only the source.
    Ok(checked.and_then(|()| checksum::check_file(entry, target)))
}
