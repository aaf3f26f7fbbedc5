//! Leases: writing about jobs and ending them.
//!
//! Every write of a worker says `WHERE id = ? AND lease = ? AND status = 'running'` and counts for nothing if no row
//! matches: the lease number, raised by each claim, is the fence.

use api::job::{Progress, Status};
use api::results::Snapshot;
use solver::record::CycleReport;
use sqlx::{Sqlite, Transaction};
use uuid::Uuid;

use crate::queue;
use crate::queue::{Transition, Tries};
use crate::store::sqlite::checkpoints;
use crate::store::sqlite::checkpoints::NewCheckpoint;
use crate::store::sqlite::conclusion::{End, Standing, conclude};
use crate::store::sqlite::files::{NewFile, insert_files};
use crate::store::sqlite::queries::{BEGIN, insert_event};
use crate::store::{Store, StoreError};

/// A job in a worker's hands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// The job.
    pub id: Uuid,
    /// The number of the lease; the fence of every write.
    pub lease: i64,
    /// The resolved specification, JSON.
    pub spec: String,
    /// Which attempt it is, from 1.
    pub attempt: u32,
    /// How long it is since the job was accepted, ms.
    pub waited_ms: i64,
    /// When the job fails unless it has ended, ms.
    pub deadline_at: Option<i64>,
    /// What it is expected to need, MB.
    pub memory_mb: i64,
    /// From where it goes on.
    pub checkpoint: Option<NewCheckpoint>,
}

/// What a worker writes at once.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Batch {
    /// How far the job is.
    pub progress: Progress,
    /// New rows of the wear history.
    pub rows: Vec<CycleReport>,
    /// New snapshots.
    pub snapshots: Vec<Snapshot>,
    /// New files.
    pub files: Vec<NewFile>,
    /// The newest checkpoint, if there is a new one; it follows all rows and snapshots up to its cycle.
    pub checkpoint: Option<NewCheckpoint>,
    /// New events: name and JSON document.
    pub events: Vec<(&'static str, String)>,
}

/// Whether a worker still holds its job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Held {
    /// It does.
    Yes {
        /// The user no longer wants the job.
        cancel_requested: bool,
    },
    /// It does not: what it wanted to write was thrown away.
    No,
}

