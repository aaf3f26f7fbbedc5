//! Changes of all jobs in their order.

use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::sql::selects::select_overview;
use crate::store::{Changed, StoreError};

/// Changes that are read at once.
const MOST: u16 = 200;

impl SqliteStore {
    pub(in crate::store) async fn last_revision(&self) -> Result<i64, StoreError> {
        let last = sqlx::query_scalar("SELECT last FROM revisions")
            .fetch_one(&self.readers)
            .await?;
        Ok(last)
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
        let mut changes = self.changes_of(&rows, &deleted)?;
        changes.truncate(usize::from(MOST));
        Ok(changes)
    }
}
