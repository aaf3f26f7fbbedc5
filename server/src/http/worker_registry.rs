//! Contacts of this service with remote workers, which it notes in the store from time to time: there are many a second.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use uuid::Uuid;

use crate::queue::MemoryBudget;
use crate::store::{Store, WorkerContact, WorkerOffer};
use crate::worker::protocol::MAX_SLOTS;

/// Time after which a contact is noted again: much shorter than that after which a process is taken for ended.
const NOTE_EVERY: Duration = Duration::from_secs(10);
/// The same where workers are shown.
const SHOW_EVERY: Duration = Duration::from_secs(2);
/// Time after which a silent process is forgotten here.
const FORGOTTEN: Duration = Duration::from_mins(1);
/// Longest name of a machine, characters.
const LONGEST_HOST: usize = 255;
/// Longest sentence about a failing worker, characters.
const LONGEST_CAUSE: usize = 500;

/// The processes that were in contact.
#[derive(Debug, Default)]
pub(crate) struct WorkerRegistry {
    seen: Mutex<BTreeMap<Uuid, Seen>>,
    /// Those that take no more jobs.
    draining: Mutex<BTreeSet<Uuid>>,
}

#[derive(Debug)]
struct Seen {
    offer: Option<WorkerOffer>,
    failing: Option<String>,
    last_contact: Instant,
    /// The last contact that the store knows.
    noted: Option<Instant>,
}

impl WorkerRegistry {
    /// Notes a claim.
    pub(super) fn claims(&self, worker: Uuid, host: &str, slots: usize, memory: MemoryBudget) {
        let offer = WorkerOffer {
            host: shown(host, LONGEST_HOST),
            slots: i64::try_from(slots.min(MAX_SLOTS)).unwrap_or(i64::MAX),
            memory_mb: memory.memory_mb,
            free_memory_mb: memory.free_mb(),
        };
        self.contact(worker, |entry| entry.offer = Some(offer));
    }

    /// Notes a heartbeat, with why the worker starts no solves at present.
    pub(super) fn beats(&self, worker: Uuid, failing: Option<&str>) {
        let failing = failing.map(|cause| shown(cause, LONGEST_CAUSE));
        self.contact(worker, |entry| {
            if entry.failing != failing {
                // To be noted at once.
                entry.noted = None;
                entry.failing = failing;
            }
        });
    }

    /// Returns `true` if a process takes no more jobs.
    pub(super) fn is_draining(&self, worker: Uuid) -> bool {
        held(&self.draining).contains(&worker)
    }

    /// Notes in the store what has not been noted for a while, and reads who takes no more jobs. What fails is logged and done the next time.
    pub(crate) async fn exchange(&self, store: &Store) {
        self.note(store, NOTE_EVERY).await;
        match store.draining_workers().await {
            Ok(draining) => *held(&self.draining) = draining.into_iter().collect(),
            Err(error) => tracing::warn!(%error, "drained workers could not be read"),
        }
    }

    /// Notes in the store what is to be shown.
    pub(super) async fn note_shown(&self, store: &Store) {
        self.note(store, SHOW_EVERY).await;
    }

    async fn note(&self, store: &Store, every: Duration) {
        let contacts = self.due(every);
        if contacts.is_empty() {
            return;
        }
        let began = Instant::now();
        match store.note_workers(&contacts).await {
            Ok(()) => {
                let mut seen = held(&self.seen);
                for contact in &contacts {
                    let noted = began.checked_sub(contact.ago);
                    seen.entry(contact.id)
                        .and_modify(|entry| entry.noted = noted.or(entry.noted));
                }
            }
            Err(error) => tracing::warn!(%error, "contacts with workers could not be noted"),
        }
    }

    /// Contacts with processes of which the last one that was noted is so old; silent processes are forgotten.
    fn due(&self, every: Duration) -> Vec<WorkerContact> {
        let mut seen = held(&self.seen);
        seen.retain(|_, entry| entry.last_contact.elapsed() < FORGOTTEN);
        let is_due = |entry: &Seen| {
            let since = |noted| entry.last_contact.saturating_duration_since(noted);
            entry.noted.is_none_or(|noted| since(noted) > every)
        };
        let due = seen.iter().filter(|(_, entry)| is_due(entry));
        let contact = |(id, entry): (&Uuid, &Seen)| WorkerContact {
            id: *id,
            offer: entry.offer.clone(),
            failing: entry.failing.clone(),
            ago: entry.last_contact.elapsed(),
        };
        due.map(contact).collect()
    }

    /// Notes a contact now, and what it changes.
    fn contact(&self, worker: Uuid, change: impl FnOnce(&mut Seen)) {
        let (mut seen, now) = (held(&self.seen), Instant::now());
        let entry = seen.entry(worker).or_insert(Seen {
            offer: None,
            failing: None,
            last_contact: now,
            noted: None,
        });
        entry.last_contact = now;
        change(entry);
    }
}

/// A text of a worker as it may be shown.
fn shown(text: &str, most: usize) -> String {
    let shown = text.chars().filter(|c| !c.is_control());
    shown.take(most).collect()
}

fn held<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
