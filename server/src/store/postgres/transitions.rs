//! Transitions to an end, or back into the queue.

use std::collections::HashMap;

use api::job::Status;
use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::store::candidates::left_until;
use crate::store::ending::{Ending, EndingJob};
use crate::store::postgres::queries::{NewEvent, insert_events};
use crate::store::{End, JobUpdate, StoreError};

/// The end of a job, or its return to the queue.
pub(super) struct JobEnd {
    job: Uuid,
    before: Status,
    cancel_requested: bool,
    ending: Ending,
    /// Number of its last write and its progress, if its worker ends it.
    last: Option<(i64, String)>,
}

impl JobEnd {
    /// `None` if the transition is not allowed.
    fn of(job: &EndingJob, end: &End) -> Result<Option<Self>, StoreError> {
        let ending = job.ending(end)?;
        Ok(ending.map(|ending| Self {
            job: job.id,
            before: job.status,
            cancel_requested: job.cancel_requested,
            ending,
            last: None,
        }))
    }

    /// With the last update of its worker; `None` if the transition is not allowed.
    pub(super) fn by_worker(
        job: &EndingJob,
        end: &End,
        update: &JobUpdate,
    ) -> Result<Option<Self>, StoreError> {
        let last = (update.number, serde_json::to_string(&update.progress)?);
        let end = Self::of(job, end)?;
        Ok(end.map(|end| Self {
            last: Some(last),
            ..end
        }))
    }

    /// The status of the job after it.
    pub(super) fn status(&self) -> Status {
        self.ending.status
    }
}

/// Ends a job, whose row the transaction has locked, or returns it to the queue; `None` if the transition is not allowed.
pub(super) async fn end_job(
    connection: &mut PgConnection,
    job: &EndingJob,
    end: &End,
    now: Now,
) -> Result<Option<Status>, StoreError> {
    let end = JobEnd::of(job, end)?;
    end_jobs(connection, end.as_slice(), now).await?;
    Ok(end.as_ref().map(JobEnd::status))
}

/// Ends jobs, whose rows the transaction has locked, or returns them to the queue.
pub(super) async fn end_jobs(
    connection: &mut PgConnection,
    ends: &[JobEnd],
    now: Now,
) -> Result<(), StoreError> {
    if ends.is_empty() {
        return Ok(());
    }
    let seqs = update_jobs(connection, ends, now).await?;
    let done = ends.iter().filter_map(|end| {
        Some(NewEvent {
            job: end.job,
            seq: *seqs.get(&end.job)?,
            name: "done",
            data: end.ending.done.as_ref()?,
        })
    });
    insert_events(connection, done.collect()).await?;
    // Other ends may be followed by another try.
    let succeeded = ends.iter().filter(|end| end.status() == Status::Succeeded);
    let succeeded: Vec<_> = succeeded.map(|end| end.job).collect();
    if !succeeded.is_empty() {
        sqlx::query("DELETE FROM checkpoints WHERE job_id = ANY($1)")
            .bind(succeeded)
            .execute(connection)
            .await?;
    }
    Ok(())
}

/// Updates the rows of jobs that end or return to the queue; the number of the last event of each.
async fn update_jobs(
    connection: &mut PgConnection,
    ends: &[JobEnd],
    now: Now,
) -> Result<HashMap<Uuid, i64>, StoreError> {
    fn each<'a, T>(ends: &'a [JobEnd], value: impl Fn(&'a JobEnd) -> T) -> Vec<T> {
        ends.iter().map(value).collect()
    }
    let is_terminal = |end: &JobEnd| end.status().is_terminal();
    let updated: Vec<(Uuid, i64)> = sqlx::query_as(
        "UPDATE jobs SET status = given.status, status_reason = reason, outcome = given.outcome, summary = given.summary, \
         cancel_requested = requested, lease_expires_at = NULL, finished_at = given.finished_at, \
         ended_ms = (SELECT passed_ms FROM service_time), \
         progress = COALESCE(given.progress, jobs.progress), last_write = COALESCE(number, last_write), \
         attempts = attempts - released::int, fruitless = GREATEST(fruitless - released::int, 0), \
         last_event = last_event + ended::int, version = version + 1, \
         avoided_worker = CASE WHEN is_left THEN worker END, avoided_until = CASE WHEN is_left THEN $14 END \
         FROM unnest($1::uuid[], $2::text[], $3::text[], $4::text[], $5::text[], $6::text[], $7::boolean[], $8::bigint[], $9::text[], \
         $10::bigint[], $11::boolean[], $12::boolean[], $13::boolean[]) \
         AS given (id, before, status, reason, outcome, summary, requested, finished_at, progress, number, released, ended, is_left) \
         WHERE jobs.id = given.id AND jobs.status = before RETURNING jobs.id, last_event",
    )
    .bind(each(ends, |end| end.job))
    .bind(each(ends, |end| end.before.as_str()))
    .bind(each(ends, |end| end.status().as_str()))
    .bind(each(ends, |end| end.ending.status_reason.as_deref()))
    .bind(each(ends, |end| end.ending.outcome))
    .bind(each(ends, |end| end.ending.summary.as_deref()))
    .bind(each(ends, |end| end.cancel_requested))
    .bind(each(ends, |end| is_terminal(end).then_some(now.system_ms)))
    .bind(each(ends, |end| end.last.as_ref().map(|(_, progress)| progress.as_str())))
    .bind(each(ends, |end| end.last.as_ref().map(|(number, _)| *number)))
    .bind(each(ends, |end| end.ending.is_released))
    .bind(each(ends, is_terminal))
    .bind(each(ends, |end| end.ending.is_left))
    .bind(left_until(now))
    .fetch_all(connection)
    .await?;
    if updated.len() != ends.len() {
        return Err(sqlx::Error::RowNotFound.into());
    }
    Ok(updated.into_iter().collect())
}
