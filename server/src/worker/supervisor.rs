//! Seeing one job through: read the child's lines, write batches under the lease, obey cancel and shutdown, conclude.

use std::path::Path;
use std::time::{Duration, Instant};

use api::job::{Outcome, Status};
use api::spec::Spec;
use tokio_util::sync::CancellationToken;

use super::batcher::Batcher;
use super::child::{Ended, Solving};
use super::gather::gather;
use super::{LEASE, lease_end};
use crate::clock::now_ms;
use crate::queue::Move;
use crate::solve::{Line, UNWRITTEN};
use crate::store::{Batch, Claim, End, Held, Store, StoreError};
use crate::translate;

/// How often gathered lines are written and a cancel request is looked for.
const TICK: Duration = Duration::from_millis(150);
/// A lease is renewed when this much of it has gone.
const RENEW: Duration = Duration::from_secs(3);

/// Why the reading of lines ended.
enum Stop {
    /// The child closed its output; its last line, if it was one that ends a job.
    Output(Option<Line>),
    /// A line could not be read.
    Unreadable(String),
    /// The user no longer wants the job.
    Cancelled,
    /// Another worker holds the job.
    LeaseLost,
    /// The service stops.
    Shutdown,
}

/// Sees a job through. Whatever happens to the child, the job is concluded or another worker holds it.
pub(super) async fn supervise(
    store: &Store,
    claim: &Claim,
    program: &Path,
    stopping: &CancellationToken,
) -> Result<(), StoreError> {
    debug_assert!(RENEW * 3 < LEASE, "a lease survives two missed renewals");
    let cycles =
        serde_json::from_str::<Spec>(&claim.spec).map_or(0, |spec| translate::cycles(&spec));
    let mut batcher = Batcher::new(cycles);
    let mut child = match Solving::start(program, &claim.spec, &store.attempt_folder(claim)).await {
        Ok(child) => child,
        Err(cause) => {
            let end = end(
                Move::Lose,
                format!("its solving process could not be started: {cause}"),
            );
            return conclude(store, claim, &batcher.batch(true), &end).await;
        }
    };
    let stop = follow(store, claim, &mut child, &mut batcher, stopping).await?;
    let end = match stop {
        Stop::Output(last) => {
            let ended = child.ended().await.unwrap_or(Ended::Killed);
            verdict(last, ended)
        }
        other => {
            child.kill().await;
            match other {
                Stop::Cancelled => end(Move::Cancel, "cancelled while running"),
                Stop::Shutdown => end(Move::GiveBack, "the service was stopped"),
                Stop::Unreadable(why) => End {
                    outcome: Some(Outcome::NotConverged),
                    ..end(Move::Fail, why)
                },
                Stop::Output(_) | Stop::LeaseLost => {
                    tracing::warn!(job = %claim.id, lease = claim.lease, "lease lost; nothing more is written");
                    return Ok(());
                }
            }
        }
    };
    conclude(store, claim, &batcher.batch(true), &end).await
}

