//! Verification: every result that a database names is read and compared with its checksum. Both engines have the same statements about what
//! is damaged; their SQL is behind [`Verified`].

use api::results::ResultFile;
use futures_util::{StreamExt, TryStreamExt, stream};
use uuid::Uuid;

use crate::export::files::{hexadecimal, sha256};
use crate::objects::{ObjectPart, Objects, ObjectsError};
use crate::store::block::Block;
use crate::store::folder::Folder;
use crate::store::integrity::Checksum;
use crate::store::stored_block::{StoredBlock, unreadable};
use crate::store::{BackupError, CopySummary, IntegrityError, StoreError, integrity};

/// Jobs that are verified at the same time: a request for an object takes some 10 to 100 ms.
const AT_ONCE: usize = 16;

/// A file of a manifest, and where its content is.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::store) struct FileRow {
    pub(in crate::store) entry: ResultFile,
    /// In the folder of large results.
    pub(in crate::store) place: Option<String>,
    /// In the store of objects.
    pub(in crate::store) object: Option<String>,
}

impl FileRow {
    fn is_same(&self, other: &Self) -> bool {
        let name = |row: &Self| row.entry.name.clone();
        (name(self), &self.place, &self.object) == (name(other), &other.place, &other.object)
    }
}

/// A checkpoint, and where its state is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::store) struct CheckpointRow {
    pub(in crate::store) sha256: Vec<u8>,
    pub(in crate::store) state: Vec<u8>,
    /// In the store of objects.
    pub(in crate::store) object: Option<String>,
}

/// A database whose results are verified, which may be in use.
pub(in crate::store) trait Verified {
    /// Ids of all jobs.
    async fn jobs(&self) -> Result<Vec<Uuid>, StoreError>;

    /// The block of a job.
    async fn block(&self, job: Uuid) -> Result<Option<StoredBlock>, StoreError>;

    /// Replaces the entries of a block, unless the job has another one meanwhile.
    async fn mark_block(&self, job: Uuid, old: &[u8], new: &[u8]) -> Result<(), StoreError>;

    /// The files of a job that are not in its block.
    async fn files(&self, job: Uuid) -> Result<Vec<FileRow>, StoreError>;

    /// The content of a file in its row.
    async fn content(&self, job: Uuid, name: &str) -> Result<Option<Vec<u8>>, StoreError>;

    /// Writes how a file is damaged, unless the job has another one of its name meanwhile.
    async fn mark_file(
        &self,
        job: Uuid,
        file: &FileRow,
        how: Option<&str>,
    ) -> Result<(), StoreError>;

    /// The checkpoint of a job.
    async fn checkpoint(&self, job: Uuid) -> Result<Option<CheckpointRow>, StoreError>;

    /// Whether the objects that it names are those of its original.
    async fn is_copy(&self) -> Result<bool, StoreError>;
}

/// What the results of a database are compared in.
#[derive(Debug)]
pub(in crate::store) struct Verification<'a, D> {
    pub(in crate::store) database: &'a D,
    pub(in crate::store) folder: &'a Folder,
    pub(in crate::store) objects: Option<&'a Objects>,
}

