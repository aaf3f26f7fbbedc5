//! A backup of results that are moved to the store of objects while it is made.

use std::path::Path;

use sqlx::{Connection, SqliteConnection};

use crate::store::BackupError;
use crate::store::sqlite::objects::REMOVALS;

/// Statements that copy the moved results of a job (`?1`) from the original.
const TAKEN: [&str; 2] = [
    "INSERT OR REPLACE INTO result_blocks SELECT * FROM original.result_blocks WHERE job_id = ?1",
    "UPDATE jobs SET (spec, plan) = (SELECT spec, plan FROM original.jobs AS moved WHERE moved.id = ?1) WHERE id = ?1",
];

/// Takes the results of jobs over that were moved to the store of objects while their files were copied. Returns the places of the
/// files of other jobs.
pub(super) async fn take_moved(
    source: &Path,
    copy: &mut SqliteConnection,
    missing: Vec<String>,
) -> Result<Vec<String>, BackupError> {
    if missing.is_empty() {
        return Ok(missing);
    }
    sqlx::query("ATTACH DATABASE ? AS original")
        .bind(source.to_string_lossy().into_owned())
        .execute(&mut *copy)
        .await?;
    let mut deleted = Vec::new();
    for place in missing {
        let moved: Option<String> = sqlx::query_scalar(
            "SELECT job_id FROM result_files JOIN original.result_blocks AS moved USING (job_id) \
             WHERE place = ? AND moved.object IS NOT NULL",
        )
        .bind(&place)
        .fetch_optional(&mut *copy)
        .await?;
        let Some(job) = moved else {
            deleted.push(place);
            continue;
        };
        let mut transaction = copy.begin().await?;
        for statement in TAKEN.into_iter().chain(REMOVALS) {
            sqlx::query(statement)
                .bind(&job)
                .execute(&mut *transaction)
                .await?;
        }
        transaction.commit().await?;
    }
    Ok(deleted)
}
