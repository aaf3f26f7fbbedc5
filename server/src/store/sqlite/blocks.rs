//! Blocks of results of jobs that end.

use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::block::EncodedBlock;

/// Stores the block of a job that ends. Documents of the block replace files of the same names that an earlier end has left. The history
/// replaces the rows if the job has succeeded: the next try of another one continues them.
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
