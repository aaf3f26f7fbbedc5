//! A circuit breaker for writes to the store of objects that a worker waits for: after a failure none is tried for a while, and the database takes
//! what belongs there.

use std::time::Duration;

use tokio::time::{Instant, timeout};

use crate::objects::{Objects, ObjectsError};
use crate::store::{Store, StoreError};

/// Time without a try after a failure.
const PAUSE: Duration = Duration::from_mins(1);

impl Store {
    /// Refuses a write if one has failed a short time ago.
    ///
    /// # Errors
    /// [`StoreError::Objects`] then.
    pub(in crate::store) async fn check_circuit(
        &self,
        objects: &Objects,
    ) -> Result<(), StoreError> {
        let failed_at = *self.local().objects_failed_at.lock().await;
        if failed_at.is_none_or(|at| at.elapsed() >= PAUSE) {
            return Ok(());
        }
        let cause = format!("it has failed, and is tried again after {PAUSE:?}");
        Err(objects.failed(cause).into())
    }

    /// Does a write to the store of this database, unless that takes too long, which opens the circuit as a failure of the store does. An error of
    /// the database, or a damaged file, says nothing about it.
    ///
    /// # Errors
    /// [`StoreError`] if it fails.
    pub(in crate::store) async fn write_in_time(
        &self,
        objects: &Objects,
        longest: Duration,
        write: impl Future<Output = Result<(), StoreError>>,
    ) -> Result<(), StoreError> {
        let marked_write = async {
            self.check_mark(objects).await?;
            write.await
        };
        let written = timeout(longest, marked_write).await;
        let written = written.unwrap_or_else(|_| {
            let cause = format!("no answer within {longest:?}");
            Err(objects.failed(cause).into())
        });
        if let Err(error) = &written
            && is_of_objects(error)
        {
            tracing::warn!(
                %error,
                "the store of objects takes no files and checkpoints; the database has them for {PAUSE:?}"
            );
            *self.local().objects_failed_at.lock().await = Some(Instant::now());
        }
        written
    }
}

/// Whether an error is one of the store of objects, or of which store it is.
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
