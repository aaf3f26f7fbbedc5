//! Submission of jobs.

use api::job::Status;
use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::store::job_ids::new_id;
use crate::store::new_row::NewRow;
use crate::store::postgres::PostgresStore;
use crate::store::postgres::insertion::insert;
use crate::store::{NewJob, RequestKey, StoreError, Submitted};

impl PostgresStore {
    pub(in crate::store) async fn submit(
        &self,
        job: &NewJob,
        key: Option<&RequestKey>,
    ) -> Result<Submitted, StoreError> {
        self.process.disk.check()?;
        let (mut transaction, now) = self.begin().await?;
        let id = new_id(now.system_ms);
        if let Some(key) = key
            && let Some(earlier) = submitted_before(&mut transaction, key, id).await?
        {
            return Ok(earlier);
        }
        let new = [(job, NewRow::of(job, id, now)?)];
        insert(&mut transaction, &new, None, now).await?;
        transaction.commit().await?;
        self.process.concluded(id, Some(Status::Queued));
        Ok(Submitted::Job(id))
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
