//! Changes of all jobs in their order.

use api::job::JobOverview;
use sqlx::Row;

use crate::store::sqlite::overview::{overview, select_overview};
use crate::store::sqlite::queries;
use crate::store::{Changed, Store, StoreError};

/// Changes that are read at once.
const MOST: i64 = 200;
/// Revisions whose deletions are kept: as in the migration.
const KEPT: i64 = 1_000_000;

impl Store {
    /// Revision of the last change of any job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn last_revision(&self) -> Result<i64, StoreError> {
        let last = sqlx::query_scalar("SELECT last FROM revisions")
            .fetch_one(&self.readers)
            .await?;
        Ok(last)
    }

    /// Whether all changes after a revision are known.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn knows_revision(&self, revision: i64) -> Result<bool, StoreError> {
        let last = self.last_revision().await?;
        Ok((last.saturating_sub(KEPT)..=last).contains(&revision))
    }

    /// Jobs that have changed or were deleted after a revision, each once, in the order of their last changes.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn changed_after(&self, revision: i64) -> Result<Vec<(i64, Changed)>, StoreError> {
        let rows = sqlx::query(
            "SELECT revision, id, 0 AS deleted FROM jobs WHERE revision > ?1 \
             UNION ALL SELECT revision, id, 1 FROM deleted_jobs WHERE revision > ?1 \
             ORDER BY revision LIMIT ?2",
        )
        .bind(revision)
        .bind(MOST)
        .fetch_all(&self.readers)
        .await?;
        let mut changes = Vec::with_capacity(rows.len());
        for row in &rows {
            let (revision, id) = (row.try_get("revision")?, queries::id(row, "id")?);
            if row.try_get("deleted")? {
                changes.push((revision, Changed::Deleted(id)));
            } else if let Some(job) = self.overview(id).await? {
                changes.push((revision, Changed::Job(Box::new(job))));
            }
        }
        Ok(changes)
    }

    /// The short document of a job as it is now.
    async fn overview(&self, id: uuid::Uuid) -> Result<Option<JobOverview>, StoreError> {
        let mut query = select_overview();
        query.push(" WHERE id = ").push_bind(id.to_string());
        let row = query.build().fetch_optional(&self.readers).await?;
        row.map(|row| overview(&self.disk, &row)).transpose()
    }
}
