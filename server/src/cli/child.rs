//! `fretwear solve-child`: a solving process; its protocol is described in [`crate::solve::protocol`].

use std::io::{Read, Write};
use std::ops::ControlFlow;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use api::job::Outcome;
use clap::Parser;
use nix::sys::resource::{Resource, setrlimit};
use signal_hook::consts::SIGTERM;

use crate::cli::arguments::ChildArguments;
use crate::cli::terminal::{Ended, failed, refused, write_err};
use crate::export::documents::Document;
use crate::export::files::{self, FilesError};
use crate::solve;
use crate::solve::checkpoint::CheckpointPolicy;
use crate::solve::process::NAME;
use crate::solve::protocol::{
    COMMAND, EXIT_DISK_FULL, EXIT_FILE_NOT_WRITTEN, EXIT_ORPHANED, Input,
};
use crate::solve::{ChildMessage, Failure};
use crate::spec;

/// Pause before a full disk is tried again.
const DISK_PAUSE: Duration = Duration::from_millis(200);

/// The arguments of a solving process, if this is one. Its command is no subcommand, so that help, suggestions and completions never
/// name it.
pub(super) fn arguments() -> Option<ChildArguments> {
    let mut all = std::env::args_os().skip(1).peekable();
    let is_child = all.peek().is_some_and(|command| command == COMMAND);
    is_child.then(|| ChildArguments::parse_from(all))
}

pub(super) fn run(arguments: &ChildArguments) -> Ended {
    let stop = Arc::new(AtomicBool::new(false));
    prepare(arguments, &stop).map_err(failed)?;
    report(&ChildMessage::Ready)?;
    let input = Input::read(std::io::stdin().lock()).map_err(failed)?;
    let mut resolved = match spec::read(input.spec.as_bytes()) {
        Ok(resolved) => resolved,
        Err(error) => {
            report(&ChildMessage::Failed(Failure {
                outcome: Outcome::NotConverged,
                reason: error.to_string(),
            }))?;
            return Err(refused("standard input", &error));
        }
    };
    resolved.scene.threads = arguments.threads;
    std::thread::spawn(end_with_supervisor);
    let from = match input.checkpoint() {
        Ok(from) => from,
        Err(cause) => {
            report(&ChildMessage::Restarted(cause))?;
            None
        }
    };
    let every = Duration::from_millis(arguments.checkpoint_every_ms);
    let policy = CheckpointPolicy::new(every, Arc::clone(&stop));
    let solved = solve::run_from((&resolved).into(), from, &policy, &mut |line| match line {
        ChildMessage::Fields(fields) => store(arguments, &fields, &stop),
        line => write(&line),
    });
    report(&match solved {
        Ok(summary) if summary.outcome == Outcome::Stopped => ChildMessage::Stopped,
        Ok(summary) => ChildMessage::Summary(Box::new(summary)),
        Err(failure) => ChildMessage::Failed(failure),
    })
}

/// Writes a line outside of the run; without a supervisor that reads it, the process fails.
fn report(line: &ChildMessage) -> Ended {
    match write(line) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(ExitCode::FAILURE),
    }
}

/// Limits the memory that may be written to, turns a request to terminate into a flag, and names the process. Address space that is only
/// reserved, as allocators do, is not counted.
fn prepare(arguments: &ChildArguments, stop: &Arc<AtomicBool>) -> std::io::Result<()> {
    if let Some(limit) = arguments.memory_limit_mb {
        let bytes = limit.saturating_mul(1 << 20);
        setrlimit(Resource::RLIMIT_DATA, bytes, bytes)?;
    }
    signal_hook::flag::register(SIGTERM, Arc::clone(stop))?;
    // The program is started by a path that does not have its name; without it, lists of processes show another one.
    let _ = std::fs::write("/proc/self/comm", NAME);
    Ok(())
}

/// Blocks until standard input ends, then ends the process.
fn end_with_supervisor() {
    let mut rest = [0_u8; 64];
    let mut stdin = std::io::stdin().lock();
    while stdin.read(&mut rest).is_ok_and(|length| length > 0) {}
    std::process::exit(EXIT_ORPHANED);
}

/// Writes fields into the attempt's folder and reports the file. A failed write is not the job's fault: while a disk that is waited for
/// is full, the write is retried until the process is asked to stop; after any other error the process exits without an
/// outcome, and the job is attempted again.
fn store(arguments: &ChildArguments, fields: &Document, stop: &AtomicBool) -> ControlFlow<()> {
    let Document {
        name,
        cycle,
        media_type,
        bytes,
    } = fields;
    let mut logged = false;
    while let Err(error) = files::write_atomically(&arguments.folder, name, bytes) {
        if !logged {
            write_err(&error);
            logged = true;
        }
        match error {
            FilesError::Write { cause, .. } if files::is_full(&cause) => {
                if !arguments.waits_for_disk {
                    std::process::exit(EXIT_DISK_FULL);
                }
            }
            _ => std::process::exit(EXIT_FILE_NOT_WRITTEN),
        }
        if stop.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        std::thread::sleep(DISK_PAUSE);
    }
    write(&ChildMessage::File(files::manifest_entry(
        name, *cycle, media_type, bytes,
    )))
}

/// Writes a line; a supervisor that does not read any more stops the run.
fn write(line: &ChildMessage) -> ControlFlow<()> {
    let Ok(mut bytes) = serde_json::to_vec(line) else {
        return ControlFlow::Break(());
    };
    bytes.push(b'\n');
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(&bytes).and_then(|()| stdout.flush()) {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    }
}
