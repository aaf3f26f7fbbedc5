//! `fretwear fetch ID --out DIR`: the files of a job.

use std::path::{Path, PathBuf};

use uuid::Uuid;

use crate::cli::client::connection::{ServerOptions, interruptible, job_id, report};
use crate::cli::destination;
use crate::cli::terminal::{Ended, write_err};
use crate::client::{Client, Fetched, WrittenId};

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct FetchArguments {
    /// The job; the first or last characters of its id are enough.
    id: WrittenId,
    /// Names of the files; all of them unless given.
    names: Vec<String>,
    /// The folder, which is created.
    #[arg(long)]
    out: PathBuf,
    #[command(flatten)]
    server: ServerOptions,
}

pub(super) fn run(arguments: &FetchArguments) -> Ended {
    destination::folder(&arguments.out)?;
    let client = arguments.server.client()?;
    let id = job_id(&client, &arguments.id)?;
    fetch(&client, id, &arguments.names, &arguments.out)
}

/// Writes files of a job into a folder; all of them if none is named.
pub(super) fn fetch(client: &Client, id: Uuid, names: &[String], folder: &Path) -> Ended {
    let (mut received, mut present, mut bytes) = (0, 0, 0);
    let fetched = client.fetch(id, names, folder, |file, fetched| match fetched {
        Fetched::Received => {
            received += 1;
            bytes += file.bytes;
        }
        Fetched::Present => present += 1,
    });
    let fetched = interruptible(fetched, None)?;
    fetched.map_err(|error| report(&error))?;
    write_err(format_args!(
        "{}: received files: {received} ({} kB), unchanged: {present}",
        folder.display(),
        bytes.div_ceil(1_000)
    ));
    Ok(())
}
