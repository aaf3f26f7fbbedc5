//! Claims: the first waiting job that fits into the free memory, under a new lease.

use sqlx::{Sqlite, Transaction};

use crate::queue::{MemoryBudget, WAITING_FOR_DISK, WAITING_FOR_WORKER, WaitingJob, admit};
use crate::store::sqlite::checkpoints;
use crate::store::sqlite::queries::{BEGIN, attempt_count, insert_attempt_event, job_id};
use crate::store::{Claim, Store, StoreError};

/// Number of waiting jobs among which one that fits is searched.
const CANDIDATE_LIMIT: i64 = 64;

impl Store {
    /// Claims the first job in the order of the queue, under a new lease that ends at `expires_at`.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn claim(&self, now: i64, expires_at: i64) -> Result<Option<Claim>, StoreError> {
        self.claim_within(i64::MAX, now, expires_at).await
    }

    /// Claims the first job in the order of the queue that fits into the part of this memory (MB) that running jobs leave,
    /// under a new lease that ends at `expires_at`. Jobs before it that do not fit get a status reason.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn claim_within(
        &self,
        memory_mb: i64,
        now: i64,
        expires_at: i64,
    ) -> Result<Option<Claim>, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let (ids, waiting) = candidates(&mut transaction).await?;
        if waiting.is_empty() {
            return Ok(None);
        }
        let budget = memory_budget(&mut transaction, memory_mb).await?;
        let admission = admit(&waiting, &budget, now);
        let mut changed = Vec::new();
        for index in admission.too_large {
            let reason = format!(
                "waiting for memory: it needs about {} MB, {} of {memory_mb} MB are left",
                waiting[index].memory_mb,
                budget.free_mb()
            );
            if set_reason(&mut transaction, &ids[index], &reason).await? {
                changed.push(job_id(&ids[index])?);
            }
        }
        let claim = match admission.admitted {
            Some(index) => Some(claim(&mut transaction, &ids[index], now, expires_at).await?),
            None => None,
        };
        transaction.commit().await?;
        for id in changed
            .into_iter()
            .chain(claim.as_ref().map(|claim| claim.id))
        {
            self.changed(id);
        }
        Ok(claim)
    }

    /// Sets the status reason of all queued jobs. Returns how many had another one.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn set_waiting_reason(&self, reason: &str) -> Result<u64, StoreError> {
        let changed = sqlx::query(
            "UPDATE jobs SET status_reason = ?1, version = version + 1 \
             WHERE status = 'queued' AND status_reason IS NOT ?1",
        )
        .bind(reason)
        .execute(&self.writer)
        .await?;
        Ok(changed.rows_affected())
    }

    /// Resets the status reason of queued jobs that waited for disk space. Returns how many.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn reset_disk_reason(&self) -> Result<u64, StoreError> {
        let changed = sqlx::query(
            "UPDATE jobs SET status_reason = ?, version = version + 1 \
             WHERE status = 'queued' AND status_reason LIKE ? || '%'",
        )
        .bind(WAITING_FOR_WORKER)
        .bind(WAITING_FOR_DISK)
        .execute(&self.writer)
        .await?;
        Ok(changed.rows_affected())
    }
}

/// The first queued jobs: their ids, and what their admission depends on.
async fn candidates(
    transaction: &mut Transaction<'_, Sqlite>,
) -> Result<(Vec<String>, Vec<WaitingJob>), StoreError> {
    let rows: Vec<(String, i64, i64)> = sqlx::query_as(
        "SELECT id, memory_mb, created_at FROM jobs WHERE status = 'queued' ORDER BY place, id LIMIT ?",
    )
    .bind(CANDIDATE_LIMIT)
    .fetch_all(&mut **transaction)
    .await?;
    let candidate = |(id, memory_mb, since)| (id, WaitingJob { memory_mb, since });
    Ok(rows.into_iter().map(candidate).unzip())
}

async fn memory_budget(
    transaction: &mut Transaction<'_, Sqlite>,
    memory_mb: i64,
) -> Result<MemoryBudget, StoreError> {
    let (running, used_mb): (i64, i64) = sqlx::query_as(
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
    id: &str,
    reason: &str,
) -> Result<bool, StoreError> {
    let changed = sqlx::query(
        "UPDATE jobs SET status_reason = ?1, version = version + 1 WHERE id = ?2 AND status_reason IS NOT ?1",
    )
    .bind(reason)
    .bind(id)
    .execute(&mut **transaction)
    .await?;
    Ok(changed.rows_affected() > 0)
}

#[derive(sqlx::FromRow)]
struct ClaimedRow {
    lease: i64,
    spec: String,
    last_event: i64,
    attempts: i64,
    created_at: i64,
    deadline_at: Option<i64>,
    memory_mb: i64,
}

async fn claim(
    transaction: &mut Transaction<'_, Sqlite>,
    text: &str,
    now: i64,
    expires_at: i64,
) -> Result<Claim, StoreError> {
    let row: ClaimedRow = sqlx::query_as(
        "UPDATE jobs SET status = 'running', lease = lease + 1, lease_expires_at = ?, attempts = attempts + 1, \
         started_at = COALESCE(started_at, ?), status_reason = NULL, last_event = last_event + 1, version = version + 1 \
         WHERE id = ? AND status = 'queued' \
         RETURNING lease, spec, last_event, attempts, created_at, deadline_at, memory_mb",
    )
    .bind(expires_at)
    .bind(now)
    .bind(text)
    .fetch_one(&mut **transaction)
    .await?;
    let id = job_id(text)?;
    let checkpoint = checkpoints::restore(transaction, id).await?;
    let attempt = attempt_count(row.attempts);
    let from_cycle = checkpoint.as_ref().map_or(0, |found| found.cycle);
    insert_attempt_event(transaction, id, row.last_event, attempt, from_cycle).await?;
    Ok(Claim {
        id,
        lease: row.lease,
        spec: row.spec,
        attempt,
        waited_ms: now.saturating_sub(row.created_at),
        deadline_at: row.deadline_at,
        memory_mb: row.memory_mb,
        checkpoint,
    })
}
