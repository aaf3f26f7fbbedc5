//! Claiming: the first waiting job that fits, under a new lease.

use sqlx::{Sqlite, Transaction};
use uuid::Uuid;

use crate::queue::{Room, WAITING_FOR_DISK, WAITING_FOR_WORKER, Waiting, choose};
use crate::store::sqlite::checkpoints;
use crate::store::sqlite::leases::Claim;
use crate::store::sqlite::queries::{BEGIN, attempt_event, job_id};
use crate::store::{Store, StoreError};

/// Waiting jobs looked at for one that fits.
const LOOKED_AT: i64 = 64;

impl Store {
    /// Hands out the first job in the order of the queue, under a new lease that ends at `expires_at`.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn claim(&self, now: i64, expires_at: i64) -> Result<Option<Claim>, StoreError> {
        self.claim_within(i64::MAX, now, expires_at).await
    }

    /// Hands out the first job in the order of the queue that fits into what running jobs leave of this memory (MB), under
    /// a new lease that ends at `expires_at`. Jobs in front of it that do not fit say so.
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
        let waiting: Vec<(String, i64, i64)> = sqlx::query_as(
            "SELECT id, memory_mb, created_at FROM jobs WHERE status = 'queued' ORDER BY place, id LIMIT ?",
        )
        .bind(LOOKED_AT)
        .fetch_all(&mut *transaction)
        .await?;
        if waiting.is_empty() {
            return Ok(None);
        }
        let room = room(&mut transaction, memory_mb).await?;
        let needs: Vec<Waiting> = waiting
            .iter()
            .map(|(_, memory_mb, since)| Waiting {
                memory_mb: *memory_mb,
                since: *since,
            })
            .collect();
        let choice = choose(&needs, &room, now);
        let mut told = Vec::new();
        for index in choice.too_large {
            let (id, needed) = (&waiting[index].0, needs[index].memory_mb);
            let reason = format!(
                "waiting for memory: it needs about {needed} MB, {} of {memory_mb} MB are left",
                room.left_mb()
            );
            if explain(&mut transaction, id, &reason).await? {
                told.push(job_id(id)?);
            }
        }
        let claim = match choice.taken {
            Some(index) => Some(take(&mut transaction, &waiting[index].0, now, expires_at).await?),
            None => None,
        };
        transaction.commit().await?;
        for id in told.into_iter().chain(claim.as_ref().map(|claim| claim.id)) {
            self.changed(id);
        }
        Ok(claim)
    }

    /// Lets all waiting jobs say why none is taken. Returns how many did not say so yet.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn explain_waiting(&self, reason: &str) -> Result<u64, StoreError> {
        let told = sqlx::query(
            "UPDATE jobs SET status_reason = ?1, version = version + 1 \
             WHERE status = 'queued' AND status_reason IS NOT ?1",
        )
        .bind(reason)
        .execute(&self.writer)
        .await?;
        Ok(told.rows_affected())
    }

    /// Lets jobs that waited for disk space say that they wait for a worker.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn explain_no_shortage(&self) -> Result<u64, StoreError> {
        let told = sqlx::query(
            "UPDATE jobs SET status_reason = ?, version = version + 1 \
             WHERE status = 'queued' AND status_reason LIKE ? || '%'",
        )
        .bind(WAITING_FOR_WORKER)
        .bind(WAITING_FOR_DISK)
        .execute(&self.writer)
        .await?;
        Ok(told.rows_affected())
    }
}

async fn room(
    transaction: &mut Transaction<'_, Sqlite>,
    memory_mb: i64,
) -> Result<Room, StoreError> {
    let (running, used_mb): (i64, i64) = sqlx::query_as(
        "SELECT count(*), COALESCE(sum(memory_mb), 0) FROM jobs WHERE status = 'running'",
    )
    .fetch_one(&mut **transaction)
    .await?;
    Ok(Room {
        memory_mb,
        used_mb,
        running,
    })
}

async fn explain(
    transaction: &mut Transaction<'_, Sqlite>,
    id: &str,
    reason: &str,
) -> Result<bool, StoreError> {
    let told = sqlx::query(
        "UPDATE jobs SET status_reason = ?1, version = version + 1 WHERE id = ?2 AND status_reason IS NOT ?1",
    )
    .bind(reason)
    .bind(id)
    .execute(&mut **transaction)
    .await?;
    Ok(told.rows_affected() > 0)
}

#[derive(sqlx::FromRow)]
struct Taken {
    lease: i64,
    spec: String,
    last_event: i64,
    attempts: i64,
    created_at: i64,
    deadline_at: Option<i64>,
    memory_mb: i64,
}

async fn take(
    transaction: &mut Transaction<'_, Sqlite>,
    text: &str,
    now: i64,
    expires_at: i64,
) -> Result<Claim, StoreError> {
    let taken: Taken = sqlx::query_as(
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
    let id: Uuid = job_id(text)?;
    let checkpoint = checkpoints::latest(transaction, id).await?;
    let attempt = u32::try_from(taken.attempts).unwrap_or(u32::MAX);
    let from_cycle = checkpoint.as_ref().map_or(0, |found| found.cycle);
    attempt_event(transaction, id, taken.last_event, attempt, from_cycle).await?;
    Ok(Claim {
        id,
        lease: taken.lease,
        spec: taken.spec,
        attempt,
        waited_ms: now.saturating_sub(taken.created_at),
        deadline_at: taken.deadline_at,
        memory_mb: taken.memory_mb,
        checkpoint,
    })
}
