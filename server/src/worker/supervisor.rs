//! Supervision of one job: reads the lines of its solving process, stores them under the lease, reacts to a cancel request
//! and to the stop of the service, ends the attempt.

use std::time::Duration;

use api::job::Outcome;
use api::spec::Spec;
use tokio::time::MissedTickBehavior;
use tokio_util::sync::CancellationToken;

use crate::clock::now_ms;
use crate::queue::Transition;
use crate::solve::Line;
use crate::solve::process::{LineError, ReceivedLine, SolveCommand, SolveProcess};
use crate::spec;
use crate::store::{Claim, End, LeaseState, Store, StoreError};
use crate::worker::end::{end_by_exit, failed};
use crate::worker::finalize::{finalize, heartbeat, retry};
use crate::worker::rules::{RETRY_PAUSE, Rules};
use crate::worker::update_buffer::UpdateBuffer;

/// Interval at which updates are written and the cancel request is read.
const TICK: Duration = Duration::from_millis(150);
/// Longest wait for the end of the output after a malformed line.
const MALFORMED_TIMEOUT: Duration = Duration::from_secs(1);

/// Why reading the output of the process has ended.
enum Stop {
    /// The process closed its output; with its last line, if there was one.
    Output(Option<Line>),
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
    /// The process cannot resume from the checkpoint, with the cause.
    Restart(String),
}

/// Supervises a job under a lease that is renewed until the end. Whatever happens to the process, the attempt is ended or
/// another worker holds the job.
pub(super) async fn supervise(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    stopping: &CancellationToken,
) -> Result<(), StoreError> {
    tokio::select! {
        ended = run_attempt(store, claim, rules, stopping) => ended,
        never = heartbeat(store, claim, rules) => match never {},
    }
}

async fn run_attempt(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    stopping: &CancellationToken,
) -> Result<(), StoreError> {
    let cycles = serde_json::from_str::<Spec>(&claim.spec).map_or(0, |spec| spec::cycles(&spec));
    let from_cycle = claim.checkpoint.as_ref().map_or(0, |found| found.cycle);
    tracing::info!(from_cycle, memory_mb = claim.memory_mb, "job claimed");
    let mut buffer = UpdateBuffer::new(cycles, from_cycle);
    let end = match start(store, claim, rules) {
        Ok(mut process) => {
            let stop =
                read_output(store, claim, rules, &mut process, &mut buffer, stopping).await?;
            end_process(stop, &mut process, &mut buffer, rules.grace).await
        }
        Err(cause) => Some(End::without_result(
            Transition::WorkerLost,
            format!("its solving process could not be started: {cause}"),
        )),
    };
    let Some(mut end) = end else {
        tracing::warn!("lease lost; nothing more is written");
        return Ok(());
    };
    if end.transition == Transition::Release && stopping.is_cancelled() {
        end.reason = Some("the service was stopped".to_owned());
    }
    finalize(store, claim, rules, &buffer.take(true), &end).await
}

fn start(store: &Store, claim: &Claim, rules: &Rules) -> std::io::Result<SolveProcess> {
    SolveCommand {
        program: &rules.program,
        folder: &store.attempt_folder(claim),
        spec: &claim.spec,
        checkpoint: claim.checkpoint.as_ref(),
        checkpoint_every: rules.checkpoint_every,
        memory_limit_mb: Some(rules.memory_limit_mb(claim.memory_mb)),
        own_group: true,
    }
    .spawn()
}

/// Waits for the exit of the process or kills it. Returns the end of the attempt; `None` if another worker holds the job.
async fn end_process(
    stop: Stop,
    process: &mut SolveProcess,
    buffer: &mut UpdateBuffer,
    grace: Duration,
) -> Option<End> {
    let last = match stop {
        Stop::Output(last) => last,
        Stop::Shutdown => match stop_gracefully(process, buffer, grace).await {
            Some(last) => Some(last),
            None => return Some(End::without_result(Transition::Release, "")),
        },
        _ => {
            process.kill().await;
            return end_of_killed(stop);
        }
    };
    Some(end_by_exit(last, &process.wait().await))
}

