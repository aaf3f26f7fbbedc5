//! Reading, cancelling, deleting and inserting jobs.

use api::job::Status;
use uuid::Uuid;

use crate::store::document::document;
use crate::store::rows::StoredRow;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::job_rows::{cancel, retry, status_of};
use crate::store::sqlite::queries::BEGIN;
use crate::store::sqlite::selects::select;
use crate::store::{Cancelled, Deleted, Filter, ListPlace, Retried, StoreError, StoredJob};

impl SqliteStore {
    pub(in crate::store) async fn job(&self, id: Uuid) -> Result<Option<StoredJob>, StoreError> {
        let mut query = select();
        query.push(" WHERE id = ").push_bind(id.to_string());
        let Some(row) = query.build().fetch_optional(&self.readers).await? else {
            return Ok(None);
        };
        let document = document(&self.local, &row)?;
        Ok(Some(StoredJob {
            waits_for_disk: self.local.disk.status_reason(document.status).is_some(),
            document,
            version: row.integer("version")?,
            last_event: row.integer("last_event")?,
        }))
    }

    pub(in crate::store) async fn sent_spec(&self, id: Uuid) -> Result<Option<String>, StoreError> {
        let sent = sqlx::query_scalar("SELECT spec FROM sent_specifications WHERE job_id = ?")
            .bind(id.to_string());
        Ok(sent.fetch_optional(&self.readers).await?)
    }

    pub(in crate::store) async fn cancel(&self, id: Uuid) -> Result<Option<Cancelled>, StoreError> {
        let write = async || {
            let mut transaction = self.writer.begin_with(BEGIN).await?;
            let effect = cancel(&mut transaction, id, self.local.clock.now()).await?;
            transaction.commit().await?;
            Ok(effect)
        };
        let effect = self.local.disk.with_reserve(write).await?;
        self.local.cancelled(id, effect);
        Ok(effect)
    }

    pub(in crate::store) async fn retry(&self, id: Uuid) -> Result<Option<Retried>, StoreError> {
        self.local.disk.check()?;
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let effect = retry(&mut transaction, id, self.local.clock.now()).await?;
        transaction.commit().await?;
        if effect == Some(Retried::Queued) {
            self.local.concluded(id, Some(Status::Queued));
        }
        Ok(effect)
    }

    pub(in crate::store) async fn retry_some(
        &self,
        filter: &Filter,
    ) -> Result<(u64, Option<ListPlace>), StoreError> {
        self.local.disk.check()?;
        let ids = self.ids(filter).await?;
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let now = self.local.clock.now();
        let mut retried = Vec::with_capacity(ids.len());
        for id in &ids {
            if retry(&mut transaction, *id, now).await? == Some(Retried::Queued) {
                retried.push(*id);
            }
        }
        transaction.commit().await?;
        for id in &retried {
            self.local.changed(*id);
        }
        self.local.many_wait();
        let count = retried.len().try_into().unwrap_or(u64::MAX);
        Ok((count, filter.next_page(&ids)))
    }

    pub(in crate::store) async fn delete(&self, id: Uuid) -> Result<Deleted, StoreError> {
        let effect = self
            .local
            .disk
            .with_reserve(|| self.delete_rows(id))
            .await?;
        if effect == Deleted::Done {
            self.local.remove_files(id).await;
        }
        self.local.changed(id);
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
