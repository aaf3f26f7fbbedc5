//! Supervision of one job: reads the lines of its solving process, stores them under the lease, reacts to a cancel
//! request and to the stop of the service, ends the attempt.

use std::time::Duration;

use api::job::Outcome;
use api::spec::Spec;
use tokio::time::MissedTickBehavior;
use tokio_util::sync::CancellationToken;

use crate::clock::monotonic_ms;
use crate::queue::Transition;
use crate::solve::Line;
use crate::solve::process::{LineError, ReceivedLine, SolveCommand, SolveProcess};
use crate::spec;
use crate::store::{End, LeaseState, StoreError};
use crate::worker::attempt::{Attempt, retry};
use crate::worker::config::RETRY_PAUSE;
use crate::worker::end::{end_by_exit, failed};
use crate::worker::update_buffer::UpdateBuffer;

/// Interval at which updates are written and the cancel request is read.
const TICK: Duration = Duration::from_millis(150);
/// Longest wait for the end of the output after a malformed line.
const MALFORMED_TIMEOUT: Duration = Duration::from_secs(1);

/// Why reading the output of the process has ended.
enum Stop {
    /// The process closed its output; with its last line, if there was one.
    Output(Option<Box<Line>>),
    /// A line cannot be read.
    Unreadable(LineError),
    /// The user has requested the end of the job.
    Cancelled,
    /// The deadline has passed.
    DeadlinePassed,
    /// Another worker holds the job.
    LeaseLost,
    /// The service stops.
    Shutdown,
}

/// A write that is due.
enum Write {
    Update,
    /// The run restarts, with the cause.
    Restart(String),
}

/// A solving process and the lines of it that are not stored yet.
struct Supervision<'a> {
    attempt: Attempt<'a>,
    process: SolveProcess,
    buffer: UpdateBuffer,
    stopping: &'a CancellationToken,
}

/// Supervises an attempt under a lease that is renewed until the end. Whatever happens to the process, the attempt is
/// ended or another worker holds the job.
pub(super) async fn supervise(
    attempt: Attempt<'_>,
    stopping: &CancellationToken,
) -> Result<(), StoreError> {
    attempt.with_heartbeat(run(attempt, stopping)).await
}

async fn run(attempt: Attempt<'_>, stopping: &CancellationToken) -> Result<(), StoreError> {
    let claim = attempt.claim;
    let cycles = serde_json::from_str::<Spec>(&claim.spec).map_or(0, |spec| spec::cycles(&spec));
    let from_cycle = claim.checkpoint.as_ref().map_or(0, |found| found.cycle);
    tracing::info!(from_cycle, memory_mb = claim.memory_mb, "job claimed");
    let mut buffer = UpdateBuffer::new(cycles, from_cycle);
    let process = match start(attempt) {
        Ok(process) => process,
        Err(cause) => {
            let reason = format!("its solving process could not be started: {cause}");
            let end = End::without_result(Transition::WorkerLost, reason);
            return attempt.finalize(&buffer.take(true), &end).await;
        }
    };
    let mut supervision = Supervision {
        attempt,
        process,
        buffer,
        stopping,
    };
    let stop = supervision.read_output().await?;
    let Some(mut end) = supervision.end_process(stop).await else {
        tracing::warn!("lease lost; nothing more is written");
        return Ok(());
    };
    if end.transition == Transition::Release && stopping.is_cancelled() {
        end.reason = Some("the service was stopped".to_owned());
    }
    let last = supervision.buffer.take(true);
    attempt.finalize(&last, &end).await
}

fn start(attempt: Attempt<'_>) -> std::io::Result<SolveProcess> {
    let Attempt { claim, config, .. } = attempt;
    SolveCommand {
        program: &config.program,
        folder: &attempt.store.attempt_folder(claim),
        spec: &claim.spec,
        checkpoint: claim.checkpoint.as_ref(),
        checkpoint_every: config.checkpoint_every,
        threads: config.threads,
        memory_limit_mb: Some(config.memory_limit_mb(claim.memory_mb)),
        own_group: true,
    }
    .spawn()
}

