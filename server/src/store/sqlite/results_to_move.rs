//! Results of jobs as they are read to be moved.

use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::store::results_to_move::{Stored, StoredFile, file_to_move};
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::sql::stored_blocks::stored_block;
use crate::store::{StoreError, StoredEvent};

impl SqliteStore {
    pub(in crate::store) async fn results_to_move(
        &self,
        ids: &[Uuid],
    ) -> Result<Vec<Stored>, StoreError> {
        let (mut connection, mut stored) = (self.readers.acquire().await?, Vec::new());
        for id in ids {
            stored.extend(self.results_of(&mut connection, *id).await?);
        }
        Ok(stored)
    }

    /// The results of a job; `None` if it was deleted.
    async fn results_of(
        &self,
        connection: &mut SqliteConnection,
        id: Uuid,
    ) -> Result<Option<Stored>, StoreError> {
        let block = stored_block(&mut *connection, id).await?;
        let texts = sqlx::query_as("SELECT spec, plan FROM jobs WHERE id = ?")
            .bind(id.to_string())
            .fetch_optional(&mut *connection)
            .await?;
        let (Some(block), Some(texts)) = (block, texts) else {
            return Ok(None);
        };
        let events = events_to_move(&mut *connection, id).await?;
        Ok(Some(Stored {
            id,
            block,
            texts,
            events,
            files: self.files_to_move(connection, id).await?,
        }))
    }

    /// The files of a job's manifest, with their places, which may be unreadable.
    async fn files_to_move(
        &self,
        connection: &mut SqliteConnection,
        id: Uuid,
    ) -> Result<Result<Vec<StoredFile>, StoreError>, StoreError> {
        let rows = sqlx::query(
            "SELECT name, cycle, media_type, bytes, sha256, damaged, place FROM result_files \
             WHERE job_id = ? AND place IS NOT NULL ORDER BY name",
        )
        .bind(id.to_string())
        .fetch_all(connection)
        .await?;
        let file = |row| file_to_move(&self.process, id, row, None);
        Ok(rows.iter().map(file).collect())
    }
}

/// All events of a job but the last one, which stays.
async fn events_to_move(
    connection: &mut SqliteConnection,
    id: Uuid,
) -> Result<Vec<StoredEvent>, StoreError> {
    let rows: Vec<(i64, String, String)> = sqlx::query_as(
        "SELECT seq, name, data FROM events WHERE job_id = $1 \
         AND seq < (SELECT last_event FROM jobs WHERE id = $1) ORDER BY seq",
    )
    .bind(id.to_string())
    .fetch_all(connection)
    .await?;
    let event = |(seq, name, data)| StoredEvent { seq, name, data };
    Ok(rows.into_iter().map(event).collect())
}
