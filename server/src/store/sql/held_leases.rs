//! Leases: their state, their renewal, and the restart of a job under one.

use std::time::Duration;

use api::job::Status;
use sqlx::AssertSqlSafe;

use super::attempts::insert_attempt_event;
use super::checkpoint_objects::delete_results_after;
use super::dialect::{Connection, EngineStore, GREATEST, stored_id};
use crate::queue::Transition;
use crate::store::ending::EndingJob;
use crate::store::{Lease, LeaseState, StoreError};

impl EngineStore {
    pub(in crate::store) async fn renew(
        &self,
        lease: impl Into<Lease>,
        length: Duration,
    ) -> Result<LeaseState, StoreError> {
        let lease = lease.into();
        let write = async || {
            let (mut transaction, now) = self.begin().await?;
            let cancel_requested = sqlx::query_scalar(
                "UPDATE jobs SET lease_expires_at = $1 WHERE id = $2 AND lease = $3 AND status = 'running' RETURNING cancel_requested",
            )
            .bind(now.end_of(length))
            .bind(stored_id(lease.job))
            .bind(lease.number)
            .fetch_optional(&mut *transaction)
            .await?;
            transaction.commit().await?;
            Ok(LeaseState::of(cancel_requested))
        };
        self.with_reserve(write).await
    }

    pub(in crate::store) async fn lease_state(
        &self,
        lease: impl Into<Lease>,
    ) -> Result<LeaseState, StoreError> {
        let mut connection = self.priority_readers().acquire().await?;
        let held = held(&mut connection, lease.into()).await?;
        Ok(LeaseState::of(
            held.map(|(_, cancel_requested)| cancel_requested),
        ))
    }

    pub(in crate::store) async fn restart(
        &self,
        lease: impl Into<Lease>,
        number: i64,
    ) -> Result<LeaseState, StoreError> {
        self.process.disk.check()?;
        let lease = lease.into();
        let (mut transaction, _) = self.begin().await?;
        let statement = format!(
            "UPDATE jobs SET last_write = $1, last_event = last_event + 1, version = version + 1, fruitless = {GREATEST}(fruitless, 1) \
             WHERE id = $2 AND lease = $3 AND status = 'running' AND last_write < $1 \
             RETURNING last_event, cancel_requested, attempts"
        );
        let restarted: Option<(i64, bool, i64)> = sqlx::query_as(AssertSqlSafe(statement))
            .bind(number)
            .bind(stored_id(lease.job))
            .bind(lease.number)
            .fetch_optional(&mut *transaction)
            .await?;
        let Some((event, cancel_requested, attempt)) = restarted else {
            let held = held(&mut transaction, lease).await?;
            return Ok(self.process.written_before(lease, number, held));
        };
        let attempt = attempt.try_into().unwrap_or_default();
        delete_results_after(&mut transaction, lease.job, None).await?;
        insert_attempt_event(&mut transaction, lease.job, event, attempt, 0).await?;
        transaction.commit().await?;
        self.process.changed(lease.job);
        Ok(LeaseState::Held { cancel_requested })
    }

    pub(in crate::store) async fn is_final(
        &self,
        lease: impl Into<Lease>,
        transition: Transition,
        cancel_requested: bool,
    ) -> Result<bool, StoreError> {
        let lease = lease.into();
        let fruitless: Option<i64> = sqlx::query_scalar("SELECT fruitless FROM jobs WHERE id = $1")
            .bind(stored_id(lease.job))
            .fetch_optional(self.priority_readers())
            .await?;
        let fruitless = fruitless.unwrap_or_default().try_into().unwrap_or_default();
        let limit = self.process.attempt_limit;
        let job = EndingJob::running(lease.job, fruitless, limit, cancel_requested);
        Ok(job.after(transition).is_some_and(Status::is_terminal))
    }
}

/// Number of the last write of a held job, and whether its end was requested; `None` if the lease was lost.
pub(in super::super) async fn held(
    connection: &mut Connection,
    lease: Lease,
) -> Result<Option<(i64, bool)>, StoreError> {
    let held = sqlx::query_as(
        "SELECT last_write, cancel_requested FROM jobs WHERE id = $1 AND lease = $2 AND status = 'running'",
    )
    .bind(stored_id(lease.job))
    .bind(lease.number);
    Ok(held.fetch_optional(connection).await?)
}
