//! Statements about one job within a transaction.

use api::job::Status;
use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::queue;
use crate::queue::Transition;
use crate::store::ending::{EndingJob, retried};
use crate::store::new_row::NewRow;
use crate::store::postgres::queries::insert_event;
use crate::store::postgres::transitions::end_job;
use crate::store::rows::status;
use crate::store::{Cancelled, End, NewJob, Retried, StoreError};

/// Locks the row of a job and returns its status; `None` if there is no such job.
pub(super) async fn lock(
    connection: &mut PgConnection,
    id: Uuid,
) -> Result<Option<Status>, StoreError> {
    let row = sqlx::query("SELECT status FROM jobs WHERE id = $1 FOR UPDATE")
        .bind(id)
        .fetch_optional(connection)
        .await?;
    row.map(|row| status(id, &row)).transpose()
}

/// Requests the end of a job, within a transaction.
pub(super) async fn cancel(
    connection: &mut PgConnection,
    id: Uuid,
    now: Now,
) -> Result<Option<Cancelled>, StoreError> {
    Ok(match lock(connection, id).await? {
        Some(Status::Queued) => {
            let end = End::without_result(Transition::Cancel, "cancelled while waiting");
            let job = EndingJob::queued(id, true);
            end_job(connection, &job, &end, now).await?;
            Some(Cancelled::AtOnce)
        }
        Some(Status::Running) => {
            sqlx::query(
                "UPDATE jobs SET cancel_requested = true, status_reason = 'cancel requested', version = version + 1 WHERE id = $1",
            )
            .bind(id)
            .execute(connection)
            .await?;
            Some(Cancelled::Requested)
        }
        Some(_) => Some(Cancelled::Already),
        None => None,
    })
}

/// Queues a failed or cancelled job again, within a transaction.
pub(super) async fn retry(
    connection: &mut PgConnection,
    id: Uuid,
    now: Now,
) -> Result<Option<Retried>, StoreError> {
    let Some(status) = lock(connection, id).await? else {
        return Ok(None);
    };
    let queued = match retried(status) {
        Ok(queued) => queued,
        Err(effect) => return Ok(Some(effect)),
    };
    let (seq, progress): (i64, String) = sqlx::query_as(
        "UPDATE jobs SET status = $1, status_reason = $2, outcome = NULL, summary = NULL, finished_at = NULL, \
         cancel_requested = false, fruitless = 0, deadline_at = deadline_at - queued_at + $3, queued_at = $3, \
         last_event = last_event + 1, version = version + 1 WHERE id = $4 RETURNING last_event, progress",
    )
    .bind(queued.as_str())
    .bind(queue::WAITING_FOR_WORKER)
    .bind(now.monotonic_ms)
    .bind(id)
    .fetch_one(&mut *connection)
    .await?;
    insert_event(connection, id, seq, "progress", &progress).await?;
    Ok(Some(Retried::Queued))
}

/// Adds jobs to the queue, with their labels and their first events, in one statement; `batch` is the one that they belong to.
pub(super) async fn insert(
    connection: &mut PgConnection,
    new: &[(&NewJob, NewRow)],
    (batch, now): (Option<Uuid>, Now),
) -> Result<(), StoreError> {
    fn each<'a, T>(new: &'a [(&NewJob, NewRow)], value: impl Fn(&'a NewRow) -> T) -> Vec<T> {
        new.iter().map(|(_, row)| value(row)).collect()
    }
    let priorities = new.iter().map(|(job, _)| i64::from(job.options.priority));
    let labels = new.iter().flat_map(|(job, row)| {
        let labels = job.spec.labels.iter();
        labels.map(|(key, value)| (row.id, (&key[..], &value[..])))
    });
    let sent = new.iter().map(|(job, _)| &job.sent[..]);
    let (labelled, labels): (Vec<Uuid>, Vec<_>) = labels.unzip();
    let (keys, values): (Vec<&str>, Vec<&str>) = labels.into_iter().unzip();
    sqlx::query(
        "WITH new AS (SELECT * FROM unnest($1::uuid[], $2::text[], $3::text[], $4::text[], $5::text[], $6::bigint[], $7::bigint[], \
         $8::bigint[], $9::bigint[], $10::bigint[]) \
         AS new (id, system, spec, plan, progress, priority, place, deadline_at, memory_mb, cpu_ms)), \
         added AS (INSERT INTO jobs (id, system, spec, plan, status, status_reason, created_at, progress, last_event, priority, \
         place, deadline_at, memory_mb, cpu_ms, queued_at, sweep_id) \
         SELECT id, system, spec, plan, 'queued', $11, $12, progress, 1, priority, place, deadline_at, memory_mb, cpu_ms, $13, $14 \
         FROM new), \
         labelled AS (INSERT INTO labels (job_id, key, value) SELECT * FROM unnest($15::uuid[], $16::text[], $17::text[])), \
         sent AS (INSERT INTO sent_specifications (job_id, spec) SELECT * FROM unnest($1::uuid[], $18::text[])) \
         INSERT INTO events (job_id, seq, name, data) SELECT id, 1, 'progress', progress FROM new",
    )
    .bind(each(new, |row| row.id))
    .bind(each(new, |row| row.system))
    .bind(each(new, |row| &row.spec[..]))
    .bind(each(new, |row| &row.plan[..]))
    .bind(each(new, |row| &row.progress[..]))
    .bind(priorities.collect::<Vec<_>>())
    .bind(each(new, |row| row.place))
    .bind(each(new, |row| row.deadline_at))
    .bind(each(new, |row| row.memory_mb))
    .bind(each(new, |row| row.cpu_ms))
    .bind(queue::WAITING_FOR_WORKER)
    .bind(now.system_ms)
    .bind(now.monotonic_ms)
    .bind(batch)
    .bind(labelled)
    .bind(keys)
    .bind(values)
    .bind(sent.collect::<Vec<_>>())
    .execute(connection)
    .await?;
    Ok(())
}
