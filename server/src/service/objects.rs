//! Moves results of succeeded jobs to the store of objects.

use std::sync::Arc;
use std::time::Duration;

use tokio_util::sync::CancellationToken;

use crate::store::Store;

/// Results that are moved in a round after which there may be more: the next one follows at once. Arbitrary.
const MANY: usize = 256;
/// Pause after another round.
const PAUSE: Duration = Duration::from_secs(1);
/// Longest pause after an error; the first one is [`PAUSE`], and each is twice as long as the last one.
const LONGEST_PAUSE: Duration = Duration::from_secs(30);

/// Runs until the service stops. Objects whose writing is interrupted are removed at the next start.
pub(super) async fn move_results(store: Arc<Store>, stopping: CancellationToken) {
    let (mut moved, mut pause) = (Vec::new(), PAUSE);
    loop {
        let round = async {
            let (now, ended) = store.move_results().await;
            // Requests that were about to read these files have had a pause, or the time of a round.
            store.remove_moved(&moved).await;
            (now, ended)
        };
        let ended;
        (moved, ended) = tokio::select! {
            () = stopping.cancelled() => return,
            round = round => round,
        };
        let is_behind = moved.len() >= MANY;
        let count = u64::try_from(moved.len()).unwrap_or_default();
        store.metrics().results_moved.inc_by(count);
        match ended {
            Ok(()) if is_behind => continue,
            Ok(()) => pause = PAUSE,
            Err(error) => {
                tracing::warn!(%error, "results could not be moved; they stay in the database meanwhile");
                pause = (2 * pause).min(LONGEST_PAUSE);
            }
        }
        tokio::select! {
            () = stopping.cancelled() => return,
            () = tokio::time::sleep(pause) => {}
        }
    }
}
