//! Verification: every result that a database names is read and compared with its checksum. The rules of damage are the same for both
//! engines.

use api::results::ResultFile;
use futures_util::{StreamExt, stream};
use tokio::sync::{Mutex, Semaphore};
use uuid::Uuid;

use crate::export::files::{hexadecimal, sha256};
use crate::objects::{Objects, ObjectsError};
use crate::store::block::Block;
use crate::store::folder::Folder;
use crate::store::integrity::checked_read::{CheckedRead, failed, in_background, object};
use crate::store::integrity::database::{FileRow, VerifiableDatabase};
use crate::store::stored_block::{StoredBlock, StoredObject, unreadable};
use crate::store::{BackupError, CopySummary, StoreError, checksum};

/// Jobs that are verified at the same time: a request for an object takes some 10 to 100 ms.
const AT_ONCE: usize = 16;
/// Length from which a content is large, bytes, and how many of them are read at the same time.
const LARGE: u64 = 4 << 20;
const LARGE_AT_ONCE: usize = 2;
/// Results that cannot be read, in successive jobs, after which the others are not tried.
const MOST_UNREAD: usize = 100;

/// Verification of all results of a database against their checksums.
#[derive(Debug)]
pub(in crate::store) struct Verification<'a, D> {
    database: &'a D,
    folder: &'a Folder,
    objects: Option<&'a Objects>,
    is_copy: bool,
    large: Semaphore,
    /// Serializes marks: a database file has one writer.
    marks: Mutex<()>,
}

impl<'a, D: VerifiableDatabase> Verification<'a, D> {
    /// Prepares the verification of a database whose large results are in a folder.
    ///
    /// # Errors
    /// [`BackupError`] if its objects are in another store.
    pub(in crate::store) async fn of(
        database: &'a D,
        folder: &'a Folder,
        objects: Option<&'a Objects>,
    ) -> Result<Self, BackupError> {
        let stored = database.address_of_objects().await?;
        if let (Some(stored), Some(given)) = (stored, objects.map(Objects::location))
            && stored != given
        {
            let given = given.to_owned();
            return Err(StoreError::OtherObjects { stored, given }.into());
        }
        Ok(Self {
            database,
            folder,
            objects,
            is_copy: database.is_copy().await?,
            large: Semaphore::new(LARGE_AT_ONCE),
            marks: Mutex::default(),
        })
    }

    /// Reads all results, and compares every checksum. Marks in the manifests which files are damaged, and which no longer are.
    ///
    /// # Errors
    /// [`BackupError`] if the database fails, or if results are in a store of objects that is not given.
    pub(in crate::store) async fn run(&self) -> Result<CopySummary, BackupError> {
        let jobs = self.database.jobs().await?;
        let report = stream::iter(jobs).map(|job| self.job(job));
        let mut report = report.buffered(AT_ONCE);
        let (mut all, mut unread) = (CopySummary::default(), 0);
        while let Some(job) = report.next().await {
            let job = job?;
            unread = match job.unread.len() {
                0 if job.files == 0 => unread,
                0 => 0,
                more => unread + more,
            };
            all.add(job);
            if unread > MOST_UNREAD {
                all.has_ended_early = true;
                break;
            }
        }
        Ok(all)
    }

    /// Verifies a job: files before the block, into which they may be moved meanwhile.
    async fn job(&self, job: Uuid) -> Result<CopySummary, BackupError> {
        let mut report = CopySummary {
            jobs: 1,
            ..CopySummary::default()
        };
        for file in self.database.files(job, None).await? {
            self.file(job, &file, &mut report).await?;
        }
        self.block(job, &mut report).await?;
        self.checkpoint(job, &mut report).await?;
        Ok(report)
    }

