//! Maintenance beside the workers: jobs of lost workers, deadlines, retention, the write-ahead log.

use std::sync::Arc;
use std::time::{Duration, Instant};

use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;
use tracing::Instrument;

use crate::store::{OWNER_HEARTBEAT, Reclaimed, Store, StoreError};
use crate::worker;
use crate::worker::WorkerConfig;

/// Interval between two checks for expired leases and deadlines.
const INTERVAL: Duration = Duration::from_secs(1);
/// Rounds between two checkpoints of the write-ahead log.
const WAL_ROUNDS: u32 = 60;

/// Runs until the service stops. `reclaimed` are the jobs that were reclaimed at its start.
pub(super) async fn maintain(
    store: Arc<Store>,
    config: Arc<WorkerConfig>,
    keep_days: Option<u32>,
    reclaimed: Reclaimed,
    stopping: CancellationToken,
) {
    let lease = config.lease;
    let mut finalizing = JoinSet::new();
    finalize(&store, &config, reclaimed, &mut finalizing);
    let mut rounds = 0_u32;
    // Since when process and store have run without a stall. After a stall all leases are expired, also those of this
    // process's own supervisors, which first get the time of one lease to renew them.
    let mut healthy = Some(Instant::now());
    loop {
        let started = Instant::now();
        tokio::select! {
            () = stopping.cancelled() => return,
            () = tokio::time::sleep(INTERVAL) => {}
        }
        if started.elapsed() > INTERVAL + lease / 2 {
            tracing::warn!("the service stalled; expired leases are ignored for a while");
            healthy = None;
        }
        while finalizing.try_join_next().is_some() {}
        if let Err(error) = store.give_pages_back().await {
            tracing::warn!(%error, "free pages of the database could not be given back");
        }
        reserve_disk(&store).await;
        let reclaims = healthy.is_some_and(|since| since.elapsed() >= lease);
        let started = Instant::now();
        healthy = match round(&store, &config, reclaims, keep_days).await {
            Ok(reclaimed) => {
                finalize(&store, &config, reclaimed, &mut finalizing);
                let is_healthy = started.elapsed() <= lease / 2;
                is_healthy.then(|| healthy.unwrap_or_else(Instant::now))
            }
            Err(error) => {
                tracing::error!(%error, "expired leases and deadlines could not be checked");
                None
            }
        };
        rounds = (rounds + 1) % WAL_ROUNDS;
        if rounds == 0 {
            each_minute(&store).await;
        }
    }
}

async fn each_minute(store: &Store) {
    if let Err(error) = store.count_time().await {
        tracing::warn!(%error, "the time until jobs are deleted could not be counted");
    }
    if let Err(error) = store.checkpoint_wal().await {
        tracing::warn!(%error, "the write-ahead log could not be checkpointed");
    }
}

/// Writes heartbeats as the owner of the database until the service stops; stops it if another process has become the owner.
pub(super) async fn beat(store: Arc<Store>, stopping: CancellationToken) {
    loop {
        tokio::select! {
            () = stopping.cancelled() => return,
            () = tokio::time::sleep(OWNER_HEARTBEAT) => {}
        }
        match store.beat().await {
            Err(error @ StoreError::Served { .. }) => {
                tracing::error!(%error, "the service stops");
                stopping.cancel();
                return;
            }
            Err(error) => tracing::warn!(%error, "no heartbeat could be written"),
            Ok(()) => {}
        }
    }
}

/// Reserves disk space again if it was released. Writing it may take a while.
async fn reserve_disk(store: &Store) {
    if store.disk().is_full() {
        let disk = Arc::clone(store.disk());
        // A task that panics has reserved nothing; the next round tries again.
        let _ = tokio::task::spawn_blocking(move || disk.reserve_again()).await;
    }
}

/// Ends jobs without another attempt, in tasks of their own: their results may be large, and the disk may be full.
fn finalize(
    store: &Arc<Store>,
    config: &Arc<WorkerConfig>,
    reclaimed: Reclaimed,
    finalizing: &mut JoinSet<()>,
) {
    for claim in reclaimed.ending {
        let (store, config) = (Arc::clone(store), Arc::clone(config));
        let span = tracing::info_span!("job", id = %claim.id, lease = claim.lease, attempt = claim.attempt);
        let ending = async move {
            if let Err(error) =
                worker::finalize_lost_job(&store, &claim, &config, reclaimed.reason).await
            {
                tracing::error!(%error, "a job whose worker was lost could not be ended");
            }
        };
        finalizing.spawn(ending.instrument(span));
    }
}

async fn round(
    store: &Store,
    config: &WorkerConfig,
    reclaims: bool,
    keep_days: Option<u32>,
) -> Result<Reclaimed, StoreError> {
    let reclaimed = if reclaims {
        store.reclaim_expired(config.lease).await?
    } else {
        Reclaimed::default()
    };
    let (queued, ending) = (reclaimed.queued, reclaimed.ending.len());
    if queued + ending > 0 {
        tracing::warn!(queued, ending, "jobs reclaimed from lost workers");
    }
    let expired = store.expire().await?;
    if expired > 0 {
        tracing::warn!(
            expired,
            "jobs failed because their deadline passed while they waited"
        );
    }
    if let Some(days) = keep_days
        && let Err(error) = delete_old(store, days).await
    {
        // Reclaimed jobs continue all the same.
        tracing::error!(%error, "old jobs could not be deleted");
    }
    Ok(reclaimed)
}

async fn delete_old(store: &Store, days: u32) -> Result<(), StoreError> {
    let deleted = store
        .delete_older(Duration::from_hours(24 * u64::from(days)))
        .await?;
    if deleted > 0 {
        tracing::info!(deleted, keep_days = days, "old jobs deleted");
    }
    Ok(())
}
