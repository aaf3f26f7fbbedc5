//! Blocks of results of ended jobs.

use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::block::EncodedBlock;
use crate::store::sqlite::SqliteStore;
use crate::store::stored_block::StoredBlock;

/// Reads the block of a job; `None` if it has none.
pub(super) async fn stored_block(
    connection: &mut SqliteConnection,
    id: Uuid,
) -> Result<Option<StoredBlock>, sqlx::Error> {
    let found = sqlx::query_as(
        "SELECT entries, content, object, content_bytes FROM result_blocks WHERE job_id = ?",
    )
    .bind(id.to_string())
    .fetch_optional(connection)
    .await?;
    Ok(found.map(|(entries, content, key, content_bytes)| {
        StoredBlock::new(entries, content, key, content_bytes)
    }))
}

impl SqliteStore {
    pub(in crate::store) async fn stored_block(
        &self,
        id: Uuid,
    ) -> Result<Option<StoredBlock>, StoreError> {
        let mut connection = self.readers.acquire().await?;
        Ok(stored_block(&mut connection, id).await?)
    }
}

/// Stores the block of a job that ends. Its documents replace files of the same names that an earlier end has left. Its history replaces the rows if the job has succeeded: the next try of another one
/// continues them.
pub(super) async fn insert_block(
    connection: &mut SqliteConnection,
    id: Uuid,
    block: &EncodedBlock,
    succeeded: bool,
) -> Result<(), StoreError> {
    let id = id.to_string();
    sqlx::query("INSERT OR REPLACE INTO result_blocks (job_id, entries, content, is_movable) VALUES (?, ?, ?, ?)")
        .bind(&id)
        .bind(&block.entries)
        .bind(&block.content)
        .bind(succeeded)
        .execute(&mut *connection)
        .await?;
    for name in &block.documents {
        sqlx::query("DELETE FROM result_files WHERE job_id = ? AND name = ?")
            .bind(&id)
            .bind(name)
            .execute(&mut *connection)
            .await?;
    }
    if !(succeeded && block.has_history) {
        return Ok(());
    }
    for statement in [
        "DELETE FROM history_rows WHERE job_id = ?",
        "DELETE FROM snapshots WHERE job_id = ?",
    ] {
        sqlx::query(statement)
            .bind(&id)
            .execute(&mut *connection)
            .await?;
    }
    Ok(())
}

/// Returns the compressed entries of a job's block; `None` if it has none.
pub(super) async fn entries(
    connection: &mut SqliteConnection,
    id: Uuid,
) -> Result<Option<Vec<u8>>, sqlx::Error> {
    sqlx::query_scalar("SELECT entries FROM result_blocks WHERE job_id = ?")
        .bind(id.to_string())
        .fetch_optional(connection)
        .await
}

/// Replaces the entries of a block, unless the job has another one meanwhile.
pub(super) async fn update_entries(
    connection: &mut SqliteConnection,
    id: Uuid,
    old: &[u8],
    new: &[u8],
) -> Result<(), sqlx::Error> {
    sqlx::query("UPDATE result_blocks SET entries = ? WHERE job_id = ? AND entries = ?")
        .bind(new)
        .bind(id.to_string())
        .bind(old)
        .execute(connection)
        .await?;
    Ok(())
}
