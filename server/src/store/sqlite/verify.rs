//! Verification of a database and of all results that it names.

use futures_util::StreamExt;
use sqlx::sqlite::{SqliteConnection, SqliteRow};
use sqlx::{ConnectOptions, Connection, Row};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::export::files::{hexadecimal, sha256};
use crate::objects::{ObjectPart, Objects, ObjectsError};
use crate::store::folder::Folder;
use crate::store::integrity::Checksum;
use crate::store::rows::entry;
use crate::store::sqlite::backup::{at, check_integrity, database_at};
use crate::store::sqlite::blocks::{stored_block, update_entries};
use crate::store::sqlite::migrations::newest_version;
use crate::store::sqlite::open::options;
use crate::store::stored_block::StoredObject;
use crate::store::{BackupError, CopySummary, StoreError, integrity};

/// Reads the database at `url`, which may be in use, and all results, and compares every checksum. Marks in the manifests
/// which files are damaged, and which no longer are. `objects` is the store that results were moved to.
///
/// # Errors
/// [`BackupError`] if the database itself is damaged or cannot be read, or if results are in a store of objects that is not given.
pub async fn verify(url: &str, objects: Option<&Objects>) -> Result<CopySummary, BackupError> {
    let path = options(url)?.get_filename().to_owned();
    let (found, known) = (database_at(&path).await?, newest_version());
    if found < known {
        return Err(BackupError::Older { path, found, known });
    }
    let folder = Folder::beside(&path);
    let mut database = at(&path).connect().await?;
    check_integrity(&path, &mut database).await?;
    let jobs: Vec<Hyphenated> = sqlx::query_scalar("SELECT id FROM jobs ORDER BY id")
        .fetch_all(&mut database)
        .await?;
    let mut verified = CopySummary::default();
    for job in jobs {
        verify_block(&mut database, objects, job.into(), &mut verified).await?;
        let job = job.to_string();
        verify_files(&mut database, &folder, &job, &mut verified).await?;
        verify_checkpoint(&mut database, objects, &job, &mut verified).await?;
        verified.jobs += 1;
    }
    database.close().await?;
    Ok(verified)
}

async fn verify_files(
    database: &mut SqliteConnection,
    folder: &Folder,
    job: &str,
    verified: &mut CopySummary,
) -> Result<(), BackupError> {
    let rows = sqlx::query(
        "SELECT name, cycle, media_type, bytes, sha256, damaged, content, place FROM result_files WHERE job_id = ?",
    )
    .bind(job)
    .fetch_all(&mut *database)
    .await?;
    for row in rows {
        let entry = entry(&row)?;
        let content: Option<Vec<u8>> = row.try_get("content")?;
        let checked = if let Some(bytes) = content {
            integrity::check_bytes(&entry, &bytes)
        } else {
            let place: String = row.try_get("place")?;
            let path = folder.path(&place).ok_or(BackupError::Place(place))?;
            integrity::check_file(&entry, &path)
        };
        verified.files += 1;
        verified.file_bytes += entry.bytes;
        let how = match checked {
            Err(cause) if !named(database, job, &row).await? => {
                tracing::debug!(%cause, "deleted or replaced meanwhile");
                continue;
            }
            Err(cause) if !cause.is_damage() => {
                let place = format!("{} of job {job}", entry.name);
                return Err(BackupError::Content { place, cause });
            }
            checked => checked.err().map(|cause| cause.to_string()),
        };
        if let Some(how) = &how {
            verified
                .damaged
                .push(format!("{} of job {job}: {how}", entry.name));
        }
        if how != entry.damaged {
            let place: Option<String> = row.try_get("place")?;
            sqlx::query(
                "UPDATE result_files SET damaged = ? WHERE job_id = ? AND name = ? AND place IS ?",
            )
            .bind(how)
            .bind(job)
            .bind(&entry.name)
            .bind(place)
            .execute(&mut *database)
            .await?;
        }
    }
    Ok(())
}

