//! Results of succeeded jobs in a store of objects. They are moved there after the end of the job, which waits for no other machine:
//! while the store of objects cannot be reached, results stay in the database and its folder.
//!
//! A key is noted as that of an unnamed object before the object is written, and is named in the transaction that removes the results
//! from the database; so no object is left without a name or without a note, whenever the process ends. One process moves at a time.

use std::collections::HashMap;
use std::fmt::Display;
use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::Duration;

use futures_util::{StreamExt, stream};
use tokio::sync::Semaphore;
use uuid::Uuid;

use crate::objects::{ObjectFile, Objects, ObjectsError, Source};
use crate::store::results_to_move::{Moved, Prepared, Stored, StoredFile};
use crate::store::rows::integer;
use crate::store::{Content, Store, StoreError};

/// Most jobs whose results are moved at once: they share two transactions. Arbitrary: more than a machine ends within a second.
const JOBS: usize = 512;
/// Most of them that are read at once, into memory.
const READ: usize = 32;
/// Objects that are written at the same time. Arbitrary: an object takes some 10 to 100 ms.
const WRITES: usize = 32;
/// Longest wait for the store of objects at the start.
const LONGEST_TEST: Duration = Duration::from_secs(5);
/// Largest number of jobs with files that are written at once: their parts are in memory; one alone where files are in rows.
const LARGE_WRITES: usize = 4;

impl Store {
    /// Lets the store move results to a store of objects, or, without one, checks that none were moved.
    ///
    /// # Errors
    /// [`StoreError`], among others if results are in another one.
    pub async fn with_objects(mut self, objects: Option<Objects>) -> Result<Self, StoreError> {
        let stored = self.address_of_objects().await?;
        match (&stored, &objects) {
            (None, None) => return Ok(self),
            (Some(_), None) => return Err(StoreError::NoObjects),
            (Some(stored), Some(given)) if stored != given.location() => {
                return Err(StoreError::OtherObjects {
                    stored: stored.clone(),
                    given: given.location().to_owned(),
                });
            }
            (_, Some(given)) => self.note_address_of_objects(given.location()).await?,
        }
        self.process_mut().objects = objects;
        self.process_mut().removes_objects = self.removes_objects().await?;
        Ok(self)
    }

    /// Makes sure that the store of objects is that of this database, before it writes or removes objects: it has a mark, which it gets the first
    /// time.
    ///
    /// # Errors
    /// [`StoreError`], among others if it has lost the mark.
    pub(in crate::store) async fn check_mark(&self, objects: &Objects) -> Result<(), StoreError> {
        let check = async || {
            let address = objects.location();
            if !self.are_objects_marked(address).await? {
                // An earlier version has written objects without a mark: they show that it is the store.
                if let Some(key) = self.any_object().await? {
                    objects.get(&key, 0..1).await?;
                }
                objects.mark().await?;
                if self.note_mark_of_objects(address).await? {
                    return Ok(());
                }
                return Err(StoreError::OtherObjects {
                    stored: self.address_of_objects().await?.unwrap_or_default(),
                    given: address.to_owned(),
                });
            }
            if objects.is_marked().await? {
                return Ok(());
            }
            Err(ObjectsError::Unmarked(address.to_owned()).into())
        };
        self.process()
            .objects_checked
            .get_or_try_init(check)
            .await?;
        Ok(())
    }

    /// Reads and writes the mark of the store of objects, to find settings that it refuses. Any other error is logged: results wait in the database
    /// until the store answers.
    ///
    /// # Errors
    /// [`StoreError`] for settings that it refuses.
    pub async fn test_objects(&self) -> Result<(), StoreError> {
        let Some(objects) = &self.process().objects else {
            return Ok(());
        };
        let test = async {
            self.check_mark(objects).await?;
            // A restored copy may read only.
            if self.moves_results().await? {
                objects.mark().await?;
            }
            Ok(())
        };
        let tested = tokio::time::timeout(LONGEST_TEST, test).await;
        let no_answer = |_| {
            let cause = format!("no answer within {LONGEST_TEST:?}");
            Err(objects.failed(cause).into())
        };
        match tested.unwrap_or_else(no_answer) {
            Err(StoreError::Objects(error)) if error.is_of_settings() => Err(error.into()),
            Err(error) => {
                tracing::error!(%error, objects = objects.location(), "the store of objects cannot be used at present");
                Ok(())
            }
            Ok(()) => Ok(()),
        }
    }

