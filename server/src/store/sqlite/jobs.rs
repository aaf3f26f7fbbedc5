//! Reading, cancelling, deleting and inserting jobs.

use api::job::Status;
use sqlx::Row;
use uuid::Uuid;

use crate::clock::Now;
use crate::store::sqlite::document::{document, select};
use crate::store::sqlite::job_rows::{cancel, retry, status_of};
use crate::store::sqlite::queries::BEGIN;
use crate::store::{Cancelled, Deleted, Retried, Store, StoreError, StoredJob};

impl Store {
    /// Returns a job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn job(&self, id: Uuid) -> Result<Option<StoredJob>, StoreError> {
        let mut query = select();
        query.push(" WHERE id = ").push_bind(id.to_string());
        let Some(row) = query.build().fetch_optional(&self.readers).await? else {
            return Ok(None);
        };
        let document = document(&self.disk, &row)?;
        Ok(Some(StoredJob {
            waits_for_disk: self.disk.status_reason(document.status).is_some(),
            document,
            version: row.try_get("version")?,
            last_event: row.try_get("last_event")?,
        }))
    }

    /// Requests the end of a job: a queued one ends at once, a running one is ended by its worker. `None` if there is
    /// no such job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn cancel(&self, id: Uuid, now: i64) -> Result<Option<Cancelled>, StoreError> {
        let write = async || {
            let mut transaction = self.writer.begin_with(BEGIN).await?;
            let effect = cancel(&mut transaction, id, now).await?;
            transaction.commit().await?;
            Ok(effect)
        };
        let effect = self.disk.with_reserve(write).await?;
        self.cancelled(id, effect);
        Ok(effect)
    }

    /// Queues a failed or cancelled job again: it continues from its last checkpoint, with all its attempts, and with a
    /// deadline as far away as it was at its submission. `None` if there is no such job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn retry(
        &self,
        id: Uuid,
        now: impl Into<Now>,
    ) -> Result<Option<Retried>, StoreError> {
        self.disk.check()?;
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let effect = retry(&mut transaction, id, now.into()).await?;
        transaction.commit().await?;
        if effect == Some(Retried::Queued) {
            self.concluded(id, Some(Status::Queued));
        }
        Ok(effect)
    }

    /// Deletes a job that has ended, with its events, results and files.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn delete(&self, id: Uuid) -> Result<Deleted, StoreError> {
        let effect = self.disk.with_reserve(|| self.delete_rows(id)).await?;
        if effect == Deleted::Done {
            self.remove_files(id).await;
        }
        self.changed(id);
        Ok(effect)
    }

    async fn delete_rows(&self, id: Uuid) -> Result<Deleted, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let effect = match status_of(&mut transaction, id).await? {
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
        Ok(effect)
    }
}
