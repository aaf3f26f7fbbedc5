//! Names in a database, as they are verified.

use sqlx::{AssertSqlSafe, Pool, QueryBuilder};
use uuid::Uuid;

use super::dialect::{
    self, Engine, FILE_OBJECT, HAS_SEVERAL_FOLDERS, Row, StoredId, read_id, stored_id,
};
use super::stored_blocks::{stored_block, update_entries};
use crate::store::StoreError;
use crate::store::integrity::database::{CheckpointRow, FileRow, VerifiableDatabase};
use crate::store::rows::{StoredRow, entry};
use crate::store::stored_block::StoredBlock;

impl VerifiableDatabase for Pool<Engine> {
    const HAS_SEVERAL_FOLDERS: bool = HAS_SEVERAL_FOLDERS;

    async fn jobs(&self) -> Result<Vec<Uuid>, StoreError> {
        let jobs: Vec<StoredId> = sqlx::query_scalar("SELECT id FROM jobs ORDER BY id")
            .fetch_all(self)
            .await?;
        Ok(jobs.into_iter().map(read_id).collect())
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
        let mut query = QueryBuilder::<Engine>::new(format!(
            "SELECT name, cycle, media_type, bytes, sha256, damaged, place, {FILE_OBJECT} AS object \
             FROM result_files WHERE job_id = "
        ));
        query.push_bind(stored_id(job));
        if let Some(name) = name {
            query.push(" AND name = ").push_bind(name);
        }
        query.push(" ORDER BY name");
        let rows = query.build().fetch_all(self).await?;
        let file = |row: &Row| {
            Ok(FileRow {
                entry: entry(row)?,
                place: row.value("place")?,
                object: row.value("object")?,
            })
        };
        rows.iter().map(file).collect()
    }

    async fn content(&self, job: Uuid, file: &FileRow) -> Result<Option<Vec<u8>>, StoreError> {
        let content = sqlx::query_scalar(
            "SELECT content FROM result_files WHERE job_id = $1 AND name = $2 AND sha256 = $3",
        );
        let content = content.bind(stored_id(job)).bind(&file.entry.name);
        let content = content.bind(&file.entry.sha256).fetch_optional(self);
        Ok(content.await?.flatten())
    }

    async fn mark_file(
        &self,
        job: Uuid,
        file: &FileRow,
        how: Option<&str>,
    ) -> Result<(), StoreError> {
        let statement = format!(
            "UPDATE result_files SET damaged = $1 WHERE job_id = $2 AND name = $3 \
             AND place IS NOT DISTINCT FROM $4 AND {FILE_OBJECT} IS NOT DISTINCT FROM $5 AND sha256 = $6",
        );
        sqlx::query(AssertSqlSafe(statement))
            .bind(how)
            .bind(stored_id(job))
            .bind(&file.entry.name)
            .bind(&file.place)
            .bind(&file.object)
            .bind(&file.entry.sha256)
            .execute(self)
            .await?;
        Ok(())
    }

    async fn checkpoint(&self, job: Uuid) -> Result<Option<CheckpointRow>, StoreError> {
        let row: Option<(Vec<u8>, Vec<u8>, Option<String>)> =
            sqlx::query_as("SELECT sha256, state, object FROM checkpoints WHERE job_id = $1")
                .bind(stored_id(job))
                .fetch_optional(self)
                .await?;
        Ok(row.map(CheckpointRow::from))
    }

    async fn address_of_objects(&self) -> Result<Option<String>, StoreError> {
        let address = sqlx::query_scalar("SELECT address FROM object_store");
        Ok(address.fetch_optional(self).await?)
    }

    async fn is_copy(&self) -> Result<bool, StoreError> {
        dialect::is_copy(&mut *self.acquire().await?).await
    }
}
