//! Objects with checkpoints, and the results that a checkpoint makes obsolete.

use std::time::Duration;

use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::objects::Objects;
use crate::store::StoreError;
use crate::store::postgres::PostgresStore;
use crate::store::rows::integer;

/// Deletes rows, snapshots and files after a cycle, and the block; without a cycle all of them, and the checkpoint.
pub(super) async fn delete_results_after(
    connection: &mut PgConnection,
    id: Uuid,
    cycle: Option<u64>,
) -> Result<(), StoreError> {
    // The block is made of them, and made again at the end.
    sqlx::query(
        "WITH history AS (DELETE FROM history_rows WHERE job_id = $1 AND cycle > $2), \
         profiles AS (DELETE FROM snapshots WHERE job_id = $1 AND cycle > $2), \
         files AS (DELETE FROM result_files WHERE job_id = $1 AND COALESCE(cycle, 0) > $2), \
         state AS (DELETE FROM checkpoints WHERE job_id = $1 AND cycle > $2) \
         DELETE FROM result_blocks WHERE job_id = $1",
    )
    .bind(id)
    .bind(cycle.map_or(-1, integer))
    .execute(connection)
    .await?;
    Ok(())
}

/// Removes the note of an object that gets a name; false if it is being removed.
pub(super) async fn name_object(
    connection: &mut PgConnection,
    key: &str,
) -> Result<bool, StoreError> {
    let noted = sqlx::query("DELETE FROM unnamed_objects WHERE key = $1 AND NOT is_removing")
        .bind(key)
        .execute(&mut *connection)
        .await?;
    if noted.rows_affected() > 0 {
        return Ok(true);
    }
    // The object may have been written after its removal.
    sqlx::query("INSERT INTO unnamed_objects (key) VALUES ($1) ON CONFLICT DO NOTHING")
        .bind(key)
        .execute(connection)
        .await?;
    Ok(false)
}

impl PostgresStore {
    pub(in crate::store) async fn note_object(&self, key: &str) -> Result<(), StoreError> {
        // A service that started meanwhile may have noted another store of objects.
        let address = self.process.objects.as_ref().map(Objects::location);
        let noted = sqlx::query(
            "INSERT INTO unnamed_objects (key, noted_at) SELECT $1, fretwear_now() FROM object_store WHERE address = $2",
        )
        .bind(key)
        .bind(address)
        .execute(&self.writer)
        .await?;
        if noted.rows_affected() > 0 {
            return Ok(());
        }
        let stored = sqlx::query_scalar("SELECT address FROM object_store");
        let stored: Option<String> = stored.fetch_optional(&self.writer).await?;
        Err(StoreError::OtherObjects {
            stored: stored.unwrap_or_default(),
            given: address.unwrap_or_default().to_owned(),
        })
    }

    pub(in crate::store) async fn keep_object(
        &self,
        key: &str,
        content: Option<&[u8]>,
        length: Duration,
    ) -> Result<bool, StoreError> {
        let kept = sqlx::query(
            "UPDATE unnamed_objects SET noted_at = fretwear_now() + $3, content = $2 WHERE key = $1 AND NOT is_removing",
        )
        .bind(key)
        .bind(content)
        .bind(integer(length.as_millis()))
        .execute(&self.writer)
        .await?;
        Ok(kept.rows_affected() > 0)
    }
}
