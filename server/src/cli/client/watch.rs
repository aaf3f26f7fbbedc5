//! `fretwear watch ID`: follows a job to its end; the summary on standard output.

use std::process::ExitCode;

use api::event::Done;
use api::job::Status;
use uuid::Uuid;

use crate::cli::client::connection::{CANCELLED, ServerOptions, interruptible, report};
use crate::cli::terminal::{Ended, bar, failed, write_err, write_json};
use crate::client::{Client, ClientError, Followed};

pub(super) fn run(id: Uuid, server: &ServerOptions) -> Ended {
    let client = server.client()?;
    interruptible(watch(&client, id), Some(id))?
}

/// Follows a job, and writes its summary.
pub(super) async fn watch(client: &Client, id: Uuid) -> Ended {
    let followed = follow(client, id).await;
    ended(&followed.map_err(|error| report(&error))?)
}

/// Follows a job to its end with a progress bar.
pub(in crate::cli) async fn follow(client: &Client, id: Uuid) -> Result<Done, ClientError> {
    let bar = bar(0);
    let mut interrupted = false;
    let followed = client.follow(id, |news| match news {
        Followed::Progress(progress) => {
            interrupted = false;
            bar.set_length(progress.cycles);
            bar.set_position(progress.cycle);
            bar.set_message(progress.phase.map_or("waiting", |phase| phase.as_str()));
        }
        Followed::Interrupted(error) => {
            if !interrupted {
                bar.suspend(|| write_err(format_args!("fretwear: {error}; trying again")));
            }
            interrupted = true;
        }
    });
    let followed = followed.await;
    bar.finish_and_clear();
    followed
}

/// Writes the summary of a job that has one; the exit code of its status.
fn ended(done: &Done) -> Ended {
    if let Some(summary) = &done.summary {
        write_json(summary)?;
    }
    let reason = done.status_reason.as_deref().unwrap_or("no reason given");
    match done.status {
        Status::Succeeded => Ok(()),
        Status::Cancelled => {
            write_err(format_args!("fretwear: the job was cancelled: {reason}"));
            Err(ExitCode::from(CANCELLED))
        }
        status => Err(failed(format_args!(
            "the job {}: {reason}",
            status.as_str()
        ))),
    }
}
