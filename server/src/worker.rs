//! Workers: each claims a job, supervises one child process that solves it, and hands its results to its job source.

mod attempt;
mod computed;
mod config;
mod end;
mod health;
mod job_source;
mod manifest;
mod process;
pub mod protocol;
mod remaining;
mod resume;
mod supervisor;
mod update_buffer;

use std::sync::Arc;
use std::time::Duration;

use tokio_util::sync::CancellationToken;
use tracing::Instrument;

use crate::store::Lease;

use attempt::Attempt;
use config::RETRY;
use process::Claimed;
use supervisor::supervise;

pub use attempt::finalize_lost_job;
pub use config::{REMOTE_LEASE, WorkerConfig};
pub use health::WorkerHealth;
pub use job_source::{JobSource, JobSourceError, Remote, RemoteOptions};
pub use process::WorkerProcess;

/// Interval at which an idle worker polls the queue, in case it missed a notification.
const POLL_INTERVAL: Duration = Duration::from_secs(1);

/// Claims and supervises jobs until it is asked to stop, or is given no more. A panic ends it; its job is then reclaimed when the lease ends.
///
/// # Errors
/// [`JobSourceError`] if the job source does not accept this worker.
pub async fn work<E: JobSource>(
    job_source: Arc<E>,
    process: Arc<WorkerProcess>,
    config: Arc<WorkerConfig>,
    stopping: CancellationToken,
) -> Result<(), JobSourceError> {
    while !stopping.is_cancelled() {
        // Summaries make it too large for the stack of a task.
        match Box::pin(next(&*job_source, &process, &config, &stopping)).await {
            Ok(true) => {}
            Ok(false) if config.until_idle && is_idle(&*job_source).await => return Ok(()),
            Ok(false) => {
                tokio::select! {
                    () = job_source.job_waiting() => {}
                    () = tokio::time::sleep(POLL_INTERVAL) => {}
                    () = stopping.cancelled() => {}
                }
            }
            Err(error) if error.is_drained() => {
                tracing::info!(%error, "a worker ends");
                return Ok(());
            }
            Err(error) if error.is_rejected() => return Err(error),
            // A claim has been followed by a pause of all workers of the process.
            Err(error) => {
                tracing::warn!(%error, "claim failed; retrying");
                tokio::time::sleep(RETRY.first).await;
            }
        }
    }
    Ok(())
}

/// Claims of a worker; when it is dropped, what is left of them is abandoned.
struct Unfinished<'a, E: JobSource> {
    job_source: &'a E,
    leases: Vec<Lease>,
}

impl<E: JobSource> Drop for Unfinished<'_, E> {
    fn drop(&mut self) {
        for lease in &self.leases {
            self.job_source.abandon(*lease);
        }
    }
}

/// Returns `true` if no job waits or runs anywhere; without an answer there may be one.
async fn is_idle(job_source: &impl JobSource) -> bool {
    job_source.is_idle().await.unwrap_or_else(|error| {
        tracing::warn!(%error, "request for waiting jobs failed");
        false
    })
}

/// Claims jobs and supervises them to their ends, one after the other; `false` if there was none to claim.
async fn next<E: JobSource>(
    job_source: &E,
    process: &WorkerProcess,
    config: &WorkerConfig,
    stopping: &CancellationToken,
) -> Result<bool, JobSourceError> {
    let claimed = process.claim(job_source, config, stopping).await?;
    let Some(Claimed {
        claims,
        memory,
        round,
    }) = claimed
    else {
        return Ok(false);
    };
    // Also after an error or a panic, without an end.
    let _unfinished = Unfinished {
        job_source,
        leases: claims.iter().map(Lease::from).collect(),
    };
    for claim in &claims {
        let attempt = Attempt {
            job_source,
            claim,
            config,
            threads: memory.threads,
            round,
        };
        let span = tracing::info_span!("job", id = %claim.id, lease = claim.lease, attempt = claim.attempt);
        let _busy = job_source.busy();
        supervise(attempt, stopping).instrument(span).await?;
    }
    Ok(true)
}

#[cfg(test)]
mod tests;
