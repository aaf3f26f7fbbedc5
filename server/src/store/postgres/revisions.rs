//! Changes of all jobs in their order. A revision is the number of the transaction that made a change, so that changes are committed in
//! another order than that of their revisions: only those before all transactions that have not ended are shown.

use sqlx::postgres::PgRow;
use sqlx::{Postgres, QueryBuilder};

use crate::store::postgres::PostgresStore;
use crate::store::postgres::sql::selects::select_overview;
use crate::store::rows::StoredRow;
use crate::store::{Changed, StoreError};

/// Changes that are read at once, beside those of the same transaction as the last one.
const MOST: usize = 200;

impl PostgresStore {
    pub(in crate::store) async fn last_revision(&self) -> Result<i64, StoreError> {
        let last = sqlx::query_scalar("SELECT fretwear_last_revision()");
        Ok(last.fetch_one(&self.readers).await?)
    }

    pub(in crate::store) async fn changed_after(
        &self,
        revision: i64,
    ) -> Result<Vec<(i64, Changed)>, StoreError> {
        // Both queries as of one revision: what is committed between them must not be passed over.
        let last = self.last_revision().await?;
        let mut jobs = between(select_overview(), revision, last);
        let rows = jobs.build().fetch_all(&self.readers).await?;
        let deleted = QueryBuilder::new("SELECT revision, id FROM deleted_jobs");
        let mut deleted = between(deleted, revision, last);
        let deleted = deleted.build().fetch_all(&self.readers).await?;
        // Where one list was cut, the other one is not known to be whole beyond.
        let last_of = |rows: &[PgRow]| {
            rows.last()
                .filter(|_| rows.len() >= MOST)
                .map(|row| row.value::<i64>("revision"))
        };
        let ends = [last_of(&rows), last_of(&deleted)].into_iter().flatten();
        let end = ends
            .collect::<Result<Vec<_>, _>>()?
            .into_iter()
            .min()
            .unwrap_or(last);
        let mut changes = self.changes_of(&rows, &deleted)?;
        changes.retain(|(revision, _)| *revision <= end);
        Ok(changes)
    }
}

/// Completes a query of changes after one revision and up to another.
fn between(mut query: QueryBuilder<Postgres>, after: i64, last: i64) -> QueryBuilder<Postgres> {
    query
        .push(" WHERE revision > ")
        .push_bind(after)
        .push(" AND revision <= ")
        .push_bind(last)
        .push(" ORDER BY revision FETCH FIRST ")
        .push(MOST)
        .push(" ROWS WITH TIES");
    query
}
