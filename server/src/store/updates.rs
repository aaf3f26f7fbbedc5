//! Writes of workers under their leases. Large contents are written to the store of objects first, where there is one.

use std::time::Duration;

use api::job::Status;

use crate::store::{End, JobUpdate, Lease, LeaseState, Store, StoreError};

impl Store {
    /// Writes an update and renews the lease.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails, or the store of objects where it has the files.
    pub async fn record(
        &self,
        lease: impl Into<Lease>,
        update: &JobUpdate,
        length: Duration,
    ) -> Result<LeaseState, StoreError> {
        let lease = lease.into();
        let mut update = self.with_file_objects(lease, update).await?;
        self.check_files(lease, &update).await?;
        if let Some(checkpoint) = &update.checkpoint
            && let Some(key) = self.put_checkpoint(lease, checkpoint).await?
        {
            update.to_mut().checkpoint_object = Some(key);
        }
        self.write_update(lease, &update, length).await
    }

    /// Writes progress, results and files of the last update and ends the job or returns it to the queue, in one
    /// transaction. Returns the new status, or `None` if the lease was lost.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails, or the store of objects where it has the files.
    pub async fn end(
        &self,
        lease: impl Into<Lease>,
        update: &JobUpdate,
        end: &End,
    ) -> Result<Option<Status>, StoreError> {
        let lease = lease.into();
        let update = self.with_file_objects(lease, update).await?;
        self.check_files(lease, &update).await?;
        self.write_end(lease, &update, end).await
    }
}