    async fn file(
        &self,
        job: Uuid,
        file: &FileRow,
        report: &mut CopySummary,
    ) -> Result<(), BackupError> {
        let FileRow { entry, .. } = file;
        let what = format!("{} of job {job}", entry.name);
        let found = match self.check_file(job, file).await? {
            CheckedRead::Compared(None) => None,
            // The file may have been deleted or replaced meanwhile.
            _ if !self.is_named(job, file).await? => return Ok(()),
            CheckedRead::Compared(how) => how,
            CheckedRead::Missing(how) => Some(how),
            CheckedRead::Gone => return Ok(()),
            CheckedRead::Unread(cause) => {
                report.unread.push(format!("{what}: {cause}"));
                return Ok(());
            }
            CheckedRead::Elsewhere(cause) => {
                report.elsewhere.push(format!("{what}: {cause}"));
                return Ok(());
            }
        };
        if found != entry.damaged {
            let _mark = self.marks.lock().await;
            let how = found.as_deref();
            self.database.mark_file(job, file, how).await?;
        }
        report.count(entry, &what, found);
        Ok(())
    }

    /// Compares a file with its entry.
    async fn check_file(&self, job: Uuid, file: &FileRow) -> Result<CheckedRead, BackupError> {
        let FileRow { entry, .. } = file;
        let _large = self.large_one(entry.bytes).await;
        if let Some(key) = &file.object {
            let objects = self.objects.ok_or(StoreError::NoObjects)?;
            return Ok(match object(objects, key, 0..entry.bytes, entry).await {
                // The original has moved or removed the object.
                CheckedRead::Missing(_) if self.is_copy => CheckedRead::Elsewhere(
                    "the original of this copy may have removed it".to_owned(),
                ),
                found => found,
            });
        }
        let entry = entry.clone();
        let checked = if let Some(place) = &file.place {
            let path = self.folder.path(place);
            let path = path.ok_or_else(|| BackupError::Place(place.clone()))?;
            let has_folder = if D::HAS_SEVERAL_FOLDERS {
                path.parent().is_some_and(std::path::Path::is_dir)
            } else {
                self.folder.exists()
            };
            if !has_folder {
                return Ok(CheckedRead::Elsewhere(format!(
                    "{} is not here",
                    path.display()
                )));
            }
            in_background(move || checksum::check_file(&entry, &path)).await
        } else {
            let Some(content) = self.database.content(job, file).await? else {
                return Ok(CheckedRead::Gone);
            };
            in_background(move || checksum::check_bytes(&entry, &content)).await
        };
        Ok(checked.into())
    }

    /// Checks whether the database still names a file.
    async fn is_named(&self, job: Uuid, file: &FileRow) -> Result<bool, BackupError> {
        let now = self.database.files(job, Some(&file.entry.name)).await?;
        Ok(now.iter().any(|now| now.is_same(file)))
    }

    /// Checks the block of a job, and the files behind it in an object.
    async fn block(&self, job: Uuid, report: &mut CopySummary) -> Result<(), BackupError> {
        let Some(stored) = self.database.block(job).await? else {
            return Ok(());
        };
        let (mut entries, key) = (stored.entries.clone(), key_of(&stored));
        let checked = match self.checked(stored, job).await? {
            Ok(checked) => checked,
            Err(found) => {
                let now = self.database.block(job).await?;
                let is_named = now.is_some_and(|now| key_of(&now) == key);
                let what = format!("results of job {job}");
                match found {
                    _ if !is_named => {}
                    CheckedRead::Compared(Some(how)) | CheckedRead::Missing(how) => {
                        report.damaged.push(format!("{what}: {how}"));
                    }
                    CheckedRead::Unread(cause) => report.unread.push(format!("{what}: {cause}")),
                    CheckedRead::Compared(None) | CheckedRead::Gone | CheckedRead::Elsewhere(_) => {
                    }
                }
                return Ok(());
            }
        };
        let block = Block::decode(&entries, &[]);
        let mut marked = block.map_err(|cause| unreadable(job, &cause))?;
        for (entry, found) in checked {
            let what = format!("{} of job {job}", entry.name);
            let how = match found {
                CheckedRead::Compared(how) => how,
                CheckedRead::Unread(cause) => {
                    report.unread.push(format!("{what}: {cause}"));
                    continue;
                }
                CheckedRead::Missing(_) | CheckedRead::Gone | CheckedRead::Elsewhere(_) => continue,
            };
            let new = marked.mark(&entry.name, how.as_deref());
            if let Some(new) = new.map_err(StoreError::from)? {
                let _mark = self.marks.lock().await;
                self.database.mark_block(job, &entries, &new).await?;
                entries = new;
            }
            report.count(&entry, &what, how);
        }
        Ok(())
    }