impl Store {
    /// Writes a batch and renews the lease until `expires_at`.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn record(
        &self,
        claim: &Claim,
        batch: &Batch,
        expires_at: i64,
    ) -> Result<Held, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let events = count(batch.events.len());
        let held: Option<(i64, bool)> = sqlx::query_as(
            "UPDATE jobs SET progress = ?, lease_expires_at = ?, last_event = last_event + ?, version = version + 1 \
             WHERE id = ? AND lease = ? AND status = 'running' RETURNING last_event, cancel_requested",
        )
        .bind(serde_json::to_string(&batch.progress)?)
        .bind(expires_at)
        .bind(events)
        .bind(claim.id.to_string())
        .bind(claim.lease)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some((last_event, cancel_requested)) = held else {
            return Ok(self.refused());
        };
        write_results(&mut transaction, claim, batch).await?;
        if let Some(checkpoint) = &batch.checkpoint {
            checkpoints::write(&mut transaction, claim, checkpoint).await?;
            self.metrics.checkpoints.inc();
        }
        for (seq, (name, data)) in (last_event - events + 1..).zip(&batch.events) {
            insert_event(&mut transaction, claim.id, seq, name, data).await?;
        }
        transaction.commit().await?;
        self.changed(claim.id);
        Ok(Held::Yes { cancel_requested })
    }

    /// Renews the lease until `expires_at`: the worker's heartbeat.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn renew(&self, claim: &Claim, expires_at: i64) -> Result<Held, StoreError> {
        let row: Option<bool> = sqlx::query_scalar(
            "UPDATE jobs SET lease_expires_at = ? WHERE id = ? AND lease = ? AND status = 'running' \
             RETURNING cancel_requested",
        )
        .bind(expires_at)
        .bind(claim.id.to_string())
        .bind(claim.lease)
        .fetch_optional(&self.writer)
        .await?;
        Ok(row.map_or(Held::No, |cancel_requested| Held::Yes { cancel_requested }))
    }

    /// Whether the worker holds the job and is wanted to go on; writes nothing.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn held(&self, claim: &Claim) -> Result<Held, StoreError> {
        let row: Option<bool> = sqlx::query_scalar(
            "SELECT cancel_requested FROM jobs WHERE id = ? AND lease = ? AND status = 'running'",
        )
        .bind(claim.id.to_string())
        .bind(claim.lease)
        .fetch_optional(&self.readers)
        .await?;
        Ok(row.map_or(Held::No, |cancel_requested| Held::Yes { cancel_requested }))
    }

    /// Writes the last batch and ends the job, in one transaction. Returns the status it came to, or nothing if the
    /// worker no longer held it.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn end(
        &self,
        claim: &Claim,
        batch: &Batch,
        end: &End,
        now: i64,
    ) -> Result<Option<Status>, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let standing: Option<Standing> = sqlx::query_as(
            "SELECT attempts, cancel_requested FROM jobs WHERE id = ? AND lease = ? AND status = 'running'",
        )
        .bind(claim.id.to_string())
        .bind(claim.lease)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some(standing) = standing else {
            self.refused();
            return Ok(None);
        };
        write_results(&mut transaction, claim, batch).await?;
        let progress = serde_json::to_string(&batch.progress)?;
        let standing = standing.limited(self.attempt_limit);
        let status = conclude(
            &mut transaction,
            claim.id,
            &standing,
            end,
            Some(&progress),
            now,
        )
        .await?;
        transaction.commit().await?;
        self.concluded(claim.id, status);
        Ok(status)
    }

    /// Whether a worker's move ends a job rather than putting it back into the queue.
    pub fn ends(&self, claim: &Claim, step: Transition, cancel_requested: bool) -> bool {
        let tries = Tries {
            made: claim.attempt,
            limit: self.attempt_limit,
        };
        queue::after(Status::Running, step, tries, cancel_requested)
            .is_some_and(Status::is_terminal)
    }

    pub(in crate::store) fn concluded(&self, id: Uuid, status: Option<Status>) {
        self.changed(id);
        match status {
            Some(Status::Queued) => self.waiting.notify_one(),
            Some(status) if status.is_terminal() => self.metrics.ended(status),
            _ => {}
        }
    }
}

async fn write_results(
    transaction: &mut Transaction<'_, Sqlite>,
    claim: &Claim,
    batch: &Batch,
) -> Result<(), StoreError> {
    let id = claim.id;
    for row in &batch.rows {
        sqlx::query("INSERT OR REPLACE INTO history_rows (job_id, cycle, data) VALUES (?, ?, ?)")
            .bind(id.to_string())
            .bind(i64::try_from(row.cycle).unwrap_or(i64::MAX))
            .bind(serde_json::to_string(row)?)
            .execute(&mut **transaction)
            .await?;
    }
    for snapshot in &batch.snapshots {
        sqlx::query(
            "INSERT OR REPLACE INTO snapshots (job_id, cycle, profile, pressure, friction_loop) VALUES (?, ?, ?, ?, ?)",
        )
        .bind(id.to_string())
        .bind(i64::try_from(snapshot.profile.cycle).unwrap_or(i64::MAX))
        .bind(serde_json::to_string(&snapshot.profile)?)
        .bind(serde_json::to_string(&snapshot.pressure)?)
        .bind(serde_json::to_string(&snapshot.friction_loop)?)
        .execute(&mut **transaction)
        .await?;
    }
    insert_files(transaction, claim, &batch.files).await
}

fn count(length: usize) -> i64 {
    i64::try_from(length).unwrap_or(i64::MAX)
}
