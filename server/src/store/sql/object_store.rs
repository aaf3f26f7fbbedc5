//! The store of objects that a database names, and results that stay in the database.

use sqlx::AssertSqlSafe;
use uuid::Uuid;

use super::dialect::{EngineStore, IS_MOVABLE, StoredId, read_id, stored_id};
use crate::store::StoreError;

impl EngineStore {
    pub(in crate::store) async fn removes_objects(&self) -> Result<bool, StoreError> {
        let removes =
            sqlx::query_scalar("SELECT EXISTS (SELECT 1 FROM object_store WHERE removes)");
        Ok(removes.fetch_one(&self.writer).await?)
    }

    pub(in crate::store) async fn movable_jobs(
        &self,
        after: Uuid,
        most: i64,
    ) -> Result<Vec<Uuid>, StoreError> {
        let statement = format!(
            "SELECT job_id FROM result_blocks WHERE {IS_MOVABLE} AND object IS NULL AND job_id > $1 ORDER BY job_id LIMIT $2"
        );
        let jobs: Vec<StoredId> = sqlx::query_scalar(AssertSqlSafe(statement))
            .bind(stored_id(after))
            .bind(most)
            .fetch_all(self.priority_readers())
            .await?;
        Ok(jobs.into_iter().map(read_id).collect())
    }

    pub(in crate::store) async fn are_objects_marked(
        &self,
        address: &str,
    ) -> Result<bool, StoreError> {
        let marked = sqlx::query_scalar(
            "SELECT EXISTS (SELECT 1 FROM object_store WHERE is_marked AND address = $1)",
        );
        Ok(marked.bind(address).fetch_one(&self.writer).await?)
    }

    pub(in crate::store) async fn note_mark_of_objects(
        &self,
        address: &str,
    ) -> Result<bool, StoreError> {
        let noted = sqlx::query("UPDATE object_store SET is_marked = true WHERE address = $1")
            .bind(address)
            .execute(&self.writer)
            .await?;
        Ok(noted.rows_affected() > 0)
    }

    pub(in crate::store) async fn any_object(&self) -> Result<Option<String>, StoreError> {
        let key =
            sqlx::query_scalar("SELECT object FROM result_blocks WHERE object IS NOT NULL LIMIT 1");
        Ok(key.fetch_optional(&self.writer).await?)
    }

    pub(in crate::store) async fn keep_results(&self, id: Uuid) -> Result<(), StoreError> {
        sqlx::query(
            "UPDATE result_blocks SET is_movable = false WHERE job_id = $1 AND object IS NULL",
        )
        .bind(stored_id(id))
        .execute(&self.writer)
        .await?;
        Ok(())
    }
}
