//! Rows of events.

use uuid::Uuid;

use super::dialect::{EngineStore, stored_id};
use crate::store::{StoreError, StoredEvent, events};

impl EngineStore {
    pub(in crate::store) async fn event_rows(
        &self,
        id: Uuid,
        after: i64,
    ) -> Result<Vec<StoredEvent>, StoreError> {
        let rows: Vec<(i64, String, String, Option<String>)> = sqlx::query_as(
            "SELECT seq, name, data, CASE WHEN name = 'done' THEN (SELECT summary FROM jobs WHERE id = job_id) END \
             FROM events WHERE job_id = $1 AND seq > $2 ORDER BY seq LIMIT $3",
        )
        .bind(stored_id(id))
        .bind(after)
        .bind(events::PAGE)
        .fetch_all(&self.readers)
        .await?;
        let stored = rows.into_iter().map(events::with_summary);
        stored.collect()
    }
}
