//! Events of jobs.

use uuid::Uuid;

use crate::store::{Store, StoreError, StoredEvent};

/// Largest number of events in an answer.
const PAGE_LIMIT: i64 = 500;

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
        .bind(PAGE_LIMIT)
        .fetch_all(&self.readers)
        .await?;
        let event = |(seq, name, data)| StoredEvent { seq, name, data };
        Ok(rows.into_iter().map(event).collect())
    }
}
