//! Events and results.

use api::results::{ResultFile, Snapshot};
use solver::record::CycleReport;
use uuid::Uuid;

use crate::objects::Source;
use crate::store::operations::operations;
use crate::store::results_to_move::{Moved, Stored};
use crate::store::stored_block::StoredBlock;
use crate::store::{Content, Lease, SnapshotPart, StoreError, StoredEvent};

operations! {
    /// Returns the manifest of a job so far, by name.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn manifest(&self, id: Uuid) -> Result<Vec<ResultFile>, StoreError>;

    /// Marks a file in its manifest as damaged, with how, or no longer.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn mark_damaged(&self, id: Uuid, name: &str, how: Option<&str>) -> Result<(), StoreError>;

    /// Removes files that no manifest names: of the attempts at a job up to this one, or of all jobs at start-up. A
    /// later attempt may write files that the manifest does not name yet, and so may a remote worker. Files that cannot be removed are logged and
    /// remain until the next start.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn remove_unnamed_files(&self, attempt: Option<Lease>) -> Result<(), StoreError>;

    /// Address of the store of objects that results were moved to; `None` if none were.
    pub(in crate::store) async fn address_of_objects(&self) -> Result<Option<String>, StoreError>;

    /// Notes the address of the store of objects.
    pub(in crate::store) async fn note_address_of_objects(&self, address: &str) -> Result<(), StoreError>;

    /// Checks whether objects that no job names are removed: not by a copy of a database, whose original names them, too.
    pub(in crate::store) async fn removes_objects(&self) -> Result<bool, StoreError>;

    /// Checks whether the store of objects at an address has got its mark.
    pub(in crate::store) async fn are_objects_marked(&self, address: &str) -> Result<bool, StoreError>;

    /// Notes that the store of objects has its mark; false if the database has another address meanwhile.
    pub(in crate::store) async fn note_mark_of_objects(&self, address: &str) -> Result<bool, StoreError>;

    /// Key of an object with the results of a job.
    pub(in crate::store) async fn any_object(&self) -> Result<Option<String>, StoreError>;

    /// Checks whether this process is the one that moves results.
    pub(in crate::store) async fn moves_results(&self) -> Result<bool, StoreError>;

    /// Succeeded jobs whose results are not in objects: the first ones after an id.
    pub(in crate::store) async fn movable_jobs(&self, after: Uuid, most: i64) -> Result<Vec<Uuid>, StoreError>;

    /// Notes the keys of objects that are about to be written.
    pub(in crate::store) async fn note_unnamed(&self, keys: &[String]) -> Result<(), StoreError>;

    /// Keys of objects to be removed; they cannot be named any more.
    pub(in crate::store) async fn take_unnamed(&self, most: i64) -> Result<Vec<String>, StoreError>;

    /// Forgets the keys of removed objects.
    pub(in crate::store) async fn forget_unnamed(&self, keys: &[String]) -> Result<(), StoreError>;

    /// Reads the results of jobs that were not deleted.
    pub(in crate::store) async fn results_to_move(&self, ids: &[Uuid]) -> Result<Vec<Stored>, StoreError>;

    /// Notes that the results of a job cannot be moved.
    pub(in crate::store) async fn keep_results(&self, id: Uuid) -> Result<(), StoreError>;

    /// Names objects and removes the results from the database, unless they have changed meanwhile. Returns the jobs.
    pub(in crate::store) async fn name_objects(&self, moved: &[Moved]) -> Result<Vec<Uuid>, StoreError>;

    /// Reads the block of a job; `None` if it has none.
    pub(in crate::store) async fn stored_block(&self, id: Uuid) -> Result<Option<StoredBlock>, StoreError>;

    /// Reads the rows of the wear history, by cycle.
    pub(in crate::store) async fn history_rows(&self, id: Uuid) -> Result<Vec<CycleReport>, StoreError>;

    /// Reads a document of the row of the snapshot nearest to a cycle.
    pub(in crate::store) async fn snapshot_row(&self, id: Uuid, part: SnapshotPart, cycle: Option<u64>) -> Result<Option<String>, StoreError>;

    /// Reads the rows of all snapshots, by cycle.
    pub(in crate::store) async fn snapshot_rows(&self, id: Uuid) -> Result<Vec<Snapshot>, StoreError>;

    /// Reads a page of the rows of events after one.
    pub(in crate::store) async fn event_rows(&self, id: Uuid, after: i64) -> Result<Vec<StoredEvent>, StoreError>;

    /// The files of a job whose content is not in the database, and where it is.
    pub(in crate::store) async fn files_outside(&self, id: Uuid) -> Result<Vec<(ResultFile, Source)>, StoreError>;

    /// Reads the row of a file.
    pub(in crate::store) async fn file_row(&self, id: Uuid, name: &str) -> Result<Option<(ResultFile, Content)>, StoreError>;
}
