//! The folder of large results beside the database. Each lease has a folder of its own, so that a worker that lost its
//! lease cannot touch the files of the next attempt; a file counts once the manifest names it.

use std::collections::HashSet;
use std::path::{Component, Path, PathBuf};
use std::time::Duration;

use fs_err::DirEntry;
use tempfile::TempPath;
use uuid::Uuid;

/// Returns the path of a file or folder beside a database, by its suffix.
pub(in crate::store) fn beside(database: &Path, suffix: &str) -> PathBuf {
    let mut name = database.as_os_str().to_owned();
    name.push(suffix);
    PathBuf::from(name)
}

/// Prefix of the names of files that are being received.
const RECEIVED: &str = "received-";
/// Longest time for receiving a file.
const LONGEST_RECEIPT: Duration = Duration::from_hours(1);

/// The folder of large results.
#[derive(Debug, Clone)]
pub(in crate::store) struct Folder {
    root: PathBuf,
}

impl Folder {
    /// The folder of a database.
    pub(in crate::store) fn beside(database: &Path) -> Self {
        Self {
            root: beside(database, ".results"),
        }
    }

    /// Returns the folder of an attempt.
    pub(in crate::store) fn of_attempt(&self, id: Uuid, lease: i64) -> PathBuf {
        self.root.join(id.to_string()).join(lease.to_string())
    }

    /// Returns the path of a file relative to this folder, as the database stores it.
    pub(in crate::store) fn place(id: Uuid, lease: i64, name: &str) -> String {
        format!("{id}/{lease}/{name}")
    }

    /// Returns the absolute path of a stored one; `None` if it leads out of the folder, which the service never writes.
    pub(in crate::store) fn path(&self, place: &str) -> Option<PathBuf> {
        let is_inside = Path::new(place)
            .components()
            .all(|part| matches!(part, Component::Normal(_)));
        (is_inside && !place.is_empty()).then(|| self.root.join(place))
    }

    /// The jobs that have files.
    pub(in crate::store) fn jobs(&self) -> std::io::Result<Vec<Uuid>> {
        let names = entries(&self.root)?.into_iter();
        let names = names.map(|entry| entry.file_name());
        Ok(names
            .filter_map(|name| name.to_str()?.parse().ok())
            .collect())
    }

    /// Creates a file to receive into; it is removed when it is dropped.
    pub(in crate::store) fn received(&self) -> std::io::Result<TempPath> {
        fs_err::create_dir_all(&self.root)?;
        let file = tempfile::Builder::new()
            .prefix(RECEIVED)
            .tempfile_in(&self.root)?;
        Ok(file.into_temp_path())
    }

    /// Removes partly received files of killed processes; returns their number. Other processes may be receiving files here, too.
    pub(in crate::store) fn remove_received(&self) -> std::io::Result<usize> {
        let mut removed = 0;
        for entry in entries(&self.root)? {
            if !entry.file_name().to_string_lossy().starts_with(RECEIVED) {
                continue;
            }
            // Another process may remove it, too.
            let Ok(written) = entry.metadata().and_then(|file| file.modified()) else {
                continue;
            };
            let is_old = written.elapsed().is_ok_and(|age| age > LONGEST_RECEIPT);
            if is_old && fs_err::remove_file(entry.path()).is_ok() {
                removed += 1;
            }
        }
        Ok(removed)
    }

    /// Returns `true` if the folder exists. It does not before the first job has files, nor while its disk is not mounted.
    pub(in crate::store) fn exists(&self) -> bool {
        self.root.is_dir()
    }

    /// Returns `true` if a job may have files.
    pub(in crate::store) fn has(&self, id: Uuid) -> bool {
        self.root.join(id.to_string()).exists()
    }

    /// Removes all files of a job.
    pub(in crate::store) fn remove(&self, id: Uuid) -> std::io::Result<()> {
        match fs_err::remove_dir_all(self.root.join(id.to_string())) {
            Err(cause) if cause.kind() != std::io::ErrorKind::NotFound => Err(cause),
            _ => Ok(()),
        }
    }

