//! Changes of all jobs in their order.

use crate::store::overview::overview;
use crate::store::rows::StoredRow;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::sql::selects::select_overview;
use crate::store::{Changed, StoreError};

/// Changes that are read at once.
const MOST: u16 = 200;
/// Revisions whose deletions are kept: as in the migration.
const KEPT: i64 = 1_000_000;

impl SqliteStore {
    pub(in crate::store) async fn last_revision(&self) -> Result<i64, StoreError> {
        let last = sqlx::query_scalar("SELECT last FROM revisions")
            .fetch_one(&self.readers)
            .await?;
        Ok(last)
    }

    pub(in crate::store) async fn knows_revision(&self, revision: i64) -> Result<bool, StoreError> {
        let last = self.last_revision().await?;
        Ok((last.saturating_sub(KEPT)..=last).contains(&revision))
    }

    pub(in crate::store) async fn changed_after(
        &self,
        revision: i64,
    ) -> Result<Vec<(i64, Changed)>, StoreError> {
        let mut query = select_overview();
        query
            .push(" WHERE revision > ")
            .push_bind(revision)
            .push(" ORDER BY revision LIMIT ")
            .push_bind(MOST);
        let rows = query.build().fetch_all(&self.readers).await?;
        let deleted = sqlx::query(
            "SELECT revision, id FROM deleted_jobs WHERE revision > ? ORDER BY revision LIMIT ?",
        );
        let deleted = deleted.bind(revision).bind(MOST);
        let deleted = deleted.fetch_all(&self.readers).await?;
        let mut changes = Vec::with_capacity(rows.len() + deleted.len());
        for row in &rows {
            let job = Changed::Job(Box::new(overview(&self.process, row)?));
            changes.push((row.value("revision")?, job));
        }
        for row in &deleted {
            let id = Changed::Deleted(row.id("id")?);
            changes.push((row.value("revision")?, id));
        }
        changes.sort_unstable_by_key(|(revision, _)| *revision);
        changes.truncate(usize::from(MOST));
        Ok(changes)
    }
}
