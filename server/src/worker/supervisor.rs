//! Seeing one job through: read the child's lines, write batches under the lease, obey cancel and shutdown, conclude.

use std::time::Duration;

use api::job::Outcome;
use api::spec::Spec;
use tokio::time::MissedTickBehavior;
use tokio_util::sync::CancellationToken;

use crate::clock::now_ms;
use crate::queue::Transition;
use crate::solve::Line;
use crate::spec;
use crate::store::{Claim, End, Held, Store, StoreError};
use crate::worker::batcher::Batcher;
use crate::worker::child::Solving;
use crate::worker::ending::{beat, conclude, patiently};
use crate::worker::verdict::{end, verdict};
use crate::worker::{Rules, STORE_PAUSE};

/// How often gathered lines are written and a cancel request is looked for.
const TICK: Duration = Duration::from_millis(150);
/// How long the end of the output is waited for after a line that cannot be read.
const NEXT_LINE: Duration = Duration::from_secs(1);

/// Why the reading of lines ended.
enum Stop {
    /// The child closed its output; its last line, if it was one that ends a job.
    Output(Option<Line>),
    /// A line could not be read.
    Unreadable(String),
    /// The user no longer wants the job.
    Cancelled,
    /// The job's deadline has passed.
    Late,
    /// Another worker holds the job.
    LeaseLost,
    /// The service stops.
    Shutdown,
}

/// What is due.
enum Due {
    Batch,
    /// The child could not go on from the checkpoint, and says why.
    Anew(String),
}

/// Sees a job through under a lease that is renewed until then. Whatever happens to the child, the job is concluded or
/// another worker holds it.
pub(super) async fn supervise(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    stopping: &CancellationToken,
) -> Result<(), StoreError> {
    tokio::select! {
        seen = see_through(store, claim, rules, stopping) => seen,
        never = beat(store, claim, rules) => match never {},
    }
}

async fn see_through(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    stopping: &CancellationToken,
) -> Result<(), StoreError> {
    let cycles = serde_json::from_str::<Spec>(&claim.spec).map_or(0, |spec| spec::cycles(&spec));
    let from_cycle = claim.checkpoint.as_ref().map_or(0, |found| found.cycle);
    tracing::info!(from_cycle, memory_mb = claim.memory_mb, "job taken");
    let mut batcher = Batcher::new(cycles, from_cycle);
    let folder = store.attempt_folder(claim);
    let mut child = match Solving::start(rules, claim, &folder) {
        Ok(child) => child,
        Err(cause) => {
            let end = end(
                Transition::Lose,
                format!("its solving process could not be started: {cause}"),
            );
            return conclude(store, claim, rules, &batcher.batch(true), &end).await;
        }
    };
    let stop = follow(store, claim, rules, &mut child, &mut batcher, stopping).await?;
    let end = match stop {
        Stop::Output(last) => concluded(last, &mut child).await,
        Stop::Shutdown => {
            let last = wind_down(&mut child, &mut batcher, rules.grace).await;
            match last {
                Some(last) => concluded(Some(last), &mut child).await,
                None => end(Transition::GiveBack, ""),
            }
        }
        other => {
            child.kill().await;
            match ended_by(other) {
                Some(end) => end,
                None => return Ok(()),
            }
        }
    };
    let end = match end.step {
        Transition::GiveBack if stopping.is_cancelled() => End {
            reason: Some("the service was stopped".to_owned()),
            ..end
        },
        _ => end,
    };
    conclude(store, claim, rules, &batcher.batch(true), &end).await
}

async fn concluded(last: Option<Line>, child: &mut Solving) -> End {
    let (ended, words) = child.ended().await;
    verdict(last, ended, words)
}

/// The end of a job whose child was killed for this reason; nothing if it is another worker's to end.
fn ended_by(stop: Stop) -> Option<End> {
    match stop {
        Stop::Cancelled => Some(end(Transition::Cancel, "cancelled while running")),
        Stop::Late => Some(End {
            outcome: Some(Outcome::DeadlineExceeded),
            ..end(Transition::Expire, "its deadline passed while it ran")
        }),
        Stop::Unreadable(why) => Some(End {
            outcome: Some(Outcome::NotConverged),
            ..end(Transition::Fail, why)
        }),
        Stop::Output(_) | Stop::Shutdown | Stop::LeaseLost => {
            tracing::warn!("lease lost; nothing more is written");
            None
        }
    }
}

