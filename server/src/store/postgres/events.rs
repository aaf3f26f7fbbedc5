//! Events of jobs. Those before the last one of a job whose results were moved to a store of objects are in its object.

use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::store::postgres::PostgresStore;
use crate::store::{StoreError, StoredEvent, events};

impl PostgresStore {
    pub(in crate::store) async fn events(
        &self,
        id: Uuid,
        after: i64,
    ) -> Result<Vec<StoredEvent>, StoreError> {
        let rows: Vec<(i64, String, String, Option<String>)> = sqlx::query_as(
            "SELECT seq, name, data, CASE WHEN name = 'done' THEN (SELECT summary FROM jobs WHERE id = job_id) END \
             FROM events WHERE job_id = $1 AND seq > $2 ORDER BY seq LIMIT $3",
        )
        .bind(id)
        .bind(after)
        .bind(events::PAGE)
        .fetch_all(&self.pool)
        .await?;
        let stored = rows.into_iter().map(events::with_summary);
        let stored: Vec<_> = stored.collect::<Result<_, _>>()?;
        if events::is_whole(&stored, after) {
            return Ok(stored);
        }
        let moved = match self.stored_block(id).await? {
            None => Vec::new(),
            Some(block) => block.events(id, self.local.objects.as_ref()).await?,
        };
        Ok(events::page(moved, stored, after))
    }
}

/// All events of a job but the last one, which stays.
pub(super) async fn events_to_move(
    connection: &mut PgConnection,
    id: Uuid,
) -> Result<Vec<StoredEvent>, StoreError> {
    let rows: Vec<(i64, String, String)> = sqlx::query_as(
        "SELECT seq, name, data FROM events WHERE job_id = $1 \
         AND seq < (SELECT last_event FROM jobs WHERE id = $1) ORDER BY seq",
    )
    .bind(id)
    .fetch_all(connection)
    .await?;
    let event = |(seq, name, data)| StoredEvent { seq, name, data };
    Ok(rows.into_iter().map(event).collect())
}
