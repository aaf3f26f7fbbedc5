//! Statements about objects: their keys, and the removal of rows that an object replaces.

use sqlx::{Sqlite, Transaction};
use uuid::Uuid;

use crate::clock::monotonic_ms;
use crate::store::StoreError;
use crate::store::checkpoint_object::REMOVED_AFTER_MS;
use crate::store::results_to_move::Moved;
use crate::store::sqlite::SqliteStore;

/// Statements that delete the rows of a job (`?1`) that its object replaces, beside the content of its block.
pub(super) const REMOVALS: [&str; 2] = [
    "DELETE FROM result_files WHERE job_id = ?1 AND place IS NOT NULL",
    "DELETE FROM events WHERE job_id = ?1 AND seq < (SELECT last_event FROM jobs WHERE id = ?1)",
];

impl SqliteStore {
    pub(in crate::store) async fn address_of_objects(&self) -> Result<Option<String>, StoreError> {
        let stored = sqlx::query_scalar(
            "SELECT address FROM object_store WHERE EXISTS (SELECT 1 FROM result_blocks WHERE object IS NOT NULL) \
             OR EXISTS (SELECT 1 FROM checkpoints WHERE object IS NOT NULL) OR is_marked AND EXISTS (SELECT 1 FROM unnamed_objects)",
        );
        Ok(stored.fetch_optional(&self.writer).await?)
    }

    pub(in crate::store) async fn note_address_of_objects(
        &self,
        address: &str,
    ) -> Result<(), StoreError> {
        let (mut transaction, _) = self.begin().await?;
        let updated = sqlx::query(
            "UPDATE object_store SET address = ?1, is_marked = is_marked AND address = ?1",
        )
        .bind(address)
        .execute(&mut *transaction)
        .await?;
        // An earlier process has ended: no object that it noted is still being written.
        sqlx::query("UPDATE unnamed_objects SET noted_at = 0")
            .execute(&mut *transaction)
            .await?;
        if updated.rows_affected() == 0 {
            sqlx::query("INSERT INTO object_store (address) VALUES (?)")
                .bind(address)
                .execute(&mut *transaction)
                .await?;
        }
        Ok(transaction.commit().await?)
    }

    #[expect(
        clippy::unused_async,
        reason = "the process that serves a file is the only one; other engines ask their database"
    )]
    pub(in crate::store) async fn moves_results(&self) -> Result<bool, StoreError> {
        Ok(true)
    }

    pub(in crate::store) async fn note_unnamed(&self, keys: &[String]) -> Result<(), StoreError> {
        let (mut transaction, _) = self.begin().await?;
        for key in keys {
            sqlx::query("INSERT INTO unnamed_objects (key) VALUES (?)")
                .bind(key)
                .execute(&mut *transaction)
                .await?;
        }
        Ok(transaction.commit().await?)
    }

    pub(in crate::store) async fn take_unnamed(
        &self,
        most: i64,
    ) -> Result<Vec<String>, StoreError> {
        let keys = sqlx::query_scalar(
            "SELECT key FROM unnamed_objects WHERE noted_at <= ? \
                 AND NOT EXISTS (SELECT 1 FROM result_blocks WHERE object = key) \
                 AND NOT EXISTS (SELECT 1 FROM checkpoints WHERE object = key) LIMIT ?",
        )
        .bind(monotonic_ms() - REMOVED_AFTER_MS)
        .bind(most);
        Ok(keys.fetch_all(&self.readers).await?)
    }

    pub(in crate::store) async fn forget_unnamed(&self, keys: &[String]) -> Result<(), StoreError> {
        let (mut transaction, _) = self.begin().await?;
        for key in keys {
            forget(&mut transaction, key).await?;
        }
        Ok(transaction.commit().await?)
    }

    pub(in crate::store) async fn name_objects(
        &self,
        moved: &[Moved],
    ) -> Result<Vec<Uuid>, StoreError> {
        let write = async || {
            let mut named = Vec::with_capacity(moved.len());
            let (mut transaction, _) = self.begin().await?;
            for results in moved {
                if name_object(&mut transaction, results).await? {
                    named.push(results.id);
                }
            }
            transaction.commit().await?;
            Ok(named)
        };
        self.process.disk.with_reserve(write).await
    }
}

/// Removes the note of an unnamed object.
async fn forget(transaction: &mut Transaction<'_, Sqlite>, key: &str) -> Result<(), StoreError> {
    sqlx::query("DELETE FROM unnamed_objects WHERE key = ?")
        .bind(key)
        .execute(&mut **transaction)
        .await?;
    Ok(())
}

/// Names an object in a transaction; false if the results are not those any more that it has.
async fn name_object(
    transaction: &mut Transaction<'_, Sqlite>,
    moved: &Moved,
) -> Result<bool, StoreError> {
    // Behind the other rows, short ones share a page; where the content was, a page would stay half empty.
    let updated = sqlx::query(
        "UPDATE result_blocks SET rowid = (SELECT max(rowid) + 1 FROM result_blocks), content = x'', object = ?, \
         content_bytes = ?, entries = ?, documents = ? \
         WHERE job_id = ? AND entries = ? AND is_movable = 1 AND object IS NULL",
    )
    .bind(&moved.key)
    .bind(moved.content_bytes)
    .bind(&moved.entries.1)
    .bind(&moved.documents)
    .bind(moved.id.to_string())
    .bind(&moved.entries.0)
    .execute(&mut **transaction)
    .await?;
    if updated.rows_affected() == 0 {
        return Ok(false);
    }
    forget(transaction, &moved.key).await?;
    sqlx::query("UPDATE jobs SET spec = ?, plan = 'null' WHERE id = ?")
        .bind(&moved.listed)
        .bind(moved.id.to_string())
        .execute(&mut **transaction)
        .await?;
    for statement in REMOVALS {
        sqlx::query(statement)
            .bind(moved.id.to_string())
            .execute(&mut **transaction)
            .await?;
    }
    Ok(true)
}
