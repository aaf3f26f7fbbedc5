//! The heartbeat of the workers of a process: renews their leases, and reports their health.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::time::MissedTickBehavior;

use super::options::RemoteOptions;
use crate::client::ClientError;
use crate::store::{Lease, LeaseState};
use crate::worker::protocol::{LeasesBody, MOST_LEASES};

/// Interval of the heartbeat of all jobs of a worker, which also brings cancel requests.
const HEARTBEAT: Duration = Duration::from_secs(2);

/// Leases of this worker, and their states by the last answers of the service.
pub(super) type Leases = Arc<Mutex<HashMap<Lease, LeaseState>>>;

/// Renews all leases, in one request unless they are too many, and reports the health of the workers, until its task is aborted.
pub(super) async fn beat(options: RemoteOptions, leases: Leases) {
    let mut timer = tokio::time::interval(HEARTBEAT);
    timer.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let (mut failures, mut was_failing) = (0_u32, false);
    loop {
        timer.tick().await;
        let failing = options.health.failing();
        let all: Vec<_> = held(&leases).keys().copied().collect();
        let mut parts: Vec<_> = all.chunks(MOST_LEASES).collect();
        if parts.is_empty() && (failing.is_some() || was_failing) {
            parts.push(&[]);
        }
        was_failing = failing.is_some();
        for part in parts {
            match renew(&options, part, failing.clone()).await {
                Ok(states) => {
                    failures = 0;
                    let mut known = held(&leases);
                    for (lease, state) in part.iter().zip(states) {
                        // The attempt may have ended meanwhile.
                        known.entry(*lease).and_modify(|known| *known = state);
                    }
                }
                Err(error) => {
                    failures += 1;
                    // Logs seldom while the service cannot be reached.
                    if failures.is_power_of_two() {
                        tracing::warn!(%error, failures, "leases could not be renewed");
                    }
                }
            }
        }
    }
}

/// Renews leases; returns their states.
async fn renew(
    options: &RemoteOptions,
    leases: &[Lease],
    failing: Option<String>,
) -> Result<Vec<LeaseState>, ClientError> {
    let body = LeasesBody {
        worker: options.worker,
        leases: leases.to_vec(),
        length: options.lease,
        failing,
    };
    options.client.post("/v1/worker/leases", &body).await
}

pub(super) fn held(leases: &Leases) -> MutexGuard<'_, HashMap<Lease, LeaseState>> {
    leases.lock().unwrap_or_else(PoisonError::into_inner)
}
