//! Leases: claims, fenced writes, lost workers.

use std::time::Duration;

use api::job::Status;
use uuid::Uuid;

use crate::queue::Transition;
use crate::store::checkpoint_object::CheckpointObject;
use crate::store::operations::operations;
use crate::store::{Claim, ClaimRequest, End, JobUpdate, Lease, LeaseState, Reclaimed, StoreError};

operations! {
    /// Claims the first jobs in the order of the queue that a worker can take, under new leases. Jobs before them that do not fit
    /// into its memory get a status reason. A repeated request gets the jobs of the first one that it still holds.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn claim(&self, request: &ClaimRequest) -> Result<Vec<Claim>, StoreError>;

    /// Writes an update, whose checkpoint and files may be in objects that were noted, and renews the lease.
    pub(in crate::store) async fn write_update(&self, lease: Lease, update: &JobUpdate, length: Duration) -> Result<LeaseState, StoreError>;

    /// Notes the key of an object that is about to be written for an update; unless that names it, it is removed after a while.
    pub(in crate::store) async fn note_object(&self, key: &str) -> Result<(), StoreError>;

    /// Keeps a noted object for a length of time, or the content that it should have got; false if it is being removed.
    pub(in crate::store) async fn keep_object(&self, key: &str, content: Option<&[u8]>, length: Duration) -> Result<bool, StoreError>;

    /// The object with the checkpoint of a held job; `None` if it has none, or if the lease was lost.
    pub(in crate::store) async fn checkpoint_object(&self, lease: Lease) -> Result<Option<CheckpointObject>, StoreError>;

    /// Those leases that jobs were claimed under with a token, or by a remote worker without one: the service required none then.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn owned(&self, token: Uuid, leases: &[Lease]) -> Result<Vec<Lease>, StoreError>;

    /// The states of the leases of a worker, renewed for a length where more than a third of it has passed: a heartbeat that comes often, for
    /// the sake of cancel requests, writes seldom. With a token, those that it does not own are lost.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn heartbeat(&self, leases: &[Lease], length: Duration, token: Option<Uuid>) -> Result<Vec<LeaseState>, StoreError>;

    /// Renews the lease: the worker's heartbeat.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn renew(&self, lease: impl Into<Lease>, length: Duration) -> Result<LeaseState, StoreError>;

    /// Returns the state of a lease; writes nothing.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn lease_state(&self, lease: impl Into<Lease>) -> Result<LeaseState, StoreError>;

    /// Deletes results and checkpoint, because the run restarts at cycle 0: this attempt has no checkpoint then. The write has a number as an update has,
    /// and may follow a gap: what the writes before it have left is deleted.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn restart(&self, lease: impl Into<Lease>, number: i64) -> Result<LeaseState, StoreError>;

    /// Writes progress, results and files of the last update and ends the job or returns it to the queue, in one
    /// transaction. Returns the new status, or `None` if the lease was lost.
    pub(in crate::store) async fn write_end(&self, lease: Lease, update: &JobUpdate, end: &End) -> Result<Option<Status>, StoreError>;

    /// True if a transition ends a claimed job instead of returning it to the queue.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn is_final(&self, lease: impl Into<Lease>, transition: Transition, cancel_requested: bool) -> Result<bool, StoreError>;

    /// Reclaims running jobs whose lease has ended. Those without another attempt are held under new leases of this length.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn reclaim_expired(&self, length: Duration) -> Result<Reclaimed, StoreError>;

    /// Reclaims the running jobs of the process that served before, at start-up. Remote workers have the length of a lease of
    /// theirs to renew it.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn reclaim_at_start(&self, length: Duration, remote: Duration) -> Result<Reclaimed, StoreError>;

    /// Fails queued jobs whose deadline has passed. Returns how many.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn expire(&self) -> Result<usize, StoreError>;
}
