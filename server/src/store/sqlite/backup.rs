//! Backup and restore: one consistent, verified copy of the database and the files that it names.
//!
//! A backup is a folder with `fretwear.db` and `fretwear.db.results`, which can be served as it is.

mod database;
mod disk;
mod files;

use std::path::Path;

use sqlx::sqlite::SqliteConnection;
use sqlx::{ConnectOptions, Connection};

use crate::export::files::{create_folder, parent};
use crate::store::folder::{Folder, beside};
use crate::store::leases::ENDED_BY_RESTORE;
use crate::store::sqlite::identity::schema_version;
use crate::store::sqlite::lock::lock;
use crate::store::sqlite::moved_meanwhile::take_moved;
use crate::store::sqlite::open::options;
use crate::store::{BackupError, CopySummary, Lease};

use database::has_marks;
use disk::{absent, file, sync};
use files::{Damage, copy_files};

pub(super) use database::{at, check_integrity};

/// File name of the database in a backup.
const NAME: &str = "fretwear.db";
/// Suffix of a database that is being copied.
const PARTIAL: &str = ".partial";

/// Copies the database at `url`, which may be in use, and its files into a new or empty folder.
///
/// # Errors
/// [`BackupError`]; the incomplete copy is not removed.
pub async fn backup(url: &str, into: &Path) -> Result<CopySummary, BackupError> {
    let source = options(url)?.get_filename().to_owned();
    database_at(&source).await?;
    create_folder(into).map_err(|cause| file(into, cause))?;
    let mut entries = std::fs::read_dir(into).map_err(|cause| file(into, cause))?;
    if entries.next().is_some() {
        return Err(BackupError::NotEmpty(into.to_owned()));
    }
    let target = into.join(NAME);
    copy_database(&source, &target).await?;
    copy_named_files(&source, &target).await
}

/// Checks that a file is a database of this program; returns the version of its schema.
pub(super) async fn database_at(path: &Path) -> Result<i64, BackupError> {
    let version = schema_version(path).await?;
    version.ok_or_else(|| BackupError::NoDatabase(path.to_owned()))
}

/// Copies a database, which may be in use.
pub(in crate::store) async fn copy_database(
    source: &Path,
    target: &Path,
) -> Result<(), BackupError> {
    let mut database = at(source).connect().await?;
    let vacuum: i64 = sqlx::query_scalar("PRAGMA auto_vacuum")
        .fetch_one(&mut database)
        .await?;
    if vacuum == 0 {
        // Applies to the copy alone, which can then release free pages.
        sqlx::query("PRAGMA auto_vacuum = INCREMENTAL")
            .execute(&mut database)
            .await?;
    }
    sqlx::query("VACUUM INTO ?")
        .bind(target.to_string_lossy().into_owned())
        .execute(&mut database)
        .await?;
    Ok(database.close().await?)
}

/// Copies the files that a copied database names; jobs that were deleted from the source meanwhile are deleted from the
/// copy too. Damaged files are copied as they are, and marked as damaged in the copy.
pub(in crate::store) async fn copy_named_files(
    source: &Path,
    target: &Path,
) -> Result<CopySummary, BackupError> {
    let (mut copied, damages) =
        copy_files(target, &Folder::beside(source), &Folder::beside(target)).await?;
    let (damaged, missing) = still_named(source, damages).await?;
    let mut database = at(target).connect().await?;
    let deleted = take_moved(source, &mut database, missing).await?;
    database.close().await?;
    copied.jobs = delete_missing(target, &deleted).await?;
    copied.damaged = complete(target, damaged).await?;
    sync(target)?;
    sync(parent(target))?;
    Ok(copied)
}

/// Splits damaged files into those that a database still names and the places of the others.
async fn still_named(
    database: &Path,
    damages: Vec<Damage>,
) -> Result<(Vec<Damage>, Vec<String>), BackupError> {
    let (mut damaged, mut deleted) = (Vec::new(), Vec::new());
    let mut connection = at(database).read_only(true).connect().await?;
    for damage in damages {
        let named: i64 = sqlx::query_scalar("SELECT count(*) FROM result_files WHERE place = ?")
            .bind(&damage.place)
            .fetch_one(&mut connection)
            .await?;
        if named > 0 {
            damaged.push(damage);
        } else {
            deleted.push(damage.place);
        }
    }
    connection.close().await?;
    Ok((damaged, deleted))
}

