//! The lock beside a database: one process serves it.

use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

use crate::export::files::parent;
use crate::store::StoreError;
use crate::store::folder::beside;

/// The lock of a database. The operating system releases it when the process ends, however it ends.
///
/// Closing the file would not release it while another process has the file, too: one that this process has begun to start shares its files
/// until it executes its program.
#[derive(Debug)]
pub(super) struct DatabaseLock(File);

impl Drop for DatabaseLock {
    fn drop(&mut self) {
        if let Err(error) = self.0.unlock() {
            tracing::warn!(%error, "the lock of the database was not released");
        }
    }
}

/// Locks the file beside the database.
pub(super) fn lock(database: &Path) -> Result<DatabaseLock, StoreError> {
    let prepare = |cause| StoreError::Prepare {
        path: database.to_owned(),
        cause,
    };
    let folder = parent(database);
    if !folder.is_dir() {
        return Err(StoreError::NoFolder {
            path: folder.to_owned(),
        });
    }
    let path = beside(&real_path(database).map_err(prepare)?, ".lock");
    let file = File::options()
        .create(true)
        .truncate(false)
        .write(true)
        .open(&path)
        .map_err(prepare)?;
    match file.try_lock() {
        Ok(()) => Ok(DatabaseLock(file)),
        Err(TryLockError::WouldBlock) => Err(StoreError::Locked { path }),
        Err(TryLockError::Error(cause)) => Err(prepare(cause)),
    }
}

/// Returns the database's path without links, so that two names of one database share a lock.
fn real_path(database: &Path) -> std::io::Result<PathBuf> {
    match database.canonicalize() {
        Err(cause) if cause.kind() == std::io::ErrorKind::NotFound => {
            let name = database.file_name().unwrap_or_default();
            Ok(parent(database).canonicalize()?.join(name))
        }
        path => path,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lock_is_released_although_a_process_that_is_being_started_has_its_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let database = folder.path().join("test.db");
        let held = lock(&database).expect("a lock");
        let inherited = held.0.try_clone().expect("a file");
        assert!(lock(&database).is_err());
        drop(held);
        assert!(lock(&database).is_ok());
        drop(inherited);
    }
}
