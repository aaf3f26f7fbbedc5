//! Batches with jobs that are queued only when others have been solved.

use api::sweep::RefusedChanges;
use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::store::StoreError;
use crate::store::batches::NewBatchJob;
use crate::store::job_ids::new_id;
use crate::store::new_row::NewRow;
use crate::store::postgres::insertion::insert;
use crate::store::rows::integer;

/// Jobs that a statement adds: their specifications, of up to a megabyte each, are in memory. Arbitrary.
const ROWS: usize = 32;

/// Notes combinations of changes that make no valid jobs.
pub(super) async fn insert_refusals(
    connection: &mut PgConnection,
    batch: Uuid,
    refusals: &[RefusedChanges],
) -> Result<(), StoreError> {
    let (mut positions, mut overrides, mut reasons) = (Vec::new(), Vec::new(), Vec::new());
    for refused in refusals {
        positions.push(integer(refused.position));
        overrides.push(serde_json::to_string(&refused.overrides)?);
        reasons.push(refused.reason.as_str());
    }
    sqlx::query(
        "INSERT INTO refused_jobs (sweep_id, position, overrides, reason) \
         SELECT $1, * FROM unnest($2::bigint[], $3::text[], $4::text[])",
    )
    .bind(batch)
    .bind(positions)
    .bind(overrides)
    .bind(reasons)
    .execute(connection)
    .await?;
    Ok(())
}

/// Queues jobs of a batch.
pub(super) async fn insert_jobs(
    connection: &mut PgConnection,
    batch: Uuid,
    new: &[NewBatchJob],
    now: Now,
) -> Result<(), StoreError> {
    let mut ids = Vec::with_capacity(new.len());
    for new in new.chunks(ROWS) {
        let rows = new.iter().map(|NewBatchJob { job, .. }| {
            let row = NewRow::of(job, new_id(now.system_ms), now)?;
            Ok((job, row))
        });
        let rows: Vec<_> = rows.collect::<Result<_, StoreError>>()?;
        insert(&mut *connection, &rows, Some(batch), now).await?;
        ids.extend(rows.iter().map(|(_, row)| row.id));
    }
    let positions = new.iter().map(|new| integer(new.position));
    let overrides = new.iter().map(|new| serde_json::to_string(&new.overrides));
    sqlx::query(
        "INSERT INTO sweep_jobs (sweep_id, position, job_id, overrides) \
         SELECT $1, * FROM unnest($2::bigint[], $3::uuid[], $4::text[])",
    )
    .bind(batch)
    .bind(positions.collect::<Vec<_>>())
    .bind(ids)
    .bind(overrides.collect::<Result<Vec<_>, _>>()?)
    .execute(connection)
    .await?;
    Ok(())
}
