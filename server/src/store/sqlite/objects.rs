//! Results of succeeded jobs in a store of objects. They are moved there after the end of the job, which waits for no other machine:
//! while the store of objects cannot be reached, results stay in the database and its folder.
//!
//! A key is noted as that of an unnamed object before the object is written, and is named in the transaction that removes the results
//! from the database; so no object is left without a name or without a note, whenever the process ends.

use std::fmt::Display;

use futures_util::{StreamExt, stream};
use sqlx::{Sqlite, Transaction};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::objects::{Objects, ObjectsError};
use crate::store::sqlite::queries::BEGIN;
use crate::store::sqlite::results_to_move::{Moved, Prepared};
use crate::store::{Store, StoreError};

/// Most jobs whose results are moved at once: they share two transactions. Arbitrary: more than a machine ends within a second.
const JOBS: i64 = 512;
/// What leaves the database once a job (`?1`) has an object, beside the content of its block.
pub(super) const REMOVALS: [&str; 2] = [
    "DELETE FROM result_files WHERE job_id = ?1 AND place IS NOT NULL",
    "DELETE FROM events WHERE job_id = ?1 AND seq < (SELECT last_event FROM jobs WHERE id = ?1)",
];
/// Objects that are written at the same time. Arbitrary: an object takes some 10 to 100 ms.
const WRITES: usize = 8;

impl Store {
    /// Lets the store move results to a store of objects, or, without one, checks that none were moved.
    ///
    /// # Errors
    /// [`StoreError`], among others if results are in another one.
    pub async fn with_objects(mut self, objects: Option<Objects>) -> Result<Self, StoreError> {
        let stored: Option<String> = sqlx::query_scalar(
            "SELECT address FROM object_store WHERE EXISTS (SELECT 1 FROM result_blocks WHERE object IS NOT NULL) \
             OR EXISTS (SELECT 1 FROM unnamed_objects)",
        )
        .fetch_optional(&self.writer)
        .await?;
        match (&stored, &objects) {
            (None, None) => return Ok(self),
            (Some(_), None) => return Err(StoreError::NoObjects),
            (Some(stored), Some(given)) if stored != given.location() => {
                return Err(StoreError::OtherObjects {
                    stored: stored.clone(),
                    given: given.location().to_owned(),
                });
            }
            (_, Some(given)) => self.note_address(given.location()).await?,
        }
        self.objects = objects;
        Ok(self)
    }

    /// Notes the address of the store of objects.
    async fn note_address(&self, address: &str) -> Result<(), StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let updated = sqlx::query("UPDATE object_store SET address = ?")
            .bind(address)
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

    /// Moves results of succeeded jobs to the store of objects, of a limited number of jobs. Returns these jobs; their files are
    /// still there for requests that are reading them, until [`Store::remove_moved`].
    ///
    /// # Errors
    /// [`StoreError`] if the database or the store of objects fails; the results of other jobs are moved all the same.
    pub async fn move_results(&self) -> (Vec<Uuid>, Result<(), StoreError>) {
        let Some(objects) = &self.objects else {
            return (Vec::new(), Ok(()));
        };
        // Objects that cannot be removed keep no others from being written.
        let mut failed = self.remove_unnamed_objects(objects).await;
        let written = match self.write_objects(objects).await {
            Ok(written) => written,
            Err(error) => return (Vec::new(), Err(error)),
        };
        let mut moved = Vec::new();
        for written in written {
            match written {
                Ok(written) => moved.extend(written),
                Err(error) => failed = Err(error),
            }
        }
        match self.name_objects(&moved).await {
            Ok(named) => (named, failed),
            Err(error) => (Vec::new(), Err(error)),
        }
    }

    /// Writes the objects of a limited number of jobs.
    async fn write_objects(
        &self,
        objects: &Objects,
    ) -> Result<Vec<Result<Option<Moved>, StoreError>>, StoreError> {
        let jobs: Vec<Hyphenated> = sqlx::query_scalar(
            "SELECT job_id FROM result_blocks WHERE is_movable = 1 AND object IS NULL LIMIT ?",
        )
        .bind(JOBS)
        .fetch_all(&self.readers)
        .await?;
        if jobs.is_empty() {
            return Ok(Vec::new());
        }
        let keyed = jobs.into_iter().map(|id| {
            let key = format!("jobs/{id}/{}", Uuid::now_v7());
            (Uuid::from(id), key)
        });
        let keyed: Vec<_> = keyed.collect();
        self.note_unnamed(&keyed).await?;
        let writes = stream::iter(keyed).map(|(id, key)| self.write_object(objects, id, key));
        Ok(writes.buffer_unordered(WRITES).collect().await)
    }

