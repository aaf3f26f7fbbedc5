//! `fretwear backup` and `fretwear restore`.

use std::path::Path;

use crate::cli::runtime::block_on;
use crate::cli::terminal::{Ended, failed, write_out};
use crate::store::{BackupError, CopySummary, backup, restore};

pub(super) fn run(database: &str, into: &Path) -> Ended {
    report(block_on(backup(database, into))?)
}

pub(super) fn run_restore(from: &Path, database: &str) -> Ended {
    report(block_on(restore(from, database))?)
}

fn report(copied: Result<CopySummary, BackupError>) -> Ended {
    let CopySummary {
        jobs,
        files,
        file_bytes,
    } = copied.map_err(failed)?;
    write_out(format_args!(
        "{jobs} jobs and {files} files of {file_bytes} bytes copied and verified"
    ));
    Ok(())
}
