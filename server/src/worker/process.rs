//! State that the workers of one process share: the numbers of their requests, and the memory of their solves.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::time::Instant;
use tokio_util::sync::CancellationToken;
use uuid::Uuid;

use crate::queue::{Capacity, MemoryBudget};
use crate::store::{Claim, ClaimRequest, RequestNumber};
use crate::worker::config::{RETRY, WorkerConfig};
use crate::worker::health::{Round, WorkerHealth};
use crate::worker::job_source::{JobSource, JobSourceError};

/// The workers of one process.
#[derive(Debug)]
pub struct WorkerProcess {
    id: Uuid,
    is_remote: bool,
    is_one_of_several: bool,
    memory: Mutex<MemoryBudget>,
    health: Arc<WorkerHealth>,
    /// Held during a request, so that one worker asks at a time.
    turn: tokio::sync::Mutex<Turn>,
}

/// The next request of the workers of a process.
#[derive(Debug)]
struct Turn {
    /// Number of the request, from 1.
    number: i64,
    /// Requests in a row that had no answer.
    unanswered: usize,
    /// When it may be made.
    not_before: Instant,
}

/// Claimed jobs.
#[derive(Debug)]
pub(super) struct Claimed<'a> {
    /// The jobs, one to be solved after the other.
    pub(super) claims: Vec<Claim>,
    /// Memory of the largest, which is reserved.
    pub(super) memory: SolveMemory<'a>,
    pub(super) round: Round<'a>,
}

/// Memory of a solve, free again when it is dropped, and its threads.
#[derive(Debug)]
pub(super) struct SolveMemory<'a> {
    process: &'a WorkerProcess,
    memory_mb: i64,
    pub(super) threads: usize,
}

impl Drop for SolveMemory<'_> {
    fn drop(&mut self) {
        let mut memory = self.process.memory();
        memory.used_mb -= self.memory_mb;
        memory.running -= 1;
    }
}

impl WorkerProcess {
    /// Workers with this memory for all their solves, in the process of the store or remote.
    pub fn new(memory_mb: i64, is_remote: bool) -> Self {
        Self {
            id: Uuid::now_v7(),
            is_remote,
            is_one_of_several: is_remote,
            memory: Mutex::new(MemoryBudget {
                memory_mb,
                used_mb: 0,
                running: 0,
            }),
            health: Arc::default(),
            turn: tokio::sync::Mutex::new(Turn {
                number: 1,
                unanswered: 0,
                not_before: Instant::now(),
            }),
        }
    }

    /// One beside which others, with more memory, may take the jobs that do not fit.
    #[must_use]
    pub fn beside_others(self) -> Self {
        Self {
            is_one_of_several: true,
            ..self
        }
    }

    /// Id, new with each start.
    pub fn id(&self) -> Uuid {
        self.id
    }

    /// Health of its workers.
    pub fn health(&self) -> &Arc<WorkerHealth> {
        &self.health
    }

    /// Claims a job that fits into the free memory, and short ones after it, and reserves the memory of the largest. After a request without
    /// an answer, and while solving processes do not start, all workers of the process pause.
    pub(super) async fn claim(
        &self,
        job_source: &impl JobSource,
        config: &WorkerConfig,
        stopping: &CancellationToken,
    ) -> Result<Option<Claimed<'_>>, JobSourceError> {
        let mut turn = tokio::select! {
            biased;
            () = stopping.cancelled() => return Ok(None),
            turn = self.turn() => turn,
        };
        let request = self.request(turn.number, config);
        let round = self.health.round();
        // Without an answer the same request is made again, by whichever worker is next.
        let answer = tokio::select! {
            answer = job_source.claim(&request) => answer,
            // The request may wait for long. Repeated without a slot, it returns the jobs claimed meanwhile, to be released.
            () = stopping.cancelled() => job_source.claim(&without_slots(request)).await,
        };
        turn.note(answer.is_ok());
        let claims = answer?;
        let Some(estimated_mb) = claims.iter().map(|claim| claim.memory_mb).max() else {
            return Ok(None);
        };
        round.claimed();
        Ok(Some(Claimed {
            claims,
            memory: self.reserve(estimated_mb, config),
            round,
        }))
    }

    /// Waits until a worker may ask for jobs, and then lets no other one ask.
    async fn turn(&self) -> tokio::sync::MutexGuard<'_, Turn> {
        let turn = self.turn.lock().await;
        tokio::time::sleep_until(turn.not_before).await;
        self.health.resumed().await;
        turn
    }

    fn request(&self, number: i64, config: &WorkerConfig) -> ClaimRequest {
        ClaimRequest {
            request: RequestNumber {
                worker: self.id,
                number,
            },
            is_remote: self.is_remote,
            capacity: Capacity {
                slots: 1,
                memory: *self.memory(),
                is_one_of_several: self.is_one_of_several,
                ahead_ms: i64::try_from(config.ahead.as_millis()).unwrap_or(i64::MAX),
            },
            lease: config.lease,
            token: None,
        }
    }

    /// Reserves memory for a solve with this estimate, and for as many threads as there is memory for.
    fn reserve(&self, estimated_mb: i64, config: &WorkerConfig) -> SolveMemory<'_> {
        let mut memory = self.memory();
        memory.running += 1;
        let running = usize::try_from(memory.running).unwrap_or_default();
        let (threads, memory_mb) =
            config.threads_and_memory(estimated_mb, memory.free_mb(), running);
        memory.used_mb += memory_mb;
        SolveMemory {
            process: self,
            memory_mb,
            threads,
        }
    }

    fn memory(&self) -> MutexGuard<'_, MemoryBudget> {
        self.memory.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Turn {
    /// Notes whether the request was answered. One that was not is repeated after a pause.
    fn note(&mut self, is_answered: bool) {
        if is_answered {
            (self.number, self.unanswered) = (self.number + 1, 0);
        } else {
            self.unanswered += 1;
            self.not_before = Instant::now() + RETRY.jittered_pause_after(self.unanswered);
        }
    }
}

/// The same request for no further job.
fn without_slots(request: ClaimRequest) -> ClaimRequest {
    ClaimRequest {
        capacity: Capacity {
            slots: 0,
            ..request.capacity
        },
        ..request
    }
}
