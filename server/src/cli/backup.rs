//! `fretwear backup` and `fretwear restore`.

use std::path::Path;
use std::process::ExitCode;

use crate::cli::runtime::runtime;
use crate::cli::terminal::{failed, write_out};
use crate::store::{BackupError, CopySummary, backup, restore};

pub(super) fn run(database: &str, into: &Path) -> ExitCode {
    ended(runtime().map(|runtime| runtime.block_on(backup(database, into))))
}

pub(super) fn run_restore(from: &Path, database: &str) -> ExitCode {
    ended(runtime().map(|runtime| runtime.block_on(restore(from, database))))
}

fn ended(copied: std::io::Result<Result<CopySummary, BackupError>>) -> ExitCode {
    match copied {
        Ok(Ok(CopySummary {
            jobs,
            files,
            file_bytes,
        })) => {
            write_out(format_args!(
                "{jobs} jobs and {files} files of {file_bytes} bytes copied and verified"
            ));
            ExitCode::SUCCESS
        }
        Ok(Err(error)) => failed(error),
        Err(cause) => failed(cause),
    }
}
