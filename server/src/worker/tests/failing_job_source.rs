//! Workers whose job source fails, or has no job.

use std::sync::Mutex;
use std::time::Instant;

use api::service::Demand;
use tokio::task::JoinHandle;

use super::*;
use crate::metrics::Busy;
use crate::objects::ObjectsError;
use crate::queue::Transition;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::tests::request;
use crate::store::{Claim, ClaimRequest, End, Lease, LeaseState, StoreError};
use crate::worker::JobSource;
use crate::worker::attempt::Attempt;
use crate::worker::config::RETRY;

/// A job source that gives two jobs and then fails for good, or none and waits.
#[derive(Debug, Default)]
struct Failing {
    folder: PathBuf,
    waits: bool,
    /// No claim has an answer.
    is_away: bool,
    writes: Writes,
    finished: Mutex<Vec<Transition>>,
    asked_at: Mutex<Vec<Instant>>,
    asked: Mutex<Vec<(i64, usize)>>,
    abandoned: Mutex<Vec<Lease>>,
}

/// Effect of writes.
#[derive(Debug, Default, PartialEq, Eq)]
enum Writes {
    #[default]
    Fail,
    /// No files are taken: they are damaged.
    WithoutFiles,
    Succeed,
}

fn failed() -> JobSourceError {
    JobSourceError::Store(StoreError::OnlySqlite)
}

impl JobSource for Failing {
    const WAITS_FOR_DISK: bool = true;

    async fn claim(&self, request: &ClaimRequest) -> Result<Vec<Claim>, JobSourceError> {
        let asked = (request.request.number, request.capacity.slots);
        self.asked.lock().expect("no panic").push(asked);
        self.asked_at.lock().expect("no panic").push(Instant::now());
        if self.is_away {
            return Err(StoreError::Unwritten.into());
        }
        if self.waits && request.capacity.slots > 0 {
            return std::future::pending().await;
        }
        let claim = |id| Claim {
            id: Uuid::from_u128(id),
            lease: request.request.number,
            spec: "{}".to_owned(),
            attempt: 1,
            waited_ms: 0,
            deadline_in_ms: None,
            memory_mb: 1,
            cpu_ms: 1,
            checkpoint: None,
        };
        let jobs = if self.waits { vec![] } else { vec![1, 2] };
        Ok(jobs.into_iter().map(claim).collect())
    }

    async fn job_waiting(&self) {}

    async fn renew(&self, _lease: Lease, _length: Duration) -> Result<LeaseState, JobSourceError> {
        Err(failed())
    }

    async fn lease_state(&self, _lease: Lease) -> Result<LeaseState, JobSourceError> {
        Err(failed())
    }

    async fn checkpoint(&self, _lease: Lease) -> Result<Option<EncodedCheckpoint>, JobSourceError> {
        Err(failed())
    }

    async fn record(
        &self,
        _lease: Lease,
        _update: &JobUpdate,
        _length: Duration,
    ) -> Result<LeaseState, JobSourceError> {
        if self.writes == Writes::Succeed {
            return Ok(LeaseState::Held {
                cancel_requested: false,
            });
        }
        if self.writes == Writes::WithoutFiles {
            let (what, how) = ("a.vtu".to_owned(), "it is shorter".to_owned());
            let damaged = ObjectsError::Damaged { what, how };
            return Err(StoreError::from(damaged).into());
        }
        Err(failed())
    }

    async fn restart(&self, _lease: Lease, _number: i64) -> Result<LeaseState, JobSourceError> {
        Err(failed())
    }

    async fn finish(
        &self,
        _lease: Lease,
        _update: &JobUpdate,
        end: &End,
    ) -> Result<Option<Status>, JobSourceError> {
        if self.writes != Writes::Fail {
            let mut finished = self.finished.lock().expect("no panic");
            finished.push(end.transition);
            return Ok(Some(Status::Cancelled));
        }
        Err(failed())
    }

    fn abandon(&self, lease: Lease) {
        self.abandoned.lock().expect("no panic").push(lease);
    }

    fn folder(&self, _lease: Lease) -> PathBuf {
        self.folder.clone()
    }

    fn busy(&self) -> Option<Busy> {
        None
    }

    async fn demand(&self) -> Result<Demand, JobSourceError> {
        Err(failed())
    }
}

