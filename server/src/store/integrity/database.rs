//! Names in a database, as it is verified. The SQL is in `store/sql/`.

use api::results::ResultFile;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::stored_block::StoredBlock;

/// A file of a manifest, and where its content is: in its row if at neither place.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::store) struct FileRow {
    pub(in crate::store) entry: ResultFile,
    /// In the folder of large results.
    pub(in crate::store) place: Option<String>,
    /// In the store of objects.
    pub(in crate::store) object: Option<String>,
}

/// A checkpoint, and where its state is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::store) struct CheckpointRow {
    pub(in crate::store) sha256: Vec<u8>,
    pub(in crate::store) state: Vec<u8>,
    /// In the store of objects.
    pub(in crate::store) object: Option<String>,
}

impl From<(Vec<u8>, Vec<u8>, Option<String>)> for CheckpointRow {
    fn from((sha256, state, object): (Vec<u8>, Vec<u8>, Option<String>)) -> Self {
        Self {
            sha256,
            state,
            object,
        }
    }
}

/// A database whose results are verified, which may be in use.
pub(in crate::store) trait VerifiableDatabase {
    /// True if machines with other folders serve it.
    const HAS_SEVERAL_FOLDERS: bool;

    /// Ids of all jobs.
    async fn jobs(&self) -> Result<Vec<Uuid>, StoreError>;

    /// Address of the store of objects that it names.
    async fn address_of_objects(&self) -> Result<Option<String>, StoreError>;

    /// Checks whether the database is a copy, whose objects are those of its original.
    async fn is_copy(&self) -> Result<bool, StoreError>;

    /// The block of a job.
    async fn block(&self, job: Uuid) -> Result<Option<StoredBlock>, StoreError>;

    /// Replaces the entries of a block, unless the job has another one meanwhile.
    async fn mark_block(&self, job: Uuid, old: &[u8], new: &[u8]) -> Result<(), StoreError>;

    /// The files of a job that are not in its block: all, or that of a name.
    async fn files(&self, job: Uuid, name: Option<&str>) -> Result<Vec<FileRow>, StoreError>;

    /// The content of a file in its row, unless the job has another one of its name meanwhile.
    async fn content(&self, job: Uuid, file: &FileRow) -> Result<Option<Vec<u8>>, StoreError>;

    /// Writes how a file is damaged, unless the job has another one of its name meanwhile.
    async fn mark_file(
        &self,
        job: Uuid,
        file: &FileRow,
        how: Option<&str>,
    ) -> Result<(), StoreError>;

    /// The checkpoint of a job.
    async fn checkpoint(&self, job: Uuid) -> Result<Option<CheckpointRow>, StoreError>;
}

impl FileRow {
    /// Returns `true` if another row is of the same content at the same place.
    pub(in crate::store) fn is_same(&self, other: &Self) -> bool {
        let of = |row: &Self| (row.entry.name.clone(), row.entry.sha256.clone());
        of(self) == of(other) && (&self.place, &self.object) == (&other.place, &other.object)
    }
}
