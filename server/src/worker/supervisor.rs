//! Supervision of one job: reads the lines of its solving process, stores them under the lease, reacts to a cancel
//! request and to the stop of the service, ends the attempt.

use std::time::{Duration, Instant};

use api::job::Outcome;
use api::spec::Spec;
use tokio::time::MissedTickBehavior;
use tokio_util::sync::CancellationToken;

use crate::estimate::foreseen::Foreseen;
use crate::queue::Transition;
use crate::solve::ChildMessage;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::solve::process::{LineError, ReceivedLine, SolveCommand, SolveProcess};
use crate::spec;
use crate::store::{ClaimedCheckpoint, End, LeaseState};
use crate::worker::attempt::{Attempt, retry};
use crate::worker::config::RETRY;
use crate::worker::end::{
    STOPPED, cancelled, deadline_passed, declined, end_by_exit, failed, not_started,
};
use crate::worker::job_source::{JobSource, JobSourceError};
use crate::worker::resume::{Start, start_of};
use crate::worker::update_buffer::UpdateBuffer;

/// Longest wait for the end of the output after a malformed line.
const MALFORMED_TIMEOUT: Duration = Duration::from_secs(1);

/// Why reading the output of the process has ended.
enum Stop {
    /// The process closed its output; with its last line, if there was one.
    Output(Option<Box<ChildMessage>>),
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
struct Supervision<'a, E> {
    attempt: Attempt<'a, E>,
    /// When the job fails unless it has ended.
    deadline: Option<Instant>,
    process: SolveProcess,
    /// Set once the process has said that it is ready.
    is_ready: bool,
    buffer: UpdateBuffer,
    stopping: &'a CancellationToken,
}

/// Supervises an attempt under a lease that is renewed until the end. Whatever happens to the process, the attempt is
/// ended or another worker holds the job.
pub(super) async fn supervise<E: JobSource>(
    attempt: Attempt<'_, E>,
    stopping: &CancellationToken,
) -> Result<(), JobSourceError> {
    attempt.with_heartbeat(run(attempt, stopping)).await
}

async fn run<E: JobSource>(
    attempt: Attempt<'_, E>,
    stopping: &CancellationToken,
) -> Result<(), JobSourceError> {
    let claim = attempt.claim;
    let deadline = claim.deadline_in_ms.map(|ms| {
        let length = Duration::from_millis(u64::try_from(ms).unwrap_or_default());
        Instant::now() + length
    });
    let cycles = serde_json::from_str::<Spec>(&claim.spec).map_or(0, |spec| spec::cycles(&spec));
    let from_cycle = claim
        .checkpoint
        .as_ref()
        .map_or(0, ClaimedCheckpoint::cycle);
    tracing::info!(from_cycle, memory_mb = claim.memory_mb, "job claimed");
    let specification = claim.spec.clone();
    let foreseen = tokio::task::spawn_blocking(move || Foreseen::of(&specification));
    // Without it no remaining time is stated.
    let foreseen = foreseen.await.unwrap_or_default();
    let mut buffer = UpdateBuffer::new(cycles, from_cycle, foreseen);
    let started = if let Some(cause) = attempt.round.end() {
        Err(declined(cause))
    } else {
        match start_of(attempt, &mut buffer, deadline, stopping).await? {
            Start::From(checkpoint) => {
                let started = start(attempt, checkpoint.as_deref());
                started.map_err(|cause| not_started(&cause))
            }
            Start::Never(end) => Err(*end),
            Start::LeaseLost => return Ok(()),
        }
    };
    let process = match started {
        Ok(process) => process,
        Err(end) => {
            let updates = buffer.take_all();
            let number = buffer.next_number();
            return attempt.finalize(&updates, number, &end, None).await;
        }
    };
    let mut supervision = Supervision {
        attempt,
        deadline,
        process,
        is_ready: false,
        buffer,
        stopping,
    };
    let stop = supervision.read_output().await?;
    let Some(mut end) = supervision.end_process(stop).await else {
        tracing::warn!("lease lost; nothing more is written");
        return Ok(());
    };
    if end.transition == Transition::Release && stopping.is_cancelled() {
        end.reason = Some(STOPPED.to_owned());
    }
    let updates = supervision.buffer.take_all();
    let number = supervision.buffer.next_number();
    let computed = supervision.buffer.take_computed();
    attempt.finalize(&updates, number, &end, computed).await
}

fn start<E: JobSource>(
    attempt: Attempt<'_, E>,
    checkpoint: Option<&EncodedCheckpoint>,
) -> std::io::Result<SolveProcess> {
    let Attempt {
        claim,
        config,
        job_source,
        threads,
        ..
    } = attempt;
    SolveCommand {
        program: &config.program,
        folder: &job_source.folder(claim.into()),
        spec: &claim.spec,
        checkpoint,
        checkpoint_every: config.checkpoint_every,
        threads,
        memory_limit_mb: Some(config.memory_limit_mb(claim.memory_mb)),
        waits_for_disk: E::WAITS_FOR_DISK,
        own_group: true,
    }
    .spawn()
}

