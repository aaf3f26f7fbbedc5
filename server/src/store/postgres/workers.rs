//! Remote workers.

use api::worker::RemoteWorker;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::postgres::PostgresStore;
use crate::store::rows::remote_worker;
use crate::store::workers::{WorkerContact, contact_at, present_from, remembered_from};

impl PostgresStore {
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
                .bind(id)
                .execute(&mut *transaction)
                .await?;
                continue;
            };
            sqlx::query(
                "INSERT INTO workers (id, host, slots, memory_mb, free_memory_mb, failing, last_contact_at) VALUES ($1, $2, $3, $4, $5, $6, $7) \
                 ON CONFLICT (id) DO UPDATE SET free_memory_mb = excluded.free_memory_mb, failing = excluded.failing, \
                 last_contact_at = excluded.last_contact_at WHERE excluded.last_contact_at > workers.last_contact_at",
            )
            .bind(id)
            .bind(&offer.host)
            .bind(offer.slots)
            .bind(offer.memory_mb)
            .bind(offer.free_memory_mb)
            .bind(failing)
            .bind(at)
            .execute(&mut *transaction)
            .await?;
        }
        sqlx::query(
            "DELETE FROM workers WHERE id IN \
             (SELECT id FROM workers WHERE last_contact_at < $1 ORDER BY id FOR UPDATE SKIP LOCKED)",
        )
        .bind(remembered_from(now))
        .execute(&mut *transaction)
        .await?;
        Ok(transaction.commit().await?)
    }

    pub(in crate::store) async fn workers(&self) -> Result<Vec<RemoteWorker>, StoreError> {
        let mut connection = self.readers.acquire().await?;
        let now = self.now(&mut connection).await?.monotonic_ms;
        let rows = sqlx::query(
            "SELECT id, host, slots, memory_mb, free_memory_mb, last_contact_at, is_draining::int::bigint AS is_draining, failing, \
             (SELECT count(*) FROM jobs WHERE status = 'running' AND worker = workers.id) AS jobs \
             FROM workers WHERE last_contact_at >= $1 ORDER BY id",
        )
        .bind(present_from(now))
        .fetch_all(&mut *connection)
        .await?;
        rows.iter().map(|row| remote_worker(row, now)).collect()
    }

    pub(in crate::store) async fn draining_workers(&self) -> Result<Vec<Uuid>, StoreError> {
        let draining = sqlx::query_scalar("SELECT id FROM workers WHERE is_draining");
        Ok(draining.fetch_all(&self.readers).await?)
    }

    pub(in crate::store) async fn drain_worker(&self, id: Uuid) -> Result<bool, StoreError> {
        let mut connection = self.pool.acquire().await?;
        let now = self.now(&mut connection).await?.monotonic_ms;
        let drained = sqlx::query(
            "UPDATE workers SET is_draining = true WHERE id = $1 AND last_contact_at >= $2",
        )
        .bind(id)
        .bind(present_from(now))
        .execute(&mut *connection)
        .await?;
        Ok(drained.rows_affected() > 0)
    }
}
