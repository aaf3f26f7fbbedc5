//! Change notifications of one job, and of all.

use tokio::sync::broadcast;
use uuid::Uuid;

/// Stands for all jobs where it is not known which of them have changed.
pub(in crate::store) const ANY_JOB: Uuid = Uuid::nil();

/// Changes of one job, from the time of the subscription.
#[derive(Debug)]
pub struct Changes {
    id: Uuid,
    changed: broadcast::Receiver<Uuid>,
}

impl Changes {
    /// Selects the changes of one job from those of all jobs.
    pub(in crate::store) fn new(id: Uuid, changed: broadcast::Receiver<Uuid>) -> Self {
        Self { id, changed }
    }

    /// Returns when the job has changed, or when so many other changes were missed that it may have.
    pub async fn next(&mut self) {
        let is_other = |id| id != self.id && id != ANY_JOB;
        while self.changed.recv().await.is_ok_and(is_other) {}
    }
}

/// Changes of all jobs, from the time of the subscription.
#[derive(Debug)]
pub struct AllChanges(broadcast::Receiver<Uuid>);

impl AllChanges {
    pub(in crate::store) fn new(changed: broadcast::Receiver<Uuid>) -> Self {
        Self(changed)
    }

    /// Returns when any job has changed; notifications that were missed count as one.
    pub async fn next(&mut self) {
        let _ = self.0.recv().await;
        while self.0.try_recv().is_ok() {}
    }
}
