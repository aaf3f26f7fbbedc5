//! Options of `serve` about who may ask.

use std::path::PathBuf;

use crate::http::{Access, TokenError};

/// Why the access that was asked for cannot be given.
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
    /// The token cannot be used.
    #[error(transparent)]
    Token(#[from] TokenError),
}

/// Who may ask. A token is not an option of its own: other users of the machine can read the options of a process.
#[derive(Debug, clap::Args)]
pub(super) struct AccessOptions {
    /// A file that holds the access token, which every request must then show; needed to listen elsewhere than on
    /// loopback. The variable FRETWEAR_TOKEN can hold the token itself.
    #[arg(long, env = "FRETWEAR_TOKEN_FILE")]
    token_file: Option<PathBuf>,
    /// Name that the service answers to besides its addresses; may be given several times.
    #[arg(
        long = "allowed-host",
        env = "FRETWEAR_ALLOWED_HOSTS",
        value_delimiter = ','
    )]
    allowed_hosts: Vec<String>,
}

impl AccessOptions {
    /// The access; only a digest of the token stays in memory.
    pub(super) fn access(&self) -> Result<Access, AccessError> {
        let token = match &self.token_file {
            Some(path) => {
                Some(
                    std::fs::read_to_string(path).map_err(|cause| AccessError::File {
                        path: path.clone(),
                        cause,
                    })?,
                )
            }
            None => std::env::var("FRETWEAR_TOKEN").ok(),
        };
        Ok(Access::new(
            token.as_deref().map(str::trim),
            &self.allowed_hosts,
        )?)
    }
}
