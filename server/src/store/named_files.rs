//! Files that results name: checked when an update names them, and when their job ends.
//!
//! A database that was restored, or a folder that lost files, can name files that do not exist. A job does not succeed with them.

use std::path::PathBuf;

use api::job::{Outcome, Status};
use api::results::ResultFile;

use crate::objects::{ObjectsError, Source};
use crate::queue::Transition;
use crate::store::checksum::check_file_length;
use crate::store::{
    End, IntegrityError, JobUpdate, Lease, LeaseState, NewContent, Store, StoreError,
};

impl Store {
    /// Checks that the files that an update names are in the folder of the attempt, with their lengths.
    ///
    /// # Errors
    /// [`StoreError::NoFile`] if not, unless the lease was lost: then the update has no effect.
    pub(in crate::store) async fn check_files(
        &self,
        lease: Lease,
        update: &JobUpdate,
    ) -> Result<(), StoreError> {
        let folder = self.attempt_folder(lease);
        let in_folder = update.files.iter();
        let in_folder = in_folder.filter(|file| file.content == NewContent::Folder);
        for file in in_folder {
            let path = folder.join(&file.file.name);
            if let Err(cause) = self.check_length(file.file.clone(), path).await
                && self.lease_state(lease).await? != LeaseState::Lost
            {
                let name = file.file.name.clone();
                return Err(StoreError::NoFile { name, cause });
            }
        }
        Ok(())
    }

    /// Names of the files of a job that do not exist, or have another length. What cannot be found out is not among them.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn missing_files(&self, lease: Lease) -> Result<Vec<String>, StoreError> {
        let mut missing = Vec::new();
        for (entry, source) in self.files_outside(lease.job).await? {
            let name = entry.name.clone();
            let is_missing = match source {
                Source::File(path) => {
                    let checked = self.check_length(entry, path).await;
                    checked.is_err_and(|cause| cause.is_damage())
                }
                Source::Object(part) => {
                    let length = part.object_length().await;
                    length.as_ref().is_ok_and(|length| *length != entry.bytes)
                        || matches!(length, Err(ObjectsError::Missing(_)))
                }
                Source::Bytes(_) => false,
            };
            missing.extend(is_missing.then_some(name));
        }
        Ok(missing)
    }

    /// Returns a job to the queue that was solved although files of its results are missing, to be solved again from cycle 0; after all
    /// its attempts it fails. `None` if the lease was lost.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn solve_again(
        &self,
        lease: Lease,
        last: &JobUpdate,
        missing: &[String],
    ) -> Result<Option<Status>, StoreError> {
        let Some(job) = self.job(lease.job).await? else {
            return Ok(None);
        };
        let name = missing.first().map_or("", String::as_str);
        let cause = format!(
            "{} of the files of its results do not exist, among them {name}; it starts at cycle 0 again",
            missing.len()
        );
        tracing::error!(job = %lease.job, cause, "a job cannot succeed");
        if self.restart(lease, last.number).await? == LeaseState::Lost {
            return Ok(None);
        }
        let end = if job.document.attempts < self.process().attempt_limit {
            End::without_result(Transition::WorkerLost, cause)
        } else {
            End {
                outcome: Some(Outcome::WorkerLost),
                ..End::without_result(Transition::Fail, cause)
            }
        };
        let update = JobUpdate {
            number: last.number + 1,
            progress: last.progress.clone(),
            ..JobUpdate::default()
        };
        self.end(lease, &update, &end).await
    }

    async fn check_length(&self, entry: ResultFile, path: PathBuf) -> Result<(), IntegrityError> {
        let check = move || check_file_length(&entry, &path);
        let checked = tokio::task::spawn_blocking(check).await;
        checked.unwrap_or_else(|panicked| Err(IntegrityError::Read(panicked.into())))
    }
}
