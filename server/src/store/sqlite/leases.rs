//! Fenced operations: writes of workers and ends of jobs.
//!
//! Every write of a worker says `WHERE id = ? AND lease = ? AND status = 'running'` and has no effect if no row
//! matches: the lease number, raised by each claim, is the fence.

use api::job::Status;
use sqlx::{Sqlite, Transaction};

use crate::queue::Transition;
use crate::store::sqlite::blocks::insert_block;
use crate::store::sqlite::checkpoints;
use crate::store::sqlite::files::insert_files;
use crate::store::sqlite::queries::{BEGIN, insert_attempt_event, insert_event, integer};
use crate::store::sqlite::transitions::{EndingJob, end_job};
use crate::store::{Claim, End, JobUpdate, LeaseState, Store, StoreError};

impl Store {
    /// Writes an update and renews the lease until `expires_at`.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn record(
        &self,
        claim: &Claim,
        update: &JobUpdate,
        expires_at: i64,
    ) -> Result<LeaseState, StoreError> {
        self.disk.check()?;
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let events = integer(update.events.len());
        let held: Option<(i64, bool)> = sqlx::query_as(
            "UPDATE jobs SET progress = ?, lease_expires_at = ?, last_event = last_event + ?, version = version + 1, \
             fruitless = iif(?, 0, fruitless) \
             WHERE id = ? AND lease = ? AND status = 'running' RETURNING last_event, cancel_requested",
        )
        .bind(serde_json::to_string(&update.progress)?)
        .bind(expires_at)
        .bind(events)
        .bind(update.checkpoint.is_some())
        .bind(claim.id.to_string())
        .bind(claim.lease)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some((last_event, cancel_requested)) = held else {
            return Ok(self.stale_write());
        };
        write_results(&mut transaction, claim, update).await?;
        if let Some(checkpoint) = &update.checkpoint {
            checkpoints::write(&mut transaction, claim, checkpoint).await?;
            self.metrics.checkpoints.inc();
        }
        for (seq, (name, data)) in (last_event - events + 1..).zip(&update.events) {
            insert_event(&mut transaction, claim.id, seq, name, data).await?;
        }
        transaction.commit().await?;
        self.changed(claim.id);
        Ok(LeaseState::Held { cancel_requested })
    }

    /// Renews the lease until `expires_at`: the worker's heartbeat.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn renew(&self, claim: &Claim, expires_at: i64) -> Result<LeaseState, StoreError> {
        let write = async || {
            let cancel_requested = sqlx::query_scalar(
                "UPDATE jobs SET lease_expires_at = ? WHERE id = ? AND lease = ? AND status = 'running' \
                 RETURNING cancel_requested",
            )
            .bind(expires_at)
            .bind(claim.id.to_string())
            .bind(claim.lease)
            .fetch_optional(&self.writer)
            .await?;
            Ok(lease_state(cancel_requested))
        };
        self.disk.with_reserve(write).await
    }

    /// Whether the worker holds the job; writes nothing.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn lease_state(&self, claim: &Claim) -> Result<LeaseState, StoreError> {
        let cancel_requested = sqlx::query_scalar(
            "SELECT cancel_requested FROM jobs WHERE id = ? AND lease = ? AND status = 'running'",
        )
        .bind(claim.id.to_string())
        .bind(claim.lease)
        .fetch_optional(&self.readers)
        .await?;
        Ok(lease_state(cancel_requested))
    }

    /// Deletes results and checkpoint, because the run restarts at cycle 0.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn restart(&self, claim: &Claim) -> Result<LeaseState, StoreError> {
        self.disk.check()?;
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let held: Option<(i64, bool)> = sqlx::query_as(
            "UPDATE jobs SET last_event = last_event + 1, version = version + 1 \
             WHERE id = ? AND lease = ? AND status = 'running' RETURNING last_event, cancel_requested",
        )
        .bind(claim.id.to_string())
        .bind(claim.lease)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some((event, cancel_requested)) = held else {
            return Ok(self.stale_write());
        };
        checkpoints::delete_results_after(&mut transaction, claim.id, None).await?;
        insert_attempt_event(&mut transaction, claim.id, event, claim.attempt, 0).await?;
        transaction.commit().await?;
        self.changed(claim.id);
        Ok(LeaseState::Held { cancel_requested })
    }

    /// Writes progress, results and files of the last update and ends the job or returns it to the queue, in one
    /// transaction. Returns the new status, or `None` if the lease was lost.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn end(
        &self,
        claim: &Claim,
        update: &JobUpdate,
        end: &End,
        now: i64,
    ) -> Result<Option<Status>, StoreError> {
        let write = || self.write_end(claim, update, end, now);
        self.disk.with_reserve(write).await
    }

    async fn write_end(
        &self,
        claim: &Claim,
        update: &JobUpdate,
        end: &End,
        now: i64,
    ) -> Result<Option<Status>, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let held = sqlx::query_as(
            "SELECT fruitless, cancel_requested FROM jobs WHERE id = ? AND lease = ? AND status = 'running'",
        )
        .bind(claim.id.to_string())
        .bind(claim.lease)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some((fruitless, cancel_requested)) = held else {
            self.stale_write();
            return Ok(None);
        };
        write_results(&mut transaction, claim, update).await?;
        let job = EndingJob::running(claim.id, fruitless, self.attempt_limit, cancel_requested);
        let progress = serde_json::to_string(&update.progress)?;
        let status = end_job(&mut transaction, &job, end, Some(&progress), now).await?;
        if let Some(block) = &update.block {
            let succeeded = status == Some(Status::Succeeded);
            insert_block(&mut transaction, claim.id, block, succeeded).await?;
        }
        transaction.commit().await?;
        self.concluded(claim.id, status);
        Ok(status)
    }

    /// Whether a transition ends a claimed job instead of returning it to the queue.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn is_final(
        &self,
        claim: &Claim,
        transition: Transition,
        cancel_requested: bool,
    ) -> Result<bool, StoreError> {
        let fruitless: Option<u32> = sqlx::query_scalar("SELECT fruitless FROM jobs WHERE id = ?")
            .bind(claim.id.to_string())
            .fetch_optional(&self.readers)
            .await?;
        let fruitless = fruitless.unwrap_or_default();
        let job = EndingJob::running(claim.id, fruitless, self.attempt_limit, cancel_requested);
        Ok(job.after(transition).is_some_and(Status::is_terminal))
    }
}

