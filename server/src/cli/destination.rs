//! Folders and files that a command writes: checked before it solves anything, so that no finished run is lost.

use std::path::Path;
use std::process::ExitCode;

use crate::cli::terminal::unusable_at;

/// Creates a folder, and checks that files can be written there; reports a failure and returns its exit code.
pub(super) fn folder(path: &Path) -> Result<(), ExitCode> {
    let created = std::fs::create_dir_all(path);
    let written = created.and_then(|()| tempfile::tempfile_in(path));
    written.map(drop).map_err(|cause| unusable_at(path, &cause))
}

/// Checks that a file can be written; reports a failure and returns its exit code.
pub(super) fn file(path: &Path) -> Result<(), ExitCode> {
    let written = if path.exists() {
        std::fs::File::options().append(true).open(path)
    } else {
        let parent = path.parent().filter(|parent| *parent != Path::new(""));
        tempfile::tempfile_in(parent.unwrap_or(Path::new(".")))
    };
    written.map(drop).map_err(|cause| unusable_at(path, &cause))
}
