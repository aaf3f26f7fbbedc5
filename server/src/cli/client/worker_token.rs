//! `fretwear worker-token create|list|revoke`: tokens of remote workers.

use std::fs::File;
use std::io::Write;
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};

use api::worker::WorkerTokens;
use clap::Subcommand;
use comfy_table::Table;

use crate::cli::client::connection::{ServerOptions, interruptible, report};
use crate::cli::terminal::{Ended, failed_at, printable, unusable_at, write_out};
use crate::client::WrittenId;
use crate::export::markdown;

/// Subcommands of `fretwear worker-token`.
#[derive(Debug, Subcommand)]
pub(in crate::cli) enum TokenAction {
    /// Make a token. It is shown once.
    Create {
        /// Purpose of the token, such as the name of a cluster.
        name: String,
        /// Write it into this file, which only its owner can read, instead of to standard output.
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        server: ServerOptions,
    },
    /// List the tokens.
    List {
        #[command(flatten)]
        server: ServerOptions,
    },
    /// Revoke a token: its workers are refused from now on.
    Revoke {
        /// Id of the token; the first or last characters are enough.
        id: WrittenId,
        #[command(flatten)]
        server: ServerOptions,
    },
}

pub(super) fn run(action: &TokenAction) -> Ended {
    match action {
        TokenAction::Create { name, out, server } => create(name, out.as_deref(), server),
        TokenAction::List { server } => {
            let client = server.client()?;
            let listed = interruptible(client.worker_tokens(), None)?;
            write_out(table(&listed.map_err(|error| report(&error))?))
        }
        TokenAction::Revoke { id, server } => {
            let client = server.client()?;
            let revoke = async {
                let id = client.worker_token_id(id).await?;
                client.revoke_worker_token(id).await.map(|()| id)
            };
            let revoked = interruptible(revoke, None)?;
            let id = revoked.map_err(|error| report(&error))?;
            write_out(format_args!("{id} revoked"))
        }
    }
}

fn create(name: &str, out: Option<&Path>, server: &ServerOptions) -> Ended {
    let client = server.client()?;
    // A token whose file cannot be written would be lost.
    let file = out.map(|path| secret_file(path).map_err(|cause| unusable_at(path, &cause)));
    let file = out.zip(file.transpose()?);
    let made = interruptible(client.create_worker_token(name), None);
    let made = made.and_then(|made| made.map_err(|error| report(&error)));
    let Some((path, mut file)) = file else {
        return write_out(&made?.token);
    };
    let written = made.and_then(|made| {
        writeln!(file, "{}", made.token).map_err(|cause| failed_at(path, &cause))?;
        write_out(format_args!("{} {}", made.entry.id, path.display()))
    });
    if written.is_err() {
        // An empty file is no token.
        let _ = std::fs::remove_file(path);
    }
    written
}

fn table(listed: &WorkerTokens) -> Table {
    let header = ["id", "name", "created", "revoked"];
    let mut table = markdown::table(header.map(str::to_owned), header.len());
    for token in &listed.tokens {
        table.add_row([
            token.id.to_string(),
            printable(&token.name).replace('\n', " "),
            token.created_at.clone(),
            token.revoked_at.clone().unwrap_or_default(),
        ]);
    }
    table
}

/// Creates a file that only its owner can read.
fn secret_file(path: &Path) -> std::io::Result<File> {
    let mut options = File::options();
    options.write(true).create_new(true).mode(0o600).open(path)
}
