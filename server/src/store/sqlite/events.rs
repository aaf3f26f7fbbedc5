//! Events of jobs. Those before the last one of a job whose results were moved to a store of objects are in its object.

use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::store::block::Block;
use crate::store::compression::{compress, decompress};
use crate::store::integrity;
use crate::store::sqlite::blocks::{StoredBlock, unreadable};
use crate::store::sqlite::queries::integer;
use crate::store::{Store, StoreError, StoredEvent};

/// Largest number of events in an answer.
const PAGE: usize = 500;
/// Largest length of all events of a job, bytes.
const LIMIT: usize = 64 << 20;

impl Store {
    /// Returns the events of a job after number `after`, oldest first; at most a page of them.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn events(&self, id: Uuid, after: i64) -> Result<Vec<StoredEvent>, StoreError> {
        let rows: Vec<(i64, String, String)> = sqlx::query_as(
            "SELECT seq, name, iif(name = 'done' AND data ->> '$.status' = 'succeeded', \
             json_set(data, '$.summary', json((SELECT summary FROM jobs WHERE id = job_id))), data) \
             FROM events WHERE job_id = ? AND seq > ? ORDER BY seq LIMIT ?",
        )
        .bind(id.to_string())
        .bind(after)
        .bind(integer(PAGE))
        .fetch_all(&self.readers)
        .await?;
        let event = |(seq, name, data)| StoredEvent { seq, name, data };
        let stored: Vec<_> = rows.into_iter().map(event).collect();
        // Numbers have no gaps: the events before were moved to an object.
        let is_whole = stored.first().is_none_or(|first| first.seq == after + 1);
        if is_whole {
            return Ok(stored);
        }
        let mut events = self.moved_events(id).await?;
        events.retain(|event| event.seq > after);
        events.extend(stored);
        events.truncate(PAGE);
        Ok(events)
    }

    /// The events of a job that were moved.
    async fn moved_events(&self, id: Uuid) -> Result<Vec<StoredEvent>, StoreError> {
        let mut connection = self.readers.acquire().await?;
        let stored = StoredBlock::of(&mut connection, id).await?;
        drop(connection);
        let Some((entries, object)) =
            stored.and_then(|stored| Some((stored.entries, stored.object?)))
        else {
            return Ok(Vec::new());
        };
        let block = Block::decode(&entries, &[]);
        let block = block.map_err(|cause| unreadable(id, &cause))?;
        let Some((entry, range)) = block.events() else {
            return Ok(Vec::new());
        };
        let part = object.behind(self.objects.as_ref(), &range)?;
        let bytes = part.read().await?;
        let damaged = |cause: String| StoreError::DamagedResults { id, cause };
        integrity::check_bytes(entry, &bytes)
            .map_err(|cause| damaged(format!("events: {cause}")))?;
        serde_json::from_slice(&decompress(&bytes, LIMIT))
            .map_err(|cause| damaged(format!("events: {cause}")))
    }
}

/// Compresses all events of a job but the last one, which stays.
pub(super) async fn pack_events(
    connection: &mut SqliteConnection,
    id: Uuid,
) -> Result<Vec<u8>, StoreError> {
    let rows: Vec<(i64, String, String)> = sqlx::query_as(
        "SELECT seq, name, data FROM events WHERE job_id = ?1 \
         AND seq < (SELECT last_event FROM jobs WHERE id = ?1) ORDER BY seq",
    )
    .bind(id.to_string())
    .fetch_all(connection)
    .await?;
    let event = |(seq, name, data)| StoredEvent { seq, name, data };
    let events: Vec<_> = rows.into_iter().map(event).collect();
    Ok(compress(&serde_json::to_vec(&events)?))
}
