//! Changes of all jobs in their order.

use super::dialect::{EngineStore, Row};
use crate::store::overview::overview;
use crate::store::rows::StoredRow;
use crate::store::{Changed, StoreError};

/// Revisions whose deletions are kept: as in the migrations of SQLite.
pub(in super::super) const KEPT_REVISIONS: i64 = 1_000_000;

impl EngineStore {
    pub(in crate::store) async fn knows_revision(&self, revision: i64) -> Result<bool, StoreError> {
        let last = self.last_revision().await?;
        Ok((last.saturating_sub(KEPT_REVISIONS)..=last).contains(&revision))
    }

    /// Changes from rows of jobs and of deleted jobs, in their order.
    pub(in super::super) fn changes_of(
        &self,
        jobs: &[Row],
        deleted: &[Row],
    ) -> Result<Vec<(i64, Changed)>, StoreError> {
        let mut changes = Vec::with_capacity(jobs.len() + deleted.len());
        for row in jobs {
            let job = Changed::Job(Box::new(overview(&self.process, row)?));
            changes.push((row.value("revision")?, job));
        }
        for row in deleted {
            changes.push((row.value("revision")?, Changed::Deleted(row.id("id")?)));
        }
        changes.sort_by_key(|(revision, _)| *revision);
        Ok(changes)
    }
}
