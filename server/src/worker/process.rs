//! What the workers of one process share: the numbers of their requests, and the memory of their solves.

use std::sync::{Mutex, MutexGuard, PoisonError};

use tokio_util::sync::CancellationToken;
use uuid::Uuid;

use crate::queue::{Capacity, MemoryBudget};
use crate::store::{Claim, ClaimRequest, RequestNumber};
use crate::worker::config::WorkerConfig;
use crate::worker::employer::{Employer, EmployerError};

/// The workers of one process.
#[derive(Debug)]
pub struct WorkerProcess {
    id: Uuid,
    is_remote: bool,
    is_one_of_several: bool,
    memory: Mutex<MemoryBudget>,
    /// Number of the next request; held during it, so that one worker asks at a time.
    next_request: tokio::sync::Mutex<i64>,
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
            next_request: tokio::sync::Mutex::new(1),
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

    /// Its id, new with each start.
    pub fn id(&self) -> Uuid {
        self.id
    }

    /// Claims a job that fits into the free memory, and short ones after it, and reserves the memory of the largest.
    pub(super) async fn claim(
        &self,
        employer: &impl Employer,
        config: &WorkerConfig,
        stopping: &CancellationToken,
    ) -> Result<Option<(Vec<Claim>, SolveMemory<'_>)>, EmployerError> {
        let mut number = tokio::select! {
            biased;
            () = stopping.cancelled() => return Ok(None),
            number = self.next_request.lock() => number,
        };
        let request = ClaimRequest {
            request: RequestNumber {
                worker: self.id,
                number: *number,
            },
            is_remote: self.is_remote,
            capacity: Capacity {
                slots: 1,
                memory: *self.memory(),
                is_one_of_several: self.is_one_of_several,
                ahead_ms: i64::try_from(config.ahead.as_millis()).unwrap_or(i64::MAX),
            },
            lease: config.lease,
        };
        // Without an answer the same request is made again, by whichever worker is next.
        let claims = tokio::select! {
            claims = employer.claim(&request) => claims?,
            // It may wait for long. Repeated without a slot, it gets what it has claimed meanwhile, to be given back.
            () = stopping.cancelled() => employer.claim(&without_slots(request)).await?,
        };
        *number += 1;
        let Some(estimated_mb) = claims.iter().map(|claim| claim.memory_mb).max() else {
            return Ok(None);
        };
        let mut memory = self.memory();
        memory.running += 1;
        let running = usize::try_from(memory.running).unwrap_or_default();
        let (threads, memory_mb) =
            config.threads_and_memory((estimated_mb, memory.free_mb()), running);
        memory.used_mb += memory_mb;
        drop(memory);
        let reserved = SolveMemory {
            process: self,
            memory_mb,
            threads,
        };
        Ok(Some((claims, reserved)))
    }

    fn memory(&self) -> MutexGuard<'_, MemoryBudget> {
        self.memory.lock().unwrap_or_else(PoisonError::into_inner)
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