/// Completes a copy: marks the damaged files, removes the owner, and ends the leases; returns a message about each damaged file.
async fn complete(database: &Path, damaged: Vec<Damage>) -> Result<Vec<String>, BackupError> {
    let mut connection = at(database).connect().await?;
    let (has_marks, mut said) = (has_marks(&mut connection).await?, Vec::new());
    let owner: i64 = sqlx::query_scalar("SELECT count(*) FROM sqlite_master WHERE name = 'owner'")
        .fetch_one(&mut connection)
        .await?;
    if owner > 0 {
        // Nobody serves the copy; a service on it need not wait for a heartbeat of the original's.
        sqlx::query("DELETE FROM owner")
            .execute(&mut connection)
            .await?;
    }
    end_leases(&mut connection).await?;
    let moves: i64 =
        sqlx::query_scalar("SELECT count(*) FROM sqlite_master WHERE name = 'object_store'")
            .fetch_one(&mut connection)
            .await?;
    if moves > 0 {
        // The original names these objects, or will remove them.
        for statement in [
            "DELETE FROM unnamed_objects",
            "UPDATE object_store SET removes = 0",
        ] {
            sqlx::query(statement).execute(&mut connection).await?;
        }
    }
    for Damage { place, cause, .. } in damaged {
        let how = cause.to_string();
        if has_marks {
            sqlx::query("UPDATE result_files SET damaged = ? WHERE place = ?")
                .bind(&how)
                .bind(&place)
                .execute(&mut connection)
                .await?;
        }
        said.push(format!("{place}: {how}"));
    }
    connection.close().await?;
    Ok(said)
}

/// Ends all leases of a copy: their workers continue writing to the original.
async fn end_leases(connection: &mut SqliteConnection) -> Result<(), sqlx::Error> {
    sqlx::query("UPDATE jobs SET lease = lease + ?, lease_expires_at = ? WHERE status = 'running'")
        .bind(Lease::step())
        .bind(ENDED_BY_RESTORE)
        .execute(connection)
        .await?;
    Ok(())
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

/// Copies a backup to the database address `url`; overwrites nothing. Files that were damaged when the backup was made are
/// copied as they are.
///
/// # Errors
/// [`BackupError`]; nothing is left of the copy.
pub async fn restore(from: &Path, url: &str) -> Result<CopySummary, BackupError> {
    let source = from.join(NAME);
    database_at(&source).await?;
    let target = options(url)?.get_filename().to_owned();
    let results = beside(&target, ".results");
    absent(&target)?;
    absent(&results)?;
    // No process may serve it before it is complete.
    let _lock = lock(&target)?;
    let copied = copy_backup(&source, &target).await;
    if copied.is_err() {
        // Files that cannot be removed are named by no database, but prevent the next restore to this place.
        for log in ["", "-wal", "-shm", "-journal"] {
            let _ = std::fs::remove_file(beside(&target, &format!("{PARTIAL}{log}")));
        }
        let _ = std::fs::remove_dir_all(&results);
        let _ = std::fs::remove_file(beside(&target, ".lock"));
    }
    copied
}

async fn copy_backup(source: &Path, target: &Path) -> Result<CopySummary, BackupError> {
    let (mut copied, damages) =
        copy_files(source, &Folder::beside(source), &Folder::beside(target)).await?;
    for Damage {
        place,
        cause,
        is_known,
    } in damages
    {
        if !is_known {
            return Err(BackupError::Content { place, cause });
        }
        copied.damaged.push(format!("{place}: {cause}"));
    }
    let partial = beside(target, PARTIAL);
    std::fs::copy(source, &partial).map_err(|cause| file(&partial, cause))?;
    // A backup of an earlier version has leases, and its workers may have continued since.
    let mut connection = at(&partial).connect().await?;
    end_leases(&mut connection).await?;
    connection.close().await?;
    sync(&partial)?;
    std::fs::rename(&partial, target).map_err(|cause| file(target, cause))?;
    // The rename is durable once the folder is synced.
    sync(parent(target))?;
    Ok(copied)
}
