//! Workers: each takes a job from the queue, supervises one child process that solves it, and writes what it tells.

mod batcher;
mod child;
mod gather;
mod supervisor;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use tokio_util::sync::CancellationToken;

use crate::clock::now_ms;
use crate::store::{Store, StoreError};

/// How long a lease holds; renewed several times within.
pub const LEASE: Duration = Duration::from_secs(10);
/// How often an idle worker looks for itself, should it have missed a call.
const LOOK: Duration = Duration::from_secs(1);
/// Pause after the store failed.
const STORE_PAUSE: Duration = Duration::from_secs(1);

/// When a lease taken or renewed now ends, ms.
fn lease_end() -> i64 {
    now_ms().saturating_add(i64::try_from(LEASE.as_millis()).unwrap_or(i64::MAX))
}

/// Takes and supervises jobs until the service stops. `program` is the binary with the hidden subcommand `solve-child`.
pub async fn work(store: Arc<Store>, program: PathBuf, stopping: CancellationToken) {
    while !stopping.is_cancelled() {
        match next(&store, &program, &stopping).await {
            Ok(true) => {}
            Ok(false) => {
                tokio::select! {
                    () = store.job_waiting() => {}
                    () = tokio::time::sleep(LOOK) => {}
                    () = stopping.cancelled() => {}
                }
            }
            Err(error) => {
                tracing::error!(%error, "a worker could not use the store");
                tokio::time::sleep(STORE_PAUSE).await;
            }
        }
    }
}

/// Takes one job and sees it through; `false` if none was waiting.
async fn next(
    store: &Store,
    program: &std::path::Path,
    stopping: &CancellationToken,
) -> Result<bool, StoreError> {
    let Some(claim) = store.claim(now_ms(), lease_end()).await? else {
        return Ok(false);
    };
    tracing::info!(job = %claim.id, lease = claim.lease, "job taken");
    supervisor::supervise(store, &claim, program, stopping).await?;
    Ok(true)
}
