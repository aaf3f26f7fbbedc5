//! Sources of the jobs of a worker: the store of its own process, or a remote service. Both give the same answers, which the tests in
//! `worker/job_source/tests.rs` compare.

mod remote;
mod store;

use std::path::PathBuf;
use std::time::Duration;

use api::job::Status;
use api::service::Demand;

use crate::client::ClientError;
use crate::metrics::Busy;
use crate::objects::ObjectsError;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::{Claim, ClaimRequest, End, JobUpdate, Lease, LeaseState, StoreError};

pub use remote::{Remote, RemoteOptions};

/// Why a job source gave no answer.
#[derive(Debug, thiserror::Error)]
pub enum JobSourceError {
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The remote service was not reached, or has refused the request.
    #[error(transparent)]
    Remote(#[from] ClientError),
}

impl JobSourceError {
    /// Returns `true` if the same request may succeed later.
    pub(super) fn is_temporary(&self) -> bool {
        match self {
            Self::Store(StoreError::Objects(ObjectsError::Damaged { .. })) => false,
            Self::Store(error) => matches!(
                error,
                StoreError::Database { .. }
                    | StoreError::Prepare { .. }
                    | StoreError::DiskFull
                    | StoreError::NoAnswer(_)
                    | StoreError::Unwritten
                    | StoreError::Objects(_)
                    | StoreError::LostFile(_)
                    // Another service of the same database may have one.
                    | StoreError::NoObjects
            ),
            // As the store's own errors: a finished solve waits for a service that fails.
            Self::Remote(error) => error.is_temporary() || error.is_of_type("/problems/internal"),
        }
    }

    /// Returns `true` if the job source does not accept this worker.
    pub(super) fn is_rejected(&self) -> bool {
        match self {
            Self::Store(_) => false,
            Self::Remote(error) => error.is_rejected(),
        }
    }

    /// Returns `true` if the job source gives this worker no more jobs.
    pub(super) fn is_drained(&self) -> bool {
        match self {
            Self::Store(_) => false,
            Self::Remote(error) => error.is_of_type("/problems/worker-drained"),
        }
    }

    /// Returns `true` if the store of objects takes no file that only it can have.
    pub(super) fn is_without_objects(&self) -> bool {
        match self {
            Self::Store(error) => matches!(error, StoreError::Objects(_)),
            Self::Remote(error) => error.is_of_type("/problems/results-unreachable"),
        }
    }

    /// Returns `true` if the disk of the database is full: nothing more can be recorded, but jobs can be cancelled.
    pub(super) fn is_disk_full(&self) -> bool {
        match self {
            Self::Store(error) => error.is_disk_full(),
            Self::Remote(error) => error.is_of_type("/problems/disk-full"),
        }
    }
}

/// Source of the jobs of a worker: a store or a service.
pub trait JobSource: Send + Sync + 'static {
    /// True if attempts write to the disk of the database, which all jobs wait for while it is full; otherwise a job is released.
    const WAITS_FOR_DISK: bool;

    /// Claims jobs. A repeated request gets the same ones.
    fn claim(
        &self,
        request: &ClaimRequest,
    ) -> impl Future<Output = Result<Vec<Claim>, JobSourceError>> + Send;

    /// Returns when a job may be waiting.
    fn job_waiting(&self) -> impl Future<Output = ()> + Send;

    /// Renews a lease for this length.
    fn renew(
        &self,
        lease: Lease,
        length: Duration,
    ) -> impl Future<Output = Result<LeaseState, JobSourceError>> + Send;

    /// The state of a lease.
    fn lease_state(
        &self,
        lease: Lease,
    ) -> impl Future<Output = Result<LeaseState, JobSourceError>> + Send;

    /// The checkpoint of a job that does not come with its claim; `None` if it is missing or damaged, or if the lease was lost.
    fn checkpoint(
        &self,
        lease: Lease,
    ) -> impl Future<Output = Result<Option<EncodedCheckpoint>, JobSourceError>> + Send;

    /// Records an update and renews the lease. The files that the update names are in the folder of the attempt, or were sent. A repeated one has
    /// no further effect.
    fn record(
        &self,
        lease: Lease,
        update: &JobUpdate,
        length: Duration,
    ) -> impl Future<Output = Result<LeaseState, JobSourceError>> + Send;

    /// Deletes all results, because the run restarts at cycle 0; numbered as an update.
    fn restart(
        &self,
        lease: Lease,
        number: i64,
    ) -> impl Future<Output = Result<LeaseState, JobSourceError>> + Send;

    /// Ends the job, with documents of all its results, or returns it to the queue. Of the update, progress and number count, and files and block
    /// where it has one: the documents that the worker has made. Returns the new status, `None` if the lease was lost; a repeated end
    /// returns the same.
    fn finish(
        &self,
        lease: Lease,
        update: &JobUpdate,
        end: &End,
    ) -> impl Future<Output = Result<Option<Status>, JobSourceError>> + Send;

    /// Stops renewing a lease, and removes the files of its attempt, which has ended or is given up.
    fn abandon(&self, lease: Lease);

    /// The folder into which an attempt writes its files.
    fn folder(&self, lease: Lease) -> PathBuf;

    /// Counts a busy worker where this process has metrics.
    fn busy(&self) -> Option<Busy>;

    /// The jobs that wait and run, of all workers.
    fn demand(&self) -> impl Future<Output = Result<Demand, JobSourceError>> + Send;

    /// Checks whether no job waits or runs anywhere.
    fn is_idle(&self) -> impl Future<Output = Result<bool, JobSourceError>> + Send {
        async {
            let demand = self.demand().await?;
            Ok(demand.queued + demand.running == 0)
        }
    }
}

#[cfg(test)]
mod tests;