    /// Moves results of succeeded jobs to the store of objects, of a limited number of jobs. Returns these jobs; their files are
    /// still there for requests that are reading them, until [`Store::remove_moved`].
    ///
    /// # Errors
    /// [`StoreError`] if the database or the store of objects fails; the results of other jobs are moved all the same.
    pub async fn move_results(&self) -> (Vec<Uuid>, Result<(), StoreError>) {
        let Some(objects) = &self.process().objects else {
            return (Vec::new(), Ok(()));
        };
        match self.moves_results().await {
            Ok(true) => {}
            Ok(false) => return (Vec::new(), Ok(())),
            Err(error) => return (Vec::new(), Err(error)),
        }
        // Objects that cannot be removed keep no others from being written.
        let mut failed = self.remove_unnamed_objects(objects).await;
        let written = match self.write_objects(objects, JOBS).await {
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

    /// Removes the files of jobs whose results were moved.
    pub async fn remove_moved(&self, jobs: &[Uuid]) {
        for id in jobs {
            self.process().remove_files(*id).await;
        }
    }

    /// Writes the objects of a limited number of jobs.
    pub(in crate::store) async fn write_objects(
        &self,
        objects: &Objects,
        most: usize,
    ) -> Result<Vec<Result<Option<Moved>, StoreError>>, StoreError> {
        let jobs = self.jobs_to_move(most).await?;
        if jobs.is_empty() {
            return Ok(Vec::new());
        }
        self.check_mark(objects).await?;
        let key = |id| format!("jobs/{id}/{}", Uuid::now_v7());
        let keys: Vec<String> = jobs.iter().map(key).collect();
        self.note_unnamed(&keys).await?;
        let keys: HashMap<Uuid, String> = jobs.iter().copied().zip(keys).collect();
        let large = Semaphore::new(LARGE_WRITES);
        let parts: Vec<_> = jobs.chunks(READ).map(<[Uuid]>::to_vec).collect();
        let read = stream::iter(parts).then(|jobs| self.read(jobs));
        let stored = read.flat_map(stream::iter).boxed();
        let writes = stored.map(async |stored| {
            let stored = stored?;
            let key = keys.get(&stored.id).ok_or(StoreError::Unwritten)?;
            self.write_object(objects, &large, stored, key.clone())
                .await
        });
        Ok(writes.buffer_unordered(WRITES).collect().await)
    }

    /// The next jobs whose results are to be moved, in a circle: those that cannot be moved keep no others from it.
    async fn jobs_to_move(&self, most: usize) -> Result<Vec<Uuid>, StoreError> {
        let mut last = self.process().last_moved.lock().await;
        let jobs = self.movable_jobs(*last, integer(most)).await?;
        let may_be_more = jobs.len() >= most;
        *last = jobs
            .last()
            .copied()
            .filter(|_| may_be_more)
            .unwrap_or_default();
        Ok(jobs)
    }

    /// Reads the results of jobs.
    async fn read(&self, jobs: Vec<Uuid>) -> Vec<Result<Stored, StoreError>> {
        match self.results_to_move(&jobs).await {
            Ok(stored) => stored.into_iter().map(Ok).collect(),
            Err(error) => vec![Err(error)],
        }
    }

    async fn remove_unnamed_objects(&self, objects: &Objects) -> Result<(), StoreError> {
        let keys = self.take_unnamed(integer(JOBS)).await?;
        if keys.is_empty() {
            return Ok(());
        }
        self.check_mark(objects).await?;
        let removals = stream::iter(keys).map(async |key| {
            objects.remove(&key).await?;
            Ok::<_, ObjectsError>(key)
        });
        let removals: Vec<_> = removals.buffer_unordered(WRITES).collect().await;
        let (mut removed, mut failed) = (Vec::with_capacity(removals.len()), Ok(()));
        for key in removals {
            match key {
                Ok(key) => removed.push(key),
                Err(error) => failed = Err(error.into()),
            }
        }
        self.forget_unnamed(&removed).await?;
        failed
    }

    /// Writes the results of a job to an object; `None` if they are damaged, and then stay.
    async fn write_object(
        &self,
        objects: &Objects,
        large: &Semaphore,
        stored: Stored,
        key: String,
    ) -> Result<Option<Moved>, StoreError> {
        let id = stored.id;
        let prepared = match stored.prepare(key).await {
            Ok(prepared) => prepared,
            Err(error @ (StoreError::DamagedResults { .. } | StoreError::Corrupt { .. })) => {
                return self.kept(id, &error).await;
            }
            Err(error) => return Err(error),
        };
        let Prepared { moved, head, files } = prepared;
        let writes = match &files[..] {
            [] => 0,
            files if files.iter().any(|file| file.source.is_none()) => LARGE_WRITES,
            _ => 1,
        };
        let writes = u32::try_from(writes).unwrap_or(1);
        let _large = large.acquire_many(writes).await.ok();
        let files = self.object_files(id, files).await?;
        match objects.put(&moved.key, &head, &files).await {
            Ok(()) => Ok(Some(moved)),
            Err(error @ ObjectsError::Damaged { .. }) if self.has_folders_of(&files) => {
                self.kept(id, &error).await
            }
            Err(error @ ObjectsError::Damaged { .. }) if self.is_shared() => {
                if !self
                    .process()
                    .has_unseen_files
                    .swap(true, Ordering::Relaxed)
                {
                    tracing::warn!(job = %id, %error, "files of jobs may be in the folder of another service; they stay there");
                }
                Ok(None)
            }
            Err(error) => Err(error.into()),
        }
    }

    /// The files of a job as they are written, those of rows in memory.
    async fn object_files(
        &self,
        id: Uuid,
        files: Vec<StoredFile>,
    ) -> Result<Vec<ObjectFile>, StoreError> {
        let mut found = Vec::with_capacity(files.len());
        for StoredFile { entry, source } in files {
            let source = match source {
                Some(source) => source,
                None => match self.file_row(id, &entry.name).await? {
                    Some((_, Content::Inline(bytes))) => Source::Bytes(bytes.into()),
                    _ => return Err(StoreError::LostFile(entry.name)),
                },
            };
            found.push(ObjectFile {
                source,
                bytes: entry.bytes,
                sha256: entry.sha256,
            });
        }
        Ok(found)
    }

    /// Returns `true` if a file that is missing is lost: the folder may not be mounted, or may be that of another service.
    fn has_folders_of(&self, files: &[ObjectFile]) -> bool {
        let has_folder = |file: &ObjectFile| match &file.source {
            Source::File(path) if self.is_shared() => path.parent().is_some_and(Path::is_dir),
            Source::File(_) => self.process().folder.exists(),
            Source::Object(_) | Source::Bytes(_) => true,
        };
        files.iter().all(has_folder)
    }

    /// Leaves the results of a job where they are.
    async fn kept(
        &self,
        id: Uuid,
        cause: &(impl Display + Sync),
    ) -> Result<Option<Moved>, StoreError> {
        tracing::error!(job = %id, error = %cause, "results stay in the database");
        self.keep_results(id).await?;
        Ok(None)
    }
}
