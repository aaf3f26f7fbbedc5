//! What goes on beside the workers: jobs taken back from lost workers, deadlines, retention, a short write-ahead log.

use std::sync::Arc;
use std::time::{Duration, Instant};

use tokio_util::sync::CancellationToken;

use crate::clock::now_ms;
use crate::store::{Store, StoreError};

/// How often expired leases and deadlines are looked for.
const ROUND: Duration = Duration::from_secs(1);
/// Rounds between two looks at the write-ahead log and at old jobs.
const SELDOM: u32 = 60;
/// Milliseconds of a day.
const DAY_MS: i64 = 86_400_000;

/// Works until the service stops.
pub(super) async fn maintain(
    store: Arc<Store>,
    lease: Duration,
    keep_days: Option<u32>,
    stopping: CancellationToken,
) {
    let mut rounds = 0_u32;
    // Since when the process and its store have gone on without a halt. Where they stood still for a while, all leases
    // are found expired, those of this process's own supervisors too: they are first given a lease's time to renew them.
    let mut healthy = Some(Instant::now());
    loop {
        let began = Instant::now();
        tokio::select! {
            () = stopping.cancelled() => return,
            () = tokio::time::sleep(ROUND) => {}
        }
        if began.elapsed() > ROUND + lease / 2 {
            tracing::warn!("the service stood still; leases are left alone for a while");
            healthy = None;
        }
        let rescues = healthy.is_some_and(|since| since.elapsed() >= lease);
        let began = Instant::now();
        healthy = match round(&store, rescues).await {
            Ok(()) if began.elapsed() <= lease / 2 => healthy.or_else(|| Some(Instant::now())),
            Ok(()) => None,
            Err(error) => {
                tracing::error!(%error, "expired leases and deadlines could not be looked for");
                None
            }
        };
        rounds = (rounds + 1) % SELDOM;
        if rounds == 0
            && let Err(error) = seldom(&store, keep_days).await
        {
            tracing::warn!(%error, "the database could not be kept short");
        }
    }
}

async fn round(store: &Store, rescues: bool) -> Result<(), StoreError> {
    if rescues {
        let rescued = store.rescue_expired(now_ms()).await?;
        if rescued > 0 {
            tracing::warn!(rescued, "jobs taken back from lost workers");
        }
    }
    let late = store.expire(now_ms()).await?;
    if late > 0 {
        tracing::warn!(
            late,
            "jobs failed because their deadline passed while they waited"
        );
    }
    Ok(())
}

async fn seldom(store: &Store, keep_days: Option<u32>) -> Result<(), StoreError> {
    if let Some(days) = keep_days {
        let before = now_ms().saturating_sub(DAY_MS.saturating_mul(i64::from(days)));
        let deleted = store.delete_ended_before(before).await?;
        if deleted > 0 {
            tracing::info!(deleted, keep_days = days, "old jobs deleted");
        }
    }
    store.checkpoint().await
}
