//! Blocks of results of jobs that end.

use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::block::EncodedBlock;

/// The block of a job that ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct NewBlock<'a> {
    pub(super) job: Uuid,
    pub(super) block: &'a EncodedBlock,
    /// True if the job has succeeded.
    pub(super) succeeded: bool,
}

/// Stores the blocks of jobs that end. Documents of a block replace files of the same names that an earlier end has left. Its history
/// replaces the rows if the job has succeeded: the next try of another one continues them.
pub(super) async fn insert_blocks(
    connection: &mut PgConnection,
    blocks: &[NewBlock<'_>],
) -> Result<(), StoreError> {
    if blocks.is_empty() {
        return Ok(());
    }
    let of = |value: fn(&EncodedBlock) -> &[u8]| -> Vec<&[u8]> {
        blocks.iter().map(|new| value(new.block)).collect()
    };
    sqlx::query(
        "INSERT INTO result_blocks (job_id, entries, content, is_movable) \
         SELECT * FROM unnest($1::uuid[], $2::bytea[], $3::bytea[], $4::boolean[]) \
         ON CONFLICT (job_id) DO UPDATE SET entries = excluded.entries, content = excluded.content, \
         is_movable = excluded.is_movable, object = NULL, content_bytes = NULL, documents = NULL",
    )
    .bind(blocks.iter().map(|new| new.job).collect::<Vec<_>>())
    .bind(of(|block| &block.entries))
    .bind(of(|block| &block.content))
    .bind(blocks.iter().map(|new| new.succeeded).collect::<Vec<_>>())
    .execute(&mut *connection)
    .await?;
    let documents = blocks.iter().flat_map(|new| {
        let names = new.block.documents.iter();
        names.map(|name| (new.job, name.as_str()))
    });
    let (jobs, names): (Vec<_>, Vec<_>) = documents.unzip();
    sqlx::query(
        "DELETE FROM result_files USING unnest($1::uuid[], $2::text[]) AS given (job, document) WHERE job_id = job AND name = document",
    )
    .bind(jobs)
    .bind(names)
    .execute(&mut *connection)
    .await?;
    let replaced = blocks
        .iter()
        .filter(|new| new.succeeded && new.block.has_history);
    let replaced: Vec<_> = replaced.map(|new| new.job).collect();
    if !replaced.is_empty() {
        sqlx::query(
            "WITH history AS (DELETE FROM history_rows WHERE job_id = ANY($1)) DELETE FROM snapshots WHERE job_id = ANY($1)",
        )
        .bind(replaced)
        .execute(connection)
        .await?;
    }
    Ok(())
}