    /// Documents of a block and files behind it, with the finding for each; or one finding for all of them.
    async fn checked(
        &self,
        stored: StoredBlock,
        job: Uuid,
    ) -> Result<Result<Vec<(ResultFile, CheckedRead)>, CheckedRead>, StoreError> {
        let content = stored.object.as_ref().map(StoredObject::content);
        let (key, behind) = content.unwrap_or_default();
        let is_object = stored.object.is_some();
        let block = match stored.decoded(job, self.objects).await {
            Ok(block) => block,
            Err(StoreError::Objects(cause)) => {
                let objects = self.objects.ok_or(StoreError::NoObjects)?;
                return Ok(Err(failed(objects, &key, behind, cause).await));
            }
            Err(error @ StoreError::DamagedResults { .. }) => {
                return Ok(Err(CheckedRead::Compared(Some(error.to_string()))));
            }
            Err(error) => return Err(error),
        };
        let documents = block.all();
        let compared = |(entry, bytes): (&ResultFile, _)| {
            let found = checksum::check_bytes(entry, bytes).into();
            (entry.clone(), found)
        };
        let mut checked: Vec<_> = documents.map(compared).collect();
        if !is_object {
            return Ok(Ok(checked));
        }
        let objects = self.objects.ok_or(StoreError::NoObjects)?;
        for (entry, range) in block.events().into_iter().chain(block.files()) {
            let _large = self.large_one(entry.bytes).await;
            let range = behind + range.start..behind + range.end;
            match object(objects, &key, range, entry).await {
                found @ CheckedRead::Missing(_) => return Ok(Err(found)),
                found => checked.push((entry.clone(), found)),
            }
        }
        Ok(Ok(checked))
    }

    /// Checks the checkpoint of a job. A damaged one is not marked: its job would restart at cycle 0.
    async fn checkpoint(&self, job: Uuid, report: &mut CopySummary) -> Result<(), BackupError> {
        let Some(row) = self.database.checkpoint(job).await? else {
            return Ok(());
        };
        let what = format!("checkpoint of job {job}");
        let state = match &row.object {
            None => row.state,
            Some(key) => match self
                .objects
                .ok_or(StoreError::NoObjects)?
                .get_all(key)
                .await
            {
                Ok(state) => state,
                Err(cause) => {
                    let is_missing = matches!(cause, ObjectsError::Missing(_));
                    // The checkpoint may have been replaced meanwhile, by the original if this is a copy.
                    let now = self.database.checkpoint(job).await?;
                    let is_named = now.is_some_and(|now| now.object == row.object);
                    if is_named && !is_missing {
                        report.unread.push(format!("{what}: {cause}"));
                    } else if is_named && !self.is_copy {
                        report.damaged.push(format!("{what}: {cause}"));
                    }
                    return Ok(());
                }
            },
        };
        let (found, named) = (sha256(&state), hexadecimal(&row.sha256));
        if found != named {
            let how = format!("it has the SHA-256 {found}, the database names {named}");
            report.damaged.push(format!("{what}: {how}"));
        }
        Ok(())
    }

    /// Waits for its turn with a large content.
    async fn large_one(&self, bytes: u64) -> Option<tokio::sync::SemaphorePermit<'_>> {
        if bytes < LARGE {
            return None;
        }
        self.large.acquire().await.ok()
    }
}

impl CopySummary {
    /// Adds what was verified of another job.
    fn add(&mut self, other: Self) {
        self.jobs += other.jobs;
        self.files += other.files;
        self.file_bytes += other.file_bytes;
        self.damaged.extend(other.damaged);
        self.unread.extend(other.unread);
        self.elsewhere.extend(other.elsewhere);
    }

    /// Counts a file that was compared.
    fn count(&mut self, entry: &ResultFile, what: &str, how: Option<String>) {
        self.files += 1;
        self.file_bytes += entry.bytes;
        self.damaged.extend(how.map(|how| format!("{what}: {how}")));
    }
}

fn key_of(stored: &StoredBlock) -> Option<String> {
    let object = stored.object.as_ref();
    object.map(|object| object.content().0)
}
