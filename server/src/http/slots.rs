//! Slots of what only a few requests can do at once.
//!
//! Others wait for one. They hold places among the concurrent requests meanwhile, so their number is limited, too: those of one route keep
//! no request of another one waiting.

use std::sync::Arc;

use tokio::sync::{OwnedSemaphorePermit, Semaphore};

/// Maximum number of requests that wait for a slot of the same kind.
pub(super) const MAX_WAITING: usize = 64;

/// Slots of one kind.
#[derive(Debug, Clone)]
pub(super) struct Slots {
    pub(super) free: Arc<Semaphore>,
    waiting: Arc<Semaphore>,
}

impl Slots {
    /// So many slots.
    pub(super) fn new(slots: usize) -> Self {
        Self {
            free: Arc::new(Semaphore::new(slots)),
            waiting: Arc::new(Semaphore::new(MAX_WAITING)),
        }
    }

    /// Waits for a slot; none if too many wait already.
    pub(super) async fn take(&self) -> Option<OwnedSemaphorePermit> {
        let _waits = self.waiting.try_acquire().ok()?;
        // The semaphore is never closed.
        Arc::clone(&self.free).acquire_owned().await.ok()
    }
}

#[cfg(test)]
mod tests {
    use futures_util::poll;

    use super::*;

    #[tokio::test]
    async fn a_limited_number_waits_for_a_slot() {
        let slots = Slots::new(1);
        let taken = slots.take().await.expect("a slot");
        let mut waiting: Vec<_> = (0..MAX_WAITING).map(|_| Box::pin(slots.take())).collect();
        for one in &mut waiting {
            assert!(poll!(one).is_pending());
        }
        assert!(slots.take().await.is_none(), "one too many");
        drop(taken);
        assert!(waiting.remove(0).await.is_some());
        let mut another = Box::pin(slots.take());
        assert!(poll!(&mut another).is_pending());
    }
}
