//! Files of attempts: those that get a name, and those that have none.

use std::collections::HashSet;

use sqlx::SqliteConnection;
use uuid::fmt::Hyphenated;

use crate::store::folder::Folder;
use crate::store::rows::integer;
use crate::store::sqlite::SqliteStore;
use crate::store::{Lease, NewContent, NewFile, StoreError};

impl SqliteStore {
    pub(in crate::store) async fn remove_unnamed_files(
        &self,
        attempt: Option<Lease>,
    ) -> Result<(), StoreError> {
        let attempt = attempt.map(|lease| (lease.job, lease.number));
        let named: Vec<String> = sqlx::query_scalar(
            "SELECT place FROM result_files WHERE place IS NOT NULL AND (job_id = ?1 OR ?1 IS NULL)",
        )
        .bind(attempt.map(|(id, _)| id.to_string()))
        .fetch_all(&self.readers)
        .await?;
        let named: HashSet<String> = named.into_iter().collect();
        // Remote workers, which live on when the service ends, may be about to name what they have sent.
        let held: Vec<(Hyphenated, i64)> = match attempt {
            Some(_) => Vec::new(),
            None => {
                sqlx::query_as("SELECT id, lease FROM jobs WHERE status = 'running' AND is_remote")
                    .fetch_all(&self.readers)
                    .await?
            }
        };
        let remove = move |folder: Folder| {
            let held = held
                .iter()
                .map(|(id, lease)| folder.of_attempt((*id).into(), *lease));
            folder.remove_unnamed(attempt, &named, &held.collect())
        };
        self.process.remove_unnamed(remove).await;
        Ok(())
    }
}

/// Adds files to the manifest, in a transaction that has checked the lease.
pub(super) async fn insert_files(
    connection: &mut SqliteConnection,
    lease: Lease,
    files: &[NewFile],
) -> Result<(), StoreError> {
    for NewFile { file, content } in files {
        let (mut inline, mut place) = (None, None);
        match content {
            NewContent::Inline(bytes) => inline = Some(&bytes[..]),
            NewContent::Folder => place = Some(Folder::place(lease.job, lease.number, &file.name)),
            // The one service of a file has them in its folder.
            NewContent::Object(_) => return Err(StoreError::LostFile(file.name.clone())),
        }
        sqlx::query(
            "INSERT OR REPLACE INTO result_files (job_id, name, cycle, media_type, bytes, sha256, content, place) \
             VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
        )
        .bind(lease.job.to_string())
        .bind(&file.name)
        .bind(file.cycle.map(integer))
        .bind(&file.media_type)
        .bind(integer(file.bytes))
        .bind(&file.sha256)
        .bind(inline)
        .bind(place)
        .execute(&mut *connection)
        .await?;
    }
    Ok(())
}
