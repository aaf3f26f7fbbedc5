//! Files of attempts: those that get a name, and those that have none.

use std::collections::HashSet;

use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::store::file_key::is_of_job;
use crate::store::folder::Folder;
use crate::store::postgres::PostgresStore;
use crate::store::rows::integer;
use crate::store::{Lease, NewContent, NewFile, StoreError};

impl PostgresStore {
    /// Removes files of the attempts at a job up to this one, or those of all jobs that were deleted or whose results were moved. Files of
    /// other jobs may be about to be named by other processes.
    pub(in crate::store) async fn remove_unnamed_files(
        &self,
        attempt: Option<Lease>,
    ) -> Result<(), StoreError> {
        let Some(attempt) = attempt else {
            return self.remove_left_files().await;
        };
        let job = attempt.job;
        let has_files = self.process.in_folder(move |folder| Ok(folder.has(job)));
        if !has_files.await.unwrap_or(true) {
            return Ok(());
        }
        let named: Vec<String> = sqlx::query_scalar(
            "SELECT place FROM result_files WHERE place IS NOT NULL AND job_id = $1",
        )
        .bind(attempt.job)
        .fetch_all(&self.readers)
        .await?;
        let named: HashSet<String> = named.into_iter().collect();
        let attempt = Some((attempt.job, attempt.number));
        let remove = move |folder: Folder| folder.remove_unnamed(attempt, &named, &HashSet::new());
        self.process.remove_unnamed(remove).await;
        Ok(())
    }

    async fn remove_left_files(&self) -> Result<(), StoreError> {
        let jobs = match self.process.in_folder(|folder| folder.jobs()).await {
            Ok(jobs) => jobs,
            Err(error) => {
                tracing::warn!(%error, "the folder of results cannot be read");
                return Ok(());
            }
        };
        let kept: Vec<(Uuid, i64, bool)> = sqlx::query_as(
            "SELECT id, lease, status = 'running' OR EXISTS (SELECT 1 FROM result_files WHERE job_id = id AND place IS NOT NULL) \
             FROM jobs LEFT JOIN result_blocks ON job_id = id WHERE id = ANY($1) AND object IS NULL",
        )
        .bind(&jobs)
        .fetch_all(&self.readers)
        .await?;
        for (job, lease, is_needed) in &kept {
            // Attempts that begin meanwhile have higher numbers.
            let attempt = Some((*job, *lease));
            let remove = move |folder: Folder| {
                folder.remove_unnamed(attempt, &HashSet::new(), &HashSet::new())
            };
            if !is_needed {
                self.process.remove_unnamed(remove).await;
            }
        }
        let kept: HashSet<_> = kept.into_iter().map(|(job, ..)| job).collect();
        for job in jobs.into_iter().filter(|job| !kept.contains(job)) {
            self.process.remove_files(job).await;
        }
        let remove = |folder: Folder| folder.remove_received();
        self.process.remove_unnamed(remove).await;
        Ok(())
    }
}

/// Place of a file that was sent under a key.
#[derive(Debug, Clone, Copy)]
enum Sent {
    /// In the object.
    Object,
    /// In the note, because the object could not be written.
    Content,
}

/// Locks the note of a job's file and returns the place of the file; `None` without a note, or if the object is being removed.
async fn sent(
    connection: &mut PgConnection,
    job: Uuid,
    key: &str,
) -> Result<Option<Sent>, StoreError> {
    if !is_of_job(key, job) {
        return Ok(None);
    }
    let has_content: Option<bool> = sqlx::query_scalar(
        "SELECT content IS NOT NULL FROM unnamed_objects WHERE key = $1 AND NOT is_removing FOR UPDATE",
    )
    .bind(key)
    .fetch_optional(connection)
    .await?;
    let sent = |has_content| {
        if has_content {
            Sent::Content
        } else {
            Sent::Object
        }
    };
    Ok(has_content.map(sent))
}

/// Removes the note of a file that the manifest names. A note with the content loses that only: an object may exist, too, at least in
/// part, and is removed later.
async fn forget(connection: &mut PgConnection, key: &str, sent: Sent) -> Result<(), StoreError> {
    let statement = match sent {
        Sent::Object => "DELETE FROM unnamed_objects WHERE key = $1",
        Sent::Content => {
            "UPDATE unnamed_objects SET content = NULL, noted_at = fretwear_now() WHERE key = $1"
        }
    };
    sqlx::query(statement).bind(key).execute(connection).await?;
    Ok(())
}

/// Adds files to the manifest, in a transaction that has checked the lease.
pub(super) async fn insert_files(
    connection: &mut PgConnection,
    lease: Lease,
    files: &[NewFile],
) -> Result<(), StoreError> {
    for NewFile { file, content } in files {
        let (mut inline, mut place, mut object) = (None, None, None);
        let mut noted = None;
        match content {
            NewContent::Inline(bytes) => inline = Some(&bytes[..]),
            NewContent::Folder => place = Some(Folder::place(lease.job, lease.number, &file.name)),
            NewContent::Object(key) => {
                let sent = sent(connection, lease.job, key).await?;
                let sent = sent.ok_or_else(|| StoreError::LostFile(file.name.clone()))?;
                match sent {
                    Sent::Object => object = Some(key),
                    Sent::Content => {}
                }
                noted = Some((key, sent));
            }
        }
        sqlx::query(
            "INSERT INTO result_files (job_id, name, cycle, media_type, bytes, sha256, content, place, object) \
             VALUES ($1, $2, $3, $4, $5, $6, COALESCE($7, (SELECT content FROM unnamed_objects WHERE key = $10)), $8, $9) \
             ON CONFLICT (job_id, name) DO UPDATE SET cycle = excluded.cycle, \
             media_type = excluded.media_type, bytes = excluded.bytes, sha256 = excluded.sha256, content = excluded.content, \
             place = excluded.place, object = excluded.object, damaged = NULL",
        )
        .bind(lease.job)
        .bind(&file.name)
        .bind(file.cycle.map(integer))
        .bind(&file.media_type)
        .bind(integer(file.bytes))
        .bind(&file.sha256)
        .bind(inline)
        .bind(place)
        .bind(object)
        .bind(noted.map(|(key, _)| key))
        .execute(&mut *connection)
        .await?;
        if let Some((key, sent)) = noted {
            forget(connection, key, sent).await?;
        }
    }
    Ok(())
}
