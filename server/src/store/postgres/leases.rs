//! Fenced operations: writes of workers and ends of jobs. The statement that names the lease locks the row of the job until the
//! transaction ends.

use std::collections::BTreeMap;
use std::time::Duration;

use api::job::Status;
use sqlx::postgres::PgConnection;

use crate::queue::Transition;
use crate::store::ending::EndingJob;
use crate::store::postgres::blocks::insert_block;
use crate::store::postgres::files::insert_files;
use crate::store::postgres::queries::insert_attempt_event;
use crate::store::postgres::transitions::end_job;
use crate::store::postgres::{PostgresStore, begin, checkpoints};
use crate::store::rows::integer;
use crate::store::{End, JobUpdate, Lease, LeaseState, StoreError};

impl PostgresStore {
    pub(in crate::store) async fn record(
        &self,
        lease: impl Into<Lease>,
        update: &JobUpdate,
        length: Duration,
    ) -> Result<LeaseState, StoreError> {
        self.local.disk.check()?;
        let lease = lease.into();
        let (mut transaction, now) = self.begin().await?;
        let events = integer(update.events.len());
        let held: Option<(i64, bool)> = sqlx::query_as(
            "UPDATE jobs SET last_write = $1, progress = $2, lease_expires_at = $3, last_event = last_event + $4, version = version + 1, \
             fruitless = CASE WHEN $5 THEN 0 ELSE fruitless END \
             WHERE id = $6 AND lease = $7 AND status = 'running' AND last_write < $1 RETURNING last_event, cancel_requested",
        )
        .bind(update.number)
        .bind(serde_json::to_string(&update.progress)?)
        .bind(now.end_of(length))
        .bind(events)
        .bind(update.checkpoint.is_some())
        .bind(lease.job)
        .bind(lease.number)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some((last_event, cancel_requested)) = held else {
            return self.written_before(&mut transaction, lease).await;
        };
        write_results(&mut transaction, lease, update).await?;
        if let Some(checkpoint) = &update.checkpoint {
            checkpoints::write(&mut transaction, lease, checkpoint, now).await?;
            self.local.metrics.checkpoints.inc();
        }
        write_events(&mut transaction, lease, last_event - events + 1, update).await?;
        transaction.commit().await?;
        self.local.changed(lease.job);
        Ok(LeaseState::Held { cancel_requested })
    }

    /// The state of the lease of a write that had no effect: it is a repeated one, or the lease was lost.
    async fn written_before(
        &self,
        connection: &mut PgConnection,
        lease: Lease,
    ) -> Result<LeaseState, StoreError> {
        let cancel_requested = held(connection, lease).await?;
        Ok(match cancel_requested {
            Some(cancel_requested) => LeaseState::Held { cancel_requested },
            None => self.local.stale_write(),
        })
    }

