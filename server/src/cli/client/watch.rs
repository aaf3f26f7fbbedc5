//! `fretwear watch ID`: follows a job to its end; its tables or the summary on standard output.

use std::process::ExitCode;

use api::event::Done;
use api::job::Status;
use uuid::Uuid;

use crate::cli::client::connection::{CANCELLED, ServerOptions, interruptible, job_id, report};
use crate::cli::summary;
use crate::cli::summary::Format;
use crate::cli::terminal::{Ended, bar, failed, write_err};
use crate::client::{Client, ClientError, Followed, WrittenId};

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct WatchArguments {
    /// The job; the first or last characters of its id are enough.
    id: WrittenId,
    /// Write the summary as JSON instead of tables.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    server: ServerOptions,
}

pub(super) fn run(arguments: &WatchArguments) -> Ended {
    let client = arguments.server.client()?;
    let id = job_id(&client, &arguments.id)?;
    let format = Format::json_if(arguments.json);
    interruptible(watch(&client, id, format), Some(id))?
}

/// Follows a job, and writes its summary.
pub(super) async fn watch(client: &Client, id: Uuid, format: Format) -> Ended {
    let followed = follow(client, id).await;
    let done = followed.map_err(|error| report(&error))?;
    if let Some(summary) = &done.summary {
        let job = client.job(id).await.map_err(|error| report(&error))?;
        summary::write(&job.spec, summary, format)?;
    }
    ended(&done)
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

/// Reports how a job has ended, unless it has succeeded; the exit code of its status.
fn ended(done: &Done) -> Ended {
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
