//! Remote workers.

use api::worker::RemoteWorker;
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::store::StoreError;
use crate::store::rows::remote_worker;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::queries::BEGIN;
use crate::store::workers::{WorkerContact, contact_at, present_from, remembered_from};

impl SqliteStore {
    pub(in crate::store) async fn note_workers(
        &self,
        contacts: &[WorkerContact],
    ) -> Result<(), StoreError> {
        let now = self.local.clock.now().monotonic_ms;
        let mut transaction = self.writer.begin_with(BEGIN).await?;
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
                    "UPDATE workers SET last_contact_at = ?1, failing = ?2 WHERE id = ?3 AND last_contact_at < ?1",
                )
                .bind(at)
                .bind(failing)
                .bind(id.to_string())
                .execute(&mut *transaction)
                .await?;
                continue;
            };
            sqlx::query(
                "INSERT INTO workers (id, host, slots, memory_mb, free_memory_mb, failing, last_contact_at) VALUES (?, ?, ?, ?, ?, ?, ?) \
                 ON CONFLICT (id) DO UPDATE SET free_memory_mb = excluded.free_memory_mb, failing = excluded.failing, \
                 last_contact_at = excluded.last_contact_at WHERE excluded.last_contact_at > workers.last_contact_at",
            )
            .bind(id.to_string())
            .bind(&offer.host)
            .bind(offer.slots)
            .bind(offer.memory_mb)
            .bind(offer.free_memory_mb)
            .bind(failing)
            .bind(at)
            .execute(&mut *transaction)
            .await?;
        }
        sqlx::query("DELETE FROM workers WHERE last_contact_at < ?")
            .bind(remembered_from(now))
            .execute(&mut *transaction)
            .await?;
        Ok(transaction.commit().await?)
    }

    pub(in crate::store) async fn workers(&self) -> Result<Vec<RemoteWorker>, StoreError> {
        let now = self.local.clock.now().monotonic_ms;
        let rows = sqlx::query(
            "SELECT id, host, slots, memory_mb, free_memory_mb, last_contact_at, is_draining, failing, \
             (SELECT count(*) FROM jobs INDEXED BY jobs_by_claim WHERE status = 'running' AND worker = workers.id) AS jobs \
             FROM workers WHERE last_contact_at >= ? ORDER BY id",
        )
        .bind(present_from(now))
        .fetch_all(&self.readers)
        .await?;
        rows.iter().map(|row| remote_worker(row, now)).collect()
    }

    pub(in crate::store) async fn draining_workers(&self) -> Result<Vec<Uuid>, StoreError> {
        let draining: Vec<Hyphenated> =
            sqlx::query_scalar("SELECT id FROM workers WHERE is_draining")
                .fetch_all(&self.readers)
                .await?;
        Ok(draining.into_iter().map(Uuid::from).collect())
    }

    pub(in crate::store) async fn drain_worker(&self, id: Uuid) -> Result<bool, StoreError> {
        let from = present_from(self.local.clock.now().monotonic_ms);
        let write = async || {
            let drained = sqlx::query(
                "UPDATE workers SET is_draining = 1 WHERE id = ? AND last_contact_at >= ?",
            )
            .bind(id.to_string())
            .bind(from)
            .execute(&self.writer)
            .await?;
            Ok(drained.rows_affected() > 0)
        };
        self.local.disk.with_reserve(write).await
    }
}
