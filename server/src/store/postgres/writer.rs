//! A transaction of writes under leases.

use api::job::Status;
use sqlx::postgres::{PgConnection, PgPool};
use uuid::Uuid;

use crate::clock::Now;
use crate::store::ending::EndingJob;
use crate::store::postgres::begin;
use crate::store::postgres::blocks::{NewBlock, insert_blocks};
use crate::store::postgres::transitions::{JobEnd, end_jobs};
use crate::store::postgres::updates::{Renewal, insert_results, renew};
use crate::store::postgres::write::{LeaseEffect, Written};
use crate::store::process_state::log_lost_writes;
use crate::store::{StoreError, Write, WriteKind};

/// Policy for rows that another transaction has locked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Locked {
    /// Waits for the row.
    Wait,
    /// Skips the job.
    Skip,
}

/// Writes transactions.
#[derive(Debug, Clone)]
pub(super) struct Writer {
    pub(super) pool: PgPool,
    /// The time, if a test sets it.
    pub(super) given: Option<Now>,
    pub(super) attempt_limit: u32,
}

/// A job under its lease, whose row is locked.
#[derive(Debug, Clone, Copy)]
struct Held<'a> {
    write: &'a Write,
    /// Number of the write in its transaction.
    index: usize,
    fruitless: u32,
    cancel_requested: bool,
    last_event: i64,
}

impl Writer {
    /// Writes in one transaction, each of another job. `None` for writes that are left out.
    pub(super) async fn write(
        &self,
        writes: &[&Write],
        locked: Locked,
    ) -> Result<Vec<Option<Written>>, StoreError> {
        let mut transaction = begin(&self.pool, None).await?;
        let (held, now) = lock(&mut transaction, writes, locked).await?;
        let now = self.given.unwrap_or(now);
        let mut written = vec![None; writes.len()];
        if held.len() < writes.len() && locked == Locked::Wait {
            for (index, effect) in effects_before(&mut transaction, writes).await? {
                written[index] = Some(Written::repeated(effect));
            }
        }
        if !held.is_empty() {
            for (held, effect) in held
                .iter()
                .zip(self.write_held(&mut transaction, &held, now).await?)
            {
                written[held.index] = Some(Written {
                    effect,
                    is_repeated: false,
                });
            }
            transaction.commit().await?;
        }
        Ok(written)
    }

