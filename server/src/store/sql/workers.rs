//! Remote workers.

use api::worker::RemoteWorker;
use sqlx::AssertSqlSafe;
use uuid::Uuid;

use super::dialect::{
    BY_CLAIM, Connection, EngineStore, SKIP_LOCKED, StoredId, read_id, stored_id,
};
use crate::clock::Now;
use crate::store::StoreError;
use crate::store::rows::remote_worker;
use crate::store::workers::{WorkerContact, contact_at, present_from, remembered_from};

impl EngineStore {
    pub(in crate::store) async fn note_workers(
        &self,
        contacts: &[WorkerContact],
    ) -> Result<(), StoreError> {
        let (mut transaction, now) = self.begin().await?;
        let now = now.monotonic_ms;
        // In one order, because several services note the same processes.
        let mut contacts: Vec<_> = contacts.iter().collect();
        contacts.sort_by_key(|contact| contact.id);
        for WorkerContact {
            id,
            offer,
            failing,
            ago,
        } in contacts
        {
            let at = contact_at(now, *ago);
            let Some(offer) = offer else {
                sqlx::query(
                    "UPDATE workers SET last_contact_at = $1, failing = $2 WHERE id = $3 AND last_contact_at < $1",
                )
                .bind(at)
                .bind(failing)
                .bind(stored_id(*id))
                .execute(&mut *transaction)
                .await?;
                continue;
            };
            sqlx::query(
                "INSERT INTO workers (id, host, slots, memory_mb, free_memory_mb, failing, last_contact_at) VALUES ($1, $2, $3, $4, $5, $6, $7) \
                 ON CONFLICT (id) DO UPDATE SET free_memory_mb = excluded.free_memory_mb, failing = excluded.failing, \
                 last_contact_at = excluded.last_contact_at WHERE excluded.last_contact_at > workers.last_contact_at",
            )
            .bind(stored_id(*id))
            .bind(&offer.host)
            .bind(offer.slots)
            .bind(offer.memory_mb)
            .bind(offer.free_memory_mb)
            .bind(failing)
            .bind(at)
            .execute(&mut *transaction)
            .await?;
        }
        let statement = format!(
            "DELETE FROM workers WHERE id IN (SELECT id FROM workers WHERE last_contact_at < $1 ORDER BY id{SKIP_LOCKED})"
        );
        sqlx::query(AssertSqlSafe(statement))
            .bind(remembered_from(now))
            .execute(&mut *transaction)
            .await?;
        Ok(transaction.commit().await?)
    }

    pub(in crate::store) async fn workers(&self) -> Result<Vec<RemoteWorker>, StoreError> {
        let (mut connection, now) = self.read().await?;
        let now = now.monotonic_ms;
        let statement = format!(
            "SELECT id, host, slots, memory_mb, free_memory_mb, last_contact_at, failing, \
             CAST(CASE WHEN is_draining THEN 1 ELSE 0 END AS bigint) AS is_draining, \
             (SELECT count(*) FROM jobs{BY_CLAIM} WHERE status = 'running' AND worker = workers.id) AS jobs \
             FROM workers WHERE last_contact_at >= $1 ORDER BY id"
        );
        let rows = sqlx::query(AssertSqlSafe(statement))
            .bind(present_from(now))
            .fetch_all(&mut *connection)
            .await?;
        rows.iter().map(|row| remote_worker(row, now)).collect()
    }

    pub(in crate::store) async fn draining_workers(&self) -> Result<Vec<Uuid>, StoreError> {
        let draining: Vec<StoredId> =
            sqlx::query_scalar("SELECT id FROM workers WHERE is_draining")
                .fetch_all(&self.readers)
                .await?;
        Ok(draining.into_iter().map(read_id).collect())
    }

    pub(in crate::store) async fn drain_worker(&self, id: Uuid) -> Result<bool, StoreError> {
        let write = async || {
            let (mut transaction, now) = self.begin().await?;
            let drained = sqlx::query(
                "UPDATE workers SET is_draining = true WHERE id = $1 AND last_contact_at >= $2",
            )
            .bind(stored_id(id))
            .bind(present_from(now.monotonic_ms))
            .execute(&mut *transaction)
            .await?;
            transaction.commit().await?;
            Ok(drained.rows_affected() > 0)
        };
        self.with_reserve(write).await
    }
}

/// Remote workers that are there and start solves.
pub(in super::super) async fn able_workers(
    connection: &mut Connection,
    now: Now,
) -> Result<Vec<Uuid>, StoreError> {
    let ids: Vec<StoredId> = sqlx::query_scalar(
        "SELECT id FROM workers WHERE last_contact_at >= $1 AND NOT is_draining AND failing IS NULL",
    )
    .bind(present_from(now.monotonic_ms))
    .fetch_all(connection)
    .await?;
    Ok(ids.into_iter().map(read_id).collect())
}
