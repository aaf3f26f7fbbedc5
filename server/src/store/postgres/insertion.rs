//! Insertion of jobs into the queue.

use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::queue;
use crate::store::new_row::NewRow;
use crate::store::{NewJob, StoreError};

/// Adds jobs to the queue, with their labels and their first events, in one statement; `batch` is the one that they belong to.
pub(super) async fn insert(
    connection: &mut PgConnection,
    new: &[(&NewJob, NewRow)],
    batch: Option<Uuid>,
    now: Now,
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
