//! The disk of the database and its results: how much of it is free, and a part that is reserved.
//!
//! The reserved part is a file beside the database. It is removed when a write fails because the disk is full, so that
//! cancel requests, deletions and leases are written all the same; until it can be allocated again, other writes are
//! refused, or they would use up the space. It stays when the service ends, so that the service can start on a disk that is full.

use std::fs::File;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use api::job::Status;

use crate::export::files;
use crate::store::error::StoreError;

/// Size of the reserved part, bytes: some hundred transactions of a few pages each.
const RESERVED: usize = 4 << 20;
/// Free space from which it is reserved, MB.
const LEAST_FREE_TO_RESERVE_MB: u64 = 8;
const BLOCK: usize = 1 << 12;

/// The disk of the database.
#[derive(Debug)]
pub struct DataDisk {
    /// Free space below which no job is started, MB.
    least_free_mb: u64,
    /// The file that occupies the reserved part.
    reserve: PathBuf,
    is_reserved: AtomicBool,
    /// Free pages of the database, bytes: the next writes use them first.
    free_in_database: AtomicU64,
    /// The file of the database is not at its path any more.
    is_database_removed: AtomicBool,
}

impl DataDisk {
    /// The disk of a file that is created, if there is space for it, to reserve some.
    pub(super) fn reserve(reserve: PathBuf, least_free_mb: u64) -> Self {
        let disk = Self {
            least_free_mb,
            reserve,
            is_reserved: AtomicBool::new(false),
            free_in_database: AtomicU64::new(0),
            is_database_removed: AtomicBool::new(false),
        };
        // The start itself needs what a process before this one has reserved, if the disk is full.
        disk.remove();
        disk.reserve_again();
        disk
    }

    /// Returns `true` if a write failed because the disk was full, and there is no space since.
    pub fn is_full(&self) -> bool {
        !self.is_reserved.load(Ordering::Acquire)
    }

    /// Free space, MB; `None` if the system does not report it.
    pub fn free_mb(&self) -> Option<u64> {
        files::free_mb(files::parent(&self.reserve))
    }

    /// Notes the size of the free pages of the database, bytes.
    pub(super) fn set_free_in_database(&self, bytes: u64) {
        self.free_in_database.store(bytes, Ordering::Relaxed);
    }

    /// Size of the free pages of the database, MB.
    pub fn free_in_database_mb(&self) -> u64 {
        self.free_in_database.load(Ordering::Relaxed) >> 20
    }

    /// Free space with that in the database, MB; `None` if the system does not report it.
    pub fn usable_mb(&self) -> Option<u64> {
        Some(self.free_mb()? + self.free_in_database_mb())
    }

    /// Why no job is started, if there is not enough space.
    pub fn shortage(&self) -> Option<String> {
        if self.is_full() {
            let free = self
                .free_mb()
                .map_or_else(String::new, |mb| format!(" ({mb} MB free)"));
            return Some(format!("{}{free}", StoreError::DiskFull));
        }
        let free = self.usable_mb().filter(|mb| *mb < self.least_free_mb)?;
        let needed = self.least_free_mb;
        Some(format!("{free} MB are free, {needed} MB are needed"))
    }

    /// Why a job waits, if it waits for space: a queued one for enough to start, a running one for any.
    pub(super) fn status_reason(&self, status: Status) -> Option<String> {
        let waits = match status {
            Status::Queued => true,
            Status::Running => self.is_full(),
            _ => false,
        };
        let shortage = waits.then(|| self.shortage())??;
        Some(format!("waiting for disk space: {shortage}"))
    }

    /// Notes that the file of the database is not at its path any more; returns whether this was known.
    pub(super) fn note_removed_database(&self) -> bool {
        self.is_database_removed.swap(true, Ordering::AcqRel)
    }

    /// Fails while the reserved part is needed for other writes, or if what is written would be lost.
    pub(super) fn check(&self) -> Result<(), StoreError> {
        if self.is_database_removed.load(Ordering::Acquire) {
            return Err(StoreError::Removed);
        }
        if self.is_full() {
            return Err(StoreError::DiskFull);
        }
        Ok(())
    }

    /// Executes a small write that must not fail because the disk is full.
    pub(super) async fn with_reserve<T, F: Future<Output = Result<T, StoreError>>>(
        &self,
        write: impl Fn() -> F,
    ) -> Result<T, StoreError> {
        match write().await {
            Err(error) if self.release_after(&error) => write().await,
            answer => answer,
        }
    }

    /// Frees the reserved part if an operation failed because the disk is full; returns whether it did.
    pub fn release_after(&self, error: &StoreError) -> bool {
        let releases = error.is_disk_full() && self.is_reserved.swap(false, Ordering::AcqRel);
        if releases {
            tracing::warn!("the disk is full; the reserved space is left to cancel requests");
            self.remove();
        }
        releases
    }

    /// Reserves the space again if it was released. Blocks while the file is written.
    pub fn reserve_again(&self) {
        // Space that is hardly more than what was released would be used up at once.
        if !self.is_full()
            || self
                .free_mb()
                .is_some_and(|free| free < LEAST_FREE_TO_RESERVE_MB)
        {
            return;
        }
        match self.write() {
            Ok(()) => self.is_reserved.store(true, Ordering::Release),
            Err(error) => {
                tracing::warn!(%error, path = %self.reserve.display(), "no disk space could be reserved");
                self.remove();
            }
        }
    }

    fn write(&self) -> std::io::Result<()> {
        let mut file = File::create(&self.reserve)?;
        for _ in 0..RESERVED / BLOCK {
            file.write_all(&[0; BLOCK])?;
        }
        file.sync_all()
    }

    fn remove(&self) {
        // A file that cannot be removed is written over the next time.
        let _ = std::fs::remove_file(&self.reserve);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disk(least_free_mb: u64) -> (tempfile::TempDir, DataDisk) {
        let folder = tempfile::tempdir().expect("a folder");
        let reserve = folder.path().join("reserve");
        (folder, DataDisk::reserve(reserve, least_free_mb))
    }

    #[test]
    fn a_disk_with_too_little_free_space_starts_no_job() {
        let (_folder, disk) = disk(u64::MAX);
        let reason = disk.status_reason(Status::Queued).expect("a reason");
        assert!(reason.starts_with("waiting for disk space: "), "{reason}");
        assert!(reason.ends_with(" MB are needed"), "{reason}");
        assert_eq!(disk.status_reason(Status::Running), None);
        assert!(disk.check().is_ok());
        let (_folder, disk) = self::disk(0);
        assert_eq!(disk.shortage(), None);
    }

    #[tokio::test]
    async fn a_full_disk_has_space_for_a_cancel_request_only() {
        let (folder, disk) = disk(0);
        let reserve = folder.path().join("reserve");
        let size = std::fs::metadata(&reserve).expect("a file").len();
        assert_eq!(size, u64::try_from(RESERVED).expect("small"));
        // Fails as long as the space is reserved.
        let write = async || {
            if reserve.exists() {
                Err(StoreError::DiskFull)
            } else {
                Ok(())
            }
        };
        assert!(disk.with_reserve(write).await.is_ok());
        assert!(disk.check().is_err_and(|error| error.is_disk_full()));
        for status in [Status::Queued, Status::Running] {
            let reason = disk.status_reason(status).expect("a reason");
            assert!(
                reason.contains("no space left on the data disk"),
                "{reason}"
            );
        }
        assert_eq!(disk.status_reason(Status::Succeeded), None);
        disk.reserve_again();
        assert!(disk.check().is_ok());
        drop(disk);
        assert!(reserve.exists(), "the next process needs it");
    }
}
