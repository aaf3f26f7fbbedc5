//! Fenced operations: writes of workers and ends of jobs.
//!
//! Every write of a worker says `WHERE id = ? AND lease = ? AND status = 'running'` and has no effect if no row
//! matches: the lease number, raised by each claim, is the fence. Writes under a lease are numbered, so that one whose
//! commit or answer was lost can be repeated: one with a number up to the last has no further effect.

use std::time::Duration;

use api::job::Status;
use sqlx::{Sqlite, Transaction};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::store::ending::EndingJob;
use crate::store::process_state::log_lost_writes;
use crate::store::rows::integer;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::blocks::insert_block;
use crate::store::sqlite::new_files::insert_files;
use crate::store::sqlite::queries::insert_event;
use crate::store::sqlite::sql::checkpoints;
use crate::store::sqlite::sql::held_leases;
use crate::store::sqlite::sql::results::insert_snapshots;
use crate::store::sqlite::transitions::end_job_at;
use crate::store::{End, JobUpdate, Lease, LeaseState, StoreError};

impl SqliteStore {
    pub(in crate::store) async fn write_update(
        &self,
        lease: Lease,
        update: &JobUpdate,
        length: Duration,
    ) -> Result<LeaseState, StoreError> {
        self.process.disk.check()?;
        let (mut transaction, now) = self.begin().await?;
        let events = integer(update.events.len());
        let held: Option<(i64, bool)> = sqlx::query_as(
            "UPDATE jobs SET last_write = ?1, progress = ?2, lease_expires_at = ?3, last_event = last_event + ?4, version = version + 1, \
             fruitless = iif(?5, 0, fruitless) \
             WHERE id = ?6 AND lease = ?7 AND status = 'running' AND last_write = ?1 - 1 RETURNING last_event, cancel_requested",
        )
        .bind(update.number)
        .bind(serde_json::to_string(&update.progress)?)
        .bind(now.end_of(length))
        .bind(events)
        .bind(update.checkpoint.is_some())
        .bind(lease.job.to_string())
        .bind(lease.number)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some((last_event, cancel_requested)) = held else {
            // A repeated write, or the lease was lost, as after a gap.
            let held = held_leases::held(&mut transaction, lease).await?;
            return Ok(self.process.written_before(lease, update.number, held));
        };
        write_results(&mut transaction, lease, update).await?;
        if let Some(checkpoint) = &update.checkpoint {
            let object = update.checkpoint_object.as_deref();
            checkpoints::write(&mut transaction, lease, checkpoint, object, now).await?;
            self.process.metrics.checkpoints.inc();
        }
        for (seq, (name, data)) in (last_event - events + 1..).zip(&update.events) {
            insert_event(&mut transaction, lease.job, seq, name.as_str(), data).await?;
        }
        transaction.commit().await?;
        self.process.changed(lease.job);
        Ok(LeaseState::Held { cancel_requested })
    }

    pub(in crate::store) async fn owned(
        &self,
        token: Uuid,
        leases: &[Lease],
    ) -> Result<Vec<Lease>, StoreError> {
        let owned: Vec<(Hyphenated, i64)> = sqlx::query_as(
            "SELECT jobs.id, lease FROM json_each(?) AS given CROSS JOIN jobs ON jobs.id = value ->> '$.job' AND lease = value ->> '$.number' \
             WHERE lease_token = ? OR lease_token IS NULL AND is_remote",
        )
        .bind(serde_json::to_string(leases)?)
        .bind(token.to_string())
        .fetch_all(&self.readers)
        .await?;
        let lease = |(job, number): (Hyphenated, i64)| Lease {
            job: job.into(),
            number,
        };
        Ok(owned.into_iter().map(lease).collect())
    }