async fn follow(
    store: &Store,
    claim: &Claim,
    child: &mut Solving,
    batcher: &mut Batcher,
    stopping: &CancellationToken,
) -> Result<Stop, StoreError> {
    let mut tick = tokio::time::interval(TICK);
    tick.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
    let mut renewed = Instant::now();
    let mut last = None;
    loop {
        let due = tokio::select! {
            line = child.line() => match line.map(|line| line.map(|line| serde_json::from_str::<Line>(&line))) {
                Ok(Some(Ok(line @ (Line::Summary(_) | Line::Failed(_))))) => {
                    last = Some(line);
                    false
                }
                Ok(Some(Ok(line))) => {
                    batcher.take(line);
                    batcher.is_full()
                }
                Ok(Some(Err(cause))) => {
                    return Ok(Stop::Unreadable(format!("the solver wrote something that cannot be read: {cause}")));
                }
                Ok(None) => return Ok(Stop::Output(last)),
                Err(cause) => return Ok(Stop::Unreadable(format!("the solver's output cannot be read: {cause}"))),
            },
            _ = tick.tick() => true,
            () = stopping.cancelled() => return Ok(Stop::Shutdown),
        };
        if !due {
            continue;
        }
        let writes = batcher.is_dirty() || renewed.elapsed() >= RENEW;
        let answer = if writes {
            let batch = batcher.batch(false);
            let answer = store.record(claim, &batch, lease_end()).await;
            if answer.is_err() {
                batcher.give_back(batch);
            }
            answer
        } else {
            store.held(claim).await
        };
        let held = match answer {
            Ok(held) => {
                renewed = if writes { Instant::now() } else { renewed };
                held
            }
            // The lease is ours until it ends: the solve goes on and the batch is written again.
            Err(error) if renewed.elapsed() < LEASE => {
                tracing::warn!(job = %claim.id, %error, "the store did not take a batch; trying again");
                continue;
            }
            Err(error) => return Err(error),
        };
        match held {
            Held::Yes {
                cancel_requested: false,
            } => {}
            Held::Yes {
                cancel_requested: true,
            } => return Ok(Stop::Cancelled),
            Held::No => return Ok(Stop::LeaseLost),
        }
    }
}

/// What the child's end means: a result, a failure or a crash of its own is final; killed from outside, it is tried
/// again.
fn verdict(last: Option<Line>, ended: Ended) -> End {
    match (last, ended) {
        (Some(Line::Summary(summary)), _) => End {
            step: Move::Succeed,
            reason: None,
            outcome: Some(summary.outcome),
            summary: Some(*summary),
        },
        (Some(Line::Failed(failure)), _) => End {
            outcome: Some(failure.outcome),
            ..end(Move::Fail, failure.reason)
        },
        (_, Ended::Killed) => end(Move::Lose, "its solving process was killed"),
        (_, Ended::Code(UNWRITTEN)) => end(Move::Lose, "its results could not be written"),
        (_, Ended::Crashed(signal)) => End {
            outcome: Some(Outcome::NotConverged),
            ..end(
                Move::Fail,
                format!("the solving process crashed with signal {signal}"),
            )
        },
        (_, Ended::Code(code)) => End {
            outcome: Some(Outcome::NotConverged),
            ..end(
                Move::Fail,
                format!("the solving process ended with code {code} and without a result"),
            )
        },
    }
}

fn end(step: Move, reason: impl Into<String>) -> End {
    End {
        step,
        reason: Some(reason.into()),
        outcome: None,
        summary: None,
    }
}

async fn conclude(
    store: &Store,
    claim: &Claim,
    batch: &Batch,
    end: &End,
) -> Result<(), StoreError> {
    // A batch's events precede the end, so they are written first, under the same lease.
    let recorded = patiently(claim, || store.record(claim, batch, lease_end())).await?;
    if matches!(recorded, Held::No) {
        return Ok(());
    }
    let ends = matches!(end.step, Move::Succeed | Move::Fail | Move::Cancel);
    let files = if ends {
        patiently(claim, || gather(store, claim, end.summary.as_ref())).await?
    } else {
        Vec::new()
    };
    // The end and the manifest are one transaction.
    let rest = Batch {
        progress: batch.progress.clone(),
        files,
        ..Batch::default()
    };
    let status = patiently(claim, || store.end(claim, &rest, end, now_ms())).await?;
    store.sweep_files(Some(claim.id)).await?;
    tracing::info!(job = %claim.id, status = status.map(Status::as_str), reason = end.reason, "job concluded");
    Ok(())
}

/// Writes again while a lease lasts: a store that stalls must not cost a finished solve. The fence keeps a write that
/// comes too late from counting.
async fn patiently<T, F: Future<Output = Result<T, StoreError>>>(
    claim: &Claim,
    write: impl Fn() -> F,
) -> Result<T, StoreError> {
    let began = Instant::now();
    loop {
        match write().await {
            Err(error) if began.elapsed() < LEASE => {
                tracing::warn!(job = %claim.id, %error, "the store did not take the end of a job; trying again");
                tokio::time::sleep(TICK).await;
            }
            answer => return answer,
        }
    }
}
