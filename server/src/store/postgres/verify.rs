//! Verification of all results that a database names. The database itself is checked by the server's own tools (`pg_amcheck`,
//! checksums of pages).

use std::path::Path;

use sqlx::postgres::{PgPool, PgRow};
use uuid::Uuid;

use crate::objects::Objects;
use crate::store::folder::Folder;
use crate::store::postgres::blocks::stored_block;
use crate::store::postgres::objects::identity;
use crate::store::postgres::open::open_to_verify;
use crate::store::rows::{StoredRow, entry};
use crate::store::stored_block::StoredBlock;
use crate::store::verification::Verification;
use crate::store::verified::{CheckpointRow, FileRow, Verified};
use crate::store::{BackupError, CopySummary, StoreError};

/// Verifies the database at `url`, whose large results may be in the folder `files`.results.
pub(in crate::store) async fn verify(
    url: &str,
    files: &Path,
    objects: Option<&Objects>,
) -> Result<CopySummary, BackupError> {
    let database = open_to_verify(url).await?;
    let folder = Folder::beside(files);
    let verification = Verification::of(&database, &folder, objects).await?;
    let verified = verification.run().await;
    database.close().await;
    verified
}

impl Verified for PgPool {
    const HAS_SEVERAL_FOLDERS: bool = true;

    async fn jobs(&self) -> Result<Vec<Uuid>, StoreError> {
        let jobs = sqlx::query_scalar("SELECT id FROM jobs ORDER BY id");
        Ok(jobs.fetch_all(self).await?)
    }

    async fn block(&self, job: Uuid) -> Result<Option<StoredBlock>, StoreError> {
        let mut connection = self.acquire().await?;
        Ok(stored_block(&mut connection, job).await?)
    }

    async fn mark_block(&self, job: Uuid, old: &[u8], new: &[u8]) -> Result<(), StoreError> {
        sqlx::query("UPDATE result_blocks SET entries = $1 WHERE job_id = $2 AND entries = $3")
            .bind(new)
            .bind(job)
            .bind(old)
            .execute(self)
            .await?;
        Ok(())
    }

    async fn files(&self, job: Uuid, name: Option<&str>) -> Result<Vec<FileRow>, StoreError> {
        let rows = sqlx::query(
            "SELECT name, cycle, media_type, bytes, sha256, damaged, place, object FROM result_files \
             WHERE job_id = $1 AND ($2::text IS NULL OR name = $2) ORDER BY name",
        )
        .bind(job)
        .bind(name)
        .fetch_all(self)
        .await?;
        let file = |row: &PgRow| {
            Ok(FileRow {
                entry: entry(row)?,
                place: row.optional_text("place")?,
                object: row.optional_text("object")?,
            })
        };
        rows.iter().map(file).collect()
    }

    async fn content(&self, job: Uuid, file: &FileRow) -> Result<Option<Vec<u8>>, StoreError> {
        let content = sqlx::query_scalar(
            "SELECT content FROM result_files WHERE job_id = $1 AND name = $2 AND sha256 = $3",
        );
        let content = content.bind(job).bind(&file.entry.name);
        let content = content.bind(&file.entry.sha256).fetch_optional(self);
        Ok(content.await?.flatten())
    }

    async fn mark_file(
        &self,
        job: Uuid,
        file: &FileRow,
        how: Option<&str>,
    ) -> Result<(), StoreError> {
        sqlx::query(
            "UPDATE result_files SET damaged = $1 WHERE job_id = $2 AND name = $3 \
             AND place IS NOT DISTINCT FROM $4 AND object IS NOT DISTINCT FROM $5 AND sha256 = $6",
        )
        .bind(how)
        .bind(job)
        .bind(&file.entry.name)
        .bind(&file.place)
        .bind(&file.object)
        .bind(&file.entry.sha256)
        .execute(self)
        .await?;
        Ok(())
    }

    async fn checkpoint(&self, job: Uuid) -> Result<Option<CheckpointRow>, StoreError> {
        let row: Option<(Vec<u8>, Vec<u8>, Option<String>)> =
            sqlx::query_as("SELECT sha256, state, object FROM checkpoints WHERE job_id = $1")
                .bind(job)
                .fetch_optional(self)
                .await?;
        Ok(row.map(CheckpointRow::from))
    }

    async fn address_of_objects(&self) -> Result<Option<String>, StoreError> {
        let address = sqlx::query_scalar("SELECT address FROM object_store");
        Ok(address.fetch_optional(self).await?)
    }

    async fn is_copy(&self) -> Result<bool, StoreError> {
        let noted = sqlx::query_as("SELECT removes, owner FROM object_store");
        let noted: Option<(bool, Option<String>)> = noted.fetch_optional(self).await?;
        let Some((removes, owner)) = noted else {
            return Ok(false);
        };
        let own = identity(&mut *self.acquire().await?).await?;
        Ok(!removes || owner.is_some_and(|owner| is_another(&owner, &own)))
    }
}

/// Returns `true` if two identities are of two databases. A role that may not read that of the server has only the number of the database.
fn is_another(noted: &str, own: &str) -> bool {
    match (noted.split_once('/'), own.split_once('/')) {
        (Some(noted), Some(own)) => noted != own,
        (noted_parts, own_parts) => {
            let number = |parts: Option<(_, _)>, whole| parts.map_or(whole, |(_, number)| number);
            number(noted_parts, noted) != number(own_parts, own)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_role_that_may_not_read_the_server_sees_no_copy() {
        assert!(is_another("7/16384", "8/16384") && is_another("7/16384", "7/16385"));
        assert!(is_another("16384", "7/16385") && is_another("16384", "16385"));
        assert!(!is_another("7/16384", "7/16384") && !is_another("7/16384", "16384"));
        assert!(!is_another("16384", "7/16384"));
    }
}
