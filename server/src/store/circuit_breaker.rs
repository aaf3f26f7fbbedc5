//! A circuit breaker for writes to the store of objects that a worker waits for: after a failure none is tried for a while, and the database takes
//! what belongs there.

use std::time::Duration;

use tokio::time::{Instant, timeout};

use crate::objects::{Objects, ObjectsError};
use crate::store::{Store, StoreError};

/// Time without a try after a failure.
const PAUSE: Duration = Duration::from_mins(1);

impl Store {
    /// Refuses a write if one has failed a short time ago, or if the store is not that of this database, which is found out within a time.
    ///
    /// # Errors
    /// [`StoreError`] then.
    pub(in crate::store) async fn check_circuit(
        &self,
        objects: &Objects,
        longest: Duration,
    ) -> Result<(), StoreError> {
        let failed_at = *self.process().objects_failed_at.lock().await;
        if failed_at.is_none_or(|at| at.elapsed() >= PAUSE) {
            let check = Box::pin(self.check_mark(objects));
            return self.within(objects, longest, check).await;
        }
        let cause = format!("it has failed, and is tried again after {PAUSE:?}");
        Err(objects.failed(cause).into())
    }

    /// Does a write, unless that takes too long, which opens the circuit as a failure of the store does. A damaged file says nothing
    /// about it.
    ///
    /// # Errors
    /// [`StoreError`] if it fails.
    pub(in crate::store) async fn write_in_time(
        &self,
        objects: &Objects,
        longest: Duration,
        write: impl Future<Output = Result<(), ObjectsError>>,
    ) -> Result<(), StoreError> {
        let write = async { Ok(write.await?) };
        self.within(objects, longest, write).await
    }

    async fn within(
        &self,
        objects: &Objects,
        longest: Duration,
        request: impl Future<Output = Result<(), StoreError>>,
    ) -> Result<(), StoreError> {
        let answer = timeout(longest, request).await;
        let answer = answer.unwrap_or_else(|_| {
            let cause = format!("no answer within {longest:?}");
            Err(objects.failed(cause).into())
        });
        if let Err(error) = &answer
            && is_of_objects(error)
        {
            tracing::warn!(
                %error,
                "the store of objects takes no files and checkpoints; the database has them for {PAUSE:?}"
            );
            *self.process().objects_failed_at.lock().await = Some(Instant::now());
        }
        answer
    }
}

/// Returns `true` if an error is one of the store of objects, or of which store it is.
fn is_of_objects(error: &StoreError) -> bool {
    match error {
        StoreError::OtherObjects { .. } => true,
        StoreError::Objects(error) => !matches!(
            error,
            ObjectsError::Damaged { .. } | ObjectsError::File { .. }
        ),
        _ => false,
    }
}