impl Supervision<'_> {
    async fn read_output(&mut self) -> Result<Stop, StoreError> {
        let mut tick = tokio::time::interval(TICK);
        tick.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let (mut last, mut store_failed) = (None, false);
        loop {
            // While the store fails, lines stay in the pipe, so that memory stays bounded.
            let may_read = !(store_failed && self.buffer.is_full());
            let write = tokio::select! {
                received = self.process.next_line(), if may_read => match received {
                    Ok(Some(ReceivedLine { line: Line::Restarted(cause), .. })) => {
                        Write::Restart(cause)
                    }
                    Ok(Some(ReceivedLine { line, .. })) if line.is_last() => {
                        last = Some(line);
                        continue;
                    }
                    Ok(Some(ReceivedLine { line, bytes })) => {
                        self.buffer.push(line, bytes);
                        if !self.buffer.is_full() {
                            continue;
                        }
                        Write::Update
                    }
                    Ok(None) => return Ok(Stop::Output(last.map(Box::new))),
                    Err(error) => return Ok(self.stop_by(error, last).await),
                },
                _ = tick.tick() => Write::Update,
                () = self.stopping.cancelled() => return Ok(Stop::Shutdown),
            };
            let deadline_at = self.attempt.claim.deadline_at;
            if deadline_at.is_some_and(|at| monotonic_ms() >= at) {
                return Ok(Stop::DeadlinePassed);
            }
            match self.execute(write).await {
                Ok(LeaseState::Held {
                    cancel_requested: false,
                }) => store_failed = false,
                Ok(LeaseState::Held {
                    cancel_requested: true,
                }) => return Ok(Stop::Cancelled),
                Ok(LeaseState::Lost) => return Ok(Stop::LeaseLost),
                // The solve continues and the update is written again; the fence discards writes that come too late.
                Err(error @ (StoreError::Database { .. } | StoreError::DiskFull)) => {
                    tracing::warn!(%error, "the store failed; retrying");
                    if self.is_cancelled_on_full_disk(&error).await {
                        return Ok(Stop::Cancelled);
                    }
                    store_failed = true;
                    tick.reset_after(RETRY_PAUSE);
                }
                Err(error) => return Err(error),
            }
        }
    }

    /// Whether the user cancelled the job while nothing could be stored because the disk is full. The state of the lease
    /// can be read all the same; after another error the next write returns it.
    async fn is_cancelled_on_full_disk(&self, error: &StoreError) -> bool {
        let Attempt { store, claim, .. } = self.attempt;
        store.disk().release_after(error);
        let cancelled = LeaseState::Held {
            cancel_requested: true,
        };
        error.is_disk_full() && store.lease_state(claim).await.ok() == Some(cancelled)
    }

    /// Returns the meaning of a line error. A malformed line at the end of the output was truncated when the process
    /// was killed; followed by more output it is a failure of the solver.
    async fn stop_by(&mut self, error: LineError, last: Option<Line>) -> Stop {
        if matches!(error, LineError::Malformed(_)) {
            let next = tokio::time::timeout(MALFORMED_TIMEOUT, self.process.next_line()).await;
            if matches!(next, Ok(Ok(None))) {
                return Stop::Output(last.map(Box::new));
            }
        }
        Stop::Unreadable(error)
    }

    /// Executes a write. An update without new lines only reads the state of the lease.
    async fn execute(&mut self, write: Write) -> Result<LeaseState, StoreError> {
        let Attempt { store, claim, .. } = self.attempt;
        match write {
            Write::Restart(cause) => {
                tracing::warn!(cause, "the run restarts at cycle 0");
                self.buffer.restart();
                retry(|| store.restart(claim)).await
            }
            Write::Update if self.buffer.is_dirty() => {
                let update = self.buffer.take(false);
                let expires_at = self.attempt.config.lease_end();
                let answer = store.record(claim, &update, expires_at).await;
                if answer.is_err() {
                    self.buffer.put_back(update);
                }
                answer
            }
            Write::Update => store.lease_state(claim).await,
        }
    }

    /// Waits for the exit of the process or kills it. Returns the end of the attempt; `None` if another worker holds
    /// the job.
    async fn end_process(&mut self, stop: Stop) -> Option<End> {
        let end = match stop {
            Stop::Output(last) => {
                return Some(end_by_exit(
                    last.map(|line| *line),
                    &self.process.wait().await,
                ));
            }
            Stop::Shutdown => match self.stop_gracefully().await {
                Some(last) => return Some(end_by_exit(Some(last), &self.process.wait().await)),
                None => Some(End::without_result(Transition::Release, "")),
            },
            Stop::Cancelled => Some(End::without_result(
                Transition::Cancel,
                "cancelled while running",
            )),
            Stop::DeadlinePassed => Some(End {
                outcome: Some(Outcome::DeadlineExceeded),
                ..End::without_result(Transition::Expire, "its deadline passed while it ran")
            }),
            Stop::Unreadable(error) => Some(failed(Outcome::NotConverged, error.to_string())),
            Stop::LeaseLost => None,
        };
        self.process.kill().await;
        end
    }

    /// Asks the process for a last checkpoint and its exit, and waits for the grace period. Returns its last line.
    async fn stop_gracefully(&mut self) -> Option<Line> {
        self.process.terminate();
        let mut last = None;
        let read = async {
            while let Ok(Some(ReceivedLine { line, bytes })) = self.process.next_line().await {
                match line {
                    line if line.is_last() => last = Some(line),
                    // The results before would have to be deleted first; instead the next attempt restarts from the last
                    // checkpoint.
                    Line::Restarted(_) => break,
                    line => self.buffer.push(line, bytes),
                }
            }
        };
        let read = tokio::time::timeout(self.attempt.config.grace, read).await;
        if read.is_err() {
            tracing::warn!("the solving process did not end in time and is killed");
        }
        last
    }
}