/// Returns the end of an attempt whose process the worker has killed.
fn end_of_killed(stop: Stop) -> Option<End> {
    match stop {
        Stop::Cancelled => Some(End::without_result(
            Transition::Cancel,
            "cancelled while running",
        )),
        Stop::DeadlinePassed => Some(End {
            outcome: Some(Outcome::DeadlineExceeded),
            ..End::without_result(Transition::Expire, "its deadline passed while it ran")
        }),
        Stop::Unreadable(error) => Some(failed(Outcome::NotConverged, error.to_string())),
        Stop::Output(_) | Stop::Shutdown | Stop::LeaseLost => None,
    }
}

/// Asks the process for a last checkpoint and its exit; kills it after the grace period. Returns its last line.
async fn stop_gracefully(
    process: &mut SolveProcess,
    buffer: &mut UpdateBuffer,
    grace: Duration,
) -> Option<Line> {
    process.terminate();
    let mut last = None;
    let read = async {
        while let Ok(Some(ReceivedLine { line, bytes })) = process.next_line().await {
            match line {
                line if line.is_last() => last = Some(line),
                // The results of earlier attempts would have to be deleted first; instead the next attempt restarts.
                Line::Restarted(_) => break,
                line => buffer.push(line, bytes),
            }
        }
    };
    if tokio::time::timeout(grace, read).await.is_err() {
        tracing::warn!("the solving process did not end in time and is killed");
    }
    if last.is_none() {
        process.kill().await;
    }
    last
}

async fn read_output(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    process: &mut SolveProcess,
    buffer: &mut UpdateBuffer,
    stopping: &CancellationToken,
) -> Result<Stop, StoreError> {
    let mut tick = tokio::time::interval(TICK);
    tick.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let (mut last, mut store_failed) = (None, false);
    loop {
        let write = tokio::select! {
            // While the store fails, lines stay in the pipe, so that memory stays bounded.
            received = process.next_line(), if !(store_failed && buffer.is_full()) => match received {
                Ok(Some(ReceivedLine { line, bytes })) => match line {
                    Line::Restarted(cause) => Write::Restart(cause),
                    line if line.is_last() => {
                        last = Some(line);
                        continue;
                    }
                    line => {
                        buffer.push(line, bytes);
                        if !buffer.is_full() {
                            continue;
                        }
                        Write::Update
                    }
                },
                Ok(None) => return Ok(Stop::Output(last)),
                Err(error) => return Ok(stop_by(error, process, last).await),
            },
            _ = tick.tick() => Write::Update,
            () = stopping.cancelled() => return Ok(Stop::Shutdown),
        };
        if claim.deadline_at.is_some_and(|at| now_ms() >= at) {
            return Ok(Stop::DeadlinePassed);
        }
        match execute(store, claim, rules, buffer, write).await {
            Ok(LeaseState::Held {
                cancel_requested: false,
            }) => store_failed = false,
            Ok(LeaseState::Held {
                cancel_requested: true,
            }) => return Ok(Stop::Cancelled),
            Ok(LeaseState::Lost) => return Ok(Stop::LeaseLost),
            // The solve continues and the update is written again; the fence discards writes that come too late.
            Err(error @ StoreError::Database { .. }) => {
                tracing::warn!(%error, "the store failed; retrying");
                store_failed = true;
                tick.reset_after(RETRY_PAUSE);
            }
            Err(error) => return Err(error),
        }
    }
}

/// Returns the meaning of a line error. A malformed line at the end of the output was truncated when the process was
/// killed; followed by more output it is a failure of the solver.
async fn stop_by(error: LineError, process: &mut SolveProcess, last: Option<Line>) -> Stop {
    if matches!(error, LineError::Malformed(_)) {
        let next = tokio::time::timeout(MALFORMED_TIMEOUT, process.next_line()).await;
        if matches!(next, Ok(Ok(None))) {
            return Stop::Output(last);
        }
    }
    Stop::Unreadable(error)
}

/// Executes a write. An update without new lines only reads the state of the lease.
async fn execute(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    buffer: &mut UpdateBuffer,
    write: Write,
) -> Result<LeaseState, StoreError> {
    match write {
        Write::Restart(cause) => {
            tracing::error!(
                cause,
                "the run cannot resume from its checkpoint and restarts at cycle 0"
            );
            buffer.restart();
            retry(|| store.restart(claim)).await
        }
        Write::Update if buffer.is_dirty() => {
            let update = buffer.take(false);
            let answer = store.record(claim, &update, rules.lease_end()).await;
            if answer.is_err() {
                buffer.put_back(update);
            }
            answer
        }
        Write::Update => store.lease_state(claim).await,
    }
}
