//! Fenced operations: writes of workers and ends of jobs. The statement that names the lease locks the row of the job until the
//! transaction ends.

use std::time::Duration;

use api::job::Status;
use uuid::Uuid;

use crate::store::postgres::PostgresStore;
use crate::store::postgres::write::LeaseEffect;
use crate::store::{End, JobUpdate, Lease, LeaseState, StoreError, Write, WriteKind};

impl PostgresStore {
    pub(in crate::store) async fn write_update(
        &self,
        lease: Lease,
        update: &JobUpdate,
        length: Duration,
    ) -> Result<LeaseState, StoreError> {
        self.process.disk.check()?;
        let write = Write {
            lease,
            update: update.clone(),
            kind: WriteKind::Renew(length),
        };
        let written = self.write(write).await?;
        let LeaseEffect::Held { cancel_requested } = written.effect else {
            return Ok(self.process.stale_write());
        };
        if !written.is_repeated {
            if update.checkpoint.is_some() {
                self.process.metrics.checkpoints.inc();
            }
            self.process.changed(lease.job);
        }
        Ok(LeaseState::Held { cancel_requested })
    }

    pub(in crate::store) async fn owned(
        &self,
        token: Uuid,
        leases: &[Lease],
    ) -> Result<Vec<Lease>, StoreError> {
        let owned: Vec<(Uuid, i64)> = sqlx::query_as(
            "SELECT id, lease FROM jobs JOIN unnest($1::uuid[], $2::bigint[]) AS given (id, lease) USING (id, lease) WHERE lease_token = $3 OR lease_token IS NULL AND is_remote",
        )
        .bind(leases.iter().map(|lease| lease.job).collect::<Vec<_>>())
        .bind(leases.iter().map(|lease| lease.number).collect::<Vec<_>>())
        .bind(token)
        .fetch_all(&self.readers)
        .await?;
        let lease = |(job, number)| Lease { job, number };
        Ok(owned.into_iter().map(lease).collect())
    }

    pub(in crate::store) async fn heartbeat(
        &self,
        leases: &[Lease],
        length: Duration,
        token: Option<Uuid>,
    ) -> Result<Vec<LeaseState>, StoreError> {
        let mut connection = self.writer.acquire().await?;
        let now = self.now(&mut connection).await?;
        let ids: Vec<_> = leases.iter().map(|lease| lease.job).collect();
        let numbers: Vec<_> = leases.iter().map(|lease| lease.number).collect();
        let held: Vec<(i64, bool, i64)> = sqlx::query_as(
            "SELECT n, cancel_requested, lease_expires_at \
             FROM unnest($1::uuid[], $2::bigint[]) WITH ORDINALITY AS given (id, lease, n) \
             JOIN jobs ON jobs.id = given.id AND jobs.lease = given.lease \
             WHERE status = 'running' AND ($3::uuid IS NULL OR lease_token = $3 OR lease_token IS NULL AND is_remote)",
        )
        .bind(&ids)
        .bind(&numbers)
        .bind(token)
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
                 WHERE status = 'running' AND lease_expires_at < $3 AND ($5::uuid IS NULL OR lease_token = $5 OR lease_token IS NULL AND is_remote) \
                 FOR UPDATE OF jobs SKIP LOCKED) \
                 UPDATE jobs SET lease_expires_at = $4 FROM due WHERE jobs.id = due.id",
            )
            .bind(&ids)
            .bind(&numbers)
            .bind(renewed_until)
            .bind(now.end_of(length))
            .bind(token)
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

    pub(in crate::store) async fn write_end(
        &self,
        lease: Lease,
        update: &JobUpdate,
        end: &End,
    ) -> Result<Option<Status>, StoreError> {
        let write = Write {
            lease,
            update: update.clone(),
            kind: WriteKind::End(Box::new(end.clone())),
        };
        let written = self.write(write).await?;
        let LeaseEffect::Ended(status) = written.effect else {
            self.process.stale_write();
            return Ok(None);
        };
        if !written.is_repeated {
            self.process.ended_by_worker(lease.job, status);
        }
        Ok(status)
    }
}
