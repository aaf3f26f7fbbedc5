//! Checkpoints in a store of objects, where there is one: they are large and often replaced, and no query needs them.
//!
//! The state of one is written to an object before the update that names it. Its key is noted first, and the note is removed in the transaction
//! of the update, so no object is left without a name or without a note. While the store of objects does not answer, states are in
//! the database, as those of small checkpoints always are.

use std::time::Duration;

use tokio::time::timeout;
use uuid::Uuid;

use crate::objects::ObjectsError;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::checkpoint_object::CheckpointObject;
use crate::store::{Lease, Store, StoreError, checksum};

/// Smallest state in an object, bytes: below, a request to a bucket costs more than a row. Arbitrary.
const SMALLEST: usize = 64 << 10;
/// Longest time for writing an object: the worker waits for it, even while it is stopping.
const LONGEST: Duration = Duration::from_secs(3);
/// Longest time for reading an object.
const LONGEST_READ: Duration = Duration::from_secs(30);

impl Store {
    /// Writes the state of a checkpoint to an object; returns its key, or `None` if the database is to have the state.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub(in crate::store) async fn put_checkpoint(
        &self,
        lease: Lease,
        checkpoint: &EncodedCheckpoint,
    ) -> Result<Option<String>, StoreError> {
        // Objects that replace checkpoints of a copied database would never be removed.
        if checkpoint.state.len() < SMALLEST || !self.process().removes_objects {
            return Ok(None);
        }
        let Some(objects) = &self.process().objects else {
            return Ok(None);
        };
        let unusable = |error: &StoreError| {
            matches!(
                error,
                StoreError::Objects(_) | StoreError::OtherObjects { .. }
            )
        };
        match self.check_circuit(objects, LONGEST).await {
            Err(error) if unusable(&error) => return Ok(None),
            checked => checked?,
        }
        let key = format!("checkpoints/{}/{}", lease.job, Uuid::now_v7());
        let put = Box::pin(objects.put_whole(&key, checkpoint.state.clone()));
        let written = async {
            self.note_object(&key).await?;
            self.write_in_time(objects, LONGEST, put).await
        };
        match written.await {
            Ok(()) => Ok(Some(key)),
            Err(error) if unusable(&error) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// The checkpoint of a held job that is in an object; `None` if it is damaged or missing, or if the lease was lost.
    ///
    /// # Errors
    /// [`StoreError`] if the database or the store of objects fails.
    pub async fn checkpoint(
        &self,
        lease: impl Into<Lease>,
    ) -> Result<Option<EncodedCheckpoint>, StoreError> {
        let lease = lease.into();
        let Some(CheckpointObject { cycle, sha256, key }) = self.checkpoint_object(lease).await?
        else {
            return Ok(None);
        };
        let objects = self
            .process()
            .objects
            .as_ref()
            .ok_or(StoreError::NoObjects)?;
        let read = timeout(LONGEST_READ, objects.get_all(&key)).await;
        let read = read.unwrap_or_else(|_| {
            let cause = format!("no answer within {LONGEST_READ:?}");
            Err(objects.failed(cause))
        });
        match read {
            Ok(state) => Ok(checksum::checkpoint(lease.job, cycle, &sha256, state)),
            Err(error @ ObjectsError::Missing(_)) => {
                tracing::error!(job = %lease.job, cycle, %error, "a checkpoint is missing");
                Ok(None)
            }
            Err(error) => Err(error.into()),
        }
    }
}
