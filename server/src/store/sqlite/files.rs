//! Manifests: the files of a job by name, and their content.

use std::collections::HashSet;

use api::results::ResultFile;
use sqlx::{Sqlite, Transaction};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::objects::Source;
use crate::store::block::Block;
use crate::store::folder::Folder;
use crate::store::rows::{entry, integer};
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::blocks::{entries, update_entries};
use crate::store::sqlite::queries::BEGIN;
use crate::store::stored_block::unreadable;
use crate::store::stored_file::{file, source};
use crate::store::{Content, Lease, NewContent, NewFile, StoreError};

impl SqliteStore {
    pub(in crate::store) async fn manifest(&self, id: Uuid) -> Result<Vec<ResultFile>, StoreError> {
        // Both as of one time: a file may be moved from the one to the other.
        let mut transaction = self.readers.begin().await?;
        let rows = sqlx::query(
            "SELECT name, cycle, media_type, bytes, sha256, damaged FROM result_files WHERE job_id = ? ORDER BY name",
        )
        .bind(id.to_string())
        .fetch_all(&mut *transaction)
        .await?;
        let mut files: Vec<_> = rows.iter().map(entry).collect::<Result<_, _>>()?;
        if let Some(entries) = entries(&mut transaction, id).await? {
            files.extend(Block::listed(&entries).map_err(|cause| unreadable(id, &cause))?);
            files.sort_by(|a, b| a.name.cmp(&b.name));
        }
        Ok(files)
    }

    pub(in crate::store) async fn file_row(
        &self,
        id: Uuid,
        name: &str,
    ) -> Result<Option<(ResultFile, Content)>, StoreError> {
        let row = sqlx::query(
            "SELECT name, cycle, media_type, bytes, sha256, damaged, content, place FROM result_files WHERE job_id = ? AND name = ?",
        )
        .bind(id.to_string())
        .bind(name)
        .fetch_optional(&self.readers)
        .await?;
        row.map(|row| file(&self.local, id, &row, None)).transpose()
    }

    pub(in crate::store) async fn files_outside(
        &self,
        id: Uuid,
    ) -> Result<Vec<(ResultFile, Source)>, StoreError> {
        let rows = sqlx::query(
            "SELECT name, cycle, media_type, bytes, sha256, damaged, place FROM result_files WHERE job_id = ? AND place IS NOT NULL",
        )
        .bind(id.to_string())
        .fetch_all(&self.readers)
        .await?;
        let mut files = Vec::with_capacity(rows.len());
        for row in &rows {
            let entry = entry(row)?;
            let source = source(&self.local, id, &entry, (row, None))?;
            files.extend(source.map(|source| (entry, source)));
        }
        Ok(files)
    }

    pub(in crate::store) async fn mark_damaged(
        &self,
        id: Uuid,
        name: &str,
        how: Option<&str>,
    ) -> Result<(), StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        sqlx::query(
            "UPDATE result_files SET damaged = ?1 WHERE job_id = ?2 AND name = ?3 AND damaged IS NOT ?1",
        )
        .bind(how)
        .bind(id.to_string())
        .bind(name)
        .execute(&mut *transaction)
        .await?;
        if let Some(old) = entries(&mut transaction, id).await? {
            let block = Block::decode(&old, &[]);
            let mut block = block.map_err(|cause| unreadable(id, &cause))?;
            if let Some(new) = block.mark(name, how)? {
                update_entries(&mut transaction, id, &old, &new).await?;
            }
        }
        Ok(transaction.commit().await?)
    }

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
        self.local.remove_unnamed(remove).await;
        Ok(())
    }
}

/// Adds files to the manifest, in a transaction that has checked the lease.
pub(super) async fn insert_files(
    transaction: &mut Transaction<'_, Sqlite>,
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
        .execute(&mut **transaction)
        .await?;
    }
    Ok(())
}
