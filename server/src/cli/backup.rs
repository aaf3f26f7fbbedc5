//! `fretwear backup`, `fretwear restore` and `fretwear verify`.

use std::path::Path;

use crate::cli::runtime::block_on;
use crate::cli::terminal::{Ended, failed, write_out};
use crate::objects::Objects;
use crate::store::{BackupError, CopySummary, backup, restore, verify};

pub(super) fn run(database: &str, into: &Path) -> Ended {
    let copied = block_on(backup(database, into))?;
    let damaged = report(copied, "copied and verified")?;
    refuse(damaged, "they are copied as they are")
}

pub(super) fn run_restore(from: &Path, database: &str) -> Ended {
    let copied = block_on(restore(from, database))?;
    // The backup has said so before.
    report(copied, "copied and verified").map(|_| ())
}

pub(super) fn run_verify(database: &str, files: &Path, objects: Option<&str>) -> Ended {
    let objects = objects.map(Objects::open).transpose().map_err(failed)?;
    let verified = block_on(verify(database, files, objects.as_ref()))?;
    let damaged = report(verified, "verified")?;
    refuse(damaged, "files among them are marked in their manifests")
}

/// Writes what was done, and each damaged file; returns their number.
fn report(
    done: Result<CopySummary, BackupError>,
    what: &str,
) -> Result<usize, std::process::ExitCode> {
    let CopySummary {
        jobs,
        files,
        file_bytes,
        damaged,
        unread,
        elsewhere,
        has_ended_early,
    } = done.map_err(failed)?;
    for file in &damaged {
        write_out(format_args!("damaged: {file}"))?;
    }
    for file in unread.iter().chain(&elsewhere) {
        write_out(format_args!("not verified: {file}"))?;
    }
    write_out(format_args!(
        "{jobs} jobs and {files} files of {file_bytes} bytes {what}"
    ))?;
    if unread.is_empty() && elsewhere.is_empty() {
        return Ok(damaged.len());
    }
    let early = if has_ended_early {
        ", and the jobs after these were not tried"
    } else {
        ""
    };
    Err(failed(format_args!(
        "{} results could not be read and {} are not here{early}; {} damaged ones were found",
        unread.len(),
        elsewhere.len(),
        damaged.len()
    )))
}

/// Fails if results are damaged.
fn refuse(damaged: usize, treated: &str) -> Ended {
    if damaged == 0 {
        return Ok(());
    }
    Err(failed(format_args!(
        "{damaged} damaged results were found; {treated}"
    )))
}
