//! Health of the workers of one process. Where solving processes cannot be started, or have no space for their files, the fault is this
//! machine's and not that of the jobs: an attempt is declined, no job is claimed for a pause that grows with each round of declined
//! attempts, and then by one worker alone, until a process has started.

use std::time::Duration;

use tokio::sync::watch;
use tokio::time::Instant;

use crate::backoff::Backoff;

/// Pauses before jobs are claimed again, by the number of rounds that were declined in a row.
const PAUSES: Backoff = Backoff {
    first: Duration::from_secs(1),
    longest: Duration::from_mins(1),
};

/// Health of the workers of one process.
#[derive(Debug, Default)]
pub struct WorkerHealth(watch::Sender<State>);

#[derive(Debug, Clone, Default)]
struct State {
    /// Number of the round in which jobs are claimed; a declined attempt ends it.
    round: u64,
    /// Rounds that were declined in a row.
    declined: usize,
    /// Why the last round was declined; `None` since a solving process has started.
    failing: Option<String>,
    /// No job is claimed before.
    paused_until: Option<Instant>,
}

impl State {
    /// Lets no other worker claim a job for a while.
    fn pause(&mut self) {
        self.paused_until = Some(Instant::now() + PAUSES.pause_after(self.declined));
    }
}

/// The round of an attempt.
#[derive(Debug, Clone, Copy)]
pub(super) struct Round<'a> {
    health: &'a WorkerHealth,
    number: u64,
}

impl WorkerHealth {
    /// Why no solving process runs here at present; `None` if the last one has started.
    pub fn failing(&self) -> Option<String> {
        self.0.borrow().failing.clone()
    }

    /// Returns once so many rounds in a row were declined, with the cause of the last one.
    pub async fn declined_in_a_row(&self, most: usize) -> String {
        let mut changes = self.0.subscribe();
        let exhausted = changes.wait_for(|state| state.declined >= most).await;
        let cause = exhausted.map(|state| state.failing.clone());
        cause.ok().flatten().unwrap_or_default()
    }

    /// Waits until a job may be claimed.
    pub(super) async fn resumed(&self) {
        let mut changes = self.0.subscribe();
        loop {
            let paused_until = changes.borrow_and_update().paused_until;
            let Some(until) = paused_until.filter(|until| *until > Instant::now()) else {
                return;
            };
            tokio::select! {
                () = tokio::time::sleep_until(until) => {}
                // The sender is held by `self`.
                _ = changes.changed() => {}
            }
        }
    }

    /// The round of jobs that are being claimed.
    pub(super) fn round(&self) -> Round<'_> {
        Round {
            health: self,
            number: self.0.borrow().round,
        }
    }
}

impl Round<'_> {
    /// Jobs were claimed. After a declined round, other workers wait for what becomes of them.
    pub(super) fn claimed(&self) {
        self.change(|state| {
            if state.failing.is_some() {
                state.pause();
            }
        });
    }

    /// A solving process has started.
    pub(super) fn started(&self) {
        self.change(|state| (state.failing, state.paused_until) = (None, None));
    }

    /// An attempt has ended that was not declined.
    pub(super) fn ended(&self) {
        self.change(|state| state.declined = 0);
    }

    /// An attempt is declined, which ends the round.
    pub(super) fn declined(&self, cause: &str) {
        self.change(|state| {
            state.round += 1;
            state.declined += 1;
            state.failing = Some(cause.to_owned());
            state.pause();
            let pause = PAUSES.pause_after(state.declined);
            tracing::error!(
                cause,
                ?pause,
                "an attempt is declined; no job is claimed for a pause"
            );
        });
    }

    /// Why its attempts are declined, if it has ended.
    pub(super) fn end(&self) -> Option<String> {
        let state = self.health.0.borrow();
        let is_over = state.round != self.number;
        is_over.then(|| state.failing.clone().unwrap_or_default())
    }

    /// Changes the state unless the round has ended: what was claimed before says nothing about the present.
    fn change(&self, change: impl FnOnce(&mut State)) {
        self.health.0.send_if_modified(|state| {
            let is_current = state.round == self.number;
            if is_current {
                change(state);
            }
            is_current
        });
    }
}

#[cfg(test)]
mod tests {
    use futures_util::poll;

    use super::*;

    impl WorkerHealth {
        /// Declines an attempt.
        pub(crate) fn decline(&self, cause: &str) {
            self.round().declined(cause);
        }

        /// Notes that a solving process has started.
        pub(crate) fn start(&self) {
            self.round().started();
        }
    }

    #[tokio::test]
    async fn attempts_that_fail_together_are_one_declined_round() {
        let health = WorkerHealth::default();
        let round = health.round();
        for _ in 0..8 {
            round.declined("no file handles are left");
        }
        assert_eq!(health.0.borrow().declined, 1);
        assert_eq!(
            health.failing().as_deref(),
            Some("no file handles are left")
        );
        assert_eq!(round.end(), health.failing());
        assert_eq!(health.round().end(), None);
        health.round().declined("it is not there");
        assert_eq!(health.declined_in_a_row(2).await, "it is not there");
    }

    #[tokio::test]
    async fn after_a_declined_round_one_worker_claims_and_the_others_wait_until_its_process_has_started()
     {
        let health = WorkerHealth::default();
        health.resumed().await;
        health.round().declined("it is not there");
        let mut waiting = Box::pin(health.resumed());
        assert!(poll!(&mut waiting).is_pending());
        waiting.await;
        let round = health.round();
        round.claimed();
        let mut others = Box::pin(health.resumed());
        assert!(poll!(&mut others).is_pending());
        round.started();
        others.await;
        assert_eq!(health.failing(), None);
    }

    #[test]
    fn pauses_grow_until_an_attempt_of_the_same_round_has_ended() {
        let health = WorkerHealth::default();
        let earlier = health.round();
        health.round().declined("the disk is full");
        health.round().started();
        earlier.ended();
        health.round().declined("the disk is full");
        assert_eq!(health.0.borrow().declined, 2);
        health.round().ended();
        assert_eq!(health.0.borrow().declined, 0);
    }
}
