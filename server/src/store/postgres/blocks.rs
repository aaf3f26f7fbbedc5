//! Blocks of results of ended jobs.

use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::block::EncodedBlock;
use crate::store::postgres::PostgresStore;
use crate::store::stored_block::StoredBlock;

/// Reads the block of a job; `None` if it has none.
pub(super) async fn stored_block(
    connection: &mut PgConnection,
    id: Uuid,
) -> Result<Option<StoredBlock>, sqlx::Error> {
    let found = sqlx::query_as(
        "SELECT entries, content, object, content_bytes FROM result_blocks WHERE job_id = $1",
    )
    .bind(id)
    .fetch_optional(connection)
    .await?;
    Ok(found.map(|(entries, content, key, content_bytes)| {
        StoredBlock::new(entries, content, key, content_bytes)
    }))
}

impl PostgresStore {
    pub(in crate::store) async fn stored_block(
        &self,
        id: Uuid,
    ) -> Result<Option<StoredBlock>, StoreError> {
        let mut connection = self.readers.acquire().await?;
        Ok(stored_block(&mut connection, id).await?)
    }
}

/// Stores the block of a job that ends. Its documents replace files of the same names that an earlier end has left. Its history
/// replaces the rows if the job has succeeded: the next try of another one continues them.
pub(super) async fn insert_block(
    connection: &mut PgConnection,
    id: Uuid,
    block: &EncodedBlock,
    succeeded: bool,
) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT INTO result_blocks (job_id, entries, content, is_movable) VALUES ($1, $2, $3, $4) \
         ON CONFLICT (job_id) DO UPDATE SET entries = excluded.entries, content = excluded.content, \
         is_movable = excluded.is_movable, object = NULL, content_bytes = NULL, documents = NULL",
    )
    .bind(id)
    .bind(&block.entries)
    .bind(&block.content)
    .bind(succeeded)
    .execute(&mut *connection)
    .await?;
    sqlx::query("DELETE FROM result_files WHERE job_id = $1 AND name = ANY($2)")
        .bind(id)
        .bind(&block.documents)
        .execute(&mut *connection)
        .await?;
    if succeeded && block.has_history {
        sqlx::query(
            "WITH history AS (DELETE FROM history_rows WHERE job_id = $1) DELETE FROM snapshots WHERE job_id = $1",
        )
        .bind(id)
        .execute(connection)
        .await?;
    }
    Ok(())
}

/// Returns the compressed entries of a job's block; `None` if it has none.
pub(super) async fn entries(
    connection: &mut PgConnection,
    id: Uuid,
) -> Result<Option<Vec<u8>>, sqlx::Error> {
    sqlx::query_scalar("SELECT entries FROM result_blocks WHERE job_id = $1")
        .bind(id)
        .fetch_optional(connection)
        .await
}
