//! Options of `serve` for access control.

use std::path::PathBuf;

use crate::http::{Access, TokenError};

/// Why the access options are invalid.
#[derive(Debug, thiserror::Error)]
pub(super) enum AccessError {
    /// The file with the token cannot be read.
    #[error("{}: {cause}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// The token is invalid.
    #[error(transparent)]
    Token(#[from] TokenError),
}

/// Access options. The token itself is not an option: other users of the machine can read the options of a process.
#[derive(Debug, clap::Args)]
pub(super) struct AccessOptions {
    /// File with the access token, which every request must then carry; required to listen on other addresses than
    /// loopback. The variable FRETWEAR_TOKEN can contain the token itself.
    #[arg(long, env = "FRETWEAR_TOKEN_FILE")]
    token_file: Option<PathBuf>,
    /// Host name that requests may name besides the service's addresses; may be given several times.
    #[arg(
        long = "allowed-host",
        env = "FRETWEAR_ALLOWED_HOSTS",
        value_delimiter = ','
    )]
    allowed_hosts: Vec<String>,
}

impl AccessOptions {
    /// Returns the access rules; only a digest of the token stays in memory.
    pub(super) fn access(&self) -> Result<Access, AccessError> {
        let token = match &self.token_file {
            Some(path) => {
                let error = |cause| AccessError::File {
                    path: path.clone(),
                    cause,
                };
                Some(std::fs::read_to_string(path).map_err(error)?)
            }
            None => std::env::var("FRETWEAR_TOKEN").ok(),
        };
        Ok(Access::new(
            token.as_deref().map(str::trim),
            &self.allowed_hosts,
        )?)
    }
}
