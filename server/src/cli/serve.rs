//! `fretwear serve`: the service.

use std::process::ExitCode;

use tokio::signal::unix::{SignalKind, signal};

use crate::cli::arguments::ServeArguments;
use crate::cli::runtime::runtime;
use crate::cli::terminal::{failed, write_err};
use crate::service::{Config, Service};

pub(super) fn run(arguments: ServeArguments) -> ExitCode {
    let runtime = match runtime() {
        Ok(runtime) => runtime,
        Err(cause) => return failed(cause),
    };
    let program = match std::env::current_exe() {
        Ok(program) => program,
        Err(cause) => return failed(cause),
    };
    runtime.block_on(async {
        let work = &arguments.work;
        let access = match arguments.access.access() {
            Ok(access) => access,
            Err(error) => return failed(error),
        };
        let config = Config {
            listen: arguments.listen,
            access,
            workers: work.workers(),
            attempts: work.attempts,
            keep_days: work.keep_days,
            worker: work.config(program, &arguments.database),
            database: arguments.database,
        };
        let service = match Service::start(config).await {
            Ok(service) => service,
            Err(error) => return failed(error),
        };
        write_err(format_args!(
            "fretwear serves on http://{}",
            service.address
        ));
        let ended = until_signal().await;
        service.stop().await;
        match ended {
            Ok(()) => ExitCode::SUCCESS,
            Err(cause) => failed(cause),
        }
    })
}

/// Returns at SIGINT (Ctrl-C) or SIGTERM.
pub(super) async fn until_signal() -> std::io::Result<()> {
    let mut interrupt = signal(SignalKind::interrupt())?;
    let mut terminate = signal(SignalKind::terminate())?;
    tokio::select! {
        _ = interrupt.recv() => {}
        _ = terminate.recv() => {}
    }
    Ok(())
}
