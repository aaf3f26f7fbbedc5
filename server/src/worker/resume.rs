//! The checkpoint that an attempt starts from, which may have to be asked for.

use std::borrow::Cow;
use std::time::Instant;

use tokio_util::sync::CancellationToken;

use crate::queue::Transition;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::{ClaimedCheckpoint, End, LeaseState};
use crate::worker::attempt::{Attempt, retry};
use crate::worker::config::RETRY;
use crate::worker::end::{STOPPED, cancelled, deadline_passed};
use crate::worker::job_source::{JobSource, JobSourceError};
use crate::worker::update_buffer::UpdateBuffer;

/// How an attempt starts.
pub(super) enum Start<'a> {
    /// From a checkpoint, or at cycle 0.
    From(Option<Cow<'a, EncodedCheckpoint>>),
    /// Not at all: it ends.
    Never(Box<End>),
    /// Not at all: another worker holds the job.
    LeaseLost,
}

/// How an attempt starts: from its checkpoint if it has one.
///
/// # Errors
/// [`JobSourceError`] if the job source fails for good.
pub(super) async fn start_of<'a, E: JobSource>(
    attempt: Attempt<'a, E>,
    buffer: &mut UpdateBuffer,
    deadline: Option<Instant>,
    stopping: &CancellationToken,
) -> Result<Start<'a>, JobSourceError> {
    if stopping.is_cancelled() {
        return Ok(stopped());
    }
    match &attempt.claim.checkpoint {
        None => Ok(Start::From(None)),
        Some(ClaimedCheckpoint::Given(checkpoint)) => {
            Ok(Start::From(Some(Cow::Borrowed(checkpoint))))
        }
        Some(ClaimedCheckpoint::Stored { .. }) => stored(attempt, buffer, deadline, stopping).await,
    }
}

/// Asks for the checkpoint, and waits for a store of objects that does not answer. A run whose checkpoint is damaged starts at cycle 0.
async fn stored<'a, E: JobSource>(
    attempt: Attempt<'a, E>,
    buffer: &mut UpdateBuffer,
    deadline: Option<Instant>,
    stopping: &CancellationToken,
) -> Result<Start<'a>, JobSourceError> {
    let (job_source, lease) = (attempt.job_source, attempt.lease());
    let mut failures = 0;
    loop {
        let answer = tokio::select! {
            answer = job_source.checkpoint(lease) => answer,
            () = stopping.cancelled() => return Ok(stopped()),
        };
        match answer {
            Ok(Some(checkpoint)) => return Ok(Start::From(Some(Cow::Owned(checkpoint)))),
            Ok(None) => break,
            Err(error) if error.is_temporary() => {
                tracing::warn!(%error, "the checkpoint could not be read; retrying");
            }
            Err(error) => return Err(error),
        }
        if deadline.is_some_and(|at| Instant::now() >= at) {
            return Ok(Start::Never(Box::new(deadline_passed())));
        }
        match job_source.lease_state(lease).await {
            Ok(LeaseState::Held {
                cancel_requested: true,
            }) => return Ok(Start::Never(Box::new(cancelled()))),
            Ok(LeaseState::Lost) => return Ok(Start::LeaseLost),
            Ok(LeaseState::Held { .. }) | Err(_) => {}
        }
        failures += 1;
        tokio::select! {
            () = stopping.cancelled() => return Ok(stopped()),
            () = tokio::time::sleep(RETRY.jittered_pause_after(failures)) => {}
        }
    }
    tracing::warn!("its checkpoint is missing or damaged; the run starts at cycle 0");
    let number = buffer.restart("its checkpoint is missing or damaged".to_owned());
    Ok(match retry(|| job_source.restart(lease, number)).await? {
        LeaseState::Held { .. } => Start::From(None),
        LeaseState::Lost => Start::LeaseLost,
    })
}

/// End of an attempt whose worker is asked to stop.
fn stopped<'a>() -> Start<'a> {
    let end = End::without_result(Transition::Release, STOPPED);
    Start::Never(Box::new(end))
}
