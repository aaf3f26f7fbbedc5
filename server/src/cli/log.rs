//! The log on standard error.
//!
//! Lines pass through a queue to a thread of its own. A reader that stops reading, a closed pipe or a full disk costs lines
//! of the log and nothing else: no task waits for the log, and none fails with it.

use std::backtrace::{Backtrace, BacktraceStatus};
use std::io::IsTerminal;
use std::panic::PanicHookInfo;

use tracing_appender::non_blocking::{NonBlockingBuilder, WorkerGuard};
use tracing_subscriber::EnvFilter;

use crate::cli::arguments::LogFormat;

/// Lines that wait to be written at most; further ones are dropped. Some MB.
const WAITING_LINES: usize = 16_384;

/// Starts the log at a level, which `RUST_LOG` overrides; the guard writes the lines that wait when it is dropped.
pub(super) fn start(level: &str, format: LogFormat) -> WorkerGuard {
    let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new(level));
    let (writer, guard) = NonBlockingBuilder::default()
        .lossy(true)
        .buffered_lines_limit(WAITING_LINES)
        .thread_name("log")
        .finish(std::io::stderr());
    let builder = tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_ansi(std::io::stderr().is_terminal())
        // Otherwise a line that is not written is reported on standard error, which panics where that fails, too.
        .log_internal_errors(false)
        .with_writer(writer);
    match format {
        LogFormat::Text => builder.init(),
        LogFormat::Json => builder.json().init(),
    }
    guard
}

/// Logs what a panic says: the standard hook would write on standard error itself, and wait there.
pub(super) fn log_panics() {
    std::panic::set_hook(Box::new(log_panic));
}

/// Logs a panic, with a backtrace where `RUST_BACKTRACE` requests one.
fn log_panic(panic: &PanicHookInfo<'_>) {
    let backtrace = Backtrace::capture();
    let captured = backtrace.status() == BacktraceStatus::Captured;
    let backtrace = captured.then(|| backtrace.to_string());
    tracing::error!(%panic, backtrace, "a task panicked");
}
