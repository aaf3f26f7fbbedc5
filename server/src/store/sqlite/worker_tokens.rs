//! Tokens of remote workers.

use api::worker::WorkerToken;
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::store::StoreError;
use crate::store::rows::{timestamp, token};
use crate::store::sqlite::SqliteStore;

impl SqliteStore {
    pub(in crate::store) async fn add_worker_token(
        &self,
        name: &str,
        sha256: &[u8; 32],
    ) -> Result<WorkerToken, StoreError> {
        let (id, now) = (Uuid::now_v7(), self.local.clock.now().system_ms);
        sqlx::query("INSERT INTO worker_tokens (id, name, sha256, created_at) VALUES (?, ?, ?, ?)")
            .bind(id.to_string())
            .bind(name)
            .bind(&sha256[..])
            .bind(now)
            .execute(&self.writer)
            .await?;
        Ok(WorkerToken {
            id,
            name: name.to_owned(),
            created_at: timestamp(now),
            revoked_at: None,
        })
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
            "UPDATE worker_tokens SET revoked_at = COALESCE(revoked_at, ?) WHERE id = ?",
        )
        .bind(self.local.clock.now().system_ms)
        .bind(id.to_string())
        .execute(&self.writer)
        .await?;
        Ok(revoked.rows_affected() > 0)
    }

    pub(in crate::store) async fn valid_worker_token(
        &self,
        sha256: &[u8; 32],
    ) -> Result<Option<Uuid>, StoreError> {
        let found: Option<Hyphenated> = sqlx::query_scalar(
            "SELECT id FROM worker_tokens WHERE sha256 = ? AND revoked_at IS NULL",
        )
        .bind(&sha256[..])
        .fetch_optional(&self.readers)
        .await?;
        Ok(found.map(Uuid::from))
    }
}
