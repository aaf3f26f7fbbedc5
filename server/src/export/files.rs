//! Results as files in a folder.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use api::results::ResultFile;
use sha2::{Digest, Sha256};

use crate::export::documents;
use crate::export::documents::{DocumentError, Results};
use crate::solve::FieldsFile;

/// Why a file was not written.
#[derive(Debug, thiserror::Error)]
pub enum FilesError {
    /// The system refused.
    #[error("{}: {cause}", .path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// A document could not be made.
    #[error(transparent)]
    Document(#[from] DocumentError),
}

/// Writes all results into a folder, which is made if it is missing.
///
/// # Errors
/// [`FilesError`] naming the file.
pub fn write(
    folder: &Path,
    results: &Results<'_>,
    fields: &[FieldsFile],
) -> Result<(), FilesError> {
    std::fs::create_dir_all(folder).map_err(|cause| FilesError::Write {
        path: folder.to_owned(),
        cause,
    })?;
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).map_err(|cause| FilesError::Write { path, cause })
    };
    for document in documents::all(results)? {
        file(&document.name, &document.bytes)?;
    }
    for fields in fields {
        file(&fields.name, &fields.bytes)?;
    }
    Ok(())
}

/// Writes a file so that its name stands for the whole content or for nothing, also after a crash: under another name
/// first, to the disk, then renamed. What was begun and cannot be finished is removed.
///
/// # Errors
/// [`FilesError`] naming the file.
pub fn keep(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), FilesError> {
    let path = folder.join(name);
    let unfinished = folder.join(format!("{name}.unfinished"));
    let written = || -> std::io::Result<()> {
        make_folder(folder)?;
        let mut file = File::create(&unfinished)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        std::fs::rename(&unfinished, &path)?;
        // The rename is on the disk once the folder is.
        File::open(folder)?.sync_all()
    };
    written().map_err(|cause| {
        // It would keep space that is missing elsewhere; if it stays, it is swept with what no manifest names.
        let _ = std::fs::remove_file(&unfinished);
        FilesError::Write { path, cause }
    })
}

/// Makes a folder and those above it that are missing, each on the disk before anything is put into it.
///
/// # Errors
/// If the system refuses.
pub fn make_folder(folder: &Path) -> std::io::Result<()> {
    if folder.is_dir() {
        return Ok(());
    }
    let above = parent(folder);
    make_folder(above)?;
    match std::fs::create_dir(folder) {
        Err(cause) if cause.kind() != ErrorKind::AlreadyExists => Err(cause),
        _ => File::open(above)?.sync_all(),
    }
}

/// The folder of a file.
pub fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Whether something was not written for want of space, which may pass.
pub fn is_full(cause: &std::io::Error) -> bool {
    matches!(
        cause.kind(),
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded
    )
}

/// What a manifest says about a file.
pub fn described(name: &str, cycle: Option<u64>, media_type: &str, bytes: &[u8]) -> ResultFile {
    ResultFile {
        name: name.to_owned(),
        cycle,
        media_type: media_type.to_owned(),
        bytes: u64::try_from(bytes.len()).unwrap_or(u64::MAX),
        sha256: sha256(bytes),
    }
}

/// The checksum of a file, as a manifest writes it.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .fold(String::with_capacity(64), |mut text, byte| {
            // Writing to a text does not fail.
            let _ = write!(text, "{byte:02x}");
            text
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kept_file_replaces_an_older_one_and_leaves_nothing_unfinished() {
        let folder = tempfile::tempdir().expect("a folder");
        let deep = folder.path().join("a/b");
        keep(&deep, "x.vtu", b"first").expect("kept");
        keep(&deep, "x.vtu", b"second").expect("kept");
        assert_eq!(
            std::fs::read(deep.join("x.vtu")).expect("a file"),
            b"second"
        );
        assert_eq!(std::fs::read_dir(&deep).expect("a folder").count(), 1);
    }

    #[test]
    fn digests_are_those_of_the_standard() {
        // FIPS 180-2, appendix B.1.
        let described = described("x", None, "text/plain", b"abc");
        assert_eq!(
            described.sha256,
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
        assert_eq!(described.bytes, 3);
    }
}
