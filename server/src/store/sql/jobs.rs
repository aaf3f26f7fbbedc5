//! Reading, cancelling, deleting and retrying of jobs.

use api::job::Status;
use uuid::Uuid;

use super::dialect::{EngineStore, stored_id};
use super::job_rows::{cancel, lock, retry};
use super::selects::select;
use crate::store::document::document;
use crate::store::rows::StoredRow;
use crate::store::{Cancelled, Deleted, Filter, ListPlace, Retried, StoreError, StoredJob};

impl EngineStore {
    pub(in crate::store) async fn job(&self, id: Uuid) -> Result<Option<StoredJob>, StoreError> {
        let mut query = select();
        query.push(" WHERE id = ").push_bind(stored_id(id));
        let Some(row) = query.build().fetch_optional(&self.readers).await? else {
            return Ok(None);
        };
        let document = document(&self.process, &row)?;
        Ok(Some(StoredJob {
            waits_for_disk: self.process.disk.status_reason(document.status).is_some(),
            document,
            version: row.value("version")?,
            last_event: row.value("last_event")?,
        }))
    }

    pub(in crate::store) async fn sent_spec(&self, id: Uuid) -> Result<Option<String>, StoreError> {
        let sent = sqlx::query_scalar("SELECT spec FROM sent_specifications WHERE job_id = $1");
        Ok(sent
            .bind(stored_id(id))
            .fetch_optional(&self.readers)
            .await?)
    }

    pub(in crate::store) async fn cancel(&self, id: Uuid) -> Result<Option<Cancelled>, StoreError> {
        let write = async || {
            let (mut transaction, now) = self.begin().await?;
            let effect = cancel(&mut transaction, id, now).await?;
            transaction.commit().await?;
            Ok(effect)
        };
        let effect = self.with_reserve(write).await?;
        self.process.cancelled(id, effect);
        Ok(effect)
    }

    pub(in crate::store) async fn retry(&self, id: Uuid) -> Result<Option<Retried>, StoreError> {
        self.process.disk.check()?;
        let (mut transaction, now) = self.begin().await?;
        let effect = retry(&mut transaction, id, now).await?;
        transaction.commit().await?;
        if effect == Some(Retried::Queued) {
            self.process.concluded(id, Some(Status::Queued));
        }
        Ok(effect)
    }

    pub(in crate::store) async fn retry_some(
        &self,
        filter: &Filter,
    ) -> Result<(u64, Option<ListPlace>), StoreError> {
        self.process.disk.check()?;
        let ids = self.ids(filter).await?;
        let (mut transaction, now) = self.begin().await?;
        let mut retried = Vec::with_capacity(ids.len());
        // In the order in which others lock them.
        for id in ids.iter().rev() {
            if retry(&mut transaction, *id, now).await? == Some(Retried::Queued) {
                retried.push(*id);
            }
        }
        transaction.commit().await?;
        for id in &retried {
            self.process.changed(*id);
        }
        self.process.many_wait();
        let count = retried.len().try_into().unwrap_or(u64::MAX);
        Ok((count, filter.next_page(&ids)))
    }

    pub(in crate::store) async fn delete(&self, id: Uuid) -> Result<Deleted, StoreError> {
        let effect = self.with_reserve(|| self.delete_rows(id)).await?;
        if effect == Deleted::Done {
            self.process.remove_files(id).await;
        }
        self.process.changed(id);
        Ok(effect)
    }

    async fn delete_rows(&self, id: Uuid) -> Result<Deleted, StoreError> {
        let (mut transaction, _) = self.begin().await?;
        let effect = match lock(&mut transaction, id).await? {
            None => Deleted::Missing,
            Some(status) if !status.is_terminal() => Deleted::Active,
            Some(_) => {
                sqlx::query("DELETE FROM jobs WHERE id = $1")
                    .bind(stored_id(id))
                    .execute(&mut *transaction)
                    .await?;
                Deleted::Done
            }
        };
        transaction.commit().await?;
        Ok(effect)
    }
}
