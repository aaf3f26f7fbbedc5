//! The manifest of a job: what it produced, by name, and where the content is.

use std::collections::HashSet;
use std::path::PathBuf;

use api::results::{ResultFile, Snapshot};
use sqlx::{Sqlite, Transaction};
use uuid::Uuid;

use crate::store::sqlite::folder::Folder;
use crate::store::sqlite::leases::Claim;
use crate::store::{Store, StoreError};

/// A file to be added to the manifest.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewFile {
    /// What the manifest says.
    pub file: ResultFile,
    /// The content, if it is small; otherwise it is a file of that name in the attempt's folder.
    pub content: Option<Vec<u8>>,
}

/// Where the content of a file is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Content {
    /// Here.
    Inline(Vec<u8>),
    /// In this file.
    File(PathBuf),
}

#[derive(sqlx::FromRow)]
struct FileRow {
    name: String,
    cycle: Option<i64>,
    media_type: String,
    bytes: i64,
    sha256: String,
}

impl From<FileRow> for ResultFile {
    fn from(row: FileRow) -> Self {
        Self {
            name: row.name,
            cycle: row.cycle.and_then(|cycle| u64::try_from(cycle).ok()),
            media_type: row.media_type,
            bytes: u64::try_from(row.bytes).unwrap_or_default(),
            sha256: row.sha256,
        }
    }
}

impl Store {
    /// Where an attempt at a job writes its large results.
    pub fn attempt_folder(&self, claim: &Claim) -> PathBuf {
        self.folder.of_attempt(claim.id, claim.lease)
    }

    /// The manifest of a job so far, by name.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn manifest(&self, id: Uuid) -> Result<Vec<ResultFile>, StoreError> {
        let rows: Vec<FileRow> = sqlx::query_as(
            "SELECT name, cycle, media_type, bytes, sha256 FROM result_files WHERE job_id = ? ORDER BY name",
        )
        .bind(id.to_string())
        .fetch_all(&self.readers)
        .await?;
        Ok(rows.into_iter().map(ResultFile::from).collect())
    }

    /// A file that the manifest names, and where its content is.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn result_file(
        &self,
        id: Uuid,
        name: &str,
    ) -> Result<Option<(ResultFile, Content)>, StoreError> {
        #[derive(sqlx::FromRow)]
        struct Stored {
            #[sqlx(flatten)]
            row: FileRow,
            content: Option<Vec<u8>>,
            place: Option<String>,
        }
        let stored: Option<Stored> = sqlx::query_as(
            "SELECT name, cycle, media_type, bytes, sha256, content, place FROM result_files WHERE job_id = ? AND name = ?",
        )
        .bind(id.to_string())
        .bind(name)
        .fetch_optional(&self.readers)
        .await?;
        let Some(stored) = stored else {
            return Ok(None);
        };
        let place = stored.place.unwrap_or_default();
        let content = match stored.content {
            Some(content) => Content::Inline(content),
            None => Content::File(self.folder.path(&place).ok_or(StoreError::Corrupt {
                id,
                what: "place of a file",
                cause: place,
            })?),
        };
        Ok(Some((stored.row.into(), content)))
    }

    /// All snapshots of a job, by cycle.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails or a document cannot be read.
    pub async fn snapshots(&self, id: Uuid) -> Result<Vec<Snapshot>, StoreError> {
        let rows: Vec<(String, String, String)> = sqlx::query_as(
            "SELECT profile, pressure, friction_loop FROM snapshots WHERE job_id = ? ORDER BY cycle",
        )
        .bind(id.to_string())
        .fetch_all(&self.readers)
        .await?;
        let read = |(profile, pressure, friction_loop): &(String, String, String)| {
            Ok(Snapshot {
                profile: serde_json::from_str(profile)?,
                pressure: serde_json::from_str(pressure)?,
                friction_loop: serde_json::from_str(friction_loop)?,
            })
        };
        rows.iter()
            .map(read)
            .collect::<Result<_, serde_json::Error>>()
            .map_err(|cause| StoreError::Corrupt {
                id,
                what: "snapshot",
                cause: cause.to_string(),
            })
    }

    /// Removes files that no manifest names: of the attempts at a job up to this one, or at start-up of all. A later
    /// attempt may write files that the manifest does not name yet. What cannot be removed is logged and left for the
    /// next start.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn sweep_files(&self, attempt: Option<&Claim>) -> Result<(), StoreError> {
        let attempt = attempt.map(|claim| (claim.id, claim.lease));
        let named: Vec<String> = sqlx::query_scalar(
            "SELECT place FROM result_files WHERE place IS NOT NULL AND (job_id = ?1 OR ?1 IS NULL)",
        )
        .bind(attempt.map(|(id, _)| id.to_string()))
        .fetch_all(&self.readers)
        .await?;
        let named: HashSet<String> = named.into_iter().collect();
        let folder = self.folder.clone();
        match tokio::task::spawn_blocking(move || folder.sweep(attempt, &named)).await {
            Ok(Ok(0)) => {}
            Ok(Ok(gone)) => tracing::info!(gone, "files that no manifest names were removed"),
            Ok(Err(error)) => tracing::warn!(%error, "files could not be swept"),
            Err(error) => tracing::warn!(%error, "files could not be swept"),
        }
        Ok(())
    }

    /// Removes the files of a job that is gone. What cannot be removed is logged and left for the next start.
    pub(in crate::store) async fn remove_files(&self, id: Uuid) {
        let folder = self.folder.clone();
        match tokio::task::spawn_blocking(move || folder.remove(id)).await {
            Ok(Ok(())) => {}
            Ok(Err(error)) => tracing::warn!(job = %id, %error, "files could not be removed"),
            Err(error) => tracing::warn!(job = %id, %error, "files could not be removed"),
        }
    }
}

/// Adds files to the manifest, in a transaction that has checked the lease.
pub(in crate::store) async fn insert_files(
    transaction: &mut Transaction<'_, Sqlite>,
    claim: &Claim,
    files: &[NewFile],
) -> Result<(), StoreError> {
    for NewFile { file, content } in files {
        let place = content
            .is_none()
            .then(|| Folder::place(claim.id, claim.lease, &file.name));
        sqlx::query(
            "INSERT OR REPLACE INTO result_files (job_id, name, cycle, media_type, bytes, sha256, content, place) \
             VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
        )
        .bind(claim.id.to_string())
        .bind(&file.name)
        .bind(file.cycle.map(|cycle| i64::try_from(cycle).unwrap_or(i64::MAX)))
        .bind(&file.media_type)
        .bind(i64::try_from(file.bytes).unwrap_or(i64::MAX))
        .bind(&file.sha256)
        .bind(content.as_deref())
        .bind(place)
        .execute(&mut **transaction)
        .await?;
    }
    Ok(())
}
