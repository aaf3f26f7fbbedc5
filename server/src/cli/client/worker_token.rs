//! `fretwear worker-token create|list|revoke`: tokens of remote workers.

use std::path::{Path, PathBuf};

use api::worker::WorkerTokens;
use clap::Subcommand;
use comfy_table::Table;
use uuid::Uuid;

use crate::cli::client::connection::{ServerOptions, interruptible, report};
use crate::cli::terminal::{Ended, failed, printable, write_out};
use crate::export::markdown;

/// What is done with tokens.
#[derive(Debug, Subcommand)]
pub(in crate::cli) enum TokenAction {
    /// Make a token. It is shown once.
    Create {
        /// What it is for, such as the name of a cluster.
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
        /// Its id.
        id: Uuid,
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
            let revoked = interruptible(client.revoke_worker_token(*id), None)?;
            revoked.map_err(|error| report(&error))?;
            write_out(format_args!("{id} revoked"))
        }
    }
}

fn create(name: &str, out: Option<&Path>, server: &ServerOptions) -> Ended {
    let client = server.client()?;
    let made = interruptible(client.create_worker_token(name), None)?;
    let made = made.map_err(|error| report(&error))?;
    match out {
        None => write_out(&made.token),
        Some(path) => {
            write_secret(path, &made.token).map_err(failed)?;
            write_out(format_args!("{} {}", made.entry.id, path.display()))
        }
    }
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

/// Writes a new file that only its owner can read.
fn write_secret(path: &Path, token: &str) -> std::io::Result<()> {
    use std::io::Write;
    use std::os::unix::fs::OpenOptionsExt;

    let mut file = std::fs::OpenOptions::new()
        .write(true)
        .create_new(true)
        .mode(0o600)
        .open(path)?;
    writeln!(file, "{token}")
}
