//! Backup and restore: one consistent, verified copy of the database and the files that it names.
//!
//! A backup is a folder with `fretwear.db` and `fretwear.db.results`, which can be served as it is.

use std::io::ErrorKind;
use std::path::Path;

use sqlx::sqlite::SqliteConnectOptions;
use sqlx::{ConnectOptions, Connection};

use crate::export::files::{create_folder, parent, sha256};
use crate::store::sqlite::folder::{Folder, beside};
use crate::store::sqlite::open::{lock, options};
use crate::store::{BackupError, CopySummary};

/// File name of the database in a backup.
const NAME: &str = "fretwear.db";

/// Copies the database at `url`, which may be in use, and its files into a new folder.
///
/// # Errors
/// [`BackupError`]; the incomplete copy is not removed.
pub async fn backup(url: &str, into: &Path) -> Result<CopySummary, BackupError> {
    let source = options(url)?.get_filename().to_owned();
    let target = into.join(NAME);
    absent(&target)?;
    create_folder(into).map_err(|cause| file(into, cause))?;
    copy_database(&source, &target).await?;
    copy_named_files(&source, &target).await
}

/// Copies a database, which may be in use.
pub(super) async fn copy_database(source: &Path, target: &Path) -> Result<(), BackupError> {
    let mut database = at(source).connect().await?;
    sqlx::query("VACUUM INTO ?")
        .bind(target.to_string_lossy().into_owned())
        .execute(&mut database)
        .await?;
    Ok(database.close().await?)
}

/// Copies the files that a copied database names; jobs that were deleted from the source meanwhile are deleted from the
/// copy too.
pub(super) async fn copy_named_files(
    source: &Path,
    target: &Path,
) -> Result<CopySummary, BackupError> {
    let (mut copied, missing) =
        copy_files(target, &Folder::beside(source), &Folder::beside(target)).await?;
    check_deleted(source, &missing).await?;
    copied.jobs = delete_missing(target, &missing).await?;
    sync(target)?;
    sync(parent(target))?;
    Ok(copied)
}

/// Checks that a database no longer names these missing files.
async fn check_deleted(database: &Path, missing: &[String]) -> Result<(), BackupError> {
    if missing.is_empty() {
        return Ok(());
    }
    let mut connection = at(database).read_only(true).connect().await?;
    for place in missing {
        let named: i64 = sqlx::query_scalar("SELECT count(*) FROM result_files WHERE place = ?")
            .bind(place)
            .fetch_one(&mut connection)
            .await?;
        if named > 0 {
            return Err(BackupError::Missing(place.clone()));
        }
    }
    Ok(connection.close().await?)
}

/// Deletes the owners of missing files from a copy: ended jobs were deleted from the source, other jobs restart at
/// cycle 0. Returns the number of jobs in the copy.
async fn delete_missing(copy: &Path, missing: &[String]) -> Result<i64, BackupError> {
    let mut database = at(copy).foreign_keys(true).connect().await?;
    let mut transaction = database.begin().await?;
    for place in missing {
        for statement in [
            "DELETE FROM jobs WHERE finished_at IS NOT NULL AND id IN (SELECT job_id FROM result_files WHERE place = ?)",
            "DELETE FROM checkpoints WHERE job_id IN (SELECT job_id FROM result_files WHERE place = ?)",
            "DELETE FROM result_files WHERE place = ?",
        ] {
            sqlx::query(statement)
                .bind(place)
                .execute(&mut *transaction)
                .await?;
        }
    }
    let jobs = sqlx::query_scalar("SELECT count(*) FROM jobs")
        .fetch_one(&mut *transaction)
        .await?;
    transaction.commit().await?;
    database.close().await?;
    Ok(jobs)
}

/// Copies a backup to the database address `url`; overwrites nothing.
///
/// # Errors
/// [`BackupError`]; the database is created only if the whole backup is valid.
pub async fn restore(from: &Path, url: &str) -> Result<CopySummary, BackupError> {
    let source = from.join(NAME);
    let target = options(url)?.get_filename().to_owned();
    absent(&target)?;
    // No process may serve it before it is complete.
    let _lock = lock(&target)?;
    let (copied, missing) =
        copy_files(&source, &Folder::beside(&source), &Folder::beside(&target)).await?;
    check_deleted(&source, &missing).await?;
    let partial = beside(&target, ".partial");
    std::fs::copy(&source, &partial).map_err(|cause| file(&partial, cause))?;
    sync(&partial)?;
    std::fs::rename(&partial, &target).map_err(|cause| file(&target, cause))?;
    // The rename is durable once the folder is synced.
    sync(parent(&target))?;
    Ok(copied)
}

/// Checks a database and copies the files it names, comparing their checksums. Also returns the paths of missing files.
async fn copy_files(
    database: &Path,
    from: &Folder,
    to: &Folder,
) -> Result<(CopySummary, Vec<String>), BackupError> {
    let mut connection = at(database).read_only(true).connect().await?;
    let found: String = sqlx::query_scalar("PRAGMA integrity_check(1)")
        .fetch_one(&mut connection)
        .await?;
    if found != "ok" {
        let path = database.to_owned();
        return Err(BackupError::Damaged { path, found });
    }
    let jobs = sqlx::query_scalar("SELECT count(*) FROM jobs")
        .fetch_one(&mut connection)
        .await?;
    let named: Vec<(String, String)> =
        sqlx::query_as("SELECT place, sha256 FROM result_files WHERE place IS NOT NULL")
            .fetch_all(&mut connection)
            .await?;
    connection.close().await?;
    let mut copied = CopySummary {
        jobs,
        ..CopySummary::default()
    };
    let mut missing = Vec::new();
    for (place, sha256) in named {
        let (Some(source), Some(target)) = (from.path(&place), to.path(&place)) else {
            return Err(BackupError::Place(place));
        };
        match copy_file(&source, &target, &sha256)? {
            Some(bytes) => {
                copied.files += 1;
                copied.file_bytes += bytes;
            }
            None => missing.push(place),
        }
    }
    Ok((copied, missing))
}

/// Copies a file; returns its length, or `None` if it does not exist.
fn copy_file(source: &Path, target: &Path, named: &str) -> Result<Option<u64>, BackupError> {
    let bytes = match std::fs::read(source) {
        Err(cause) if cause.kind() == ErrorKind::NotFound => return Ok(None),
        bytes => bytes.map_err(|cause| file(source, cause))?,
    };
    let found = sha256(&bytes);
    if found != named {
        return Err(BackupError::Checksum {
            path: source.to_owned(),
            found,
            named: named.to_owned(),
        });
    }
    let folder = parent(target);
    create_folder(folder).map_err(|cause| file(folder, cause))?;
    std::fs::write(target, &bytes).map_err(|cause| file(target, cause))?;
    sync(target)?;
    sync(folder)?;
    Ok(Some(u64::try_from(bytes.len()).unwrap_or(u64::MAX)))
}

/// Options to connect to a database file.
fn at(path: &Path) -> SqliteConnectOptions {
    SqliteConnectOptions::new().filename(path)
}

fn absent(path: &Path) -> Result<(), BackupError> {
    if path.exists() {
        return Err(BackupError::Exists(path.to_owned()));
    }
    Ok(())
}

fn sync(path: &Path) -> Result<(), BackupError> {
    std::fs::File::open(path)
        .and_then(|opened| opened.sync_all())
        .map_err(|cause| file(path, cause))
}

fn file(path: &Path, cause: std::io::Error) -> BackupError {
    BackupError::File {
        path: path.to_owned(),
        cause,
    }
}
