//! Workers whose employer fails, or has no job.

use std::sync::Mutex;

use api::service::Demand;

use super::*;
use crate::metrics::Busy;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::{Claim, ClaimRequest, End, Lease, LeaseState, StoreError};
use crate::worker::Employer;

/// An employer that gives two jobs and then fails for good, or none and waits.
#[derive(Debug, Default)]
struct Failing {
    folder: PathBuf,
    waits: bool,
    asked: Mutex<Vec<(i64, usize)>>,
    abandoned: Mutex<Vec<Lease>>,
}

fn failed() -> EmployerError {
    EmployerError::Store(StoreError::OnlySqlite)
}

impl Employer for Failing {
    async fn claim(&self, request: &ClaimRequest) -> Result<Vec<Claim>, EmployerError> {
        let asked = (request.request.number, request.capacity.slots);
        self.asked.lock().expect("no panic").push(asked);
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

    async fn renew(&self, _lease: Lease, _length: Duration) -> Result<LeaseState, EmployerError> {
        Err(failed())
    }

    async fn lease_state(&self, _lease: Lease) -> Result<LeaseState, EmployerError> {
        Err(failed())
    }

    async fn checkpoint(&self, _lease: Lease) -> Result<Option<EncodedCheckpoint>, EmployerError> {
        Err(failed())
    }

    async fn record(
        &self,
        _lease: Lease,
        _update: &JobUpdate,
        _length: Duration,
    ) -> Result<LeaseState, EmployerError> {
        Err(failed())
    }

    async fn restart(&self, _lease: Lease, _number: i64) -> Result<LeaseState, EmployerError> {
        Err(failed())
    }

    async fn finish(
        &self,
        _lease: Lease,
        _update: &JobUpdate,
        _end: &End,
    ) -> Result<Option<Status>, EmployerError> {
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

    async fn demand(&self) -> Result<Demand, EmployerError> {
        Err(failed())
    }
}

#[tokio::test]
async fn claims_of_a_worker_that_fails_are_abandoned() {
    let employer = Failing::default();
    let config = WorkerConfig::new(PathBuf::from("/nowhere"));
    let process = WorkerProcess::new(1_000, true);
    let stopping = CancellationToken::new();
    let next = crate::worker::next(&employer, (&process, &config), &stopping);
    Box::pin(next).await.expect_err("the employer fails");
    let abandoned = employer.abandoned.lock().expect("no panic").clone();
    let jobs: Vec<u128> = abandoned.iter().map(|lease| lease.job.as_u128()).collect();
    assert_eq!(jobs, [1, 2]);
}

#[tokio::test]
async fn workers_that_wait_for_a_job_stop_and_ask_what_their_request_has_claimed() {
    let employer = Arc::new(Failing {
        waits: true,
        ..Failing::default()
    });
    let process = Arc::new(WorkerProcess::new(1_000, true));
    let config = Arc::new(WorkerConfig::new(PathBuf::from("/nowhere")));
    let stopping = CancellationToken::new();
    let start = |_| {
        let shared = (Arc::clone(&process), Arc::clone(&config));
        tokio::spawn(work(Arc::clone(&employer), shared, stopping.clone()))
    };
    let workers: Vec<_> = (0..8).map(start).collect();
    while employer.asked.lock().expect("no panic").is_empty() {
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
    let asked = employer.asked.lock().expect("no panic").clone();
    assert_eq!(asked, [(1, 1), (1, 0)]);
}
