//! Rows of events.

use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::store::sqlite::SqliteStore;
use crate::store::{StoreError, StoredEvent, events};

impl SqliteStore {
    pub(in crate::store) async fn event_rows(
        &self,
        id: Uuid,
        after: i64,
    ) -> Result<Vec<StoredEvent>, StoreError> {
        let rows: Vec<(i64, String, String, Option<String>)> = sqlx::query_as(
            "SELECT seq, name, data, iif(name = 'done', (SELECT summary FROM jobs WHERE id = job_id), NULL) \
             FROM events WHERE job_id = ? AND seq > ? ORDER BY seq LIMIT ?",
        )
        .bind(id.to_string())
        .bind(after)
        .bind(events::PAGE)
        .fetch_all(&self.readers)
        .await?;
        let stored = rows.into_iter().map(events::with_summary);
        stored.collect()
    }
}

/// All events of a job but the last one, which stays.
pub(super) async fn events_to_move(
    connection: &mut SqliteConnection,
    id: Uuid,
) -> Result<Vec<StoredEvent>, StoreError> {
    let rows: Vec<(i64, String, String)> = sqlx::query_as(
        "SELECT seq, name, data FROM events WHERE job_id = ?1 \
         AND seq < (SELECT last_event FROM jobs WHERE id = ?1) ORDER BY seq",
    )
    .bind(id.to_string())
    .fetch_all(connection)
    .await?;
    let event = |(seq, name, data)| StoredEvent { seq, name, data };
    Ok(rows.into_iter().map(event).collect())
}
