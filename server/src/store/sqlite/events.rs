//! Events of a job, in order.

use uuid::Uuid;

use crate::store::{Store, StoreError};

/// Events fetched at once while a stream catches up.
const PAGE: i64 = 500;

/// An event as it was stored.
#[derive(Debug, Clone, PartialEq, Eq, sqlx::FromRow)]
pub struct StoredEvent {
    /// Its number within the job, from 1 without gaps.
    pub seq: i64,
    /// Its name.
    pub name: String,
    /// Its document, JSON.
    pub data: String,
}

impl Store {
    /// The next events of a job after number `after`, oldest first; at most a page of them.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn events(&self, id: Uuid, after: i64) -> Result<Vec<StoredEvent>, StoreError> {
        let events = sqlx::query_as(
            "SELECT seq, name, data FROM events WHERE job_id = ? AND seq > ? ORDER BY seq LIMIT ?",
        )
        .bind(id.to_string())
        .bind(after)
        .bind(PAGE)
        .fetch_all(&self.readers)
        .await?;
        Ok(events)
    }
}