    /// Removes all files that are not named, and folders without files: of the attempts at a job up to one of them, or
    /// of all jobs without the folders that are held. Returns the number of removed files.
    pub(in crate::store) fn remove_unnamed(
        &self,
        attempt: Option<(Uuid, i64)>,
        named: &HashSet<String>,
        held: &HashSet<PathBuf>,
    ) -> std::io::Result<usize> {
        let named: HashSet<PathBuf> = named.iter().filter_map(|place| self.path(place)).collect();
        let Some((id, last)) = attempt else {
            return remove_unnamed(&self.root, &named, held);
        };
        // The job's own folder is not removed, even if empty: the next attempt may be about to write into it.
        let mut removed = 0;
        for entry in entries(&self.root.join(id.to_string()))? {
            let name = entry.file_name();
            let lease = name.to_str().and_then(|name| name.parse::<i64>().ok());
            if lease.is_some_and(|lease| lease <= last) {
                removed += remove_unnamed(&entry.path(), &named, held)?;
            }
        }
        Ok(removed)
    }
}

fn remove_unnamed(
    folder: &Path,
    named: &HashSet<PathBuf>,
    held: &HashSet<PathBuf>,
) -> std::io::Result<usize> {
    let (mut removed, mut is_empty) = (0, true);
    for entry in entries(folder)? {
        let path = entry.path();
        if held.contains(&path) {
            is_empty = false;
        } else if entry.file_type()?.is_dir() {
            removed += remove_unnamed(&path, named, held)?;
            is_empty &= !path.exists();
        } else if named.contains(&path) {
            is_empty = false;
        } else {
            fs_err::remove_file(&path)?;
            removed += 1;
        }
    }
    if is_empty && folder.exists() {
        fs_err::remove_dir(folder)?;
    }
    Ok(removed)
}

/// Returns the entries of a folder; none if it does not exist.
fn entries(folder: &Path) -> std::io::Result<Vec<DirEntry>> {
    match fs_err::read_dir(folder) {
        Err(cause) if cause.kind() == std::io::ErrorKind::NotFound => Ok(Vec::new()),
        entries => entries?.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stored_paths_that_lead_out_of_the_folder_are_rejected() {
        let folder = Folder::beside(Path::new("/tmp/x.db"));
        for place in ["../x", "/etc/passwd", "a/../../b", "", "./a"] {
            assert_eq!(folder.path(place), None, "{place}");
        }
        let inside = folder.path("a/1/fields-3.vtu");
        assert_eq!(
            inside,
            Some(PathBuf::from("/tmp/x.db.results/a/1/fields-3.vtu"))
        );
    }

    #[test]
    fn named_files_stay_and_empty_folders_are_removed() {
        let place = tempfile::tempdir().expect("a folder");
        let folder = Folder::beside(&place.path().join("x.db"));
        let (named_job, other_job) = (Uuid::from_u128(1), Uuid::from_u128(2));
        for (id, lease) in [(named_job, 1), (named_job, 2), (other_job, 1)] {
            let attempt = folder.of_attempt(id, lease);
            std::fs::create_dir_all(&attempt).expect("a folder");
            std::fs::write(attempt.join("a.vtu"), "x").expect("a file");
        }
        let named = HashSet::from([Folder::place(named_job, 2, "a.vtu")]);
        assert_eq!(
            folder
                .remove_unnamed(Some((named_job, 1)), &named, &HashSet::new())
                .expect("removed"),
            1
        );
        assert!(folder.of_attempt(other_job, 1).exists());
        let held = HashSet::from([folder.of_attempt(other_job, 1)]);
        let removed = folder.remove_unnamed(None, &named, &held);
        assert_eq!(removed.expect("removed"), 0, "one is held");
        let removed = folder.remove_unnamed(None, &named, &HashSet::new());
        assert_eq!(removed.expect("removed"), 1);
        assert!(folder.of_attempt(named_job, 2).join("a.vtu").exists());
        assert!(
            !folder.of_attempt(named_job, 1).exists() && !folder.of_attempt(other_job, 1).exists()
        );
    }
}
