//! An attempt at a job: its lease, which is renewed until the end, and its end: the last updates, and the transition.

use std::sync::Arc;
use std::time::Duration;

use tokio::time::MissedTickBehavior;

use crate::queue::Transition;
use crate::store::{Claim, End, JobUpdate, Lease, LeaseState, Store};
use crate::worker::computed::Computed;
use crate::worker::config::{RETRY, WorkerConfig};
use crate::worker::health::Round;
use crate::worker::job_source::{JobSource, JobSourceError};
use crate::worker::manifest::{Documents, make_documents};

/// Heartbeats within a lease.
const HEARTBEATS: u32 = 3;

/// An attempt at a job under a lease.
pub(super) struct Attempt<'a, E> {
    pub(super) job_source: &'a E,
    pub(super) claim: &'a Claim,
    pub(super) config: &'a WorkerConfig,
    /// Threads of its solving process.
    pub(super) threads: usize,
    pub(super) round: Round<'a>,
}

impl<E> Clone for Attempt<'_, E> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<E> Copy for Attempt<'_, E> {}

impl<E: JobSource> Attempt<'_, E> {
    pub(super) fn lease(&self) -> Lease {
        self.claim.into()
    }

    /// Awaits a task while the lease is renewed, independently of the solver. A lost lease is detected by the next
    /// write.
    pub(super) async fn with_heartbeat<T>(&self, task: impl Future<Output = T>) -> T {
        with_heartbeat(self.job_source, self.lease(), self.config.lease, task).await
    }

    /// Writes the last updates and ends the attempt. `number` is that of the end, after those of the updates.
    pub(super) async fn finalize(
        &self,
        updates: &[JobUpdate],
        mut number: i64,
        end: &End,
        computed: Option<Computed>,
    ) -> Result<(), JobSourceError> {
        let lease = self.lease();
        match end.transition {
            Transition::Decline => (self.round).declined(end.reason.as_deref().unwrap_or_default()),
            Transition::Release => {}
            _ => self.round.ended(),
        }
        let is_final = |error: &JobSourceError| {
            let is_full = error.is_disk_full() || error.is_without_objects();
            end.transition == Transition::Cancel && is_full
        };
        // The events of the updates precede the end, so they are written first, under the same lease.
        for update in updates {
            let record = || self.job_source.record(lease, update, self.config.lease);
            match retry_unless(record, is_final).await {
                Ok(LeaseState::Held { .. }) => {}
                Ok(LeaseState::Lost) => return Ok(()),
                // The rest of a cancelled job is not recorded; the job ends by the write that follows the last one recorded.
                Err(error) if is_final(&error) => {
                    number = update.number;
                    break;
                }
                Err(error) => return Err(error),
            }
        }
        let mut last = JobUpdate {
            number,
            progress: updates
                .last()
                .map(|update| update.progress.clone())
                .unwrap_or_default(),
            ..JobUpdate::default()
        };
        // Of other ends the job source decides whether they are final.
        if let Some(computed) = computed.filter(|_| end.transition == Transition::Succeed) {
            let computed = Arc::new(computed);
            (last.files, last.block) = retry(|| self.documents(end, &computed)).await?;
        }
        retry(|| self.job_source.finish(lease, &last, end)).await?;
        Ok(())
    }

    /// Makes the documents of everything that was computed.
    async fn documents(
        &self,
        end: &End,
        computed: &Arc<Computed>,
    ) -> Result<Documents, JobSourceError> {
        let lease = self.lease();
        let Ok(spec) = serde_json::from_str(&self.claim.spec) else {
            return Ok((Vec::new(), None));
        };
        let (folder, summary) = (self.job_source.folder(lease), end.summary.as_ref());
        let computed = Arc::clone(computed);
        Ok(make_documents(folder, lease.job, spec, summary, computed).await?)
    }
}

/// Ends a job whose last worker was lost, under a lease of its own, with documents of the lost attempt's results.
///
/// # Errors
/// [`JobSourceError`] if the store fails permanently; the job is reclaimed again when the lease ends.
pub async fn finalize_lost_job(
    store: &Store,
    claim: &Claim,
    config: &WorkerConfig,
    reason: &str,
) -> Result<(), JobSourceError> {
    let lease = Lease::from(claim);
    let end = End::without_result(Transition::WorkerLost, reason);
    let finalized = async {
        let job = retry(async || Ok::<_, JobSourceError>(store.job(claim.id).await?)).await?;
        let last = JobUpdate {
            number: 1,
            progress: job.map(|job| job.document.progress).unwrap_or_default(),
            ..JobUpdate::default()
        };
        retry(|| JobSource::finish(store, lease, &last, &end)).await
    };
    // Summaries make it too large for the stack of a task.
    with_heartbeat(store, lease, config.lease, Box::pin(finalized)).await?;
    Ok(())
}

async fn with_heartbeat<E: JobSource, T>(
    job_source: &E,
    lease: Lease,
    length: Duration,
    task: impl Future<Output = T>,
) -> T {
    let mut timer = tokio::time::interval(length / HEARTBEATS);
    timer.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let heartbeat = async {
        loop {
            timer.tick().await;
            if let Err(error) = job_source.renew(lease, length).await {
                tracing::warn!(%error, "the lease could not be renewed");
            }
        }
    };
    tokio::select! {
        done = task => done,
        never = heartbeat => never,
    }
}

/// Retries an operation until the job source accepts it: a stalled store or a full disk must not cost a finished solve. The
/// fence discards writes that come too late.
pub(super) async fn retry<T, F: Future<Output = Result<T, JobSourceError>>>(
    operation: impl Fn() -> F,
) -> Result<T, JobSourceError> {
    retry_unless(operation, |_| false).await
}

/// The same until an error of which nothing better is expected.
async fn retry_unless<T, F: Future<Output = Result<T, JobSourceError>>>(
    operation: impl Fn() -> F,
    is_final: impl Fn(&JobSourceError) -> bool,
) -> Result<T, JobSourceError> {
    let mut failures = 0;
    loop {
        match operation().await {
            Err(error) if error.is_temporary() && !is_final(&error) => {
                tracing::warn!(%error, "the job source failed; retrying");
                failures += 1;
                tokio::time::sleep(RETRY.jittered_pause_after(failures)).await;
            }
            answer => return answer,
        }
    }
}