    /// Writes to jobs whose rows are locked; returns the effect of each write.
    async fn write_held(
        &self,
        connection: &mut PgConnection,
        held: &[Held<'_>],
        now: Now,
    ) -> Result<Vec<LeaseEffect>, StoreError> {
        let updates: Vec<_> = held
            .iter()
            .map(|held| (held.write.lease, &held.write.update))
            .collect();
        insert_results(connection, &updates, now).await?;
        let (mut renewals, mut ends, mut blocks) = (Vec::new(), Vec::new(), Vec::new());
        let mut effects = Vec::with_capacity(held.len());
        for held in held {
            let Write {
                lease,
                update,
                kind,
            } = held.write;
            let cancel_requested = held.cancel_requested;
            effects.push(match kind {
                WriteKind::Renew(length) => {
                    renewals.push(Renewal {
                        job: lease.job,
                        update,
                        ends_at: now.end_of(*length),
                        last_event: held.last_event,
                    });
                    LeaseEffect::Held { cancel_requested }
                }
                WriteKind::End(end) => {
                    let job = EndingJob::running(
                        lease.job,
                        held.fruitless,
                        self.attempt_limit,
                        cancel_requested,
                    );
                    let end = JobEnd::by_worker(&job, end, update)?;
                    let status = end.as_ref().map(JobEnd::status);
                    blocks.extend(update.block.as_ref().map(|block| NewBlock {
                        job: lease.job,
                        block,
                        succeeded: status == Some(Status::Succeeded),
                    }));
                    ends.extend(end);
                    LeaseEffect::Ended(status)
                }
            });
        }
        renew(connection, &renewals).await?;
        end_jobs(connection, &ends, now).await?;
        insert_blocks(connection, &blocks).await?;
        Ok(effects)
    }
}

/// Locks the rows of the jobs that are held and not written yet, in the order of their ids; and the time.
async fn lock<'a>(
    connection: &mut PgConnection,
    writes: &[&'a Write],
    locked: Locked,
) -> Result<(Vec<Held<'a>>, Now), StoreError> {
    let skipped = match locked {
        Locked::Wait => "",
        Locked::Skip => " SKIP LOCKED",
    };
    let (jobs, leases, numbers) = keys(writes);
    let rows: Vec<(i64, i64, bool, i64, i64)> = sqlx::query_as(sqlx::AssertSqlSafe(format!(
        "SELECT n, fruitless, cancel_requested, last_event, fretwear_now() FROM jobs \
         JOIN unnest($1::uuid[], $2::bigint[], $3::bigint[]) WITH ORDINALITY AS given (id, lease, number, n) \
         ON jobs.id = given.id AND jobs.lease = given.lease WHERE status = 'running' AND last_write = number - 1 \
         ORDER BY jobs.id FOR UPDATE OF jobs{skipped}"
    )))
    .bind(jobs)
    .bind(leases)
    .bind(numbers)
    .fetch_all(connection)
    .await?;
    let now = rows.first().map_or(0, |(.., now)| *now);
    let held = rows
        .into_iter()
        .filter_map(|(n, fruitless, cancel_requested, last_event, _)| {
            let index = usize::try_from(n - 1).ok()?;
            Some(Held {
                write: writes.get(index)?,
                index,
                fruitless: fruitless.try_into().unwrap_or_default(),
                cancel_requested,
                last_event,
            })
        });
    Ok((held.collect(), now.into()))
}

/// Effects of earlier writes of the same numbers; none where the lease was lost, as after a gap in the numbers.
async fn effects_before(
    connection: &mut PgConnection,
    writes: &[&Write],
) -> Result<Vec<(usize, LeaseEffect)>, StoreError> {
    let (jobs, leases, numbers) = keys(writes);
    let rows: Vec<(i64, String, bool, i64)> = sqlx::query_as(
        "SELECT n, status, cancel_requested, last_write FROM jobs \
         JOIN unnest($1::uuid[], $2::bigint[], $3::bigint[]) WITH ORDINALITY AS given (id, lease, number, n) \
         ON jobs.id = given.id AND jobs.lease = given.lease",
    )
    .bind(jobs)
    .bind(leases)
    .bind(numbers)
    .fetch_all(connection)
    .await?;
    let effect = |(n, status, cancel_requested, last): (i64, String, bool, i64)| {
        let index = usize::try_from(n - 1).ok()?;
        let status = Status::from_name(&status)?;
        let write = writes.get(index)?;
        let number = write.update.number;
        let is_running = status == Status::Running;
        if is_running && number > last {
            log_lost_writes(write.lease, number, last);
        }
        let effect = match write.kind {
            WriteKind::Renew(_) if is_running && number <= last => {
                LeaseEffect::Held { cancel_requested }
            }
            WriteKind::End(_) if !is_running && number == last => LeaseEffect::Ended(Some(status)),
            WriteKind::Renew(_) | WriteKind::End(_) => return None,
        };
        Some((index, effect))
    };
    Ok(rows.into_iter().filter_map(effect).collect())
}

/// Jobs, leases and numbers of writes.
fn keys(writes: &[&Write]) -> (Vec<Uuid>, Vec<i64>, Vec<i64>) {
    let jobs = writes.iter().map(|write| write.lease.job);
    let leases = writes.iter().map(|write| write.lease.number);
    let numbers = writes.iter().map(|write| write.update.number);
    (jobs.collect(), leases.collect(), numbers.collect())
}
