//! Integrity of stored results: comparison of a content with its entry in the manifest.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

use api::results::ResultFile;
use sha2::{Digest, Sha256};
use uuid::Uuid;

use crate::export::files::hexadecimal;
use crate::solve::checkpoint::EncodedCheckpoint;

const BLOCK: usize = 64 << 10;

/// Why a content cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum IntegrityError {
    /// The file does not exist.
    #[error("it does not exist")]
    Missing,
    /// Length differs.
    #[error("it has {found} bytes, its manifest names {named}")]
    Length {
        /// The length, bytes.
        found: u64,
        /// The length in the manifest, bytes.
        named: u64,
    },
    /// Content differs.
    #[error("it has the SHA-256 {found}, its manifest names {named}")]
    Checksum {
        /// SHA-256 of the content, hexadecimal.
        found: String,
        /// SHA-256 in the manifest.
        named: String,
    },
    /// The content cannot be read.
    #[error("it cannot be read: {0}")]
    Read(#[source] std::io::Error),
}

impl IntegrityError {
    /// Returns `true` if the content is damaged, and not only unreadable at present or for this process.
    pub fn is_damage(&self) -> bool {
        !matches!(self, Self::Read(_))
    }
}

impl From<std::io::Error> for IntegrityError {
    fn from(cause: std::io::Error) -> Self {
        match cause.kind() {
            ErrorKind::NotFound => Self::Missing,
            _ => Self::Read(cause),
        }
    }
}

/// Returns a stored checkpoint; `None`, with an error in the log, if its checksum differs.
pub(in crate::store) fn checkpoint(
    id: Uuid,
    cycle: u64,
    sha256: &[u8],
    state: Vec<u8>,
) -> Option<EncodedCheckpoint> {
    if Sha256::digest(&state).as_slice() == sha256 {
        return Some(EncodedCheckpoint { cycle, state });
    }
    tracing::error!(job = %id, cycle, "the checkpoint is damaged: its checksum differs; the job restarts at cycle 0");
    None
}

/// The bytes of a content so far, to be compared with its entry once they are complete.
#[derive(Debug, Clone, Default)]
pub struct Checksum {
    sha256: Sha256,
    bytes: u64,
}

impl Checksum {
    /// Adds the next bytes.
    pub fn update(&mut self, bytes: &[u8]) {
        self.sha256.update(bytes);
        self.bytes += u64::try_from(bytes.len()).unwrap_or(u64::MAX);
    }

    /// Returns the SHA-256 of all bytes, hexadecimal.
    pub fn sha256(self) -> String {
        hexadecimal(&self.sha256.finalize())
    }

    /// Compares all bytes with an entry.
    ///
    /// # Errors
    /// [`IntegrityError`] if they differ.
    pub fn compare(self, entry: &ResultFile) -> Result<(), IntegrityError> {
        compare_length(self.bytes, entry)?;
        let found = self.sha256();
        if found == entry.sha256 {
            return Ok(());
        }
        let named = entry.sha256.clone();
        Err(IntegrityError::Checksum { found, named })
    }
}

/// Checks that a file exists with the length of its entry.
///
/// # Errors
/// [`IntegrityError`] if not.
pub fn check_file_length(entry: &ResultFile, path: &Path) -> Result<(), IntegrityError> {
    compare_length(std::fs::metadata(path)?.len(), entry)
}

/// Checks bytes.
///
/// # Errors
/// [`IntegrityError`] if they differ from their entry.
pub fn check_bytes(entry: &ResultFile, bytes: &[u8]) -> Result<(), IntegrityError> {
    let mut checksum = Checksum::default();
    checksum.update(bytes);
    checksum.compare(entry)
}

/// Reads a file and checks it.
///
/// # Errors
/// [`IntegrityError`] if it differs from its entry.
pub fn check_file(entry: &ResultFile, path: &Path) -> Result<(), IntegrityError> {
    let mut checksum = Checksum::default();
    read(path, &mut checksum)?;
    checksum.compare(entry)
}

fn read(path: &Path, checksum: &mut Checksum) -> std::io::Result<()> {
    let mut file = File::open(path)?;
    let mut block = vec![0; BLOCK];
    loop {
        match file.read(&mut block)? {
            0 => return Ok(()),
            length => checksum.update(&block[..length]),
        }
    }
}

fn compare_length(found: u64, entry: &ResultFile) -> Result<(), IntegrityError> {
    let named = entry.bytes;
    if found == named {
        return Ok(());
    }
    Err(IntegrityError::Length { found, named })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::documents::VTU;
    use crate::export::files::manifest_entry;

    #[test]
    fn every_kind_of_damage_is_distinguished() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.vtu");
        let entry = manifest_entry("a.vtu", None, VTU, b"fields");
        let damage = |bytes: Option<&[u8]>| {
            match bytes {
                Some(bytes) => std::fs::write(&path, bytes).expect("written"),
                None => std::fs::remove_file(&path).expect("removed"),
            }
            check_file(&entry, &path)
        };
        assert!(damage(Some(b"fields")).is_ok());
        let checksum = damage(Some(b"FIELDS"));
        assert!(matches!(checksum, Err(IntegrityError::Checksum { .. })));
        assert!(check_file_length(&entry, &path).is_ok());
        let shorter = damage(Some(b"field"));
        assert!(matches!(
            shorter,
            Err(IntegrityError::Length { found: 5, named: 6 })
        ));
        assert!(check_file_length(&entry, &path).is_err());
        assert!(matches!(damage(None), Err(IntegrityError::Missing)));
        assert!(check_bytes(&entry, b"fields").is_ok());
        assert!(check_bytes(&entry, b"other").is_err());
    }
}
