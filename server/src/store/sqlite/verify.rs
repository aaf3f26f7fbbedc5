//! Verification of a database file and of all results that it names.

use sqlx::sqlite::{SqlitePool, SqlitePoolOptions, SqliteRow};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::objects::Objects;
use crate::store::folder::Folder;
use crate::store::rows::{StoredRow, entry};
use crate::store::sqlite::backup::{at, check_integrity, database_at};
use crate::store::sqlite::blocks::{stored_block, update_entries};
use crate::store::sqlite::migrations::newest_version;
use crate::store::sqlite::open::options;
use crate::store::stored_block::StoredBlock;
use crate::store::verification::Verification;
use crate::store::verified::{CheckpointRow, FileRow, Verified};
use crate::store::{BackupError, CopySummary, StoreError};

/// Connections: jobs are read beside each other.
const CONNECTIONS: u32 = 4;

/// Verifies the file at `url`.
pub(in crate::store) async fn verify(
    url: &str,
    objects: Option<&Objects>,
) -> Result<CopySummary, BackupError> {
    let path = options(url)?.get_filename().to_owned();
    let (found, known) = (database_at(&path).await?, newest_version());
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
    let verified = verification.run().await;
    database.close().await;
    verified
}

impl Verified for SqlitePool {
    const HAS_SEVERAL_FOLDERS: bool = false;

    async fn jobs(&self) -> Result<Vec<Uuid>, StoreError> {
        let jobs: Vec<Hyphenated> = sqlx::query_scalar("SELECT id FROM jobs ORDER BY id")
            .fetch_all(self)
            .await?;
        Ok(jobs.into_iter().map(Uuid::from).collect())
    }

    async fn block(&self, job: Uuid) -> Result<Option<StoredBlock>, StoreError> {
        let mut connection = self.acquire().await?;
        Ok(stored_block(&mut connection, job).await?)
    }

    async fn mark_block(&self, job: Uuid, old: &[u8], new: &[u8]) -> Result<(), StoreError> {
        let mut connection = self.acquire().await?;
        Ok(update_entries(&mut connection, job, old, new).await?)
    }

    async fn files(&self, job: Uuid, name: Option<&str>) -> Result<Vec<FileRow>, StoreError> {
        let rows = sqlx::query(
            "SELECT name, cycle, media_type, bytes, sha256, damaged, place FROM result_files \
             WHERE job_id = ?1 AND (?2 IS NULL OR name = ?2) ORDER BY name",
        )
        .bind(job.to_string())
        .bind(name)
        .fetch_all(self)
        .await?;
        let file = |row: &SqliteRow| {
            Ok(FileRow {
                entry: entry(row)?,
                place: row.optional_text("place")?,
                object: None,
            })
        };
        rows.iter().map(file).collect()
    }

    async fn content(&self, job: Uuid, file: &FileRow) -> Result<Option<Vec<u8>>, StoreError> {
        let content = sqlx::query_scalar(
            "SELECT content FROM result_files WHERE job_id = ? AND name = ? AND sha256 = ?",
        );
        let content = content.bind(job.to_string()).bind(&file.entry.name);
        let content = content.bind(&file.entry.sha256).fetch_optional(self);
        Ok(content.await?.flatten())
    }

    async fn mark_file(
        &self,
        job: Uuid,
        file: &FileRow,
        how: Option<&str>,
    ) -> Result<(), StoreError> {
        sqlx::query(
            "UPDATE result_files SET damaged = ? WHERE job_id = ? AND name = ? AND place IS ? AND sha256 = ?",
        )
        .bind(how)
        .bind(job.to_string())
        .bind(&file.entry.name)
        .bind(&file.place)
        .bind(&file.entry.sha256)
        .execute(self)
        .await?;
        Ok(())
    }

    async fn checkpoint(&self, job: Uuid) -> Result<Option<CheckpointRow>, StoreError> {
        let row: Option<(Vec<u8>, Vec<u8>, Option<String>)> =
            sqlx::query_as("SELECT sha256, state, object FROM checkpoints WHERE job_id = ?")
                .bind(job.to_string())
                .fetch_optional(self)
                .await?;
        Ok(row.map(CheckpointRow::from))
    }

    async fn address_of_objects(&self) -> Result<Option<String>, StoreError> {
        let address = sqlx::query_scalar("SELECT address FROM object_store");
        Ok(address.fetch_optional(self).await?)
    }

    async fn is_copy(&self) -> Result<bool, StoreError> {
        let copy =
            sqlx::query_scalar("SELECT EXISTS (SELECT 1 FROM object_store WHERE NOT removes)");
        Ok(copy.fetch_one(self).await?)
    }
}