    pub(in crate::store) async fn heartbeat(
        &self,
        leases: &[Lease],
        length: Duration,
        token: Option<Uuid>,
    ) -> Result<Vec<LeaseState>, StoreError> {
        let token = token.map(|token| token.to_string());
        let given = serde_json::to_string(leases)?;
        let held: Vec<(i64, bool, i64)> = sqlx::query_as(
            "SELECT key, cancel_requested, lease_expires_at FROM json_each(?1) AS given \
             CROSS JOIN jobs ON jobs.id = value ->> '$.job' AND lease = value ->> '$.number' \
             WHERE status = 'running' AND (?2 IS NULL OR lease_token = ?2 OR lease_token IS NULL AND is_remote)",
        )
        .bind(&given)
        .bind(&token)
        .fetch_all(&self.readers)
        .await?;
        let renewed_until = self.process.clock.end_of(length / 3 * 2);
        let is_due = |(.., expires_at): &(i64, bool, i64)| *expires_at < renewed_until;
        if held.iter().any(is_due) {
            let write = async || {
                sqlx::query(
                    "UPDATE jobs SET lease_expires_at = ?1 \
                     WHERE (id, lease) IN (SELECT value ->> '$.job', value ->> '$.number' FROM json_each(?2)) \
                     AND +status = 'running' AND lease_expires_at < ?3 \
                     AND (?4 IS NULL OR lease_token = ?4 OR lease_token IS NULL AND is_remote)",
                )
                .bind(self.process.clock.end_of(length))
                .bind(&given)
                .bind(renewed_until)
                .bind(&token)
                .execute(&self.writer)
                .await?;
                Ok(())
            };
            self.process.disk.with_reserve(write).await?;
        }
        let mut states = vec![LeaseState::Lost; leases.len()];
        for (index, cancel_requested, _) in held {
            let index = usize::try_from(index).unwrap_or(usize::MAX);
            if let Some(state) = states.get_mut(index) {
                *state = LeaseState::Held { cancel_requested };
            }
        }
        Ok(states)
    }

    pub(in crate::store) async fn write_end(
        &self,
        lease: Lease,
        update: &JobUpdate,
        end: &End,
    ) -> Result<Option<Status>, StoreError> {
        let write = || self.end_in_transaction(lease, update, end);
        self.process.disk.with_reserve(write).await
    }

    async fn end_in_transaction(
        &self,
        lease: Lease,
        update: &JobUpdate,
        end: &End,
    ) -> Result<Option<Status>, StoreError> {
        let (mut transaction, now) = self.begin().await?;
        let held = sqlx::query_as(
            "UPDATE jobs SET last_write = ?1 WHERE id = ?2 AND lease = ?3 AND status = 'running' AND last_write = ?1 - 1 \
             RETURNING fruitless, cancel_requested",
        )
        .bind(update.number)
        .bind(lease.job.to_string())
        .bind(lease.number)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some((fruitless, cancel_requested)) = held else {
            return self
                .ended_before(&mut transaction, lease, update.number)
                .await;
        };
        write_results(&mut transaction, lease, update).await?;
        let job = EndingJob::running(
            lease.job,
            fruitless,
            self.process.attempt_limit,
            cancel_requested,
        );
        let progress = serde_json::to_string(&update.progress)?;
        let status = end_job_at(&mut transaction, &job, end, Some(&progress), now).await?;
        if let Some(block) = &update.block {
            let succeeded = status == Some(Status::Succeeded);
            insert_block(&mut transaction, lease.job, block, succeeded).await?;
        }
        transaction.commit().await?;
        self.process.ended_by_worker(lease.job, status);
        Ok(status)
    }

    /// The status that a repeated end has led to; `None` if it had no effect because the lease was lost.
    async fn ended_before(
        &self,
        transaction: &mut Transaction<'_, Sqlite>,
        lease: Lease,
        number: i64,
    ) -> Result<Option<Status>, StoreError> {
        let before: Option<(String, i64)> =
            sqlx::query_as("SELECT status, last_write FROM jobs WHERE id = ? AND lease = ?")
                .bind(lease.job.to_string())
                .bind(lease.number)
                .fetch_optional(&mut **transaction)
                .await?;
        let before = before.and_then(|(status, last)| Some((Status::from_name(&status)?, last)));
        match before {
            Some((status, last)) if status != Status::Running && number == last => {
                return Ok(Some(status));
            }
            Some((Status::Running, last)) if number > last => log_lost_writes(lease, number, last),
            _ => {}
        }
        self.process.stale_write();
        Ok(None)
    }
}

async fn write_results(
    transaction: &mut Transaction<'_, Sqlite>,
    lease: Lease,
    update: &JobUpdate,
) -> Result<(), StoreError> {
    let id = lease.job.to_string();
    for row in &update.rows {
        sqlx::query("INSERT OR REPLACE INTO history_rows (job_id, cycle, data) VALUES (?, ?, ?)")
            .bind(&id)
            .bind(integer(row.cycle))
            .bind(serde_json::to_string(row)?)
            .execute(&mut **transaction)
            .await?;
    }
    insert_snapshots(transaction, lease.job, &update.snapshots).await?;
    insert_files(transaction, lease, &update.files).await
}
