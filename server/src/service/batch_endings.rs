//! Cancels and deletes the jobs of large sweeps, after the answer to the request, also after a restart.

use std::sync::Arc;
use std::time::Duration;

use tokio_util::sync::CancellationToken;

use crate::store::Store;

/// Pause after a round that has left nothing to be done, or has failed.
const PAUSE: Duration = Duration::from_secs(1);

/// Runs until the service stops. Several services of one database may do the same: each job is cancelled or deleted once.
pub(super) async fn end_jobs(store: Arc<Store>, stopping: CancellationToken) {
    let round = async || {
        match store.end_jobs_of_batches().await {
            Ok(true) => return,
            Ok(false) => {}
            Err(error) => {
                tracing::error!(%error, "jobs of a sweep could not be cancelled or deleted");
            }
        }
        tokio::time::sleep(PAUSE).await;
    };
    while stopping.run_until_cancelled(round()).await.is_some() {}
}
