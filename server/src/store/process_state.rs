//! State of a store in this process, besides the database: the folder of large results, the disk, the clock, counters and
//! subscribers.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use api::job::Status;
use tokio::sync::{Mutex, Notify, OnceCell, Semaphore, broadcast, mpsc};
use tokio::time::Instant;
use uuid::Uuid;

use crate::clock::Clock;
use crate::metrics::Metrics;
use crate::objects::Objects;
use crate::store::batch_counts::BatchCounts;
use crate::store::folder::{Folder, beside};
use crate::store::{Cancelled, DataDisk, Lease, LeaseState, Limits};

/// Number of changes that a subscriber may fall behind.
const CHANGE_CAPACITY: usize = 1024;

/// Memory of the files that are written to the store of objects at the same time, MB. Arbitrary.
pub(in crate::store) const FILE_WRITES_MB: usize = 256;

/// Notification of the other processes that serve the same database.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::store) enum Notification {
    /// Jobs wait in the queue.
    Waiting,
    /// A job has changed.
    Changed(Uuid),
}

/// Logs that a write follows a gap after the last one that the database has.
pub(in crate::store) fn log_lost_writes(lease: Lease, number: i64, last: i64) {
    let Lease { job, number: lease } = lease;
    tracing::warn!(%job, lease, number, last, "the database has lost writes of a worker, whose lease ends");
}

/// State of a store in this process, besides the database.
#[derive(Debug)]
pub(in crate::store) struct ProcessState {
    pub(in crate::store) changes: broadcast::Sender<Uuid>,
    pub(in crate::store) waiting: Arc<Notify>,
    /// Notifications to the other processes that serve the same database.
    pub(in crate::store) others: Option<mpsc::UnboundedSender<Notification>>,
    pub(in crate::store) folder: Folder,
    /// Store of objects for results of succeeded jobs and for checkpoints.
    pub(in crate::store) objects: Option<Objects>,
    /// Set once the store of objects is known to be that of this database.
    pub(in crate::store) objects_checked: OnceCell<()>,
    /// The last job whose results were to be moved to objects; nil at first, and after the last job of all.
    pub(in crate::store) last_moved: Mutex<Uuid>,
    /// True once results were found whose files are in the folder of another service.
    pub(in crate::store) has_unseen_files: AtomicBool,
    /// True if objects that no job names are removed.
    pub(in crate::store) removes_objects: bool,
    /// Memory for files that are being written to objects, MB.
    pub(in crate::store) file_writes: Semaphore,
    /// Time of the last failed write to the store of objects.
    pub(in crate::store) objects_failed_at: Mutex<Option<Instant>>,
    /// The machine's calibration cache.
    pub(in crate::store) machine: PathBuf,
    pub(in crate::store) attempt_limit: u32,
    pub(in crate::store) metrics: Arc<Metrics>,
    pub(in crate::store) disk: Arc<DataDisk>,
    pub(in crate::store) clock: Clock,
    pub(in crate::store) batch_counts: BatchCounts,
}

impl ProcessState {
    /// Prepares the state. Its files are named after `files` and lie beside it; those of this machine also have its name where
    /// other machines have theirs in the same folder.
    pub(in crate::store) fn prepare(
        files: &Path,
        machine: Option<&str>,
        limits: Limits,
        clock: Clock,
    ) -> Self {
        let own = machine.map_or_else(String::new, |name| format!(".{name}"));
        let reserve = beside(files, &format!("{own}.reserve"));
        let (changes, _) = broadcast::channel(CHANGE_CAPACITY);
        Self {
            changes,
            waiting: Arc::default(),
            others: None,
            folder: Folder::beside(files),
            objects: None,
            objects_checked: OnceCell::new(),
            last_moved: Mutex::new(Uuid::nil()),
            has_unseen_files: AtomicBool::new(false),
            removes_objects: false,
            file_writes: Semaphore::new(FILE_WRITES_MB),
            objects_failed_at: Mutex::default(),
            machine: beside(files, &format!("{own}.machine.json")),
            attempt_limit: limits.attempts,
            metrics: Arc::default(),
            disk: Arc::new(DataDisk::reserve(reserve, limits.least_free_disk_mb)),
            clock,
            batch_counts: BatchCounts::default(),
        }
    }

