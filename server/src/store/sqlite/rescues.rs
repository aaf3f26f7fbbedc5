//! Taking jobs back from lost workers: into the queue, or under a new lease to be ended.

use uuid::Uuid;

use crate::queue::Transition;
use crate::store::sqlite::conclusion::{End, Standing, conclude};
use crate::store::sqlite::leases::Claim;
use crate::store::sqlite::queries::{BEGIN, job_id};
use crate::store::{Store, StoreError};

/// What was taken back.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Reclaimed {
    /// How many jobs wait in the queue again.
    pub queued: usize,
    /// Jobs that are not tried again. They are held here, so that what they left can be gathered before they end.
    pub ending: Vec<Claim>,
    /// Why they were taken back.
    pub reason: &'static str,
}

#[derive(sqlx::FromRow)]
struct Lost {
    id: String,
    spec: String,
    attempts: i64,
    cancel_requested: bool,
    deadline_at: Option<i64>,
    memory_mb: i64,
}

impl Lost {
    fn standing(&self) -> Standing {
        Standing {
            attempts: self.attempts,
            cancel_requested: self.cancel_requested,
        }
    }

    /// A claim under a new lease; nothing is solved under it.
    fn claim(self, id: Uuid, lease: i64) -> Claim {
        Claim {
            id,
            lease,
            spec: self.spec,
            attempt: u32::try_from(self.attempts).unwrap_or(u32::MAX),
            waited_ms: 0,
            deadline_at: self.deadline_at,
            memory_mb: self.memory_mb,
            checkpoint: None,
        }
    }
}

impl Store {
    /// Takes running jobs back whose lease has ended by this time. Those that are not tried again are held under new
    /// leases until `expires_at`.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn rescue_expired(&self, by: i64, expires_at: i64) -> Result<Reclaimed, StoreError> {
        self.rescue(by, expires_at, "its worker was lost").await
    }

    /// Takes all running jobs back, at start-up: the process that held them is gone.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn rescue_all(&self, expires_at: i64) -> Result<Reclaimed, StoreError> {
        let reason = "the service was ended while it ran";
        self.rescue(i64::MAX, expires_at, reason).await
    }

    async fn rescue(
        &self,
        by: i64,
        expires_at: i64,
        reason: &'static str,
    ) -> Result<Reclaimed, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let lost: Vec<Lost> = sqlx::query_as(
            "SELECT id, spec, attempts, cancel_requested, deadline_at, memory_mb FROM jobs \
             WHERE status = 'running' AND lease_expires_at <= ?",
        )
        .bind(by)
        .fetch_all(&mut *transaction)
        .await?;
        let end = End {
            step: Transition::Lose,
            reason: Some(reason.to_owned()),
            outcome: None,
            summary: None,
        };
        let (mut back, mut ending) = (Vec::new(), Vec::new());
        for lost in lost {
            let id = job_id(&lost.id)?;
            let standing = lost.standing().limited(self.attempt_limit);
            if standing.ends(end.step) {
                let lease = sqlx::query_scalar(
                    "UPDATE jobs SET lease = lease + 1, lease_expires_at = ? WHERE id = ? RETURNING lease",
                )
                .bind(expires_at)
                .bind(&lost.id)
                .fetch_one(&mut *transaction)
                .await?;
                ending.push(lost.claim(id, lease));
            } else {
                let status = conclude(&mut transaction, id, &standing, &end, None, 0).await?;
                back.push((id, status));
            }
        }
        transaction.commit().await?;
        for (id, status) in &back {
            self.concluded(*id, *status);
        }
        for _ in 0..back.len() + ending.len() {
            self.metrics.rescues.inc();
        }
        Ok(Reclaimed {
            queued: back.len(),
            ending,
            reason,
        })
    }
}
