//! The folder of large results beside the database. Each attempt at a job writes into a folder of its own, so that a
//! worker that lost its lease cannot touch the files of the next one; a file counts once the manifest names it.

use std::collections::HashSet;
use std::fs::DirEntry;
use std::path::{Component, Path, PathBuf};

use uuid::Uuid;

/// The folder.
#[derive(Debug, Clone)]
pub(in crate::store) struct Folder {
    root: PathBuf,
}

impl Folder {
    /// The one that belongs to a database.
    pub(in crate::store) fn beside(database: &Path) -> Self {
        let mut name = database.as_os_str().to_owned();
        name.push(".results");
        Self { root: name.into() }
    }

    /// Where an attempt writes.
    pub(in crate::store) fn of_attempt(&self, id: Uuid, lease: i64) -> PathBuf {
        self.root.join(id.to_string()).join(lease.to_string())
    }

    /// A place as the manifest keeps it.
    pub(in crate::store) fn place(id: Uuid, lease: i64, name: &str) -> String {
        format!("{id}/{lease}/{name}")
    }

    /// The path of a place; nothing if it leads out of the folder, which the service has never written.
    pub(in crate::store) fn path(&self, place: &str) -> Option<PathBuf> {
        let plain = Path::new(place)
            .components()
            .all(|part| matches!(part, Component::Normal(_)));
        (plain && !place.is_empty()).then(|| self.root.join(place))
    }

    /// Removes everything of a job.
    pub(in crate::store) fn remove(&self, id: Uuid) -> std::io::Result<()> {
        match std::fs::remove_dir_all(self.root.join(id.to_string())) {
            Err(cause) if cause.kind() != std::io::ErrorKind::NotFound => Err(cause),
            _ => Ok(()),
        }
    }

    /// Removes all files that are at none of the named places, and the folders that this leaves empty: of the attempts at
    /// a job up to one of them, or of all jobs. Returns how many files went.
    pub(in crate::store) fn sweep(
        &self,
        attempt: Option<(Uuid, i64)>,
        named: &HashSet<String>,
    ) -> std::io::Result<usize> {
        let named: HashSet<PathBuf> = named.iter().filter_map(|place| self.path(place)).collect();
        let Some((id, last)) = attempt else {
            return swept(&self.root, &named);
        };
        // The job's own folder stays, also empty: the next attempt may be about to write into it.
        let mut gone = 0;
        for entry in entries(&self.root.join(id.to_string()))? {
            let number = entry
                .file_name()
                .to_str()
                .and_then(|name| name.parse().ok());
            if number.is_some_and(|number: i64| number <= last) {
                gone += swept(&entry.path(), &named)?;
            }
        }
        Ok(gone)
    }
}

fn swept(folder: &Path, named: &HashSet<PathBuf>) -> std::io::Result<usize> {
    let (mut gone, mut left) = (0, false);
    for entry in entries(folder)? {
        let path = entry.path();
        if entry.file_type()?.is_dir() {
            gone += swept(&path, named)?;
            left |= path.exists();
        } else if named.contains(&path) {
            left = true;
        } else {
            std::fs::remove_file(&path)?;
            gone += 1;
        }
    }
    if !left && folder.exists() {
        std::fs::remove_dir(folder)?;
    }
    Ok(gone)
}

/// What is in a folder; nothing if there is none.
fn entries(folder: &Path) -> std::io::Result<Vec<DirEntry>> {
    match std::fs::read_dir(folder) {
        Err(cause) if cause.kind() == std::io::ErrorKind::NotFound => Ok(Vec::new()),
        entries => entries?.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_that_lead_elsewhere_have_no_path() {
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
    fn a_sweep_leaves_what_is_named_and_no_empty_folders() {
        let place = tempfile::tempdir().expect("a folder");
        let folder = Folder::beside(&place.path().join("x.db"));
        let (kept, lost) = (Uuid::from_u128(1), Uuid::from_u128(2));
        for (id, lease) in [(kept, 1), (kept, 2), (lost, 1)] {
            let attempt = folder.of_attempt(id, lease);
            std::fs::create_dir_all(&attempt).expect("a folder");
            std::fs::write(attempt.join("a.vtu"), "x").expect("a file");
        }
        let named = HashSet::from([Folder::place(kept, 2, "a.vtu")]);
        assert_eq!(folder.sweep(Some((kept, 1)), &named).expect("swept"), 1);
        assert!(folder.of_attempt(lost, 1).exists());
        assert_eq!(folder.sweep(None, &named).expect("swept"), 1);
        assert!(folder.of_attempt(kept, 2).join("a.vtu").exists());
        assert!(!folder.of_attempt(kept, 1).exists() && !folder.of_attempt(lost, 1).exists());
    }
}
