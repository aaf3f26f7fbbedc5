//! Updates of held jobs: results, progress, renewed leases, events.

use std::collections::BTreeMap;

use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::store::postgres::new_files::insert_files;
use crate::store::postgres::queries::{NewEvent, insert_events};
use crate::store::postgres::sql::checkpoints;
use crate::store::postgres::sql::results::insert_snapshots;
use crate::store::rows::integer;
use crate::store::{JobUpdate, Lease, StoreError};

/// A lease that is renewed with an update.
#[derive(Debug)]
pub(super) struct Renewal<'a> {
    pub(super) job: Uuid,
    pub(super) update: &'a JobUpdate,
    /// End of the lease.
    pub(super) ends_at: i64,
    /// Number of the last event before the update.
    pub(super) last_event: i64,
}

/// Stores the results of updates of different jobs, whose rows are locked.
pub(super) async fn insert_results(
    connection: &mut PgConnection,
    updates: &[(Lease, &JobUpdate)],
    now: Now,
) -> Result<(), StoreError> {
    insert_rows(connection, updates).await?;
    for (lease, update) in updates {
        insert_snapshots(connection, lease.job, &update.snapshots).await?;
        insert_files(connection, *lease, &update.files).await?;
        if let Some(checkpoint) = &update.checkpoint {
            let object = update.checkpoint_object.as_deref();
            checkpoints::write(connection, *lease, checkpoint, object, now).await?;
        }
    }
    Ok(())
}

/// Stores rows of the history.
async fn insert_rows(
    connection: &mut PgConnection,
    updates: &[(Lease, &JobUpdate)],
) -> Result<(), StoreError> {
    // A statement replaces a row once: of rows of one cycle, the last one counts.
    let mut rows = BTreeMap::new();
    for (lease, update) in updates {
        for row in &update.rows {
            rows.insert((lease.job, integer(row.cycle)), serde_json::to_string(row)?);
        }
    }
    if rows.is_empty() {
        return Ok(());
    }
    let (keys, texts): (Vec<_>, Vec<_>) = rows.into_iter().unzip();
    let (jobs, cycles): (Vec<_>, Vec<_>) = keys.into_iter().unzip();
    sqlx::query(
        "INSERT INTO history_rows (job_id, cycle, data) SELECT * FROM unnest($1::uuid[], $2::bigint[], $3::text[]) \
         ON CONFLICT (job_id, cycle) DO UPDATE SET data = excluded.data",
    )
    .bind(jobs)
    .bind(cycles)
    .bind(texts)
    .execute(connection)
    .await?;
    Ok(())
}

/// Renews leases, notes the progress and appends the events of updates, whose results are stored.
pub(super) async fn renew(
    connection: &mut PgConnection,
    renewals: &[Renewal<'_>],
) -> Result<(), StoreError> {
    if renewals.is_empty() {
        return Ok(());
    }
    let of = |value: fn(&Renewal<'_>) -> i64| renewals.iter().map(value).collect::<Vec<_>>();
    let jobs: Vec<_> = renewals.iter().map(|renewal| renewal.job).collect();
    let progress = renewals
        .iter()
        .map(|renewal| serde_json::to_string(&renewal.update.progress));
    let has_checkpoint = renewals
        .iter()
        .map(|renewal| renewal.update.checkpoint.is_some());
    sqlx::query(
        "UPDATE jobs SET last_write = number, progress = given.progress, lease_expires_at = ends_at, last_event = given.last_event, \
         version = version + 1, fruitless = CASE WHEN has_checkpoint THEN 0 ELSE fruitless END \
         FROM unnest($1::uuid[], $2::bigint[], $3::text[], $4::bigint[], $5::bigint[], $6::boolean[]) \
         AS given (id, number, progress, ends_at, last_event, has_checkpoint) WHERE jobs.id = given.id",
    )
    .bind(jobs)
    .bind(of(|renewal| renewal.update.number))
    .bind(progress.collect::<Result<Vec<_>, _>>()?)
    .bind(of(|renewal| renewal.ends_at))
    .bind(of(|renewal| renewal.last_event + integer(renewal.update.events.len())))
    .bind(has_checkpoint.collect::<Vec<_>>())
    .execute(&mut *connection)
    .await?;
    let events = renewals.iter().flat_map(|renewal| {
        let events = renewal.update.events.iter().zip(renewal.last_event + 1..);
        events.map(|((name, data), seq)| NewEvent {
            job: renewal.job,
            seq,
            name: name.as_str(),
            data,
        })
    });
    insert_events(connection, events.collect()).await
}
