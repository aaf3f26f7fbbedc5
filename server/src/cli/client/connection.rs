//! The service that a command uses: its address and token, interruption by Ctrl-C, and exit codes.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use uuid::Uuid;

use crate::cli::access;
use crate::cli::runtime::block_on;
use crate::cli::signals::until_signal;
use crate::cli::terminal::{REFUSED, failed, write_err};
use crate::client::{Client, ClientError, WrittenId};

/// Default address of the service.
const SERVER: &str = "http://127.0.0.1:8080";
pub(super) const CANCELLED: u8 = 3;
const UNREACHABLE: u8 = 4;
/// As shells report the end by a signal 2.
const INTERRUPTED: u8 = 130;

/// The service, and the token for it.
#[derive(Debug, Args)]
pub(in crate::cli) struct ServerOptions {
    /// Address of the service.
    #[arg(long, env = "FRETWEAR_SERVER", default_value = SERVER)]
    server: String,
    /// File with the access token of the service. The variable FRETWEAR_TOKEN can contain the token itself.
    #[arg(long, env = "FRETWEAR_TOKEN_FILE")]
    token_file: Option<PathBuf>,
    /// File with the certificates of the authorities to trust (PEM), instead of those of the system.
    #[arg(long, env = "FRETWEAR_CA")]
    ca: Option<PathBuf>,
}

impl ServerOptions {
    pub(super) fn client(&self) -> Result<Client, ExitCode> {
        let token = access::token(self.token_file.as_deref()).map_err(failed)?;
        let token = token.as_deref().map(str::trim);
        Client::new(&self.server, token, self.ca.as_deref()).map_err(|error| report(&error))
    }
}

/// Runs requests until they end or Ctrl-C is pressed, which leaves the job `watched` as it is.
pub(super) fn interruptible<T>(
    requests: impl Future<Output = T>,
    watched: Option<Uuid>,
) -> Result<T, ExitCode> {
    block_on(async {
        tokio::select! {
            done = requests => Ok(done),
            signal = until_signal() => {
                signal.map_err(failed)?;
                if let Some(id) = watched {
                    write_err(format_args!("the job continues; `fretwear watch {id}` follows it again"));
                }
                Err(ExitCode::from(INTERRUPTED))
            }
        }
    })?
}

/// The id of a job that may be written in short.
pub(super) fn job_id(client: &Client, written: &WrittenId) -> Result<Uuid, ExitCode> {
    let found = interruptible(client.job_id(written), None)?;
    found.map_err(|error| report(&error))
}

/// Reports an error; returns its exit code.
pub(super) fn report(error: &ClientError) -> ExitCode {
    failed(error);
    exit_code(error)
}

/// The same of a request with a document, which is named if the service refuses it.
pub(super) fn report_of(source: &str, error: &ClientError) -> ExitCode {
    if error.is_refused() {
        failed(format_args!("{source}: {error}"));
    } else {
        failed(error);
    }
    exit_code(error)
}

fn exit_code(error: &ClientError) -> ExitCode {
    if error.is_refused() {
        ExitCode::from(REFUSED)
    } else if error.is_unreachable() {
        ExitCode::from(UNREACHABLE)
    } else {
        ExitCode::FAILURE
    }
}
