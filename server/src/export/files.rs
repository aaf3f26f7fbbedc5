//! Results as files in a folder, and files that are written atomically.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use api::results::ResultFile;
use nix::sys::statvfs::statvfs;
use sha2::{Digest, Sha256};
use uuid::Uuid;

use crate::export::documents::{self, Document, DocumentError, Results};
use crate::export::earlier;

/// Why a file was not written.
#[derive(Debug, thiserror::Error)]
pub enum FilesError {
    /// The operating system reported an error.
    #[error("{}: {cause}", .path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The error.
        cause: std::io::Error,
    },
    /// A document could not be rendered.
    #[error(transparent)]
    Document(#[from] DocumentError),
}

/// Writes all results into a folder, which is created if it is missing, and removes those of an earlier run that this one does not
/// replace.
///
/// # Errors
/// [`FilesError`] naming the file.
pub fn write(folder: &Path, results: &Results<'_>, fields: &[Document]) -> Result<(), FilesError> {
    std::fs::create_dir_all(folder).map_err(|cause| FilesError::Write {
        path: folder.to_owned(),
        cause,
    })?;
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).map_err(|cause| FilesError::Write { path, cause })
    };
    let documents = documents::all(results)?;
    let mut present = Vec::new();
    for Document { name, bytes, .. } in documents.iter().chain(fields) {
        file(name, bytes)?;
        present.push(name.as_str());
    }
    earlier::remove(folder, &present).map_err(|cause| FilesError::Write {
        path: folder.to_owned(),
        cause,
    })
}

/// Writes a file atomically, also with respect to a crash: to a temporary name, synced, then renamed. The temporary
/// file is removed if this fails.
///
/// # Errors
/// [`FilesError`] naming the file.
pub fn write_atomically(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), FilesError> {
    let path = folder.join(name);
    // Two ends of one job may write it at the same time.
    let unfinished = folder.join(format!("{name}.{}.unfinished", Uuid::now_v7()));
    let written = || -> std::io::Result<()> {
        create_folder(folder)?;
        let mut file = File::create(&unfinished)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        std::fs::rename(&unfinished, &path)?;
        // The rename is durable once the folder is synced.
        File::open(folder)?.sync_all()
    };
    written().map_err(|cause| {
        // The partial file would occupy disk space. If removal fails, retention deletes it with all files that no manifest lists.
        let _ = std::fs::remove_file(&unfinished);
        FilesError::Write { path, cause }
    })
}

/// Creates a folder and its missing parents, each synced before it is used.
///
/// # Errors
/// The error of the operating system.
pub fn create_folder(folder: &Path) -> std::io::Result<()> {
    if folder.is_dir() {
        return Ok(());
    }
    let above = parent(folder);
    create_folder(above)?;
    match std::fs::create_dir(folder) {
        Err(cause) if cause.kind() != ErrorKind::AlreadyExists => Err(cause),
        _ => File::open(above)?.sync_all(),
    }
}

/// Longest name of a file, bytes: file systems of Linux have 255, and a file has a longer name while it is written.
const LONGEST_NAME: usize = 200;

/// Checks whether a text is the name of a file on any system, and not a path out of its folder.
pub fn is_plain_name(name: &str) -> bool {
    let is_separator = |c: char| c.is_control() || "/\\:".contains(c);
    let is_folder = ["", ".", ".."].contains(&name);
    !is_folder && name.len() <= LONGEST_NAME && !name.contains(is_separator)
}

/// The folder that contains a file.
pub fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Checks whether the disk or a quota was full, which may be temporary.
pub fn is_full(cause: &std::io::Error) -> bool {
    matches!(
        cause.kind(),
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded
    )
}

/// Free space on the disk of a folder, MB; `None` if the system does not report it.
pub fn free_mb(folder: &Path) -> Option<u64> {
    let disk = statvfs(folder).ok()?;
    Some(disk.blocks_available().saturating_mul(disk.fragment_size()) >> 20)
}

/// The manifest entry of a file.
pub fn manifest_entry(
    name: &str,
    cycle: Option<u64>,
    media_type: &str,
    bytes: &[u8],
) -> ResultFile {
    ResultFile {
        name: name.to_owned(),
        cycle,
        media_type: media_type.to_owned(),
        bytes: u64::try_from(bytes.len()).unwrap_or(u64::MAX),
        sha256: sha256(bytes),
        damaged: None,
    }
}

/// SHA-256 of a file, hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

/// Bytes in hexadecimal digits.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes
        .iter()
        .fold(String::with_capacity(64), |mut text, byte| {
            // Writing to a string cannot fail.
            let _ = write!(text, "{byte:02x}");
            text
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_atomic_write_replaces_the_file_and_leaves_no_temporary_one() {
        let folder = tempfile::tempdir().expect("a folder");
        let deep = folder.path().join("a/b");
        write_atomically(&deep, "x.vtu", b"first").expect("written");
        write_atomically(&deep, "x.vtu", b"second").expect("written");
        assert_eq!(
            std::fs::read(deep.join("x.vtu")).expect("a file"),
            b"second"
        );
        assert_eq!(std::fs::read_dir(&deep).expect("a folder").count(), 1);
    }

    #[test]
    fn digests_equal_the_example_of_the_standard() {
        // FIPS 180-2, appendix B.1.
        let entry = manifest_entry("x", None, "text/plain", b"abc");
        assert_eq!(
            entry.sha256,
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
        assert_eq!(entry.bytes, 3);
    }
}
