//! Claims: the first waiting job that fits into the free memory, under a new lease.

use sqlx::sqlite::SqliteRow;
use sqlx::{Row, Sqlite, Transaction};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::clock::Now;
use crate::queue::{MemoryBudget, WaitingJob, admit};
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::sqlite::checkpoints;
use crate::store::sqlite::queries::{BEGIN, insert_attempt_event};
use crate::store::{Claim, Store, StoreError};

/// Number of waiting jobs among which one that fits is searched.
const CANDIDATE_LIMIT: i64 = 64;

impl Store {
    /// Claims the first job in the order of the queue that fits into the part of this memory (MB) that running jobs
    /// leave, under a new lease that ends at `expires_at`. Jobs before it that do not fit get a status reason.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn claim_within(
        &self,
        memory_mb: i64,
        now: impl Into<Now>,
        expires_at: i64,
    ) -> Result<Option<Claim>, StoreError> {
        self.disk.check()?;
        let now = now.into();
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let (ids, waiting) = candidates(&mut transaction).await?;
        if waiting.is_empty() {
            return Ok(None);
        }
        let budget = memory_budget(&mut transaction, memory_mb).await?;
        let admission = admit(&waiting, &budget, now.monotonic_ms);
        let mut changed = Vec::new();
        for index in admission.too_large {
            let reason = format!(
                "waiting for memory: it needs about {} MB, {} of {memory_mb} MB are left",
                waiting[index].memory_mb,
                budget.free_mb()
            );
            if set_reason(&mut transaction, ids[index], &reason).await? {
                changed.push(ids[index]);
            }
        }
        let claim = match admission.admitted {
            Some(index) => Some(claim(&mut transaction, ids[index], now, expires_at).await?),
            None => None,
        };
        transaction.commit().await?;
        changed.extend(claim.as_ref().map(|claim| claim.id));
        for id in changed {
            self.changed(id);
        }
        Ok(claim)
    }
}

/// The first queued jobs: their ids, and what their admission depends on.
async fn candidates(
    transaction: &mut Transaction<'_, Sqlite>,
) -> Result<(Vec<Uuid>, Vec<WaitingJob>), StoreError> {
    let rows: Vec<(Hyphenated, i64, i64)> = sqlx::query_as(
        "SELECT id, memory_mb, queued_at FROM jobs WHERE status = 'queued' ORDER BY place, id LIMIT ?",
    )
    .bind(CANDIDATE_LIMIT)
    .fetch_all(&mut **transaction)
    .await?;
    let candidate = |(id, memory_mb, since)| (Uuid::from(id), WaitingJob { memory_mb, since });
    Ok(rows.into_iter().map(candidate).unzip())
}

async fn memory_budget(
    transaction: &mut Transaction<'_, Sqlite>,
    memory_mb: i64,
) -> Result<MemoryBudget, StoreError> {
    let (running, used_mb) = sqlx::query_as(
        "SELECT count(*), COALESCE(sum(memory_mb), 0) FROM jobs WHERE status = 'running'",
    )
    .fetch_one(&mut **transaction)
    .await?;
    Ok(MemoryBudget {
        memory_mb,
        used_mb,
        running,
    })
}

/// Sets the status reason of a job; whether it had another one.
async fn set_reason(
    transaction: &mut Transaction<'_, Sqlite>,
    id: Uuid,
    reason: &str,
) -> Result<bool, StoreError> {
    let changed = sqlx::query(
        "UPDATE jobs SET status_reason = ?1, version = version + 1 WHERE id = ?2 AND status_reason IS NOT ?1",
    )
    .bind(reason)
    .bind(id.to_string())
    .execute(&mut **transaction)
    .await?;
    Ok(changed.rows_affected() > 0)
}

async fn claim(
    transaction: &mut Transaction<'_, Sqlite>,
    id: Uuid,
    now: Now,
    expires_at: i64,
) -> Result<Claim, StoreError> {
    let row = sqlx::query(
        "UPDATE jobs SET status = 'running', lease = lease + 1, lease_expires_at = ?, attempts = attempts + 1, \
         fruitless = fruitless + 1, started_at = COALESCE(started_at, ?), status_reason = NULL, last_event = last_event + 1, version = version + 1 \
         WHERE id = ? AND status = 'queued' \
         RETURNING lease, spec, last_event, attempts, queued_at, deadline_at, memory_mb",
    )
    .bind(expires_at)
    .bind(now.system_ms)
    .bind(id.to_string())
    .fetch_one(&mut **transaction)
    .await?;
    let checkpoint = checkpoints::restore(transaction, id).await?;
    let from_cycle = checkpoint.as_ref().map_or(0, |found| found.cycle);
    let waited_ms = now.monotonic_ms.saturating_sub(row.try_get("queued_at")?);
    let claim = claimed(id, &row, waited_ms, checkpoint)?;
    let event = row.try_get("last_event")?;
    insert_attempt_event(transaction, id, event, claim.attempt, from_cycle).await?;
    Ok(claim)
}

/// Returns the claim of a job, from its row under the new lease.
pub(super) fn claimed(
    id: Uuid,
    row: &SqliteRow,
    waited_ms: i64,
    checkpoint: Option<EncodedCheckpoint>,
) -> Result<Claim, StoreError> {
    Ok(Claim {
        id,
        lease: row.try_get("lease")?,
        spec: row.try_get("spec")?,
        attempt: row.try_get("attempts")?,
        waited_ms,
        deadline_at: row.try_get("deadline_at")?,
        memory_mb: row.try_get("memory_mb")?,
        checkpoint,
    })
}
