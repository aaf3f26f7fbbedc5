//! Names of objects, which take the place of the results that they have: for several jobs in one transaction, whose statements are over all
//! of them.

use std::collections::HashSet;

use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::objects::Objects;
use crate::store::StoreError;
use crate::store::postgres::{PostgresStore, begin};
use crate::store::results_to_move::Moved;

impl PostgresStore {
    pub(in crate::store) async fn name_objects(
        &self,
        moved: &[Moved],
    ) -> Result<Vec<Uuid>, StoreError> {
        let error = match self.name_together(moved).await {
            Ok(named) => return Ok(named),
            Err(error) => error,
        };
        tracing::warn!(%error, jobs = moved.len(), "results were not moved together");
        let mut named = Vec::with_capacity(moved.len());
        for results in moved {
            match self.name_together(std::slice::from_ref(results)).await {
                Ok(alone) => named.extend(alone),
                // Results that were named so far stay moved; the others follow in a later call.
                Err(error) if !named.is_empty() => {
                    tracing::warn!(%error, "results of a job were not moved");
                    return Ok(named);
                }
                Err(error) => return Err(error),
            }
        }
        Ok(named)
    }

    /// Names objects in one transaction; returns the jobs whose results are still those that their objects have. Objects that are being
    /// removed are not named.
    async fn name_together(&self, moved: &[Moved]) -> Result<Vec<Uuid>, StoreError> {
        let mut transaction = begin(&self.writer, None).await?;
        lock(&mut transaction, moved).await?;
        let noted = forget(&mut transaction, moved).await?;
        let (noted, mut unnamed): (Vec<&Moved>, Vec<_>) = moved
            .iter()
            .partition(|results| noted.contains(&results.key));
        let address = self.process.objects.as_ref().map(Objects::location);
        let named = name(&mut transaction, &noted, address).await?;
        // Another process has taken them for ones that are left, and they may have been written after their removal; or the results have changed.
        unnamed.extend(noted.iter().filter(|results| !named.contains(&results.id)));
        note(&mut transaction, &unnamed).await?;
        let named_results: Vec<_> = noted
            .into_iter()
            .filter(|results| named.contains(&results.id))
            .collect();
        remove_results(&mut transaction, &named_results).await?;
        transaction.commit().await?;
        Ok(named_results.iter().map(|results| results.id).collect())
    }
}

/// Locks the rows of jobs, in the order of their ids.
async fn lock(connection: &mut PgConnection, moved: &[Moved]) -> Result<(), StoreError> {
    let ids: Vec<_> = moved.iter().map(|results| results.id).collect();
    sqlx::query("SELECT 1 FROM jobs WHERE id = ANY($1) ORDER BY id FOR UPDATE")
        .bind(ids)
        .execute(connection)
        .await?;
    Ok(())
}

/// Removes the notes of objects that get names; returns their keys.
async fn forget(
    connection: &mut PgConnection,
    moved: &[Moved],
) -> Result<HashSet<String>, StoreError> {
    let keys: Vec<_> = moved.iter().map(|results| results.key.as_str()).collect();
    let noted: Vec<String> = sqlx::query_scalar(
        "DELETE FROM unnamed_objects WHERE key = ANY($1) AND NOT is_removing RETURNING key",
    )
    .bind(keys)
    .fetch_all(connection)
    .await?;
    Ok(noted.into_iter().collect())
}

/// Notes objects that get no names; not those that have got theirs before, by a transaction whose answer was lost.
async fn note(connection: &mut PgConnection, moved: &[&Moved]) -> Result<(), StoreError> {
    if moved.is_empty() {
        return Ok(());
    }
    let keys: Vec<_> = moved.iter().map(|results| results.key.as_str()).collect();
    sqlx::query(
        "INSERT INTO unnamed_objects (key) SELECT key FROM unnest($1::text[]) AS given (key) \
         WHERE NOT EXISTS (SELECT 1 FROM result_blocks WHERE object = given.key) ON CONFLICT DO NOTHING",
    )
    .bind(keys)
    .execute(connection)
    .await?;
    Ok(())
}

/// Puts the names of objects in place of the contents of blocks that have not changed; returns the jobs.
async fn name(
    connection: &mut PgConnection,
    moved: &[&Moved],
    address: Option<&str>,
) -> Result<HashSet<Uuid>, StoreError> {
    fn each<'a, T>(moved: &[&'a Moved], value: impl Fn(&'a Moved) -> T) -> Vec<T> {
        moved.iter().map(|results| value(results)).collect()
    }
    let named: Vec<Uuid> = sqlx::query_scalar(
        "UPDATE result_blocks SET content = '', object = given.key, content_bytes = given.bytes, entries = given.after, \
         documents = given.documents \
         FROM unnest($1::uuid[], $2::text[], $3::bigint[], $4::bytea[], $5::bytea[], $6::bytea[]) \
         AS given (id, key, bytes, before, after, documents) \
         WHERE job_id = given.id AND entries = given.before AND is_movable AND object IS NULL \
         AND EXISTS (SELECT 1 FROM object_store WHERE address = $7) RETURNING job_id",
    )
    .bind(each(moved, |results| results.id))
    .bind(each(moved, |results| results.key.as_str()))
    .bind(each(moved, |results| results.content_bytes))
    .bind(each(moved, |results| &results.entries.0[..]))
    .bind(each(moved, |results| &results.entries.1[..]))
    .bind(each(moved, |results| &results.documents[..]))
    .bind(address)
    .fetch_all(connection)
    .await?;
    Ok(named.into_iter().collect())
}

/// Removes what the objects of jobs have, beside the contents of blocks.
async fn remove_results(connection: &mut PgConnection, moved: &[&Moved]) -> Result<(), StoreError> {
    let ids: Vec<_> = moved.iter().map(|results| results.id).collect();
    let listed: Vec<_> = moved.iter().map(|results| &results.listed[..]).collect();
    sqlx::query(
        "WITH texts AS (UPDATE jobs SET spec = given.listed, plan = 'null' \
         FROM unnest($1::uuid[], $2::text[]) AS given (id, listed) WHERE jobs.id = given.id), \
         files AS (DELETE FROM result_files WHERE job_id = ANY($1)) \
         DELETE FROM events USING jobs WHERE job_id = ANY($1) AND jobs.id = job_id AND seq < last_event",
    )
    .bind(ids)
    .bind(listed)
    .execute(connection)
    .await?;
    Ok(())
}
