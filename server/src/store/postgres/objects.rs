//! Statements about objects: their keys, and what leaves the database when an object has it.

use sqlx::Connection;
use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::objects::Objects;
use crate::store::StoreError;
use crate::store::checkpoints::REMOVED_AFTER_MS;
use crate::store::postgres::job_rows::lock;
use crate::store::postgres::open::refuse_standby;
use crate::store::postgres::{PostgresStore, begin};
use crate::store::results_to_move::Moved;

/// Key of the lock of the process that moves results: `frtw` in ASCII.
const MOVER: i64 = 0x6672_7477;

impl PostgresStore {
    pub(in crate::store) async fn address_of_objects(&self) -> Result<Option<String>, StoreError> {
        let stored = sqlx::query_scalar(
            "SELECT address FROM object_store WHERE EXISTS (SELECT 1 FROM result_blocks WHERE object IS NOT NULL) \
             OR EXISTS (SELECT 1 FROM checkpoints WHERE object IS NOT NULL) OR EXISTS (SELECT 1 FROM unnamed_objects)",
        );
        Ok(stored.fetch_optional(&self.pool).await?)
    }

    pub(in crate::store) async fn note_address_of_objects(
        &self,
        address: &str,
    ) -> Result<(), StoreError> {
        let mut transaction = begin(&self.pool, None).await?;
        // Two processes that start together must not write two rows.
        sqlx::query("LOCK TABLE object_store IN EXCLUSIVE MODE")
            .execute(&mut *transaction)
            .await?;
        sqlx::query(
            "WITH updated AS (UPDATE object_store SET address = $1 RETURNING 1) \
             INSERT INTO object_store (address) SELECT $1 WHERE NOT EXISTS (SELECT 1 FROM updated)",
        )
        .bind(address)
        .execute(&mut *transaction)
        .await?;
        Ok(transaction.commit().await?)
    }

    /// The process that holds a lock moves results, as long as its connection lives. Another one may take over while this one still
    /// writes objects: what it is about to remove cannot be named any more.
    pub(in crate::store) async fn moves_results(&self) -> Result<bool, StoreError> {
        let mut mover = self.mover.lock().await;
        let kept = match mover.take() {
            Some((connection, is_mover)) => {
                answering(connection).await.map(|kept| (kept, is_mover))
            }
            None => None,
        };
        let mut connection = match kept {
            Some((connection, true)) => {
                *mover = Some((connection, true));
                return Ok(true);
            }
            Some((connection, false)) => connection,
            None => {
                let mut connection =
                    PgConnection::connect_with(&self.pool.connect_options()).await?;
                refuse_standby(&mut connection).await?;
                connection
            }
        };
        let is_mover: bool = sqlx::query_scalar("SELECT pg_try_advisory_lock($1)")
            .bind(MOVER)
            .fetch_one(&mut connection)
            .await?;
        *mover = Some((connection, is_mover));
        Ok(is_mover)
    }

    pub(in crate::store) async fn movable_jobs(&self, most: i64) -> Result<Vec<Uuid>, StoreError> {
        let jobs = sqlx::query_scalar(
            "SELECT job_id FROM result_blocks WHERE is_movable AND object IS NULL LIMIT $1",
        )
        .bind(most);
        Ok(jobs.fetch_all(&self.pool).await?)
    }

    pub(in crate::store) async fn note_unnamed(
        &self,
        keyed: &[(Uuid, String)],
    ) -> Result<(), StoreError> {
        let keys: Vec<_> = keyed.iter().map(|(_, key)| key.as_str()).collect();
        sqlx::query("INSERT INTO unnamed_objects (key) SELECT * FROM unnest($1::text[])")
            .bind(keys)
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    pub(in crate::store) async fn take_unnamed(
        &self,
        most: i64,
    ) -> Result<Vec<String>, StoreError> {
        let keys = sqlx::query_scalar(
            "UPDATE unnamed_objects SET is_removing = true WHERE key IN \
             (SELECT key FROM unnamed_objects WHERE noted_at <= fretwear_now() - $1 LIMIT $2) RETURNING key",
        )
        .bind(REMOVED_AFTER_MS)
        .bind(most);
        Ok(keys.fetch_all(&self.pool).await?)
    }

    pub(in crate::store) async fn forget_unnamed(&self, keys: &[String]) -> Result<(), StoreError> {
        sqlx::query("DELETE FROM unnamed_objects WHERE key = ANY($1)")
            .bind(keys)
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    pub(in crate::store) async fn keep_results(&self, id: Uuid) -> Result<(), StoreError> {
        sqlx::query("UPDATE result_blocks SET is_movable = false WHERE job_id = $1")
            .bind(id)
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    pub(in crate::store) async fn name_objects(
        &self,
        moved: &[Moved],
    ) -> Result<Vec<Uuid>, StoreError> {
        let mut named = Vec::with_capacity(moved.len());
        for results in moved {
            match self.name_object(results).await {
                Ok(true) => named.push(results.id),
                Ok(false) => {}
                // What is named stays so; the others are moved another time.
                Err(error) if !named.is_empty() => {
                    tracing::warn!(%error, "results of a job were not moved");
                    return Ok(named);
                }
                Err(error) => return Err(error),
            }
        }
        Ok(named)
    }

    /// Names an object; false if the results are not those any more that it has, or if the object is being removed.
    async fn name_object(&self, moved: &Moved) -> Result<bool, StoreError> {
        let mut transaction = begin(&self.pool, None).await?;
        lock(&mut transaction, moved.id).await?;
        let noted = sqlx::query("DELETE FROM unnamed_objects WHERE key = $1 AND NOT is_removing")
            .bind(&moved.key)
            .execute(&mut *transaction)
            .await?;
        if noted.rows_affected() == 0 {
            // Another process has taken it for one that is left; it may have been written after its removal.
            sqlx::query("INSERT INTO unnamed_objects (key) VALUES ($1) ON CONFLICT DO NOTHING")
                .bind(&moved.key)
                .execute(&mut *transaction)
                .await?;
            transaction.commit().await?;
            return Ok(false);
        }
        let address = self.local.objects.as_ref().map(Objects::location);
        let updated = sqlx::query(
            "UPDATE result_blocks SET content = '', object = $1, content_bytes = $2, entries = $3, documents = $4 \
             WHERE job_id = $5 AND entries = $6 AND is_movable AND object IS NULL \
             AND EXISTS (SELECT 1 FROM object_store WHERE address = $7)",
        )
        .bind(&moved.key)
        .bind(moved.content_bytes)
        .bind(&moved.entries.1)
        .bind(&moved.documents)
        .bind(moved.id)
        .bind(&moved.entries.0)
        .bind(address)
        .execute(&mut *transaction)
        .await?;
        if updated.rows_affected() == 0 {
            return Ok(false);
        }
        sqlx::query(
            "WITH texts AS (UPDATE jobs SET spec = $2, plan = 'null' WHERE id = $1), \
             files AS (DELETE FROM result_files WHERE job_id = $1 AND place IS NOT NULL) \
             DELETE FROM events WHERE job_id = $1 AND seq < (SELECT last_event FROM jobs WHERE id = $1)",
        )
        .bind(moved.id)
        .bind(&moved.listed)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(true)
    }
}

/// A connection if it still answers.
async fn answering(mut connection: PgConnection) -> Option<PgConnection> {
    connection.ping().await.is_ok().then_some(connection)
}
