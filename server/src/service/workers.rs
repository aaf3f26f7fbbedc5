//! Notes contacts with remote workers in the store, and reads there who takes no more jobs.

use std::sync::Arc;
use std::time::Duration;

use tokio_util::sync::CancellationToken;

use crate::http::WorkerRegistry;
use crate::store::Store;

/// Interval: a drain reaches the workers of other services within it.
const EVERY: Duration = Duration::from_secs(2);

/// Runs until the service stops.
pub(super) async fn note_workers(
    store: Arc<Store>,
    workers: Arc<WorkerRegistry>,
    stopping: CancellationToken,
) {
    loop {
        workers.exchange(&store).await;
        tokio::select! {
            () = stopping.cancelled() => return,
            () = tokio::time::sleep(EVERY) => {}
        }
    }
}
