//! Contacts of this service with remote workers, which it notes in the store from time to time: there are many a second.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use uuid::Uuid;

use crate::queue::MemoryBudget;
use crate::store::{Store, StoreError, WorkerContact, WorkerOffer};

/// Time after which a contact is noted again: much shorter than that after which a process is taken for ended.
const NOTE_EVERY: Duration = Duration::from_secs(10);

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
    last_contact: Instant,
    noted: Option<Instant>,
}

impl WorkerRegistry {
    /// Notes a claim.
    pub(super) fn claims(&self, worker: Uuid, (host, slots): (&str, usize), memory: MemoryBudget) {
        let offer = WorkerOffer {
            host: host.to_owned(),
            slots: i64::try_from(slots).unwrap_or(i64::MAX),
            memory_mb: memory.memory_mb,
            free_memory_mb: memory.free_mb(),
        };
        self.contact(worker, Some(offer));
    }

    /// Notes a heartbeat.
    pub(super) fn beats(&self, worker: Uuid) {
        self.contact(worker, None);
    }

    /// Whether a process takes no more jobs.
    pub(super) fn is_draining(&self, worker: Uuid) -> bool {
        held(&self.draining).contains(&worker)
    }

    /// Notes in the store what has not been noted for a while, and reads who takes no more jobs.
    pub(crate) async fn exchange(&self, store: &Store) -> Result<(), StoreError> {
        self.note(store, NOTE_EVERY).await?;
        let draining = store.draining_workers().await?;
        *held(&self.draining) = draining.into_iter().collect();
        Ok(())
    }

    /// Notes in the store all contacts since the last time.
    pub(super) async fn note_all(&self, store: &Store) -> Result<(), StoreError> {
        self.note(store, Duration::ZERO).await
    }

    async fn note(&self, store: &Store, every: Duration) -> Result<(), StoreError> {
        let contacts = self.due(every);
        if contacts.is_empty() {
            return Ok(());
        }
        store.note_workers(&contacts).await
    }

    /// Contacts with processes that were last noted so long ago, and have been in contact since; the others are forgotten once they are
    /// noted and silent.
    fn due(&self, every: Duration) -> Vec<WorkerContact> {
        let mut seen = held(&self.seen);
        let mut contacts = Vec::new();
        for (id, entry) in seen.iter_mut() {
            let is_new = entry.noted.is_none_or(|noted| entry.last_contact > noted);
            if is_new && entry.noted.is_none_or(|noted| noted.elapsed() >= every) {
                entry.noted = Some(Instant::now());
                contacts.push(WorkerContact {
                    id: *id,
                    offer: entry.offer.clone(),
                    ago: entry.last_contact.elapsed(),
                });
            }
        }
        seen.retain(|_, entry| entry.last_contact.elapsed() < 2 * NOTE_EVERY);
        contacts
    }

    /// Notes a contact now, with what the process offers where it says so.
    fn contact(&self, worker: Uuid, offer: Option<WorkerOffer>) {
        let (mut seen, now) = (held(&self.seen), Instant::now());
        let entry = seen.entry(worker).or_insert(Seen {
            offer: None,
            last_contact: now,
            noted: None,
        });
        entry.last_contact = now;
        if offer.is_some() {
            entry.offer = offer;
        }
    }
}

fn held<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
