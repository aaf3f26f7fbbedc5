//! Submission of batches.

use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::store::batches::NewBatch;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::dialect::stored_id;
use crate::store::sqlite::expansions::insert_jobs;
use crate::store::sqlite::sql::batches::submitted;
use crate::store::sqlite::sql::expansion_rows::insert_expansion;
use crate::store::{RequestKey, StoreError, Submitted};

impl SqliteStore {
    pub(in crate::store) async fn submit_batch(
        &self,
        batch: &NewBatch,
        key: Option<&RequestKey>,
    ) -> Result<Submitted, StoreError> {
        self.process.disk.check()?;
        let (mut transaction, now) = self.begin().await?;
        if let Some(key) = key
            && let Some(earlier) = submitted(&mut *transaction, key).await?
        {
            return Ok(earlier);
        }
        let id = insert_batch(&mut transaction, batch, key, now).await?;
        transaction.commit().await?;
        self.process.many_wait();
        Ok(Submitted::Job(id))
    }
}

async fn insert_batch(
    connection: &mut SqliteConnection,
    batch: &NewBatch,
    key: Option<&RequestKey>,
    now: Now,
) -> Result<Uuid, StoreError> {
    let id = Uuid::now_v7();
    sqlx::query(
        "INSERT INTO sweeps (id, name, base, created_at, request_key, body_sha256, submitted_ms) \
         VALUES (?, ?, ?, ?, ?, ?, (SELECT passed_ms FROM service_time))",
    )
    .bind(stored_id(id))
    .bind(&batch.name)
    .bind(&batch.base)
    .bind(now.system_ms)
    .bind(key.map(|key| &key.key))
    .bind(key.map(|key| key.meaning_sha256.as_slice()))
    .execute(&mut *connection)
    .await?;
    if let Some(plan) = &batch.plan {
        sqlx::query("INSERT INTO studies (sweep_id, plan) VALUES (?, ?)")
            .bind(stored_id(id))
            .bind(plan)
            .execute(&mut *connection)
            .await?;
    }
    if let Some(expansion) = &batch.expansion {
        insert_expansion(connection, id, expansion).await?;
    }
    insert_jobs(connection, id, &batch.jobs, now).await?;
    Ok(id)
}
