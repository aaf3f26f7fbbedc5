//! Migrations of schemas, embedded.

use sqlx::SqlSafeStr;
use sqlx::migrate::{Migration, MigrationType, Migrator};

/// A file of a folder in `migrations/`: its name and its SQL.
macro_rules! file {
    ($name:literal) => {
        (
            $name,
            include_str!(concat!("../../../../migrations/", $name)),
        )
    };
}
pub(in crate::store) use file;

/// Applies the migrations that a database does not have; refuses a database with others.
pub(in crate::store) fn migrator_of(files: &[(&str, &'static str)]) -> Migrator {
    let migration = |(path, sql): &(&str, &'static str)| {
        let (_, name) = path.split_once('/')?;
        let (version, topic) = name.trim_end_matches(".sql").split_once('_')?;
        let (version, topic) = (version.parse().ok()?, topic.replace('_', " "));
        Some(Migration::new(
            version,
            topic.into(),
            MigrationType::Simple,
            (*sql).into_sql_str(),
            false,
        ))
    };
    Migrator::with_migrations(files.iter().filter_map(migration).collect())
}

/// Version of the newest file.
pub(in crate::store) fn newest_version(files: &[(&str, &'static str)]) -> i64 {
    let migrator = migrator_of(files);
    let versions = migrator.iter().map(|migration| migration.version);
    versions.max().unwrap_or_default()
}

#[cfg(test)]
pub(in crate::store) mod tests {
    use super::*;

    /// Checks that the files of a folder are all embedded.
    pub(in crate::store) fn assert_whole(folder: &str, files: &[(&str, &'static str)]) {
        let path = format!("{}/../migrations/{folder}", env!("CARGO_MANIFEST_DIR"));
        let entries = std::fs::read_dir(path).expect("the folder");
        let name = |entry: std::io::Result<std::fs::DirEntry>| {
            let name = entry.expect("an entry").file_name();
            format!("{folder}/{}", name.to_str().expect("text"))
        };
        let mut names: Vec<String> = entries.map(name).collect();
        names.sort();
        let embedded: Vec<_> = files.iter().map(|(name, _)| *name).collect();
        assert_eq!(names, embedded);
        assert_eq!(migrator_of(files).iter().count(), files.len());
    }
}
