//! Backup and restore: one consistent copy of the database and the files that it names, verified.
//!
//! A backup is a folder with `fretwear.db` and `fretwear.db.results`, so it can be served as it is.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};
use sqlx::{ConnectOptions, Connection};

use crate::export::files::{create_folder, parent, sha256};
use crate::store::StoreError;
use crate::store::sqlite::folder::Folder;
use crate::store::sqlite::open::locked;

/// Name of the database in a backup.
const NAME: &str = "fretwear.db";

/// Why there is no backup, or nothing was restored.
#[derive(Debug, thiserror::Error)]
pub enum BackupError {
    /// The store cannot be used.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The database refused a statement.
    #[error("database: {0}")]
    Sql(#[from] sqlx::Error),
    /// A file cannot be read or written.
    #[error("{}: {cause}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// Nothing is overwritten.
    #[error("{} exists; nothing is overwritten", .0.display())]
    Exists(PathBuf),
    /// The database is damaged.
    #[error("{} is damaged: {found}", .path.display())]
    Damaged {
        /// The database.
        path: PathBuf,
        /// What its check said.
        found: String,
    },
    /// A file that the database names is not there.
    #[error("the database names {0}, which is not there")]
    Missing(String),
    /// A file is not the one that the database names.
    #[error("{} has the checksum {found}, the database names {named}", .path.display())]
    Checksum {
        /// The file.
        path: PathBuf,
        /// Its checksum.
        found: String,
        /// The one it should have.
        named: String,
    },
    /// The database names a place outside of its folder.
    #[error("the database names `{0}`, which is no place for a file")]
    Place(String),
}

/// What was copied and verified.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Copied {
    /// Jobs in the database.
    pub jobs: i64,
    /// Files beside it.
    pub files: usize,
    /// Their size together, bytes.
    pub file_bytes: u64,
}

/// Copies the database at `url`, which may be served meanwhile, and its files into a new folder.
///
/// # Errors
/// [`BackupError`]; what was copied so far stays there to be looked at.
pub async fn backup(url: &str, into: &Path) -> Result<Copied, BackupError> {
    let source = path_of(url)?;
    let target = into.join(NAME);
    absent(&target)?;
    create_folder(into).map_err(|cause| file(into, cause))?;
    copy_database(&source, &target).await?;
    copy_what_it_names(&source, &target).await
}

/// Copies a database, which may be served meanwhile, as it stands.
pub(in crate::store) async fn copy_database(
    source: &Path,
    target: &Path,
) -> Result<(), BackupError> {
    let mut database = SqliteConnectOptions::new()
        .filename(source)
        .connect()
        .await?;
    sqlx::query("VACUUM INTO ?")
        .bind(target.to_string_lossy().into_owned())
        .execute(&mut database)
        .await?;
    Ok(database.close().await?)
}

/// Copies the files that a copied database names; what was deleted from its source meanwhile is deleted from it too.
pub(in crate::store) async fn copy_what_it_names(
    source: &Path,
    target: &Path,
) -> Result<Copied, BackupError> {
    let (mut copied, gone) =
        copy_files(target, &Folder::beside(source), &Folder::beside(target)).await?;
    still_named(source, &gone).await?;
    copied.jobs = forget(target, &gone).await?;
    synced(target)?;
    synced(parent(target))?;
    Ok(copied)
}

/// Files that are gone although a database names them are damage.
async fn still_named(database: &Path, gone: &[String]) -> Result<(), BackupError> {
    if gone.is_empty() {
        return Ok(());
    }
    let mut connection = SqliteConnectOptions::new()
        .filename(database)
        .read_only(true)
        .connect()
        .await?;
    for place in gone {
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

/// Brings a copy up to what has become of files that are gone: jobs that had ended were deleted, others begin anew.
/// Returns how many jobs the copy has.
async fn forget(copy: &Path, gone: &[String]) -> Result<i64, BackupError> {
    let mut database = SqliteConnectOptions::new()
        .filename(copy)
        .foreign_keys(true)
        .connect()
        .await?;
    let mut transaction = database.begin().await?;
    for place in gone {
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

/// Copies a backup to where the database at `url` is to be; refuses to overwrite one.
///
/// # Errors
/// [`BackupError`]; the database is there only if all of the backup was found to be sound.
pub async fn restore(from: &Path, url: &str) -> Result<Copied, BackupError> {
    let (source, target) = (from.join(NAME), path_of(url)?);
    absent(&target)?;
    // Nobody may begin to serve it before all of it is there.
    let _lock = locked(&target)?;
    let (copied, gone) =
        copy_files(&source, &Folder::beside(&source), &Folder::beside(&target)).await?;
    still_named(&source, &gone).await?;
    let mut partial = target.clone().into_os_string();
    partial.push(".partial");
    let partial = PathBuf::from(partial);
    std::fs::copy(&source, &partial).map_err(|cause| file(&partial, cause))?;
    synced(&partial)?;
    std::fs::rename(&partial, &target).map_err(|cause| file(&target, cause))?;
    // The rename is on the disk once the folder is.
    synced(parent(&target))?;
    Ok(copied)
}

/// Checks a database and copies the files it names, each against its checksum; with the places of those that are not
/// there.
async fn copy_files(
    database: &Path,
    from: &Folder,
    to: &Folder,
) -> Result<(Copied, Vec<String>), BackupError> {
    let mut connection = SqliteConnectOptions::new()
        .filename(database)
        .read_only(true)
        .connect()
        .await?;
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
    let named = named_files(&mut connection).await?;
    connection.close().await?;
    let mut copied = Copied {
        jobs,
        files: 0,
        file_bytes: 0,
    };
    let mut gone = Vec::new();
    for (place, sha256) in named {
        let (Some(source), Some(target)) = (from.path(&place), to.path(&place)) else {
            return Err(BackupError::Place(place));
        };
        match copy_file(&source, &target, &sha256)? {
            Some(bytes) => {
                copied.files += 1;
                copied.file_bytes += bytes;
            }
            None => gone.push(place),
        }
    }
    Ok((copied, gone))
}

async fn named_files(
    connection: &mut SqliteConnection,
) -> Result<Vec<(String, String)>, BackupError> {
    Ok(
        sqlx::query_as("SELECT place, sha256 FROM result_files WHERE place IS NOT NULL")
            .fetch_all(connection)
            .await?,
    )
}

/// Copies a file; its length, or nothing if it is not there.
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
    synced(target)?;
    synced(folder)?;
    Ok(Some(u64::try_from(bytes.len()).unwrap_or(u64::MAX)))
}

fn path_of(url: &str) -> Result<PathBuf, BackupError> {
    let options = SqliteConnectOptions::from_str(url).map_err(|_| StoreError::Address {
        url: url.to_owned(),
    })?;
    Ok(options.get_filename().to_owned())
}

fn absent(path: &Path) -> Result<(), BackupError> {
    if path.exists() {
        return Err(BackupError::Exists(path.to_owned()));
    }
    Ok(())
}

fn synced(path: &Path) -> Result<(), BackupError> {
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
