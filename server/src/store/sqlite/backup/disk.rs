//! Files and folders of copies.

use std::path::Path;

use crate::store::BackupError;

pub(super) fn absent(path: &Path) -> Result<(), BackupError> {
    if path.exists() {
        return Err(BackupError::Exists(path.to_owned()));
    }
    Ok(())
}

pub(super) fn sync(path: &Path) -> Result<(), BackupError> {
    std::fs::File::open(path)
        .and_then(|opened| opened.sync_all())
        .map_err(|cause| file(path, cause))
}

pub(super) fn file(path: &Path, cause: std::io::Error) -> BackupError {
    BackupError::File {
        path: path.to_owned(),
        cause,
    }
}
