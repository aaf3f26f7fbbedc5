//! Batches with jobs that are queued only when others have been solved.

use api::sweep::RefusedChanges;
use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::store::StoreError;
use crate::store::batches::NewBatchJob;
use crate::store::rows::integer;
use crate::store::sqlite::insertion::insert;

/// Notes combinations of changes that make no valid jobs.
pub(super) async fn insert_refusals(
    connection: &mut SqliteConnection,
    batch: Uuid,
    refusals: &[RefusedChanges],
) -> Result<(), StoreError> {
    for refused in refusals {
        sqlx::query(
            "INSERT INTO refused_jobs (sweep_id, position, overrides, reason) VALUES (?, ?, ?, ?)",
        )
        .bind(batch.to_string())
        .bind(integer(refused.position))
        .bind(serde_json::to_string(&refused.overrides)?)
        .bind(&refused.reason)
        .execute(&mut *connection)
        .await?;
    }
    Ok(())
}

/// Queues jobs of a batch.
pub(super) async fn insert_jobs(
    connection: &mut SqliteConnection,
    batch: Uuid,
    jobs: &[NewBatchJob],
    now: Now,
) -> Result<(), StoreError> {
    for new in jobs {
        let id = insert(connection, &new.job, Some(batch), now).await?;
        sqlx::query(
            "INSERT INTO sweep_jobs (sweep_id, position, job_id, overrides) VALUES (?, ?, ?, ?)",
        )
        .bind(batch.to_string())
        .bind(integer(new.position))
        .bind(id.to_string())
        .bind(serde_json::to_string(&new.overrides)?)
        .execute(&mut *connection)
        .await?;
    }
    Ok(())
}