fn lease_state(cancel_requested: Option<bool>) -> LeaseState {
    cancel_requested.map_or(LeaseState::Lost, |cancel_requested| LeaseState::Held {
        cancel_requested,
    })
}

async fn write_results(
    transaction: &mut Transaction<'_, Sqlite>,
    claim: &Claim,
    update: &JobUpdate,
) -> Result<(), StoreError> {
    let id = claim.id.to_string();
    for row in &update.rows {
        sqlx::query("INSERT OR REPLACE INTO history_rows (job_id, cycle, data) VALUES (?, ?, ?)")
            .bind(&id)
            .bind(integer(row.cycle))
            .bind(serde_json::to_string(row)?)
            .execute(&mut **transaction)
            .await?;
    }
    for snapshot in &update.snapshots {
        sqlx::query(
            "INSERT OR REPLACE INTO snapshots (job_id, cycle, profile, pressure, friction_loop) VALUES (?, ?, ?, ?, ?)",
        )
        .bind(&id)
        .bind(integer(snapshot.profile.cycle))
        .bind(serde_json::to_string(&snapshot.profile)?)
        .bind(serde_json::to_string(&snapshot.pressure)?)
        .bind(serde_json::to_string(&snapshot.friction_loop)?)
        .execute(&mut **transaction)
        .await?;
    }
    insert_files(transaction, claim, &update.files).await
}
