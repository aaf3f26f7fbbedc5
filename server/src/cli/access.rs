//! Options of `serve` for access control, and warnings of secrets and data that other users of the machine can reach.

use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use nix::sys::stat::{Mode, umask};

use crate::http::{Access, Tls, TlsError, TokenError};

/// Rights on a file of a secret that others than its owner and group must not have, and its group neither.
const EXPOSING: u32 = 0o027;

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
        if let Some(key) = &self.tls_key {
            warn_of_readers(key);
        }
        files
            .map(|(certificate, key)| Tls::read(certificate, key))
            .transpose()
    }
}

/// Returns the access token in a file, or in the environment.
pub(super) fn token(file: Option<&Path>) -> Result<Option<String>, AccessError> {
    match file {
        Some(path) => token_in(path).map(Some),
        None => Ok(std::env::var("FRETWEAR_TOKEN").ok()),
    }
}

/// Returns the token in a file.
pub(super) fn token_in(path: &Path) -> Result<String, AccessError> {
    let token = std::fs::read_to_string(path).map_err(|cause| AccessError::File {
        path: path.to_owned(),
        cause,
    })?;
    warn_of_readers(path);
    Ok(token)
}

/// Warns if others than the owner of a file with a secret can read or change it.
fn warn_of_readers(path: &Path) {
    // A file that is not there is an error of whoever reads it.
    let mode = std::fs::metadata(path).map_or(0, |file| file.permissions().mode() & 0o777);
    if is_exposing(mode) {
        let (path, mode) = (path.display(), format!("{mode:04o}"));
        tracing::warn!(%path, mode, "other users of this machine can read or change the file of a secret; `chmod 600` keeps them out");
    }
}

fn is_exposing(mode: u32) -> bool {
    mode & EXPOSING != 0
}

/// Warns if other users could change the files that this process creates. It is called before there are other threads that create some.
pub(super) fn warn_of_umask() {
    let mask = umask(Mode::all());
    umask(mask);
    if lets_others_write(mask) {
        let umask = format!("{:04o}", mask.bits());
        tracing::warn!(
            umask,
            "other users of this machine can change the database and its results; a umask of 0027 keeps them out"
        );
    }
}

fn lets_others_write(mask: Mode) -> bool {
    !mask.contains(Mode::S_IWOTH)
}

impl AccessOptions {
    /// Returns the access rules of a service that listens on an address of this name; only a digest of the token stays in memory.
    pub(super) fn access(&self, name: Option<String>) -> Result<Access, AccessError> {
        let token = token(self.token_file.as_deref())?;
        let hosts: Vec<_> = self.allowed_hosts.iter().cloned().chain(name).collect();
        Ok(Access::new(token.as_deref().map(str::trim), &hosts)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_secret_is_for_its_owner_and_for_readers_of_its_group() {
        for mode in [0o400, 0o600, 0o440, 0o640] {
            assert!(!is_exposing(mode), "{mode:o}");
        }
        for mode in [0o644, 0o604, 0o602, 0o620, 0o660, 0o666, 0o777] {
            assert!(is_exposing(mode), "{mode:o}");
        }
    }

    #[test]
    fn a_umask_keeps_other_users_from_writing() {
        let lets = |mask| lets_others_write(Mode::from_bits_truncate(mask));
        assert!(lets(0) && lets(0o020) && lets(0o055));
        assert!(!lets(0o002) && !lets(0o022) && !lets(0o077));
    }
}
