//! Results of a job, there while it runs.

use futures_util::TryStreamExt;
use solver::record::CycleReport;
use uuid::Uuid;

use crate::store::{Store, StoreError};

/// A document of a snapshot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SnapshotPart {
    /// Worn depth.
    Profile,
    /// Contact tractions.
    Pressure,
    /// Friction loop.
    Loop,
}

impl SnapshotPart {
    fn nearest(self) -> &'static str {
        match self {
            Self::Profile => {
                "SELECT profile FROM snapshots WHERE job_id = ? ORDER BY abs(cycle - ?), cycle LIMIT 1"
            }
            Self::Pressure => {
                "SELECT pressure FROM snapshots WHERE job_id = ? ORDER BY abs(cycle - ?), cycle LIMIT 1"
            }
            Self::Loop => {
                "SELECT friction_loop FROM snapshots WHERE job_id = ? ORDER BY abs(cycle - ?), cycle LIMIT 1"
            }
        }
    }
}

impl Store {
    /// The rows of the wear history so far, by cycle.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails or a row cannot be read.
    pub async fn history(&self, id: Uuid) -> Result<Vec<CycleReport>, StoreError> {
        // One text after the other: those of a long history together are several times as large as its rows.
        let text = sqlx::query_scalar::<_, String>(
            "SELECT data FROM history_rows WHERE job_id = ? ORDER BY cycle",
        );
        let mut texts = text.bind(id.to_string()).fetch(&self.readers);
        let mut rows = Vec::new();
        while let Some(text) = texts.try_next().await? {
            let row = serde_json::from_str(&text).map_err(|cause| StoreError::Corrupt {
                id,
                what: "history row",
                cause: cause.to_string(),
            })?;
            rows.push(row);
        }
        Ok(rows)
    }

    /// A document (JSON) of the stored snapshot nearest to a cycle; the last one if no cycle is named.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn snapshot(
        &self,
        id: Uuid,
        part: SnapshotPart,
        cycle: Option<u64>,
    ) -> Result<Option<String>, StoreError> {
        let cycle = cycle.map_or(i64::MAX, |cycle| i64::try_from(cycle).unwrap_or(i64::MAX));
        let document = sqlx::query_scalar(part.nearest())
            .bind(id.to_string())
            .bind(cycle)
            .fetch_optional(&self.readers)
            .await?;
        Ok(document)
    }

    /// The cycles at which snapshots are stored.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn snapshot_cycles(&self, id: Uuid) -> Result<Vec<i64>, StoreError> {
        Ok(
            sqlx::query_scalar("SELECT cycle FROM snapshots WHERE job_id = ? ORDER BY cycle")
                .bind(id.to_string())
                .fetch_all(&self.readers)
                .await?,
        )
    }
}
