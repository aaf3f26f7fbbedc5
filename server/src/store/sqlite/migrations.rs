//! The migrations of the schema, embedded.

use sqlx::SqlSafeStr;
use sqlx::migrate::{Migration, MigrationType, Migrator};

/// A file of the folder `migrations/sqlite`: its name and its SQL.
macro_rules! file {
    ($name:literal) => {
        (
            $name,
            include_str!(concat!("../../../../migrations/sqlite/", $name)),
        )
    };
}

/// All files of the folder; a name is the version and what it is about.
const FILES: [(&str, &str); 26] = [
    file!("0001_jobs.sql"),
    file!("0002_labels.sql"),
    file!("0003_events.sql"),
    file!("0004_results.sql"),
    file!("0005_request_keys.sql"),
    file!("0010_checkpoints.sql"),
    file!("0011_scheduling.sql"),
    file!("0012_probes.sql"),
    file!("0020_result_files.sql"),
    file!("0021_sweeps.sql"),
    file!("0040_studies.sql"),
    file!("0050_fruitless_attempts.sql"),
    file!("0051_retries.sql"),
    file!("0052_disk_reasons.sql"),
    file!("0053_damaged_files.sql"),
    file!("0054_owner.sql"),
    file!("0055_list_indexes.sql"),
    file!("0056_result_blocks.sql"),
    file!("0057_job_counts.sql"),
    file!("0058_clock.sql"),
    file!("0059_clock_of_the_boot.sql"),
    file!("0060_revisions.sql"),
    file!("0061_numbered_requests.sql"),
    file!("0062_worker_tokens.sql"),
    file!("0063_objects.sql"),
    file!("0064_queue_indexes.sql"),
];

/// Applies the migrations that a database does not have; refuses a database with others.
pub(super) fn migrator() -> Migrator {
    let migration = |(name, sql): (&str, &'static str)| {
        let (version, topic) = name.trim_end_matches(".sql").split_once('_')?;
        let (version, topic) = (version.parse().ok()?, topic.replace('_', " "));
        let sql = sql.into_sql_str();
        Some(Migration::new(
            version,
            topic.into(),
            MigrationType::Simple,
            sql,
            false,
        ))
    };
    Migrator::with_migrations(FILES.into_iter().filter_map(migration).collect())
}

/// Version of the newest migration.
pub(super) fn newest_version() -> i64 {
    let versions = migrator();
    versions
        .iter()
        .map(|migration| migration.version)
        .max()
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_of_the_folder_is_embedded_and_has_a_version() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../migrations/sqlite");
        let entries = std::fs::read_dir(folder).expect("the folder");
        let name = |entry: std::io::Result<std::fs::DirEntry>| {
            let name = entry.expect("an entry").file_name();
            name.into_string().expect("text")
        };
        let mut names: Vec<String> = entries.map(name).collect();
        names.sort();
        assert_eq!(names, FILES.map(|(name, _)| name));
        assert_eq!(migrator().iter().count(), FILES.len());
    }
}
