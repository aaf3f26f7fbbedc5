//! Workers: each takes a job from the queue, supervises one child process that solves it, and writes what it tells.

mod batcher;
mod child;
mod ending;
mod gather;
mod rules;
mod supervisor;
mod verdict;

use std::panic::AssertUnwindSafe;
use std::sync::Arc;
use std::time::{Duration, Instant};

use futures_util::FutureExt;
use tokio_util::sync::CancellationToken;
use tracing::Instrument;

use crate::clock::{now_ms, steady_ms};
use crate::store::{Claim, Store, StoreError};

pub use ending::bury;
pub use rules::Rules;

/// How often an idle worker looks for itself, should it have missed a call.
const LOOK: Duration = Duration::from_secs(1);
/// Pause after the store failed.
const STORE_PAUSE: Duration = Duration::from_secs(1);

impl Rules {
    /// When a lease taken or renewed now ends, ms of the steady clock.
    pub fn lease_end(&self) -> i64 {
        steady_ms().saturating_add(i64::try_from(self.lease.as_millis()).unwrap_or(i64::MAX))
    }
}

/// Takes and supervises jobs until the service stops.
pub async fn work(store: Arc<Store>, rules: Arc<Rules>, stopping: CancellationToken) {
    // Before the service was started it may have been.
    let mut short_of_disk = true;
    while !stopping.is_cancelled() {
        let turn = AssertUnwindSafe(next(&store, &rules, &mut short_of_disk, &stopping));
        match turn.catch_unwind().await {
            Ok(Ok(true)) => {}
            Ok(Ok(false)) => {
                tokio::select! {
                    () = store.job_waiting() => {}
                    () = tokio::time::sleep(LOOK) => {}
                    () = stopping.cancelled() => {}
                }
            }
            Ok(Err(error)) => {
                tracing::error!(%error, "a worker could not use the store");
                tokio::time::sleep(STORE_PAUSE).await;
            }
            // The panic is in the log. The job is taken back when its lease ends, and the worker works on.
            Err(_) => tokio::time::sleep(STORE_PAUSE).await,
        }
    }
}

/// Takes one job and sees it through; `false` if none could be taken.
async fn next(
    store: &Store,
    rules: &Rules,
    short_of_disk: &mut bool,
    stopping: &CancellationToken,
) -> Result<bool, StoreError> {
    if let Some(reason) = rules.disk_shortage() {
        *short_of_disk = true;
        store.explain_waiting(&reason).await?;
        return Ok(false);
    }
    if *short_of_disk {
        store.explain_no_shortage().await?;
        *short_of_disk = false;
    }
    let claimed = store
        .claim_within(rules.memory_mb, now_ms(), rules.lease_end())
        .await?;
    let Some(claim) = claimed else {
        return Ok(false);
    };
    count(store, &claim);
    let span =
        tracing::info_span!("job", id = %claim.id, lease = claim.lease, attempt = claim.attempt);
    let began = Instant::now();
    supervisor::supervise(store, &claim, rules, stopping)
        .instrument(span)
        .await?;
    let metrics = store.metrics();
    metrics
        .solve_duration
        .observe(began.elapsed().as_secs_f64());
    Ok(true)
}

fn count(store: &Store, claim: &Claim) {
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
