//! Submission of batches.

use uuid::Uuid;

use super::batches::submitted;
use super::dialect::{Connection, EngineStore, stored_id};
use super::expansion_rows::insert_expansion;
use super::expansions::insert_jobs;
use crate::clock::Now;
use crate::store::batches::NewBatch;
use crate::store::job_ids::new_id;
use crate::store::{RequestKey, StoreError, Submitted};

impl EngineStore {
    pub(in crate::store) async fn submit_batch(
        &self,
        batch: &NewBatch,
        key: Option<&RequestKey>,
    ) -> Result<Submitted, StoreError> {
        self.process.disk.check()?;
        let (mut transaction, now) = self.begin().await?;
        let id = new_id(now.system_ms);
        if !insert_batch(&mut transaction, id, batch, key, now).await?
            && let Some(key) = key
        {
            // The transaction of the earlier request has ended: this one has waited for it.
            let earlier = submitted(&mut *transaction, key).await?;
            return earlier.ok_or(StoreError::Unwritten);
        }
        if let Some(expansion) = &batch.expansion {
            insert_expansion(&mut transaction, id, expansion).await?;
        }
        insert_jobs(&mut transaction, id, &batch.jobs, now).await?;
        transaction.commit().await?;
        self.process.many_wait();
        Ok(Submitted::Job(id))
    }
}

/// Adds a batch without its jobs; false if an earlier request with the same key has added one.
async fn insert_batch(
    connection: &mut Connection,
    id: Uuid,
    batch: &NewBatch,
    key: Option<&RequestKey>,
    now: Now,
) -> Result<bool, StoreError> {
    let added = sqlx::query(
        "INSERT INTO sweeps (id, name, base, created_at, request_key, body_sha256, submitted_ms) \
         VALUES ($1, $2, $3, $4, $5, $6, (SELECT passed_ms FROM service_time)) \
         ON CONFLICT (request_key) DO NOTHING",
    )
    .bind(stored_id(id))
    .bind(&batch.name)
    .bind(&batch.base)
    .bind(now.system_ms)
    .bind(key.map(|key| &key.key))
    .bind(key.map(|key| key.meaning_sha256.as_slice()))
    .execute(&mut *connection)
    .await?;
    if let Some(plan) = batch.plan.as_ref().filter(|_| added.rows_affected() > 0) {
        sqlx::query("INSERT INTO studies (sweep_id, plan) VALUES ($1, $2)")
            .bind(stored_id(id))
            .bind(plan)
            .execute(connection)
            .await?;
    }
    Ok(added.rows_affected() > 0)
}
