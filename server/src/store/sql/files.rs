//! Manifests: the files of a job by name, and their content.

use api::results::ResultFile;
use sqlx::AssertSqlSafe;
use uuid::Uuid;

use super::dialect::{EngineStore, FILE_OBJECT, STORES_NUL, stored_id};
use super::job_rows::lock;
use super::stored_blocks::{entries, update_entries};
use crate::objects::Source;
use crate::store::block::Block;
use crate::store::rows::{StoredRow, entry};
use crate::store::stored_block::unreadable;
use crate::store::stored_file::{file, source};
use crate::store::{Content, StoreError};

impl EngineStore {
    pub(in crate::store) async fn manifest(&self, id: Uuid) -> Result<Vec<ResultFile>, StoreError> {
        // Both as of one time: a file may be moved from the one to the other.
        let mut transaction = self.snapshot().await?;
        let rows = sqlx::query(
            "SELECT name, cycle, media_type, bytes, sha256, damaged FROM result_files WHERE job_id = $1",
        )
        .bind(stored_id(id))
        .fetch_all(&mut *transaction)
        .await?;
        let mut files: Vec<_> = rows.iter().map(entry).collect::<Result<_, _>>()?;
        if let Some(entries) = entries(&mut transaction, id).await? {
            files.extend(Block::listed(&entries).map_err(|cause| unreadable(id, &cause))?);
        }
        files.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(files)
    }

    pub(in crate::store) async fn file_row(
        &self,
        id: Uuid,
        name: &str,
    ) -> Result<Option<(ResultFile, Content)>, StoreError> {
        if !STORES_NUL && name.contains('\0') {
            return Ok(None);
        }
        let statement = format!(
            "SELECT name, cycle, media_type, bytes, sha256, damaged, content, place, {FILE_OBJECT} AS object \
             FROM result_files WHERE job_id = $1 AND name = $2"
        );
        let row = sqlx::query(AssertSqlSafe(statement))
            .bind(stored_id(id))
            .bind(name)
            .fetch_optional(&self.readers)
            .await?;
        let Some(row) = row else {
            return Ok(None);
        };
        let object: Option<String> = row.value("object")?;
        file(&self.process, id, &row, object.as_deref()).map(Some)
    }

    pub(in crate::store) async fn files_outside(
        &self,
        id: Uuid,
    ) -> Result<Vec<(ResultFile, Source)>, StoreError> {
        let statement = format!(
            "SELECT name, cycle, media_type, bytes, sha256, damaged, place, {FILE_OBJECT} AS object \
             FROM result_files WHERE job_id = $1 AND content IS NULL"
        );
        let rows = sqlx::query(AssertSqlSafe(statement))
            .bind(stored_id(id))
            .fetch_all(&self.readers)
            .await?;
        let mut files = Vec::with_capacity(rows.len());
        for row in &rows {
            let object: Option<String> = row.value("object")?;
            let entry = entry(row)?;
            let source = source(&self.process, id, &entry, row, object.as_deref())?;
            files.extend(source.map(|source| (entry, source)));
        }
        Ok(files)
    }

    pub(in crate::store) async fn mark_damaged(
        &self,
        id: Uuid,
        name: &str,
        how: Option<&str>,
    ) -> Result<(), StoreError> {
        let (mut transaction, _) = self.begin().await?;
        lock(&mut transaction, id).await?;
        sqlx::query(
            "UPDATE result_files SET damaged = $1 WHERE job_id = $2 AND name = $3 AND damaged IS DISTINCT FROM $1",
        )
        .bind(how)
        .bind(stored_id(id))
        .bind(name)
        .execute(&mut *transaction)
        .await?;
        if let Some(old) = entries(&mut transaction, id).await? {
            let block = Block::decode(&old, &[]);
            let mut block = block.map_err(|cause| unreadable(id, &cause))?;
            if let Some(new) = block.mark(name, how)? {
                update_entries(&mut transaction, id, &old, &new).await?;
            }
        }
        Ok(transaction.commit().await?)
    }
}
