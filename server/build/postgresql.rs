//! Where the programs of PostgreSQL are that tests start.

use std::path::{Path, PathBuf};

/// Tells the crate that is built the folder of the programs, if they are there.
pub(crate) fn find() {
    println!("cargo::rustc-check-cfg=cfg(has_postgresql)");
    println!("cargo::rerun-if-changed=/usr/lib/postgresql");
    let found = folder();
    if found.is_some() {
        println!("cargo::rustc-cfg=has_postgresql");
    }
    let folder = found.unwrap_or_default();
    println!("cargo::rustc-env=FRETWEAR_POSTGRESQL={}", folder.display());
}

/// The folder in which Debian has those of the newest version, or one of the search path.
fn folder() -> Option<PathBuf> {
    let versions = std::fs::read_dir("/usr/lib/postgresql");
    let versions = versions.into_iter().flatten().flatten();
    let mut folders: Vec<_> = versions.map(|entry| entry.path().join("bin")).collect();
    folders.sort();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let mut folders = folders
        .into_iter()
        .rev()
        .chain(std::env::split_paths(&path));
    folders.find(|folder| has_programs(folder))
}

fn has_programs(folder: &Path) -> bool {
    ["initdb", "postgres", "createdb", "pg_isready"]
        .iter()
        .all(|name| folder.join(name).is_file())
}
