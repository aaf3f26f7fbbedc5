//! Upkeep of the database: old notes of deletions.

use crate::store::StoreError;
use crate::store::postgres::PostgresStore;
use crate::store::postgres::sql::revisions::KEPT_REVISIONS;

impl PostgresStore {
    /// The server keeps its own log; what is removed here are old notes of deletions.
    pub(in crate::store) async fn checkpoint_wal(&self) -> Result<(), StoreError> {
        sqlx::query(
            "DELETE FROM deleted_jobs WHERE revision <= (SELECT fretwear_last_revision()) - $1",
        )
        .bind(KEPT_REVISIONS)
        .execute(&self.writer)
        .await?;
        Ok(())
    }

    /// The server does it by itself.
    #[expect(clippy::unused_async, reason = "a file has to be asked")]
    pub(in crate::store) async fn give_pages_back(&self) -> Result<(), StoreError> {
        Ok(())
    }

    /// Several processes may serve the database.
    #[expect(
        clippy::unused_async,
        reason = "other engines note in the database which process serves it"
    )]
    pub(in crate::store) async fn beat(&self) -> Result<(), StoreError> {
        Ok(())
    }
}
