//! Notes contacts with remote workers in the store, and reads there who takes no more jobs.

use std::sync::Arc;
use std::time::Duration;

use tokio_util::sync::CancellationToken;

use crate::http::WorkerRegistry;
use crate::store::Store;

/// Time between two looks: a drain reaches the workers of other services within it.
const EVERY: Duration = Duration::from_secs(2);

/// Runs until the service stops.
pub(super) async fn note_workers(
    store: Arc<Store>,
    workers: Arc<WorkerRegistry>,
    stopping: CancellationToken,
) {
    loop {
        tokio::select! {
            () = stopping.cancelled() => return,
            () = tokio::time::sleep(EVERY) => {}
        }
        if let Err(error) = workers.exchange(&store).await {
            tracing::warn!(%error, "contacts with workers could not be noted");
        }
    }
}