    /// Removes the files of jobs whose results were moved.
    pub async fn remove_moved(&self, jobs: &[Uuid]) {
        for id in jobs {
            self.remove_files(*id).await;
        }
    }

    async fn remove_unnamed_objects(&self, objects: &Objects) -> Result<(), StoreError> {
        let keys: Vec<String> = sqlx::query_scalar("SELECT key FROM unnamed_objects LIMIT ?")
            .bind(JOBS)
            .fetch_all(&self.readers)
            .await?;
        if keys.is_empty() {
            return Ok(());
        }
        let removals = stream::iter(keys).map(async |key| {
            objects.remove(&key).await?;
            Ok::<_, ObjectsError>(key)
        });
        let removed: Vec<_> = removals.buffer_unordered(WRITES).collect().await;
        let (mut transaction, mut failed) = (self.writer.begin_with(BEGIN).await?, Ok(()));
        for key in removed {
            match key {
                Ok(key) => {
                    sqlx::query("DELETE FROM unnamed_objects WHERE key = ?")
                        .bind(key)
                        .execute(&mut *transaction)
                        .await?;
                }
                Err(error) => failed = Err(error.into()),
            }
        }
        transaction.commit().await?;
        failed
    }

    /// Notes the keys of objects that are about to be written.
    pub(in crate::store) async fn note_unnamed(
        &self,
        keyed: &[(Uuid, String)],
    ) -> Result<(), StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        for (_, key) in keyed {
            sqlx::query("INSERT INTO unnamed_objects (key) VALUES (?)")
                .bind(key)
                .execute(&mut *transaction)
                .await?;
        }
        Ok(transaction.commit().await?)
    }

    /// Writes the results of a job to an object; `None` if the job was deleted, or if its results are damaged, which then stay.
    async fn write_object(
        &self,
        objects: &Objects,
        id: Uuid,
        key: String,
    ) -> Result<Option<Moved>, StoreError> {
        let prepared = match self.prepare(id, key).await {
            Ok(Some(prepared)) => prepared,
            Ok(None) => return Ok(None),
            Err(error @ (StoreError::DamagedResults { .. } | StoreError::Corrupt { .. })) => {
                return self.keep_results(id, &error).await;
            }
            Err(error) => return Err(error),
        };
        let Prepared { moved, head, files } = prepared;
        match objects.put(&moved.key, &head, &files).await {
            Ok(()) => Ok(Some(moved)),
            Err(error @ ObjectsError::Damaged { .. }) => self.keep_results(id, &error).await,
            Err(error) => Err(error.into()),
        }
    }

    /// Leaves the results of a job where they are.
    async fn keep_results(
        &self,
        id: Uuid,
        cause: &(impl Display + Sync),
    ) -> Result<Option<Moved>, StoreError> {
        tracing::error!(job = %id, error = %cause, "results stay in the database");
        sqlx::query("UPDATE result_blocks SET is_movable = 0 WHERE job_id = ?")
            .bind(id.to_string())
            .execute(&self.writer)
            .await?;
        Ok(None)
    }

    /// Names the objects and removes the results from the database, unless they have changed meanwhile. Returns the jobs.
    async fn name_objects(&self, moved: &[Moved]) -> Result<Vec<Uuid>, StoreError> {
        let write = async || {
            let mut named = Vec::with_capacity(moved.len());
            let mut transaction = self.writer.begin_with(BEGIN).await?;
            for results in moved {
                if name_object(&mut transaction, results).await? {
                    named.push(results.id);
                }
            }
            transaction.commit().await?;
            Ok(named)
        };
        self.disk.with_reserve(write).await
    }
}

/// Names an object in a transaction; false if the results are not those any more that it has.
async fn name_object(
    transaction: &mut Transaction<'_, Sqlite>,
    moved: &Moved,
) -> Result<bool, StoreError> {
    let updated = sqlx::query(
        "UPDATE result_blocks SET content = x'', object = ?, content_bytes = ?, entries = ?, documents = ? \
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
    sqlx::query("DELETE FROM unnamed_objects WHERE key = ?")
        .bind(&moved.key)
        .execute(&mut **transaction)
        .await?;
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