impl<D: Verified> Verification<'_, D> {
    /// Reads all results, and compares every checksum. Marks in the manifests which files are damaged, and which no longer are.
    ///
    /// # Errors
    /// [`BackupError`] if something cannot be read, or if results are in a store of objects that is not given.
    pub(in crate::store) async fn run(&self) -> Result<CopySummary, BackupError> {
        let jobs = self.database.jobs().await?;
        let verified = stream::iter(jobs).map(|job| self.job(job));
        let all = verified.buffered(AT_ONCE);
        all.try_fold(CopySummary::default(), async |mut all, job| {
            all.add(job);
            Ok(all)
        })
        .await
    }

    async fn job(&self, job: Uuid) -> Result<CopySummary, BackupError> {
        let mut verified = CopySummary {
            jobs: 1,
            ..CopySummary::default()
        };
        self.block(job, &mut verified).await?;
        for file in self.database.files(job).await? {
            self.file(job, &file, &mut verified).await?;
        }
        self.checkpoint(job, &mut verified).await?;
        Ok(verified)
    }

    /// Checks the block of a job, and the files behind it in an object.
    async fn block(&self, job: Uuid, verified: &mut CopySummary) -> Result<(), BackupError> {
        let Some(stored) = self.database.block(job).await? else {
            return Ok(());
        };
        let (mut entries, object) = (stored.entries.clone(), stored.object.clone());
        let key = object.as_ref().map(|object| object.key.clone());
        let checked = match self.checked(stored, job).await {
            Ok(checked) => checked,
            Err(error) => return self.unreadable(job, key, error, verified).await,
        };
        let block = Block::decode(&entries, &[]);
        let mut marked = block.map_err(|cause| unreadable(job, &cause))?;
        for (entry, how) in checked {
            verified.files += 1;
            verified.file_bytes += entry.bytes;
            let new = marked.mark(&entry.name, how.as_deref());
            if let Some(new) = new.map_err(StoreError::from)? {
                self.database.mark_block(job, &entries, &new).await?;
                entries = new;
            }
            let said = how.map(|how| format!("{} of job {job}: {how}", entry.name));
            verified.damaged.extend(said);
        }
        Ok(())
    }

    /// The documents of a block and the files behind it, and how they are damaged.
    async fn checked(
        &self,
        stored: StoredBlock,
        job: Uuid,
    ) -> Result<Vec<(ResultFile, Option<String>)>, StoreError> {
        let object = stored.object.clone();
        let block = stored.decoded(job, self.objects).await?;
        let said = |checked: Result<(), IntegrityError>| checked.err().map(|how| how.to_string());
        let documents = block.all();
        let mut checked: Vec<_> = documents
            .map(|(entry, bytes)| (entry.clone(), said(integrity::check_bytes(entry, bytes))))
            .collect();
        if let Some(object) = object {
            for (entry, range) in block.events().into_iter().chain(block.files()) {
                let part = object.behind(self.objects, &range)?;
                let found = checksum(&part).await?;
                checked.push((entry.clone(), said(found.compare(entry))));
            }
        }
        Ok(checked)
    }

    /// What an error says about the block of a job.
    async fn unreadable(
        &self,
        job: Uuid,
        key: Option<String>,
        error: StoreError,
        verified: &mut CopySummary,
    ) -> Result<(), BackupError> {
        match error {
            StoreError::Objects(cause @ ObjectsError::Missing(_)) => {
                let now = self.database.block(job).await?;
                let now = now.and_then(|block| block.object).map(|object| object.key);
                if now == key {
                    let said = format!("results of job {job}: {cause}");
                    verified.damaged.push(said);
                } else {
                    tracing::debug!(%job, "deleted meanwhile");
                }
                Ok(())
            }
            error @ StoreError::DamagedResults { .. } => {
                verified.damaged.push(error.to_string());
                Ok(())
            }
            error => Err(error.into()),
        }
    }

    async fn file(
        &self,
        job: Uuid,
        file: &FileRow,
        verified: &mut CopySummary,
    ) -> Result<(), BackupError> {
        let FileRow { entry, .. } = file;
        let checked = self.check_file(job, file).await?;
        verified.files += 1;
        verified.file_bytes += entry.bytes;
        let how = match checked {
            Err(cause) if !self.is_named(job, file).await? => {
                tracing::debug!(%cause, "deleted or replaced meanwhile");
                return Ok(());
            }
            Err(cause) if !cause.is_damage() => {
                let place = format!("{} of job {job}", entry.name);
                return Err(BackupError::Content { place, cause });
            }
            checked => checked.err().map(|cause| cause.to_string()),
        };
        if let Some(how) = &how {
            let said = format!("{} of job {job}: {how}", entry.name);
            verified.damaged.push(said);
        }
        if how != entry.damaged {
            let how = how.as_deref();
            self.database.mark_file(job, file, how).await?;
        }
        Ok(())
    }

    /// Compares a file with its entry.
    async fn check_file(
        &self,
        job: Uuid,
        file: &FileRow,
    ) -> Result<Result<(), IntegrityError>, BackupError> {
        let FileRow { entry, .. } = file;
        if let Some(key) = &file.object {
            let objects = self.objects.ok_or(StoreError::NoObjects)?;
            let part = ObjectPart::new(objects, key, 0..entry.bytes);
            return match checksum(&part).await {
                Ok(found) => Ok(found.compare(entry)),
                Err(ObjectsError::Missing(_)) => Ok(Err(IntegrityError::Missing)),
                Err(cause) => Err(StoreError::from(cause).into()),
            };
        }
        if let Some(place) = &file.place {
            let path = self.folder.path(place);
            let path = path.ok_or_else(|| BackupError::Place(place.clone()))?;
            return Ok(integrity::check_file(entry, &path));
        }
        let content = self.database.content(job, &entry.name).await?;
        let checked = content.map(|bytes| integrity::check_bytes(entry, &bytes));
        Ok(checked.unwrap_or(Err(IntegrityError::Missing)))
    }

    /// Whether the database still names a file.
    async fn is_named(&self, job: Uuid, file: &FileRow) -> Result<bool, BackupError> {
        let now = self.database.files(job).await?;
        Ok(now.iter().any(|now| now.is_same(file)))
    }

    /// Checks the checkpoint of a job. A damaged one is not marked: its job would restart at cycle 0.
    async fn checkpoint(&self, job: Uuid, verified: &mut CopySummary) -> Result<(), BackupError> {
        let Some(row) = self.database.checkpoint(job).await? else {
            return Ok(());
        };
        let state = match &row.object {
            None => row.state,
            Some(key) => match self
                .objects
                .ok_or(StoreError::NoObjects)?
                .get_all(key)
                .await
            {
                Ok(state) => state,
                Err(cause @ ObjectsError::Missing(_)) => {
                    // It may have been replaced meanwhile, by the original if this is a copy.
                    let now = self.database.checkpoint(job).await?;
                    let is_named = now.is_some_and(|now| now.object == row.object);
                    if is_named && !self.database.is_copy().await? {
                        let said = format!("checkpoint of job {job}: {cause}");
                        verified.damaged.push(said);
                    }
                    return Ok(());
                }
                Err(cause) => return Err(StoreError::from(cause).into()),
            },
        };
        let (found, named) = (sha256(&state), hexadecimal(&row.sha256));
        if found != named {
            let how = format!("it has the SHA-256 {found}, the database names {named}");
            verified
                .damaged
                .push(format!("checkpoint of job {job}: {how}"));
        }
        Ok(())
    }
}

impl CopySummary {
    /// Adds what was verified of another job.
    fn add(&mut self, other: Self) {
        self.jobs += other.jobs;
        self.files += other.files;
        self.file_bytes += other.file_bytes;
        self.damaged.extend(other.damaged);
    }
}

/// The checksum of a part of an object.
async fn checksum(part: &ObjectPart) -> Result<Checksum, ObjectsError> {
    let mut checksum = Checksum::default();
    let mut chunks = part.stream(0..part.length()).await?;
    while let Some(chunk) = chunks.next().await {
        checksum.update(&chunk?);
    }
    Ok(checksum)
}
