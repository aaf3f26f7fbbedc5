//! Processes with remote workers, as their requests show them: who is there, with what memory, and what it holds.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use api::worker::RemoteWorker;
use uuid::Uuid;

use crate::queue::MemoryBudget;

/// Time without contact after which a process is taken for ended: several claims, each of which waits for up to 20 s.
const PRESENT: Duration = Duration::from_mins(1);

/// The processes, by id and so by age.
#[derive(Debug, Default)]
pub(super) struct WorkerRegistry {
    seen: Mutex<BTreeMap<Uuid, Seen>>,
}

#[derive(Debug)]
struct Seen {
    host: String,
    slots: usize,
    memory: MemoryBudget,
    jobs: usize,
    last_contact: Instant,
}

impl WorkerRegistry {
    /// Notes a claim.
    pub(super) fn claims(&self, worker: Uuid, (host, slots): (&str, usize), memory: MemoryBudget) {
        let mut seen = self.present();
        let entry = seen.entry(worker).or_insert_with(|| Seen {
            host: host.to_owned(),
            slots,
            memory,
            jobs: 0,
            last_contact: Instant::now(),
        });
        entry.memory = memory;
        entry.last_contact = Instant::now();
        if memory.running == 0 {
            entry.jobs = 0;
        }
    }

    /// Notes a heartbeat for so many jobs. A process that has not claimed since the service started is not known yet.
    pub(super) fn beats(&self, worker: Uuid, jobs: usize) {
        if let Some(entry) = self.present().get_mut(&worker) {
            entry.jobs = jobs;
            entry.last_contact = Instant::now();
        }
    }

    /// Number of jobs that all of them solve at once.
    pub(super) fn slots(&self) -> u64 {
        let slots = self.list().into_iter().map(|worker| worker.slots);
        slots.fold(0, u64::saturating_add)
    }

    /// The processes that are there.
    pub(super) fn list(&self) -> Vec<RemoteWorker> {
        let positive = |value: i64| u64::try_from(value).unwrap_or_default();
        let shown = |(id, seen): (&Uuid, &Seen)| RemoteWorker {
            id: *id,
            host: seen.host.clone(),
            slots: u64::try_from(seen.slots).unwrap_or(u64::MAX),
            jobs: u64::try_from(seen.jobs).unwrap_or(u64::MAX),
            memory_mb: positive(seen.memory.memory_mb),
            free_memory_mb: positive(seen.memory.free_mb()),
            last_contact_s: seen.last_contact.elapsed().as_secs(),
        };
        self.present().iter().map(shown).collect()
    }

    /// Those that are there; the others are forgotten.
    fn present(&self) -> MutexGuard<'_, BTreeMap<Uuid, Seen>> {
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        seen.retain(|_, entry| entry.last_contact.elapsed() < PRESENT);
        seen
    }
}
