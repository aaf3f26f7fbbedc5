//! Runtime and parallelism of the commands.

use std::process::ExitCode;
use std::sync::Arc;

use nix::sys::signal::Signal::SIGXFSZ;

use crate::cli::terminal::failed;

/// A number of jobs or threads; one per processor unless given.
pub(super) fn or_processors(given: Option<u16>) -> usize {
    given.map_or_else(processors, usize::from)
}

/// Processors of this machine that the process may use.
pub(super) fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Lets writes beyond the largest size of a file (`ulimit -f`) fail with an error. Otherwise the system ends the process without a line.
pub(super) fn report_large_files() -> std::io::Result<()> {
    let flag = Arc::default();
    signal_hook::flag::register(SIGXFSZ as i32, flag).map(drop)
}

/// Runs a future on a multi-threaded runtime.
pub(super) fn block_on<F: Future>(future: F) -> Result<F::Output, ExitCode> {
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()
        .map_err(failed)?;
    Ok(runtime.block_on(future))
}