/// Checks the block of a job, and the files behind it in an object; marks what is damaged.
async fn verify_block(
    database: &mut SqliteConnection,
    objects: Option<&Objects>,
    job: Uuid,
    verified: &mut CopySummary,
) -> Result<(), BackupError> {
    let Some(stored) = stored_block(&mut *database, job).await? else {
        return Ok(());
    };
    let (mut entries, object) = (stored.entries.clone(), stored.object.clone());
    let block = match stored.decoded(job, objects).await {
        Ok(block) => block,
        Err(StoreError::Objects(ObjectsError::Missing(_)))
            if !is_named(database, job, object.as_ref()).await? =>
        {
            tracing::debug!(%job, "deleted meanwhile");
            return Ok(());
        }
        Err(StoreError::Objects(cause @ ObjectsError::Missing(_))) => {
            let said = format!("results of job {job}: {cause}");
            verified.damaged.push(said);
            return Ok(());
        }
        Err(error @ StoreError::DamagedResults { .. }) => {
            verified.damaged.push(error.to_string());
            return Ok(());
        }
        Err(error) => return Err(error.into()),
    };
    let documents = block.all();
    let mut checked: Vec<_> = documents
        .map(|(entry, bytes)| (entry, integrity::check_bytes(entry, bytes)))
        .collect();
    if let Some(object) = object {
        for (entry, range) in block.events().into_iter().chain(block.files()) {
            let part = object.behind(objects, &range)?;
            let found = checksum(&part).await.map_err(StoreError::from)?;
            checked.push((entry, found.compare(entry)));
        }
    }
    let mut marked = block.clone();
    for (entry, checked) in checked {
        verified.files += 1;
        verified.file_bytes += entry.bytes;
        let how = checked.err().map(|cause| cause.to_string());
        let marked = marked.mark(&entry.name, how.as_deref());
        if let Some(new) = marked.map_err(StoreError::from)? {
            // A job that was queued again meanwhile may have another block.
            update_entries(database, job, &entries, &new).await?;
            entries = new;
        }
        let said = how.map(|how| format!("{} of job {job}: {how}", entry.name));
        verified.damaged.extend(said);
    }
    Ok(())
}

/// Whether a job still names an object.
async fn is_named(
    database: &mut SqliteConnection,
    job: Uuid,
    object: Option<&StoredObject>,
) -> Result<bool, BackupError> {
    let rows: i64 =
        sqlx::query_scalar("SELECT count(*) FROM result_blocks WHERE job_id = ? AND object = ?")
            .bind(job.to_string())
            .bind(object.map(|object| &object.key))
            .fetch_one(database)
            .await?;
    Ok(rows > 0)
}

/// The checksum of a part of an object.
async fn checksum(part: &ObjectPart) -> Result<Checksum, ObjectsError> {
    let mut checksum = Checksum::default();
    let mut chunks = part.stream(0..part.length()).await?;
    while let Some(chunk) = chunks.next().await {
        checksum.update(&chunk?);
    }
    Ok(checksum)
}

/// Whether the database still names a file.
async fn named(
    database: &mut SqliteConnection,
    job: &str,
    row: &SqliteRow,
) -> Result<bool, BackupError> {
    let (name, place): (String, Option<String>) = (row.try_get("name")?, row.try_get("place")?);
    let rows: i64 = sqlx::query_scalar(
        "SELECT count(*) FROM result_files WHERE job_id = ? AND name = ? AND place IS ?",
    )
    .bind(job)
    .bind(name)
    .bind(place)
    .fetch_one(database)
    .await?;
    Ok(rows > 0)
}

/// A damaged checkpoint is not marked: its job would restart at cycle 0.
async fn verify_checkpoint(
    database: &mut SqliteConnection,
    objects: Option<&Objects>,
    job: &str,
    verified: &mut CopySummary,
) -> Result<(), BackupError> {
    let Some((named, state, object)) = checkpoint(database, job).await? else {
        return Ok(());
    };
    let state = match &object {
        None => state,
        Some(key) => {
            let read = objects.ok_or(StoreError::NoObjects)?.get_all(key).await;
            match read {
                Ok(state) => state,
                Err(cause @ ObjectsError::Missing(_)) => {
                    // It may have been replaced meanwhile, by the original if this is a copy.
                    let (.., now) = checkpoint(database, job).await?.unwrap_or_default();
                    if now == object && !is_copy(database).await? {
                        let said = format!("checkpoint of job {job}: {cause}");
                        verified.damaged.push(said);
                    }
                    return Ok(());
                }
                Err(cause) => return Err(StoreError::from(cause).into()),
            }
        }
    };
    let (found, named) = (sha256(&state), hexadecimal(&named));
    if found != named {
        let how = format!("it has the SHA-256 {found}, the database names {named}");
        verified
            .damaged
            .push(format!("checkpoint of job {job}: {how}"));
    }
    Ok(())
}

/// Whether the objects of a database are those of its original.
async fn is_copy(database: &mut SqliteConnection) -> Result<bool, BackupError> {
    let copy = sqlx::query_scalar("SELECT EXISTS (SELECT 1 FROM object_store WHERE NOT removes)");
    Ok(copy.fetch_one(database).await?)
}

/// SHA-256, state and object of the checkpoint of a job.
async fn checkpoint(
    database: &mut SqliteConnection,
    job: &str,
) -> Result<Option<(Vec<u8>, Vec<u8>, Option<String>)>, BackupError> {
    let row = sqlx::query_as("SELECT sha256, state, object FROM checkpoints WHERE job_id = ?");
    Ok(row.bind(job).fetch_optional(database).await?)
}
