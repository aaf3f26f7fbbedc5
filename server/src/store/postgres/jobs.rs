//! Submission, reading, cancelling and deleting of jobs.

use api::job::Status;
use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::store::document::document;
use crate::store::job_ids::new_id;
use crate::store::new_row::NewRow;
use crate::store::postgres::job_rows::{cancel, insert, lock, retry};
use crate::store::postgres::selects::select;
use crate::store::postgres::{PostgresStore, begin};
use crate::store::rows::StoredRow;
use crate::store::{
    Cancelled, Deleted, Filter, ListPlace, NewJob, RequestKey, Retried, StoreError, StoredJob,
    Submitted,
};

impl PostgresStore {
    pub(in crate::store) async fn submit(
        &self,
        job: &NewJob,
        key: Option<&RequestKey>,
    ) -> Result<Submitted, StoreError> {
        self.local.disk.check()?;
        let (mut transaction, now) = self.begin().await?;
        let id = new_id(now.system_ms);
        if let Some(key) = key
            && let Some(earlier) = submitted_before(&mut transaction, key, id).await?
        {
            return Ok(earlier);
        }
        let new = [(job, NewRow::of(job, id, now)?)];
        insert(&mut transaction, &new, (None, now)).await?;
        transaction.commit().await?;
        self.local.concluded(id, Some(Status::Queued));
        Ok(Submitted::Job(id))
    }

    pub(in crate::store) async fn job(&self, id: Uuid) -> Result<Option<StoredJob>, StoreError> {
        let mut query = select();
        query.push(" WHERE id = ").push_bind(id);
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
        let sent = sqlx::query_scalar("SELECT spec FROM sent_specifications WHERE job_id = $1");
        Ok(sent.bind(id).fetch_optional(&self.readers).await?)
    }

    pub(in crate::store) async fn cancel(&self, id: Uuid) -> Result<Option<Cancelled>, StoreError> {
        let (mut transaction, now) = self.begin().await?;
        let effect = cancel(&mut transaction, id, now).await?;
        transaction.commit().await?;
        self.local.cancelled(id, effect);
        Ok(effect)
    }

    pub(in crate::store) async fn retry(&self, id: Uuid) -> Result<Option<Retried>, StoreError> {
        self.local.disk.check()?;
        let (mut transaction, now) = self.begin().await?;
        let effect = retry(&mut transaction, id, now).await?;
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
            self.local.changed(*id);
        }
        self.local.many_wait();
        let count = retried.len().try_into().unwrap_or(u64::MAX);
        Ok((count, filter.next_page(&ids)))
    }

    pub(in crate::store) async fn delete(&self, id: Uuid) -> Result<Deleted, StoreError> {
        let mut transaction = begin(&self.pool, None).await?;
        let effect = match lock(&mut transaction, id).await? {
            None => Deleted::Missing,
            Some(status) if !status.is_terminal() => Deleted::Active,
            Some(_) => {
                sqlx::query("DELETE FROM jobs WHERE id = $1")
                    .bind(id)
                    .execute(&mut *transaction)
                    .await?;
                Deleted::Done
            }
        };
        transaction.commit().await?;
        if effect == Deleted::Done {
            self.local.remove_files(id).await;
        }
        self.local.changed(id);
        Ok(effect)
    }
}

/// Notes the key of a submission, or returns the job that an earlier one with this key has queued.
async fn submitted_before(
    connection: &mut PgConnection,
    key: &RequestKey,
    id: Uuid,
) -> Result<Option<Submitted>, StoreError> {
    let noted = sqlx::query(
        "INSERT INTO request_keys (key, body_sha256, job_id) VALUES ($1, $2, $3) ON CONFLICT (key) DO NOTHING",
    )
    .bind(&key.key)
    .bind(key.meaning_sha256.as_slice())
    .bind(id)
    .execute(&mut *connection)
    .await?;
    if noted.rows_affected() > 0 {
        return Ok(None);
    }
    let known: Option<(Vec<u8>, Uuid)> =
        sqlx::query_as("SELECT body_sha256, job_id FROM request_keys WHERE key = $1")
            .bind(&key.key)
            .fetch_optional(connection)
            .await?;
    // Without a row, the job of the key was deleted in between: the client tries again.
    let (body, job) = known.ok_or(StoreError::Unwritten)?;
    Ok(Some(key.repeated(&body, job)))
}
