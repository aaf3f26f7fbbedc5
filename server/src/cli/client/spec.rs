//! `fretwear spec ID`: the specification of a job as it was sent, on standard output.

use crate::cli::client::connection::{ServerOptions, interruptible, job_id, report};
use crate::cli::terminal::{Ended, write_err, write_out};
use crate::client::WrittenId;

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct SpecArguments {
    /// The job; the first or last characters of its id are enough.
    id: WrittenId,
    #[command(flatten)]
    server: ServerOptions,
}

pub(super) fn run(arguments: &SpecArguments) -> Ended {
    let client = arguments.server.client()?;
    let id = job_id(&client, &arguments.id)?;
    let sent = interruptible(client.sent_spec(id), None)?;
    let sent = sent.map_err(|error| report(&error))?;
    if !sent.is_as_sent {
        write_err(format_args!(
            "fretwear: warning: {id} was queued by a version that did not store what was sent: every value of this specification counts as given"
        ));
    }
    write_out(sent.json.trim_end())
}