/// The last update is part of the results of a job that succeeds; that of a cancelled job may be lost.
#[tokio::test]
async fn a_job_whose_last_update_is_refused_does_not_succeed() {
    let job_source = Failing {
        writes: Writes::WithoutFiles,
        ..Failing::default()
    };
    let claims = job_source.claim(&request(i64::MAX, Duration::ZERO)).await;
    let claim = claims.expect("jobs").pop().expect("a job");
    let health = WorkerHealth::default();
    let attempt = Attempt {
        job_source: &job_source,
        claim: &claim,
        config: &WorkerConfig::new(PathBuf::from("/nowhere")),
        threads: 1,
        round: health.round(),
    };
    for transition in [Transition::Succeed, Transition::Cancel] {
        let end = End::without_result(transition, "the end");
        let ended = attempt
            .finalize(&[JobUpdate::default()], 2, &end, None)
            .await;
        assert_eq!(ended.is_ok(), transition == Transition::Cancel);
    }
    let finished = job_source.finished.lock().expect("no panic");
    assert_eq!(*finished, [Transition::Cancel]);
}

#[tokio::test]
async fn claims_of_a_worker_that_fails_are_abandoned() {
    let job_source = Failing::default();
    let config = WorkerConfig::new(PathBuf::from("/nowhere"));
    let process = WorkerProcess::new(1_000, true);
    let stopping = CancellationToken::new();
    let next = crate::worker::next(&job_source, &process, &config, &stopping);
    Box::pin(next).await.expect_err("the job source fails");
    let abandoned = job_source.abandoned.lock().expect("no panic").clone();
    let jobs: Vec<u128> = abandoned.iter().map(|lease| lease.job.as_u128()).collect();
    assert_eq!(jobs, [1, 2]);
}

#[tokio::test]
async fn short_jobs_that_were_claimed_together_go_back_together() {
    let job_source = Failing {
        writes: Writes::Succeed,
        ..Failing::default()
    };
    let config = WorkerConfig::new(PathBuf::from("/nowhere"));
    let process = WorkerProcess::new(1_000, true);
    let stopping = CancellationToken::new();
    let next = crate::worker::next(&job_source, &process, &config, &stopping);
    assert!(Box::pin(next).await.expect("an answer"));
    let finished = job_source.finished.lock().expect("no panic").clone();
    assert_eq!(finished, [Transition::Decline; 2]);
    // A second declined round would end it.
    let mut second = Box::pin(process.health().declined_in_a_row(2));
    assert!(futures_util::poll!(&mut second).is_pending());
}

/// Starts the workers of one process.
fn eight_workers(
    job_source: &Arc<Failing>,
    stopping: &CancellationToken,
) -> Vec<JoinHandle<Result<(), JobSourceError>>> {
    let process = Arc::new(WorkerProcess::new(1_000, true));
    let config = Arc::new(WorkerConfig::new(PathBuf::from("/nowhere")));
    let start = |_| {
        let (process, config) = (Arc::clone(&process), Arc::clone(&config));
        tokio::spawn(work(
            Arc::clone(job_source),
            process,
            config,
            stopping.clone(),
        ))
    };
    (0..8).map(start).collect()
}

#[tokio::test]
async fn workers_of_a_process_pause_together_while_the_employer_is_away() {
    let job_source = Arc::new(Failing {
        is_away: true,
        ..Failing::default()
    });
    let stopping = CancellationToken::new();
    let workers = eight_workers(&job_source, &stopping);
    while job_source.asked.lock().expect("no panic").len() < 3 {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    stopping.cancel();
    for worker in workers {
        worker.await.expect("no panic").expect("accepted");
    }
    // The same request, after half of the first and of the second pause at least.
    let asked = job_source.asked.lock().expect("no panic").clone();
    assert!(asked.iter().all(|asked| *asked == (1, 1)), "{asked:?}");
    let at = job_source.asked_at.lock().expect("no panic").clone();
    assert!(at[1] - at[0] >= RETRY.first / 2, "{at:?}");
    assert!(at[2] - at[1] >= RETRY.first, "{at:?}");
}

#[tokio::test]
async fn workers_that_wait_for_a_job_stop_and_ask_what_their_request_has_claimed() {
    let job_source = Arc::new(Failing {
        waits: true,
        ..Failing::default()
    });
    let stopping = CancellationToken::new();
    let workers = eight_workers(&job_source, &stopping);
    while job_source.asked.lock().expect("no panic").is_empty() {
        tokio::task::yield_now().await;
    }
    stopping.cancel();
    for worker in workers {
        let ended = tokio::time::timeout(TEST_TIMEOUT, worker).await;
        ended
            .expect("in time")
            .expect("no panic")
            .expect("accepted");
    }
    let asked = job_source.asked.lock().expect("no panic").clone();
    assert_eq!(asked, [(1, 1), (1, 0)]);
}
