//! Claims: the first waiting jobs that fit into the free memory of a worker, under new leases.

use sqlx::{Sqlite, Transaction};
use uuid::Uuid;

use crate::clock::Now;
use crate::queue::admit;
use crate::store::candidates::{CANDIDATES, Candidate};
use crate::store::rows::{self, StoredRow, integer};
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::sql::attempts::insert_attempt_event;
use crate::store::sqlite::sql::checkpoints;
use crate::store::sqlite::sql::workers::able_workers;
use crate::store::{Claim, ClaimRequest, ClaimedCheckpoint, Lease, StoreError};

impl SqliteStore {
    pub(in crate::store) async fn claim(
        &self,
        request: &ClaimRequest,
    ) -> Result<Vec<Claim>, StoreError> {
        self.process.disk.check()?;
        let (mut transaction, now) = self.begin().await?;
        let expires_at = now.end_of(request.lease);
        let known = claimed_before(&mut transaction, request, now, expires_at).await?;
        if !known.is_empty() {
            transaction.commit().await?;
            return Ok(known);
        }
        let limit = CANDIDATES.saturating_add(request.capacity.slots);
        let mut candidates = candidates(&mut transaction, limit).await?;
        if candidates.iter().any(|one| one.avoided(now).is_some()) {
            let there = able_workers(&mut transaction, now).await?;
            candidates.retain(|one| !one.is_left(request.request.worker, &there, now));
        }
        if candidates.is_empty() {
            return Ok(Vec::new());
        }
        let waiting: Vec<_> = candidates.iter().map(|one| one.job).collect();
        let admission = admit(&waiting, &request.capacity, now.monotonic_ms);
        let memory = &request.capacity.memory;
        let mut changed = Vec::new();
        for index in admission.too_large {
            let Candidate { id, job, .. } = &candidates[index];
            if set_reason(&mut transaction, *id, &memory.reason_to_wait(job)).await? {
                changed.push(*id);
            }
        }
        let mut claims = Vec::with_capacity(admission.admitted.len());
        for index in admission.admitted {
            let id = candidates[index].id;
            claims.push(claim(&mut transaction, id, request, now, expires_at).await?);
        }
        transaction.commit().await?;
        changed.extend(claims.iter().map(|claim| claim.id));
        for id in changed {
            self.process.changed(id);
        }
        Ok(claims)
    }
}

/// The first queued jobs.
async fn candidates(
    transaction: &mut Transaction<'_, Sqlite>,
    limit: usize,
) -> Result<Vec<Candidate>, StoreError> {
    let rows = sqlx::query(
        "SELECT id, memory_mb, queued_at, cpu_ms, avoided_worker, avoided_until FROM jobs INDEXED BY jobs_waiting \
         WHERE status = 'queued' ORDER BY place, id LIMIT ?",
    )
    .bind(integer(limit))
    .fetch_all(&mut **transaction)
    .await?;
    rows.iter().map(Candidate::read).collect()
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

/// The jobs that the same request has claimed before and that are still held, with renewed leases.
async fn claimed_before(
    transaction: &mut Transaction<'_, Sqlite>,
    request: &ClaimRequest,
    now: Now,
    expires_at: i64,
) -> Result<Vec<Claim>, StoreError> {
    let rows = sqlx::query(
        "UPDATE jobs INDEXED BY jobs_by_claim SET lease_expires_at = ? \
         WHERE worker = ? AND claim_number = ? AND lease_token IS ? AND status = 'running' \
         RETURNING id, lease, spec, attempts, queued_at, deadline_at, memory_mb, cpu_ms",
    )
    .bind(expires_at)
    .bind(request.request.worker.to_string())
    .bind(request.request.number)
    .bind(request.token.map(|token| token.to_string()))
    .fetch_all(&mut **transaction)
    .await?;
    let mut claims = Vec::with_capacity(rows.len());
    for row in rows {
        let id = row.id("id")?;
        let checkpoint = checkpoints::restore(transaction, id).await?;
        claims.push(rows::claim(id, &row, now, checkpoint)?);
    }
    Ok(claims)
}

async fn claim(
    transaction: &mut Transaction<'_, Sqlite>,
    id: Uuid,
    request: &ClaimRequest,
    now: Now,
    expires_at: i64,
) -> Result<Claim, StoreError> {
    let row = sqlx::query(
        "UPDATE jobs SET status = 'running', lease = lease + ?, lease_expires_at = ?, last_write = 0, worker = ?, claim_number = ?, \
         is_remote = ?, lease_token = ?, attempts = attempts + 1, fruitless = fruitless + 1, started_at = COALESCE(started_at, ?), \
         status_reason = NULL, last_event = last_event + 1, version = version + 1 \
         WHERE id = ? AND status = 'queued' \
         RETURNING lease, spec, last_event, attempts, queued_at, deadline_at, memory_mb, cpu_ms",
    )
    .bind(Lease::step())
    .bind(expires_at)
    .bind(request.request.worker.to_string())
    .bind(request.request.number)
    .bind(request.is_remote)
    .bind(request.token.map(|token| token.to_string()))
    .bind(now.system_ms)
    .bind(id.to_string())
    .fetch_one(&mut **transaction)
    .await?;
    let checkpoint = checkpoints::restore(transaction, id).await?;
    let from_cycle = checkpoint.as_ref().map_or(0, ClaimedCheckpoint::cycle);
    let claim = rows::claim(id, &row, now, checkpoint)?;
    let event = row.value("last_event")?;
    insert_attempt_event(transaction, id, event, claim.attempt, from_cycle).await?;
    Ok(claim)
}
