//! Files that an earlier run left in the folder of the results: beside those of a new run they would be taken for its own.

use std::path::Path;

/// Documents with a part of this name for each snapshot, and their extension.
const OF_SNAPSHOTS: [(&str, &str); 6] = [
    ("maps", "json"),
    ("stations", "json"),
    ("profile", "csv"),
    ("pressure", "csv"),
    ("loop", "csv"),
    ("fields", "vtu"),
];

/// Pictures of which a run may draw none.
const PICTURES: [&str; 6] = [
    "wear-history",
    "profiles",
    "pressure",
    "loops",
    "sections",
    "life",
];

/// Removes the results in a folder that are not among those of the present run. Other files stay.
///
/// # Errors
/// The error of the operating system.
pub(super) fn remove(folder: &Path, present: &[&str]) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let name = entry?.file_name();
        let is_earlier = |name: &&str| is_result(name) && !present.contains(name);
        if let Some(name) = name.to_str().filter(is_earlier) {
            std::fs::remove_file(folder.join(name))?;
        }
    }
    Ok(())
}

/// Returns `true` if a run writes a file of this name, but not every run.
fn is_result(name: &str) -> bool {
    if name == "summary.json" {
        return true;
    }
    let Some((stem, extension)) = name.rsplit_once('.') else {
        return false;
    };
    if PICTURES.contains(&stem) {
        return matches!(extension, "svg" | "png");
    }
    stem.rsplit_once('-').is_some_and(|(part, cycle)| {
        OF_SNAPSHOTS.contains(&(part, extension)) && cycle.parse::<u64>().is_ok()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_results_of_an_earlier_run_are_removed() {
        let folder = tempfile::tempdir().expect("a folder");
        let results = ["summary.json", "life.svg", "loop-7.csv", "fields-20.vtu"];
        let others = [
            "notes.txt",
            "profile-old.csv",
            "loop-7.txt",
            "life.pdf",
            "fields-20.csv",
        ];
        for name in results.into_iter().chain(others) {
            std::fs::write(folder.path().join(name), b"").expect("written");
        }
        remove(folder.path(), &["loop-7.csv"]).expect("removed");
        let mut left: Vec<String> = std::fs::read_dir(folder.path())
            .expect("a folder")
            .map(|entry| entry.expect("a file").file_name().into_string())
            .collect::<Result<_, _>>()
            .expect("text");
        left.sort();
        let mut expected = [others.as_slice(), &["loop-7.csv"]].concat();
        expected.sort_unstable();
        assert_eq!(left, expected);
    }
}
