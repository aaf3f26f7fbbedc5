//! Files of attempts in a store of objects, where several services have one: they need no folder in common.
//!
//! A file is written to an object before the update that names it, by the service that gets it from a remote worker, or by that of
//! the worker. Its key is noted first, and the note is removed in the transaction of the update. While the store of objects takes none,
//! the note has the content, and the update takes it from there, so that no job waits for the store but one with a larger file. A
//! succeeded job's files are moved into its one object with its other results.

use std::borrow::Cow;
use std::time::Duration;

use tempfile::TempPath;
use tokio::sync::SemaphorePermit;
use tokio::time::timeout;

use crate::objects::{ObjectFile, Objects, ObjectsError, Source};
use crate::store::file_key;
use crate::store::process_state::FILE_WRITES_MB;
use crate::store::{JobUpdate, Lease, LeaseState, NewContent, NewFile, Store, StoreError};

/// Longest time between the end of the writing of a file and the update that names it: the other files of the update are sent meanwhile. Later it
/// is removed, and the update is refused until the file has been sent again. Arbitrary.
const NAMED_WITHIN: Duration = Duration::from_hours(24);
/// Longest time for an object: of an empty one, for each further MB, and of any. The worker waits for it.
const LONGEST: [Duration; 3] = [
    Duration::from_secs(3),
    Duration::from_millis(500),
    Duration::from_secs(20),
];
/// Longest wait for memory.
const LONGEST_WAIT: Duration = Duration::from_secs(10);
/// Most memory of a file that is written, MB: it is written in parts.
const MOST_MB: u32 = 16;
/// Largest file that the database takes, bytes; a larger one waits for the store of objects. Fields of the largest models so far have 15 MB.
const LARGEST: u64 = 64 << 20;
/// Memory of such a file, MB.
const LARGEST_MB: u32 = 65;
/// Longest time for an object of a larger one.
const LONGEST_OF_LARGE: Duration = Duration::from_mins(10);

/// Longest time for an object of so many bytes.
fn longest(bytes: u64) -> Duration {
    if bytes > LARGEST {
        return LONGEST_OF_LARGE;
    }
    let [least, each, most] = LONGEST;
    most.min(least + each.saturating_mul(megabytes(bytes)))
}

/// Whole MB of some bytes.
fn megabytes(bytes: u64) -> u32 {
    u32::try_from(bytes >> 20).unwrap_or(u32::MAX)
}

/// Why a large file is not written yet.
fn large(bytes: u64, error: StoreError) -> StoreError {
    match error {
        StoreError::Objects(ObjectsError::Store { location, cause }) => {
            let (file, most) = (megabytes(bytes), megabytes(LARGEST));
            let cause = format!(
                "{cause}; a file of {file} MB waits for it, since the database takes {most} MB at most"
            );
            StoreError::Objects(ObjectsError::Store {
                location,
                cause: cause.into(),
            })
        }
        error => error,
    }
}

impl Store {
    /// Returns `true` if files of attempts are objects.
    pub fn has_files_as_objects(&self) -> bool {
        self.objects_of_files().is_some()
    }

    /// Creates a file to receive into; it is removed when it is dropped.
    ///
    /// # Errors
    /// If it cannot be created.
    pub fn received_file(&self) -> std::io::Result<TempPath> {
        self.process().folder.received()
    }

    /// Writes a file of an attempt to an object; its key.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails, or if the file is large and the store of objects fails.
    pub async fn put_file(&self, lease: Lease, file: &ObjectFile) -> Result<String, StoreError> {
        let objects = self.objects_of_files().ok_or(StoreError::NoObjects)?;
        self.disk().check()?;
        let Lease { job, number } = lease;
        let key = file_key::new(job, number);
        self.note_object(&key).await?;
        let (content, _memory) = match self.put_in_time(objects, &key, file).await {
            Ok(()) => (None, None),
            Err(error @ StoreError::Objects(ObjectsError::Damaged { .. })) => return Err(error),
            Err(error) if file.bytes > LARGEST => return Err(large(file.bytes, error)),
            Err(_) => {
                let memory = self.memory_of(file, LARGEST_MB).await;
                (Some(file.read().await?), memory)
            }
        };
        let kept = self.keep_object(&key, content.as_deref(), NAMED_WITHIN);
        if kept.await? {
            return Ok(key);
        }
        // The note is too old: the object may have been written after its removal.
        objects.remove(&key).await?;
        Err(StoreError::LostFile(key))
    }

    /// Writes a file to an object, unless that takes too long or has failed a short time ago.
    async fn put_in_time(
        &self,
        objects: &Objects,
        key: &str,
        file: &ObjectFile,
    ) -> Result<(), StoreError> {
        self.check_circuit(objects, LONGEST[0]).await?;
        let Ok(_memory) = timeout(LONGEST_WAIT, self.memory_of(file, MOST_MB)).await else {
            let cause = format!("files of {FILE_WRITES_MB} MB are being written");
            return Err(objects.failed(cause).into());
        };
        let put = Box::pin(objects.put(key, &[], std::slice::from_ref(file)));
        self.write_in_time(objects, longest(file.bytes), put).await
    }

    /// Waits for memory for a file, up to a limit.
    async fn memory_of(&self, file: &ObjectFile, most_mb: u32) -> Option<SemaphorePermit<'_>> {
        let megabytes = most_mb.min(megabytes(file.bytes).saturating_add(1));
        let memory = self.process().file_writes.acquire_many(megabytes);
        memory.await.ok()
    }

    /// An update whose files are in objects, if they belong there.
    pub(in crate::store) async fn with_file_objects<'a>(
        &self,
        lease: Lease,
        update: &'a JobUpdate,
    ) -> Result<Cow<'a, JobUpdate>, StoreError> {
        let is_in_folder = |file: &NewFile| file.content == NewContent::Folder;
        if self.objects_of_files().is_none()
            || !update.files.iter().any(is_in_folder)
            // The files of a repeated end are no longer there, and it has no effect.
            || self.lease_state(lease).await? == LeaseState::Lost
        {
            return Ok(Cow::Borrowed(update));
        }
        let mut update = update.clone();
        let folder = self.attempt_folder(lease);
        for NewFile { file, content } in update.largest_files_first() {
            if *content != NewContent::Folder {
                continue;
            }
            let source = ObjectFile {
                source: Source::File(folder.join(&file.name)),
                bytes: file.bytes,
                sha256: file.sha256.clone(),
            };
            *content = match self.put_file(lease, &source).await {
                Ok(key) => NewContent::Object(key),
                // An end that was repeated meanwhile has removed them.
                Err(StoreError::Objects(ObjectsError::Damaged { .. }))
                    if self.lease_state(lease).await? == LeaseState::Lost =>
                {
                    return Ok(Cow::Owned(update));
                }
                Err(error) => return Err(error),
            };
        }
        Ok(Cow::Owned(update))
    }

    /// The store of objects if it has the files of attempts: services on several machines share no folder. Objects that replace files of a
    /// copied database would never be removed.
    fn objects_of_files(&self) -> Option<&Objects> {
        let is_used = self.is_shared() && self.process().removes_objects;
        self.process().objects.as_ref().filter(|_| is_used)
    }
}
