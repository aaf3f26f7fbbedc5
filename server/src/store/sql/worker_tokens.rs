//! Tokens of remote workers.

use api::worker::WorkerToken;
use uuid::Uuid;

use super::dialect::{EngineStore, StoredId, read_id, stored_id};
use crate::store::StoreError;
use crate::store::rows::token;

impl EngineStore {
    pub(in crate::store) async fn add_worker_token(
        &self,
        name: &str,
        sha256: &[u8; 32],
    ) -> Result<WorkerToken, StoreError> {
        let (mut transaction, now) = self.begin().await?;
        let row = sqlx::query(
            "INSERT INTO worker_tokens (id, name, sha256, created_at) VALUES ($1, $2, $3, $4) RETURNING *",
        )
        .bind(stored_id(Uuid::now_v7()))
        .bind(name)
        .bind(&sha256[..])
        .bind(now.system_ms)
        .fetch_one(&mut *transaction)
        .await?;
        transaction.commit().await?;
        token(&row)
    }

    pub(in crate::store) async fn worker_tokens(&self) -> Result<Vec<WorkerToken>, StoreError> {
        let rows =
            sqlx::query("SELECT id, name, created_at, revoked_at FROM worker_tokens ORDER BY id")
                .fetch_all(&self.readers)
                .await?;
        rows.iter().map(token).collect()
    }

    pub(in crate::store) async fn revoke_worker_token(&self, id: Uuid) -> Result<bool, StoreError> {
        let (mut transaction, now) = self.begin().await?;
        let revoked = sqlx::query(
            "UPDATE worker_tokens SET revoked_at = COALESCE(revoked_at, $1) WHERE id = $2",
        )
        .bind(now.system_ms)
        .bind(stored_id(id))
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(revoked.rows_affected() > 0)
    }

    pub(in crate::store) async fn valid_worker_token(
        &self,
        sha256: &[u8; 32],
    ) -> Result<Option<Uuid>, StoreError> {
        let found: Option<StoredId> = sqlx::query_scalar(
            "SELECT id FROM worker_tokens WHERE sha256 = $1 AND revoked_at IS NULL",
        )
        .bind(&sha256[..])
        .fetch_optional(&self.readers)
        .await?;
        Ok(found.map(read_id))
    }
}
