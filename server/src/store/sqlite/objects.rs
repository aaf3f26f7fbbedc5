//! Results of succeeded jobs in a store of objects. They are moved there after the end of the job, which waits for no other machine:
//! while the store of objects cannot be reached, results stay in the database and its folder.
//!
//! A key is noted as that of an unnamed object before the object is written, and is named in the transaction that removes the results
//! from the database; so no object is left without a name or without a note, whenever the process ends.

use std::path::PathBuf;

use api::results::ResultFile;
use futures_util::{StreamExt, stream};
use sqlx::{Row, Sqlite, Transaction};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::export::documents::JSON;
use crate::export::files::manifest_entry;
use crate::objects::{Objects, ObjectsError};
use crate::store::block::Block;
use crate::store::sqlite::blocks::{StoredBlock, unreadable};
use crate::store::sqlite::events::pack_events;
use crate::store::sqlite::files::entry;
use crate::store::sqlite::packed::{listed, pack};
use crate::store::sqlite::queries::{BEGIN, corrupt, integer};
use crate::store::{Store, StoreError};

/// Most jobs whose results are moved at once: they share two transactions. Arbitrary: more than a machine ends within a second.
const JOBS: i64 = 512;
/// Objects that are written at the same time. Arbitrary: an object takes some 10 to 100 ms.
const WRITES: usize = 16;

/// Results that were written to an object.
struct Moved {
    id: Uuid,
    key: String,
    /// The entries of the block before, and now.
    entries: (Vec<u8>, Vec<u8>),
    content_bytes: i64,
    /// Specification and plan, compressed, and the part of the specification that stays.
    documents: Vec<u8>,
    listed: String,
}

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
            (_, Some(given)) => {
                let mut transaction = self.writer.begin_with(BEGIN).await?;
                sqlx::query("DELETE FROM object_store")
                    .execute(&mut *transaction)
                    .await?;
                sqlx::query("INSERT INTO object_store (address) VALUES (?)")
                    .bind(given.location())
                    .execute(&mut *transaction)
                    .await?;
                transaction.commit().await?;
            }
        }
        self.objects = objects;
        Ok(self)
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
        let written = match self.write_objects(objects).await {
            Ok(written) => written,
            Err(error) => return (Vec::new(), Err(error)),
        };
        let (mut moved, mut failed) = (Vec::new(), Ok(()));
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
        self.remove_unnamed_objects(objects).await?;
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

    /// Writes the results of a job to an object; `None` if the job was deleted, or if a file of it is damaged.
    async fn write_object(
        &self,
        objects: &Objects,
        id: Uuid,
        key: String,
    ) -> Result<Option<Moved>, StoreError> {
        let mut connection = self.readers.acquire().await?;
        let Some(stored) = StoredBlock::of(&mut connection, id).await? else {
            return Ok(None);
        };
        let texts: Option<(String, String)> =
            sqlx::query_as("SELECT spec, plan FROM jobs WHERE id = ?")
                .bind(id.to_string())
                .fetch_optional(&mut *connection)
                .await?;
        let Some((spec, plan)) = texts else {
            return Ok(None);
        };
        let events = pack_events(&mut connection, id).await?;
        drop(connection);
        let (files, paths): (Vec<ResultFile>, Vec<(PathBuf, u64)>) =
            self.files_to_move(id).await?.into_iter().unzip();
        let head = [&stored.content[..], &events].concat();
        match objects.put(&key, &head, &paths).await {
            Ok(()) => {}
            Err(error @ ObjectsError::File { .. }) => {
                tracing::error!(job = %id, %error, "results stay in the database");
                self.keep_results(id).await?;
                return Ok(None);
            }
            Err(error) => return Err(error.into()),
        }
        let events = manifest_entry("events", None, JSON, &events);
        let entries = Block::with_files(&stored.entries, events, files);
        let entries = entries.map_err(|cause| unreadable(id, &cause))?;
        Ok(Some(Moved {
            id,
            key,
            content_bytes: integer(stored.content.len()),
            documents: pack(&spec, &plan),
            listed: listed(id, &spec)?,
            entries: (stored.entries, entries),
        }))
    }

    /// The files of a job's manifest, with their paths and lengths.
    async fn files_to_move(
        &self,
        id: Uuid,
    ) -> Result<Vec<(ResultFile, (PathBuf, u64))>, StoreError> {
        let rows = sqlx::query(
            "SELECT name, cycle, media_type, bytes, sha256, damaged, place FROM result_files \
             WHERE job_id = ? AND place IS NOT NULL ORDER BY name",
        )
        .bind(id.to_string())
        .fetch_all(&self.readers)
        .await?;
        let file = |row| {
            let (entry, place) = (entry(row)?, row.try_get::<&str, _>("place")?);
            let path = self.folder.path(place);
            let path = path.ok_or_else(|| corrupt(id, "path of a file", &place))?;
            let bytes = entry.bytes;
            Ok((entry, (path, bytes)))
        };
        rows.iter().map(file).collect()
    }

    /// Leaves the results of a job where they are.
    async fn keep_results(&self, id: Uuid) -> Result<(), StoreError> {
        sqlx::query("UPDATE result_blocks SET is_movable = 0 WHERE job_id = ?")
            .bind(id.to_string())
            .execute(&self.writer)
            .await?;
        Ok(())
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
    for statement in [
        "DELETE FROM result_files WHERE job_id = ?1 AND place IS NOT NULL",
        "DELETE FROM events WHERE job_id = ?1 AND seq < (SELECT last_event FROM jobs WHERE id = ?1)",
    ] {
        sqlx::query(statement)
            .bind(moved.id.to_string())
            .execute(&mut **transaction)
            .await?;
    }
    Ok(true)
}