impl<E: JobSource> Supervision<'_, E> {
    async fn read_output(&mut self) -> Result<Stop, JobSourceError> {
        let mut tick = tokio::time::interval(self.attempt.config.update_every);
        tick.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let (mut last, mut failures) = (None, 0);
        loop {
            // While the store fails, lines stay in the pipe, so that memory stays bounded.
            let may_read = failures == 0 || !self.buffer.is_full();
            let write = tokio::select! {
                received = self.process.next_line(), if may_read => match received {
                    Ok(Some(ReceivedLine { line: ChildMessage::Ready, .. })) => {
                        self.is_ready = true;
                        self.attempt.round.started();
                        continue;
                    }
                    Ok(Some(ReceivedLine { line: ChildMessage::Restarted(cause), .. })) => {
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
            if self.deadline.is_some_and(|at| Instant::now() >= at) {
                return Ok(Stop::DeadlinePassed);
            }
            match self.execute(write).await {
                Ok(LeaseState::Held {
                    cancel_requested: false,
                }) => failures = 0,
                Ok(LeaseState::Held {
                    cancel_requested: true,
                }) => return Ok(Stop::Cancelled),
                Ok(LeaseState::Lost) => return Ok(Stop::LeaseLost),
                // The solve continues and the update is written again; the fence discards writes that come too late.
                Err(error) if error.is_temporary() => {
                    tracing::warn!(%error, "the job source failed; retrying");
                    if self.is_cancelled_meanwhile(&error).await {
                        return Ok(Stop::Cancelled);
                    }
                    failures += 1;
                    tick.reset_after(RETRY.jittered_pause_after(failures));
                }
                Err(error) => return Err(error),
            }
        }
    }

    /// Returns `true` if the user cancelled the job while nothing could be stored because the disk is full, or no large file. The state of the lease
    /// can be read all the same; after another error the next write returns it.
    async fn is_cancelled_meanwhile(&self, error: &JobSourceError) -> bool {
        let cancelled = LeaseState::Held {
            cancel_requested: true,
        };
        let Attempt { job_source, .. } = self.attempt;
        (error.is_disk_full() || error.is_without_objects())
            && job_source.lease_state(self.attempt.lease()).await.ok() == Some(cancelled)
    }

    /// Returns the meaning of a line error. A malformed line at the end of the output was truncated when the process
    /// was killed; followed by more output it is a failure of the solver.
    async fn stop_by(&mut self, error: LineError, last: Option<ChildMessage>) -> Stop {
        if matches!(error, LineError::Malformed(_)) {
            let next = tokio::time::timeout(MALFORMED_TIMEOUT, self.process.next_line()).await;
            if matches!(next, Ok(Ok(None))) {
                return Stop::Output(last.map(Box::new));
            }
        }
        Stop::Unreadable(error)
    }

    /// Executes a write. An update without new lines only reads the state of the lease.
    async fn execute(&mut self, write: Write) -> Result<LeaseState, JobSourceError> {
        let Attempt {
            job_source, config, ..
        } = self.attempt;
        let lease = self.attempt.lease();
        match write {
            Write::Restart(cause) => {
                tracing::warn!(%cause, "the run restarts at cycle 0");
                let number = self.buffer.restart(cause);
                retry(|| job_source.restart(lease, number)).await
            }
            Write::Update if self.buffer.is_dirty() => {
                let update = self.buffer.take();
                let answer = job_source.record(lease, &update, config.lease).await;
                if answer.is_err() {
                    self.buffer.put_back(update);
                }
                answer
            }
            Write::Update => job_source.lease_state(lease).await,
        }
    }

    /// Waits for the exit of the process or kills it. Returns the end of the attempt; `None` if another worker holds
    /// the job.
    async fn end_process(&mut self, stop: Stop) -> Option<End> {
        let end = match stop {
            Stop::Output(last) => {
                let exit = self.process.wait().await;
                let last = last.map(|line| *line);
                return Some(if self.is_ready || exit.is_out_of_memory() {
                    end_by_exit(last, &exit)
                } else {
                    not_started(&exit)
                });
            }
            Stop::Shutdown => match self.stop_gracefully().await {
                Some(last) => return Some(end_by_exit(Some(last), &self.process.wait().await)),
                None => Some(End::without_result(Transition::Release, "")),
            },
            Stop::Cancelled => Some(cancelled()),
            Stop::DeadlinePassed => Some(deadline_passed()),
            Stop::Unreadable(error) if self.is_ready => {
                Some(failed(Outcome::NotConverged, error.to_string()))
            }
            Stop::Unreadable(error) => Some(not_started(&error)),
            Stop::LeaseLost => None,
        };
        self.process.kill().await;
        end
    }

    /// Asks the process for a last checkpoint and its exit, and waits for the grace period. Returns its last line.
    async fn stop_gracefully(&mut self) -> Option<ChildMessage> {
        self.process.terminate();
        let mut last = None;
        let read = async {
            while let Ok(Some(ReceivedLine { line, bytes })) = self.process.next_line().await {
                match line {
                    line if line.is_last() => last = Some(line),
                    // The results before would have to be deleted first; instead the next attempt restarts from the last
                    // checkpoint.
                    ChildMessage::Restarted(_) => break,
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