    /// Counts a write whose lease was lost.
    pub(in crate::store) fn stale_write(&self) -> LeaseState {
        self.metrics.stale_writes.inc();
        LeaseState::Lost
    }

    /// The state of the lease of a numbered write that had no effect, by the number of the last one and whether the end of the job was
    /// requested, if the job is held: it is a repeated one; or a gap shows that the database has lost writes, and with them the lease.
    pub(in crate::store) fn written_before(
        &self,
        lease: Lease,
        number: i64,
        held: Option<(i64, bool)>,
    ) -> LeaseState {
        match held {
            Some((last, cancel_requested)) if number <= last => {
                LeaseState::Held { cancel_requested }
            }
            Some((last, _)) => {
                log_lost_writes(lease, number, last);
                self.stale_write()
            }
            None => self.stale_write(),
        }
    }

    /// Notifies the subscribers of a job.
    pub(in crate::store) fn changed(&self, id: Uuid) {
        // Without a subscriber this is not an error.
        let _ = self.changes.send(id);
        self.notify(Notification::Changed(id));
    }

    /// Notifies the other processes that serve the same database.
    fn notify(&self, notification: Notification) {
        if let Some(others) = &self.others {
            // The task that notifies them ends with the store.
            let _ = others.send(notification);
        }
    }

    /// Notifies subscribers of a committed cancel request, which ends a queued job.
    pub(in crate::store) fn cancelled(&self, id: Uuid, effect: Option<Cancelled>) {
        match effect {
            Some(Cancelled::AtOnce) => self.concluded(id, Some(Status::Cancelled)),
            Some(Cancelled::Requested) => self.changed(id),
            Some(Cancelled::Already) | None => {}
        }
    }

    /// Notifies subscribers and workers of a job that its worker has ended, or that waits again.
    pub(in crate::store) fn ended_by_worker(&self, id: Uuid, status: Option<Status>) {
        self.concluded(id, status);
        if status == Some(Status::Queued) {
            // The first worker that is woken may have to leave it to another one.
            self.many_wait();
        }
    }

    /// Notifies subscribers and workers of a committed transition, and counts ended jobs.
    pub(in crate::store) fn concluded(&self, id: Uuid, status: Option<Status>) {
        self.changed(id);
        match status {
            Some(Status::Queued) => {
                self.waiting.notify_one();
                self.notify(Notification::Waiting);
            }
            Some(status) if status.is_terminal() => self.metrics.ended(status),
            _ => {}
        }
    }

    /// Wakes every idle worker; one that misses the notification looks again within a second.
    pub(in crate::store) fn many_wait(&self) {
        self.waiting.notify_waiters();
        self.waiting.notify_one();
        self.notify(Notification::Waiting);
    }

    /// Removes the files of a deleted job. Files that cannot be removed are logged and remain until the next start.
    pub(in crate::store) async fn remove_files(&self, id: Uuid) {
        if let Err(error) = self.in_folder(move |folder| folder.remove(id)).await {
            tracing::warn!(job = %id, %error, "files could not be removed");
        }
    }

    /// Removes files that no manifest names, by an operation that returns their number. Those that cannot be removed are logged and remain.
    pub(in crate::store) async fn remove_unnamed(
        &self,
        remove: impl FnOnce(Folder) -> std::io::Result<usize> + Send + 'static,
    ) {
        match self.in_folder(remove).await {
            Ok(0) => {}
            Ok(removed) => tracing::info!(removed, "files that no manifest names were removed"),
            Err(error) => tracing::warn!(%error, "files that no manifest names were not removed"),
        }
    }

    /// Runs a blocking operation on the folder of results.
    pub(in crate::store) async fn in_folder<T: Send + 'static>(
        &self,
        operation: impl FnOnce(Folder) -> std::io::Result<T> + Send + 'static,
    ) -> std::io::Result<T> {
        let folder = self.folder.clone();
        tokio::task::spawn_blocking(move || operation(folder)).await?
    }
}
