//! What goes on beside the workers: jobs taken back from lost workers, deadlines, retention, a short write-ahead log.

use std::sync::Arc;
use std::time::{Duration, Instant};

use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;
use tracing::Instrument;

use crate::clock::{now_ms, steady_ms};
use crate::store::{Reclaimed, Store, StoreError};
use crate::worker;
use crate::worker::Rules;

/// How often expired leases and deadlines are looked for.
const ROUND: Duration = Duration::from_secs(1);
/// Rounds between two looks at the write-ahead log.
const SELDOM: u32 = 60;
/// Milliseconds of a day.
const DAY_MS: i64 = 86_400_000;

/// Works until the service stops. `rescued` was taken back when it started.
pub(super) async fn maintain(
    store: Arc<Store>,
    rules: Arc<Rules>,
    keep_days: Option<u32>,
    rescued: Reclaimed,
    stopping: CancellationToken,
) {
    let lease = rules.lease;
    let mut burials = JoinSet::new();
    bury(&store, &rules, rescued, &mut burials);
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
        while burials.try_join_next().is_some() {}
        let rescues = healthy.is_some_and(|since| since.elapsed() >= lease);
        let began = Instant::now();
        healthy = match round(&store, &rules, rescues, keep_days).await {
            Ok(rescued) => {
                bury(&store, &rules, rescued, &mut burials);
                let quick = began.elapsed() <= lease / 2;
                quick.then(|| healthy.unwrap_or_else(Instant::now))
            }
            Err(error) => {
                tracing::error!(%error, "expired leases and deadlines could not be looked for");
                None
            }
        };
        rounds = (rounds + 1) % SELDOM;
        if rounds == 0
            && let Err(error) = store.checkpoint().await
        {
            tracing::warn!(%error, "the write-ahead log could not be kept short");
        }
    }
}

/// Ends jobs that are not tried again, beside everything else: what they left may be much, and the disk may be full.
fn bury(store: &Arc<Store>, rules: &Arc<Rules>, rescued: Reclaimed, burials: &mut JoinSet<()>) {
    for claim in rescued.ending {
        let (store, rules) = (Arc::clone(store), Arc::clone(rules));
        let span = tracing::info_span!("job", id = %claim.id, lease = claim.lease, attempt = claim.attempt);
        let burial = async move {
            if let Err(error) = worker::bury(&store, &claim, &rules, rescued.reason).await {
                tracing::error!(%error, "a job whose worker was lost could not be ended");
            }
        };
        burials.spawn(burial.instrument(span));
    }
}

async fn round(
    store: &Store,
    rules: &Rules,
    rescues: bool,
    keep_days: Option<u32>,
) -> Result<Reclaimed, StoreError> {
    let rescued = if rescues {
        store.rescue_expired(steady_ms(), rules.lease_end()).await?
    } else {
        Reclaimed::default()
    };
    let (queued, ending) = (rescued.queued, rescued.ending.len());
    if queued + ending > 0 {
        tracing::warn!(queued, ending, "jobs taken back from lost workers");
    }
    let late = store.expire(now_ms()).await?;
    if late > 0 {
        tracing::warn!(
            late,
            "jobs failed because their deadline passed while they waited"
        );
    }
    if let Some(days) = keep_days {
        let before = now_ms().saturating_sub(DAY_MS.saturating_mul(i64::from(days)));
        let deleted = store.delete_ended_before(before).await?;
        if deleted > 0 {
            tracing::info!(deleted, keep_days = days, "old jobs deleted");
        }
    }
    Ok(rescued)
}
