//! Workers: each claims a job, supervises one child process that solves it, and stores its results.

mod attempt;
mod config;
mod end;
mod manifest;
mod supervisor;
mod update_buffer;

use std::sync::Arc;
use std::time::{Duration, Instant};

use tokio_util::sync::CancellationToken;
use tracing::Instrument;

use crate::clock::Now;
use crate::store::{Claim, Store, StoreError};

use attempt::Attempt;
use config::RETRY_PAUSE;
use supervisor::supervise;

pub use attempt::finalize_lost_job;
pub use config::WorkerConfig;

/// Interval at which an idle worker polls the queue, in case it missed a notification.
const POLL_INTERVAL: Duration = Duration::from_secs(1);

/// Claims and supervises jobs until the service stops. A panic ends it; its job is then reclaimed when the lease ends.
pub async fn work(store: Arc<Store>, config: Arc<WorkerConfig>, stopping: CancellationToken) {
    while !stopping.is_cancelled() {
        // Summaries make it too large for the stack of a task.
        match Box::pin(next(&store, &config, &stopping)).await {
            Ok(true) => {}
            Ok(false) => {
                tokio::select! {
                    () = store.job_waiting() => {}
                    () = tokio::time::sleep(POLL_INTERVAL) => {}
                    () = stopping.cancelled() => {}
                }
            }
            Err(error) => {
                // Jobs that wait say so, and the next write has to be a small one.
                store.disk().release_after(&error);
                tracing::error!(%error, "a worker could not use the store");
                tokio::time::sleep(RETRY_PAUSE).await;
            }
        }
    }
}

/// Claims one job and supervises it to its end; `false` if there was none to claim.
async fn next(
    store: &Store,
    config: &WorkerConfig,
    stopping: &CancellationToken,
) -> Result<bool, StoreError> {
    if store.disk().shortage().is_some() {
        return Ok(false);
    }
    let claimed = store
        .claim_within(config.memory_mb, Now::read(), config.lease_end())
        .await?;
    let Some(claim) = claimed else {
        return Ok(false);
    };
    count_claim(store, &claim);
    let _busy = store.metrics().busy_worker();
    let span =
        tracing::info_span!("job", id = %claim.id, lease = claim.lease, attempt = claim.attempt);
    let started = Instant::now();
    let attempt = Attempt {
        store,
        claim: &claim,
        config,
    };
    supervise(attempt, stopping).instrument(span).await?;
    let solve_s = started.elapsed().as_secs_f64();
    store.metrics().solve_duration.observe(solve_s);
    Ok(true)
}

fn count_claim(store: &Store, claim: &Claim) {
    let metrics = store.metrics();
    metrics.attempts.inc();
    if claim.lease == 1 {
        let waited = u64::try_from(claim.waited_ms).unwrap_or_default();
        let waited = Duration::from_millis(waited);
        metrics.claim_latency.observe(waited.as_secs_f64());
    }
}

#[cfg(test)]
mod tests;
