//! Statements about objects: their keys, and the process that moves results there.

use sqlx::Connection;
use sqlx::postgres::PgConnection;

use crate::store::StoreError;
use crate::store::checkpoint_object::REMOVED_AFTER_MS;
use crate::store::postgres::open::refuse_standby;
use crate::store::postgres::{PostgresStore, begin};

/// Key of the lock of the process that moves results: `frtw` in ASCII.
const MOVER: i64 = 0x6672_7477;

impl PostgresStore {
    pub(in crate::store) async fn address_of_objects(&self) -> Result<Option<String>, StoreError> {
        let stored = sqlx::query_scalar(
            "SELECT address FROM object_store WHERE EXISTS (SELECT 1 FROM result_blocks WHERE object IS NOT NULL) \
             OR EXISTS (SELECT 1 FROM checkpoints WHERE object IS NOT NULL) OR EXISTS (SELECT 1 FROM result_files WHERE object IS NOT NULL) \
             OR is_marked AND EXISTS (SELECT 1 FROM unnamed_objects)",
        );
        Ok(stored.fetch_optional(&self.writer).await?)
    }

    pub(in crate::store) async fn note_address_of_objects(
        &self,
        address: &str,
    ) -> Result<(), StoreError> {
        let mut transaction = begin(&self.writer, None).await?;
        // Two processes that start together must not write two rows.
        sqlx::query("LOCK TABLE object_store IN EXCLUSIVE MODE")
            .execute(&mut *transaction)
            .await?;
        let owner = identity(&mut transaction).await?;
        let before: Option<Option<String>> = sqlx::query_scalar("SELECT owner FROM object_store")
            .fetch_optional(&mut *transaction)
            .await?;
        if let Some(Some(before)) = &before
            && *before != owner
        {
            // As of a copied file.
            tracing::warn!(
                "this database is a copy: objects of its jobs are not removed; once the original is gone, \
                 UPDATE object_store SET removes = true"
            );
            sqlx::query("WITH notes AS (DELETE FROM unnamed_objects) UPDATE object_store SET removes = false")
                .execute(&mut *transaction)
                .await?;
        }
        sqlx::query(
            "WITH updated AS (UPDATE object_store SET is_marked = is_marked AND address = $1, address = $1, owner = $2 RETURNING 1) \
             INSERT INTO object_store (address, owner) SELECT $1, $2 WHERE NOT EXISTS (SELECT 1 FROM updated)",
        )
        .bind(address)
        .bind(owner)
        .execute(&mut *transaction)
        .await?;
        Ok(transaction.commit().await?)
    }

    /// The process that holds a lock moves results, as long as its connection lives. Another one may take over while this one still
    /// writes objects: what it is about to remove cannot be named any more.
    pub(in crate::store) async fn moves_results(&self) -> Result<bool, StoreError> {
        let mut mover = self.mover.lock().await;
        let kept = match mover.take() {
            Some((connection, is_mover)) => {
                answering(connection).await.map(|kept| (kept, is_mover))
            }
            None => None,
        };
        let mut connection = match kept {
            Some((connection, true)) => {
                *mover = Some((connection, true));
                return Ok(true);
            }
            Some((connection, false)) => connection,
            None => {
                let mut connection =
                    PgConnection::connect_with(&self.writer.connect_options()).await?;
                refuse_standby(&mut connection).await?;
                connection
            }
        };
        let is_mover: bool = sqlx::query_scalar("SELECT pg_try_advisory_lock($1)")
            .bind(MOVER)
            .fetch_one(&mut connection)
            .await?;
        *mover = Some((connection, is_mover));
        Ok(is_mover)
    }

    pub(in crate::store) async fn note_unnamed(&self, keys: &[String]) -> Result<(), StoreError> {
        sqlx::query("INSERT INTO unnamed_objects (key) SELECT * FROM unnest($1::text[])")
            .bind(keys)
            .execute(&self.writer)
            .await?;
        Ok(())
    }

    pub(in crate::store) async fn take_unnamed(
        &self,
        most: i64,
    ) -> Result<Vec<String>, StoreError> {
        let keys = sqlx::query_scalar(
            "UPDATE unnamed_objects SET is_removing = true WHERE key IN \
             (SELECT key FROM unnamed_objects WHERE noted_at <= fretwear_now() - $1 \
             AND NOT EXISTS (SELECT 1 FROM result_blocks WHERE object = key) \
             AND NOT EXISTS (SELECT 1 FROM checkpoints WHERE object = key) \
             AND NOT EXISTS (SELECT 1 FROM result_files WHERE object = key) LIMIT $2) RETURNING key",
        )
        .bind(REMOVED_AFTER_MS)
        .bind(most);
        Ok(keys.fetch_all(&self.writer).await?)
    }

    pub(in crate::store) async fn forget_unnamed(&self, keys: &[String]) -> Result<(), StoreError> {
        sqlx::query("DELETE FROM unnamed_objects WHERE key = ANY($1)")
            .bind(keys)
            .execute(&self.writer)
            .await?;
        Ok(())
    }
}

/// Identity of a database that its copies do not share: the server that it was made on, where its role may read that, and its number
/// there. A standby that is promoted has the same.
pub(super) async fn identity(connection: &mut PgConnection) -> Result<String, StoreError> {
    let (number, may_read): (String, bool) = sqlx::query_as(
        "SELECT oid::text, has_function_privilege('pg_catalog.pg_control_system()', 'EXECUTE') \
         FROM pg_database WHERE datname = current_database()",
    )
    .fetch_one(&mut *connection)
    .await?;
    if !may_read {
        return Ok(number);
    }
    let server: String =
        sqlx::query_scalar("SELECT system_identifier::text FROM pg_control_system()")
            .fetch_one(connection)
            .await?;
    Ok(format!("{server}/{number}"))
}

/// A connection if it still answers.
async fn answering(mut connection: PgConnection) -> Option<PgConnection> {
    connection.ping().await.is_ok().then_some(connection)
}
