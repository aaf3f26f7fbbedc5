//! Reading, cancelling, deleting and inserting jobs.

use api::job::Status;
use uuid::Uuid;

use crate::store::sqlite::document::JobRow;
use crate::store::sqlite::job_rows::{cancel, status};
use crate::store::sqlite::queries::BEGIN;
use crate::store::{Cancelled, Deleted, Store, StoreError, StoredJob};

impl Store {
    /// Returns a job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn job(&self, id: Uuid) -> Result<Option<StoredJob>, StoreError> {
        let mut query = JobRow::select();
        query.push(" WHERE id = ").push_bind(id.to_string());
        let row: Option<JobRow> = query.build_query_as().fetch_optional(&self.readers).await?;
        row.map(|row| {
            Ok(StoredJob {
                document: row.document()?,
                version: row.version,
                last_event: row.last_event,
            })
        })
        .transpose()
    }

    /// Requests the end of a job: a queued one ends at once, a running one is ended by its worker. `None` if there is no
    /// such job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn cancel(&self, id: Uuid, now: i64) -> Result<Option<Cancelled>, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let effect = cancel(&mut transaction, id, now).await?;
        transaction.commit().await?;
        let ended = (effect == Some(Cancelled::AtOnce)).then_some(Status::Cancelled);
        self.concluded(id, ended);
        Ok(effect)
    }

    /// Deletes a job that has ended, with its events, results and files.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn delete(&self, id: Uuid) -> Result<Deleted, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let effect = match status(&mut transaction, id).await? {
            None => Deleted::Missing,
            Some(status) if !status.is_terminal() => Deleted::Active,
            Some(_) => {
                sqlx::query("DELETE FROM jobs WHERE id = ?")
                    .bind(id.to_string())
                    .execute(&mut *transaction)
                    .await?;
                Deleted::Done
            }
        };
        transaction.commit().await?;
        if effect == Deleted::Done {
            self.remove_files(id).await;
        }
        self.changed(id);
        Ok(effect)
    }
}
