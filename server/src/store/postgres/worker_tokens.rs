//! Tokens of remote workers.

use api::worker::WorkerToken;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::postgres::PostgresStore;
use crate::store::rows::token;

impl PostgresStore {
    pub(in crate::store) async fn add_worker_token(
        &self,
        name: &str,
        sha256: &[u8; 32],
    ) -> Result<WorkerToken, StoreError> {
        let row = sqlx::query(
            "INSERT INTO worker_tokens (id, name, sha256, created_at) VALUES ($1, $2, $3, fretwear_now()) RETURNING *",
        )
        .bind(Uuid::now_v7())
        .bind(name)
        .bind(&sha256[..])
        .fetch_one(&self.pool)
        .await?;
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
        let revoked = sqlx::query(
            "UPDATE worker_tokens SET revoked_at = COALESCE(revoked_at, fretwear_now()) WHERE id = $1",
        )
        .bind(id)
        .execute(&self.pool)
        .await?;
        Ok(revoked.rows_affected() > 0)
    }

    pub(in crate::store) async fn valid_worker_token(
        &self,
        sha256: &[u8; 32],
    ) -> Result<Option<Uuid>, StoreError> {
        let found = sqlx::query_scalar(
            "SELECT id FROM worker_tokens WHERE sha256 = $1 AND revoked_at IS NULL",
        )
        .bind(&sha256[..]);
        Ok(found.fetch_optional(&self.readers).await?)
    }
}
