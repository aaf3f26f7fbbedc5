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
    /// The last contact that the store knows.
    noted: Option<Instant>,
}

impl WorkerRegistry {
    /// Notes a claim.
    pub(super) fn claims(&self, worker: Uuid, (host, slots): (&str, usize), memory: MemoryBudget) {
        let offer = WorkerOffer {
            host: host
                .chars()
                .filter(|c| !c.is_control())
                .take(LONGEST_HOST)
                .collect(),
            slots: i64::try_from(slots.min(MAX_SLOTS)).unwrap_or(i64::MAX),
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

    /// Notes in the store what has not been noted for a while, and reads who takes no more jobs. What fails is logged and done the next time.
    pub(crate) async fn exchange(&self, store: &Store) {
        self.note(store, NOTE_EVERY).await;
        match store.draining_workers().await {
            Ok(draining) => *held(&self.draining) = draining.into_iter().collect(),
            Err(error) => tracing::warn!(%error, "it is not known which workers are drained"),
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
            ago: entry.last_contact.elapsed(),
        };
        due.map(contact).collect()
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
