//! `fretwear serve`: the service.

use std::pin::pin;

use nix::sys::resource::{Resource, getrlimit, setrlimit};

use crate::cli::access::warn_of_umask;
use crate::cli::arguments::{LogFormat, ServeArguments};
use crate::cli::runtime::block_on;
use crate::cli::signals::{Asked, Signals};
use crate::cli::terminal::{Ended, failed, write_err};
use crate::http::Tls;
use crate::objects::Objects;
use crate::program;
use crate::service::{Config, Service};

pub(super) fn run(arguments: ServeArguments) -> Ended {
    warn_of_umask();
    let access = arguments.access.access(arguments.listen.name);
    let access = access.map_err(failed)?;
    let tls = arguments.tls.read().map_err(failed)?;
    let objects = arguments.objects.as_deref().map(Objects::open);
    let objects = objects.transpose().map_err(failed)?;
    let (work, log) = (&arguments.work, arguments.log);
    allow_many_files();
    let config = Config {
        listen: arguments.listen.address,
        access,
        tls: tls.clone(),
        workers: work.workers(),
        limits: work.limits(),
        keep_days: work.keep_days,
        jobs_ahead: work.jobs_ahead,
        worker: work.config(program::own()),
        database: arguments.database,
        files: arguments.files,
        objects,
    };
    block_on(async {
        let signals = Signals::new().map_err(failed)?;
        let mut end = pin!(until_end(signals, tls.as_ref()));
        let service = tokio::select! {
            service = Service::start(config) => service.map_err(failed)?,
            () = &mut end => return Ok(()),
        };
        // A log that a program reads has the address in its first line.
        if log == LogFormat::Text {
            let address = service.address;
            let scheme = if tls.is_some() { "https" } else { "http" };
            write_err(format_args!("fretwear serves on {scheme}://{address}"));
        }
        let ended = tokio::select! {
            () = end => Ok(()),
            () = service.ended() => Err(failed("another process serves the database")),
        };
        service.stop().await;
        ended
    })?
}

/// Raises the limit on open files, and so on connections, as far as this process may.
fn allow_many_files() {
    if let Ok((_, most)) = getrlimit(Resource::RLIMIT_NOFILE) {
        // Otherwise the service has fewer connections.
        let _ = setrlimit(Resource::RLIMIT_NOFILE, most, most);
    }
}

/// Returns when a signal asks for the end. SIGHUP asks a service with a certificate to read it again, and others to end.
async fn until_end(mut signals: Signals, tls: Option<&Tls>) {
    while let (Asked::Hangup, Some(tls)) = (signals.next().await, tls) {
        match tls.read_again() {
            Ok(()) => tracing::info!("the certificate was read again"),
            Err(error) => {
                tracing::error!(%error, "the certificate could not be read again; the one before stays in use");
            }
        }
    }
}