    pub(in crate::store) async fn renew(
        &self,
        lease: impl Into<Lease>,
        length: Duration,
    ) -> Result<LeaseState, StoreError> {
        let lease = lease.into();
        let (mut transaction, now) = self.begin().await?;
        let cancel_requested = sqlx::query_scalar(
            "UPDATE jobs SET lease_expires_at = $1 WHERE id = $2 AND lease = $3 AND status = 'running' RETURNING cancel_requested",
        )
        .bind(now.end_of(length))
        .bind(lease.job)
        .bind(lease.number)
        .fetch_optional(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(LeaseState::of(cancel_requested))
    }

    pub(in crate::store) async fn heartbeat(
        &self,
        leases: &[Lease],
        length: Duration,
    ) -> Result<Vec<LeaseState>, StoreError> {
        let mut connection = self.pool.acquire().await?;
        let now = self.now(&mut connection).await?;
        let ids: Vec<_> = leases.iter().map(|lease| lease.job).collect();
        let numbers: Vec<_> = leases.iter().map(|lease| lease.number).collect();
        let held: Vec<(i64, bool, i64)> = sqlx::query_as(
            "SELECT n, cancel_requested, lease_expires_at \
             FROM unnest($1::uuid[], $2::bigint[]) WITH ORDINALITY AS given (id, lease, n) \
             JOIN jobs ON jobs.id = given.id AND jobs.lease = given.lease WHERE status = 'running'",
        )
        .bind(&ids)
        .bind(&numbers)
        .fetch_all(&mut *connection)
        .await?;
        let renewed_until = now.end_of(length / 3 * 2);
        if held
            .iter()
            .any(|(.., expires_at)| *expires_at < renewed_until)
        {
            // One that another transaction has locked is renewed by it, or by the next heartbeat.
            sqlx::query(
                "WITH due AS (SELECT jobs.id FROM unnest($1::uuid[], $2::bigint[]) AS given (id, lease) \
                 JOIN jobs ON jobs.id = given.id AND jobs.lease = given.lease \
                 WHERE status = 'running' AND lease_expires_at < $3 FOR UPDATE OF jobs SKIP LOCKED) \
                 UPDATE jobs SET lease_expires_at = $4 FROM due WHERE jobs.id = due.id",
            )
            .bind(&ids)
            .bind(&numbers)
            .bind(renewed_until)
            .bind(now.end_of(length))
            .execute(&mut *connection)
            .await?;
        }
        let mut states = vec![LeaseState::Lost; leases.len()];
        for (n, cancel_requested, _) in held {
            let index = usize::try_from(n - 1).unwrap_or(usize::MAX);
            if let Some(state) = states.get_mut(index) {
                *state = LeaseState::Held { cancel_requested };
            }
        }
        Ok(states)
    }

    pub(in crate::store) async fn lease_state(
        &self,
        lease: impl Into<Lease>,
    ) -> Result<LeaseState, StoreError> {
        let mut connection = self.pool.acquire().await?;
        Ok(LeaseState::of(held(&mut connection, lease.into()).await?))
    }

    pub(in crate::store) async fn restart(
        &self,
        lease: impl Into<Lease>,
        number: i64,
    ) -> Result<LeaseState, StoreError> {
        self.local.disk.check()?;
        let lease = lease.into();
        let mut transaction = begin(&self.pool, None).await?;
        let held: Option<(i64, bool, i64)> = sqlx::query_as(
            "UPDATE jobs SET last_write = $1, last_event = last_event + 1, version = version + 1 \
             WHERE id = $2 AND lease = $3 AND status = 'running' AND last_write < $1 \
             RETURNING last_event, cancel_requested, attempts",
        )
        .bind(number)
        .bind(lease.job)
        .bind(lease.number)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some((event, cancel_requested, attempt)) = held else {
            return self.written_before(&mut transaction, lease).await;
        };
        let attempt = attempt.try_into().unwrap_or_default();
        checkpoints::delete_results_after(&mut transaction, lease.job, None).await?;
        insert_attempt_event(&mut transaction, lease.job, event, attempt, 0).await?;
        transaction.commit().await?;
        self.local.changed(lease.job);
        Ok(LeaseState::Held { cancel_requested })
    }

    pub(in crate::store) async fn end(
        &self,
        lease: impl Into<Lease>,
        update: &JobUpdate,
        end: &End,
    ) -> Result<Option<Status>, StoreError> {
        let lease = lease.into();
        let (mut transaction, now) = self.begin().await?;
        let held: Option<(i64, bool)> = sqlx::query_as(
            "UPDATE jobs SET last_write = $1 WHERE id = $2 AND lease = $3 AND status = 'running' AND last_write < $1 \
             RETURNING fruitless, cancel_requested",
        )
        .bind(update.number)
        .bind(lease.job)
        .bind(lease.number)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some((fruitless, cancel_requested)) = held else {
            return self
                .ended_before(&mut transaction, lease, update.number)
                .await;
        };
        write_results(&mut transaction, lease, update).await?;
        let fruitless = fruitless.try_into().unwrap_or_default();
        let limit = self.local.attempt_limit;
        let job = EndingJob::running(lease.job, fruitless, limit, cancel_requested);
        let progress = serde_json::to_string(&update.progress)?;
        let status = end_job(&mut transaction, &job, end, Some(&progress), now.system_ms).await?;
        if let Some(block) = &update.block {
            let succeeded = status == Some(Status::Succeeded);
            insert_block(&mut transaction, lease.job, block, succeeded).await?;
        }
        transaction.commit().await?;
        self.local.concluded(lease.job, status);
        Ok(status)
    }

    /// The status that a repeated end has led to; `None` if it had no effect because the lease was lost.
    async fn ended_before(
        &self,
        connection: &mut PgConnection,
        lease: Lease,
        number: i64,
    ) -> Result<Option<Status>, StoreError> {
        let status: Option<String> = sqlx::query_scalar(
            "SELECT status FROM jobs WHERE id = $1 AND lease = $2 AND last_write = $3 AND status <> 'running'",
        )
        .bind(lease.job)
        .bind(lease.number)
        .bind(number)
        .fetch_optional(connection)
        .await?;
        if status.is_none() {
            self.local.stale_write();
        }
        Ok(status.as_deref().and_then(Status::from_name))
    }

    pub(in crate::store) async fn is_final(
        &self,
        lease: impl Into<Lease>,
        transition: Transition,
        cancel_requested: bool,
    ) -> Result<bool, StoreError> {
        let lease = lease.into();
        let fruitless: Option<i64> = sqlx::query_scalar("SELECT fruitless FROM jobs WHERE id = $1")
            .bind(lease.job)
            .fetch_optional(&self.pool)
            .await?;
        let fruitless = fruitless.unwrap_or_default().try_into().unwrap_or_default();
        let limit = self.local.attempt_limit;
        let job = EndingJob::running(lease.job, fruitless, limit, cancel_requested);
        Ok(job.after(transition).is_some_and(Status::is_terminal))
    }
}

/// Whether the end of a held job was requested; `None` if the lease was lost.
async fn held(connection: &mut PgConnection, lease: Lease) -> Result<Option<bool>, StoreError> {
    let cancel_requested = sqlx::query_scalar(
        "SELECT cancel_requested FROM jobs WHERE id = $1 AND lease = $2 AND status = 'running'",
    )
    .bind(lease.job)
    .bind(lease.number);
    Ok(cancel_requested.fetch_optional(connection).await?)
}

async fn write_results(
    connection: &mut PgConnection,
    lease: Lease,
    update: &JobUpdate,
) -> Result<(), StoreError> {
    // A statement replaces a row once: of rows of one cycle, the last one counts.
    let mut rows = BTreeMap::new();
    for row in &update.rows {
        rows.insert(integer(row.cycle), serde_json::to_string(row)?);
    }
    if !rows.is_empty() {
        let (cycles, texts): (Vec<_>, Vec<_>) = rows.into_iter().unzip();
        sqlx::query(
            "INSERT INTO history_rows (job_id, cycle, data) SELECT $1, * FROM unnest($2::bigint[], $3::text[]) \
             ON CONFLICT (job_id, cycle) DO UPDATE SET data = excluded.data",
        )
        .bind(lease.job)
        .bind(cycles)
        .bind(texts)
        .execute(&mut *connection)
        .await?;
    }
    for snapshot in &update.snapshots {
        sqlx::query(
            "INSERT INTO snapshots (job_id, cycle, profile, pressure, friction_loop) VALUES ($1, $2, $3, $4, $5) \
             ON CONFLICT (job_id, cycle) DO UPDATE SET profile = excluded.profile, pressure = excluded.pressure, \
             friction_loop = excluded.friction_loop",
        )
        .bind(lease.job)
        .bind(integer(snapshot.profile.cycle))
        .bind(serde_json::to_string(&snapshot.profile)?)
        .bind(serde_json::to_string(&snapshot.pressure)?)
        .bind(serde_json::to_string(&snapshot.friction_loop)?)
        .execute(&mut *connection)
        .await?;
    }
    insert_files(connection, lease, &update.files).await
}

/// Appends the events of an update, numbered from `first`.
async fn write_events(
    connection: &mut PgConnection,
    lease: Lease,
    first: i64,
    update: &JobUpdate,
) -> Result<(), StoreError> {
    if update.events.is_empty() {
        return Ok(());
    }
    let names: Vec<_> = update
        .events
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    let texts: Vec<_> = update
        .events
        .iter()
        .map(|(_, data)| data.as_str())
        .collect();
    sqlx::query(
        "INSERT INTO events (job_id, seq, name, data) SELECT $1, $2 + n - 1, name, data \
         FROM unnest($3::text[], $4::text[]) WITH ORDINALITY AS new (name, data, n)",
    )
    .bind(lease.job)
    .bind(first)
    .bind(names)
    .bind(texts)
    .execute(connection)
    .await?;
    Ok(())
}
