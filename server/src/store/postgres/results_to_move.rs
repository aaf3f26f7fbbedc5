//! Results of jobs as they are read to be moved: by statements over all of them.

use std::collections::HashMap;

use sqlx::Row;
use sqlx::postgres::{PgConnection, PgRow};
use uuid::Uuid;

use crate::store::postgres::PostgresStore;
use crate::store::results_to_move::{Stored, StoredFile, file_to_move};
use crate::store::rows::StoredRow;
use crate::store::stored_block::StoredBlock;
use crate::store::{StoreError, StoredEvent};

/// All rows are found by their keys. Without statistics, as in a new database, the server takes the events of 32 jobs for a large part of all, and reads
/// the whole table.
const BY_KEYS: &str = "SELECT set_config('enable_seqscan', 'off', true)";

impl PostgresStore {
    pub(in crate::store) async fn results_to_move(
        &self,
        ids: &[Uuid],
    ) -> Result<Vec<Stored>, StoreError> {
        let mut transaction = self.snapshot().await?;
        sqlx::query(BY_KEYS).execute(&mut *transaction).await?;
        let rows = sqlx::query(
            "SELECT job_id, entries, content, object, content_bytes, spec, plan FROM result_blocks JOIN jobs ON id = job_id \
             WHERE job_id = ANY($1)",
        )
        .bind(ids)
        .fetch_all(&mut *transaction)
        .await?;
        let mut events = events_to_move(&mut transaction, ids).await?;
        let mut files = self.files_to_move(&mut transaction, ids).await?;
        transaction.commit().await?;
        let stored = rows.iter().map(|row| {
            let id = row.id("job_id")?;
            let (entries, content) = (row.try_get("entries")?, row.try_get("content")?);
            let (key, bytes) = (row.try_get("object")?, row.try_get("content_bytes")?);
            Ok(Stored {
                id,
                block: StoredBlock::new(entries, content, key, bytes),
                texts: (row.value("spec")?, row.value("plan")?),
                events: events.remove(&id).unwrap_or_default(),
                files: files.remove(&id).unwrap_or_else(|| Ok(Vec::new())),
            })
        });
        stored.collect()
    }

    /// The files of the manifests of jobs, with their places, which may be unreadable.
    async fn files_to_move(
        &self,
        connection: &mut PgConnection,
        ids: &[Uuid],
    ) -> Result<HashMap<Uuid, Result<Vec<StoredFile>, StoreError>>, StoreError> {
        let rows = sqlx::query(
            "SELECT job_id, name, cycle, media_type, bytes, sha256, damaged, place, object FROM result_files \
             WHERE job_id = ANY($1) ORDER BY job_id, name COLLATE \"C\"",
        )
        .bind(ids)
        .fetch_all(connection)
        .await?;
        let mut rows_of: HashMap<Uuid, Vec<PgRow>> = HashMap::new();
        for row in rows {
            rows_of.entry(row.id("job_id")?).or_default().push(row);
        }
        let file = |id, row: &PgRow| {
            let object: Option<String> = row.value("object")?;
            file_to_move(&self.process, id, row, object.as_deref())
        };
        let files = rows_of
            .into_iter()
            .map(|(id, rows)| (id, rows.iter().map(|row| file(id, row)).collect()));
        Ok(files.collect())
    }
}

/// All events of jobs but the last ones, which stay.
async fn events_to_move(
    connection: &mut PgConnection,
    ids: &[Uuid],
) -> Result<HashMap<Uuid, Vec<StoredEvent>>, StoreError> {
    let rows: Vec<(Uuid, i64, String, String)> = sqlx::query_as(
        "SELECT job_id, seq, name, data FROM events JOIN jobs ON id = job_id \
         WHERE job_id = ANY($1) AND seq < last_event ORDER BY job_id, seq",
    )
    .bind(ids)
    .fetch_all(connection)
    .await?;
    let mut events: HashMap<_, Vec<_>> = HashMap::new();
    for (job, seq, name, data) in rows {
        let event = StoredEvent { seq, name, data };
        events.entry(job).or_default().push(event);
    }
    Ok(events)
}
