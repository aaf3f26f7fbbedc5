//! Options of `serve` for access control.

use std::path::{Path, PathBuf};

use crate::http::{Access, Tls, TlsError, TokenError};

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

/// Certificate and key of the service.
#[derive(Debug, clap::Args)]
pub(super) struct TlsOptions {
    /// File with the certificate of the service, followed by those up to its authority (PEM); HTTPS instead of HTTP.
    #[arg(long, env = "FRETWEAR_TLS_CERTIFICATE", requires = "tls_key")]
    tls_certificate: Option<PathBuf>,
    /// File with its private key (PEM).
    #[arg(long, env = "FRETWEAR_TLS_KEY", requires = "tls_certificate")]
    tls_key: Option<PathBuf>,
}

impl TlsOptions {
    /// Reads certificate and key, if they are given.
    pub(super) fn read(&self) -> Result<Option<Tls>, TlsError> {
        let files = self.tls_certificate.as_deref().zip(self.tls_key.as_deref());
        files
            .map(|(certificate, key)| Tls::read(certificate, key))
            .transpose()
    }
}

/// Returns the access token in a file, or in the environment.
pub(super) fn token(file: Option<&Path>) -> Result<Option<String>, AccessError> {
    let Some(path) = file else {
        return Ok(std::env::var("FRETWEAR_TOKEN").ok());
    };
    let error = |cause| AccessError::File {
        path: path.to_owned(),
        cause,
    };
    std::fs::read_to_string(path).map(Some).map_err(error)
}

impl AccessOptions {
    /// Returns the access rules of a service that listens on an address of this name; only a digest of the token stays in memory.
    pub(super) fn access(&self, name: Option<String>) -> Result<Access, AccessError> {
        let token = token(self.token_file.as_deref())?;
        let hosts: Vec<_> = self.allowed_hosts.iter().cloned().chain(name).collect();
        Ok(Access::new(token.as_deref().map(str::trim), &hosts)?)
    }
}