/// Lets the child tell a last checkpoint and end; kills it when the grace is over. Returns the line that it ended with.
async fn wind_down(child: &mut Solving, batcher: &mut Batcher, grace: Duration) -> Option<Line> {
    child.terminate();
    let mut last = None;
    let read = async {
        while let Ok(Some(text)) = child.line().await {
            match serde_json::from_str::<Line>(&text) {
                Ok(line @ (Line::Summary(_) | Line::Failed(_) | Line::Stopped)) => {
                    last = Some(line);
                }
                // What earlier attempts left would have to go first; instead the next attempt begins anew.
                Ok(Line::Anew(_)) | Err(_) => break,
                Ok(line) => batcher.take(line, text.len()),
            }
        }
    };
    if tokio::time::timeout(grace, read).await.is_err() {
        tracing::warn!("the solving process did not end in time and is killed");
    }
    if last.is_none() {
        child.kill().await;
    }
    last
}

async fn follow(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    child: &mut Solving,
    batcher: &mut Batcher,
    stopping: &CancellationToken,
) -> Result<Stop, StoreError> {
    let mut tick = tokio::time::interval(TICK);
    tick.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let (mut last, mut refused) = (None, false);
    loop {
        let due = tokio::select! {
            // What the store does not take stays in the child's pipe, so that memory stays bounded.
            line = child.line(), if !(refused && batcher.is_full()) => match line.map(|line| line.map(|line| (line.len(), serde_json::from_str::<Line>(&line)))) {
                Ok(Some((_, Ok(line @ (Line::Summary(_) | Line::Failed(_) | Line::Stopped))))) => {
                    last = Some(line);
                    continue;
                }
                Ok(Some((_, Ok(Line::Anew(why))))) => Due::Anew(why),
                Ok(Some((length, Ok(line)))) => {
                    batcher.take(line, length);
                    if !batcher.is_full() {
                        continue;
                    }
                    Due::Batch
                }
                Ok(Some((_, Err(cause)))) => return Ok(broken(child, last, &cause).await),
                Ok(None) => return Ok(Stop::Output(last)),
                Err(cause) => return Ok(Stop::Unreadable(format!("the solver's output cannot be read: {cause}"))),
            },
            _ = tick.tick() => Due::Batch,
            () = stopping.cancelled() => return Ok(Stop::Shutdown),
        };
        if claim.deadline_at.is_some_and(|at| now_ms() >= at) {
            return Ok(Stop::Late);
        }
        match told(store, claim, rules, batcher, due).await {
            Ok(Held::Yes {
                cancel_requested: false,
            }) => refused = false,
            Ok(Held::Yes {
                cancel_requested: true,
            }) => return Ok(Stop::Cancelled),
            Ok(Held::No) => return Ok(Stop::LeaseLost),
            // The solve goes on and the batch is written again; the fence keeps what comes too late from counting.
            Err(error @ StoreError::Sql(_)) => {
                tracing::warn!(%error, "the store did not take a write; trying again");
                refused = true;
                tick.reset_after(STORE_PAUSE);
            }
            Err(error) => return Err(error),
        }
    }
}

/// What a line means that cannot be read: the last words of a process that was killed while it wrote them, or a fault of
/// the solver if more follows.
async fn broken(child: &mut Solving, last: Option<Line>, cause: &serde_json::Error) -> Stop {
    match tokio::time::timeout(NEXT_LINE, child.line()).await {
        Ok(Ok(None)) => Stop::Output(last),
        _ => Stop::Unreadable(format!(
            "the solver wrote something that cannot be read: {cause}"
        )),
    }
}

/// Writes what is due; whether the worker still holds the job.
async fn told(
    store: &Store,
    claim: &Claim,
    rules: &Rules,
    batcher: &mut Batcher,
    due: Due,
) -> Result<Held, StoreError> {
    match due {
        Due::Anew(why) => {
            tracing::error!(
                why,
                "the checkpoint cannot be gone on from; the job begins anew"
            );
            batcher.begin_anew();
            patiently(|| store.begin_anew(claim)).await
        }
        Due::Batch if batcher.is_dirty() => {
            let batch = batcher.batch(false);
            let answer = store.record(claim, &batch, rules.lease_end()).await;
            if answer.is_err() {
                batcher.give_back(batch);
            }
            answer
        }
        Due::Batch => store.held(claim).await,
    }
}
