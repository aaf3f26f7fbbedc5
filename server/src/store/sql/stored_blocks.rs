//! Blocks of results of ended jobs.

use uuid::Uuid;

use super::dialect::{Connection, EngineStore, stored_id};
use crate::store::StoreError;
use crate::store::stored_block::StoredBlock;

/// Reads the block of a job; `None` if it has none.
pub(in super::super) async fn stored_block(
    connection: &mut Connection,
    id: Uuid,
) -> Result<Option<StoredBlock>, sqlx::Error> {
    let found = sqlx::query_as(
        "SELECT entries, content, object, content_bytes FROM result_blocks WHERE job_id = $1",
    )
    .bind(stored_id(id))
    .fetch_optional(connection)
    .await?;
    Ok(found.map(|(entries, content, key, content_bytes)| {
        StoredBlock::new(entries, content, key, content_bytes)
    }))
}

impl EngineStore {
    pub(in crate::store) async fn stored_block(
        &self,
        id: Uuid,
    ) -> Result<Option<StoredBlock>, StoreError> {
        let mut connection = self.readers.acquire().await?;
        Ok(stored_block(&mut connection, id).await?)
    }
}

/// Returns the compressed entries of a job's block; `None` if it has none.
pub(super) async fn entries(
    connection: &mut Connection,
    id: Uuid,
) -> Result<Option<Vec<u8>>, sqlx::Error> {
    sqlx::query_scalar("SELECT entries FROM result_blocks WHERE job_id = $1")
        .bind(stored_id(id))
        .fetch_optional(connection)
        .await
}

/// Replaces the entries of a block, unless the job has another one meanwhile.
pub(super) async fn update_entries(
    connection: &mut Connection,
    id: Uuid,
    old: &[u8],
    new: &[u8],
) -> Result<(), sqlx::Error> {
    sqlx::query("UPDATE result_blocks SET entries = $1 WHERE job_id = $2 AND entries = $3")
        .bind(new)
        .bind(stored_id(id))
        .bind(old)
        .execute(connection)
        .await?;
    Ok(())
}
